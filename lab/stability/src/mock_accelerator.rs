//! Records the rays that the tracer sends from a surface, with an accelerator that finds no further object.

use octray_core::accel::{Accelerator, Hit};
use octray_core::object::ObjectRef;
use octray_core::observe::Observer;
use octray_core::ray::Ray;
use octray_core::scalar::Scalar;
use octray_core::scene::{Attributes, Light, Scene, Sky, Surface};
use octray_core::shape::Shapes;
use octray_core::trace::{QueuedRay, TraceScalar, Tracer, Workspace};
use octray_core::vec3::Vec3;

/// The rays that left a surface.
#[derive(Clone, Debug, Default)]
pub struct Seen<S> {
    met: bool,
    /// Reflected and transmitted rays.
    pub follow: Vec<Ray<S>>,
}

struct MockAccelerator<S>(Hit<S>);

impl<S: Scalar> Accelerator<S> for MockAccelerator<S> {
    type Stack = Seen<S>;

    fn nearest<O: Observer>(
        &self,
        _: &Scene<'_, S>,
        ray: &Ray<S>,
        seen: &mut Seen<S>,
        _: &mut O,
    ) -> Option<Hit<S>> {
        if seen.met {
            seen.follow.push(*ray);
            return None;
        }
        seen.met = true;
        Some(self.0)
    }

    fn any_hit<O: Observer>(
        &self,
        _: &Scene<'_, S>,
        _: &Ray<S>,
        _: S,
        _: Option<&Light<S>>,
        _: &mut Seen<S>,
        _: &mut O,
    ) -> Option<ObjectRef> {
        None
    }
}

/// Returns a surface that only reflects.
pub fn mirror<S: Scalar>() -> Surface<S> {
    Surface {
        reflect: S::ONE,
        ..Surface::default()
    }
}

/// Returns a surface that transmits everything, from refraction index `ratio` outside to 1 inside.
pub fn glass<S: Scalar>(ratio: S) -> Surface<S> {
    Surface {
        refract: S::ONE,
        entering: ratio,
        ..Surface::default()
    }
}

/// Returns the rays that the tracer sends from the point where `ray` hits an object of `shapes`.
pub fn leaving<S: TraceScalar>(
    shapes: Shapes<'_, S>,
    surface: Surface<S>,
    ray: &Ray<S>,
    hit: Hit<S>,
) -> Seen<S> {
    let attributes = vec![
        Attributes {
            id: 0,
            surface: 0,
            patch: Attributes::FLAT,
        };
        shapes.len()
    ];
    let surfaces = [surface];
    let scene = Scene {
        shapes,
        attributes: &attributes,
        first: Scene::first_of(&shapes),
        surfaces: &surfaces,
        lights: &[],
        background: Vec3::ZERO,
        sky: Sky::default(),
        checkers: &[],
        diameter: S::MAX,
    };
    let tracer = Tracer {
        scene: &scene,
        accelerator: &MockAccelerator(hit),
        max_depth: 1,
        cut_off: S::ZERO,
    };
    let mut seen = Seen::default();
    let mut workspace = Workspace {
        rays: &mut [QueuedRay::EMPTY; 2],
        stack: &mut seen,
        shadow_cache: &mut [],
    };
    tracer.radiance(*ray, &mut workspace, &mut ());
    seen
}
