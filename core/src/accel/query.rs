//! A query of an accelerator: a ray, and the best hit so far.

use super::accelerator::Hit;
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::ray::Ray;
use crate::scalar::{Scalar, Tolerance};
use crate::scene::{Light, Scene};

/// A query for the first object a ray meets, or with `ANY` for any object nearer than the limit.
pub(super) struct Query<'a, S: Scalar, O, const ANY: bool, const FEATURES: FeatureSet> {
    pub(super) scene: &'a Scene<'a, S, FEATURES>,
    pub(super) ray: &'a Ray<S>,
    /// Nothing beyond this distance matters any more.
    pub(super) limit: S,
    /// What the ray goes to.
    pub(super) light: Option<&'a Light<S>>,
    pub(super) found: Option<ObjectRef>,
    pub(super) observer: &'a mut O,
}

impl<'a, S: Tolerance, O: Observer, const ANY: bool, const FEATURES: FeatureSet>
    Query<'a, S, O, ANY, FEATURES>
{
    #[inline(always)]
    pub(super) fn new(
        scene: &'a Scene<'a, S, FEATURES>,
        ray: &'a Ray<S>,
        limit: S,
        light: Option<&'a Light<S>>,
        observer: &'a mut O,
    ) -> Self {
        Self {
            scene,
            ray,
            limit,
            light,
            found: None,
            observer,
        }
    }

    /// Tests the objects of a list up to the marked one. True if the query is over. `INLINE`: see [`Shapes::meets`].
    ///
    /// [`Shapes::meets`]: crate::shape::Shapes::meets
    #[inline(always)]
    pub(super) fn test_list<const INLINE: bool>(&mut self, links: &[ObjectRef]) -> bool {
        for &object in links {
            let light = self.light.filter(|_| ANY);
            let shapes = &self.scene.shapes;
            let hit = shapes.meets::<INLINE, O>(object, self.ray, self.limit, light, self.observer);
            if let Some(t) = hit {
                if ANY {
                    self.found = Some(object);
                    return true;
                }
                let first = |found| precedes(self.scene, object, found);
                if t < self.limit || self.found.is_none_or(first) {
                    self.limit = t;
                    self.found = Some(object);
                }
            }
            if object.is_last() {
                break;
            }
        }
        false
    }

    #[inline(always)]
    pub(super) fn hit(self) -> Option<Hit<S>> {
        self.found.map(|object| Hit {
            t: self.limit,
            object,
        })
    }
}

/// Whether an object at the same distance as the one found comes before it in the scene file.
#[cold]
#[inline(never)]
fn precedes<S: Scalar, const FEATURES: FeatureSet>(
    scene: &Scene<'_, S, FEATURES>,
    object: ObjectRef,
    found: ObjectRef,
) -> bool {
    let id = |object| scene.attributes_of(object).id;
    id(object) < id(found)
}

/// Implements [`Accelerator`](super::Accelerator) by a type's method `walk`, which takes a query and
/// a stack.
///
/// The walk is not inlined into the tracer, which would not fit the code cache then.
macro_rules! accelerate {
    ([$($generics:tt)*] $accelerator:ty, stack: $stack:ty, scalar: $scalar:ident) => {
        impl<S: $scalar, const FEATURES: $crate::features::FeatureSet $($generics)*>
            $crate::accel::accelerator::Accelerator<S, FEATURES> for $accelerator
        {
            type Stack = $stack;

            #[inline(never)]
            fn nearest<O: $crate::observe::Observer>(
                &self,
                scene: &$crate::scene::Scene<'_, S, FEATURES>,
                ray: &$crate::ray::Ray<S>,
                stack: &mut $stack,
                observer: &mut O,
            ) -> Option<$crate::accel::accelerator::Hit<S>> {
                let mut query = $crate::accel::query::Query::<_, _, false, FEATURES>::new(
                    scene,
                    ray,
                    scene.diameter,
                    None,
                    observer,
                );
                self.walk(&mut query, stack);
                query.hit()
            }

            #[inline(never)]
            fn any_hit<O: $crate::observe::Observer>(
                &self,
                scene: &$crate::scene::Scene<'_, S, FEATURES>,
                ray: &$crate::ray::Ray<S>,
                limit: S,
                light: Option<&$crate::scene::Light<S>>,
                stack: &mut $stack,
                observer: &mut O,
            ) -> Option<$crate::object::ObjectRef> {
                let mut query =
                    $crate::accel::query::Query::<_, _, true, FEATURES>::new(scene, ray, limit, light, observer);
                self.walk(&mut query, stack);
                query.found
            }
        }
    };
}

pub(super) use accelerate;
