//! Writes the tables as Rust source.

use super::BakeOptions;
use crate::literal::Literal;
use crate::quantise::Prepared;
use octray_core::accel;
use octray_core::camera::Projection;
use octray_core::checker::Checker;
use octray_core::features::{self, FeatureSet};
use octray_core::frame::FrameParams;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::ray::Aabb;
use octray_core::scene::{Attributes, Light, Parallax, Surface};
use octray_core::shape::{Bands, Cone, Cuboid, Patch, Plane, Polygon, Sphere, Triangle};
use octray_core::vec3::{Axis, Vec3};
use octray_core::world::World;
use std::fmt::{self, Display, Formatter};

/// The contents of the source.
pub(super) struct Tables<'a, S: Literal> {
    pub(super) prepared: &'a Prepared<S>,
    pub(super) tree: Tree,
    /// The objects, leaf by leaf.
    pub(super) links: &'a [ObjectRef],
    pub(super) features: FeatureSet,
    pub(super) rays: usize,
    pub(super) options: &'a BakeOptions<'a>,
}

/// The accelerator.
pub(super) enum Tree {
    /// None: a list of all objects.
    None,
    /// The compact BVH's nodes, its tick, and the maximum number of nodes on the traversal stack.
    Packed(Vec<u32>, u32, usize),
    /// The device builds the tree: its size in words, and its options.
    Device(usize, accel::BuildOptions),
}

impl Tree {
    fn words(&self) -> &[u32] {
        match self {
            Self::Packed(words, ..) => words,
            _ => &[],
        }
    }

    /// Returns the maximum number of nodes on the traversal stack.
    pub(super) fn nodes(&self) -> usize {
        match self {
            Self::None => 0,
            Self::Packed(_, _, nodes) => *nodes,
            Self::Device(..) => accel::COMPACT_STACK_SIZE,
        }
    }

    /// Returns the words of the tree, here or on the device.
    pub(super) fn room(&self) -> usize {
        match self {
            Self::Device(words, _) => *words,
            _ => self.words().len(),
        }
    }
}

impl<S: Literal> Tables<'_, S> {
    /// Returns the bytes of all arrays.
    pub(super) fn bytes(&self) -> usize {
        let scene = &self.prepared.scene;
        size_of_val(&*scene.spheres)
            + size_of_val(&*scene.triangles)
            + size_of_val(&*scene.polygons)
            + size_of_val(&*scene.cones)
            + size_of_val(&*scene.cuboids)
            + size_of_val(&*scene.corners)
            + size_of_val(&*scene.bands)
            + size_of_val(&*scene.edges)
            + size_of_val(&*scene.patches)
            + size_of_val(&*scene.normals)
            + size_of_val(scene.scene().attributes)
            + size_of_val(self.baked_links())
            + size_of_val(&*scene.surfaces)
            + size_of_val(&*scene.checkers)
            + size_of_val(&*scene.lights)
            + size_of_val(self.tree.words())
    }

    /// Returns the links, unless the device makes its own.
    fn baked_links(&self) -> &[ObjectRef] {
        match self.tree {
            Tree::Device(..) => &[],
            _ => self.links,
        }
    }
}

