//! Counts dropped rays. The capacity for rays may come from a plan, which measured it without a proof.

use crate::baked::{FEATURES, MAX_DEPTH, RAYS};
use core::sync::atomic::{AtomicU32, Ordering};
use octray_core::observe::{Observer, RayObserver};
use octray_core::trace::required_rays;

/// Whether the capacity provably suffices; then the compiler removes everything here.
const PROVED: bool = RAYS >= required_rays(MAX_DEPTH, FEATURES);

static DROPPED: AtomicU32 = AtomicU32::new(0);

/// Counts dropped rays. It has no field, so that tracing compiles to the same instructions as with `()`.
pub(super) struct DropCounter;

impl<S> RayObserver<S> for DropCounter {}

impl Observer for DropCounter {
    #[inline(always)]
    fn dropped_ray(&mut self) {
        if !PROVED {
            increment();
        }
    }
}

#[cold]
#[inline(never)]
fn increment() {
    // The smallest cores have no atomic addition; there is only one thread.
    DROPPED.store(
        DROPPED.load(Ordering::Relaxed).wrapping_add(1),
        Ordering::Relaxed,
    );
}

/// Returns the number of dropped rays.
pub(super) fn total() -> u32 {
    if PROVED {
        0
    } else {
        DROPPED.load(Ordering::Relaxed)
    }
}
