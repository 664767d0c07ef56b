//! The memory that tracing takes, and how much of it.

use crate::features::{self, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::RayKind;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;
use core::fmt::{self, Display, Formatter};

/// A ray that waits to be traced.
#[derive(Clone, Copy, Debug)]
pub struct QueuedRay<S> {
    /// The ray.
    pub ray: Ray<S>,
    /// The share of its light that reaches the picture.
    pub weight: S,
    /// How often it has bounced: 0 for a ray of the camera.
    pub depth: u32,
    /// Why it is traced.
    pub kind: RayKind,
}

impl<S: Scalar> QueuedRay<S> {
    /// Fills an unused place.
    pub const EMPTY: Self = Self {
        ray: Ray::new(Vec3::ZERO, Vec3::ZERO),
        weight: S::ZERO,
        depth: 0,
        kind: RayKind::Primary,
    };
}

/// The memory one thread traces with, lent and kept from ray to ray.
///
/// [`Tracer::workspace`](super::Tracer::workspace) makes one and refuses what is too small. Where a tighter bound is known, the
/// fields can be filled in without a check; what finds no room then is reported to the observer
/// ([`Observer::dropped_ray`](crate::observe::Observer::dropped_ray),
/// [`Observer::uncached_light`](crate::observe::Observer::uncached_light)).
#[derive(Debug)]
pub struct Workspace<'a, S, K> {
    /// Room for the rays that wait; [`required_rays`] of them always do.
    pub rays: &'a mut [QueuedRay<S>],
    /// Room for the tree's walk, [`Accelerator::Stack`](crate::accel::Accelerator::Stack).
    pub stack: &'a mut K,
    /// What blocked each light last (Haines and Greenberg, "The Light Buffer: A Shadow-Testing
    /// Accelerator", 1986). With fewer places than lights the picture is the
    /// same, only slower.
    pub shadow_cache: &'a mut [Option<ObjectRef>],
}

/// How many rays can wait at once, whatever the scene, if rays bounce at most `max_depth` times: the
/// room that [`Workspace::rays`] needs.
///
/// A surface that only reflects, or only transmits, leaves one ray, which is taken up at once; one
/// that does both leaves one more at each bounce.
pub const fn required_rays(max_depth: u32, features: FeatureSet) -> usize {
    let reflects = features::contains(features, features::REFLECTION);
    let refracts = features::contains(features, features::REFRACTION);
    match (max_depth, reflects, refracts) {
        (0, ..) | (_, false, false) => 0,
        (_, true, true) => max_depth as usize + 1,
        _ => 1,
    }
}

/// Memory that is too small to trace with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WorkspaceTooSmall {
    /// The rays that can wait.
    pub rays: usize,
    /// The lights that there are.
    pub lights: usize,
}

impl Display for WorkspaceTooSmall {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { rays, lights } = self;
        write!(f, "tracing takes room for {rays} rays and {lights} lights")
    }
}

impl core::error::Error for WorkspaceTooSmall {}

impl<S, K> Workspace<'_, S, K> {
    /// Clears the shadow cache, so that what is counted does not depend on what was traced before.
    pub(crate) fn clear_shadow_cache(&mut self) {
        self.shadow_cache.fill(None);
    }
}
