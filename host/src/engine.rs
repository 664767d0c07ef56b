//! A scene made ready to be traced: one face for every arithmetic and every tree.
//!
//! Arithmetic and tree are chosen at run time among all that are compiled in, and only here, so that each
//! pair of them is compiled once, whoever traces: `octray render`, the simulation of schedules, the ranks
//! of a distributed rendering.

use crate::error::Error;
use crate::job::{Arith, Link, Tree, TreeOptions, ViewOptions};
use crate::packets::Packet;
use crate::picture::{Intensity, Level};
use crate::stats::Octree;
use octray_core::observe::Counters;
use octray_core::octree::{
    self, Accelerator, List, Octants, Options, Packed, Plane, Summary, Tight, Variant,
};
use octray_core::packet::Region;
use octray_core::scalar::{Approx, Fixed, Fixed64, Quantize};
use octray_core::shape::ObjectRef;
use octray_core::trace::{Pending, Tracer, Workspace};
use octray_core::vec3::Vec3;
use octray_scenes::model::Scene;
use octray_scenes::quantise::{self, Prepared, View};
use octray_scenes::tree::{Growth, OctantTree, PackedTree, TightTree, every_object};
use std::num::{NonZeroU32, NonZeroUsize};

/// A scene in one arithmetic, with one tree.
pub trait Engine: Send + Sync {
    /// What there is to know of it.
    fn built(&self) -> &Built;

    /// Somebody who traces parts of the picture, for one thread.
    fn worker(&self) -> Box<dyn Worker + '_>;
}

/// Traces parts of a picture, one after the other, and counts.
pub trait Worker: Send {
    /// Fills a packet: its pixels, and the background where nothing is to be seen.
    fn trace(&mut self, packet: Packet<'_>);

    /// Traces some pixels only to count what they cost. What it learnt of the scene before is kept, so pixel
    /// by pixel costs what all of them at once do.
    fn probe(&mut self, region: &Region);

    /// What the camera's rays through the blocks that begin in a row meet first, from left to right; the
    /// samples of a block follow each other.
    fn first_hits(&mut self, row: u32) -> Vec<Option<FirstHit>>;

    /// What was counted so far.
    fn counters(&self) -> &Counters;
}

/// What a ray of the camera meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// The object's place in the scene file, counted from 0.
    pub object: u32,
    /// How far away, in units of the scene file.
    pub distance: f64,
}

/// What there is to know of a scene that was made ready.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    /// The number format, e.g. `i16f16`.
    pub format: &'static str,
    /// The scene was scaled by 2 to this power.
    pub scale: i32,
    /// What the format is too coarse for, if anything.
    pub too_fine: Option<String>,
    /// The octree.
    pub octree: Octree,
    /// Columns and rows of the picture.
    pub size: (u32, u32),
    /// The pixels that may show anything but background.
    pub active: Region,
    /// The side of the square of pixels that one ray colours, 1 or 2.
    pub block: u32,
    /// The background.
    pub background: (Level, Intensity),
}

impl Built {
    /// What packets are cut of: the rows that may show anything but background, whole.
    pub fn region(&self) -> Region {
        Region {
            columns: 0..self.size.0,
            rows: self.active.rows.clone(),
        }
    }
}

/// Makes a scene ready.
///
/// # Errors
/// [`Error::Failed`] if the scene does not fit the arithmetic or the tree.
pub fn build(
    scene: &Scene,
    arith: Arith,
    tree: &TreeOptions,
    view: &ViewOptions,
) -> Result<Box<dyn Engine>, Error> {
    let plan = Plan { scene, tree, view };
    match arith {
        Arith::F64 => plan.build::<f64>(),
        Arith::F32 => plan.build::<f32>(),
        Arith::Approx0 => plan.build::<Approx<0>>(),
        Arith::Approx1 => plan.build::<Approx<1>>(),
        Arith::Approx2 => plan.build::<Approx<2>>(),
        Arith::I24F8 => plan.build::<Fixed<8, true>>(),
        Arith::I20F12 => plan.build::<Fixed<12, true>>(),
        Arith::I16F16 => plan.build::<Fixed<16, true>>(),
        Arith::I12F20 => plan.build::<Fixed<20, true>>(),
        Arith::I8F24 => plan.build::<Fixed<24, true>>(),
        Arith::I4F28 => plan.build::<Fixed<28, true>>(),
        Arith::I32F32 => plan.build::<Fixed64>(),
        Arith::Auto if plan.fits::<Fixed<28, true>>() => plan.build::<Fixed<28, true>>(),
        Arith::Auto if plan.fits::<Fixed<24, true>>() => plan.build::<Fixed<24, true>>(),
        Arith::Auto if plan.fits::<Fixed<20, true>>() => plan.build::<Fixed<20, true>>(),
        Arith::Auto if plan.fits::<Fixed<16, true>>() => plan.build::<Fixed<16, true>>(),
        Arith::Auto if plan.fits::<Fixed<12, true>>() => plan.build::<Fixed<12, true>>(),
        Arith::Auto => plan.build::<Fixed<8, true>>(),
    }
}

