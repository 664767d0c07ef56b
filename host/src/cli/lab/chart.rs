//! Arguments of `octray chart`.

use super::lists;
use crate::cli::{files, value};
use clap::{Args, value_parser};
use octray_lab::canvas;
use octray_lab::chart::ChartJob;
use octray_lab::chart::cost::{CostKind, tree_on_boards};
use octray_lab::chart::point::{Against, Wishes};
use octray_lab::chart::setting::Grid;
use octray_prepare::{Arith, PixelsPerRay, RenderSettings, Samples, TreeKind};
use octray_render::error::Error;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// The largest number of combinations of scenes, settings and costs: a chart of more would be unreadable.
const MOST: usize = 256;

/// Arguments of `octray chart`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Every combination of the lists is a point. An arithmetic's name states its Newton steps (approx0 to approx2) or its integer \
and fraction bits. Costs are host-time (seconds; varies between runs), host-instructions (counted by Valgrind), events \
(instructions estimated from counted rays, steps and tests: for comparing settings; equal for all arithmetics), and \
boards such as m3 (instructions counted in QEMU; see octray measure). Boards support only the trees compact-bvh8 and none, \
and one ray per pixel at most.

The knee is the point of the frontier that lies farthest above the straight line between its ends, in decibels over \
the logarithm of the cost.")]
pub struct ChartArgs {
    /// Scene files [default: the five figures]
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Arithmetics, separated by commas
    #[arg(long, value_name = "LIST", value_parser = value::choice::<Arith>(), value_delimiter = ',', default_value = ARITHS)]
    arith: Vec<Arith>,
    /// Trees [default: bvh8, or compact-bvh8 with a board]
    #[arg(long, value_name = "LIST", value_parser = value::choice::<TreeKind>(), value_delimiter = ',')]
    tree: Vec<TreeKind>,
    /// Maximum numbers of bounces of a ray
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "8", value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: Vec<u32>,
    /// Weights from 0 to 1; rays of a smaller weight are not traced
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1/512", value_parser = value::weight)]
    cut_off: Vec<f64>,
    /// Pixels that one ray colours
    #[arg(
        long,
        value_name = "LIST",
        value_parser = value::choice::<PixelsPerRay>(),
        value_delimiter = ',',
        default_value = "1"
    )]
    pixels_per_ray: Vec<PixelsPerRay>,
    /// Rays per pixel: K x K, or adaptive[:LEVELS[:THRESHOLD]], as in `octray render`
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1", value_parser = value::samples)]
    samples: Vec<Samples>,
    /// Cost of a frame: host-time, host-instructions, events, or a board; one panel each
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "host-time", value_parser = CostKind::named)]
    cost: Vec<CostKind>,
    /// Columns and rows; the framing stays the same
    #[arg(long, value_name = "WxH", default_value = "128x96", value_parser = value::size)]
    size: (u32, u32),

    /// Reference of the accuracy: f64 with the same settings, or converged f64 [default: the same settings, if points
    /// differ only in arithmetic and tree]
    #[arg(long, value_name = "WHAT", value_parser = value::choice::<Against>())]
    against: Option<Against>,
    /// K x K rays per pixel of the converged reference
    #[arg(long, value_name = "K", default_value_t = 16, value_parser = value_parser!(u32).range(1..=64))]
    converged_samples: u32,
    /// Number of rounds; the median time counts
    #[arg(long, value_name = "N", default_value = "5", value_parser = value::positive::<NonZeroUsize>)]
    rounds: NonZeroUsize,
    /// Choose the fastest point with at least this PSNR, in decibels
    #[arg(long, value_name = "DB", default_value = "40", value_parser = value::not_negative)]
    min_psnr: f64,
    /// Choose the most accurate point within this cost: instructions or seconds per frame
    #[arg(long, value_name = "COST", value_parser = value::not_negative)]
    budget: Option<f64>,

    /// Draw the chart: .svg, .png or .ppm
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the points as comma-separated values
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write points and choices as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

const ARITHS: &str =
    "f64,f32,approx0,approx1,approx2,i24f8,i20f12,i16f16,i12f20,i8f24,i4f28,i32f32";