impl<S: Literal> Display for Tables<'_, S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.head(f)?;
        let scene = &self.prepared.scene;
        array(f, "SPHERES", "shape::Sphere<S>", &scene.spheres, sphere)?;
        let triangles = &scene.triangles;
        array(f, "TRIANGLES", "shape::Triangle<S>", triangles, triangle)?;
        array(f, "POLYGONS", "shape::Polygon<S>", &scene.polygons, polygon)?;
        array(f, "CONES", "shape::Cone<S>", &scene.cones, cone)?;
        array(f, "CUBOIDS", "shape::Cuboid<S>", &scene.cuboids, cuboid)?;
        array(f, "CORNERS", "[S; 2]", &scene.corners, pair)?;
        array(f, "BANDS", "u32", &scene.bands, u32::to_string)?;
        array(f, "EDGES", "[[S; 2]; 2]", &scene.edges, |[a, b]| {
            format!("[{}, {}]", pair(a), pair(b))
        })?;
        array(f, "PATCHES", "shape::Patch<S>", &scene.patches, patch)?;
        array(f, "NORMALS", "vec3::Vec3<S>", &scene.normals, vector)?;
        let seen = scene.scene();
        array(
            f,
            "ATTRIBUTES",
            "scene::Attributes",
            seen.attributes,
            attributes,
        )?;
        array(f, "SURFACES", "scene::Surface<S>", &scene.surfaces, surface)?;
        array(
            f,
            "CHECKERS",
            "checker::Checker<S>",
            &scene.checkers,
            checker,
        )?;
        array(f, "LAMPS", "scene::Light<S>", &scene.lights, light)?;
        array(f, "LINKS", "object::ObjectRef", self.baked_links(), link)?;
        array(f, "WORDS", "u32", self.tree.words(), |w| {
            format!("{w:#010x}")
        })?;
        writeln!(
            f,
            "\n/// The scene.\npub static SCENE: scene::Scene<'static, S, FEATURES> = scene::Scene {{\n    \
             shapes: shape::Shapes {{\n        \
             spheres: &SPHERES,\n        triangles: &TRIANGLES,\n        polygons: &POLYGONS,\n        \
             cones: &CONES,\n        cuboids: &CUBOIDS,\n        \
             outlines: shape::Outlines {{ corners: &CORNERS, bands: &BANDS, edges: &EDGES }},\n        \
             patches: &PATCHES,\n        normals: &NORMALS,\n        slack: {},\n    }},\n    \
             attributes: &ATTRIBUTES,\n    first: {:?},\n    surfaces: &SURFACES,\n    \
             lights: &LAMPS,\n    background: {},\n    \
             sky: scene::Sky {{ rise: {}, up: {} }},\n    checkers: &CHECKERS,\n    diameter: {},\n}};",
            number(scene.slack),
            seen.first,
            vector(&scene.background),
            vector(&scene.sky.rise),
            vector(&scene.sky.up),
            number(scene.diameter),
        )?;
        let tree = match &self.tree {
            Tree::None => "accel::BruteForce(&LINKS)".into(),
            Tree::Packed(_, tick, _) => {
                format!(
                    "match accel::CompactBvh8::new(&WORDS, &LINKS, {tick}) {{\n    Ok(tree) => tree,\n    Err(_) => panic!(\"the traversal stack is too small\"),\n}}"
                )
            }
            Tree::Device(..) => String::new(),
        };
        if !tree.is_empty() {
            writeln!(
                f,
                "\n/// Its tree.\npub static TREE: Tree = {tree};\n\n\
                 /// What is traced, and how far.\n\
                 pub static TRACER: trace::Tracer<'static, S, Tree, FEATURES> = trace::Tracer {{\n    \
                 scene: &SCENE,\n    accelerator: &TREE,\n    max_depth: MAX_DEPTH,\n    cut_off: CUT_OFF,\n}};"
            )?;
        }
        writeln!(
            f,
            "\n/// Its picture.\n\
             pub static FRAME: frame::Frame<S> = frame::Frame::from_params({});",
            params(self.prepared.frame.params())
        )
    }
}

