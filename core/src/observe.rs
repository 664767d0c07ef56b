//! What the tracer tells whoever wants to know: rays by kind, steps, tests.

use crate::object::ObjectKind;

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

/// Is told what happens while a picture is traced. All methods are empty by default: with `()`
/// as the observer nothing of it is left in the machine code.
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
    /// A ray came to a node of the octree, leaf or not, and to the boxes of so many children.
    #[inline(always)]
    fn step(&mut self, _children: usize) {}
    /// A ray was tested against an object of a kind, and met it or not.
    #[inline(always)]
    fn test(&mut self, _: ObjectKind, _met: bool) {}
    /// A test came to an outline, and to so many of its edges: the ray meets a polygon's plane in
    /// the polygon's box, and nearer than the limit. Triangles do not tell.
    #[inline(always)]
    fn edges(&mut self, _: usize) {}
    /// A test came to a cone's side: the ray meets the sphere around it.
    #[inline(always)]
    fn side(&mut self) {}
    /// This many rays wait on the stack.
    #[inline(always)]
    fn queued(&mut self, _: usize) {}
}

impl Observer for () {}

/// Counts everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays by [`RayKind`].
    pub rays: [u64; 4],
    /// Shadow rays that met something.
    pub blocked: u64,
    /// Primary, reflected and transmitted rays that met something, by [`RayKind`].
    pub hits: [u64; 4],
    /// The most rays that ever waited on the stack.
    pub deepest: u64,
    /// Steps and tests: of rays that look for the closest hit, and of shadow rays.
    pub queries: [QueryCounts; 2],
    /// Which of the two is going on, 0 or 1.
    pub query: usize,
}

/// What searches did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueryCounts {
    /// Octree nodes visited.
    pub steps: u64,
    /// Their children.
    pub children: u64,
    /// Object tests by [`ObjectKind`].
    pub tests: [u64; 5],
    /// Those of them that met the object.
    pub met: [u64; 5],
    /// Outlines of polygons, triangles left out, that tests came to.
    pub outlines: u64,
    /// Those of their edges that were looked at.
    pub edges: u64,
    /// Sides of cones that tests came to.
    pub sides: u64,
}

impl QueryCounts {
    fn add(&mut self, other: &Self) {
        self.steps += other.steps;
        self.children += other.children;
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

    /// Octree nodes visited.
    pub fn steps(&self) -> u64 {
        self.queries.iter().map(|search| search.steps).sum()
    }

    /// Object tests.
    pub fn tests(&self) -> u64 {
        self.queries.iter().flat_map(|search| search.tests).sum()
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
        for (mine, theirs) in self.queries.iter_mut().zip(&other.queries) {
            mine.add(theirs);
        }
    }
}

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
        let search = &mut self.queries[self.query & 1];
        search.steps += 1;
        search.children += children as u64;
    }
    #[inline(always)]
    fn test(&mut self, kind: ObjectKind, met: bool) {
        let search = &mut self.queries[self.query & 1];
        search.tests[kind as usize] += 1;
        search.met[kind as usize] += u64::from(met);
    }
    #[inline(always)]
    fn edges(&mut self, count: usize) {
        let search = &mut self.queries[self.query & 1];
        search.outlines += 1;
        search.edges += count as u64;
    }
    #[inline(always)]
    fn side(&mut self) {
        self.queries[self.query & 1].sides += 1;
    }
    #[inline(always)]
    fn queued(&mut self, count: usize) {
        self.deepest = self.deepest.max(count as u64);
    }
}
