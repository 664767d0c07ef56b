//! No tree: every object is tested. The oracle for the trees, and the cheapest for a handful.

use super::query::Query;
use super::{Accelerator, Hit};
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::Scene;

/// A plain list of objects, none of them marked but possibly the last.
#[derive(Clone, Copy, Debug)]
pub struct BruteForce<'a>(pub &'a [ObjectRef]);

impl<S: Scalar, const FEATURES: FeatureSet> Accelerator<S, FEATURES> for BruteForce<'_> {
    type Stack = ();

    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        (): &mut (),
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut query = Query::<_, _, false, FEATURES>::new(scene, ray, scene.diameter, observer);
        query.test_list(self.0);
        query.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S, FEATURES>,
        ray: &Ray<S>,
        limit: S,
        (): &mut (),
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut query = Query::<_, _, true, FEATURES>::new(scene, ray, limit, observer);
        query.test_list(self.0);
        query.found
    }
}