/// Makes a scene ready as small targets have it, with a packed tree or none: in any format that
/// [`octray_scenes::bake`] knows by name but approximate and 64-bit fixed ones.
///
/// # Errors
/// [`Error::Failed`] if the scene does not fit the format or the tree, or the format is not known.
pub fn build_small(
    scene: &Scene,
    format: &str,
    tree: Option<Options>,
    view: &ViewOptions,
) -> Result<Box<dyn Engine>, Error> {
    let tree = &TreeOptions {
        kind: tree.map_or(Tree::None, |_| Tree::Packed),
        depth: tree.map(|options| options.depth),
        leaf_size: tree.and_then(|options| NonZeroU32::new(options.leaf_size)),
        arena: None,
        link: Link::Shape,
    };
    let plan = Plan { scene, tree, view };
    match format {
        "f64" => plan.small::<f64>(),
        "f32" => plan.small::<f32>(),
        "i24f8" => plan.small::<Fixed<8, true>>(),
        "i22f10" => plan.small::<Fixed<10, true>>(),
        "i20f12" => plan.small::<Fixed<12, true>>(),
        "i18f14" => plan.small::<Fixed<14, true>>(),
        "i16f16" => plan.small::<Fixed<16, true>>(),
        "i14f18" => plan.small::<Fixed<18, true>>(),
        "i12f20" => plan.small::<Fixed<20, true>>(),
        "i10f22" => plan.small::<Fixed<22, true>>(),
        "i8f24" => plan.small::<Fixed<24, true>>(),
        "i6f26" => plan.small::<Fixed<26, true>>(),
        "i4f28" => plan.small::<Fixed<28, true>>(),
        other => Err(Error::Failed(format!("no small target has {other}"))),
    }
}

/// What is to be made ready, in whatever arithmetic.
struct Plan<'a> {
    scene: &'a Scene,
    tree: &'a TreeOptions,
    view: &'a ViewOptions,
}

impl Plan<'_> {
    /// Whether the scene cannot overflow format `S`.
    fn fits<S: Quantize>(&self) -> bool {
        quantise::limits::<S>(self.scene, self.view.max_depth).is_ok()
    }

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
            Tree::Modified => Some(Variant::Modified),
            Tree::Plain => Some(Variant::Plain),
        };
        let mut prepared = self.prepare::<S>()?;
        let Some(variant) = variant else {
            let (tree, summary) = TightTree::build(&mut prepared.scene, &self.growth(24));
            return Ok(self.ready(prepared, tree, summary));
        };
        let link = match self.tree.link {
            Link::Shape => octree::Link::Shape,
            Link::Box => octree::Link::Box,
        };
        let growth = self.growth(8);
        let (tree, summary) = OctantTree::build(&mut prepared.scene, &growth, variant, link);
        Ok(self.ready(prepared, tree, summary))
    }

    /// With a packed tree, or none.
    fn small<S: Quantize>(&self) -> Result<Box<dyn Engine>, Error> {
        let mut prepared = self.prepare::<S>()?;
        if self.tree.kind == Tree::Packed {
            let (tree, summary) = PackedTree::build(&mut prepared.scene, &self.growth(24))
                .map_err(|_| Error::Failed("a packed tree holds at most 32767 objects".into()))?;
            return Ok(self.ready(prepared, tree, summary));
        }
        let all = every_object(&prepared.scene);
        let summary = Summary {
            links: all.len() as u32,
            ..Summary::default()
        };
        Ok(self.ready(prepared, all, summary))
    }

    fn growth(&self, default_depth: u32) -> Growth {
        Growth {
            options: Options {
                depth: self.tree.depth.unwrap_or(default_depth),
                leaf_size: self.tree.leaf_size.map_or(2, NonZeroU32::get),
            },
            arena: self.tree.arena.map(NonZeroUsize::get),
        }
    }

    fn prepare<S: Quantize>(&self) -> Result<Prepared<S>, Error> {
        quantise::quantise::<S>(self.scene, &self.quantised_view())
            .map_err(|overflow| Error::Failed(overflow.to_string()))
    }

    fn ready<S: Quantize, T: Grown<S> + 'static>(
        &self,
        prepared: Prepared<S>,
        tree: T,
        summary: Summary,
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

/// A tree in memory of its own.
trait Grown<S: Quantize>: Send + Sync {
    /// The tree as the tracer sees it.
    type View<'a>: Accelerator<S> + Send
    where
        Self: 'a;

    fn view(&self) -> Self::View<'_>;
}

impl<S: Quantize<Plane = P>, P: Plane> Grown<S> for TightTree<P> {
    type View<'a> = Tight<'a, P>;

    fn view(&self) -> Tight<'_, P> {
        self.tree()
    }
}

impl<S: Quantize> Grown<S> for PackedTree {
    type View<'a> = Packed<'a>;

    fn view(&self) -> Packed<'_> {
        self.tree()
    }
}

impl<S: Quantize<Plane = P>, P: Plane> Grown<S> for OctantTree<P> {
    type View<'a> = Octants<'a, P>;

