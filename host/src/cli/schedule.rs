//! Arguments of `octray schedule`.

use super::{files, value};
use crate::canvas;
use crate::deal::Policy;
use crate::error::Error;
use crate::packets::Shape;
use crate::picture::Target;
use crate::simulate::Machine;
use crate::sweep::SweepJob;
use clap::{Args, ValueEnum, value_parser};
use octray_engine::options::{Arith, DEEPEST, Link, PixelsPerRay, Tree, TreeOptions, ViewOptions};
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Arguments of `octray schedule`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Lists are such as 1,2,7 or 1..1024, which doubles: 1, 2, 4 and so on up to 1024. Costs are in instructions, \
estimated from counted events, and the same every time. The machine is ideal unless told otherwise.")]
pub struct ScheduleArgs {
    /// The scene file
    scene: PathBuf,
    /// Numbers of processors
    #[arg(long, value_name = "LIST", default_value = "1..1024", value_parser = value::doubling)]
    processors: value::Whole,
    /// Rows of packets that are strips
    #[arg(long, value_name = "LIST", default_value = "1..256", value_parser = value::doubling)]
    packet_rows: value::Whole,
    /// Sides of packets that are square tiles
    #[arg(long, value_name = "LIST", default_value = "4..256", value_parser = value::doubling)]
    tiles: value::Whole,
    /// Which processor gets which packet [default: all]
    #[arg(long, value_name = "HOW", value_enum, value_delimiter = ',')]
    policy: Vec<Policy>,
    /// Columns and rows; the framing stays [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    arith: Arith,
    /// Pixels that one ray colours; packets whose sides are odd are left out with 4
    #[arg(long, value_name = "N", value_enum, default_value_t)]
    pixels_per_ray: PixelsPerRay,
    /// Trace K x K rays per pixel
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = value_parser!(u32).range(1..=64))]
    samples: u32,
    /// How often a ray may bounce
    #[arg(long, value_name = "D", default_value_t = 8, value_parser = value_parser!(u32).range(..=i64::from(DEEPEST)))]
    max_depth: u32,
    /// The kind of octree
    #[arg(long, value_name = "KIND", value_enum, default_value_t)]
    tree: Tree,
    /// Instructions for which a packet that comes from others keeps them from handing out another
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    hand_out: f64,
    /// The same for each pixel of the packet, where pixels come back in messages
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    per_pixel: f64,
    /// Every packet for others than the first processor comes in a message from it, whatever the policy, as with
    /// 'octray render --mpi'
    #[arg(long)]
    messages: bool,
    /// By how much of itself each further busy processor slows all of them
    #[arg(long, value_name = "C", default_value = "0", value_parser = value::not_negative)]
    contention: f64,
    /// Instructions that one processor does before the others begin
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    serial: f64,
    /// Print one JSON object with every combination instead of a table of the best
    #[arg(long)]
    json: bool,
    /// Write every combination to a file
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Draw heat maps of packets by processors, and efficiency by processors: .svg, .png, .ppm or .ras
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ScheduleArgs {
    /// The job that these arguments ask for.
    ///
    /// # Errors
    /// [`Error::Usage`] when no packet is left with four pixels per ray, a result would replace the scene or
    /// another result, or the chart's name says nothing known.
    pub fn job(self) -> Result<SweepJob, Error> {
        let usage = |text: &str| Err(Error::Usage(text.into()));
        let results = [&self.output, &self.csv];
        files::distinct([&self.scene], results.into_iter().flatten())?;
        if let Some(path) = self.output.iter().find(|path| !canvas::is_svg(path)) {
            Target::new(path.clone()).map_err(Error::Usage)?;
        }
        let even = self.pixels_per_ray == PixelsPerRay::Four;
        let fits = |side: &NonZeroU32| !even || side.get().is_multiple_of(2);
        let strips = self.packet_rows.0.into_iter().filter(fits);
        let tiles = self.tiles.0.into_iter().filter(fits).map(Shape::tile);
        let shapes: Vec<_> = strips.map(Shape::strip).chain(tiles).collect();
        if shapes.is_empty() {
            return usage(
                "with --pixels-per-ray 4, a side of --packet-rows or --tiles must be even",
            );
        }
        let processors = self.processors.0.into_iter();
        Ok(SweepJob {
            scene: self.scene,
            processors: processors
                .filter_map(|count: NonZeroU32| NonZeroUsize::try_from(count).ok())
                .collect(),
            shapes,
            policies: match self.policy.is_empty() {
                true => Policy::value_variants().to_vec(),
                false => self.policy,
            },
            arith: self.arith,
            tree: TreeOptions {
                kind: self.tree,
                depth: None,
                leaf_size: None,
                arena: None,
                link: Link::Shape,
            },
            view: ViewOptions {
                size: self.size,
                pixels_per_ray: self.pixels_per_ray,
                samples: self.samples,
                max_depth: self.max_depth,
                cut_off: 1.0 / 512.0,
            },
            machine: Machine {
                hand_out: self.hand_out,
                contention: self.contention,
                serial: self.serial,
            },
            per_pixel: self.per_pixel,
            messages: self.messages,
            json: self.json,
            csv: self.csv,
            chart: self.output,
        })
    }
}
