//! Scenes made in code, with the checks that scenes in files get.
//!
//! ```
//! use octray_scenes::builder::SceneBuilder;
//! use octray_scenes::model::Surface;
//!
//! let mut scene = SceneBuilder::look([0.0, 2.0, 6.0], [0.0, 0.7, 0.0], 40.0);
//! scene.background([0.3, 0.5, 0.8]);
//! scene.light([4.0, 6.0, 4.0], 1.0);
//! scene.sphere([0.0, 1.0, 0.0], 1.0, Surface::glossy([0.8, 0.2, 0.1], 30.0, 0.2));
//! let floor = [[-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]];
//! scene.polygon(&floor, Surface::matt([0.6; 3]));
//! let scene = scene.build()?;
//! assert_eq!((scene.objects.len(), scene.surfaces.len()), (2, 2));
//! # Ok::<(), octray_scenes::builder::Mistakes>(())
//! ```
//!
//! A call with wrong values is no panic: the mistake is kept, with the place of the call, and
//! [`build`](SceneBuilder::build) returns all of them.
//!
//! ```
//! # use octray_scenes::builder::SceneBuilder;
//! # use octray_scenes::model::Surface;
//! let mut scene = SceneBuilder::look([0.0, 2.0, 6.0], [0.0; 3], 40.0);
//! let matt = Surface::matt([0.6; 3]);
//! scene.sphere([0.0, 1.0, 0.0], 1.0, matt);
//! scene.sphere([2.0, 1.0, 0.0], -1.0, matt);
//! scene.light([4.0, f64::NAN, 4.0], 1.0);
//! let mistakes = scene.build().unwrap_err().to_string();
//! let mut lines = mistakes.lines();
//! let mut told = |text| assert!(lines.next().is_some_and(|line| line.ends_with(text)), "{mistakes}");
//! told("error: sphere 2: radius -1: expected a radius above 0");
//! told("error: light 1: position [4, NaN, 4]: expected finite numbers");
//! ```

mod mistake;
mod value;

pub use mistake::{Mistake, Mistakes, Warning, Warnings};

use crate::check;
use crate::diagnostic::WarningKind;
use crate::model::{Camera, Colour, Light, Point, Projection, Scene, Shape, Surface};
use crate::word::Keyword;
use mistake::Sink;
use std::collections::HashMap;
use std::fmt;
use std::panic::Location;
use value::Value;

/// A scene under construction.
///
/// Points, lengths and sizes are in scene units, colours linear red, green and blue. Surfaces are values: objects with
/// equal ones share one in the [`Scene`]. Objects keep the order of their calls, which is their identity everywhere in
/// octray.
///
/// The checks are those of [`parse`](crate::parse()), with two differences: a negative radius is a mistake here, where a
/// file's loses its sign, and what a scene has once (background, size) may be set again, where a file has it once.
#[derive(Clone, Debug)]
pub struct SceneBuilder {
    scene: Scene,
    /// The index of each surface, by its bits.
    surfaces: HashMap<[u64; 21], u32>,
    /// How many calls there were for each kind of part.
    calls: Vec<(&'static str, usize)>,
    sink: Sink,
}

/// What holds for the whole scene.
impl SceneBuilder {
    /// Begins a scene that is seen from the point `from`, with `at` in the centre of the picture, the y axis up, and
    /// `angle` degrees, inside (0, 180), between the first and the last row. [`SceneBuilder::with_camera`] takes any
    /// other camera.
    #[track_caller]
    #[must_use]
    pub fn look(from: Point, at: Point, angle: f64) -> Self {
        Self::with_camera(Camera::Nff {
            from,
            at,
            up: [0.0, 1.0, 0.0],
            angle,
            projection: Projection::Perspective,
        })
    }

    /// Begins a scene that is seen by `camera`, in a picture of 512 × 512 pixels.
    #[track_caller]
    #[must_use]
    pub fn with_camera(camera: Camera) -> Self {
        let mut sink = Sink::default();
        if let Err(fault) = check::camera(&camera) {
            let values = value::of_camera(&camera);
            sink.mistake(Subject::one("camera"), fault, &values, Location::caller());
        }
        let scene = Scene {
            camera,
            ..Scene::default()
        };
        Self {
            scene,
            surfaces: HashMap::new(),
            calls: Vec::new(),
            sink,
        }
    }

