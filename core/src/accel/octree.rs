//! The thesis's two trees: the *plain* octree (Glassner 1984), whose cells are split at the centre
//! into eight octants, and the *modified* one of figure 12, with cluster boxes and merged cells.
//! Objects are linked into every leaf that they touch.

mod build;
mod cells;
mod faces;
mod line;
mod modified;
mod node;
mod overlap;
mod walk;

pub use faces::FaceLinks;
pub use node::OctreeNode;

use crate::object::ObjectRef;

/// Which of the thesis's trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OctreeVariant {
    /// Every inner cell has its eight octants, empty ones included. A cell of no more objects than the
    /// leaf size is a leaf.
    Plain,
    /// Figure 12 of the thesis.
    ///
    /// - Two objects whose boxes overlap are a leaf; two that are apart are parted at once.
    /// - Cells of three objects and more are split as far as the depth allows. The leaf size is the
    ///   thesis's maximum of objects: a root of three or more but no more than it is split once.
    /// - A cell whose objects' box fills less than half of it has that box inside: the cluster box.
    /// - An octant of at most one object is merged with the three others of its half if they are empty.
    ///
    /// Objects that coincide are not split for.
    Modified,
}

/// How a ray finds its way through an octree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walk {
    /// Downward from the root: the parts of a cell that the ray meets, in order.
    Ordered,
    /// From cell to cell (section 5.3 of the thesis): each is looked for from the root, at the point where
    /// the ray leaves the one before.
    Neighbour,
    /// The same, but each is looked for from the node behind that face. See [`Octree::with_links`].
    Links,
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
    /// What is behind each cell's faces, for [`Walk::Links`]; else empty.
    pub neighbours: &'a [FaceLinks],
    /// How it is walked.
    pub walk: Walk,
}
