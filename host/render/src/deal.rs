//! Dealing packets of work to processors: the three ways of the thesis (chapter 5), and three since.
//!
//! A [`Deal`] says which packet a processor gets next. Threads ask it ([`crate::threads`]), and so does the
//! simulation ([`crate::simulate`]): both see the same dealing.

use serde::Serialize;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Which processor gets which packet.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    Hash,
    Serialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Policy {
    /// Each has one block of neighbouring packets.
    Prescheduled,
    /// Packets are dealt round-robin beforehand.
    Static,
    /// The next packet goes to the next idle one.
    #[default]
    Dynamic,
    /// The next idle one gets its share of what is left, down to one packet.
    Guided,
    /// The dearest packet that is left, by estimate, goes to the next idle one.
    CostOrdered,
    /// Each has a block; an idle one takes half of what is left of the largest.
    WorkStealing,
}

impl Policy {
    /// Its name on the command line and in statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Prescheduled => "prescheduled",
            Self::Static => "static",
            Self::Dynamic => "dynamic",
            Self::Guided => "guided",
            Self::CostOrdered => "cost-ordered",
            Self::WorkStealing => "work-stealing",
        }
    }
}

/// Packets that are dealt, each exactly once.
///
/// - Guided is guided self-scheduling (Polychronopoulos and Kuck, 1987): ⌈left / processors⌉ at a time.
/// - Cost-ordered is list scheduling by longest time first (Graham, 1969): at most 4/3 of the best.
#[derive(Debug)]
pub struct Deal {
    policy: Policy,
    packets: usize,
    /// The packets that each processor has in hand: from the first (lower half) up to the second.
    hands: Vec<AtomicU64>,
    /// The next packet, or place in `order`, of the policies that deal from one pile.
    next: AtomicUsize,
    order: Vec<u32>,
    /// Whether an idle processor found nothing left to take from others.
    nothing_left: AtomicBool,
    /// Whether packets come in messages from the first processor.
    in_messages: bool,
}

/// A packet dealt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dealt {
    /// Which one.
    pub packet: usize,
    /// Whether it came from others than the processor itself, which takes longer.
    pub shared: bool,
}

impl Deal {
    /// Packets 0 to `packets` − 1 (fewer than 2³²) for `processors` processors. `order` has the packets from
    /// the dearest to the cheapest; only cost-ordered dealing looks at it.
    pub fn new(policy: Policy, packets: usize, processors: NonZeroUsize, order: Vec<u32>) -> Self {
        let processors = processors.get();
        // The blocks' sizes differ by one at most, the larger ones first.
        let (size, larger) = (packets / processors, packets % processors);
        let block = |processor: usize| processor * size + processor.min(larger);
        let hand = |processor| match policy {
            Policy::Prescheduled | Policy::WorkStealing => {
                hand(block(processor), block(processor + 1))
            }
            Policy::Static => hand(processor, packets),
            Policy::Dynamic | Policy::Guided | Policy::CostOrdered => hand(0, 0),
        };
        Self {
            policy,
            packets,
            hands: (0..processors).map(|p| AtomicU64::new(hand(p))).collect(),
            next: AtomicUsize::new(0),
            order,
            nothing_left: AtomicBool::new(false),
            in_messages: false,
        }
    }

    /// The same by messages from the first processor, as to the ranks of an MPI job: every packet for another one
    /// comes from others, whatever the policy, and none of its own.
    pub fn in_messages(self) -> Self {
        Self {
            in_messages: true,
            ..self
        }
    }

    /// How many processors the packets are dealt to.
    pub fn processors(&self) -> usize {
        self.hands.len()
    }

    /// The next packet for `processor`; `None` if there is none left for it.
    pub fn next(&self, processor: usize) -> Option<Dealt> {
        let Dealt { packet, shared } = self.deal(processor)?;
        let shared = match self.in_messages {
            true => processor != 0,
            false => shared,
        };
        Some(Dealt { packet, shared })
    }

