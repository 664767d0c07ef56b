//! Arguments of `octray render`.

use super::frames::FramesArgs;
use super::{ReductionArgs, files, value};
use crate::job::{RenderJob, StatsFormat};
use clap::{Args, value_parser};
use octray_core::frame::RUN;
use octray_prepare::choice::Choice;
use octray_prepare::{
    Arith, Link, PixelsPerRay, RenderSettings, Samples, TreeKind, TreeSettings, Walk,
};
use octray_render::error::Error;
use octray_render::picture::{RasDepth, Target};
use octray_render::schedule::Schedule;
use octray_render::scheduler::Policy;
use octray_render::tile::TileSize;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Arguments of `octray render`.
#[derive(Clone, Debug, Args)]
pub struct RenderArgs {
    /// The scene file
    scene: PathBuf,
    /// The picture: .png, .ppm, .pfm (float intensities), .ras (Sun rasterfile) or .int (intensities as text)
    /// [default: the scene's name with .png, in the current folder]
    #[arg(short, long, value_name = "FILE", value_parser = value::target(), verbatim_doc_comment)]
    output: Option<Target>,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_parser = value::choice::<Arith>(), default_value = Arith::default().name())]
    arith: Arith,
    /// Columns and rows of the picture, each from 1 to 65535 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// Bits per pixel of a Sun rasterfile
    #[arg(long, value_name = "BITS", value_parser = value::choice::<RasDepth>(), default_value = RasDepth::default().name())]
    ras_depth: RasDepth,
    /// What to print on standard output
    #[arg(long, value_name = "FORM", value_parser = value::choice::<StatsFormat>(), default_value = StatsFormat::default().name())]
    stats: StatsFormat,

    /// Draw black lines where the object that is seen changes, instead of surfaces; only rays of the camera are traced
    #[arg(long)]
    wire: bool,
    #[command(flatten)]
    reduction: ReductionArgs,

    #[command(flatten)]
    frames: FramesArgs,

    /// Pixels that one ray colours
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name(), help_heading = RAYS)]
    pixels_per_ray: PixelsPerRay,
    /// Trace K x K rays per pixel and average them; or adaptive[:LEVELS[:THRESHOLD]]: one ray through each corner of a
    /// pixel, and where corners differ by more than THRESHOLD (8) of 255 levels, quarter the pixel up to LEVELS (2) times
    #[arg(long, value_name = "K", default_value = "1", value_parser = value::samples, help_heading = RAYS)]
    samples: Samples,
    /// Maximum number of bounces of a ray
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)), help_heading = RAYS)]
    max_depth: u32,
    /// Do not trace rays of a smaller weight than this, from 0 to 1
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight, help_heading = RAYS)]
    cut_off: f64,

    /// The accelerator; all kinds give the same picture
    #[arg(long, value_name = "KIND", value_parser = value::choice::<TreeKind>(), default_value = TreeKind::default().name(), help_heading = TREE)]
    tree: TreeKind,
    /// Deepest level of nodes; the root is level 0 [default: depends on the kind]
    #[arg(long, value_name = "D", value_parser = value_parser!(u32).range(0..=64), help_heading = TREE)]
    tree_depth: Option<u32>,
    /// Do not divide a node of up to N objects [default: 2]
    #[arg(long, value_name = "N", value_parser = value::positive::<NonZeroU32>, help_heading = TREE)]
    leaf_size: Option<NonZeroU32>,
    /// Memory for N nodes; a full arena makes rendering slower, never wrong [default: as many as needed]
    #[arg(long, value_name = "NODES", value_parser = value::positive::<NonZeroUsize>, help_heading = TREE)]
    arena: Option<NonZeroUsize>,
    /// How the plain and the modified octree assign objects to their cells
    #[arg(long, value_name = "BY", value_parser = value::choice::<Link>(), default_value = Link::default().name(), help_heading = TREE)]
    link: Link,
    /// How rays find their way through the plain and the modified octree; the picture is the same
    #[arg(long, value_name = "HOW", value_parser = value::choice::<Walk>(), default_value = Walk::default().name(), help_heading = TREE)]
    walk: Walk,

    /// Number of threads [default: one per core; with --mpi one per rank]
    #[arg(long, value_name = "N", value_parser = value::threads, help_heading = WORK)]
    threads: Option<NonZeroUsize>,
    /// Which thread gets which tile
    #[arg(long, alias = "policy", value_name = "HOW", value_parser = value::choice::<Policy>(), default_value = Policy::default().name(), help_heading = WORK)]
    schedule: Policy,
    /// Rows of a tile [default: 16, fewer with many threads]
    #[arg(long, alias = "packet-rows", value_name = "H", value_parser = value::positive::<NonZeroU32>, help_heading = WORK)]
    tile_rows: Option<NonZeroU32>,
    /// Columns of a tile, a multiple of 8 [default: 16, 8 with many threads; the whole width with --tile-rows]
    #[arg(long, alias = "packet-columns", value_name = "W", value_parser = value::positive::<NonZeroU32>, help_heading = WORK)]
    tile_columns: Option<NonZeroU32>,
    /// Keep each thread on one core
    #[arg(long, help_heading = WORK)]
    pin: bool,
    /// Share the work among the ranks that mpirun started; each rank uses one thread
    #[arg(long, help_heading = WORK)]
    mpi: bool,
}

