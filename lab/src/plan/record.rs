//! What was measured for the model: lines of `octray measure --csv`, and the scenes they name.

use super::comb::comb;
use super::events::{Events, Probe};
use super::model::{Family, Parts, Weights};
use crate::measure::board::{BOARDS, Board};
use octray_core::accel::BuildOptions;
use octray_prepare::bake::{BakeOptions, Baked, bake};
use octray_prepare::choice::Choice;
use octray_prepare::plan::{Plan, fingerprint};
use octray_prepare::{Arith, PixelsPerRay, RenderSettings, TreeKind, TreeSettings};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_scenes::generate::{SceneKind, Spec, generate};
use octray_scenes::model::Scene;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::io::{Read, Write};
use std::path::Path;

/// Where the random numbers of generated scenes start.
pub const SEED: u64 = 7;

/// A line of the record.
#[derive(Clone, Debug, Deserialize)]
pub struct Line {
    /// A file of `scenes/`, or a kind and a number of objects such as `soup-60`, or `comb` and a number of teeth.
    pub scene: String,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The most bounces.
    pub max_depth: u32,
    /// The board.
    pub board: String,
    /// The number format.
    pub format: String,
    /// The tree, `packed` or `none`.
    pub tree: String,
    /// Instructions of the frame.
    pub instructions: f64,
    /// Rays that look for the closest hit.
    pub closest_rays: f64,
    /// Instructions of each of their searches.
    pub per_closest_ray: Option<f64>,
    /// Shadow rays.
    pub shadow_rays: f64,
    /// Instructions of each of their searches.
    pub per_shadow_ray: Option<f64>,
    /// Bytes of code and constants.
    pub flash: f64,
    /// Bytes of variables.
    pub ram: f64,
    /// Bytes of the deepest stack.
    pub stack: f64,
}

/// A line, and what the host knows of its frame.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The line.
    pub line: Line,
    /// The board.
    pub board: &'static Board,
    /// What kind of numbers it is.
    pub family: Family,
    /// What was counted.
    pub events: Events,
    /// How its tree is built, if there is one.
    pub tree: Option<BuildOptions>,
    /// What was baked.
    pub baked: Baked,
    /// How much memory it takes besides code and frames of functions.
    pub lent: Parts,
}

impl Sample {
    /// By how much of themselves predicted instructions, flash and RAM are too large.
    pub fn errors(&self, weights: &Weights) -> [f64; 3] {
        let predicted = weights.predict(&self.events, &self.baked, self.tree, self.lent);
        [
            predicted.instructions / self.line.instructions - 1.0,
            predicted.flash() as f64 / self.line.flash - 1.0,
            predicted.ram() as f64 / (self.line.ram + self.line.stack) - 1.0,
        ]
    }
}

/// All lines of a record.
///
/// # Errors
/// If it is no record.
pub fn read(record: impl Read) -> Result<Vec<Line>, Error> {
    let mut lines = Vec::new();
    for line in csv::Reader::from_reader(record).into_deserialize() {
        lines
            .push(line.map_err(|why| Error::Failed(format!("the record of measurements: {why}")))?);
    }
    Ok(lines)
}

/// The record with what was measured anew: of boards that were not measured the lines stay. By board, its lines in
/// the order in which they came. The columns are those of what was measured: what older lines do not tell is empty.
///
/// # Errors
/// If either is no record; if `out` cannot be written.
pub fn renew(old: impl Read, measured: impl Read, out: impl Write) -> Result<(), Error> {
    let broken = |why: String| Error::Failed(format!("the record of measurements: {why}"));
    let wrong = |why: csv::Error| broken(why.to_string());
    let mut old = csv::Reader::from_reader(old);
    let mut measured = csv::Reader::from_reader(measured);
    let columns = measured.headers().map_err(wrong)?.clone();
    let board = (columns.iter().position(|name| name == "board"))
        .ok_or_else(|| broken("no column tells the board".into()))?;
    let known = old.headers().map_err(wrong)?.clone();
    let places: Vec<_> = (columns.iter())
        .map(|name| known.iter().position(|known| known == name))
        .collect();
    let mut lines: Vec<_> = measured
        .records()
        .collect::<Result<_, _>>()
        .map_err(wrong)?;
    let boards: BTreeSet<String> = lines.iter().map(|line| line[board].to_owned()).collect();
    for line in old.records() {
        let line = line.map_err(wrong)?;
        let cell = |place: &Option<usize>| place.and_then(|at| line.get(at)).unwrap_or_default();
        let line: csv::StringRecord = places.iter().map(cell).collect();
        if !boards.contains(&line[board]) {
            lines.push(line);
        }
    }
    lines.sort_by(|a, b| a[board].cmp(&b[board]));
    let mut table = csv::Writer::from_writer(out);
    table.write_record(&columns).map_err(wrong)?;
    for line in &lines {
        table.write_record(line).map_err(wrong)?;
    }
    table.flush().map_err(|why| broken(why.to_string()))
}