    fn deal(&self, processor: usize) -> Option<Dealt> {
        let own = |step| {
            let packet = self.take(processor, step)?;
            let shared = false;
            Some(Dealt { packet, shared })
        };
        match self.policy {
            Policy::Prescheduled => own(1),
            Policy::Static => own(self.hands.len()),
            Policy::Dynamic => self.draw().map(shared),
            Policy::CostOrdered => {
                let place = self.draw()?;
                let packet = self
                    .order
                    .get(place)
                    .map_or(place, |&packet| packet as usize);
                Some(shared(packet))
            }
            Policy::Guided => own(1).or_else(|| self.share(processor).map(shared)),
            Policy::WorkStealing => own(1).or_else(|| self.steal(processor).map(shared)),
        }
    }

    /// Take the first packet that a processor has in hand, and go on by `step`.
    fn take(&self, processor: usize, step: usize) -> Option<usize> {
        let hand_of = self.hands.get(processor)?;
        let rest = hand_of.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |held| {
            let (first, end) = packets_of(held);
            (first < end).then(|| hand((first + step).min(end), end))
        });
        rest.ok().map(|held| packets_of(held).0)
    }

    /// Take the next packet off the pile.
    fn draw(&self) -> Option<usize> {
        let packet = self.next.fetch_add(1, Ordering::Relaxed);
        (packet < self.packets).then_some(packet)
    }

    /// Take one share off the pile; all but its first packet go into the processor's hand.
    fn share(&self, processor: usize) -> Option<usize> {
        let after = |first: usize| first + (self.packets - first).div_ceil(self.hands.len());
        let first = self
            .next
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, |first| {
                (first < self.packets).then(|| after(first))
            })
            .ok()?;
        self.hands[processor].store(hand(first + 1, after(first)), Ordering::Relaxed);
        Some(first)
    }

    /// Take the second half of the largest hand; all but its first packet go into the processor's own.
    fn steal(&self, processor: usize) -> Option<usize> {
        // Hands only shrink but for what was stolen, so nobody has to look through all of them again.
        if self.nothing_left.load(Ordering::Relaxed) {
            return None;
        }
        loop {
            // Among equally large hands the first.
            let victims = self.hands.iter().rev();
            let victim = victims.max_by_key(|hand| left(hand.load(Ordering::Relaxed)))?;
            let held = victim.load(Ordering::Relaxed);
            if left(held) == 0 {
                let nothing = |hand: &AtomicU64| left(hand.load(Ordering::Relaxed)) == 0;
                if self.hands.iter().all(nothing) {
                    self.nothing_left.store(true, Ordering::Relaxed);
                    return None;
                }
                continue;
            }
            let (first, end) = packets_of(held);
            let middle = first + (end - first) / 2;
            // No packet is dealt twice, so a hand never holds again what it once held.
            let (whole, half) = (held, hand(first, middle));
            let taken = victim.compare_exchange(whole, half, Ordering::Relaxed, Ordering::Relaxed);
            if taken.is_ok() {
                self.hands[processor].store(hand(middle + 1, end), Ordering::Relaxed);
                return Some(middle);
            }
        }
    }
}

fn shared(packet: usize) -> Dealt {
    let shared = true;
    Dealt { packet, shared }
}

/// The packets from `first` up to `end` in one word.
fn hand(first: usize, end: usize) -> u64 {
    (end as u64) << 32 | first as u64 & 0xffff_ffff
}

fn packets_of(hand: u64) -> (usize, usize) {
    ((hand & 0xffff_ffff) as usize, (hand >> 32) as usize)
}

