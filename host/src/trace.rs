//! Tracing a scene: the arithmetic and the tree are chosen here, at run time, among all that are
//! compiled in.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::job::{Arith, Link, PixelsPerRay, RenderJob, Tree};
use crate::packets::Packets;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::render::Traced;
use crate::schedule::run_packets;
use crate::stats::{Octree, Rays};
use octray_core::observe::{Counters, RayKind};
use octray_core::octree::{self, Accelerator, List, Options, Summary, Variant};
use octray_core::scalar::{self, Approx, Fixed, Fixed64, Quantize};
use octray_core::trace::{Pending, Tracer, Workspace};
use octray_core::vec3::Vec3;
use octray_scenes::model::Scene;
use octray_scenes::quantise::{self, Prepared, View};
use octray_scenes::tree::{Growth, OctantTree, PackedTree, TightTree, every_object};
use std::time::Instant;

/// Trace what the job asks for.
///
/// # Errors
/// [`Error::Failed`] if the scene does not fit the arithmetic or the picture does not fit into
/// memory, [`Error::Interrupted`] if it was.
pub fn trace(
    scene: &Scene,
    job: &RenderJob,
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<Traced, Error> {
    let task = Task {
        scene,
        job,
        progress,
        interrupt,
    };
    match job.arith {
        Arith::F64 => task.run::<f64>(),
        Arith::F32 => task.run::<f32>(),
        Arith::Approx0 => task.run::<Approx<0>>(),
        Arith::Approx1 => task.run::<Approx<1>>(),
        Arith::Approx2 => task.run::<Approx<2>>(),
        Arith::I24F8 => task.run::<Fixed<8, true>>(),
        Arith::I20F12 => task.run::<Fixed<12, true>>(),
        Arith::I16F16 => task.run::<Fixed<16, true>>(),
        Arith::I12F20 => task.run::<Fixed<20, true>>(),
        Arith::I8F24 => task.run::<Fixed<24, true>>(),
        Arith::I4F28 => task.run::<Fixed<28, true>>(),
        Arith::I32F32 => task.run::<Fixed64>(),
        Arith::Auto if task.fits::<Fixed<28, true>>() => task.run::<Fixed<28, true>>(),
        Arith::Auto if task.fits::<Fixed<24, true>>() => task.run::<Fixed<24, true>>(),
        Arith::Auto if task.fits::<Fixed<20, true>>() => task.run::<Fixed<20, true>>(),
        Arith::Auto if task.fits::<Fixed<16, true>>() => task.run::<Fixed<16, true>>(),
        Arith::Auto if task.fits::<Fixed<12, true>>() => task.run::<Fixed<12, true>>(),
        Arith::Auto => task.run::<Fixed<8, true>>(),
    }
}

/// What is to be done, in whatever arithmetic.
struct Task<'a> {
    scene: &'a Scene,
    job: &'a RenderJob,
    progress: &'a Progress,
    interrupt: &'a Interrupt,
}

