//! A ray as it is told: objects and lights by their numbers in the scene file.

use octray_core::observe::RayKind;
use octray_render::pixel_trace::{Effort, LeftOut, LightTest, TracedRay};
use octray_scenes::model::{Scene, Shape};
use serde::Serialize;
use std::fmt;

/// A ray with all that follows from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Node {
    /// Why it was traced.
    pub(super) kind: &'static str,
    /// The share of its light that reaches the picture.
    pub(super) weight: f64,
    /// What it met; `None` for the background.
    pub(super) object: Option<Object>,
    /// How far away, in units of the scene file.
    pub(super) distance: Option<f64>,
    /// The light along it from there, not weighted, without the rays that follow.
    pub(super) light: [f64; 3],
    #[serde(flatten)]
    pub(super) cost: Cost,
    /// The lights that the surface faces.
    pub(super) lights: Vec<Light>,
    /// The transmitted ray, the reflected ray.
    pub(super) rays: Vec<Node>,
    /// Those that were not traced.
    pub(super) not_traced: Vec<NotTraced>,
}

/// An object of the scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Object {
    /// Its kind.
    kind: &'static str,
    /// Its number among all objects of the file, counted from 1.
    pub(super) number: u32,
    /// The line on which it begins, counted from 1.
    line: u32,
}

/// A light that a surface faces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Light {
    /// Its number in the file, counted from 1.
    pub(super) light: usize,
    /// What hides it; `None` if it shines on the surface.
    pub(super) blocked_by: Option<Object>,
    #[serde(flatten)]
    pub(super) cost: Cost,
}

/// A ray that was not traced.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct NotTraced {
    /// Its kind.
    pub(super) kind: &'static str,
    /// Its weight, below the cut-off; `None` if it would bounce too often.
    pub(super) weight: Option<f64>,
}

/// What a search took.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Cost {
    /// Nodes or cells visited.
    pub(super) nodes: u64,
    /// Objects tested.
    pub(super) tests: u64,
}

/// `sphere 3, line 41`.
impl fmt::Display for Object {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, number, line } = self;
        write!(f, "{kind} {number}, line {line}")
    }
}

impl Node {
    /// `sphere 3, line 41`, or the background.
    pub(super) fn meets(&self) -> String {
        self.object
            .map_or_else(|| "background".into(), |object| object.to_string())
    }

    /// The ray of a kind that follows.
    pub(super) fn follower(&self, kind: &str) -> Option<&Self> {
        self.rays.iter().find(|ray| ray.kind == kind)
    }
}

impl Light {
    /// `lit`, or what blocks it.
    pub(super) fn state(&self) -> String {
        let blocked = |object: Object| format!("blocked by {object}");
        self.blocked_by.map_or_else(|| "lit".into(), blocked)
    }
}

impl NotTraced {
    /// Why not.
    pub(super) fn reason(&self) -> String {
        match self.weight {
            Some(weight) => format!("not traced: its weight {weight:.4} is below the cut-off"),
            None => "not traced: it would bounce too often".into(),
        }
    }
}

impl From<Effort> for Cost {
    fn from(Effort { steps, tests }: Effort) -> Self {
        Self {
            nodes: steps,
            tests,
        }
    }
}

/// What objects are called.
pub(crate) struct Names(Vec<Object>);

impl Names {
    /// The names of a scene's objects, which begin on these lines.
    pub(crate) fn new(scene: &Scene, lines: &[u32]) -> Self {
        let objects = (1..).zip(scene.objects.iter().zip(lines));
        let name =
            |(number, (object, &line)): (u32, (&octray_scenes::model::Object, &u32))| Object {
                kind: match object.shape {
                    Shape::Sphere { .. } => "sphere",
                    Shape::Cone { .. } => "cone",
                    Shape::Cuboid { .. } => "box",
                    Shape::Polygon { .. } => "polygon",
                    Shape::Patch { .. } => "patch",
                },
                number,
                line,
            };
        Self(objects.map(name).collect())
    }

    /// The object of this place in the file, counted from 0.
    pub(crate) fn object(&self, id: u32) -> Object {
        self.0[id as usize]
    }

    /// A ray as it is told.
    pub(super) fn node(&self, ray: &TracedRay) -> Node {
        let object = |id| self.object(id);
        let mut rays: Vec<_> = ray.followers.iter().map(|ray| self.node(ray)).collect();
        // The thesis's left branch is the refracted ray.
        rays.sort_by_key(|ray| ray.kind != kind(RayKind::Transmitted));
        let light = |test: &LightTest| Light {
            light: test.light + 1,
            blocked_by: test.blocker.map(object),
            cost: test.effort.into(),
        };
        let left_out = |left: &LeftOut| NotTraced {
            kind: kind(left.kind),
            weight: left.weight,
        };
        Node {
            kind: kind(ray.kind),
            weight: ray.weight,
            object: ray.hit.map(|hit| object(hit.object)),
            distance: ray.hit.map(|hit| hit.distance),
            light: ray.light,
            cost: ray.effort.into(),
            lights: ray.lights.iter().map(light).collect(),
            rays,
            not_traced: ray.left_out.iter().map(left_out).collect(),
        }
    }
}

/// The kinds of rays that follow from others, in the order in which they are told.
pub(super) const FOLLOWERS: [&str; 2] = ["transmitted", "reflected"];

fn kind(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "primary",
        RayKind::Shadow => "shadow",
        RayKind::Reflected => FOLLOWERS[1],
        RayKind::Transmitted => FOLLOWERS[0],
    }
}