    /// Sets the picture's columns and rows, 1 to 65535 each; 512 × 512 if never called. The settings of a rendering can
    /// replace them, which keeps the framing.
    #[track_caller]
    pub fn size(&mut self, width: u32, height: u32) {
        let sizes = [("width", width), ("height", height)];
        for (name, size) in sizes.map(|(name, size)| (name, f64::from(size))) {
            if let Err(fault) = check::resolution(size) {
                let values = [Value::number(name, size)];
                (self.sink).mistake(Subject::one("size"), fault, &values, Location::caller());
            }
        }
        (self.scene.width, self.scene.height) = (width, height);
    }

    /// Sets the colour of rays that hit nothing; black if never called.
    #[track_caller]
    pub fn background(&mut self, colour: Colour) {
        self.set_background(colour, None, "colour", Location::caller());
    }

    /// Sets the colour of rays that hit nothing: `lowest` straight down, `zenith` straight up, between them evenly mixed.
    /// Up is where the camera's `up` points, or the y axis for the thesis's camera.
    #[track_caller]
    pub fn sky(&mut self, lowest: Colour, zenith: Colour) {
        self.set_background(lowest, Some(zenith), "lowest", Location::caller());
    }

    /// Adds a white point light; 1 is full brightness, which does not fade with the distance.
    #[track_caller]
    pub fn light(&mut self, position: Point, brightness: f64) {
        let value = Value::number("brightness", brightness);
        self.add_light(position, [brightness; 3], value, Location::caller());
    }

    /// Adds a point light with a brightness for each channel.
    #[track_caller]
    pub fn coloured_light(&mut self, position: Point, colour: Colour) {
        let value = Value::colour("colour", colour);
        self.add_light(position, colour, value, Location::caller());
    }

    /// Returns the scene.
    ///
    /// # Errors
    /// All mistakes, up to [`MOST`](crate::diagnostic::MOST), in the order of the calls.
    pub fn build(self) -> Result<Scene, Mistakes> {
        self.build_with_warnings().map(|(scene, _)| scene)
    }

    /// Returns the scene, and beside it what is odd about it but harmless: polygons without area, which are left out,
    /// repeated vertices, and polygons that are not quite planar, which are drawn flat.
    ///
    /// # Errors
    /// Those of [`SceneBuilder::build`].
    pub fn build_with_warnings(self) -> Result<(Scene, Warnings), Mistakes> {
        self.sink.into_result(self.scene)
    }
}

/// Objects. Each has a surface; of several objects that share a wrong one, the first is told.
impl SceneBuilder {
    /// Adds a sphere; its radius is above 0.
    #[track_caller]
    pub fn sphere(&mut self, centre: Point, radius: f64, surface: Surface) {
        let shape = Shape::Sphere { centre, radius };
        let values = [
            Value::point("centre", centre),
            Value::number("radius", radius),
        ];
        self.add_solid("sphere", shape, &values, &surface, Location::caller());
    }

    /// Adds a box along the axes: its centre, and the full lengths of its sides, all above 0.
    #[track_caller]
    pub fn cuboid(&mut self, centre: Point, size: Point, surface: Surface) {
        let shape = Shape::Cuboid { centre, size };
        let values = [Value::point("centre", centre), Value::point("size", size)];
        self.add_solid("box", shape, &values, &surface, Location::caller());
    }

    /// Adds the side surface of a cone, without end caps: centres and radii of its base and of its top, which are at
    /// different places. One radius may be 0.
    #[track_caller]
    pub fn cone(
        &mut self,
        base: Point,
        base_radius: f64,
        top: Point,
        top_radius: f64,
        surface: Surface,
    ) {
        let values = [
            Value::point("base", base),
            Value::number("base radius", base_radius),
            Value::point("top", top),
            Value::number("top radius", top_radius),
        ];
        let shape = Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        };
        self.add_solid("cone", shape, &values, &surface, Location::caller());
    }

    /// Adds the side surface of a cylinder, without end caps, from `base` to `top`; its radius is above 0.
    #[track_caller]
    pub fn cylinder(&mut self, base: Point, top: Point, radius: f64, surface: Surface) {
        let values = [
            Value::point("base", base),
            Value::point("top", top),
            Value::number("radius", radius),
        ];
        let shape = Shape::Cone {
            base,
            base_radius: radius,
            top,
            top_radius: radius,
        };
        self.add_solid("cylinder", shape, &values, &surface, Location::caller());
    }

