//! A bounding volume hierarchy of up to eight boxes per node, every object in exactly one leaf.
//!
//! It takes the thesis's cluster box to its end: a node's children are not the octants of a cell
//! but the groups into which the surface area heuristic divides its objects.

mod build;
mod node;
mod walk;

pub use build::Bvh8Memory;
pub use node::Bvh8Node;

use crate::object::ObjectRef;

/// A finished 8-wide BVH.
///
/// ```
/// use octray_core::accel::{Accelerator, BuildOptions, Bvh8, Bvh8Memory, Bvh8Node};
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
/// let options = BuildOptions { depth: 24, leaf_size: 1 };
/// let (mut nodes, mut links) = ([Bvh8Node::EMPTY; 8], [ObjectRef::default(); 5]);
/// let memory = Bvh8Memory {
///     nodes: &mut nodes,
///     links: &mut links,
///     boxes: &mut [Aabb::default(); 5],
/// };
/// let (tree, stats) = Bvh8::build(&scene.shapes, memory, options)?;
/// assert_eq!((stats.links, stats.unsplit), (5, 0));
///
/// let ray = prepared.frame.camera().row(0.0).ray(0.0);
/// let hit = tree.nearest(&scene, &ray, &mut Default::default(), &mut ()).unwrap();
/// assert_eq!(scene.attributes_of(hit.object).id, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bvh8<'a, B> {
    /// The nodes; the first is the root.
    pub nodes: &'a [Bvh8Node<B>],
    /// The objects, leaf by leaf, the last of each leaf marked.
    pub links: &'a [ObjectRef],
}
