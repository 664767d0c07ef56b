//! No tree: every object is tested. The oracle for the trees, and the cheapest for a handful.

use super::search::Search;
use super::{Accelerator, Hit};
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::ObjectRef;

/// A plain list of objects, none of them marked but possibly the last.
#[derive(Clone, Copy, Debug)]
pub struct List<'a>(pub &'a [ObjectRef]);

impl<S: Scalar> Accelerator<S> for List<'_> {
    type Stack = ();

    #[inline(never)]
    fn nearest<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        (): &mut (),
        observer: &mut O,
    ) -> Option<Hit<S>> {
        let mut search = Search::<_, _, false>::new(scene, ray, scene.reach, observer);
        search.list(self.0);
        search.hit()
    }

    #[inline(never)]
    fn any_hit<O: Observer>(
        &self,
        scene: &Scene<'_, S>,
        ray: &Ray<S>,
        limit: S,
        (): &mut (),
        observer: &mut O,
    ) -> Option<ObjectRef> {
        let mut search = Search::<_, _, true>::new(scene, ray, limit, observer);
        search.list(self.0);
        search.found
    }
}