    /// Adds a polygon of three vertices or more, in a plane, in either order: convex, concave, or with edges that cross
    /// (a point is inside by the even–odd rule). It closes itself: the first vertex is not repeated.
    #[track_caller]
    pub fn polygon(&mut self, vertices: &[Point], surface: Surface) {
        let corners = vertices.iter().map(|vertex| (*vertex, None));
        self.add_polygon(Keyword::Polygon, corners, &surface, Location::caller());
    }

    /// Adds a polygon with a normal at each vertex: (vertex, normal), the normal of any length but 0. The normal of a
    /// point between is interpolated over the fan of triangles from the first vertex.
    #[track_caller]
    pub fn patch(&mut self, corners: &[(Point, Point)], surface: Surface) {
        let corners = (corners.iter()).map(|(vertex, normal)| (*vertex, Some(*normal)));
        self.add_polygon(Keyword::Patch, corners, &surface, Location::caller());
    }
}

/// Where a method was called.
type Caller = &'static Location<'static>;

/// What a call is about.
#[derive(Clone, Copy, Debug)]
struct Subject {
    kind: &'static str,
    /// Which of its kind, from 1, if there can be several.
    number: Option<usize>,
}

impl Subject {
    fn one(kind: &'static str) -> Self {
        Self { kind, number: None }
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind)?;
        self.number.map_or(Ok(()), |number| write!(f, " {number}"))
    }
}

impl SceneBuilder {
    /// Counts a call for a part of this kind.
    fn next(&mut self, kind: &'static str) -> Subject {
        let known = self.calls.iter().position(|(known, _)| *known == kind);
        let index = known.unwrap_or_else(|| {
            self.calls.push((kind, 0));
            self.calls.len() - 1
        });
        let (_, calls) = &mut self.calls[index];
        *calls += 1;
        Subject {
            kind,
            number: Some(*calls),
        }
    }

    fn set_background(
        &mut self,
        lowest: Colour,
        zenith: Option<Colour>,
        name: &'static str,
        caller: Caller,
    ) {
        if let Err(fault) = check::background(&lowest, zenith.as_ref()) {
            let mut values = vec![Value::colour(name, lowest)];
            values.extend(zenith.map(|zenith| Value::colour("zenith", zenith)));
            (self.sink).mistake(Subject::one("background"), fault, &values, caller);
        }
        (self.scene.background, self.scene.zenith) = (lowest, zenith);
    }

    fn add_light(&mut self, position: Point, colour: Colour, brightness: Value, caller: Caller) {
        let subject = self.next("light");
        if let Err(fault) = self.scene.add_light(Light { position, colour }) {
            let values = [Value::point("position", position), brightness];
            self.sink.mistake(subject, fault, &values, caller);
        }
    }

    fn add_solid(
        &mut self,
        kind: &'static str,
        shape: Shape,
        values: &[Value],
        surface: &Surface,
        caller: Caller,
    ) {
        let subject = self.next(kind);
        let surface = self.surface(surface, subject, caller);
        if let Err(fault) = self.scene.add_solid(shape, surface) {
            self.sink.mistake(subject, fault, values, caller);
        }
    }

    fn add_polygon(
        &mut self,
        keyword: Keyword,
        corners: impl ExactSizeIterator<Item = (Point, Option<Point>)> + Clone,
        surface: &Surface,
        caller: Caller,
    ) {
        let is_patch = keyword == Keyword::Patch;
        let subject = self.next(if is_patch { "patch" } else { "polygon" });
        let surface = self.surface(surface, subject, caller);
        match self.scene.add_polygon(corners.clone(), is_patch, surface) {
            Ok(None) => {}
            Ok(Some(oddity)) => {
                let (kind, vertex) = WarningKind::of(oddity, keyword);
                self.sink.warning(subject, kind, vertex, caller);
            }
            Err(fault) => {
                let value = value::of_corners(corners, &fault);
                self.sink.mistake(subject, fault, value.as_slice(), caller);
            }
        }
    }

    /// Returns the index of a surface, which is added unless there is an equal one. What is wrong with it is told once.
    fn surface(&mut self, surface: &Surface, subject: Subject, caller: Caller) -> u32 {
        let next = self.scene.surfaces.len() as u32;
        let index = *self.surfaces.entry(value::bits(surface)).or_insert(next);
        if index < next {
            return index;
        }
        if let Err(fault) = self.scene.add_surface(*surface) {
            (self.sink).mistake(subject, fault, &value::of_surface(surface), caller);
            self.scene.surfaces.push(Surface::default());
        }
        index
    }
}
