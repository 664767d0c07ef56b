//! Events of tracing: rays by kind, steps, tests, and what found no room.

use crate::accel::Hit;
use crate::object::{ObjectKind, ObjectRef};
use crate::trace::QueuedRay;
use crate::vec3::Vec3;

/// Why a ray is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// From a surface point to a light.
    Shadow,
    /// In the mirror direction.
    Reflected,
    /// Through a transparent surface.
    Transmitted,
}

/// Receives the events of tracing. All methods are empty by default: with `()` as the observer
/// nothing of it is left in the machine code.
///
/// ```
/// use octray_core::observe::{Observer, RayKind};
///
/// /// Counts shadow rays.
/// struct Shadows(u32);
///
/// impl Observer for Shadows {
///     fn ray(&mut self, kind: RayKind) {
///         self.0 += u32::from(kind == RayKind::Shadow);
///     }
/// }
///
/// let mut shadows = Shadows(0);
/// shadows.ray(RayKind::Shadow);
/// shadows.step(8);
/// assert_eq!(shadows.0, 1);
/// ```
pub trait Observer {
    /// A ray starts.
    #[inline(always)]
    fn ray(&mut self, _: RayKind) {}
    /// A shadow ray met something on its way to the light.
    #[inline(always)]
    fn blocked(&mut self) {}
    /// A ray of the given kind, not a shadow ray, met something.
    #[inline(always)]
    fn hit(&mut self, _: RayKind) {}
    /// A query visits a node of the accelerator and tests the boxes of its children.
    #[inline(always)]
    fn step(&mut self, _children: usize) {}
    /// A walk from cell to cell enters a leaf of an octree, empty or not, or crosses what is around a
    /// cluster box.
    #[inline(always)]
    fn voxel(&mut self) {}
    /// A ray was tested against an object of this kind, and met it or not.
    #[inline(always)]
    fn test(&mut self, _: ObjectKind, _met: bool) {}
    /// A test reached a polygon's outline and looked at this many of its edges: the ray meets the
    /// polygon's plane within the polygon's box and the limit. Triangles do not report it.
    #[inline(always)]
    fn edges(&mut self, _: usize) {}
    /// A test reached a cone's side: the ray meets the cone's bounding sphere.
    #[inline(always)]
    fn side(&mut self) {}
    /// This many rays wait to be traced.
    #[inline(always)]
    fn queued(&mut self, _: usize) {}
    /// A ray found no room in [`Workspace::rays`](crate::trace::Workspace::rays) and was not
    /// traced: the picture lacks its light.
    #[inline(always)]
    fn dropped_ray(&mut self) {}
    /// A node or leaf found no room on an accelerator's stack and was not visited: the picture may
    /// lack objects.
    #[inline(always)]
    fn dropped_child(&mut self) {}
    /// A shadow ray leads to a light for which the shadow cache has no place. The picture is the
    /// same, only slower.
    #[inline(always)]
    fn uncached_light(&mut self) {}
    /// Whether to trace no more: asked before each ray that is no shadow ray. The pixel then lacks
    /// the light of the rays that were not traced.
    #[inline(always)]
    fn stopped(&mut self) -> bool {
        false
    }
}

impl Observer for () {}

/// An observer that is also told of each ray what it meets and brings. All methods are empty by default.
///
/// Rays come depth first: a ray follows from the last one before it whose depth is one less.
pub trait RayObserver<S>: Observer {
    /// This ray, no shadow ray, is traced next.
    #[inline(always)]
    fn begins(&mut self, _: &QueuedRay<S>) {}
    /// It meets this first. Not called for a ray that meets nothing.
    #[inline(always)]
    fn meets(&mut self, _: Hit<S>) {}
    /// The surface there faces the light of this index; what blocks it is given, if anything does. Lights behind the
    /// surface are not told.
    #[inline(always)]
    fn looked_for_light(&mut self, _: usize, _blocker: Option<ObjectRef>) {}
    /// A ray that would follow is not traced: because of this weight, or of its depth.
    #[inline(always)]
    fn not_followed(&mut self, _: RayKind, _weight: Option<S>) {}
    /// The ray is done: this much light comes along it from the first surface or the background, not weighted and
    /// without what follows.
    #[inline(always)]
    fn brings(&mut self, _: Vec3<S>) {}
}

impl<S> RayObserver<S> for () {}

/// Counts all events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counters {
    /// Rays by [`RayKind`].
    pub rays: [u64; 4],
    /// Shadow rays that met something.
    pub blocked: u64,
    /// Primary, reflected and transmitted rays that met something, by [`RayKind`].
    pub hits: [u64; 4],
    /// The most rays that ever waited.
    pub deepest: u64,
    /// What found no room.
    pub dropped: Dropped,
    /// Steps and tests: of queries for the closest hit, and of those along shadow rays.
    pub queries: [QueryCounts; 2],
    /// Which of the two is under way, 0 or 1.
    pub query: usize,
}

