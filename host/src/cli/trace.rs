//! Arguments of `octray trace`.

use super::{ReductionArgs, files, value};
use crate::trace::{TraceFormat, TraceJob};
use clap::{Args, value_parser};
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, Link, PixelsPerRay, RenderSettings, TreeKind, TreeSettings};
use octray_render::error::Error;
use octray_scenes::{input, name};
use std::path::PathBuf;

/// Arguments of `octray trace`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Each ray is told with the object that it meets (its kind, its number in the scene file and the line on which it begins), \
how far away that is, the share of its light that reaches the picture, and the nodes visited and objects tested on the \
way. Below it are the lights that the surface faces, lit or blocked, and the rays that follow. The colour is the picture's. \
With two arithmetics, a mark shows where one meets another object, or sees a light that the other does not.")]
pub struct TraceArgs {
    /// The scene file
    scene: PathBuf,
    /// Column and row, counted from 0 at the upper left corner
    #[arg(short, long, value_name = "X,Y", value_parser = value::pixel)]
    pixel: (u32, u32),
    /// The arithmetic to trace in, or two to compare
    #[arg(long, value_name = "A[,B]", value_delimiter = ',', value_parser = value::choice::<Arith>(), default_value = Arith::default().name())]
    arith: Vec<Arith>,
    /// Tell the surfaces along the rays of the camera instead, as if they were not there, up to 65; of those at one place, one
    #[arg(long)]
    through: bool,
    /// The form of the tree [default: text; svg or json if the output's name ends so]
    #[arg(long, value_name = "FORM", value_parser = value::choice::<TraceFormat>())]
    format: Option<TraceFormat>,
    /// Where to write it [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Columns and rows of the picture, each from 1 to 65535 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    #[command(flatten)]
    reduction: ReductionArgs,
    /// Pixels that one ray colours
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name())]
    pixels_per_ray: PixelsPerRay,
    /// Trace K x K rays for the pixel
    #[arg(long, value_name = "K", default_value = "1", value_parser = value::uniform_samples)]
    samples: u32,
    /// Maximum number of bounces of a ray
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: u32,
    /// Do not trace rays of a smaller weight than this, from 0 to 1
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight)]
    cut_off: f64,
    /// The accelerator; all kinds give the same tree with other numbers of nodes and tests
    #[arg(long, value_name = "KIND", value_parser = value::choice::<TreeKind>(), default_value = TreeKind::default().name())]
    tree: TreeKind,
    /// How the plain and the modified octree assign objects to their cells
    #[arg(long, value_name = "BY", value_parser = value::choice::<Link>(), default_value = Link::default().name())]
    link: Link,
}

impl TraceArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if they contradict each other, more than two arithmetics are given, or the output would replace
    /// the scene.
    pub fn job(self) -> Result<TraceJob, Error> {
        if self.arith.len() > 2 {
            return Err(Error::Usage(
                "--arith takes one arithmetic, or two to compare".into(),
            ));
        }
        if self.pixels_per_ray != PixelsPerRay::One && self.samples > 1 {
            return Err(Error::Usage(
                "--pixels-per-ray and --samples, both above 1, contradict each other".into(),
            ));
        }
        let scene = (!input::is_stdin(&self.scene)).then_some(&self.scene);
        files::distinct(scene, &self.output)?;
        let extension = (self.output.as_ref())
            .and_then(|path| path.extension())
            .map(|extension| extension.to_string_lossy().to_lowercase());
        let format = match (self.format, extension.as_deref()) {
            (Some(format), _) => format,
            (None, None | Some("txt")) => TraceFormat::Text,
            (None, Some(extension)) => TraceFormat::named(extension).ok_or_else(|| {
                Error::Usage(format!(
                    "'.{}' is no form of the tree: expected '.txt', '.json' or '.svg', or --format",
                    name::line(extension)
                ))
            })?,
        };
        if self.through && format == TraceFormat::Svg {
            return Err(Error::Usage("--through is told as text or json".into()));
        }
        Ok(TraceJob {
            scene: self.scene,
            reduction: self.reduction.reduction(),
            pixel: self.pixel,
            settings: RenderSettings {
                tree: TreeSettings {
                    link: self.link,
                    ..TreeSettings::of(self.tree)
                },
                size: self.size,
                pixels_per_ray: self.pixels_per_ray,
                samples: self.samples,
                max_depth: self.max_depth,
                cut_off: self.cut_off,
                ..RenderSettings::DEFAULT
            },
            ariths: self.arith,
            through: self.through,
            format,
            output: self.output,
        })
    }
}
