//! Scheduling tiles on processors: the three ways of the thesis (chapter 5), and three since.
//!
//! A [`Scheduler`] says which tile a processor gets next. Threads ask it ([`crate::threads`]), and so does the
//! simulation of `octray schedule`: both see the same schedule.

use serde::Serialize;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Which processor gets which tile.
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
    /// Each has one block of neighbouring tiles.
    Prescheduled,
    /// Tiles are assigned round-robin beforehand.
    Static,
    /// The next tile goes to the next idle one.
    #[default]
    Dynamic,
    /// The next idle one gets its share of what is left, down to one tile.
    Guided,
    /// The most expensive tile that is left, by estimate, goes to the next idle one.
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

/// Assigns tiles to processors, each exactly once.
///
/// - Guided is guided self-scheduling (Polychronopoulos and Kuck, 1987): ⌈left / processors⌉ at a time.
/// - Cost-ordered is list scheduling by longest time first (Graham, 1969): at most 4/3 of the best.
#[derive(Debug)]
pub struct Scheduler {
    policy: Policy,
    tiles: usize,
    /// The tiles that each processor has queued: from the first (lower half) up to the second.
    queues: Vec<AtomicU64>,
    /// The next tile, or place in `order`, of the policies with one queue for all.
    next: AtomicUsize,
    order: Vec<u32>,
    /// Whether an idle processor found nothing left to take from others.
    nothing_left: AtomicBool,
    /// Whether tiles come in messages from the first processor.
    in_messages: bool,
}

/// A tile that was assigned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// Which one.
    pub tile: usize,
    /// Whether it came from others than the processor itself, which takes longer.
    pub shared: bool,
}

impl Scheduler {
    /// Tiles 0 to `tiles` − 1 (fewer than 2³²) for `processors` processors. `order` has the tiles from
    /// the most expensive to the cheapest; only cost-ordered scheduling looks at it.
    pub fn new(policy: Policy, tiles: usize, processors: NonZeroUsize, order: Vec<u32>) -> Self {
        let processors = processors.get();
        // The blocks' sizes differ by one at most, the larger ones first.
        let (size, larger) = (tiles / processors, tiles % processors);
        let block = |processor: usize| processor * size + processor.min(larger);
        let queue = |processor| match policy {
            Policy::Prescheduled | Policy::WorkStealing => {
                pack(block(processor), block(processor + 1))
            }
            Policy::Static => pack(processor, tiles),
            Policy::Dynamic | Policy::Guided | Policy::CostOrdered => pack(0, 0),
        };
        Self {
            policy,
            tiles,
            queues: (0..processors).map(|p| AtomicU64::new(queue(p))).collect(),
            next: AtomicUsize::new(0),
            order,
            nothing_left: AtomicBool::new(false),
            in_messages: false,
        }
    }

    /// The same by messages from the first processor, as to the ranks of an MPI job: every tile for another one
    /// comes from others, whatever the policy, and none of its own.
    pub fn in_messages(self) -> Self {
        Self {
            in_messages: true,
            ..self
        }
    }

    /// How many processors the tiles are dealt to.
    pub fn processors(&self) -> usize {
        self.queues.len()
    }

    /// The next tile for `processor`; `None` if there is none left for it.
    pub fn next(&self, processor: usize) -> Option<Assignment> {
        let Assignment { tile, shared } = self.assign(processor)?;
        let shared = match self.in_messages {
            true => processor != 0,
            false => shared,
        };
        Some(Assignment { tile, shared })
    }

    fn assign(&self, processor: usize) -> Option<Assignment> {
        let own = |step| {
            let tile = self.take(processor, step)?;
            let shared = false;
            Some(Assignment { tile, shared })
        };
        match self.policy {
            Policy::Prescheduled => own(1),
            Policy::Static => own(self.queues.len()),
            Policy::Dynamic => self.draw().map(shared),
            Policy::CostOrdered => {
                let place = self.draw()?;
                let tile = self.order.get(place).map_or(place, |&tile| tile as usize);
                Some(shared(tile))
            }
            Policy::Guided => own(1).or_else(|| self.share(processor).map(shared)),
            Policy::WorkStealing => own(1).or_else(|| self.steal(processor).map(shared)),
        }
    }

    /// Take the first tile that a processor has in queue, and go on by `step`.
    fn take(&self, processor: usize, step: usize) -> Option<usize> {
        let queue = self.queues.get(processor)?;
        let rest = queue.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |held| {
            let (first, end) = tiles_of(held);
            (first < end).then(|| pack((first + step).min(end), end))
        });
        rest.ok().map(|held| tiles_of(held).0)
    }

    /// Take the next tile off the pile.
    fn draw(&self) -> Option<usize> {
        let tile = self.next.fetch_add(1, Ordering::Relaxed);
        (tile < self.tiles).then_some(tile)
    }

    /// Take one share off the pile; all but its first tile go into the processor's queue.
    fn share(&self, processor: usize) -> Option<usize> {
        let after = |first: usize| first + (self.tiles - first).div_ceil(self.queues.len());
        let first = self
            .next
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, |first| {
                (first < self.tiles).then(|| after(first))
            })
            .ok()?;
        self.queues[processor].store(pack(first + 1, after(first)), Ordering::Relaxed);
        Some(first)
    }

    /// Take the second half of the largest queue; all but its first tile go into the processor's own.
    fn steal(&self, processor: usize) -> Option<usize> {
        // Hands only shrink but for what was stolen, so nobody has to look through all of them again.
        if self.nothing_left.load(Ordering::Relaxed) {
            return None;
        }
        loop {
            // Among equally large queues the first.
            let victims = self.queues.iter().rev();
            let victim = victims.max_by_key(|queue| left(queue.load(Ordering::Relaxed)))?;
            let held = victim.load(Ordering::Relaxed);
            if left(held) == 0 {
                let nothing = |queue: &AtomicU64| left(queue.load(Ordering::Relaxed)) == 0;
                if self.queues.iter().all(nothing) {
                    self.nothing_left.store(true, Ordering::Relaxed);
                    return None;
                }
                continue;
            }
            let (first, end) = tiles_of(held);
            let middle = first + (end - first) / 2;
            // No tile is dealt twice, so a queue never holds again what it once held.
            let (whole, half) = (held, pack(first, middle));
            let taken = victim.compare_exchange(whole, half, Ordering::Relaxed, Ordering::Relaxed);
            if taken.is_ok() {
                self.queues[processor].store(pack(middle + 1, end), Ordering::Relaxed);
                return Some(middle);
            }
        }
    }
}

