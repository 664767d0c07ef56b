//! Arguments of `octray render`.

use super::{files, value};
use crate::deal::Policy;
use crate::error::Error;
use crate::job::{RenderJob, StatsFormat, WorkOptions};
use crate::packets::Shape;
use crate::packing;
use crate::picture::{RasDepth, Target};
use clap::{Args, value_parser};
use octray_engine::options::{Arith, DEEPEST, Link, PixelsPerRay, Tree, TreeOptions, ViewOptions};
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Arguments of `octray render`.
#[derive(Clone, Debug, Args)]
pub struct RenderArgs {
    /// The scene file
    scene: PathBuf,
    /// The picture: .png, .ppm, .pfm (float intensities) or .ras (Sun rasterfile)
    /// [default: the scene's name with .png, in the current folder]
    #[arg(short, long, value_name = "FILE", value_parser = value::target(), verbatim_doc_comment)]
    output: Option<Target>,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    arith: Arith,
    /// Columns and rows of the picture, each from 1 to 65535 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// Bits per pixel of a Sun rasterfile
    #[arg(long, value_name = "BITS", value_enum, default_value_t)]
    ras_depth: RasDepth,
    /// What to tell on standard output
    #[arg(long, value_name = "FORM", value_enum, default_value_t)]
    stats: StatsFormat,

    /// Pixels that one ray colours
    #[arg(long, value_name = "N", value_enum, default_value_t, help_heading = RAYS)]
    pixels_per_ray: PixelsPerRay,
    /// Trace K x K rays per pixel, and take their mean
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = value_parser!(u32).range(1..=64), help_heading = RAYS)]
    samples: u32,
    /// How often a ray may bounce
    #[arg(long, value_name = "D", default_value_t = 8, value_parser = value_parser!(u32).range(..=i64::from(DEEPEST)), help_heading = RAYS)]
    max_depth: u32,
    /// The weight, from 0 to 1, below which a ray is not traced
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight, help_heading = RAYS)]
    cut_off: f64,

    /// The kind of octree
    #[arg(long, value_name = "KIND", value_enum, default_value_t, help_heading = OCTREE)]
    tree: Tree,
    /// The deepest level of nodes, the root being level 0 [default: as suits the kind]
    #[arg(long, value_name = "D", value_parser = value_parser!(u32).range(0..=64), help_heading = OCTREE)]
    tree_depth: Option<u32>,
    /// Do not divide a node of up to N objects [default: as suits the kind]
    #[arg(long, value_name = "N", value_parser = value::positive::<NonZeroU32>, help_heading = OCTREE)]
    leaf_size: Option<NonZeroU32>,
    /// Room for that many nodes; a full arena makes slower, never wrong [default: as many as it takes]
    #[arg(long, value_name = "NODES", value_parser = value::positive::<NonZeroUsize>, help_heading = OCTREE)]
    arena: Option<NonZeroUsize>,
    /// How the plain and the modified tree link objects into octants
    #[arg(long, value_name = "BY", value_enum, default_value_t, help_heading = OCTREE)]
    link: Link,

    /// How many threads trace [default: one for each core; on each rank of --mpi one]
    #[arg(long, value_name = "N", value_parser = value::threads, help_heading = WORK)]
    threads: Option<NonZeroUsize>,
    /// Which thread gets which packet [default: chosen for the scene, told in the statistics]
    #[arg(long, value_name = "HOW", value_enum, help_heading = WORK)]
    schedule: Option<Policy>,
    /// Rows of a packet [default: chosen; 16 with --packet-columns]
    #[arg(long, value_name = "H", value_parser = value::positive::<NonZeroU32>, help_heading = WORK)]
    packet_rows: Option<NonZeroU32>,
    /// Columns of a packet [default: chosen; all with --packet-rows]
    #[arg(long, value_name = "W", value_parser = value::positive::<NonZeroU32>, help_heading = WORK)]
    packet_columns: Option<NonZeroU32>,
    /// Keep each thread on one core
    #[arg(long, help_heading = WORK)]
    pin: bool,
    /// Share the work among the ranks that mpirun has started, each on one thread
    #[arg(long, help_heading = WORK)]
    mpi: bool,
}

const RAYS: &str = "Rays";
const OCTREE: &str = "Octree";
const WORK: &str = "Threads";

const NO_MPI: &str = "this octray was built without MPI; install libopenmpi-dev and libclang-dev, and build it with \
    'cargo build --release --features mpi'";

