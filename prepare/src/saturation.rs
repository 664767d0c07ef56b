//! How often fixed point saturates, counted for each thread apart.
//!
//! Core has no statics. This is the counter of programs with an operating system: whoever traces takes the
//! difference of [`saturations`] on the thread that traced, so that two renderings in one process are told apart.

use octray_core::scalar::SaturationCounter;
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// The counter of formats that are traced, or prepared, here: each saturation counts for its thread.
#[derive(Clone, Copy, Debug)]
pub struct PerThread;

impl SaturationCounter for PerThread {
    const CHECKED: bool = true;

    #[cold]
    fn saturated() {
        COUNT.set(COUNT.get() + 1);
    }
}

/// How many results have saturated on this thread since it began.
pub fn saturations() -> u64 {
    COUNT.get()
}

/// What `work` gives, and how many saturations it took.
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
    fn what_counts_nothing_costs_no_memory() {
        assert_eq!(size_of::<Fixed<16, PerThread>>(), size_of::<Fixed<16>>());
        assert_eq!(size_of::<Fixed<16>>(), 4);
    }
}
