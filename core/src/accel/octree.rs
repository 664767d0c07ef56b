//! The thesis's two trees: the *plain* octree (Glassner 1984), whose cells are split at the centre
//! into eight octants, and the *modified* one (figure 12), which merges and shrinks cells.
//! Objects are linked into every leaf that they touch.

mod build;
mod node;
mod overlap;
mod walk;

pub use node::OctreeNode;

use crate::object::ObjectRef;

/// Which of the thesis's trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OctreeVariant {
    /// Every inner cell has its eight octants, empty ones included.
    Plain,
    /// An octant whose three neighbours in the same half of the cell are empty is merged with
    /// them; a cell whose objects' box fills less than half of it shrinks to that box (the
    /// cluster box); a cell in which splitting separates nothing stays a leaf.
    Modified,
}

/// When an object is linked into a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkBy {
    /// When its bounding box meets the cell.
    Box,
    /// When its surface does.
    Shape,
}

/// A finished octree.
///
/// ```
/// use octray_core::accel::{Accelerator, BuildOptions, LinkBy, Octree, OctreeNode, OctreeVariant};
/// use octray_core::object::ObjectRef;
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
/// let (mut nodes, mut links) = (vec![OctreeNode::EMPTY; 64], vec![ObjectRef::default(); 256]);
/// let (tree, _) = Octree::build(
///     &scene.shapes, &mut nodes, &mut links, options, OctreeVariant::Plain, LinkBy::Shape)?;
///
/// let ray = prepared.frame.camera().row(0.0).ray(0.0);
/// let hit = tree.nearest(&scene, &ray, &mut Default::default(), &mut ()).unwrap();
/// assert_eq!(scene.attributes_of(hit.object).id, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Octree<'a, B> {
    /// The cells; the first is the root, parts of a cell are contiguous.
    pub nodes: &'a [OctreeNode<B>],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}