impl RenderArgs {
    /// The job that these arguments ask for.
    ///
    /// # Errors
    /// [`Error::Usage`] when they contradict each other, or the picture would replace the scene.
    pub fn job(self) -> Result<RenderJob, Error> {
        let usage = |text: &str| Err(Error::Usage(text.into()));
        if self.pixels_per_ray == PixelsPerRay::Four {
            if self.samples > 1 {
                return usage("--pixels-per-ray 4 and --samples above 1 contradict each other");
            }
            let sides = [self.packet_rows, self.packet_columns];
            if sides.into_iter().flatten().any(|side| side.get() % 2 == 1) {
                return usage(
                    "with --pixels-per-ray 4, --packet-rows and --packet-columns must be even",
                );
            }
        }
        let threads = match self.mpi {
            true if !cfg!(feature = "mpi") => return usage(NO_MPI),
            true if self.threads.is_some_and(|threads| threads.get() > 1) => {
                return usage("with --mpi, a rank traces on one thread; start more ranks instead");
            }
            true => Some(NonZeroUsize::MIN),
            false => self.threads,
        };
        let output = match self.output {
            Some(output) => output,
            None => {
                let mut name = self.scene.file_stem().unwrap_or_default().to_owned();
                name.push(".png");
                Target::new(name.into()).map_err(Error::Usage)?
            }
        };
        files::distinct([&self.scene], [&output.path])?;
        Ok(RenderJob {
            scene: self.scene,
            output,
            ras_depth: self.ras_depth,
            arith: self.arith,
            tree: TreeOptions {
                kind: self.tree,
                depth: self.tree_depth,
                leaf_size: self.leaf_size,
                arena: self.arena,
                link: self.link,
            },
            view: ViewOptions {
                size: self.size,
                pixels_per_ray: self.pixels_per_ray,
                samples: self.samples,
                max_depth: self.max_depth,
                cut_off: self.cut_off,
            },
            work: WorkOptions {
                threads: threads.unwrap_or(WorkOptions::default().threads),
                policy: self.schedule,
                packet: match (self.packet_rows, self.packet_columns) {
                    (None, None) => None,
                    (rows, columns) => Some(Shape {
                        rows: rows.unwrap_or(packing::FIXED.1.rows),
                        columns,
                    }),
                },
                pin: self.pin,
                mpi: self.mpi,
            },
            stats: self.stats,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Format;
    use clap::Parser;
    use std::path::Path;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        args: RenderArgs,
    }

    fn parse(line: &str) -> Result<RenderArgs, clap::Error> {
        let words = std::iter::once("render").chain(line.split_whitespace());
        Line::try_parse_from(words).map(|line| line.args)
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
        assert_eq!(job.ras_depth, RasDepth::Eight);
        assert_eq!(job.arith, Arith::F32);
        assert_eq!(job.tree.kind, Tree::Tight);
        assert_eq!(job.tree.link, Link::Shape);
        assert_eq!(job.view.size, None);
        assert_eq!(job.view.pixels_per_ray, PixelsPerRay::One);
        assert_eq!((job.view.samples, job.view.max_depth), (1, 8));
        assert_eq!(job.view.cut_off, 1.0 / 512.0);
        assert_eq!(job.work, WorkOptions::default());
        assert_eq!(job.stats, StatsFormat::Text);
    }

    #[test]
    fn every_flag_reaches_the_job() {
        let job = job(
            "a.nff -o b.RAS --arith i16f16 --size 3x5 --ras-depth 24 --stats json --pixels-per-ray 1 \
             --samples 3 --max-depth 4 --cut-off 0 --tree plain --tree-depth 7 --leaf-size 1 --arena 9 \
             --link box --threads 5 --schedule work-stealing --packet-rows 3 --packet-columns 8 --pin",
        );
        assert_eq!(job.output.format, Format::Ras);
        assert_eq!(job.ras_depth, RasDepth::TwentyFour);
        assert_eq!((job.arith, job.stats), (Arith::I16F16, StatsFormat::Json));
        let view = ViewOptions {
            size: Some((3, 5)),
            pixels_per_ray: PixelsPerRay::One,
            samples: 3,
            max_depth: 4,
            cut_off: 0.0,
        };
        assert_eq!(job.view, view);
        let tree = TreeOptions {
            kind: Tree::Plain,
            depth: Some(7),
            leaf_size: NonZeroU32::new(1),
            arena: NonZeroUsize::new(9),
            link: Link::Box,
        };
        assert_eq!(job.tree, tree);
        let work = WorkOptions {
            threads: NonZeroUsize::new(5).unwrap(),
            policy: Some(Policy::WorkStealing),
            packet: Some(Shape {
                rows: NonZeroU32::new(3).unwrap(),
                columns: NonZeroU32::new(8),
            }),
            pin: true,
            mpi: false,
        };
        assert_eq!(job.work, work);
    }

    #[test]
    fn one_side_of_a_packet_is_enough() {
        let shape = |line| job(line).work.packet.map(|shape| shape.to_string());
        assert_eq!(shape("a.scene"), None);
        assert_eq!(shape("a.scene --packet-rows 9").as_deref(), Some("9 rows"));
        let tiles = shape("a.scene --packet-columns 9");
        assert_eq!(tiles.as_deref(), Some("9 x 16 pixels"));
    }

    #[test]
    fn values_out_of_range_are_bad_usage() {
        for flag in [
            "--threads 0",
            "--threads 65537",
            "--packet-rows 0",
            "--packet-columns 0",
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
        for flags in ["--samples 2", "--packet-rows 3", "--packet-columns 5"] {
            let line = format!("a.scene --pixels-per-ray 4 {flags}");
            let error = parse(&line).unwrap().job().unwrap_err();
            assert!(matches!(error, Error::Usage(_)), "{error}");
        }
    }

    #[test]
    fn ranks_trace_on_one_thread_and_only_with_mpi() {
        let asked = |flags| parse(&format!("a.scene --mpi {flags}")).unwrap().job();
        let told = |flags| asked(flags).unwrap_err().to_string();
        match cfg!(feature = "mpi") {
            true => {
                let work = asked("").unwrap().work;
                assert!(work.mpi && work.threads.get() == 1);
                assert!(told("--threads 2").contains("start more ranks"));
            }
            false => assert!(told("").contains("--features mpi"), "{}", told("")),
        }
    }
}
