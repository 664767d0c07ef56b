//! Everything of the core that a fixed-point program can ask for: building and walking every tree,
//! tracing every shape. Built for a target without floating point, to see what it links.
#![no_std]

use octray_core::accel::{
    BruteForce, BuildOptions, Bvh8, Bvh8Memory, CompactBvh8, CompactStack, LinkBy, Octree,
    OctreeNode, OctreeVariant, TraversalStack,
};
use octray_core::camera::Camera;
use octray_core::frame::{Frame, Region};
use octray_core::object::ObjectRef;
use octray_core::ray::Aabb;
use octray_core::scalar::{Fixed, Intensity, Scalar};
use octray_core::scene::Scene;
use octray_core::trace::{Tracer, Workspace};

type Number = Fixed<28>;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

const OPTIONS: BuildOptions = BuildOptions {
    depth: 8,
    leaf_size: 2,
};

/// One row of a picture.
pub type Row = [[u8; 3]; 64];

macro_rules! render {
    ($scene:expr, $camera:expr, $tree:expr, $workspace:expr, $row:expr) => {{
        let region = Region {
            columns: 0..64,
            rows: 0..48,
        };
        let frame = Frame::new(*$camera, 64, 48, 1, 1, region);
        let tracer = Tracer {
            scene: $scene,
            accelerator: $tree,
            max_depth: 4,
            cut_off: Number::ZERO,
        };
        frame.render(0..1, &tracer, $workspace, &mut (), |x, _, colour| {
            if let Some(pixel) = $row.get_mut(x as usize) {
                *pixel = colour.to_array().map(Number::level);
            }
        });
    }};
}

/// Renders with an 8-wide BVH built here.
#[unsafe(no_mangle)]
pub fn octray_bvh8(
    scene: &Scene<'_, Number>,
    memory: Bvh8Memory<'_, i32>,
    camera: &Camera<Number>,
    workspace: &mut Workspace<'_, Number, TraversalStack<i32>>,
    row: &mut Row,
) {
    if let Ok((tree, _)) = Bvh8::build(&scene.shapes, memory, OPTIONS) {
        render!(scene, camera, &tree, workspace, row);
    }
}

/// Renders with the thesis's trees built here.
#[unsafe(no_mangle)]
pub fn octray_octree(
    scene: &Scene<'_, Number>,
    nodes: &mut [OctreeNode<i32>],
    links: &mut [ObjectRef],
    variant: OctreeVariant,
    camera: &Camera<Number>,
    workspace: &mut Workspace<'_, Number, TraversalStack<i32>>,
    row: &mut Row,
) {
    let built = Octree::build(&scene.shapes, nodes, links, OPTIONS, variant, LinkBy::Shape);
    if let Ok((tree, _)) = built {
        render!(scene, camera, &tree, workspace, row);
    }
}

/// Renders without a tree.
#[unsafe(no_mangle)]
pub fn octray_brute_force(
    scene: &Scene<'_, Number>,
    objects: &[ObjectRef],
    camera: &Camera<Number>,
    workspace: &mut Workspace<'_, Number, ()>,
    row: &mut Row,
) {
    render!(scene, camera, &BruteForce(objects), workspace, row);
}

/// Renders with a compact BVH built here.
#[unsafe(no_mangle)]
pub fn octray_compact_bvh8(
    scene: &Scene<'_, Number>,
    words: &mut [u32],
    links: &mut [ObjectRef],
    boxes: &mut [Aabb<i32>],
    camera: &Camera<Number>,
    workspace: &mut Workspace<'_, Number, CompactStack>,
    row: &mut Row,
) {
    if let Ok((tree, _)) =
        CompactBvh8::build(&scene.shapes, scene.diameter, words, links, boxes, OPTIONS)
    {
        render!(scene, camera, &tree, workspace, row);
    }
}
