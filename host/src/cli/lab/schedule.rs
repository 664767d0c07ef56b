//! Arguments of `octray schedule`.

use super::lists;
use crate::cli::{ReductionArgs, files, value};
use clap::{Args, value_parser};
use octray_lab::canvas;
use octray_lab::schedule::ScheduleJob;
use octray_lab::simulate::Machine;
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, PixelsPerRay, RenderSettings, TreeKind, TreeSettings};
use octray_render::error::Error;
use octray_render::scheduler::Policy;
use octray_render::tile::TileSize;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Arguments of `octray schedule`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Lists are numbers such as 1,2,7, or 1..1024, which doubles: 1, 2, 4 and so on up to 1024. Costs are instructions, \
estimated from counted events, and the same in every run. By default the machine is ideal.")]
pub struct ScheduleArgs {
    /// The scene file
    scene: PathBuf,
    /// Numbers of processors
    #[arg(long, value_name = "LIST", default_value = "1..1024", value_parser = lists::doubling)]
    processors: lists::Whole,
    /// Heights of strips in rows
    #[arg(long, alias = "packet-rows", value_name = "LIST", default_value = "1..256", value_parser = lists::doubling)]
    tile_rows: lists::Whole,
    /// Sides of square tiles
    #[arg(long, alias = "tiles", value_name = "LIST", default_value = "4..256", value_parser = lists::doubling)]
    tile_sides: lists::Whole,
    /// How tiles are assigned to processors [default: all schedules]
    #[arg(long, alias = "policy", value_name = "HOW", value_parser = value::choice::<Policy>(), value_delimiter = ',')]
    schedule: Vec<Policy>,
    /// Columns and rows; the framing stays the same [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_parser = value::choice::<Arith>(), default_value = Arith::default().name())]
    arith: Arith,
    /// Pixels that one ray colours; tiles that would cut such a square are left out
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name())]
    pixels_per_ray: PixelsPerRay,
    /// Trace K x K rays per pixel
    #[arg(long, value_name = "K", default_value = "1", value_parser = value::uniform_samples)]
    samples: u32,
    /// Maximum number of bounces of a ray
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: u32,
    /// The accelerator
    #[arg(long, value_name = "KIND", value_parser = value::choice::<TreeKind>(), default_value = TreeKind::default().name())]
    tree: TreeKind,
    #[command(flatten)]
    reduction: ReductionArgs,
    /// Instructions for which handing out a tile from a shared queue blocks the other processors
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    hand_out: f64,
    /// Additional instructions for each pixel of the tile, if pixels are returned in messages
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    per_pixel: f64,
    /// The first processor hands out every tile of the others in a message, whatever the schedule, as 'octray render
    /// --mpi' does
    #[arg(long)]
    messages: bool,
    /// Slowdown of all processors per further busy processor, as a fraction
    #[arg(long, value_name = "C", default_value = "0", value_parser = value::not_negative)]
    contention: f64,
    /// Slowdown of all processors per pair of busy processors and direction, as a fraction: the speed-up has a peak
    #[arg(long, value_name = "K", default_value = "0", value_parser = value::not_negative)]
    coherence: f64,
    /// Instructions that one processor executes before the others begin
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    serial: f64,
    /// Print one JSON object with every combination instead of a table of the best ones
    #[arg(long)]
    json: bool,
    /// Write every combination to a file
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Draw heat maps of tiles against processors, and efficiency against processors: .svg, .png, .ppm or .ras
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ScheduleArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if no tile is left with so many pixels per ray, if a result would replace the scene or another
    /// result, or if the chart's extension is unknown.
    pub fn job(self) -> Result<ScheduleJob, Error> {
        let usage = |text: &str| Err(Error::Usage(text.into()));
        let results = [&self.output, &self.csv];
        files::distinct([&self.scene], results.into_iter().flatten())?;
        self.output
            .iter()
            .try_for_each(|path| canvas::check_name(path))?;
        let block = self.pixels_per_ray.side();
        let fits = |side: &NonZeroU32| side.get().is_multiple_of(block);
        let strips = self.tile_rows.0.into_iter().filter(fits);
        let tiles = self
            .tile_sides
            .0
            .into_iter()
            .filter(fits)
            .map(TileSize::tile);
        let shapes: Vec<_> = strips.map(TileSize::strip).chain(tiles).collect();
        if shapes.is_empty() {
            return usage(&format!(
                "with --pixels-per-ray {}, a side of --tile-rows or --tile-sides must be a multiple of {block}",
                self.pixels_per_ray.number()
            ));
        }
        let processors = self.processors.0.into_iter();
        Ok(ScheduleJob {
            scene: self.scene,
            reduction: self.reduction.reduction(),
            processors: processors
                .filter_map(|count: NonZeroU32| NonZeroUsize::try_from(count).ok())
                .collect(),
            shapes,
            policies: match self.schedule.is_empty() {
                true => Policy::all(),
                false => self.schedule,
            },
            settings: RenderSettings {
                arith: self.arith,
                tree: TreeSettings::of(self.tree),
                size: self.size,
                pixels_per_ray: self.pixels_per_ray,
                samples: self.samples,
                max_depth: self.max_depth,
                ..RenderSettings::DEFAULT
            },
            machine: Machine {
                hand_out: self.hand_out,
                contention: self.contention,
                coherence: self.coherence,
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
