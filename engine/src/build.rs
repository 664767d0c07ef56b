//! A scene brought into its arithmetic, and the tree grown over it.

use crate::grown::Grown;
use crate::options::{Arith, Link, Tree, TreeOptions, ViewOptions};
use crate::ready::{Ready, intensity, level};
use crate::{Built, Engine, Octree};
use octray_core::accel::{self, BuildOptions, BuildStats, COMPACT_MAX_DEPTH, OctreeVariant};
use octray_core::quantize::Quantize;
use octray_core::scalar::{Approx, Fixed, Fixed64};
use octray_scenes::model::Scene;
use octray_scenes::quantise::{self, Overflow, Prepared, View};
use octray_scenes::saturation::PerThread;
use octray_scenes::tree::{Growth, OctantTree, PackedTree, TightTree, every_object};
use std::num::{NonZeroU32, NonZeroUsize};

/// Why a scene could not be made ready.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The scene does not fit the arithmetic.
    #[error(transparent)]
    Overflow(#[from] Overflow),
    /// More objects than a packed tree can link.
    #[error("a packed tree holds at most 32767 objects")]
    Objects,
    /// There is no arithmetic of this name.
    #[error("no arithmetic is called {0}")]
    Format(String),
}

/// Makes a scene ready.
///
/// # Errors
/// [`Error::Overflow`] or [`Error::Objects`] if the scene does not fit the arithmetic or the tree.
pub fn build(
    scene: &Scene,
    arith: Arith,
    tree: &TreeOptions,
    view: &ViewOptions,
) -> Result<Box<dyn Engine>, Error> {
    let request = Request { scene, tree, view };
    match arith {
        Arith::F64 => request.build::<f64>(),
        Arith::F32 => request.build::<f32>(),
        Arith::Approx0 => request.build::<Approx<0>>(),
        Arith::Approx1 => request.build::<Approx<1>>(),
        Arith::Approx2 => request.build::<Approx<2>>(),
        Arith::I24F8 => request.build::<Fixed<8, PerThread>>(),
        Arith::I20F12 => request.build::<Fixed<12, PerThread>>(),
        Arith::I16F16 => request.build::<Fixed<16, PerThread>>(),
        Arith::I12F20 => request.build::<Fixed<20, PerThread>>(),
        Arith::I8F24 => request.build::<Fixed<24, PerThread>>(),
        Arith::I4F28 => request.build::<Fixed<28, PerThread>>(),
        Arith::I32F32 => request.build::<Fixed64<PerThread>>(),
        Arith::Auto => build(scene, Arith::finest(scene, view.max_depth), tree, view),
    }
}

/// Makes a scene ready as small targets have it, with a packed tree or none: in any format that
/// [`octray_scenes::bake`] knows by name.
///
/// # Errors
/// [`Error::Overflow`] or [`Error::Objects`] if the scene does not fit the format or the tree,
/// [`Error::Format`] if the format is not known.
pub fn build_small(
    scene: &Scene,
    format: &str,
    tree: Option<BuildOptions>,
    view: &ViewOptions,
) -> Result<Box<dyn Engine>, Error> {
    let tree = &TreeOptions {
        kind: tree.map_or(Tree::None, |_| Tree::Packed),
        depth: tree.map(|options| options.depth),
        leaf_size: tree.and_then(|options| NonZeroU32::new(options.leaf_size)),
        arena: None,
        link: Link::Shape,
    };
    let request = Request { scene, tree, view };
    match format {
        "f64" => request.small::<f64>(),
        "f32" => request.small::<f32>(),
        "approx0" => request.small::<Approx<0>>(),
        "approx1" => request.small::<Approx<1>>(),
        "approx2" => request.small::<Approx<2>>(),
        "i24f8" => request.small::<Fixed<8, PerThread>>(),
        "i22f10" => request.small::<Fixed<10, PerThread>>(),
        "i20f12" => request.small::<Fixed<12, PerThread>>(),
        "i18f14" => request.small::<Fixed<14, PerThread>>(),
        "i16f16" => request.small::<Fixed<16, PerThread>>(),
        "i14f18" => request.small::<Fixed<18, PerThread>>(),
        "i12f20" => request.small::<Fixed<20, PerThread>>(),
        "i10f22" => request.small::<Fixed<22, PerThread>>(),
        "i8f24" => request.small::<Fixed<24, PerThread>>(),
        "i6f26" => request.small::<Fixed<26, PerThread>>(),
        "i4f28" => request.small::<Fixed<28, PerThread>>(),
        "i32f32" => request.small::<Fixed64<PerThread>>(),
        other => Err(Error::Format(other.into())),
    }
}

