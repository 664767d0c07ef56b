//! A scene in some arithmetic with some tree, and what one thread traces it with.

use crate::cache_padded::CachePadded;
use crate::interrupt::Interrupt;
use crate::owned::{AnyAccelerator, AnyStack, OwnedAccelerator};
use crate::pixel_trace::{PixelTrace, Recorder};
use crate::renderer::{Built, FirstHit, Renderer, Worker};
use crate::tile::{Intensity, Level, Tile};
use crate::watch::Watch;
use octray_core::frame::{RUN, Region};
use octray_core::object::ObjectRef;
use octray_core::observe::Counters;
use octray_core::quantize::Quantize;
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_core::vec3::Vec3;
use octray_prepare::quantise::Prepared;
use octray_prepare::saturation;

/// A scene in arithmetic `S` with a tree.
pub(crate) struct PreparedScene<S: Quantize> {
    pub(crate) prepared: Prepared<S>,
    pub(crate) tree: OwnedAccelerator<S::Bound>,
    pub(crate) built: Built,
    pub(crate) max_depth: u32,
    pub(crate) cut_off: S,
}

impl<S: Quantize> Renderer for PreparedScene<S> {
    fn built(&self) -> &Built {
        &self.built
    }

    fn worker(&self, interrupt: &Interrupt) -> Box<dyn Worker + '_> {
        let scene = &self.prepared.scene;
        Box::new(Tracing {
            ready: self,
            tree: self.tree.view(),
            rays: CachePadded::new(QueuedRay::EMPTY, self.max_depth as usize + 2),
            stack: AnyStack::default(),
            shadow_cache: CachePadded::new(None, scene.lights.len()),
            watch: Watch::new(interrupt),
            saturations: 0,
        })
    }
}

/// What one thread traces with, in cache lines of its own as [`CachePadded`] has it.
#[repr(align(128))]
struct Tracing<'a, S: Quantize> {
    ready: &'a PreparedScene<S>,
    tree: AnyAccelerator<'a, S::Bound>,
    rays: CachePadded<QueuedRay<S>>,
    stack: AnyStack<S::Bound>,
    shadow_cache: CachePadded<Option<ObjectRef>>,
    watch: Watch,
    saturations: u64,
}

impl<'a, S: Quantize> Tracing<'a, S> {
    /// Does something with what it takes to trace a ray.
    fn with<R>(
        &mut self,
        work: impl FnOnce(
            &Tracer<'_, S, AnyAccelerator<'a, S::Bound>>,
            &mut Workspace<'_, S, AnyStack<S::Bound>>,
            &mut Watch,
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
            rays: self.rays.get(),
            stack: &mut self.stack,
            shadow_cache: self.shadow_cache.get(),
        };
        let (done, saturations) =
            saturation::counted(|| work(&tracer, &mut workspace, &mut self.watch));
        self.saturations += saturations;
        done
    }

    /// `put` is called through a pointer, so that there is one copy of all that is inlined here.
    fn render(&mut self, region: &Region, put: &mut dyn FnMut(u32, u32, Vec3<S>)) {
        let frame = &self.ready.prepared.frame;
        self.with(|tracer, workspace, watch| {
            frame.render_region(region, tracer, workspace, watch, put);
        });
    }
}

impl<S: Quantize> Worker for Tracing<'_, S> {
    fn trace(&mut self, tile: Tile<'_>) {
        let Tile {
            region,
            levels,
            mut intensities,
        } = tile;
        let background = self.ready.built.background;
        levels.fill(background.0);
        if let Some(intensities) = &mut intensities {
            intensities.fill(background.1);
        }
        let (left, top) = (region.columns.start, region.rows.start);
        let width = region.columns.len();
        self.render(&region, &mut |x, y, colour| {
            let pixel = (y - top) as usize * width + (x - left) as usize;
            levels[pixel] = level(colour);
            if let Some(intensities) = &mut intensities {
                intensities[pixel] = intensity(colour);
            }
        });
    }

    fn probe(&mut self, region: &Region) {
        self.render(region, &mut |_, _, _| {});
    }

    fn first_hits(&mut self, row: u32) -> Vec<Option<FirstHit>> {
        let ready = self.ready;
        let (frame, unit) = (
            &ready.prepared.frame,
            (-f64::from(ready.built.scale)).exp2(),
        );
        let samples = frame.params().samples;
        let columns = (0..ready.built.size.0).step_by(frame.block() as usize);
        let place = |column| {
            let inside = (0..samples).flat_map(move |y| (0..samples).map(move |x| (x, y)));
            inside.map(move |(x, y)| frame.sample_position(column, row, x, y))
        };
        self.with(|tracer, workspace, watch| {
            let hit = |(x, y)| {
                let ray = frame.camera().row(y).ray(x);
                let hit = tracer.nearest(&ray, workspace, watch)?;
                Some(FirstHit {
                    object: tracer.scene.attributes_of(hit.object).id,
                    distance: hit.t.to_f64() * unit,
                })
            };
            columns.flat_map(place).map(hit).collect()
        })
    }

    fn trace_pixel(&mut self, column: u32, row: u32) -> PixelTrace {
        let ready = self.ready;
        let block = ready.prepared.frame.block();
        let (left, top) = (column / block * block, row / block * block);
        let region = Region {
            columns: left..left + block,
            rows: top..top + block,
        };
        let (mut level_here, mut intensity_here) = ready.built.background;
        self.shadow_cache.get().fill(None);
        self.watch.recorder = Some(Box::new(Recorder::new(&self.watch.counters)));
        self.render(&region, &mut |x, y, colour| {
            if (x, y) == (column, row) {
                (level_here, intensity_here) = (level(colour), intensity(colour));
            }
        });
        let recorder = self.watch.recorder.take();
        let scene = ready.prepared.scene.scene();
        let id = |object| scene.attributes_of(object).id;
        let unit = (-f64::from(ready.built.scale)).exp2();
        PixelTrace {
            rays: recorder.map_or_else(Vec::new, |recorder| recorder.into_rays(id, unit)),
            level: level_here,
            intensity: intensity_here,
        }
    }

    fn trace_places(&mut self, places: &[(u32, u32)]) -> Vec<Intensity> {
        let frame = &self.ready.prepared.frame;
        // As in the frame, the shadow cache begins anew at each run of pixels, so that tiles do not change what is counted.
        let run = |(x, y): (u32, u32)| (x / (2 * frame.params().samples * RUN), y);
        let mut colours = Vec::with_capacity(places.len());
        for places in places.chunk_by(|a, b| run(*a) == run(*b)) {
            self.shadow_cache.get().fill(None);
            self.with(|tracer, workspace, watch| {
                let rays = places.iter().map(|&(x, y)| frame.ray_at(x, y));
                colours.extend(rays.map(|ray| intensity(tracer.radiance(ray, workspace, watch))));
            });
        }
        colours
    }

    fn counters(&self) -> &Counters {
        &self.watch.counters
    }

    fn saturations(&self) -> u64 {
        self.saturations
    }
}

pub(crate) fn level<S: Quantize>(colour: Vec3<S>) -> Level {
    [colour.x.level(), colour.y.level(), colour.z.level()]
}

pub(crate) fn intensity<S: Quantize>(colour: Vec3<S>) -> Intensity {
    let share = |x: S| x.to_f64().clamp(0.0, 1.0) as f32;
    [share(colour.x), share(colour.y), share(colour.z)]
}
