//! Threads that work on the tiles they are assigned.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::scheduler::{Assignment, Scheduler};
use std::thread;
use std::time::{Duration, Instant};

/// What one thread did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finished<S> {
    /// The state it built up.
    pub state: S,
    /// How many tiles it worked on.
    pub tiles: usize,
    /// When it was ready for its first tile, counted from the start of all threads.
    pub begun: Duration,
    /// When it had done its last tile.
    pub ended: Duration,
}

/// For how long each thread had nothing to work on, until the last one had done its last tile.
pub fn idle<S>(finished: &[Finished<S>]) -> impl Iterator<Item = Duration> {
    let end = finished.iter().map(|thread| thread.ended).max();
    finished
        .iter()
        .map(move |thread| end.unwrap_or_default() - (thread.ended - thread.begun))
}

/// Works on the tiles of a scheduler, each exactly once, on as many threads as it has processors; the calling
/// thread is the first of them.
///
/// Every thread has a state of its own, made by `start` on that thread from the thread's number; `work` gets
/// it with each tile, and it is handed back in the order of the threads. `done` is called after each tile,
/// on whichever thread.
///
/// # Errors
/// [`Error::Interrupted`] if `interrupt` was requested before the last tile was done, [`Error::TooManyRays`] if its
/// budget was spent, [`Error::Failed`] when the system gives no more threads, or what `start` fails with; some tiles are then not done.
pub fn run_tiles<S: Send>(
    scheduler: &Scheduler,
    interrupt: &Interrupt,
    start: impl Fn(usize) -> Result<S, Error> + Sync,
    work: impl Fn(&mut S, usize) + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<Finished<S>>, Error> {
    let threads = scheduler.processors();
    // Stops the threads that run when another one cannot start.
    let abandoned = Interrupt::new();
    let begin = Instant::now();
    let run = |thread: usize| {
        let mut state = start(thread).inspect_err(|_| abandoned.request())?;
        let mut tiles = 0;
        let begun = begin.elapsed();
        while let Some(Assignment { tile, .. }) = scheduler.next(thread) {
            if abandoned.requested() {
                break;
            }
            interrupt.check()?;
            work(&mut state, tile);
            interrupt.check()?;
            tiles += 1;
            done();
        }
        Ok(Finished {
            state,
            tiles,
            begun,
            ended: begin.elapsed(),
        })
    };
    thread::scope(|scope| {
        let run = &run;
        let mut handles = Vec::with_capacity(threads);
        for thread in 1..threads {
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
        let first = run(0);
        let others = handles.into_iter().map(|handle| match handle.join() {
            Ok(finished) => finished,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        std::iter::once(first).chain(others).collect()
    })
}

/// Keeps the calling thread on the core for the `thread`-th thread; cores are gone round.
///
/// # Errors
/// [`Error::Failed`] if the system does not let us.
pub fn pin(thread: usize) -> Result<(), Error> {
    let cores = core_affinity::get_core_ids().unwrap_or_default();
    let pinned = match cores.is_empty() {
        true => false,
        false => core_affinity::set_for_current(cores[thread % cores.len()]),
    };
    match pinned {
        true => Ok(()),
        false => Err(Error::Failed("this system does not pin threads".into())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheduler::Policy;
    use std::num::NonZeroUsize;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use strum::VariantArray;

    fn scheduler(policy: Policy, tiles: usize, threads: usize) -> Scheduler {
        Scheduler::new(policy, tiles, NonZeroUsize::new(threads).unwrap(), vec![])
    }

    #[test]
    fn every_tile_is_worked_on_exactly_once() {
        for policy in Policy::VARIANTS {
            for (tiles, threads) in [(0, 1), (0, 4), (1, 4), (7, 3), (64, 1), (5000, 5)] {
                let finished = run_tiles(
                    &scheduler(*policy, tiles, threads),
                    &Interrupt::new(),
                    |_| Ok(Vec::new()),
                    Vec::push,
                    || {},
                )
                .unwrap();
                assert_eq!(finished.len(), threads);
                let mut all = Vec::new();
                for thread in finished {
                    assert_eq!(thread.tiles, thread.state.len());
                    all.extend(thread.state);
                }
                all.sort_unstable();
                let expected: Vec<_> = (0..tiles).collect();
                assert_eq!(all, expected, "{policy:?} {tiles} {threads}");
            }
        }
    }

    #[test]
    fn an_idle_thread_takes_the_rest_from_a_busy_one() {
        for policy in [Policy::Dynamic, Policy::CostOrdered, Policy::WorkStealing] {
            let others = AtomicUsize::new(0);
            let finished = run_tiles(
                &scheduler(policy, 40, 2),
                &Interrupt::new(),
                |_| Ok(()),
                |(), tile| {
                    // The first tile lasts until all others are done.
                    while tile == 0 && others.load(Ordering::Relaxed) < 39 {
                        thread::yield_now();
                    }
                    others.fetch_add(usize::from(tile > 0), Ordering::Relaxed);
                },
                || {},
            )
            .unwrap();
            // That it came to an end shows that the others were not left to the busy thread.
            let tiles: usize = finished.iter().map(|thread| thread.tiles).sum();
            assert_eq!(tiles, 40, "{policy:?}");
        }
    }

    #[test]
    fn an_interrupt_ends_the_work_before_the_next_tile() {
        for policy in Policy::VARIANTS {
            for threads in [1, 3] {
                let (interrupt, count) = (Interrupt::new(), AtomicUsize::new(0));
                let result = run_tiles(
                    &scheduler(*policy, 1000, threads),
                    &interrupt,
                    |_| Ok(()),
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

    #[test]
    fn a_thread_that_cannot_start_ends_the_work() {
        let result = run_tiles(
            &scheduler(Policy::Dynamic, 1000, 3),
            &Interrupt::new(),
            |thread| match thread {
                1 => Err(Error::Failed("no second thread".into())),
                _ => Ok(()),
            },
            |(), _| {},
            || {},
        );
        assert_eq!(result.unwrap_err().to_string(), "no second thread");
    }

    #[test]
    fn a_thread_is_idle_before_its_first_tile_and_after_its_last() {
        let thread = |begun, ended| Finished {
            state: (),
            tiles: 1,
            begun: Duration::from_millis(begun),
            ended: Duration::from_millis(ended),
        };
        let finished = [thread(1, 9), thread(3, 11)];
        let idle: Vec<_> = idle(&finished).map(|idle| idle.as_millis()).collect();
        assert_eq!(idle, [3, 3]);
    }

    #[test]
    fn threads_are_pinned_to_cores_in_turn() {
        // On a thread of its own, since pinning lasts.
        let result = thread::spawn(|| (0..3).try_for_each(pin)).join().unwrap();
        assert!(!cfg!(target_os = "linux") || result.is_ok(), "{result:?}");
    }
}