/// The scene that a record names.
///
/// # Errors
/// If there is none.
pub fn scene(name: &str, folder: &Path) -> Result<Scene, Error> {
    let broken = |why: String| Error::Failed(format!("the record of measurements: {name}: {why}"));
    if let Some(teeth) = name.strip_prefix("comb-") {
        let teeth = teeth
            .parse()
            .map_err(|_| broken("a number of teeth is missing".into()))?;
        return comb(teeth);
    }
    let generated = name.split_once('-').and_then(|(kind, objects)| {
        let kind = SceneKind::ALL
            .into_iter()
            .find(|known| known.name() == kind)?;
        let objects = objects.parse().ok()?;
        Some(generate(Spec { kind, objects }, SEED))
    });
    match generated {
        Some(scene) => Ok(scene),
        None => Ok(octray_scenes::read(
            folder.join(name).with_extension("scene"),
        )?),
    }
}

impl Line {
    fn board(&self) -> Result<&'static Board, Error> {
        let known = BOARDS.iter().find(|board| board.name == self.board);
        known.ok_or_else(|| Error::Failed(format!("the record of measurements: {}", self.board)))
    }

    /// The plan that this measures.
    ///
    /// # Errors
    /// If there is no such format or tree.
    pub fn plan(&self, scene: &Scene) -> Result<Plan, Error> {
        let unknown = |what: &str| Error::Failed(format!("the record of measurements: {what}"));
        let Some(Arith::In(format)) = Arith::named(&self.format) else {
            return Err(unknown(&self.format));
        };
        let target = Some(self.board()?.target);
        let mut plan = Plan {
            scene: fingerprint(scene),
            format,
            size: (self.width, self.height),
            pixels_per_ray: PixelsPerRay::One,
            max_depth: self.max_depth,
            cut_off: RenderSettings::DEFAULT.cut_off,
            tree: match TreeKind::named(&self.tree) {
                Some(kind @ TreeKind::CompactBvh8) => {
                    Some(TreeSettings::of(kind).build_options(format, target))
                }
                Some(TreeKind::None) => None,
                _ => return Err(unknown(&self.tree)),
            },
            on_device: false,
            rays: 0,
        };
        let options = plan
            .options(scene, "")
            .map_err(|why| unknown(&why.to_string()))?;
        let options = BakeOptions {
            rays: None,
            ..options
        };
        let baked = bake(scene, &options).map_err(|why| unknown(&why.to_string()))?;
        plan.rays = baked.rays;
        Ok(plan)
    }

    /// What the host knows of it.
    ///
    /// # Errors
    /// If scene, board or format are unknown; [`Error::Interrupted`].
    pub fn sample(self, folder: &Path, interrupt: &Interrupt) -> Result<Sample, Error> {
        let scene = scene(&self.scene, folder)?;
        let plan = self.plan(&scene)?;
        let probe = Probe::render(&scene, &plan, interrupt)?;
        let failed = |what: &str| Error::Failed(format!("the record of measurements: {what}"));
        let options = (plan.options(&scene, "")).map_err(|why| failed(&why.to_string()))?;
        let baked = bake(&scene, &options).map_err(|why| failed(&why.to_string()))?;
        let board = self.board()?;
        Ok(Sample {
            family: Family::of(plan.format),
            board,
            events: probe.events,
            tree: plan.tree,
            lent: Parts::of(&plan, &baked, scene.lights.len()),
            baked,
            line: self,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boards_that_are_not_measured_keep_their_lines() {
        let renewed = |old: &str, measured: &str| {
            let mut out = Vec::new();
            renew(old.as_bytes(), measured.as_bytes(), &mut out)
                .map(|()| String::from_utf8(out).unwrap())
        };
        let old = "scene,board,flash\na,m0,1\nb,m0,2\na,m3,3\nb,m3,4\na,m4,5\n";
        let measured = "scene,board,flash\nb,m3,6\na,m3,7\n";
        assert_eq!(
            renewed(old, measured).unwrap(),
            "scene,board,flash\na,m0,1\nb,m0,2\nb,m3,6\na,m3,7\na,m4,5\n"
        );
        // A column that is new, and one that is gone.
        assert_eq!(
            renewed("board,tree,scene\nm0,none,a\n", measured).unwrap(),
            "scene,board,flash\na,m0,\nb,m3,6\na,m3,7\n"
        );
        assert!(renewed(old, "scene\na\n").is_err());
    }
}