const RAYS: &str = "Rays";
const TREE: &str = "Tree";
const WORK: &str = "Threads";

const NO_MPI: &str = "this octray was built without MPI; install libopenmpi-dev and libclang-dev, and build it with \
    'cargo build --release --features mpi'";

impl RenderArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] when they contradict each other, or the picture would replace the scene.
    pub fn job(self) -> Result<RenderJob, Error> {
        let usage = |text: &str| Err(Error::Usage(text.into()));
        let (pixels, block) = (self.pixels_per_ray.number(), self.pixels_per_ray.side());
        let one_ray = self.samples == Samples::Uniform(1);
        if pixels > 1 && !one_ray {
            return usage("--pixels-per-ray and --samples, both above 1, contradict each other");
        }
        if self.wire && !one_ray {
            return usage("--wire draws lines of whole pixels: leave out --samples");
        }
        if (self.tile_rows).is_some_and(|rows| !rows.get().is_multiple_of(block)) {
            return usage(&format!(
                "with --pixels-per-ray {pixels}, --tile-rows must be a multiple of {block}"
            ));
        }
        let unit = Schedule::columns(block);
        let odd = |columns: &NonZeroU32| !columns.get().is_multiple_of(unit);
        if let Some(columns) = self.tile_columns.filter(odd) {
            return usage(&match unit {
                RUN => format!("--tile-columns {columns} is not a multiple of {unit}"),
                _ => format!(
                    "with --pixels-per-ray {pixels}, --tile-columns {columns} is not a multiple of {unit}"
                ),
            });
        }
        if self.walk != Walk::Ordered && !self.tree.is_octree() {
            return Err(Error::Usage(format!(
                "--walk {} is for --tree plain and --tree modified, not {}",
                self.walk.name(),
                self.tree.name()
            )));
        }
        let threads = match self.mpi {
            true if !cfg!(feature = "mpi") => return usage(NO_MPI),
            true if matches!(self.samples, Samples::Adaptive(_)) => {
                return usage(
                    "with --samples adaptive, tiles share rays, which ranks cannot: leave out --mpi",
                );
            }
            true if self.wire || self.frames.is_used() => {
                return usage(
                    "--mpi shares one picture of surfaces: leave out --wire, --frames and --path",
                );
            }
            true if self.threads.is_some_and(|threads| threads.get() > 1) => {
                return usage("with --mpi, a rank uses one thread; start more ranks instead");
            }
            true => Some(NonZeroUsize::MIN),
            false => self.threads,
        };
        let output = match self.output {
            Some(output) => output,
            None => {
                let name = files::named_after(&self.scene, ".png")?;
                Target::new(name).map_err(Error::Usage)?
            }
        };
        let (frames, orbit) = self.frames.job(&output)?;
        if frames.is_none() {
            files::distinct([&self.scene], [&output.path])?;
        }
        Ok(RenderJob {
            scene: self.scene,
            reduction: self.reduction.reduction(),
            output,
            ras_depth: self.ras_depth,
            settings: RenderSettings {
                arith: self.arith,
                tree: TreeSettings {
                    kind: self.tree,
                    depth: self.tree_depth,
                    leaf_size: self.leaf_size,
                    arena: self.arena,
                    link: self.link,
                    walk: self.walk,
                },
                size: self.size,
                orbit,
                pixels_per_ray: self.pixels_per_ray,
                max_depth: self.max_depth,
                cut_off: self.cut_off,
                ..RenderSettings::DEFAULT.with_samples(self.samples)
            },
            work: Schedule {
                threads: threads.unwrap_or(Schedule::default().threads),
                policy: self.schedule,
                tile: match (self.tile_rows, self.tile_columns) {
                    (None, None) => None,
                    (rows, columns) => Some(TileSize {
                        rows: rows.unwrap_or(Schedule::largest(block).rows),
                        columns,
                    }),
                },
                pin: self.pin,
            },
            mpi: self.mpi,
            wire: self.wire,
            frames,
            stats: self.stats,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;
    use octray_render::picture::Format;
    use octray_scenes::reduce::Reduction;
    use std::path::Path;

    #[derive(Debug, Parser)]
    struct TestCommand {
        #[command(flatten)]
        args: RenderArgs,
    }

    fn parse(line: &str) -> Result<RenderArgs, clap::Error> {
        let words = std::iter::once("render").chain(line.split_whitespace());
        TestCommand::try_parse_from(words).map(|line| line.args)
    }

    fn job(line: &str) -> RenderJob {
        parse(line).unwrap().job().unwrap()
    }

    #[test]
    fn the_defaults_are_the_documented_ones() {
        let job = job("folder/figure-19.scene");
        assert_eq!(job.scene, Path::new("folder/figure-19.scene"));
        assert_eq!(job.output.path, Path::new("figure-19.png"));
        assert_eq!(job.output.format, Format::Png);
        assert_eq!(job.reduction, Reduction::default());
        assert_eq!(job.ras_depth, RasDepth::Eight);
        assert_eq!(job.settings, RenderSettings::DEFAULT);
        assert_eq!(job.work, Schedule::default());
        assert_eq!(job.stats, StatsFormat::Text);
    }

    #[test]
    fn every_flag_reaches_the_job() {
        let job = job(
            "a.nff -o b.RAS --arith i16f16 --size 3x5 --ras-depth 24 --stats json --pixels-per-ray 1 \
             --samples 3 --max-depth 4 --cut-off 0 --tree plain --tree-depth 7 --leaf-size 1 --arena 9 \
             --lights 3 --opaque --orbit 12.5 --link box --walk links --threads 5 --schedule work-stealing --tile-rows 3 \
             --tile-columns 8 --pin",
        );
        assert_eq!(job.output.format, Format::Ras);
        assert_eq!(job.ras_depth, RasDepth::TwentyFour);
        let reduction = Reduction {
            lights: Some(3),
            opaque: true,
        };
        assert_eq!(job.reduction, reduction);
        assert_eq!(job.stats, StatsFormat::Json);
        let settings = RenderSettings {
            arith: Arith::I16F16,
            tree: TreeSettings {
                kind: TreeKind::Plain,
                depth: Some(7),
                leaf_size: NonZeroU32::new(1),
                arena: NonZeroUsize::new(9),
                link: Link::Box,
                walk: Walk::Links,
            },
            size: Some((3, 5)),
            orbit: 12.5,
            pixels_per_ray: PixelsPerRay::One,
            samples: 3,
            adaptive: None,
            max_depth: 4,
            cut_off: 0.0,
        };
        assert_eq!(job.settings, settings);
        let work = Schedule {
            threads: NonZeroUsize::new(5).unwrap(),
            policy: Policy::WorkStealing,
            tile: Some(TileSize {
                rows: NonZeroU32::new(3).unwrap(),
                columns: NonZeroU32::new(8),
            }),
            pin: true,
        };
        assert_eq!(job.work, work);
    }

    #[test]
    fn one_side_of_a_tile_is_enough() {
        let shape = |line| job(line).work.tile.map(|shape| shape.to_string());
        assert_eq!(shape("a.scene"), None);
        assert_eq!(shape("a.scene --tile-rows 9").as_deref(), Some("9 rows"));
        let tiles = shape("a.scene --tile-columns 24 --pixels-per-ray 9");
        assert_eq!(tiles.as_deref(), Some("24 x 18 pixels"));
        let tiles = shape("a.scene --tile-columns 24");
        assert_eq!(tiles.as_deref(), Some("24 x 16 pixels"));
        // The old names.
        let tiles = shape("a.scene --packet-columns 24 --packet-rows 3");
        assert_eq!(tiles.as_deref(), Some("24 x 3 pixels"));
    }

    #[test]
    fn values_out_of_range_are_bad_usage() {
        for flag in [
            "--threads 0",
            "--threads 65537",
            "--tile-rows 0",
            "--tile-columns 0",
            "--lights -1",
            "--lights all",
            "--samples 0",
            "--samples 65",
            "--size 0x1",
            "--size 65536x1",
            "--max-depth 65",
            "--max-depth -1",
            "--cut-off 1.5",
            "--leaf-size 0",
            "--arena 0",
            "--pixels-per-ray 2",
            "--arith f16",
            "--tree oak",
            "--schedule sometimes",
            "--ras-depth 16",
            "-o a.bmp",
            "-o a",
        ] {
            let error = parse(&format!("a.scene {flag}")).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{flag}");
        }
    }

    #[test]
    fn contradictions_are_bad_usage() {
        for flags in [
            "4 --samples 2",
            "4 --tile-rows 3",
            "4 --tile-columns 12",
            "9 --tile-rows 16",
            "9 --tile-columns 16",
            "1 --tile-columns 12",
        ] {
            let line = format!("a.scene --pixels-per-ray {flags}");
            let error = parse(&line).unwrap().job().unwrap_err();
            assert!(matches!(error, Error::Usage(_)), "{error}");
        }
        let line = "a.scene --walk neighbour --tree bvh8";
        let error = parse(line).unwrap().job().unwrap_err().to_string();
        assert!(
            error.contains("--walk neighbour is for --tree plain and --tree modified, not bvh8"),
            "{error}"
        );
    }

    #[test]
    fn ranks_trace_on_one_thread_and_only_with_mpi() {
        let asked = |flags| parse(&format!("a.scene --mpi {flags}")).unwrap().job();
        let message = |flags| asked(flags).unwrap_err().to_string();
        match cfg!(feature = "mpi") {
            true => {
                let job = asked("").unwrap();
                assert!(job.mpi && job.work.threads.get() == 1);
                assert!(message("--threads 2").contains("start more ranks"));
            }
            false => assert!(message("").contains("--features mpi"), "{}", message("")),
        }
    }
}