fn left(hand: u64) -> usize {
    let (first, end) = packets_of(hand);
    end.saturating_sub(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_prepare::choice::Choice;

    #[test]
    fn a_policy_has_the_same_name_everywhere() {
        for policy in Policy::VARIANTS {
            assert_eq!(Policy::named(policy.name()), Some(*policy));
            assert_eq!(serde_json::to_value(policy).unwrap(), policy.name());
        }
    }

    /// Who gets what when everybody asks in turn.
    fn in_turns(
        policy: Policy,
        packets: usize,
        processors: usize,
        order: &[u32],
    ) -> Vec<Vec<usize>> {
        let processors = NonZeroUsize::new(processors).unwrap();
        let deal = Deal::new(policy, packets, processors, order.to_vec());
        let mut hands = vec![Vec::new(); deal.processors()];
        loop {
            let mut dealt = false;
            for (processor, hand) in hands.iter_mut().enumerate() {
                if let Some(next) = deal.next(processor) {
                    hand.push(next.packet);
                    dealt = true;
                }
            }
            if !dealt {
                return hands;
            }
        }
    }

    #[test]
    fn every_packet_is_dealt_exactly_once() {
        for policy in Policy::VARIANTS {
            for (packets, processors) in [(0, 1), (0, 4), (1, 4), (7, 3), (64, 1), (1000, 5)] {
                let mut all = in_turns(*policy, packets, processors, &[]).concat();
                all.sort_unstable();
                let expected: Vec<_> = (0..packets).collect();
                assert_eq!(all, expected, "{policy:?} {packets} {processors}");
            }
        }
    }

    #[test]
    fn what_is_dealt_beforehand_is_dealt_as_the_thesis_has_it() {
        let round_robin = [vec![0, 3, 6], vec![1, 4], vec![2, 5]];
        assert_eq!(in_turns(Policy::Static, 7, 3, &[]), round_robin);
        let blocks = [vec![0, 1, 2], vec![3, 4], vec![5, 6]];
        assert_eq!(in_turns(Policy::Prescheduled, 7, 3, &[]), blocks);
    }

    #[test]
    fn guided_shares_shrink() {
        // Of 10 left: 5, of 5: 3, of 2: 1, of 1: 1.
        let deal = Deal::new(
            Policy::Guided,
            10,
            NonZeroUsize::new(2).unwrap(),
            Vec::new(),
        );
        let shared = |processor, packet| {
            let expected = Some(Dealt {
                packet,
                shared: true,
            });
            assert_eq!(deal.next(processor), expected);
        };
        shared(0, 0);
        shared(1, 5);
        for packet in 1..5 {
            let expected = Some(Dealt {
                packet,
                shared: false,
            });
            assert_eq!(deal.next(0), expected);
        }
        shared(0, 8);
        shared(0, 9);
        assert_eq!(deal.next(0), None);
        assert_eq!(deal.next(1).map(|dealt| dealt.packet), Some(6));
    }

    #[test]
    fn the_dearest_packet_comes_first() {
        let dealt = in_turns(Policy::CostOrdered, 4, 2, &[2, 0, 3, 1]);
        assert_eq!(dealt, [vec![2, 3], vec![0, 1]]);
    }

    #[test]
    fn every_packet_for_others_than_the_first_is_a_message() {
        for policy in Policy::VARIANTS {
            let two = const { NonZeroUsize::new(2).unwrap() };
            let deal = Deal::new(*policy, 8, two, Vec::new()).in_messages();
            for processor in [0, 1, 1, 0] {
                let dealt = deal.next(processor).unwrap();
                assert_eq!(dealt.shared, processor == 1, "{policy:?}");
            }
        }
    }

    #[test]
    fn half_of_the_largest_hand_is_stolen() {
        let deal = Deal::new(
            Policy::WorkStealing,
            12,
            NonZeroUsize::new(3).unwrap(),
            Vec::new(),
        );
        let next = |processor| {
            deal.next(processor)
                .map(|dealt| (dealt.packet, dealt.shared))
        };
        for packet in 0..4 {
            assert_eq!(next(0), Some((packet, false)));
        }
        assert_eq!(next(1), Some((4, false)));
        // Three are left to the second, four to the third: 10 and 11 are taken.
        assert_eq!(next(0), Some((10, true)));
        assert_eq!(next(0), Some((11, false)));
        assert_eq!(next(0), Some((6, true)));
    }
}
