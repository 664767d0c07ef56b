//! Chooses arithmetic and tree: predicts every candidate's cost and takes the cheapest that fits.

use super::accuracy::{Accuracy, Scope};
use super::events::{Events, Probe};
use super::job::PlanLimits;
use super::model::{Family, LentBytes, Model, Prediction, Weights};
use crate::measure::board::Board;
use octray_core::accel::{BuildOptions, COMPACT_MAX_DEPTH};
use octray_prepare::Format;
use octray_prepare::bake::{Baked, bake};
use octray_prepare::plan::Plan;
use octray_render::error::Error;

/// Up to this many objects, plans without a tree are tried.
const FEW: usize = 64;

/// Instructions for each pixel, measured where no ray is traced; otherwise they are not worth counting.
pub const PER_PIXEL: f64 = 3.0;

/// The leaf sizes to try.
const LEAVES: [u32; 5] = [1, 2, 3, 4, 8];

/// A plan that is accurate enough, with its cost.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The plan.
    pub plan: Plan,
    /// The events of its frame.
    pub events: Events,
    /// The baked scene.
    pub baked: Baked,
    /// Nodes of the tree.
    pub nodes: u64,
    /// The power of two by which the scene is scaled.
    pub scale: i32,
    /// Its predicted cost.
    pub cost: Prediction,
}

impl Candidate {
    /// Returns the largest relative excess over a limit; not positive if it fits.
    pub fn excess(&self, limits: &PlanLimits) -> f64 {
        let over = |needs: u64, has: u64| needs as f64 / has.max(1) as f64 - 1.0;
        f64::max(
            over(self.cost.flash(), limits.flash),
            over(self.cost.ram(), limits.ram),
        )
    }

    /// Returns whether it fits.
    pub fn fits(&self, limits: &PlanLimits) -> bool {
        self.cost.flash() <= limits.flash && self.cost.ram() <= limits.ram
    }
}

/// Predicts the costs of plans on a board.
#[derive(Debug)]
pub struct Chooser<'a> {
    /// The scene and its picture.
    pub scope: &'a Scope<'a>,
    /// The board.
    pub board: &'a Board,
    /// The model of costs.
    pub model: &'a Model,
}

impl Chooser<'_> {
    /// Returns all candidates: in each sufficient arithmetic, with trees of several leaf sizes and depths, and without
    /// a tree.
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
        // Shallower trees with the best leaf size.
        let best = cheapest(&all[first..]).map(|best| best.plan.tree);
        if let Some(Some(BuildOptions { depth, leaf_size })) = best {
            for depth in (1..depth).rev() {
                let shallow = self.candidate(packed(depth, leaf_size))?;
                let too_expensive = cheapest(&all[first..])
                    .is_some_and(|best| shallow.cost.instructions > 1.2 * best.cost.instructions);
                all.push(shallow);
                if too_expensive {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Returns a plan with its capacities minimised, and its cost.
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
        let lent = LentBytes::of(&plan, &baked, scene.lights.len());
        let weights = self.weights(plan.format)?;
        let mut cost = weights.predict(&probe.events, &baked, plan.tree, lent);
        let pixels = f64::from(plan.size.0) * f64::from(plan.size.1);
        cost.instructions = cost.instructions.max(PER_PIXEL * pixels);
        Ok(Candidate {
            cost,
            events: probe.events,
            nodes: probe.nodes,
            scale: probe.scale,
            baked,
            plan,
        })
    }

    /// Returns the weights for a format.
    ///
    /// # Errors
    /// [`Error::Failed`] if the model has none.
    pub fn weights(&self, format: Format) -> Result<&Weights, Error> {
        let (target, family) = (self.board.target, Family::of(format));
        self.model.of(target, family).ok_or_else(|| {
            let name = family.name();
            Error::Failed(format!(
                "the model does not know the cost of {name} on {target}"
            ))
        })
    }
}

/// Returns the candidate with the fewest instructions. Candidates within half a percent count as equal; of these, the
/// one with the least flash is taken.
pub fn cheapest<'a>(candidates: impl IntoIterator<Item = &'a Candidate>) -> Option<&'a Candidate> {
    let all: Vec<_> = candidates.into_iter().collect();
    let instructions = |c: &&Candidate| c.cost.instructions;
    let least = all.iter().map(instructions).min_by(f64::total_cmp)?;
    (all.into_iter())
        .filter(|c| c.cost.instructions <= 1.005 * least)
        .min_by_key(|c| c.cost.flash())
}

/// Returns the cheapest candidate that fits, or the one that comes closest if none does.
pub fn choose<'a>(candidates: &'a [Candidate], limits: &PlanLimits) -> Option<&'a Candidate> {
    cheapest(candidates.iter().filter(|c| c.fits(limits))).or_else(|| {
        let excess = |c: &&Candidate| c.excess(limits);
        (candidates.iter()).min_by(|a, b| excess(a).total_cmp(&excess(b)))
    })
}
