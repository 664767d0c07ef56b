//! Arguments of `octray bake`.

use super::{files, value};
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
The source names the crate octray_core alone; include it in a module of its own.")]
pub struct BakeArgs {
    /// The scene file
    scene: PathBuf,
    /// The arithmetic to render in
    #[arg(long, value_name = "NAME", value_parser = value::choice::<Arith>(), default_value = Arith::Auto.name())]
    arith: Arith,
    /// Columns and rows; the framing stays [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// Pixels that one ray colours: 1, or 4 in squares of two by two
    #[arg(long, value_name = "N", value_parser = value::choice::<PixelsPerRay>(), default_value = PixelsPerRay::default().name())]
    pixels_per_ray: PixelsPerRay,
    /// The tree to bake
    #[arg(long, value_name = "KIND", value_parser = value::choice::<FirmwareTree>(), default_value = FirmwareTree::default().name())]
    tree: FirmwareTree,
    /// How often a ray may bounce
    #[arg(long, value_name = "D", default_value_t = RenderSettings::DEFAULT.max_depth, value_parser = value_parser!(u32).range(..=i64::from(RenderSettings::DEEPEST)))]
    max_depth: u32,
    /// The weight below which a ray is not traced
    #[arg(long, value_name = "C", default_value = "1/512", value_parser = value::weight)]
    cut_off: f64,
    /// Objects up to which a node of the tree is not divided [default: as suits the target]
    #[arg(long, value_name = "N", value_parser = value::positive::<NonZeroU32>)]
    leaf_size: Option<NonZeroU32>,
    /// The target's triple, such as thumbv6m-none-eabi: decides the leaf size, and whether a tree pays with --tree auto
    /// [default: one with a fast multiplier and, for floats, a floating-point unit]
    #[arg(long, alias = "targets", value_name = "TRIPLE", verbatim_doc_comment)]
    target: Option<String>,
    /// All of this as `octray plan --emit` has written it
    #[arg(long, value_name = "FILE", conflicts_with_all = ["arith", "size", "pixels_per_ray", "tree", "max_depth", "cut_off", "leaf_size", "target"])]
    plan: Option<PathBuf>,
    /// The Rust source [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl BakeArgs {
    /// The job that these arguments ask for.
    ///
    /// # Errors
    /// [`Error::Usage`] if the output would replace the scene or the plan.
    pub fn job(self) -> Result<BakeJob, Error> {
        files::distinct(self.plan.iter().chain([&self.scene]), &self.output)?;
        Ok(BakeJob {
            scene: self.scene,
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
            plan: self.plan,
            output: self.output,
        })
    }
}
