//! Dealing packets of work to threads, in the three ways of the thesis (chapter 5).

use crate::error::Error;
use crate::interrupt::Interrupt;
use clap::ValueEnum;
use serde::Serialize;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Which thread gets which packet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Schedule {
    /// The next packet goes to the next idle thread.
    #[default]
    Dynamic,
    /// Packets are dealt round-robin beforehand.
    Static,
    /// Each thread has one block of neighbouring packets.
    Prescheduled,
}

impl Schedule {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dynamic => "dynamic",
            Self::Static => "static",
            Self::Prescheduled => "prescheduled",
        }
    }
}

/// What one thread did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finished<S> {
    /// The state it built up.
    pub state: S,
    /// How many packets it worked on.
    pub packets: usize,
    /// From the start of its first packet to the end of its last one.
    pub busy: Duration,
}

/// Work on packets 0 to `packets` − 1, each exactly once, on `threads` threads (never more than packets).
///
/// Every thread has a state of its own, made by `start` on that thread from the thread's number; `work` gets
/// it with each packet, and it is handed back in the order of the threads. `done` is called after each packet,
/// on whichever thread.
///
/// # Errors
/// [`Error::Interrupted`] if `interrupt` was requested before the last packet was begun, [`Error::Failed`]
/// when the system gives no more threads; some packets are then not done.
pub fn run_packets<S: Send>(
    packets: usize,
    threads: NonZeroUsize,
    schedule: Schedule,
    interrupt: &Interrupt,
    start: impl Fn(usize) -> S + Sync,
    work: impl Fn(&mut S, usize) + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<Finished<S>>, Error> {
    let threads = threads.get().min(packets.max(1));
    let deal = Deal {
        packets,
        threads,
        schedule,
        next: AtomicUsize::new(0),
    };
    // Stops the threads already running when another one cannot be started.
    let abandoned = Interrupt::new();
    let run = |thread: usize| {
        let mut state = start(thread);
        let mut hand = deal.first(thread);
        let mut packets = 0;
        let begin = Instant::now();
        while let Some(packet) = deal.next(&mut hand) {
            if abandoned.requested() {
                break;
            }
            interrupt.check()?;
            work(&mut state, packet);
            packets += 1;
            done();
        }
        Ok(Finished {
            state,
            packets,
            busy: begin.elapsed(),
        })
    };
    if threads == 1 {
        return run(0).map(|finished| vec![finished]);
    }
    thread::scope(|scope| {
        let run = &run;
        let mut handles = Vec::with_capacity(threads);
        for thread in 0..threads {
            match thread::Builder::new().spawn_scoped(scope, move || run(thread)) {
                Ok(handle) => handles.push(handle),
                Err(cause) => {
                    abandoned.request();
                    return Err(Error::Failed(format!(
                        "cannot start thread {} of {threads}: {cause}",
                        thread + 1
                    )));
                }
            }
        }
        handles
            .into_iter()
            .map(|handle| match handle.join() {
                Ok(finished) => finished,
                Err(panic) => std::panic::resume_unwind(panic),
            })
            .collect()
    })
}

/// The packets, and how they are dealt.
struct Deal {
    packets: usize,
    threads: usize,
    schedule: Schedule,
    /// The next packet of the dynamic schedule.
    next: AtomicUsize,
}

/// The packets that are a thread's own: every `step`-th of a range; unused by the dynamic schedule.
struct Hand {
    left: Range<usize>,
    step: usize,
}

impl Deal {
    fn first(&self, thread: usize) -> Hand {
        match self.schedule {
            Schedule::Dynamic => Hand {
                left: 0..0,
                step: 1,
            },
            Schedule::Static => Hand {
                left: thread..self.packets,
                step: self.threads,
            },
            Schedule::Prescheduled => Hand {
                left: self.block(thread)..self.block(thread + 1),
                step: 1,
            },
        }
    }

    /// Where the block of `thread` begins: the blocks' sizes differ by one at most, the larger ones first.
    fn block(&self, thread: usize) -> usize {
        let (size, larger) = (self.packets / self.threads, self.packets % self.threads);
        thread * size + thread.min(larger)
    }

    fn next(&self, hand: &mut Hand) -> Option<usize> {
        if self.schedule == Schedule::Dynamic {
            let packet = self.next.fetch_add(1, Ordering::Relaxed);
            return (packet < self.packets).then_some(packet);
        }
        let packet = hand.left.start;
        let some = !hand.left.is_empty();
        hand.left.start = packet.saturating_add(hand.step);
        some.then_some(packet)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deal(packets: usize, threads: usize, schedule: Schedule) -> Vec<Vec<usize>> {
        run_packets(
            packets,
            NonZeroUsize::new(threads).unwrap(),
            schedule,
            &Interrupt::new(),
            |_| Vec::new(),
            Vec::push,
            || {},
        )
        .unwrap()
        .into_iter()
        .inspect(|finished| assert_eq!(finished.packets, finished.state.len()))
        .map(|finished| finished.state)
        .collect()
    }

    #[test]
    fn every_packet_is_worked_on_exactly_once() {
        for schedule in Schedule::value_variants() {
            for (packets, threads) in [(0, 1), (0, 4), (1, 4), (7, 3), (64, 1), (1000, 5)] {
                let mut all = deal(packets, threads, *schedule).concat();
                all.sort_unstable();
                let expected: Vec<_> = (0..packets).collect();
                assert_eq!(all, expected, "{schedule:?} {packets} {threads}");
            }
        }
    }

    #[test]
    fn static_deals_round_robin_and_prescheduled_in_blocks() {
        let round_robin = [vec![0, 3, 6], vec![1, 4], vec![2, 5]];
        assert_eq!(deal(7, 3, Schedule::Static), round_robin);
        let blocks = [vec![0, 1, 2], vec![3, 4], vec![5, 6]];
        assert_eq!(deal(7, 3, Schedule::Prescheduled), blocks);
    }

    #[test]
    fn an_idle_thread_takes_the_rest_from_a_busy_one() {
        let others = AtomicUsize::new(0);
        let finished = run_packets(
            40,
            NonZeroUsize::new(2).unwrap(),
            Schedule::Dynamic,
            &Interrupt::new(),
            |_| (),
            |(), packet| {
                // The first packet lasts until all others are done.
                while packet == 0 && others.load(Ordering::Relaxed) < 39 {
                    thread::yield_now();
                }
                others.fetch_add(usize::from(packet > 0), Ordering::Relaxed);
            },
            || {},
        )
        .unwrap();
        let mut packets: Vec<_> = finished.iter().map(|thread| thread.packets).collect();
        packets.sort_unstable();
        assert_eq!(packets, [1, 39]);
    }

    #[test]
    fn an_interrupt_ends_the_work_before_the_next_packet() {
        for schedule in Schedule::value_variants() {
            for threads in [1, 3] {
                let (interrupt, count) = (Interrupt::new(), AtomicUsize::new(0));
                let result = run_packets(
                    1000,
                    NonZeroUsize::new(threads).unwrap(),
                    *schedule,
                    &interrupt,
                    |_| (),
                    |(), _| interrupt.request(),
                    || {
                        count.fetch_add(1, Ordering::Relaxed);
                    },
                );
                assert!(matches!(result, Err(Error::Interrupted)));
                assert!(count.into_inner() <= threads);
            }
        }
    }
}
