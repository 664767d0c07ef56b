//! A renderer that owns its memory.

use crate::render::{Level, Strips, levels, render_rows};
use core::fmt::{self, Display, Formatter};
use core::ops::Range;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::Rgb888;
use heapless::Vec;
use octray_core::accel::Accelerator;
use octray_core::features::FeatureSet;
use octray_core::frame::Frame;
use octray_core::object::ObjectRef;
use octray_core::observe::{Observer, RayObserver};
use octray_core::trace::{QueuedRay, TraceScalar, Tracer, Workspace};

/// The memory to render with, whose size is known when the program is compiled: `RAYS` rays that wait, the stack `K` of
/// the tree's walk, `LIGHTS` places of the shadow cache, and a strip of `PIXELS` pixels.
///
/// [`scene!`](macro@crate::scene) names the type that suits a baked scene. For a scene that is made on the device, take
/// [`required_rays`](octray_core::trace::required_rays) for `RAYS`, and a few rows for `PIXELS`.
///
/// ```
/// use octray_core::accel::BruteForce;
/// use octray_core::camera::{Projection, View};
/// use octray_core::frame::Frame;
/// use octray_core::object::{ObjectKind, ObjectRef};
/// use octray_core::scalar::{Fixed, Scalar};
/// use octray_core::scene::{Attributes, Light, Scene, Surface};
/// use octray_core::shape::{Shapes, Sphere};
/// use octray_core::trace::Tracer;
/// use octray_core::vec3::{Vec3, vec3};
/// use octray_core::world::World;
/// use octray_embedded::Renderer;
///
/// type S = Fixed<16>;
/// // A ball of radius 1 before a black background, lit from the right.
/// let world = World::around::<S>([-1.0, -1.0, -1.0], [4.0, 3.0, 5.0]);
/// let at = |p| world.place::<S>(p);
/// let spheres = [Sphere::new(at([0.0, 0.0, 0.0]), world.radius(1.0))];
/// let surfaces = [Surface::matt(vec3(S::nearest(0.9), S::nearest(0.6), S::nearest(0.2)))];
/// let lights = [Light::new(at([4.0, 3.0, 3.0]), vec3(S::ONE, S::ONE, S::ONE))];
/// let shapes = Shapes { spheres: &spheres, ..Shapes::empty(world.slack()) };
/// let attributes = [Attributes::new(0, 0)];
/// let scene: Scene<S> =
///     Scene::new(shapes, &attributes, &surfaces, &lights, Vec3::ZERO, world.diameter());
///
/// let (eye, up) = ([0.0, 0.0, 5.0], [0.0, 1.0, 0.0]);
/// let view = View::look(eye, [0.0; 3], up, 30.0, (32, 24), Projection::Perspective);
/// let frame = Frame::whole(view.camera(&world), 32, 24);
/// let tree = BruteForce(&[ObjectRef::new(ObjectKind::Sphere, 0)]);
/// let tracer = Tracer { scene: &scene, accelerator: &tree, max_depth: 0, cut_off: S::ZERO };
///
/// let mut renderer = Renderer::<S, (), 0, 1, 32>::new();
/// let mut lit = 0;
/// renderer.pixels(&frame, &tracer, |_, _, [red, _, _]| lit += u32::from(red > 0))?;
/// assert_eq!(lit, 174);
/// # Ok::<(), octray_embedded::DrawError<core::convert::Infallible>>(())
/// ```
#[derive(Debug)]
pub struct Renderer<S, K, const RAYS: usize, const LIGHTS: usize, const PIXELS: usize> {
    rays: [QueuedRay<S>; RAYS],
    stack: K,
    shadow_cache: [Option<ObjectRef>; LIGHTS],
    strip: Vec<Level, PIXELS>,
}

/// Why a picture is not drawn, or not whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DrawError<E> {
    /// What the display says. What comes after is not drawn.
    Display(E),
    /// The strip has no room for as many rows as one ray colours: so many pixels. Nothing is drawn.
    StripTooSmall {
        /// The pixels that it takes.
        pixels: usize,
    },
    /// The first row is within the squares of pixels that one ray colours. Nothing is drawn.
    SquaresCut {
        /// The side of a square: the first row has to be a multiple of it.
        side: u32,
    },
    /// The picture is drawn, but lacks light: so many rays found no room to wait.
    RaysDropped {
        /// Rays that were not traced.
        rays: u32,
    },
}

impl<E: Display> Display for DrawError<E> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Display(why) => why.fmt(f),
            Self::StripTooSmall { pixels } => write!(f, "the strip takes {pixels} pixels"),
            Self::SquaresCut { side } => write!(f, "strips begin at multiples of {side} rows"),
            Self::RaysDropped { rays } => write!(f, "{rays} rays found no room to wait"),
        }
    }
}

impl<E: core::error::Error> core::error::Error for DrawError<E> {}

impl<S, K, const RAYS: usize, const LIGHTS: usize, const PIXELS: usize>
    Renderer<S, K, RAYS, LIGHTS, PIXELS>
