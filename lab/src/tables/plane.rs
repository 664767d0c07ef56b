//! The plane scene of table I: two trees of a few balls, and three rays in a plane through all of them.

use super::subject::PLANE;
use octray_core::accel::{Accelerator, BuildOptions, LinkBy, OctreeVariant, Walk};
use octray_core::observe::{Counters, Observer, RayKind};
use octray_core::ray::Ray;
use octray_core::vec3::vec3;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, quantise};
use octray_prepare::tree::{Growth, OwnedOctree};
use octray_render::error::Error;
use octray_render::renderer::PrepareError;

/// The height of the plane, in units of the scene file.
const HEIGHT: f64 = 8.25;

/// The thesis's rays R1 to R3: x and y where each starts, and of a point on its way.
const RAYS: [(&str, [[f64; 2]; 2]); 3] = [
    ("R1", [[250.0, 134.0], [-250.0, -213.0]]),
    ("R2", [[250.0, 106.0], [-147.0, -250.0]]),
    ("R3", [[101.0, 250.0], [-123.0, -250.0]]),
];

/// One object in a cell, and two levels below the root.
const OPTIONS: BuildOptions = BuildOptions {
    depth: 2,
    leaf_size: 1,
};

/// A ray through a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayCounts {
    /// The ray's name.
    pub name: &'static str,
    /// Cells that it crosses.
    pub voxels: u64,
    /// Objects that it is tested against on its way from cell to cell.
    pub tests: u64,
    /// Nodes of the tree that the plane cuts.
    pub nodes: u64,
    /// Nodes visited in each of [`super::octrees::WALKS`].
    pub visits: [u64; 3],
}

/// Sends the rays through one of the trees, in f32.
///
/// # Errors
/// [`Error::Scene`] if the scene has mistakes.
pub fn rays(variant: OctreeVariant) -> Result<Vec<RayCounts>, Error> {
    let Prepared {
        mut scene, world, ..
    } = quantise::<f32>(&PLANE.scene()?, &RenderSettings::DEFAULT).map_err(PrepareError::from)?;
    let growth = Growth {
        options: OPTIONS,
        arena: None,
    };
    let (tree, _) = OwnedOctree::build(&mut scene, &growth, variant, LinkBy::Shape);
    let height = world.point([0.0, 0.0, HEIGHT])[2] as f32;
    let nodes = (tree.tree().nodes.iter())
        .filter(|node| node.bounds().low.z <= height && height < node.bounds().high.z)
        .count() as u64;
    let scene = scene.scene();
    let counts = RAYS.map(|(name, [from, to])| {
        let [from, to] = [from, to].map(|[x, y]| world.point([x, y, HEIGHT]));
        let [from, to] = [from, to].map(|[x, y, z]| vec3(x as f32, y as f32, z as f32));
        let ray = Ray::new(from, (to - from).unit().0);
        let walked = [Walk::Ordered, Walk::Neighbour, Walk::Links].map(|walk| {
            let mut counters = Counters::default();
            counters.ray(RayKind::Primary);
            let tree = tree.clone().walked(walk);
            tree.tree()
                .nearest(&scene, &ray, &mut Default::default(), &mut counters);
            counters
        });
        RayCounts {
            name,
            voxels: walked[1].voxels(),
            tests: walked[1].tests(),
            nodes,
            visits: walked.map(|counters| counters.steps()),
        }
    });
    Ok(counts.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the layout was searched for.
    #[test]
    fn rays_in_the_plane_have_the_thesiss_counts() {
        let counts = |variant| {
            let rays = rays(variant).unwrap();
            assert!(rays.iter().all(|ray| ray.nodes == rays[0].nodes));
            let tests = rays.iter().map(|ray| [ray.voxels, ray.tests]);
            (rays[0].nodes, tests.collect::<Vec<_>>())
        };
        let plain = (21, vec![[6, 3], [5, 2], [6, 4]]);
        assert_eq!(counts(OctreeVariant::Plain), plain);
        let modified = (16, vec![[6, 3], [3, 1], [5, 4]]);
        assert_eq!(counts(OctreeVariant::Modified), modified);
    }
}