impl<S: Literal> Tables<'_, S> {
    /// Returns the objects in the order of the scene file.
    fn by_id(&self) -> String {
        let scene = self.prepared.scene.scene();
        let mut objects: Vec<_> = scene.shapes.refs().collect();
        objects.sort_by_key(|object| scene.attributes_of(*object).id);
        objects.iter().map(link).collect::<Vec<_>>().join(", ")
    }

    fn head(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let BakeOptions { name, settings, .. } = self.options;
        let title = octray_scenes::name::line(name);
        let raw = S::RAW;
        let params = self.prepared.frame.params();
        let tree = match self.tree {
            Tree::None => "accel::BruteForce<'static>".into(),
            Tree::Packed(_, _, nodes) => format!("accel::CompactBvh8<'static, {nodes}>"),
            Tree::Device(..) => "accel::CompactBvh8<'static>".into(),
        };
        let device = match &self.tree {
            Tree::Device(words, accel::BuildOptions { depth, leaf_size }) => format!(
                "/// The words of the tree on the device.\npub const TREE_WORDS: usize = {words};\n\
                 /// How the tree is built.\npub const GROWTH: accel::BuildOptions = \
                 accel::BuildOptions {{ depth: {depth}, leaf_size: {leaf_size} }};\n"
            ),
            _ => String::new(),
        };
        let needed: Vec<_> = features::NAMES
            .into_iter()
            .filter(|(_, what)| features::contains(self.features, *what))
            .map(|(name, _)| format!("features::{name}"))
            .collect();
        let needed = match &*needed {
            [] => "0".into(),
            some => some.join(" | "),
        };
        let World {
            centre,
            exponent,
            diagonal,
            rounding,
        } = self.prepared.world;
        let scale = self.prepared.world.scale();
        let nearest = S::NEAREST;
        let trace = match self.tree {
            Tree::Device(..) => "",
            _ => "trace, ",
        };
        let by_id = self.by_id();
        writeln!(
            f,
            "// {title}, baked by octray in {} at {} x {}.\n\
             use octray_core::{{accel, camera, checker, features, frame, object, scalar, scene, shape, {trace}vec3, world}};\n\n\
             /// The arithmetic.\npub type S = {};\n/// The kind of tree.\npub type Tree = {tree};\n\
             /// The features that the scene uses.\npub const FEATURES: features::FeatureSet = {needed};\n\
             /// The scene's name.\npub const NAME: &str = {name:?};\n\
             /// The arithmetic's name.\npub const ARITH: &str = {:?};\n\
             /// Columns.\npub const WIDTH: u32 = {};\n/// Rows.\npub const HEIGHT: u32 = {};\n\
             /// The maximum number of bounces.\npub const MAX_DEPTH: u32 = {};\n\
             /// Rays of a smaller weight are not traced.\npub const CUT_OFF: S = {};\n\
             /// The maximum number of queued rays.\npub const RAYS: usize = {};\n\
             /// The number of lights.\npub const LIGHTS: usize = {};\n\
             /// The number of objects.\npub const OBJECTS: usize = {};\n\
             {device}\
             /// The place of the scene in the numbers of the arithmetic.\n\
             pub const WORLD: world::World = world::World {{\n    \
             centre: {centre:?},\n    exponent: {exponent},\n    diagonal: {diagonal:?},\n    \
             rounding: {rounding:?},\n}};\n\
             /// The objects by their place in the scene file, counted from 0.\n\
             pub const BY_ID: [object::ObjectRef; OBJECTS] = [{by_id}];\n\n\
             const fn n(raw: {raw}) -> S {{\n    {}\n}}\n\n\
             const fn v(x: {raw}, y: {raw}, z: {raw}) -> vec3::Vec3<S> {{\n    \
             vec3::vec3(n(x), n(y), n(z))\n}}\n\n\
             const fn nearest(x: f64) -> S {{\n    {nearest}\n}}\n\n\
             /// A length of the scene, in its units.\n\
             pub const fn length(x: f32) -> S {{\n    nearest(x as f64 * {scale:?})\n}}\n\n\
             /// A point of the scene, in its units.\n\
             pub const fn place(p: [f32; 3]) -> vec3::Vec3<S> {{\n    \
             vec3::vec3(\n        \
             nearest((p[0] as f64 - WORLD.centre[0]) * {scale:?}),\n        \
             nearest((p[1] as f64 - WORLD.centre[1]) * {scale:?}),\n        \
             nearest((p[2] as f64 - WORLD.centre[2]) * {scale:?}),\n    )\n}}\n",
            S::NAME,
            params.width,
            params.height,
            S::type_name(),
            S::NAME,
            params.width,
            params.height,
            settings.max_depth,
            number(S::from_f64(settings.cut_off)),
            self.rays,
            self.prepared.scene.lights.len(),
            self.links.len(),
            S::FROM_RAW,
        )
    }
}

