//! Scenes of any size from a seed.
//!
//! The same kind, size and seed give the same scene on every machine. The random numbers come from PCG, and they pass
//! only through `+ − × ÷ √`, whose results IEEE 754 defines exactly. Every number is rounded to six significant digits,
//! so that files stay short and parse to the same scene.

mod flake;
mod lattice;
mod random;
mod soup;
mod stage;
mod terrain;
mod tree;

use crate::model::Scene;
use random::Random;
use stage::Stage;

/// The kind of a generated scene. Each also has a ground polygon, three lights and a camera that sees everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SceneKind {
    /// A sphere that carries nine spheres of a third its size, which carry nine each, and so on (the `balls` of
    /// Haines's Standard Procedural Databases). Has exactly the requested size: the last generation is spread evenly
    /// over the one before.
    Flake,
    /// A cube of spheres joined by rods (cylinders). Has exactly the requested size: the outer layer may be unfinished.
    Lattice,
    /// Fractal mountains of triangles around a lake, by the diamond-square algorithm. Has
    /// 1 + 2·⌊√h⌋·⌊h/⌊√h⌋⌋ objects, where h = (size − 1)/2: at most the requested size and less than 2√size + 2 below
    /// it, but at least 3.
    Terrain,
    /// A tree in which every branch (a cone and a sphere at its tip) has three more. Has the requested size, or one
    /// less if that is even: 1 + 2·branches.
    Tree,
    /// Spheres, cones, cylinders, boxes, convex and concave polygons and patches, placed at random. Has exactly the
    /// requested size.
    Soup,
}

impl SceneKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [
        Self::Flake,
        Self::Lattice,
        Self::Terrain,
        Self::Tree,
        Self::Soup,
    ];

    /// Returns its name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flake => "flake",
            Self::Lattice => "lattice",
            Self::Terrain => "terrain",
            Self::Tree => "tree",
            Self::Soup => "soup",
        }
    }
}

/// What to generate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Spec {
    /// The kind of scene.
    pub kind: SceneKind,
    /// The requested number of objects, including the ground; [`SceneKind`] states how it is rounded. Memory and time grow
    /// linearly with it.
    pub objects: usize,
}

/// Generates the scene that `spec` and `seed` define. It satisfies the invariants of [`crate::model`].
pub fn generate(spec: Spec, seed: u64) -> Scene {
    let random = Random::new(seed);
    let mut stage = Stage::default();
    // One object is the ground, or the lake.
    let objects = spec.objects.saturating_sub(1);
    match spec.kind {
        SceneKind::Flake => flake::build(&mut stage, objects, random),
        SceneKind::Lattice => lattice::build(&mut stage, objects, random),
        SceneKind::Terrain => terrain::build(&mut stage, objects, random),
        SceneKind::Tree => tree::build(&mut stage, objects, random),
        SceneKind::Soup => soup::build(&mut stage, objects, random),
    }
    stage.finish()
}