/// What is to be made ready, in whatever arithmetic.
struct Request<'a> {
    scene: &'a Scene,
    tree: &'a TreeOptions,
    view: &'a ViewOptions,
}

impl Request<'_> {
    /// The view as quantisation wants it.
    fn quantised_view(&self) -> View {
        View {
            size: self.view.size,
            pixels_per_ray: self.view.pixels_per_ray.number(),
            samples: self.view.samples,
            max_depth: self.view.max_depth,
        }
    }

    /// With any tree.
    fn build<S: Quantize>(&self) -> Result<Box<dyn Engine>, Error> {
        let variant = match self.tree.kind {
            Tree::Packed | Tree::None => return self.small::<S>(),
            Tree::Tight => None,
            Tree::Modified => Some(OctreeVariant::Modified),
            Tree::Plain => Some(OctreeVariant::Plain),
        };
        let mut prepared = self.prepare::<S>()?;
        let Some(variant) = variant else {
            let (tree, summary) = TightTree::build(&mut prepared.scene, &self.growth(24));
            return Ok(self.ready(prepared, tree, summary));
        };
        let link = match self.tree.link {
            Link::Shape => accel::LinkBy::Shape,
            Link::Box => accel::LinkBy::Box,
        };
        let growth = self.growth(8);
        let (tree, summary) = OctantTree::build(&mut prepared.scene, &growth, variant, link);
        Ok(self.ready(prepared, tree, summary))
    }

    /// With a packed tree, or none.
    fn small<S: Quantize>(&self) -> Result<Box<dyn Engine>, Error> {
        let mut prepared = self.prepare::<S>()?;
        if self.tree.kind == Tree::Packed {
            let (tree, summary) =
                PackedTree::build(&mut prepared.scene, &self.growth(COMPACT_MAX_DEPTH))
                    .map_err(|_| Error::Objects)?;
            return Ok(self.ready(prepared, tree, summary));
        }
        let all = every_object(&prepared.scene);
        let summary = BuildStats::of_list(all.len() as u32);
        Ok(self.ready(prepared, all, summary))
    }

    fn growth(&self, default_depth: u32) -> Growth {
        Growth {
            options: BuildOptions {
                depth: self.tree.depth.unwrap_or(default_depth),
                leaf_size: self.tree.leaf_size.map_or(2, NonZeroU32::get),
            },
            arena: self.tree.arena.map(NonZeroUsize::get),
        }
    }

    fn prepare<S: Quantize>(&self) -> Result<Prepared<S>, Error> {
        Ok(quantise::quantise(self.scene, &self.quantised_view())?)
    }

    fn ready<S: Quantize, T: Grown<S> + 'static>(
        &self,
        prepared: Prepared<S>,
        tree: T,
        summary: BuildStats,
    ) -> Box<dyn Engine> {
        let background = prepared.scene.background;
        let built = Built {
            format: S::NAME,
            scale: prepared.placement.exponent,
            too_fine: quantise::resolution::<S>(self.scene, &self.quantised_view())
                .err()
                .map(|fine| fine.to_string()),
            octree: Octree {
                kind: self.tree.kind,
                nodes: u64::from(summary.inner + summary.leaves),
                links: u64::from(summary.links),
                depth: summary.depth,
                unsplit: u64::from(summary.unsplit),
            },
            size: self
                .view
                .size
                .unwrap_or((self.scene.width, self.scene.height)),
            active: prepared.frame.active().clone(),
            block: prepared.frame.block(),
            background: (level(background), intensity(background)),
        };
        Box::new(Ready {
            prepared,
            tree,
            built,
            max_depth: self.view.max_depth,
            cut_off: S::from_f64(self.view.cut_off),
        })
    }
}
