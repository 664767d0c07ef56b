//! Counting rays with an eye on the request to stop.

use crate::interrupt::Interrupt;
use crate::pixel_trace::Recorder;
use octray_core::accel::Hit;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::observe::{Counters, Observer, RayKind, RayObserver};
use octray_core::quantize::Quantize;
use octray_core::trace::QueuedRay;
use octray_core::vec3::Vec3;

/// After so many rays the request is looked for. Looking takes a memory access that other threads may share; a ray takes
/// about a thousand instructions, so this is every few milliseconds.
const PERIOD: u32 = 1024;

/// What one thread counted, and when it looks for a request to stop.
pub(crate) struct Watch {
    pub(crate) counters: Counters,
    /// What rays meet is recorded here, if it is wanted.
    pub(crate) recorder: Option<Box<Recorder>>,
    interrupt: Interrupt,
    /// Rays until the next look.
    left: u32,
    /// Rays that were taken off the budget.
    spent: u64,
}

impl Watch {
    pub(crate) fn new(interrupt: &Interrupt) -> Self {
        Self {
            counters: Counters::default(),
            recorder: None,
            interrupt: interrupt.clone(),
            left: PERIOD,
            spent: 0,
        }
    }

    /// Takes the rays counted so far off the budget, without shadow rays. Whether to stop.
    #[cold]
    #[inline(never)]
    fn look(&mut self) -> bool {
        let all = self.counters.all_rays() - self.counters.rays_of(RayKind::Shadow);
        let stop = self.interrupt.spend(all - self.spent);
        self.spent = all;
        self.left = if stop { 0 } else { PERIOD };
        stop
    }
}

/// The last rays are taken off the budget too.
impl Drop for Watch {
    fn drop(&mut self) {
        self.look();
    }
}

impl Observer for Watch {
    #[inline(always)]
    fn ray(&mut self, kind: RayKind) {
        self.counters.ray(kind);
    }
    #[inline(always)]
    fn blocked(&mut self) {
        self.counters.blocked();
    }
    #[inline(always)]
    fn hit(&mut self, kind: RayKind) {
        self.counters.hit(kind);
    }
    #[inline(always)]
    fn step(&mut self, children: usize) {
        self.counters.step(children);
    }
    #[inline(always)]
    fn voxel(&mut self) {
        self.counters.voxel();
    }
    #[inline(always)]
    fn test(&mut self, kind: ObjectKind, met: bool) {
        self.counters.test(kind, met);
    }
    #[inline(always)]
    fn edges(&mut self, count: usize) {
        self.counters.edges(count);
    }
    #[inline(always)]
    fn side(&mut self) {
        self.counters.side();
    }
    #[inline(always)]
    fn queued(&mut self, count: usize) {
        self.counters.queued(count);
    }
    #[inline(always)]
    fn dropped_ray(&mut self) {
        self.counters.dropped_ray();
    }
    #[inline(always)]
    fn dropped_child(&mut self) {
        self.counters.dropped_child();
    }
    #[inline(always)]
    fn uncached_light(&mut self) {
        self.counters.uncached_light();
    }
    #[inline(always)]
    fn stopped(&mut self) -> bool {
        match self.left.checked_sub(1) {
            Some(left) => {
                self.left = left;
                false
            }
            None => self.look(),
        }
    }
}

/// Whether to record is asked a few times for a ray, not in the searches.
impl<S: Quantize> RayObserver<S> for Watch {
    #[inline(always)]
    fn begins(&mut self, ray: &QueuedRay<S>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.begin(&self.counters, ray);
        }
    }
    #[inline(always)]
    fn meets(&mut self, hit: Hit<S>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.meet(&self.counters, hit);
        }
    }
    #[inline(always)]
    fn looked_for_light(&mut self, light: usize, blocker: Option<ObjectRef>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.light(&self.counters, light, blocker);
        }
    }
    #[inline(always)]
    fn not_followed(&mut self, kind: RayKind, weight: Option<S>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.not_followed(kind, weight.map(S::to_f64));
        }
    }
    #[inline(always)]
    fn brings(&mut self, light: Vec3<S>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.brings(&self.counters, light);
        }
    }
}