fn array<T>(
    f: &mut Formatter<'_>,
    name: &str,
    of: &str,
    things: &[T],
    source: impl Fn(&T) -> String,
) -> fmt::Result {
    array_of(f, name, of, &mut things.iter().map(source))
}

/// One function for all types of things, which would otherwise be compiled a hundred times.
fn array_of(
    f: &mut Formatter<'_>,
    name: &str,
    of: &str,
    things: &mut dyn ExactSizeIterator<Item = String>,
) -> fmt::Result {
    writeln!(f, "pub static {name}: [{of}; {}] = [", things.len())?;
    for thing in things {
        writeln!(f, "    {thing},")?;
    }
    writeln!(f, "];")
}

fn number<S: Literal>(x: S) -> String {
    format!("n({})", x.raw())
}

fn vector<S: Literal>(v: &Vec3<S>) -> String {
    format!("v({}, {}, {})", v.x.raw(), v.y.raw(), v.z.raw())
}

fn pair<S: Literal>([a, b]: &[S; 2]) -> String {
    format!("[{}, {}]", number(*a), number(*b))
}

fn bounds<S: Literal>(b: &Aabb<S>) -> String {
    let (low, high) = (vector(&b.low), vector(&b.high));
    format!("octray_core::ray::Aabb {{ low: {low}, high: {high} }}")
}

fn axis(axis: Axis) -> String {
    format!("vec3::Axis::{axis:?}")
}

fn flat<S: Literal>(plane: &Plane<S>) -> String {
    format!(
        "shape::Plane {{ normal: {}, offset: {}, axis: {} }}",
        vector(&plane.normal),
        number(plane.offset),
        axis(plane.axis)
    )
}

fn sphere<S: Literal>(sphere: &Sphere<S>) -> String {
    let (centre, radius) = (vector(&sphere.centre), number(sphere.radius));
    format!("shape::Sphere {{ centre: {centre}, radius: {radius} }}")
}

fn triangle<S: Literal>(triangle: &Triangle<S>) -> String {
    let [a, b, c] = &triangle.corners;
    format!(
        "shape::Triangle {{ plane: {}, corners: [{}, {}, {}], depth: {} }}",
        flat(&triangle.plane),
        pair(a),
        pair(b),
        pair(c),
        pair(&triangle.depth)
    )
}

fn polygon<S: Literal>(polygon: &Polygon<S>) -> String {
    let Bands {
        first,
        count,
        low,
        scale,
    } = polygon.bands;
    format!(
        "shape::Polygon {{ plane: {}, first: {}, count: {}, bounds: {}, \
         bands: shape::Bands {{ first: {first}, count: {count}, low: {}, scale: {} }} }}",
        flat(&polygon.plane),
        polygon.first,
        polygon.count,
        bounds(&polygon.bounds),
        number(low),
        S::reciprocal_source(scale)
    )
}

fn cone<S: Literal>(cone: &Cone<S>) -> String {
    format!(
        "shape::Cone {{ centre: {}, axis: {}, half_length: {}, mid_radius: {}, sin: {}, cos: {}, \
         half_widening: {}, bounding_radius: {}, exponent: {}, bounds: {} }}",
        vector(&cone.centre),
        vector(&cone.axis),
        number(cone.half_length),
        number(cone.mid_radius),
        number(cone.sin),
        number(cone.cos),
        number(cone.half_widening),
        number(cone.bounding_radius),
        cone.exponent,
        bounds(&cone.bounds)
    )
}