/// What found no room. All of it is 0 with a workspace that [`Tracer::workspace`] has approved.
///
/// [`Tracer::workspace`]: crate::trace::Tracer::workspace
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Dropped {
    /// Reflected and transmitted rays that were not traced: the picture lacks their light.
    pub rays: u64,
    /// Nodes and leaves that were not visited: the picture may lack objects.
    pub children: u64,
    /// Shadow rays to lights beyond the shadow cache: the picture is the same, only slower.
    pub uncached: u64,
}

impl Dropped {
    /// Whether the picture lacks something.
    pub const fn harms(&self) -> bool {
        self.rays != 0 || self.children != 0
    }

    fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.children += other.children;
        self.uncached += other.uncached;
    }
}

/// What queries of an accelerator did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct QueryCounts {
    /// Nodes of the accelerator visited.
    pub steps: u64,
    /// Their children.
    pub children: u64,
    /// Cells of an octree crossed by a walk from cell to cell.
    pub voxels: u64,
    /// Object tests by [`ObjectKind`].
    pub tests: [u64; 5],
    /// Those of them that met the object.
    pub met: [u64; 5],
    /// Outlines of polygons, without triangles, that tests reached.
    pub outlines: u64,
    /// Those of their edges that were looked at.
    pub edges: u64,
    /// Sides of cones that tests reached.
    pub sides: u64,
}

impl QueryCounts {
    fn add(&mut self, other: &Self) {
        self.steps += other.steps;
        self.children += other.children;
        self.voxels += other.voxels;
        self.outlines += other.outlines;
        self.edges += other.edges;
        self.sides += other.sides;
        for kind in 0..5 {
            self.tests[kind] += other.tests[kind];
            self.met[kind] += other.met[kind];
        }
    }
}

impl Counters {
    /// Rays of one kind.
    pub const fn rays_of(&self, kind: RayKind) -> u64 {
        self.rays[kind as usize]
    }

    /// Rays of all kinds.
    pub fn all_rays(&self) -> u64 {
        self.rays.iter().sum()
    }

    /// Nodes of the accelerator visited.
    pub fn steps(&self) -> u64 {
        self.queries.iter().map(|query| query.steps).sum()
    }

    /// Cells of an octree crossed by a walk from cell to cell.
    pub fn voxels(&self) -> u64 {
        self.queries.iter().map(|query| query.voxels).sum()
    }

    /// Object tests.
    pub fn tests(&self) -> u64 {
        self.queries.iter().flat_map(|query| query.tests).sum()
    }

    /// Adds another count to this one.
    pub fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.rays.iter_mut().zip(other.rays) {
            *mine += theirs;
        }
        for (mine, theirs) in self.hits.iter_mut().zip(other.hits) {
            *mine += theirs;
        }
        self.blocked += other.blocked;
        self.deepest = self.deepest.max(other.deepest);
        self.dropped.add(&other.dropped);
        for (mine, theirs) in self.queries.iter_mut().zip(&other.queries) {
            mine.add(theirs);
        }
    }
}

impl<S> RayObserver<S> for Counters {}

impl Observer for Counters {
    #[inline(always)]
    fn ray(&mut self, kind: RayKind) {
        self.rays[kind as usize] += 1;
        self.query = usize::from(kind == RayKind::Shadow);
    }
    #[inline(always)]
    fn blocked(&mut self) {
        self.blocked += 1;
    }
    #[inline(always)]
    fn hit(&mut self, kind: RayKind) {
        self.hits[kind as usize] += 1;
    }
    #[inline(always)]
    fn step(&mut self, children: usize) {
        let query = &mut self.queries[self.query & 1];
        query.steps += 1;
        query.children += children as u64;
    }
    #[inline(always)]
    fn voxel(&mut self) {
        self.queries[self.query & 1].voxels += 1;
    }
    #[inline(always)]
    fn test(&mut self, kind: ObjectKind, met: bool) {
        let query = &mut self.queries[self.query & 1];
        query.tests[kind as usize] += 1;
        query.met[kind as usize] += u64::from(met);
    }
    #[inline(always)]
    fn edges(&mut self, count: usize) {
        let query = &mut self.queries[self.query & 1];
        query.outlines += 1;
        query.edges += count as u64;
    }
    #[inline(always)]
    fn side(&mut self) {
        self.queries[self.query & 1].sides += 1;
    }
    #[inline(always)]
    fn queued(&mut self, count: usize) {
        self.deepest = self.deepest.max(count as u64);
    }
    #[inline(always)]
    fn dropped_ray(&mut self) {
        self.dropped.rays += 1;
    }
    #[inline(always)]
    fn dropped_child(&mut self) {
        self.dropped.children += 1;
    }
    #[inline(always)]
    fn uncached_light(&mut self) {
        self.dropped.uncached += 1;
    }
}
