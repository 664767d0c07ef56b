//! `octray overlaps`: lists pairs of objects that pass through each other, or one of which is inside the other.

mod body;
mod relation;

use crate::trace::{Names, Object};
use body::Body;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::scene_file;
use octray_scenes::model::{Point, Scene};
use octray_scenes::reduce::Reduction;
use relation::{Relation, relation};
use serde::Serialize;
use std::path::PathBuf;

/// Objects that are nearer to each other than this share of the scene's diagonal touch.
const SLACK: f64 = 1e-9;

/// More pairs are not listed.
const MOST: usize = 1_000_000;

/// What to look through, and how to tell it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OverlapsJob {
    /// The scene file.
    pub scene: PathBuf,
    /// Whether to print JSON rather than text.
    pub json: bool,
}

/// A pair of objects, by their places in the scene file: for [`Relation::Inside`] the inner one first.
type Pair = (u32, u32, Relation);

/// A pair as JSON has it.
#[derive(Serialize)]
struct Told {
    /// The one of lower number; the inner one if one is inside.
    object: Object,
    /// `crosses` or `inside`.
    how: &'static str,
    /// The other one.
    other: Object,
}

/// Lists the pairs.
///
/// # Errors
/// If the scene is refused or has too many pairs, or standard output cannot be written.
pub fn run(job: &OverlapsJob, interrupt: &Interrupt) -> Result<(), Error> {
    let (scene, lines) = scene_file::read_with_lines(&job.scene, Reduction::default())?;
    let pairs = sweep(&scene, interrupt)?;
    let names = Names::new(&scene, &lines);
    let told: Vec<_> = pairs
        .iter()
        .map(|&(object, other, relation)| Told {
            object: names.object(object),
            how: match relation {
                Relation::Cross => "crosses",
                Relation::Inside | Relation::Around => "inside",
            },
            other: names.object(other),
        })
        .collect();
    output::write_stdout(interrupt, |out| {
        if job.json {
            serde_json::to_writer(&mut *out, &told)?;
            return writeln!(out);
        }
        for Told { object, how, other } in &told {
            let how = if *how == "inside" { "is inside" } else { how };
            writeln!(out, "{object}  {how}  {other}")?;
        }
        let crossing = told.iter().filter(|told| told.how == "crosses").count();
        let inside = told.len() - crossing;
        let cross = if crossing == 1 {
            "pair crosses"
        } else {
            "pairs cross"
        };
        let are = if inside == 1 { "is" } else { "are" };
        writeln!(
            out,
            "{} objects: {} {cross}, {} {are} inside another",
            thousands(scene.objects.len() as u64),
            thousands(crossing as u64),
            thousands(inside as u64)
        )
    })
}

/// All pairs, in the order of the scene file. Only those whose boxes overlap are tested: the boxes are swept along x.
fn sweep(scene: &Scene, interrupt: &Interrupt) -> Result<Vec<Pair>, Error> {
    let bodies: Vec<_> = (scene.objects.iter())
        .map(|object| Body::of(scene, &object.shape))
        .collect();
    let mut boxes: Vec<(u32, &Body, [Point; 2])> = (0..)
        .zip(&bodies)
        .filter_map(|(id, body)| body.as_ref().map(|body| (id, body, body.bounds())))
        .collect();
    let slack = SLACK * diagonal(boxes.iter().map(|(.., bounds)| *bounds));
    boxes.sort_by(|a, b| a.2[0][0].total_cmp(&b.2[0][0]));
    let mut open: Vec<(u32, &Body, [Point; 2])> = Vec::new();
    let mut pairs = Vec::new();
    for next in boxes {
        interrupt.check()?;
        let [low, high] = next.2;
        open.retain(|(.., bounds)| bounds[1][0] >= low[0]);
        for (id, body, bounds) in &open {
            if (1..3).all(|i| bounds[0][i] <= high[i] && low[i] <= bounds[1][i]) {
                pairs.extend(pair((*id, body), (next.0, next.1), slack));
            }
        }
        if pairs.len() > MOST {
            let most = thousands(MOST as u64);
            return Err(Error::Failed(format!(
                "more than {most} pairs of objects overlap"
            )));
        }
        open.push(next);
    }
    pairs.sort_unstable_by_key(|&(object, other, _)| (object, other));
    Ok(pairs)
}

/// Two objects as a pair, if they are one: the inner one first, else the one of lower number.
fn pair(a: (u32, &Body), b: (u32, &Body), slack: f64) -> Option<Pair> {
    let (a, b) = if a.0 < b.0 { (a, b) } else { (b, a) };
    Some(match relation(a.1, b.1, slack)? {
        Relation::Cross => (a.0, b.0, Relation::Cross),
        Relation::Inside => (a.0, b.0, Relation::Inside),
        Relation::Around => (b.0, a.0, Relation::Inside),
    })
}

/// The diagonal of the box around boxes; 0 without any.
fn diagonal(boxes: impl Iterator<Item = [Point; 2]>) -> f64 {
    let mut all: Option<[Point; 2]> = None;
    for [low, high] in boxes {
        let [least, most] = all.unwrap_or([low, high]);
        all = Some([
            [0, 1, 2].map(|i| least[i].min(low[i])),
            [0, 1, 2].map(|i| most[i].max(high[i])),
        ]);
    }
    all.map_or(0.0, |[low, high]| body::length(body::minus(high, low)))
}

#[cfg(test)]
mod tests;
