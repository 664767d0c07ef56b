//! Looking for the packing with which threads take the least time, by simulating them.

use super::{EVENT, FIXED, HAND_OUT, MESSAGE, PER_PACKET, SHARE, WASTE};
use crate::cost::{CostMap, dearest_first};
use crate::deal::{Deal, Policy};
use crate::packets::Shape;
use crate::simulate::{Machine, simulate};
use octray_core::frame::Region;
use std::collections::HashMap;
use std::num::NonZeroUsize;

/// A packing, simulated. Times are in instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) policy: Policy,
    pub(super) shape: Shape,
    /// The time that one thread takes which does without packets.
    alone: f64,
    /// The time that all threads take.
    shared: f64,
}

impl Candidate {
    /// The speed-up if the threads begin only after some time.
    pub(super) fn speed_up(&self, serial: f64) -> f64 {
        match self.shared + serial {
            time if time > 0.0 => self.alone / time,
            _ => 1.0,
        }
    }
}

/// A picture to be packed.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) map: &'a CostMap,
    pub(super) region: &'a Region,
    pub(super) threads: NonZeroUsize,
    /// Whether packets come in messages.
    pub(super) messages: bool,
    /// Instructions before the threads begin.
    pub(super) serial: f64,
}

impl Search<'_> {
    /// The best candidate, beside [`FIXED`], and how many packings were tried: until one leaves nothing to be won
    /// or trying has taken as long as it may. [`FIXED`] and the first candidate are tried in any case.
    pub(super) fn best(&self, candidates: &[(Policy, Shape)]) -> (Candidate, Candidate, usize) {
        let (total, threads) = (self.map.cost(self.region), self.threads.get() as f64);
        let mut left = total / threads * SHARE / EVENT;
        let mut packed: HashMap<Shape, Vec<f64>> = HashMap::new();
        let mut simulate = |policy, shape| {
            let costs = packed.entry(shape).or_insert_with(|| self.costs(shape));
            self.simulate(policy, shape, costs)
        };
        let events = |shape: Shape| shape.count(self.region) as f64 + threads;
        left -= events(FIXED.1);
        let fixed = simulate(FIXED.0, FIXED.1);
        let (mut best, mut tried): (Option<Candidate>, _) = (None, 1);
        for &(policy, shape) in candidates {
            let candidate = match (policy, shape) == FIXED {
                true => fixed,
                // A coarser one may still be worth its time.
                false if best.is_some() && left < events(shape) => continue,
                false => {
                    left -= events(shape);
                    tried += 1;
                    simulate(policy, shape)
                }
            };
            let speed_up = candidate.speed_up(self.serial);
            let better =
                |best: Candidate| speed_up > best.speed_up(self.serial) * (1.0 + WASTE / 2.0);
            if best.is_none_or(better) {
                best = Some(candidate);
            }
            let most = total / (total / threads + self.serial);
            if speed_up >= most * (1.0 - WASTE) {
                break;
            }
        }
        (best.unwrap_or(fixed), fixed, tried)
    }

    /// What packets of a shape are estimated to cost.
    pub(super) fn estimates(&self, shape: Shape) -> Vec<f64> {
        let parts = shape.cut(self.region);
        parts.map(|part| self.map.cost(&part)).collect()
    }

    /// What packets of a shape cost if the estimates are as wrong as they probably are.
    fn costs(&self, shape: Shape) -> Vec<f64> {
        let wrong = |(packet, part): (u64, Region)| {
            let cost = self.map.cost(&part) * (1.0 + coin(packet) * self.map.error(&part));
            cost.max(0.0)
        };
        (0..).zip(shape.cut(self.region)).map(wrong).collect()
    }

    /// How long the threads take with packets of a shape that cost what is given; what is dealt by estimates is not
    /// what it costs.
    fn simulate(&self, policy: Policy, shape: Shape, costs: &[f64]) -> Candidate {
        let order = match policy {
            Policy::CostOrdered => dearest_first(&self.estimates(shape)),
            _ => Vec::new(),
        };
        let mut deal = Deal::new(policy, costs.len(), self.threads, order);
        let mut hand_out = HAND_OUT;
        if self.messages {
            (deal, hand_out) = (deal.in_messages(), MESSAGE);
        }
        let machine = Machine {
            hand_out,
            ..Machine::default()
        };
        let with_packets: Vec<f64> = costs.iter().map(|cost| cost + PER_PACKET).collect();
        Candidate {
            policy,
            shape,
            alone: costs.iter().sum(),
            shared: simulate(&with_packets, &deal, &machine).time,
        }
    }
}

/// 1 or −1, by the flip of a coin that falls alike each time (SplitMix64).
fn coin(packet: u64) -> f64 {
    let mut bits = (packet + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    match (bits ^ bits >> 31) & 1 {
        0 => 1.0,
        _ => -1.0,
    }
}
