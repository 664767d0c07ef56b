//! The 8-wide BVH in less than a quarter of the memory, walked in 16-bit integers whatever the
//! arithmetic: for targets with little memory, no floating-point unit, or no wide multiplication.
//!
//! Boxes of children are quantised to 8 bits relative to their node, as in Mahovsky and Wyvill,
//! "Memory-Conserving Bounding Volume Hierarchies with Coherent Raytracing" (2006), and in Ylitie,
//! Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs" (2017).
//!
//! Coordinates are on the *grid*: [`BoundScalar::to_grid`](super::BoundScalar::to_grid) maps a
//! scene's numbers to integers whose differences stay below 2³¹. Boxes and distances are in *ticks*,
//! the power of two of grid units of which the scene's diameter has 2¹³ to 2¹⁴: products of two such
//! numbers fit 32 bits.
//!
//! A node is a run of words, bytes from the lowest:
//!
//! | words | what |
//! | --- | --- |
//! | 1 | its origin's x and y in ticks, 16 bits each: the least corner of all its children's boxes |
//! | 1 | its origin's z, 16 bits; how many bits its steps along x, y and z are shifted by, 4 each; how many children it has |
//! | 2 each | a child: three low planes in steps from the origin, and the low byte of its place; three high planes, and the high byte. The place is that of its first link, marked, or of its node in pairs of words |

mod build;
mod node;
mod ray;
mod refit;
mod room;
mod walk;

pub use room::{COMPACT_MAX_DEPTH, COMPACT_STACK_SIZE, CompactStack, StackTooSmall};

use crate::object::ObjectRef;
use node::{CHILD, HEADER};

/// Words in which a compact tree of this many objects always finds room, however they move before it is built.
///
/// A node has two children or more, each its own node or a leaf of one object or more, except that one object alone
/// takes a node with one child.
pub const fn compact_words(objects: usize) -> usize {
    match objects {
        0 => 0,
        1 => HEADER + CHILD,
        _ => (objects - 1) * HEADER + (2 * objects - 2) * CHILD,
    }
}

/// A finished compact tree, walked with a stack of `ROOM` entries, which is never too small: no tree
/// that needs more can be made.
///
/// ```
/// use octray_core::accel::{Accelerator, BuildOptions, CompactBvh8};
/// use octray_core::object::ObjectRef;
/// use octray_core::ray::Aabb;
/// use octray_prepare::RenderSettings;
/// use octray_prepare::quantise::quantise;
///
/// let file = "v 0 0 9 at 0 0 0 up 0 1 0 angle 40 f 0 0 0 1 1 1 0 0 0 1 0 0
///     s 0 0 0 1 s 2 0 0 1 s -2 0 0 1 s 0 2 0 1 box 0 -2 0 1 1 1";
/// let view = RenderSettings { size: Some((8, 8)), max_depth: 0, ..RenderSettings::DEFAULT };
/// let prepared = quantise::<f32>(&octray_scenes::parse(file).unwrap(), &view)?;
/// let scene = prepared.scene.scene();
///
/// let options = BuildOptions { depth: 8, leaf_size: 1 };
/// let (mut words, mut links) = ([0; 64], [ObjectRef::default(); 5]);
/// let mut boxes = [Aabb::default(); 5];
/// let (tree, _) = CompactBvh8::build(
///     &scene.shapes, scene.diameter, &mut words, &mut links, &mut boxes, options)?;
///
/// // The same tree as constants, with a stack that is just large enough.
/// assert_eq!(tree.required_stack(), 5);
/// let tree = CompactBvh8::<5>::new(tree.words(), tree.links(), tree.tick())?;
///
/// let ray = prepared.frame.camera().row(0.0).ray(0.0);
/// let hit = tree.nearest(&scene, &ray, &mut Default::default(), &mut ()).unwrap();
/// assert_eq!(scene.attributes_of(hit.object).id, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CompactBvh8<'a, const ROOM: usize = COMPACT_STACK_SIZE> {
    words: &'a [u32],
    links: &'a [ObjectRef],
    tick: u32,
}

impl<'a, const ROOM: usize> CompactBvh8<'a, ROOM> {
    /// The tree of nothing: no object is met.
    pub const NOTHING: Self = Self {
        words: &[],
        links: &[],
        tick: 1,
    };

    /// A tree from what [`CompactBvh8::words`], [`CompactBvh8::links`] and [`CompactBvh8::tick`] gave, in
    /// constant context, too.
    ///
    /// # Errors
    /// If a walk could need more room than `ROOM`, for nodes would be left out without a word; or if the words and
    /// links are not those of a tree, for its walk might have no end.
    pub const fn new(
        words: &'a [u32],
        links: &'a [ObjectRef],
        tick: u32,
    ) -> Result<Self, StackTooSmall> {
        let needed = room::required(words, links);
        if needed > ROOM {
            return Err(StackTooSmall { needed });
        }
        Ok(Self { words, links, tick })
    }

    /// What a walk sees of the tree if it goes no further than the root: to tell what a root costs from what the rest does.
    #[must_use]
    pub fn root_alone(&self) -> Self {
        // The upper bits of a node's second word hold the number of its children. A place beyond the words is left out.
        let children = self.words.get(1).map_or(0, |word| (word >> 28) as usize);
        let size = HEADER + children * CHILD;
        Self {
            words: self.words.get(..size).unwrap_or(self.words),
            ..*self
        }
    }

    /// The nodes, the root first.
    pub const fn words(&self) -> &'a [u32] {
        self.words
    }

    /// The objects, leaf by leaf, the last of each leaf marked.
    pub const fn links(&self) -> &'a [ObjectRef] {
        self.links
    }

    /// A tick is 2 to this grid units; at least 1.
    pub const fn tick(&self) -> u32 {
        self.tick
    }

    /// The most nodes and leaves that can ever wait, whatever the ray: the least `ROOM` that
    /// [`CompactBvh8::new`] accepts.
    pub const fn required_stack(&self) -> usize {
        room::required(self.words, self.links)
    }
}
