//! Scenes of any size from a seed.
//!
//! The same kind, size and seed give the same scene on every machine: the random numbers come from
//! PCG, and nothing but `+ − × ÷ √`, which IEEE 754 defines to the last bit, is done to them. Every
//! number is rounded to six significant digits, so files stay short and parse to the same scene.

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

/// What a generated scene shows, besides a ground polygon, three lights and a camera that sees all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A sphere that carries nine of a third its size, which carry nine each, and so on (the
    /// `balls` of Haines's Standard Procedural Databases). Has exactly the wished size: the last
    /// generation is spread evenly over the one before.
    Flake,
    /// A cube of spheres joined by rods (cylinders). Has exactly the wished size: the outer layer
    /// may be unfinished.
    Lattice,
    /// Fractal mountains of triangles around a lake, by the diamond-square algorithm. Has
    /// 1 + 2·⌊√h⌋·⌊h/⌊√h⌋⌋ objects, where h = (size − 1)/2: at most the wished size, and above it by
    /// less than 2√size + 2 below; at least 3.
    Terrain,
    /// A tree whose every branch (a cone and a sphere at its tip) bears three. Has the wished
    /// size, or one less if that is even: 1 + 2·branches.
    Tree,
    /// Spheres, cones, cylinders, boxes, convex and concave polygons and patches, strewn at random.
    /// Has exactly the wished size.
    Soup,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 5] = [
        Self::Flake,
        Self::Lattice,
        Self::Terrain,
        Self::Tree,
        Self::Soup,
    ];

    /// Its name, in lower case.
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
    /// What it shows.
    pub kind: Kind,
    /// The wished number of objects, the ground included; [`Kind`] says how it is rounded. Memory
    /// and time grow in proportion.
    pub objects: usize,
}

/// Generates the scene that `spec` and `seed` define. It keeps every promise of [`crate::model`].
pub fn generate(spec: Spec, seed: u64) -> Scene {
    let random = Random::new(seed);
    let mut stage = Stage::default();
    // One object is the ground, or the lake.
    let objects = spec.objects.saturating_sub(1);
    match spec.kind {
        Kind::Flake => flake::build(&mut stage, objects, random),
        Kind::Lattice => lattice::build(&mut stage, objects, random),
        Kind::Terrain => terrain::build(&mut stage, objects, random),
        Kind::Tree => tree::build(&mut stage, objects, random),
        Kind::Soup => soup::build(&mut stage, objects, random),
    }
    stage.finish()
}
