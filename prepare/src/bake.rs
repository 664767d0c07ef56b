//! Baking: writes a scene, its tree and its picture as Rust source of constant tables, which stay in flash. The program
//! needs neither files nor an allocator.
//!
//! Numbers are written as bit patterns of the format, so nothing is rounded: the baked scene gives the same picture,
//! byte for byte, as the scene it was baked from.
//!
//! The source names `octray_core` and no other crate. It declares
//!
//! | name | what |
//! | --- | --- |
//! | `S`, `Tree` | the arithmetic; the tree's type, `Packed` or `List` |
//! | `FEATURES` | what the scene uses, for [`octray_core::features`] |
//! | `SCENE`, `TREE`, `FRAME` | the scene, its tree (unless the device builds it), its picture |
//! | `TRACER` | the scene and its tree with the limits for following rays |
//! | `MAX_DEPTH`, `CUT_OFF` | the limits for following rays |
//! | `WIDTH`, `HEIGHT`, `RAYS`, `LIGHTS`, `OBJECTS` | the sizes that its memory depends on |
//! | `TREE_WORDS`, `GROWTH` | only for a tree that the device builds: its size in words, and how it is built |
//! | `WORLD`, `place`, `length` | where the scene lies in the numbers of the format; a point, a length in its units |
//! | `BY_ID` | the objects in the order of the scene file |
//! | `SPHERES`, `CUBOIDS`, `LAMPS`, … | the tables, to be copied and changed |
//! | `NAME`, `ARITH` | the names of the scene and the format, for output |

mod script;
mod source;

pub use script::{Script, file};

use crate::dispatch::InFormat;
use crate::format::Format;
use crate::literal::Literal;
use crate::prepare::Prepare;
use crate::quantise::{Overflow, Prepared, TooFine};
use crate::settings::{RenderSettings, TreeKind};
use crate::tree::{Growth, every_object};
use octray_core::accel;
use octray_core::features::{self, FeatureSet};
use octray_core::object::ObjectKind;
use octray_core::scalar::Scalar;
use octray_core::scene::{Light, Surface};
use octray_core::vec3::Vec3;
use octray_scenes::model::Scene;
use thiserror::Error;

/// What to bake, beside the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakeOptions<'a> {
    /// The scene's name, for the program's output.
    pub name: &'a str,
    /// Arithmetic, tree and picture. The tree is [`TreeKind::CompactBvh8`] or [`TreeKind::None`]; `max_depth` limits
    /// the bounces of a ray.
    pub settings: RenderSettings,
    /// Whether the device builds the tree in its own memory; its size is computed while baking. If the scene has
    /// [`Scene::room`], the size is enough wherever objects move.
    pub on_device: bool,
    /// The target's triple, e.g. `thumbv6m-none-eabi`; it decides the leaf size unless the settings do.
    pub target: Option<&'a str>,
    /// The capacity for queued rays, if it is known to be enough; `None` takes the maximum that the scene's surfaces
    /// can queue.
    pub rays: Option<usize>,
}

impl<'a> BakeOptions<'a> {
    /// Returns options for a scene called `name` with these settings: the tree is built while baking, for a target on
    /// which hit tests are cheap.
    pub const fn new(name: &'a str, settings: RenderSettings) -> Self {
        Self {
            name,
            settings,
            on_device: false,
            target: None,
            rays: None,
        }
    }
}

/// A baked scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Baked {
    /// Rust source.
    pub source: String,
    /// The format; for `auto` the one that was chosen.
    pub format: Format,
    /// The features that the scene uses.
    pub features: FeatureSet,
    /// What the format is too coarse for, if anything: the picture may be wrong.
    pub too_fine: Option<TooFine>,
    /// Bytes of the tables, including links and nodes, on a 32-bit target.
    pub bytes: usize,
    /// The maximum number of queued rays.
    pub rays: usize,
    /// Words of the tree, whether it is baked or built by the device.
    pub words: usize,
    /// The maximum number of nodes on the traversal stack.
    pub nodes: usize,
}

/// Why a scene cannot be baked.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BakeError {
    /// The target supports no such tree.
    #[error("targets have the tree compact-bvh8 or none, not {}", .0.name())]
    Tree(TreeKind),
    /// The scene does not fit the format.
    #[error("{0}")]
    Overflow(Overflow),
    /// A compact BVH cannot hold that many objects.
    #[error("a compact BVH holds at most 32767 objects")]
    TooMany,
}

/// Bakes a scene.
///
/// # Errors
/// If the scene does not fit the format or the tree, or targets support no such tree.
pub fn bake(scene: &Scene, options: &BakeOptions<'_>) -> Result<Baked, BakeError> {
    struct Task<'a>(&'a Scene, &'a BakeOptions<'a>, Format);
    impl InFormat for Task<'_> {
        type Output = Result<Baked, BakeError>;
        fn run<S: Prepare>(self) -> Self::Output {
            bake_as::<S>(self.0, self.1, self.2)
        }
    }
    let settings = &options.settings;
    let format = settings.arith.format(scene, settings.max_depth);
    format.dispatch(Task(scene, options, format))
}

