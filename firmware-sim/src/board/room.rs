//! Whether rays found room. The room for rays may be what a plan found out, which nothing proves.

use crate::baked::{FEATURES, MAX_DEPTH, RAYS};
use core::sync::atomic::{AtomicU32, Ordering};
use octray_core::observe::Observer;
use octray_core::trace::required_rays;

/// There is room for all rays that can ever wait: then nothing of this is in the machine code.
const PROVED: bool = RAYS >= required_rays(MAX_DEPTH, FEATURES);

static DROPPED: AtomicU32 = AtomicU32::new(0);

/// Counts the rays that find no room. Without a field, so that tracing is the same instructions as with `()`.
pub(super) struct Observed;

impl Observer for Observed {
    #[inline(always)]
    fn dropped_ray(&mut self) {
        if !PROVED {
            count();
        }
    }
}

#[cold]
#[inline(never)]
fn count() {
    // The least cores have no atomic addition, and there is one thread.
    DROPPED.store(
        DROPPED.load(Ordering::Relaxed).wrapping_add(1),
        Ordering::Relaxed,
    );
}

/// How many rays found no room.
pub(super) fn dropped() -> u32 {
    if PROVED {
        0
    } else {
        DROPPED.load(Ordering::Relaxed)
    }
}