where
    S: TraceScalar,
    K: Default,
{
    /// Memory in which nothing waits.
    pub fn new() -> Self {
        const { assert!(PIXELS > 0, "a strip of no pixels") };
        Self {
            rays: [QueuedRay::EMPTY; RAYS],
            stack: K::default(),
            shadow_cache: [None; LIGHTS],
            strip: Vec::new(),
        }
    }
}

impl<S, K, const RAYS: usize, const LIGHTS: usize, const PIXELS: usize> Default
    for Renderer<S, K, RAYS, LIGHTS, PIXELS>
where
    S: TraceScalar,
    K: Default,
{
    fn default() -> Self {
        Self::new()
    }
}

impl<S: TraceScalar, K, const RAYS: usize, const LIGHTS: usize, const PIXELS: usize>
    Renderer<S, K, RAYS, LIGHTS, PIXELS>
{
    /// Renders a picture and draws it into `target`, from top to bottom, in strips of as many whole rows as there is
    /// room for.
    ///
    /// # Errors
    /// [`DrawError`].
    pub fn draw<A, D, const FEATURES: FeatureSet>(
        &mut self,
        frame: &Frame<S>,
        tracer: &Tracer<'_, S, A, FEATURES>,
        target: &mut D,
    ) -> Result<(), DrawError<D::Error>>
    where
        A: Accelerator<S, FEATURES, Stack = K>,
        D: DrawTarget<Color: From<Rgb888>>,
    {
        let strips = Strips::of(frame);
        let rows = strips.rows(PIXELS);
        if rows == 0 {
            let pixels = (strips.block * strips.width) as usize;
            return Err(DrawError::StripTooSmall { pixels });
        }
        let mut dropped = DropCount(0);
        let (strip, mut workspace) = self.parts((rows * strips.width) as usize);
        let drawn = strips.draw(target, strip, |rows, pixels| {
            render_rows(rows, frame, tracer, &mut workspace, pixels, &mut dropped);
        });
        drawn.map_err(DrawError::Display)?;
        dropped.result()
    }

    /// Renders some rows of a picture, and returns their pixels, row by row.
    ///
    /// # Errors
    /// [`DrawError::StripTooSmall`] if there is no room for them, [`DrawError::SquaresCut`], [`DrawError::RaysDropped`].
    pub fn strip<A, const FEATURES: FeatureSet>(
        &mut self,
        rows: Range<u32>,
        frame: &Frame<S>,
        tracer: &Tracer<'_, S, A, FEATURES>,
    ) -> Result<&[Level], DrawError<core::convert::Infallible>>
    where
        A: Accelerator<S, FEATURES, Stack = K>,
    {
        let pixels = rows.len() * frame.params().width as usize;
        if pixels > PIXELS {
            return Err(DrawError::StripTooSmall { pixels });
        }
        let side = frame.block();
        if !rows.start.is_multiple_of(side) {
            return Err(DrawError::SquaresCut { side });
        }
        let mut dropped = DropCount(0);
        let (strip, mut workspace) = self.parts(pixels);
        render_rows(rows, frame, tracer, &mut workspace, strip, &mut dropped);
        dropped.result()?;
        Ok(&self.strip)
    }

    /// Renders a picture, and passes each pixel to `put` with its column and its row, as soon as it is known and in no
    /// more order than that. Pixels of nothing but background, outside of [`Frame::active`], are not passed. The strip
    /// is not used.
    ///
    /// # Errors
    /// [`DrawError::RaysDropped`].
    pub fn pixels<A, const FEATURES: FeatureSet>(
        &mut self,
        frame: &Frame<S>,
        tracer: &Tracer<'_, S, A, FEATURES>,
        mut put: impl FnMut(u32, u32, Level),
    ) -> Result<(), DrawError<core::convert::Infallible>>
    where
        A: Accelerator<S, FEATURES, Stack = K>,
    {
        let mut dropped = DropCount(0);
        let rows = 0..frame.params().height;
        let put = |x, y, colour| put(x, y, levels(colour));
        let (_, mut workspace) = self.parts(0);
        frame.render(rows, tracer, &mut workspace, &mut dropped, put);
        dropped.result()
    }

    /// A strip of so many pixels, for which there is room, and what else to render with.
    fn parts(&mut self, pixels: usize) -> (&mut [Level], Workspace<'_, S, K>) {
        // It has been compared with the capacity.
        let _ = self.strip.resize_default(pixels);
        let workspace = Workspace {
            rays: &mut self.rays,
            stack: &mut self.stack,
            shadow_cache: &mut self.shadow_cache,
        };
        (&mut self.strip, workspace)
    }
}

/// Counts rays that found no room.
struct DropCount(u32);

impl DropCount {
    fn result<E>(self) -> Result<(), DrawError<E>> {
        match self.0 {
            0 => Ok(()),
            rays => Err(DrawError::RaysDropped { rays }),
        }
    }
}

impl<S> RayObserver<S> for DropCount {}

impl Observer for DropCount {
    #[inline(always)]
    fn dropped_ray(&mut self) {
        self.0 = self.0.saturating_add(1);
    }
}