fn shared(tile: usize) -> Assignment {
    let shared = true;
    Assignment { tile, shared }
}

/// The tiles from `first` up to `end` in one word.
fn pack(first: usize, end: usize) -> u64 {
    (end as u64) << 32 | first as u64 & 0xffff_ffff
}

fn tiles_of(queue: u64) -> (usize, usize) {
    ((queue & 0xffff_ffff) as usize, (queue >> 32) as usize)
}

fn left(queue: u64) -> usize {
    let (first, end) = tiles_of(queue);
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
    fn in_turns(policy: Policy, tiles: usize, processors: usize, order: &[u32]) -> Vec<Vec<usize>> {
        let processors = NonZeroUsize::new(processors).unwrap();
        let scheduler = Scheduler::new(policy, tiles, processors, order.to_vec());
        let mut queues = vec![Vec::new(); scheduler.processors()];
        loop {
            let mut assigned = false;
            for (processor, queue) in queues.iter_mut().enumerate() {
                if let Some(next) = scheduler.next(processor) {
                    queue.push(next.tile);
                    assigned = true;
                }
            }
            if !assigned {
                return queues;
            }
        }
    }

    #[test]
    fn every_tile_is_assigned_exactly_once() {
        for policy in Policy::VARIANTS {
            for (tiles, processors) in [(0, 1), (0, 4), (1, 4), (7, 3), (64, 1), (1000, 5)] {
                let mut all = in_turns(*policy, tiles, processors, &[]).concat();
                all.sort_unstable();
                let expected: Vec<_> = (0..tiles).collect();
                assert_eq!(all, expected, "{policy:?} {tiles} {processors}");
            }
        }
    }

    #[test]
    fn what_is_assigned_beforehand_is_as_the_thesis_has_it() {
        let round_robin = [vec![0, 3, 6], vec![1, 4], vec![2, 5]];
        assert_eq!(in_turns(Policy::Static, 7, 3, &[]), round_robin);
        let blocks = [vec![0, 1, 2], vec![3, 4], vec![5, 6]];
        assert_eq!(in_turns(Policy::Prescheduled, 7, 3, &[]), blocks);
    }

    #[test]
    fn guided_shares_shrink() {
        // Of 10 left: 5, of 5: 3, of 2: 1, of 1: 1.
        let scheduler = Scheduler::new(
            Policy::Guided,
            10,
            NonZeroUsize::new(2).unwrap(),
            Vec::new(),
        );
        let shared = |processor, tile| {
            let expected = Some(Assignment { tile, shared: true });
            assert_eq!(scheduler.next(processor), expected);
        };
        shared(0, 0);
        shared(1, 5);
        for tile in 1..5 {
            let expected = Some(Assignment {
                tile,
                shared: false,
            });
            assert_eq!(scheduler.next(0), expected);
        }
        shared(0, 8);
        shared(0, 9);
        assert_eq!(scheduler.next(0), None);
        assert_eq!(scheduler.next(1).map(|next| next.tile), Some(6));
    }

    #[test]
    fn the_most_expensive_tile_comes_first() {
        let assigned = in_turns(Policy::CostOrdered, 4, 2, &[2, 0, 3, 1]);
        assert_eq!(assigned, [vec![2, 3], vec![0, 1]]);
    }

    #[test]
    fn every_tile_for_others_than_the_first_is_a_message() {
        for policy in Policy::VARIANTS {
            let two = const { NonZeroUsize::new(2).unwrap() };
            let scheduler = Scheduler::new(*policy, 8, two, Vec::new()).in_messages();
            for processor in [0, 1, 1, 0] {
                let assigned = scheduler.next(processor).unwrap();
                assert_eq!(assigned.shared, processor == 1, "{policy:?}");
            }
        }
    }

    #[test]
    fn half_of_the_largest_queue_is_stolen() {
        let scheduler = Scheduler::new(
            Policy::WorkStealing,
            12,
            NonZeroUsize::new(3).unwrap(),
            Vec::new(),
        );
        let next = |processor| {
            scheduler
                .next(processor)
                .map(|next| (next.tile, next.shared))
        };
        for tile in 0..4 {
            assert_eq!(next(0), Some((tile, false)));
        }
        assert_eq!(next(1), Some((4, false)));
        // Three are left to the second, four to the third: 10 and 11 are taken.
        assert_eq!(next(0), Some((10, true)));
        assert_eq!(next(0), Some((11, false)));
        assert_eq!(next(0), Some((6, true)));
    }
}