fn bake_as<S: Prepare>(
    scene: &Scene,
    options: &BakeOptions<'_>,
    format: Format,
) -> Result<Baked, BakeError> {
    let settings = &options.settings;
    let mut prepared = S::quantised(scene, settings).map_err(BakeError::Overflow)?;
    let too_fine = S::resolution(scene, settings).err();
    let growth = settings.tree.build_options(format, options.target);
    let grow = |scene: &mut _| {
        let growth = Growth {
            options: growth,
            arena: None,
        };
        S::compact_bvh8(scene, &growth)
            .map_err(|_| BakeError::TooMany)
            .map(|(tree, _)| tree)
    };
    let every = every_object(&prepared.scene);
    let (tree, links) = match (settings.tree.kind, options.on_device) {
        (TreeKind::None, _) => (source::Tree::None, every),
        (TreeKind::CompactBvh8, false) => {
            let tree = grow(&mut prepared.scene)?;
            let nodes = tree.tree().required_stack();
            (
                source::Tree::Packed(tree.words, tree.tick, nodes),
                tree.links,
            )
        }
        (TreeKind::CompactBvh8, true) => {
            // The device receives the objects in the order of the file.
            let words = grow(&mut prepared.scene.clone())?.words.len();
            let words = match scene.room {
                // However the objects move.
                Some(_) => accel::compact_words(scene.objects.len()),
                None => words,
            };
            (source::Tree::Device(words, growth), every)
        }
        (other, _) => return Err(BakeError::Tree(other)),
    };
    let features = features_of(&prepared, options.settings.max_depth);
    let rays = (options.rays).unwrap_or_else(|| room(&used_surfaces(&prepared), features, options));
    let tables = source::Tables {
        prepared: &prepared,
        tree,
        links: &links,
        features,
        rays,
        options,
    };
    Ok(Baked {
        too_fine,
        bytes: tables.bytes(),
        source: tables.to_string(),
        format,
        features,
        rays,
        words: tables.tree.room(),
        nodes: tables.tree.nodes(),
    })
}

/// Returns the features that the tracer needs for a scene with up to `max_depth` bounces.
fn features_of<S: Literal>(prepared: &Prepared<S>, max_depth: u32) -> FeatureSet {
    let scene = &prepared.scene;
    let shapes = scene.shapes();
    let mut set = 0;
    let mut need = |what: FeatureSet, if_so: bool| set |= if if_so { what } else { 0 };
    for kind in ObjectKind::ALL {
        need(features::of_kind(kind), shapes.count(kind) > 0);
    }
    need(features::BANDS, !scene.bands.is_empty());
    need(features::PATCHES, !scene.patches.is_empty());
    need(features::SHADOWS, !scene.lights.is_empty());
    let is_far = |light: &Light<S>| light.parallax.is_some();
    need(features::FAR_LIGHTS, scene.lights.iter().any(is_far));
    need(features::SKY, scene.sky.rise != Vec3::ZERO);
    for surface in used_surfaces(prepared) {
        need(features::CHECKERS, surface.checker != 0);
        let shines = surface.specular != Vec3::ZERO;
        need(features::SPECULAR, shines);
        need(
            features::FRACTIONS,
            shines && surface.shine.fraction != S::ZERO,
        );
        need(
            features::REFLECTION,
            surface.reflect != S::ZERO && max_depth > 0,
        );
        need(features::REFRACTION, surface.refract != S::ZERO);
    }
    set
}

fn used_surfaces<S: Literal>(prepared: &Prepared<S>) -> Vec<Surface<S>> {
    let scene = &prepared.scene;
    let mut used: Vec<u32> = (scene.attributes.iter().flatten())
        .map(|a| a.surface)
        .collect();
    used.sort_unstable();
    used.dedup();
    (used.iter())
        .filter_map(|&i| scene.surfaces.get(i as usize).copied())
        .collect()
}

/// Returns the maximum number of queued rays. A surface that only reflects queues one, which is traced next; one that
/// also transmits adds one per bounce.
fn room<S: Scalar + Literal>(
    surfaces: &[Surface<S>],
    features: FeatureSet,
    options: &BakeOptions<'_>,
) -> usize {
    let follows = |what| {
        features::contains(features, what) && options.settings.max_depth > 0 && !surfaces.is_empty()
    };
    match (follows(features::REFLECTION), follows(features::REFRACTION)) {
        (false, false) => 0,
        (true, false) | (false, true) => 1,
        (true, true) => {
            let share = (surfaces.iter())
                .map(|s| s.reflect.to_f64().max(s.refract.to_f64()))
                .fold(0.0, f64::max);
            // Rounding may make weights slightly larger.
            let mut weight = 1.001;
            let mut bounces = 0;
            while bounces < options.settings.max_depth && weight * share >= options.settings.cut_off
            {
                weight *= share * 1.001;
                bounces += 1;
            }
            bounces as usize + 1
        }
    }
}
