//! Arguments of `octray measure`.

use super::lists;
use crate::cli::reduction::ReductionArgs;
use crate::cli::{files, value};
use clap::{Args, value_parser};
use octray_lab::canvas;
use octray_lab::measure::board::{self, BOARDS, Board};
use octray_lab::measure::job::{FirmwareOptions, Goal, MeasureJob};
use octray_lab::measure::ratio::CORES;
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, FirmwareTree, PixelsPerRay, RenderSettings};
use octray_render::error::Error;
use std::path::PathBuf;
use std::time::Duration;

/// Arguments of `octray measure`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Boards: m0 (Cortex-M0, micro:bit), m3, m4 (without its floating-point unit), m4f, m7f,
rv32imac, sifive-e, rv32imafc. A target's name means all of its boards.

A QEMU plugin counts instructions exactly, without start-up and panel.
Cycles are estimated from the cores' manuals, for zero wait states.")]
pub struct MeasureArgs {
    /// Scene files [default: the five figures]
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    reduction: ReductionArgs,
    /// Measure single operations instead of scenes: arithmetic, hit tests, voxel step, shaded light
    #[arg(long, conflicts_with_all = ["scenes", "lights", "opaque", "size", "max_depth", "pixels_per_ray", "cut_off", "tree", "functions", "chart"])]
    kernels: bool,
    /// Boards or targets, separated by commas [default: all]
    #[arg(long = "target", alias = "targets", value_name = "BOARDS", value_delimiter = ',', value_parser = board::named)]
    targets: Vec<Vec<&'static Board>>,
    /// Arithmetics, separated by commas
    #[arg(
        long,
        value_name = "NAMES",
        value_parser = value::choice::<Arith>(),
        value_delimiter = ',',
        default_value = "f32,auto"
    )]
    arith: Vec<Arith>,
    /// Columns and rows; the framing stays the same
    #[arg(long, value_name = "WxH", default_value = "64x48", value_parser = value::size)]
    size: (u32, u32),
    /// Maximum number of bounces of a ray
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: u32,
    /// Pixels that one ray colours: 1, or 4 in squares of two by two
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name())]
    pixels_per_ray: PixelsPerRay,
    /// Do not trace rays of a smaller weight than this, from 0 to 1
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight)]
    cut_off: f64,
    /// The firmware's tree
    #[arg(long, value_name = "KIND", value_parser = value::choice::<FirmwareTree>(), default_value = FirmwareTree::default().name())]
    tree: FirmwareTree,
    /// What the compiler optimizes for
    #[arg(long, value_name = "WHAT", value_parser = value::choice::<Goal>(), default_value = Goal::default().name())]
    optimize: Goal,
    /// Abort a run after this many seconds
    #[arg(long, value_name = "S", default_value_t = 300, value_parser = value_parser!(u64).range(1..))]
    patience: u64,
    /// Print the N most expensive functions of each run
    #[arg(long, value_name = "N", default_value_t = 0)]
    functions: usize,
    /// Write the results as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the results as comma-separated values
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw a chart of the costs without and with a floating-point unit: .svg, .png or .ppm
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
}

impl MeasureArgs {
    /// Returns the job, without duplicates.
    ///
    /// # Errors
    /// [`Error::Usage`] if a result would replace a scene or another result, or if a chart would be empty.
    pub fn job(self) -> Result<MeasureJob, Error> {
        let results = [&self.json, &self.csv, &self.chart];
        files::distinct(&self.scenes, results.into_iter().flatten())?;
        self.chart
            .iter()
            .try_for_each(|path| canvas::check_name(path))?;
        let boards: Vec<&Board> = match &*self.targets {
            [] => BOARDS.iter().collect(),
            named => lists::once(named.iter().flatten().copied(), |a, b| a.name == b.name),
        };
        if self.chart.is_some() {
            let measured = |name: &str| boards.iter().any(|board| board.name == name);
            if !CORES.iter().any(|(a, b)| measured(a) && measured(b)) {
                let why = "--chart needs m4 and m4f, or rv32imac and rv32imafc, among the targets";
                return Err(Error::Usage(why.into()));
            }
        }
        Ok(MeasureJob {
            kernels: self.kernels,
            scenes: self.scenes,
            reduction: self.reduction.reduction(),
            boards,
            ariths: lists::once(self.arith, |a, b| a == b),
            settings: RenderSettings {
                size: Some(self.size),
                max_depth: self.max_depth,
                pixels_per_ray: self.pixels_per_ray,
                cut_off: self.cut_off,
                ..RenderSettings::DEFAULT
            },
            build: FirmwareOptions {
                tree: self.tree,
                optimize: self.optimize,
            },
            patience: Duration::from_secs(self.patience),
            functions: self.functions,
            json: self.json,
            csv: self.csv,
            chart: self.chart,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct TestCommand {
        #[command(flatten)]
        args: MeasureArgs,
    }

    fn parse(line: &str) -> Result<MeasureArgs, clap::Error> {
        let words = std::iter::once("measure").chain(line.split_whitespace());
        TestCommand::try_parse_from(words).map(|line| line.args)
    }

    fn boards(line: &str) -> Vec<&'static str> {
        let job = parse(line).unwrap().job().unwrap();
        job.boards.iter().map(|board| board.name).collect()
    }

    #[test]
    fn the_defaults_are_the_documented_ones() {
        let job = parse("").unwrap().job().unwrap();
        assert!(job.scenes.is_empty() && !job.kernels);
        assert_eq!(job.boards.len(), BOARDS.len());
        assert_eq!(job.ariths, [Arith::F32, Arith::Auto]);
        let expected = RenderSettings {
            size: Some((64, 48)),
            ..RenderSettings::DEFAULT
        };
        assert_eq!(job.settings, expected);
        assert_eq!(job.build.tree, FirmwareTree::COMPACT);
        assert_eq!(job.build.optimize, Goal::Speed);
    }

    #[test]
    fn duplicates_are_measured_once() {
        let named = boards("--targets m7f,thumbv7em-none-eabihf,m0,m7f");
        assert_eq!(named, ["m7f", "m4f", "m0"]);
        let job = parse("--arith f32,f32,i16f16").unwrap().job().unwrap();
        assert_eq!(job.ariths, [Arith::F32, Arith::I16F16]);
    }

    #[test]
    fn wrong_values_are_refused() {
        for line in [
            "--targets m1",
            "--arith blob",
            "--size 0x4",
            "--tree plain",
            "--optimize all",
            "--patience 0",
            "--kernels a.scene",
            "--kernels --size 8x8",
            "--kernels --pixels-per-ray 4",
            "--pixels-per-ray 2",
            "--cut-off 2",
            "--kernels --chart a.svg",
        ] {
            assert!(parse(line).is_err(), "{line}");
        }
        for line in [
            "a --json a",
            "a --json b --csv b",
            "a --csv b.svg --chart b.svg",
            "a --chart b.txt",
            "a --targets m3,m4 --chart b.svg",
        ] {
            let error = parse(line).unwrap().job().unwrap_err();
            assert!(matches!(error, Error::Usage(_)), "{line}");
        }
    }
}
