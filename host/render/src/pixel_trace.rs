//! What the rays of one pixel meet: the intersection tree (thesis, figure 4), recorded while the pixel is traced.

use crate::renderer::FirstHit;
use crate::tile::{Intensity, Level};
use octray_core::accel::Hit;
use octray_core::object::ObjectRef;
use octray_core::observe::{Counters, RayKind};
use octray_core::quantize::Quantize;
use octray_core::trace::QueuedRay;
use octray_core::vec3::Vec3;

/// A pixel, and every ray that was traced for it.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelTrace {
    /// The rays of the camera, one for each sample; none where the picture can only show background.
    pub rays: Vec<TracedRay>,
    /// The pixel as it is in the picture.
    pub level: Level,
    /// The same in floating point.
    pub intensity: Intensity,
}

/// A ray, and those that follow from it.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedRay {
    /// Why it was traced.
    pub kind: RayKind,
    /// The share of its light that reaches the picture.
    pub weight: f64,
    /// What it met, if anything.
    pub hit: Option<FirstHit>,
    /// What finding that took.
    pub effort: Effort,
    /// The light along it from the surface it met or from the background, not weighted.
    pub light: [f64; 3],
    /// The lights that the surface there faces, in the scene's order.
    pub lights: Vec<LightTest>,
    /// Those that follow: a transmitted one, a reflected one, in the order in which they were traced.
    pub followers: Vec<TracedRay>,
    /// Those that would follow, but were not traced.
    pub left_out: Vec<LeftOut>,
}

/// A light that was looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTest {
    /// Its index in the scene, counted from 0.
    pub light: usize,
    /// The object that blocks it, counted from 0 in the order of the scene file; `None` if it shines.
    pub blocker: Option<u32>,
    /// What finding that took.
    pub effort: Effort,
}

/// A ray that was not traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOut {
    /// Its kind.
    pub kind: RayKind,
    /// Its weight, which is below the cut-off; `None` if it would bounce too often.
    pub weight: Option<f64>,
}

/// What a search cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Nodes or cells visited.
    pub steps: u64,
    /// Objects tested.
    pub tests: u64,
}

/// Records rays as they come: depth first.
#[derive(Debug)]
pub(crate) struct Recorder {
    rays: Vec<Record>,
    /// What was counted before the search that is under way.
    before: Effort,
}

/// A ray in the tracer's terms.
#[derive(Debug)]
struct Record {
    kind: RayKind,
    depth: u32,
    weight: f64,
    hit: Option<(ObjectRef, f64)>,
    effort: Effort,
    light: [f64; 3],
    lights: Vec<(usize, Option<ObjectRef>, Effort)>,
    left_out: Vec<LeftOut>,
}

/// What records is kept out of the code that traces.
impl Recorder {
    /// Nothing recorded yet.
    pub(crate) fn new(counters: &Counters) -> Self {
        let mut recorder = Self {
            rays: Vec::new(),
            before: Effort::default(),
        };
        recorder.since(counters);
        recorder
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn begin<S: Quantize>(&mut self, counters: &Counters, ray: &QueuedRay<S>) {
        self.since(counters);
        self.rays.push(Record {
            kind: ray.kind,
            depth: ray.depth,
            weight: ray.weight.to_f64(),
            hit: None,
            effort: Effort::default(),
            light: [0.0; 3],
            lights: Vec::new(),
            left_out: Vec::new(),
        });
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn meet<S: Quantize>(&mut self, counters: &Counters, hit: Hit<S>) {
        let effort = self.since(counters);
        if let Some(ray) = self.rays.last_mut() {
            (ray.effort, ray.hit) = (effort, Some((hit.object, hit.t.to_f64())));
        }
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn light(&mut self, counters: &Counters, light: usize, blocker: Option<ObjectRef>) {
        let effort = self.since(counters);
        if let Some(ray) = self.rays.last_mut() {
            ray.lights.push((light, blocker, effort));
        }
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn not_followed(&mut self, kind: RayKind, weight: Option<f64>) {
        if let Some(ray) = self.rays.last_mut() {
            ray.left_out.push(LeftOut { kind, weight });
        }
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn brings<S: Quantize>(&mut self, counters: &Counters, light: Vec3<S>) {
        let effort = self.since(counters);
        if let Some(ray) = self.rays.last_mut() {
            ray.light = light.to_array().map(S::to_f64);
            if ray.hit.is_none() {
                ray.effort = effort;
            }
        }
    }

    /// What was counted since this was last called.
    fn since(&mut self, counters: &Counters) -> Effort {
        let now = Effort {
            steps: counters.steps(),
            tests: counters.tests(),
        };
        let before = std::mem::replace(&mut self.before, now);
        Effort {
            steps: now.steps - before.steps,
            tests: now.tests - before.tests,
        }
    }

    /// The camera's rays with all that follows from them. `id` gives an object's place in the scene file, `unit` is what a
    /// distance is to be multiplied by.
    pub(crate) fn into_rays(self, id: impl Fn(ObjectRef) -> u32, unit: f64) -> Vec<TracedRay> {
        // A ray is complete once one comes that is no deeper.
        let mut open: Vec<(u32, TracedRay)> = Vec::new();
        let mut done = Vec::new();
        let mut close = |open: &mut Vec<(u32, TracedRay)>| {
            if let Some((_, ray)) = open.pop() {
                match open.last_mut() {
                    Some((_, parent)) => parent.followers.push(ray),
                    None => done.push(ray),
                }
            }
        };
        for record in self.rays {
            while open.last().is_some_and(|(depth, _)| *depth >= record.depth) {
                close(&mut open);
            }
            let lights = record.lights.into_iter();
            let ray = TracedRay {
                kind: record.kind,
                weight: record.weight,
                hit: record.hit.map(|(object, t)| FirstHit {
                    object: id(object),
                    distance: t * unit,
                }),
                effort: record.effort,
                light: record.light,
                lights: lights
                    .map(|(light, blocker, effort)| LightTest {
                        light,
                        blocker: blocker.map(&id),
                        effort,
                    })
                    .collect(),
                followers: Vec::new(),
                left_out: record.left_out,
            };
            open.push((record.depth, ray));
        }
        while !open.is_empty() {
            close(&mut open);
        }
        done
    }
}