impl ChartArgs {
    /// Returns the job, without duplicates.
    ///
    /// # Errors
    /// [`Error::Usage`] if there are no combinations or too many, if a board does not support a setting, or if a result
    /// would replace a scene or another result.
    pub fn job(self) -> Result<ChartJob, Error> {
        self.check_files()?;
        let costs = lists::once(self.cost, |a, b| a.name() == b.name());
        let on_board = costs.iter().find(|kind| matches!(kind, CostKind::Board(_)));
        let trees = match (&*self.tree, on_board) {
            ([], Some(_)) => vec![TreeKind::CompactBvh8],
            ([], None) => vec![TreeKind::Bvh8],
            (trees, _) => trees.to_vec(),
        };
        let grid = Grid {
            ariths: lists::once(self.arith, |a, b| a == b),
            trees: lists::once(trees, |a, b| a == b),
            max_depths: lists::once(self.max_depth, |a, b| a == b),
            cut_offs: lists::once(self.cut_off, |a, b| a == b),
            pixels_per_ray: lists::once(self.pixels_per_ray, |a, b| a == b),
            samples: lists::once(self.samples, |a, b| a == b),
        };
        let usage = |why: String| Err(Error::Usage(why));
        let scenes = if self.scenes.is_empty() {
            5
        } else {
            self.scenes.len()
        };
        let combinations = grid.len().saturating_mul(scenes * costs.len());
        if combinations > MOST {
            return usage(format!(
                "{combinations} combinations of scenes, settings and costs are too many: at most {MOST}"
            ));
        }
        if grid.settings(self.size).is_empty() {
            return usage(
                "--pixels-per-ray and --samples, both above 1, contradict each other".into(),
            );
        }
        if let Some(board) = on_board.map(|kind| kind.name()) {
            if let Some(tree) = grid
                .trees
                .iter()
                .find(|tree| tree_on_boards(**tree).is_none())
            {
                let tree = tree.name();
                return usage(format!(
                    "{board} has no {tree} tree: expected compact-bvh8 or none"
                ));
            }
            if grid.samples != [Samples::Uniform(1)] {
                return usage(format!("{board} supports no more than one ray per pixel"));
            }
        }
        let against = match grid.is_of_one_picture() {
            true => Against::Same,
            false => Against::Converged,
        };
        Ok(ChartJob {
            scenes: self.scenes,
            grid,
            costs,
            size: self.size,
            converged_samples: self.converged_samples,
            rounds: self.rounds,
            wishes: Wishes {
                against: self.against.unwrap_or(against),
                min_psnr: self.min_psnr,
                budget: self.budget,
            },
            output: self.output,
            csv: self.csv,
            json: self.json,
        })
    }

    /// Checks that no file is written twice, that no scene is replaced, and that the chart's extension is a known
    /// format.
    fn check_files(&self) -> Result<(), Error> {
        let results = [&self.output, &self.csv, &self.json];
        files::distinct(&self.scenes, results.into_iter().flatten())?;
        self.output
            .iter()
            .try_for_each(|path| canvas::check_name(path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct TestCommand {
        #[command(flatten)]
        args: ChartArgs,
    }

    fn parse(line: &str) -> Result<ChartArgs, clap::Error> {
        let words = std::iter::once("chart").chain(line.split_whitespace());
        TestCommand::try_parse_from(words).map(|line| line.args)
    }

    fn job(line: &str) -> ChartJob {
        parse(line).unwrap().job().unwrap()
    }

    #[test]
    fn the_defaults_are_the_documented_ones() {
        let job = job("a.scene");
        assert_eq!(job.grid.settings(job.size).len(), 12);
        assert_eq!(job.grid.trees, [TreeKind::Bvh8]);
        assert_eq!((job.size, job.converged_samples), ((128, 96), 16));
        assert_eq!(job.costs[0].name(), "host-time");
        assert_eq!(job.wishes.against, Against::Same);
        assert_eq!((job.wishes.min_psnr, job.wishes.budget), (40.0, None));
    }

    #[test]
    fn every_list_reaches_the_grid_without_duplicates() {
        let job = job(
            "a b --arith f32,auto,f32 --tree none,plain --max-depth 0,2,2 --cut-off 0,1/64 \
             --pixels-per-ray 1,4 --samples 1 --cost events,host-instructions,events --size 8x9 \
             --budget 1e6 --min-psnr 30",
        );
        assert_eq!(job.grid.len(), 2 * 2 * 2 * 2 * 2);
        assert_eq!(job.costs.len(), 2);
        assert_eq!(job.wishes.against, Against::Converged);
        assert_eq!((job.wishes.min_psnr, job.wishes.budget), (30.0, Some(1e6)));
    }

    #[test]
    fn with_a_board_the_default_tree_is_one_that_boards_support() {
        assert_eq!(
            job("a --cost m3,host-time").grid.trees,
            [TreeKind::CompactBvh8]
        );
        assert_eq!(job("a --cost m3 --tree none").grid.trees, [TreeKind::None]);
        let all = job("a --cost m3 --pixels-per-ray 1,4 --cut-off 0,0.1").grid;
        assert_eq!(all.settings((8, 8)).len(), 48);
    }

    #[test]
    fn wrong_values_are_refused() {
        for line in [
            "a --cost money",
            "a --arith f16",
            "a --tree oak",
            "a --max-depth 65",
            "a --cut-off 2",
            "a --samples 0",
            "a --budget -1",
            "a --rounds 0",
            "a --against nothing",
        ] {
            assert_eq!(parse(line).unwrap_err().exit_code(), 2, "{line}");
        }
        for (line, why) in [
            ("a --samples 2 --pixels-per-ray 4", "contradict"),
            ("--max-depth 0,1,2,3,4", "300 combinations"),
            ("a --cost m3 --tree tight", "m3 has no bvh8 tree"),
            ("a --cost m3 --samples 2", "no more than one ray per pixel"),
            ("a -o b.bmp", ".bmp"),
            ("a -o b.svg --csv b.svg", "one file"),
            ("a --json a", "which is read"),
        ] {
            let error = parse(line).unwrap().job().unwrap_err();
            assert!(matches!(error, Error::Usage(_)), "{line}");
            assert!(error.to_string().contains(why), "{error}");
        }
    }
}