    fn view(&self) -> Octants<'_, P> {
        self.tree()
    }
}

/// No tree: every object.
impl<S: Quantize> Grown<S> for Vec<ObjectRef> {
    type View<'a> = List<'a>;

    fn view(&self) -> List<'_> {
        List(self)
    }
}

/// A scene in arithmetic `S` with a tree.
struct Ready<S: Quantize, T> {
    prepared: Prepared<S>,
    tree: T,
    built: Built,
    max_depth: u32,
    cut_off: S,
}

impl<S: Quantize, T: Grown<S>> Engine for Ready<S, T> {
    fn built(&self) -> &Built {
        &self.built
    }

    fn worker(&self) -> Box<dyn Worker + '_> {
        let scene = &self.prepared.scene;
        Box::new(Tracing {
            ready: self,
            tree: self.tree.view(),
            rays: vec![Pending::EMPTY; self.max_depth as usize + 2],
            stack: Default::default(),
            blockers: vec![None; scene.lights.len()],
            counters: Counters::default(),
        })
    }
}

/// What one thread traces with.
struct Tracing<'a, S: Quantize, T: Grown<S>> {
    ready: &'a Ready<S, T>,
    tree: T::View<'a>,
    rays: Vec<Pending<S>>,
    stack: Stack<'a, S, T>,
    blockers: Vec<Option<ObjectRef>>,
    counters: Counters,
}

/// What the walk through a tree needs.
type Stack<'a, S, T> = <<T as Grown<S>>::View<'a> as Accelerator<S>>::Stack;

impl<'a, S: Quantize, T: Grown<S>> Tracing<'a, S, T> {
    /// Does something with what it takes to trace a ray.
    fn with<R>(
        &mut self,
        work: impl FnOnce(
            &Tracer<'_, S, T::View<'a>>,
            &mut Workspace<'_, S, Stack<'a, S, T>>,
            &mut Counters,
        ) -> R,
    ) -> R {
        let scene = self.ready.prepared.scene.scene();
        let tracer = Tracer {
            scene: &scene,
            accelerator: &self.tree,
            max_depth: self.ready.max_depth,
            cut_off: self.ready.cut_off,
        };
        let mut workspace = Workspace {
            rays: &mut self.rays,
            stack: &mut self.stack,
            blockers: &mut self.blockers,
        };
        work(&tracer, &mut workspace, &mut self.counters)
    }

    fn render(&mut self, region: &Region, put: impl FnMut(u32, u32, Vec3<S>)) {
        let frame = &self.ready.prepared.frame;
        self.with(|tracer, workspace, counters| {
            frame.render_region(region, tracer, workspace, counters, put);
        });
    }
}

impl<S: Quantize, T: Grown<S>> Worker for Tracing<'_, S, T> {
    fn trace(&mut self, packet: Packet<'_>) {
        let Packet {
            region,
            mut levels,
            mut intensities,
        } = packet;
        let background = self.ready.built.background;
        levels.iter_mut().for_each(|row| row.fill(background.0));
        for row in intensities.iter_mut().flatten() {
            row.fill(background.1);
        }
        // What blocked the lights last in another packet must not change what is counted in this one.
        self.blockers.fill(None);
        let (left, top) = (region.columns.start, region.rows.start);
        self.render(&region, |x, y, colour| {
            let (row, column) = ((y - top) as usize, (x - left) as usize);
            levels[row][column] = level(colour);
            if let Some(intensities) = &mut intensities {
                intensities[row][column] = intensity(colour);
            }
        });
    }

    fn probe(&mut self, region: &Region) {
        self.render(region, |_, _, _| {});
    }

    fn first_hits(&mut self, row: u32) -> Vec<Option<FirstHit>> {
        let ready = self.ready;
        let (frame, unit) = (
            &ready.prepared.frame,
            (-f64::from(ready.built.scale)).exp2(),
        );
        let samples = frame.parts().samples;
        let columns = (0..ready.built.size.0).step_by(frame.block() as usize);
        let place = |column| {
            let inside = (0..samples).flat_map(move |y| (0..samples).map(move |x| (x, y)));
            inside.map(move |(x, y)| frame.place(column, row, x, y))
        };
        self.with(|tracer, workspace, counters| {
            let hit = |(x, y)| {
                let ray = frame.camera().row(y).ray(x);
                let hit = tracer.nearest(&ray, workspace, counters)?;
                Some(FirstHit {
                    object: tracer.scene.attributes_of(hit.object).id,
                    distance: hit.t.to_f64() * unit,
                })
            };
            columns.flat_map(place).map(hit).collect()
        })
    }

    fn counters(&self) -> &Counters {
        &self.counters
    }
}

fn level<S: Quantize>(colour: Vec3<S>) -> Level {
    colour.to_array().map(S::level)
}

fn intensity<S: Quantize>(colour: Vec3<S>) -> Intensity {
    colour.to_array().map(|x| x.to_f64().clamp(0.0, 1.0) as f32)
}
