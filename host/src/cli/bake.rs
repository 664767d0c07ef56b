//! Arguments of `octray bake`.

use super::value::{self, Room};
use super::{ReductionArgs, files};
use crate::bake::BakeJob;
use clap::{Args, value_parser};
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, FirmwareTree, PixelsPerRay, RenderSettings, TreeSettings};
use octray_render::error::Error;
use std::num::NonZeroU32;
use std::path::PathBuf;

/// Arguments of `octray bake`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
The source refers to no crate but octray_core. Include it in a module of its own.")]
pub struct BakeArgs {
    /// The scene file
    scene: PathBuf,
    /// The arithmetic to render in
    #[arg(long, value_name = "NAME", value_parser = value::choice::<Arith>(), default_value = Arith::Auto.name())]
    arith: Arith,
    /// Columns and rows; the framing stays [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    #[command(flatten)]
    reduction: ReductionArgs,
    /// Pixels that one ray colours
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name())]
    pixels_per_ray: PixelsPerRay,
    /// The tree to bake
    #[arg(long, value_name = "KIND", value_parser = value::choice::<FirmwareTree>(), default_value = FirmwareTree::default().name())]
    tree: FirmwareTree,
    /// Maximum number of bounces of a ray
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: u32,
    /// Do not trace rays of a smaller weight than this, from 0 to 1
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight)]
    cut_off: f64,
    /// Do not divide a node of up to N objects [default: depends on the target]
    #[arg(long, value_name = "N", value_parser = value::positive::<NonZeroU32>)]
    leaf_size: Option<NonZeroU32>,
    /// Leave room to move: two opposite corners of a box in which objects, lights and the viewpoint may be moved by the
    /// program [default: none]
    #[arg(long, value_name = "X,Y,Z,X,Y,Z", value_parser = value::room, allow_hyphen_values = true, verbatim_doc_comment)]
    room: Option<Room>,
    /// The target's triple, such as thumbv6m-none-eabi. Decides the leaf size, and whether --tree auto builds a tree
    /// [default: a target with a fast multiplier and, for floats, a floating-point unit]
    #[arg(long, alias = "targets", value_name = "TRIPLE", verbatim_doc_comment)]
    target: Option<String>,
    /// Take all of these options from a file that `octray plan --emit` wrote
    #[arg(long, value_name = "FILE", conflicts_with_all = ["arith", "size", "pixels_per_ray", "tree", "max_depth", "cut_off", "leaf_size", "target"])]
    plan: Option<PathBuf>,
    /// The Rust source [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl BakeArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if the output would replace the scene or the plan.
    pub fn job(self) -> Result<BakeJob, Error> {
        files::distinct(self.plan.iter().chain([&self.scene]), &self.output)?;
        Ok(BakeJob {
            scene: self.scene,
            reduction: self.reduction.reduction(),
            settings: RenderSettings {
                arith: self.arith,
                tree: TreeSettings {
                    leaf_size: self.leaf_size,
                    ..TreeSettings::default()
                },
                size: self.size,
                pixels_per_ray: self.pixels_per_ray,
                max_depth: self.max_depth,
                cut_off: self.cut_off,
                ..RenderSettings::DEFAULT
            },
            tree: self.tree,
            target: self.target,
            room: self.room,
            plan: self.plan,
            output: self.output,
        })
    }
}
