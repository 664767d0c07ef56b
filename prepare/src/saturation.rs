//! Counts saturations of fixed point, separately for each thread.
//!
//! Core has no statics; this is the counter for programs with an operating system. A caller takes the difference of
//! [`saturations`] on the thread that traces, so that two renderings in one process are counted separately.

use octray_core::scalar::SaturationCounter;
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// The saturation counter of formats on a host: each saturation is counted for its thread.
#[derive(Clone, Copy, Debug)]
pub struct PerThread;

impl SaturationCounter for PerThread {
    const CHECKED: bool = true;

    #[cold]
    fn saturated() {
        COUNT.set(COUNT.get() + 1);
    }
}

/// Returns the number of saturations on this thread since it started.
pub fn saturations() -> u64 {
    COUNT.get()
}

/// Returns the result of `work` and the number of its saturations.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = saturations();
    let result = work();
    (result, saturations() - before)
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_core::quantize::Quantize;
    use octray_core::scalar::{Fixed, Fixed64};

    #[test]
    fn saturations_are_those_of_the_thread() {
        let large = Fixed::<16, PerThread>::from_f64(30_000.0);
        assert_eq!(counted(|| large - large).1, 0);
        let (sum, count) = counted(|| {
            let elsewhere = std::thread::spawn(move || counted(|| large + large + large).1);
            assert_eq!(elsewhere.join().unwrap(), 2);
            large + large
        });
        assert_eq!((sum.to_bits(), count), (i32::MAX, 1));
    }

    #[test]
    fn the_long_format_is_counted_too() {
        let large = Fixed64::<PerThread>::from_f64(2e9);
        assert_eq!(counted(|| large + large).1, 1);
    }

    #[test]
    fn a_format_without_a_counter_needs_no_more_memory() {
        assert_eq!(size_of::<Fixed<16, PerThread>>(), size_of::<Fixed<16>>());
        assert_eq!(size_of::<Fixed<16>>(), 4);
    }
}