impl Task<'_> {
    fn view(&self) -> View {
        let view = &self.job.view;
        View {
            size: view.size,
            pixels_per_ray: match view.pixels_per_ray {
                PixelsPerRay::One => 1,
                PixelsPerRay::Four => 4,
            },
            samples: view.samples,
            max_depth: view.max_depth,
        }
    }

    /// Whether the scene cannot overflow format `S`.
    fn fits<S: Quantize>(&self) -> bool {
        quantise::limits::<S>(self.scene, self.job.view.max_depth).is_ok()
    }

    fn run<S: Quantize>(&self) -> Result<Traced, Error> {
        scalar::reset_saturations();
        let begin = Instant::now();
        let mut prepared = quantise::quantise::<S>(self.scene, &self.view())
            .map_err(|overflow| Error::Failed(overflow.to_string()))?;
        let options = &self.job.tree;
        let default_depth = match options.kind {
            Tree::Tight | Tree::Packed | Tree::None => 24,
            Tree::Plain | Tree::Modified => 8,
        };
        let growth = Growth {
            options: Options {
                depth: options.depth.unwrap_or(default_depth),
                leaf_size: options.leaf_size.map_or(2, std::num::NonZero::get),
            },
            arena: options.arena.map(std::num::NonZero::get),
        };
        let link = match options.link {
            Link::Shape => octree::Link::Shape,
            Link::Box => octree::Link::Box,
        };
        match options.kind {
            Tree::Tight => {
                let (tree, summary) = TightTree::build(&mut prepared.scene, &growth);
                self.picture(&prepared, &tree.tree(), summary, begin)
            }
            Tree::Packed => {
                let (tree, summary) =
                    PackedTree::build(&mut prepared.scene, &growth).map_err(|_| {
                        Error::Failed("a packed tree holds at most 32767 objects".into())
                    })?;
                self.picture(&prepared, &tree.tree(), summary, begin)
            }
            Tree::Modified | Tree::Plain => {
                let variant = match options.kind {
                    Tree::Plain => Variant::Plain,
                    _ => Variant::Modified,
                };
                let (tree, summary) =
                    OctantTree::build(&mut prepared.scene, &growth, variant, link);
                self.picture(&prepared, &tree.tree(), summary, begin)
            }
            Tree::None => {
                let all = every_object(&prepared.scene);
                let summary = Summary {
                    links: all.len() as u32,
                    ..Summary::default()
                };
                self.picture(&prepared, &List(&all), summary, begin)
            }
        }
    }

    /// Renders the picture, and gathers what it cost.
    fn picture<S: Quantize, A: Accelerator<S>>(
        &self,
        prepared: &Prepared<S>,
        tree: &A,
        summary: Summary,
        begin: Instant,
    ) -> Result<Traced, Error> {
        let build = begin.elapsed();
        let begin = Instant::now();
        let (picture, states, packets) = self.packets(prepared, tree)?;
        let mut counters = Counters::default();
        for state in &states {
            counters.add(state);
        }
        Ok(Traced {
            picture,
            format: S::NAME.into(),
            scale: prepared.placement.exponent,
            rays: Rays {
                primary: counters.rays_of(RayKind::Primary),
                shadow: counters.rays_of(RayKind::Shadow),
                blocked: counters.blocked,
                reflected: counters.rays_of(RayKind::Reflected),
                transmitted: counters.rays_of(RayKind::Transmitted),
            },
            steps: counters.steps,
            tests: counters.tests,
            hits: counters.hits[RayKind::Primary as usize],
            saturations: u64::from(scalar::saturations()),
            octree: Octree {
                kind: self.job.tree.kind,
                nodes: u64::from(summary.inner + summary.leaves),
                links: u64::from(summary.links),
                depth: summary.depth,
                unsplit: u64::from(summary.unsplit),
            },
            build,
            render: begin.elapsed(),
            threads: states.len(),
            packets,
        })
    }

    /// Deals the picture's packets to threads. Returns it with what each thread counted (counting
    /// costs less than the time of a frame varies) and the number of packets.
    fn packets<S: Quantize, A: Accelerator<S>>(
        &self,
        prepared: &Prepared<S>,
        tree: &A,
    ) -> Result<(Picture, Vec<Counters>, usize), Error> {
        let frame = &prepared.frame;
        let scene = prepared.scene.scene();
        let tracer = Tracer {
            scene: &scene,
            accelerator: tree,
            max_depth: self.job.view.max_depth,
            cut_off: S::from_f64(self.job.view.cut_off),
        };
        let (width, height) = self.view().size_of(self.scene);
        let intensities = self.job.output.holds_intensities();
        let mut picture = Picture::black(width, height, intensities)
            .ok_or_else(|| Error::Failed("the picture does not fit into memory".into()))?;
        let intensity = |c: Vec3<S>| c.to_array().map(|x| x.to_f64().clamp(0.0, 1.0) as f32);
        let (levels, floats) = picture.pixels_mut();
        levels.fill(scene.background.to_array().map(S::level));
        if let Some(floats) = floats {
            floats.fill(intensity(scene.background));
        }
        let rows = frame.active().rows.clone();
        let packets = Packets::cut(&mut picture, rows, self.job.work.packet_rows);
        let count = packets.len();
        self.progress.start(count);
        let finished = run_packets(
            count,
            self.job.work.threads,
            self.job.work.schedule,
            self.interrupt,
            |_| State::<S, A::Stack>::new(self.job.view.max_depth, scene.lights.len()),
            |state, index| {
                let Some(mut packet) = packets.take(index) else {
                    return;
                };
                let first = packet.rows.start;
                let mut workspace = Workspace {
                    rays: &mut state.rays,
                    stack: &mut state.stack,
                    blockers: &mut state.blockers,
                };
                let rows = packet.rows.clone();
                frame.render(
                    rows,
                    &tracer,
                    &mut workspace,
                    &mut state.counters,
                    |x, y, c| {
                        let place = (y - first) as usize * width as usize + x as usize;
                        packet.levels[place] = c.to_array().map(S::level);
                        if let Some(floats) = &mut packet.intensities {
                            floats[place] = intensity(c);
                        }
                    },
                );
            },
            || self.progress.step(),
        )?;
        drop(packets);
        let counters = finished.into_iter().map(|f| f.state.counters).collect();
        Ok((picture, counters, count))
    }
}

/// What one thread works with.
struct State<S: Quantize, K> {
    rays: Vec<Pending<S>>,
    stack: K,
    blockers: Vec<Option<octray_core::shape::ObjectRef>>,
    counters: Counters,
}

impl<S: Quantize, K: Default> State<S, K> {
    fn new(max_depth: u32, lights: usize) -> Self {
        Self {
            rays: vec![Pending::EMPTY; max_depth as usize + 2],
            stack: K::default(),
            blockers: vec![None; lights],
            counters: Counters::default(),
        }
    }
}
