//! The scene: the contents of a scene file, in `f64` and in scene units, nothing derived.
//!
//! The parser and the [builder](crate::builder) have checked these invariants: every number is finite, every shape has
//! an extent, every surface index is in range. Code that makes a [`Scene`] by other means must satisfy them too, or call
//! [`crate::check::scene`] on the result.

/// A point or a direction in scene units.
pub type Point = [f64; 3];

/// Linear red, green and blue; 1 is full intensity, larger values are allowed.
pub type Colour = [f64; 3];

/// A whole scene file.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Columns of the picture as the file has it, 1 to 65535.
    pub width: u32,
    /// Rows of the picture as the file has it, 1 to 65535.
    pub height: u32,
    /// The colour of a ray that hits nothing.
    pub background: Colour,
    /// The colour of such a ray that goes straight up, if the sky is not of one colour: `background` is that of a ray
    /// straight down then.
    pub zenith: Option<Colour>,
    /// Point lights, in file order.
    pub lights: Vec<Light>,
    /// Surface properties, in file order.
    pub surfaces: Vec<Surface>,
    /// Objects, in file order; an object's index is its identity everywhere in octray.
    pub objects: Vec<Object>,
    /// Vertices of all polygons and patches; shapes hold ranges of it.
    pub vertices: Vec<Point>,
    /// Vertex normals of all patches, as written in the file (any length but zero).
    pub normals: Vec<Point>,
    /// Two opposite corners of a box in which objects, lights and the viewpoint are to have room to move.
    /// What is outside of it can stay there.
    pub room: Option<[Point; 2]>,
}

/// A picture of 512 × 512 black pixels, seen from one unit before them.
impl Default for Scene {
    fn default() -> Self {
        Self {
            camera: Camera::Thesis {
                viewpoint: [0.0, 0.0, 1.0],
                projection: Projection::Perspective,
            },
            width: 512,
            height: 512,
            background: [0.0; 3],
            zenith: None,
            lights: Vec::new(),
            surfaces: Vec::new(),
            objects: Vec::new(),
            vertices: Vec::new(),
            normals: Vec::new(),
            room: None,
        }
    }
}

/// The camera of `docs/MODEL.md` in either of its forms.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Camera {
    /// The picture plane is z = 0 and one pixel (of the file's own resolution) is one unit.
    Thesis {
        /// The eye; its z is never zero.
        viewpoint: Point,
        /// How rays leave the eye.
        projection: Projection,
    },
    /// The camera of NFF.
    Nff {
        /// The eye.
        from: Point,
        /// The point in the centre of the picture.
        at: Point,
        /// The direction that is up in the picture; never parallel to the view.
        up: Point,
        /// Degrees between the centres of the first and the last row, inside (0, 180).
        angle: f64,
        /// How rays leave the camera.
        projection: Projection,
    },
}

/// How rays leave the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Projection {
    /// From the eye through the picture plane.
    Perspective,
    /// Side by side, along the view.
    Parallel,
}

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Light {
    /// Its position.
    pub position: Point,
    /// Its brightness per channel; never negative. An NFF light without a colour holds 1/√(number of lights) in each
    /// channel.
    pub colour: Colour,
}

/// The properties of a surface, in the thesis's terms for either dialect. The default is black.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Surface {
    /// Light that the surface emits without any light source.
    pub ambient: Colour,
    /// Diffuse coefficients.
    pub diffuse: Colour,
    /// Specular coefficients.
    pub specular: Colour,
    /// Exponent of the specular term, any real ≥ 0.
    pub shine: f64,
    /// Share of the mirror ray's light, ≥ 0.
    pub reflect: f64,
    /// Share of the transmitted ray's light, ≥ 0; opaque if 0.
    pub refract: f64,
    /// Refraction index of the inside; > 0 where `refract` > 0, else 1.
    pub ior: f64,
    /// Other colours in every second cube of space.
    pub checker: Option<Checker>,
}

/// The colours of a surface where ⌊x/s⌋ + ⌊y/s⌋ + ⌊z/s⌋ is odd, s the size.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checker {
    /// The side of the cubes, > 0.
    pub size: f64,
    /// [`Surface::ambient`] there.
    pub ambient: Colour,
    /// [`Surface::diffuse`] there.
    pub diffuse: Colour,
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            ambient: [0.0; 3],
            diffuse: [0.0; 3],
            specular: [0.0; 3],
            shine: 0.0,
            reflect: 0.0,
            refract: 0.0,
            ior: 1.0,
            checker: None,
        }
    }
}

/// One object.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Object {
    /// Its geometry.
    pub shape: Shape,
    /// Index into [`Scene::surfaces`].
    pub surface: u32,
}

/// The geometry of one object.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// Centre.
        centre: Point,
        /// Radius, > 0 (the parser drops the sign).
        radius: f64,
    },
    /// The side surface of a truncated cone or a cylinder, without end caps.
    Cone {
        /// Centre of the base circle.
        base: Point,
        /// Radius of the base circle, ≥ 0.
        base_radius: f64,
        /// Centre of the top circle; differs from `base`.
        top: Point,
        /// Radius of the top circle, ≥ 0; not both radii are 0.
        top_radius: f64,
    },
    /// An axis-aligned box.
    Cuboid {
        /// Centre.
        centre: Point,
        /// Full side lengths, > 0.
        size: Point,
    },
    /// A planar polygon, convex, concave or self-intersecting (even–odd).
    Polygon {
        /// Its first vertex in [`Scene::vertices`].
        first: u32,
        /// How many vertices, ≥ 3.
        count: u32,
    },
    /// A planar polygon with a normal at each vertex.
    Patch {
        /// Its first vertex in [`Scene::vertices`].
        first: u32,
        /// How many vertices, ≥ 3.
        count: u32,
        /// The normal of its first vertex in [`Scene::normals`].
        first_normal: u32,
    },
}
