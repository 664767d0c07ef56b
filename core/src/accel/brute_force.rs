//! No tree: every object is tested. The oracle for the trees, and the cheapest for a handful.

use super::query::{Query, accelerate};
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::observe::Observer;
use crate::scalar::Tolerance;

/// A plain list of objects, none of them marked but possibly the last.
///
/// [`Scene`](crate::scene::Scene) has an example.
#[derive(Clone, Copy, Debug)]
pub struct BruteForce<'a>(pub &'a [ObjectRef]);

impl BruteForce<'_> {
    #[inline(always)]
    fn walk<S: Tolerance, O: Observer, const ANY: bool, const FEATURES: FeatureSet>(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
        (): &mut (),
    ) {
        query.test_list::<true>(self.0);
    }
}

accelerate!([] BruteForce<'_>, stack: (), scalar: Tolerance);
