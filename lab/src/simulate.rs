//! A discrete-event simulation of processors that work on tiles. It uses the same scheduler as threads
//! ([`octray_render::scheduler`]), with any number of processors.

use octray_render::scheduler::Scheduler;
use serde::Serialize;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Instructions that each tile costs its thread beyond its pixels: Callgrind's count for a picture in tiles of one
/// pixel, minus that for the same picture in whole rows.
pub const PER_TILE: f64 = 1300.0;

/// Instructions that a thread could execute while handing out a tile blocks the others: 11 ns, measured with two
/// threads that did nothing but take tiles.
pub const HAND_OUT: f64 = 100.0;

/// A parallel machine. Costs and times are in instructions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Machine {
    /// How long handing out a tile from a shared queue blocks other hand-outs.
    pub hand_out: f64,
    /// The relative slowdown of all processors per further busy processor, as on a bus: each of `n` runs at 1 / (1 +
    /// contention · (n − 1) + coherence · n · (n − 1)).
    pub contention: f64,
    /// The relative slowdown of all processors per pair of busy processors and direction, as by caches that are kept
    /// alike. With it the speed-up has a peak, at √((1 − contention) / coherence) processors (Gunther, *Guerrilla Capacity
    /// Planning*, 2007, equation 4.10).
    pub coherence: f64,
    /// Work that only one processor can do, before the others begin (Amdahl).
    pub serial: f64,
}

/// The result of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Time from the begin of the serial work to the end of the last tile.
    pub time: f64,
    /// Speed-up over one processor, which needs no hand-outs.
    pub speed_up: f64,
    /// Speed-up per processor.
    pub efficiency: f64,
}

/// Simulates the processors of a new scheduler working on tiles with the given costs.
///
/// Until the first processor finds no tile, all are busy and equally slow. Therefore events are computed in the
/// processors' own time, which contention stretches afterwards.
pub fn simulate(costs: &[f64], deal: &Scheduler, machine: &Machine) -> Outcome {
    simulate_messages(costs, deal, machine, |_| 0.0)
}

/// The same, but handing out a tile from a shared queue takes `more` of its number in addition to
/// [`Machine::hand_out`].
pub fn simulate_messages(
    costs: &[f64],
    deal: &Scheduler,
    machine: &Machine,
    more: impl Fn(usize) -> f64,
) -> Outcome {
    let processors = deal.processors();
    let mut free: BinaryHeap<_> = (0..processors).map(|p| Reverse(Event(0.0, p))).collect();
    let mut desk_free: f64 = 0.0;
    let mut ends = Vec::with_capacity(processors);
    while let Some(Reverse(Event(mut now, processor))) = free.pop() {
        let Some(dealt) = deal.next(processor) else {
            ends.push(now);
            continue;
        };
        if dealt.shared {
            desk_free = desk_free.max(now) + machine.hand_out + more(dealt.tile);
            now = desk_free;
        }
        let cost = costs.get(dealt.tile).copied().unwrap_or_default();
        free.push(Reverse(Event(now + cost, processor)));
    }
    // Sorted by time, because the heap returns no earlier event after a later one.
    let mut parallel = 0.0;
    let mut since = 0.0;
    for (done, end) in ends.iter().enumerate() {
        let others = (processors - done - 1) as f64;
        let slower = machine.contention + machine.coherence * (others + 1.0);
        parallel += (end - since) * (1.0 + slower * others);
        since = *end;
    }
    let alone = machine.serial + costs.iter().sum::<f64>();
    let time = machine.serial + parallel;
    let speed_up = if time > 0.0 { alone / time } else { 1.0 };
    Outcome {
        time,
        speed_up,
        efficiency: speed_up / processors as f64,
    }
}

/// When a processor becomes free. Of simultaneous events, that of the first processor comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Event(f64, usize);

impl Eq for Event {}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Event {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_render::cost::most_expensive_first;
    use octray_render::scheduler::Policy;
    use std::num::NonZeroUsize;
    use strum::VariantArray;

    fn run(costs: &[f64], policy: Policy, processors: usize, machine: Machine) -> Outcome {
        let processors = NonZeroUsize::new(processors).unwrap();
        let deal = Scheduler::new(policy, costs.len(), processors, most_expensive_first(costs));
        simulate(costs, &deal, &machine)
    }

