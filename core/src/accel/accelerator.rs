//! The interface of all accelerators.

use crate::features::{ALL_FEATURES, FeatureSet};
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::{Light, Scene};

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<S> {
    /// At which distance from the ray's origin, in lengths of the scene.
    pub t: S,
    /// Which object.
    pub object: ObjectRef,
}

/// Finds what rays meet.
///
/// Every implementation returns exactly what [`BruteForce`](super::BruteForce) returns over all
/// objects, bit by bit.
pub trait Accelerator<S: Scalar, const FEATURES: FeatureSet = ALL_FEATURES>: Sync {
    /// The nodes that wait while it is walked. Lent, since clearing it for each ray would cost
    /// more than the walk.
    type Stack: Default + Send;

    /// The first object that the ray meets at 0 < t ≤ [`Scene::diameter`].
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<Hit<S>>;

    /// Any object that the ray meets at 0 < t ≤ `limit`. On the way to `light`, the surfaces that hold it do not
    /// count where the ray arrives there.
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        light: Option<&Light<S>>,
        stack: &mut Self::Stack,
        observer: &mut O,
    ) -> Option<ObjectRef>;
}
