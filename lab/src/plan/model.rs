//! The model that predicts instructions, flash and memory of a frame: weights of counted events, and of the code that a
//! scene needs, for each target and family of numbers.
//!
//! `cargo bench -p octray --bench plan` measures frames on emulated boards and fits the weights.

use super::events::{Events, NAMES, OF_REST, OF_SEARCH, ROWS};
use octray_core::accel::BuildOptions;
use octray_core::features::{self, FeatureSet};
use octray_core::trace::QueuedRay;
use octray_prepare::bake::Baked;
use octray_prepare::format::{self, Format};
use octray_prepare::plan::Plan;
use octray_render::error::Error;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};

/// A family of numbers with similar costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// 32-bit fixed point.
    Fixed,
    /// 32-bit floats.
    F32,
}

impl Family {
    /// Returns the family of a format.
    pub fn of(format: Format) -> Self {
        match format.family() {
            format::Family::Fixed | format::Family::Fixed64 => Self::Fixed,
            format::Family::Float | format::Family::Approximate => Self::F32,
        }
    }

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::F32 => "f32",
        }
    }
}

/// Bytes on the stack that are lent to the tracer, exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct LentBytes {
    /// The strip of the picture.
    pub strip: usize,
    /// The queue of rays.
    pub rays: usize,
    /// The traversal stack.
    pub nodes: usize,
    /// The shadow cache.
    pub shadow_cache: usize,
}

impl LentBytes {
    /// Returns those of a baked plan with this many lights.
    pub fn of(plan: &Plan, baked: &Baked, lights: usize) -> Self {
        Self {
            strip: plan.size.0 as usize * ROWS * 3,
            rays: baked.rays * size_of::<QueuedRay<f32>>(),
            nodes: baked.nodes * 4,
            shadow_cache: lights * 8,
        }
    }

    /// Returns their sum.
    pub fn total(&self) -> usize {
        self.strip + self.rays + self.nodes + self.shadow_cache
    }
}

/// The features that the model's record has scenes with. What others add to code and frames is left out of a prediction,
/// which [`unpredicted`] names.
const RECORDED: usize = 12;

/// The parts of the code: a constant one, the tree's traversal, and one per recorded feature.
pub const OF_CODE: usize = 2 + RECORDED;

/// Returns the recorded features, with their names.
pub fn recorded() -> &'static [(&'static str, FeatureSet)] {
    &features::NAMES[..RECORDED]
}

/// Returns the names of features in a set whose code no prediction counts.
pub fn unpredicted(set: FeatureSet) -> Vec<String> {
    let others = &features::NAMES[RECORDED..];
    let used = others
        .iter()
        .filter(|(_, what)| features::contains(set, *what));
    used.map(|(name, _)| name.to_lowercase()).collect()
}

/// Returns the parts that a scene needs.
pub fn code(set: FeatureSet, tree: Option<BuildOptions>) -> [f64; OF_CODE] {
    let mut parts = [0.0; OF_CODE];
    parts[0] = 1.0;
    parts[1] = if tree.is_none() { 0.0 } else { 1.0 };
    for (part, (_, what)) in parts[2..].iter_mut().zip(recorded()) {
        *part = if features::contains(set, *what) {
            1.0
        } else {
            0.0
        };
    }
    parts
}

/// The predicted cost of a frame on a board.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// Instructions, without start-up and panel.
    pub instructions: f64,
    /// Bytes of code.
    pub code: f64,
    /// Bytes of tables, exact.
    pub tables: usize,
    /// Bytes of stack frames.
    pub frames: f64,
    /// Bytes lent to the tracer, exact.
    pub lent: LentBytes,
}

impl Prediction {
    /// Returns bytes of flash.
    pub fn flash(&self) -> u64 {
        self.code.round() as u64 + self.tables as u64
    }

    /// Returns bytes of RAM.
    pub fn ram(&self) -> u64 {
        self.frames.round() as u64 + self.lent.total() as u64
    }
}

/// Weights of one target and one family.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    /// The target.
    pub target: String,
    /// The numbers.
    pub family: Family,
    /// Instructions of each event of a search.
    pub search: [f64; OF_SEARCH],
    /// Instructions of each other event.
    pub rest: [f64; OF_REST],
    /// Bytes of each part of the code.
    pub code: [f64; OF_CODE],
    /// Bytes of stack frames of each part of the code.
    pub frames: [f64; OF_CODE],
    /// The typical relative errors of instructions, flash and RAM, for scenes that the weights were not fitted to.
    pub errors: [f64; 3],
}