fn cuboid<S: Literal>(cuboid: &Cuboid<S>) -> String {
    let (low, high) = (vector(&cuboid.low), vector(&cuboid.high));
    format!("shape::Cuboid {{ low: {low}, high: {high} }}")
}

fn patch<S: Literal>(patch: &Patch<S>) -> String {
    format!(
        "shape::Patch {{ first_normal: {}, exponent: {}, least_area: {} }}",
        patch.first_normal,
        patch.exponent,
        number(patch.least_area)
    )
}

fn attributes(attributes: &Attributes) -> String {
    let Attributes { id, surface, patch } = attributes;
    match *patch {
        Attributes::FLAT => format!(
            "scene::Attributes {{ id: {id}, surface: {surface}, patch: scene::Attributes::FLAT }}"
        ),
        _ => format!("scene::Attributes {{ id: {id}, surface: {surface}, patch: {patch} }}"),
    }
}

fn surface<S: Literal>(surface: &Surface<S>) -> String {
    format!(
        "scene::Surface {{ ambient: {}, diffuse: {}, specular: {}, \
         shine: scalar::Exponent {{ whole: {}, fraction: {} }}, reflect: {}, refract: {}, \
         entering: {}, leaving: {}, checker: {} }}",
        vector(&surface.ambient),
        vector(&surface.diffuse),
        vector(&surface.specular),
        surface.shine.whole,
        number(surface.shine.fraction),
        number(surface.reflect),
        number(surface.refract),
        number(surface.entering),
        number(surface.leaving),
        surface.checker
    )
}

fn checker<S: Literal>(checker: &Checker<S>) -> String {
    format!(
        "checker::Checker {{ ambient: {}, diffuse: {}, origin: {:?}, cells: {:?}, shift: {}, odd: {} }}",
        vector(&checker.ambient),
        vector(&checker.diffuse),
        checker.origin,
        checker.cells,
        checker.shift,
        checker.odd
    )
}

fn light<S: Literal>(light: &Light<S>) -> String {
    let (position, colour) = (vector(&light.position), vector(&light.colour));
    let parallax = match &light.parallax {
        None => "None".into(),
        Some(Parallax { share, exponent }) => {
            let share = number(*share);
            format!("Some(scene::Parallax {{ share: {share}, exponent: {exponent} }})")
        }
    };
    format!("scene::Light {{ position: {position}, colour: {colour}, parallax: {parallax} }}")
}

fn link(link: &ObjectRef) -> String {
    let kind: ObjectKind = link.kind();
    let mark = if link.is_last() {
        ".marked_last(true)"
    } else {
        ""
    };
    format!(
        "object::ObjectRef::new(object::ObjectKind::{kind:?}, {}){mark}",
        link.index()
    )
}

fn params<S: Literal>(params: &FrameParams<S>) -> String {
    let camera = &params.camera;
    let projection = match camera.projection {
        Projection::Perspective => "Perspective",
        Projection::Parallel => "Parallel",
    };
    format!(
        "frame::FrameParams {{\n    camera: camera::Camera {{\n        origin: {},\n        \
         forward: {},\n        right: {},\n        up: {},\n        \
         projection: camera::Projection::{projection},\n    }},\n    \
         active: frame::Region {{ columns: {:?}, rows: {:?} }},\n    block: {},\n    \
         samples: {},\n    width: WIDTH,\n    height: HEIGHT,\n    inv_width: {},\n    inv_height: {},\n    \
         sample_weight: {},\n}}",
        vector(&camera.origin),
        vector(&camera.forward),
        vector(&camera.right),
        vector(&camera.up),
        params.active.columns,
        params.active.rows,
        params.block,
        params.samples,
        S::reciprocal_source(params.inv_width),
        S::reciprocal_source(params.inv_height),
        number(params.sample_weight),
    )
}