    #[test]
    fn equal_tiles_are_shared_without_loss() {
        for policy in Policy::VARIANTS {
            for processors in [1, 2, 4, 8] {
                let outcome = run(&[5.0; 64], *policy, processors, Machine::default());
                assert_eq!(outcome.speed_up, processors as f64, "{policy:?}");
                assert_eq!(outcome.efficiency, 1.0);
            }
        }
    }

    #[test]
    fn more_processors_than_tiles_do_not_help() {
        for policy in Policy::VARIANTS {
            let outcome = run(&[3.0, 1.0], *policy, 9, Machine::default());
            assert_eq!(outcome.time, 3.0, "{policy:?}");
        }
    }

    #[test]
    fn each_policy_ends_when_computed_by_hand() {
        // The expensive tiles come last.
        let costs = [1.0, 1.0, 1.0, 1.0, 4.0, 4.0];
        for (policy, time) in [
            (Policy::Prescheduled, 9.0),
            (Policy::Static, 6.0),
            (Policy::Dynamic, 6.0),
            (Policy::CostOrdered, 6.0),
        ] {
            let outcome = run(&costs, policy, 2, Machine::default());
            assert_eq!(outcome.time, time, "{policy:?}");
        }
        let last = [1.0, 1.0, 1.0, 3.0];
        assert_eq!(run(&last, Policy::Dynamic, 2, Machine::default()).time, 4.0);
        assert_eq!(
            run(&last, Policy::CostOrdered, 2, Machine::default()).time,
            3.0
        );
    }

    #[test]
    fn no_policy_beats_the_lower_bounds() {
        let costs: Vec<f64> = (0..97).map(|i| f64::from(i * i % 31)).collect();
        let sum: f64 = costs.iter().sum();
        let largest = costs.iter().copied().fold(0.0, f64::max);
        for policy in Policy::VARIANTS {
            for processors in [1, 3, 16, 100] {
                let time = run(&costs, *policy, processors, Machine::default()).time;
                let least = f64::max(sum / processors as f64, largest);
                assert!(time >= least * (1.0 - 1e-12), "{policy:?} {processors}");
                if matches!(policy, Policy::Dynamic | Policy::CostOrdered) {
                    // Graham's bound for any list.
                    assert!(time <= sum / processors as f64 + largest, "{policy:?}");
                }
            }
        }
    }

    #[test]
    fn serial_work_limits_the_speed_up_by_amdahls_law() {
        let machine = Machine {
            serial: 100.0,
            ..Machine::default()
        };
        let outcome = run(&[9.0; 100], Policy::Dynamic, 100, machine);
        assert!((outcome.speed_up - 1000.0 / 109.0).abs() < 1e-12);
    }

    #[test]
    fn hand_outs_queue_only_for_shared_tiles() {
        let machine = Machine {
            hand_out: 2.0,
            ..Machine::default()
        };
        // Four processors ask at once: the last waits for four hand-outs.
        assert_eq!(run(&[10.0; 4], Policy::Dynamic, 4, machine).time, 18.0);
        assert_eq!(run(&[10.0; 4], Policy::Static, 4, machine).time, 10.0);
    }

    #[test]
    fn each_tile_has_its_own_hand_out_time() {
        let deal = Scheduler::new(Policy::Dynamic, 2, NonZeroUsize::new(2).unwrap(), vec![]);
        let machine = Machine {
            hand_out: 1.0,
            ..Machine::default()
        };
        let outcome = simulate_messages(&[10.0; 2], &deal, &machine, |tile| tile as f64);
        // The second processor waits for a hand-out of 1; its own takes 2.
        assert_eq!(outcome.time, 13.0);
    }

    #[test]
    fn messages_queue_with_every_policy() {
        let machine = Machine {
            hand_out: 2.0,
            ..Machine::default()
        };
        for policy in Policy::VARIANTS {
            let deal = Scheduler::new(*policy, 4, NonZeroUsize::new(4).unwrap(), vec![]);
            let outcome = simulate(&[10.0; 4], &deal.in_messages(), &machine);
            // The first processor's tile needs no message.
            assert_eq!(outcome.time, 16.0, "{policy:?}");
        }
    }

    #[test]
    fn contention_slows_while_others_are_busy() {
        let machine = Machine {
            contention: 0.5,
            ..Machine::default()
        };
        // Both are busy for 2 at 2/3 of the speed, then one works alone for 4.
        assert_eq!(run(&[2.0, 6.0], Policy::Static, 2, machine).time, 7.0);
        assert_eq!(
            run(&[4.0; 2], Policy::Static, 2, machine).speed_up,
            8.0 / 6.0
        );
    }
}
