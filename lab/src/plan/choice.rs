//! Which arithmetic and which tree: every candidate's cost is predicted, and the cheapest that fits is taken.

use super::accuracy::{Accuracy, Scope};
use super::events::{Events, Probe};
use super::job::Bounds;
use super::model::{Family, Model, Parts, Prediction, Weights};
use crate::measure::board::Board;
use octray_core::accel::{BuildOptions, COMPACT_MAX_DEPTH};
use octray_prepare::Format;
use octray_prepare::bake::{Baked, bake};
use octray_prepare::plan::Plan;
use octray_render::error::Error;

/// Objects up to which it is tried to do without a tree.
const FEW: usize = 64;

/// Leaf sizes that are tried.
const LEAVES: [u32; 5] = [1, 2, 3, 4, 8];

/// A plan that is accurate enough, and what it costs.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The plan.
    pub plan: Plan,
    /// What was counted.
    pub events: Events,
    /// What would be baked.
    pub baked: Baked,
    /// Nodes of the tree.
    pub nodes: u64,
    /// The scene is scaled by 2 to this power.
    pub scale: i32,
    /// What it costs.
    pub cost: Prediction,
}

impl Candidate {
    /// By how much of a bound this needs more, at the most; not positive if it fits.
    pub fn excess(&self, bounds: &Bounds) -> f64 {
        let over = |needs: u64, has: u64| needs as f64 / has.max(1) as f64 - 1.0;
        f64::max(
            over(self.cost.flash(), bounds.flash),
            over(self.cost.ram(), bounds.ram),
        )
    }

    /// Whether this fits.
    pub fn fits(&self, bounds: &Bounds) -> bool {
        self.cost.flash() <= bounds.flash && self.cost.ram() <= bounds.ram
    }
}

/// Predicts what plans cost on a board.
#[derive(Debug)]
pub struct Chooser<'a> {
    /// The scene and its picture.
    pub scope: &'a Scope<'a>,
    /// The board.
    pub board: &'a Board,
    /// What costs how much.
    pub model: &'a Model,
}

impl Chooser<'_> {
    /// All candidates: of each arithmetic that does, with trees of several leaf sizes and depths, and without.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; [`Error::Failed`] if the model does not know the board.
    pub fn candidates(&self, accuracy: &Accuracy) -> Result<Vec<Candidate>, Error> {
        let mut all = Vec::new();
        for tried in accuracy.narrowest() {
            let pixels_per_ray = accuracy.pixels_per_ray;
            let plan = self
                .scope
                .plan(tried.format, pixels_per_ray, accuracy.depth);
            self.trees(&plan, &mut all)?;
        }
        Ok(all)
    }

    fn trees(&self, plan: &Plan, all: &mut Vec<Candidate>) -> Result<(), Error> {
        let first = all.len();
        let packed = |depth, leaf_size| Plan {
            tree: Some(BuildOptions { depth, leaf_size }),
            ..plan.clone()
        };
        let objects = self.scope.scene.objects.len();
        if objects <= FEW {
            let tree = None;
            all.push(self.candidate(Plan {
                tree,
                ..plan.clone()
            })?);
        }
        for leaf_size in LEAVES
            .into_iter()
            .filter(|size| *size as usize <= objects.max(1))
        {
            all.push(self.candidate(packed(COMPACT_MAX_DEPTH, leaf_size))?);
        }
        // Shallower trees of the leaf size that is best.
        let best = cheapest(&all[first..]).map(|best| best.plan.tree);
        if let Some(Some(BuildOptions { depth, leaf_size })) = best {
            for depth in (1..depth).rev() {
                let shallow = self.candidate(packed(depth, leaf_size))?;
                let dear = cheapest(&all[first..])
                    .is_some_and(|best| shallow.cost.instructions > 1.2 * best.cost.instructions);
                all.push(shallow);
                if dear {
                    break;
                }
            }
        }
        Ok(())
    }

    /// A plan with its capacities as small as they can be, and what it costs.
    fn candidate(&self, mut plan: Plan) -> Result<Candidate, Error> {
        let probe: Probe = self.scope.render(&plan)?;
        plan.rays = probe.waiting;
        if let Some(options) = &mut plan.tree {
            options.depth = probe.depth;
        }
        let scene = self.scope.scene;
        let failed = Error::Failed;
        let options = (plan.options(scene, "")).map_err(|why| failed(why.to_string()))?;
        let baked = bake(scene, &options).map_err(|why| failed(why.to_string()))?;
        let lent = Parts::of(&plan, &baked, scene.lights.len());
        let weights = self.weights(plan.format)?;
        Ok(Candidate {
            cost: weights.predict(&probe.events, &baked, plan.tree, lent),
            events: probe.events,
            nodes: probe.nodes,
            scale: probe.scale,
            baked,
            plan,
        })
    }

    /// What things cost in a format.
    ///
    /// # Errors
    /// [`Error::Failed`] if that was not measured.
    pub fn weights(&self, format: Format) -> Result<&Weights, Error> {
        let (target, family) = (self.board.target, Family::of(format));
        self.model.of(target, family).ok_or_else(|| {
            let name = family.name();
            Error::Failed(format!("nothing is known of what {name} costs on {target}"))
        })
    }
}

/// The candidate of fewest instructions. What differs by less than half a percent costs the same: then it is
/// the one that takes least flash.
pub fn cheapest<'a>(candidates: impl IntoIterator<Item = &'a Candidate>) -> Option<&'a Candidate> {
    let all: Vec<_> = candidates.into_iter().collect();
    let instructions = |c: &&Candidate| c.cost.instructions;
    let least = all.iter().map(instructions).min_by(f64::total_cmp)?;
    (all.into_iter())
        .filter(|c| c.cost.instructions <= 1.005 * least)
        .min_by_key(|c| c.cost.flash())
}

/// The cheapest candidate that fits, or if none does the one that is nearest to it.
pub fn choose<'a>(candidates: &'a [Candidate], bounds: &Bounds) -> Option<&'a Candidate> {
    cheapest(candidates.iter().filter(|c| c.fits(bounds))).or_else(|| {
        let excess = |c: &&Candidate| c.excess(bounds);
        (candidates.iter()).min_by(|a, b| excess(a).total_cmp(&excess(b)))
    })
}