/// A row of the table of weights.
#[derive(Debug, Serialize, Deserialize)]
struct Entry {
    target: String,
    family: Family,
    what: String,
    weight: f64,
}

fn sum<const N: usize>(counts: &[f64; N], weights: &[f64; N]) -> f64 {
    counts.iter().zip(weights).map(|(c, w)| c * w).sum()
}

impl Weights {
    /// Returns the instructions of the two kinds of search and of the rest.
    pub fn instructions(&self, events: &Events) -> [f64; 3] {
        let [closest, shadow] = &events.search;
        [
            sum(closest, &self.search),
            sum(shadow, &self.search),
            sum(&events.rest, &self.rest),
        ]
    }

    /// Predicts the cost of a frame.
    pub fn predict(
        &self,
        events: &Events,
        baked: &Baked,
        tree: Option<BuildOptions>,
        lent: LentBytes,
    ) -> Prediction {
        Prediction {
            instructions: self.instructions(events).iter().sum(),
            code: sum(&code(baked.features, tree), &self.code),
            tables: baked.bytes,
            frames: sum(&code(baked.features, tree), &self.frames),
            lent,
        }
    }

    fn names() -> Vec<String> {
        let events = NAMES.into_iter().map(String::from);
        let parts = || {
            ["all", "tree"]
                .into_iter()
                .chain(recorded().iter().map(|(name, _)| *name))
        };
        let code = parts().map(|part| format!("code of {part}"));
        let frames = parts().map(|part| format!("frames of {part}"));
        let errors = ["instructions", "flash", "RAM"].map(|what| format!("error of {what}"));
        (events.chain(code).chain(frames).chain(errors)).collect()
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        let events = self.search.into_iter().chain(self.rest).chain(self.code);
        events.chain(self.frames).chain(self.errors)
    }

    fn from_values(target: &str, family: Family, values: &[f64]) -> Option<Self> {
        let (search, values) = values.split_first_chunk()?;
        let (rest, values) = values.split_first_chunk()?;
        let (code, values) = values.split_first_chunk()?;
        let (frames, errors) = values.split_first_chunk()?;
        Some(Self {
            target: target.into(),
            family,
            search: *search,
            rest: *rest,
            code: *code,
            frames: *frames,
            errors: errors.try_into().ok()?,
        })
    }
}

/// The weights of all targets and families.
#[derive(Clone, Debug, PartialEq)]
pub struct Model(pub Vec<Weights>);

impl Model {
    /// Returns the model that comes with octray.
    ///
    /// # Errors
    /// If its table is invalid.
    pub fn shipped() -> Result<Self, Error> {
        Self::read(&include_bytes!("weights.csv")[..])
    }

    /// Reads a table of weights.
    ///
    /// # Errors
    /// If it is not one.
    pub fn read(table: impl Read) -> Result<Self, Error> {
        let broken = |why: String| Error::Failed(format!("the table of weights: {why}"));
        let entries: Result<Vec<Entry>, _> =
            csv::Reader::from_reader(table).into_deserialize().collect();
        let entries = entries.map_err(|why| broken(why.to_string()))?;
        let names = Weights::names();
        let blocks = entries.chunk_by(|a, b| (&a.target, a.family) == (&b.target, b.family));
        let weights = blocks.map(|block| {
            let [first, ..] = block else {
                return Err(broken("an empty block".into()));
            };
            if !block.iter().map(|entry| &entry.what).eq(&names) {
                return Err(broken(format!("not all of {} is known", first.target)));
            }
            let values: Vec<f64> = block.iter().map(|entry| entry.weight).collect();
            Weights::from_values(&first.target, first.family, &values)
                .ok_or_else(|| broken(format!("not all of {} is known", first.target)))
        });
        weights.collect::<Result<_, _>>().map(Self)
    }

    /// Writes the table.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, out: impl Write) -> Result<(), csv::Error> {
        let mut table = csv::Writer::from_writer(out);
        for weights in &self.0 {
            for (what, weight) in Weights::names().into_iter().zip(weights.values()) {
                let (target, family) = (weights.target.clone(), weights.family);
                let digits = if what.starts_with("error") { 1e4 } else { 10.0 };
                table.serialize(Entry {
                    target,
                    family,
                    what,
                    weight: (weight * digits).round() / digits,
                })?;
            }
        }
        table.flush().map_err(csv::Error::from)
    }

    /// Returns the weights of a target and a family.
    pub fn of(&self, target: &str, family: Family) -> Option<&Weights> {
        (self.0.iter()).find(|weights| (&*weights.target, weights.family) == (target, family))
    }
}
