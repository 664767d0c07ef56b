//! Light that is reflected between mirrors: the loss by depth and cut-off.

use crate::exact::{exact, near};
use crate::method::{About, Form, SHIPPED, Sweep};
use crate::number::{Number, counted};
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use octray_core::accel::BruteForce;
use octray_core::object::ObjectRef;
use octray_core::ray::Ray;
use octray_core::scene::Surface;
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_core::vec3::{Vec3, vec3};
use octray_prepare::quantise::Prepared;

/// Two mirrors face each other and reflect a share of 0 to 499/500. Each emits so much light that the sum of all light
/// is 0.9. The reference is the sum of all reflections of the rounded numbers.
#[derive(Debug)]
pub struct Depth;

/// The weight below which a ray is not traced, and the number of bounces that this allows here.
const CUT_OFF: f64 = 1.0 / 512.0;
const DEPTH: u32 = 4000;

impl Sweep for Depth {
    const ABOUT: About = About {
        name: "depth",
        title: "Between two mirrors",
        axis: "1 / (1 − reflect)",
        unit: "grey levels",
        values: &[
            1.0, 1.25, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0,
        ],
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "depth limited by a cut-off of 1/512 only",
            },
            Form {
                name: "depth-8",
                label: "the default: at most 8 bounces",
            },
            Form {
                name: "depth-4",
                label: "at most 4 bounces",
            },
        ],
        limits: StateLimits {
            error: Some(limit(1.0, 8.0)),
            ..StateLimits::NONE
        },
    };

    fn setting(value: f64) -> Setting {
        mirrors().reflecting(1.0 - 1.0 / value, DEPTH)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 3];
        let Some(prepared) = mirrors().prepare::<S>() else {
            return all_errors;
        };
        let reflect = S::from_f64(1.0 - 1.0 / value);
        let glow = S::from_f64(0.9 / value);
        let rest = exact(1.0) - reflect.exact();
        let whole = exact(1.0);
        let truth = if glow.exact() < rest {
            glow.exact() / rest
        } else {
            whole
        };
        for (depth, errors) in [DEPTH, 8, 4].into_iter().zip(&mut all_errors) {
            let (found, saturations) = counted(|| light(&prepared, reflect, glow, depth));
            errors.cases += 1;
            errors.saturations += saturations;
            errors.err(255.0 * near(&(found.exact().min(exact(1.0)) - &truth)));
        }
        all_errors
    }
}

/// Returns two squares that face each other, with the eye between them.
fn mirrors() -> Setting {
    let square = |z: f64| {
        [
            [-1.0, -1.0, z],
            [1.0, -1.0, z],
            [1.0, 1.0, z],
            [-1.0, 1.0, z],
        ]
    };
    Setting::empty([0.0; 3])
        .and_polygon(&square(-1.0))
        .and_polygon(&square(1.0))
}

/// Returns the light that the tracer finds along a ray perpendicular to the mirrors.
fn light<S: Number>(prepared: &Prepared<S>, reflect: S, glow: S, max_depth: u32) -> S {
    let surfaces = [Surface {
        reflect,
        ambient: vec3(glow, glow, glow),
        ..Surface::default()
    }];
    let mut scene = prepared.scene.scene();
    (scene.surfaces, scene.lights) = (&surfaces, &[]);
    let all: Vec<ObjectRef> = scene.shapes.refs().collect();
    let tracer = Tracer {
        scene: &scene,
        accelerator: &BruteForce(&all),
        max_depth,
        cut_off: S::from_f64(CUT_OFF),
    };
    let mut workspace = Workspace {
        rays: &mut [QueuedRay::EMPTY; 2],
        stack: &mut (),
        shadow_cache: &mut [],
    };
    let ray = Ray::new(Vec3::ZERO, vec3(S::ZERO, S::ZERO, S::ONE));
    tracer.radiance(ray, &mut workspace, &mut ()).x
}
