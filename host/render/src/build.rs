//! A scene brought into its arithmetic, and the tree grown over it.

use crate::owned::OwnedAccelerator;
use crate::prepared::{PreparedScene, intensity, level};
use crate::renderer::{Built, Renderer, TreeStats};
use octray_core::accel::{self, BuildStats, OctreeVariant};
use octray_prepare::dispatch::InFormat;
use octray_prepare::format::Format;
use octray_prepare::prepare::Prepare;
use octray_prepare::quantise::{Overflow, Prepared};
use octray_prepare::settings::{Link, RenderSettings, TreeKind};
use octray_prepare::tree::{Growth, every_object};
use octray_scenes::model::Scene;
use std::num::NonZeroUsize;

/// Why a scene could not be made ready.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrepareError {
    /// The scene does not fit the arithmetic.
    #[error(transparent)]
    Overflow(#[from] Overflow),
    /// More objects than a packed tree can link.
    #[error("a compact BVH holds at most 32767 objects")]
    Objects,
}

/// Makes a scene ready.
///
/// # Errors
/// [`PrepareError::Overflow`] or [`PrepareError::Objects`] if the scene does not fit the arithmetic or the tree.
pub fn prepare(
    scene: &Scene,
    settings: &RenderSettings,
) -> Result<Box<dyn Renderer>, PrepareError> {
    let format = settings.arith.format(scene, settings.max_depth);
    let request = Request {
        scene,
        settings,
        format,
    };
    format.dispatch(request)
}

/// What is to be made ready, in whatever arithmetic.
struct Request<'a> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    format: Format,
}

impl InFormat for Request<'_> {
    type Output = Result<Box<dyn Renderer>, PrepareError>;

    fn run<S: Prepare>(self) -> Self::Output {
        self.build::<S>()
    }
}

impl Request<'_> {
    fn build<S: Prepare>(&self) -> Result<Box<dyn Renderer>, PrepareError> {
        let mut prepared = S::quantised(self.scene, self.settings)?;
        let tree = &self.settings.tree;
        let growth = Growth {
            options: tree.build_options(self.format, None),
            arena: tree.arena.map(NonZeroUsize::get),
        };
        let variant = match tree.kind {
            TreeKind::Bvh8 => {
                let (tree, summary) = S::bvh8(&mut prepared.scene, &growth);
                let tree = OwnedAccelerator::Bvh8(tree);
                return Ok(self.ready(prepared, tree, summary));
            }
            TreeKind::CompactBvh8 => {
                let (tree, summary) = S::compact_bvh8(&mut prepared.scene, &growth)
                    .map_err(|_| PrepareError::Objects)?;
                let tree = OwnedAccelerator::CompactBvh8(tree);
                return Ok(self.ready(prepared, tree, summary));
            }
            TreeKind::None => {
                let all = every_object(&prepared.scene);
                let summary = BuildStats::of_list(all.len() as u32);
                let tree = OwnedAccelerator::BruteForce(all);
                return Ok(self.ready(prepared, tree, summary));
            }
            TreeKind::Modified => OctreeVariant::Modified,
            TreeKind::Plain => OctreeVariant::Plain,
        };
        let link = match tree.link {
            Link::Shape => accel::LinkBy::Shape,
            Link::Box => accel::LinkBy::Box,
        };
        let (tree, summary) = S::octree(&mut prepared.scene, &growth, variant, link);
        let tree = OwnedAccelerator::Octree(tree.walked(self.settings.tree.walk.of_core()));
        Ok(self.ready(prepared, tree, summary))
    }

    fn ready<S: Prepare>(
        &self,
        prepared: Prepared<S>,
        tree: OwnedAccelerator<S::Bound>,
        summary: BuildStats,
    ) -> Box<dyn Renderer> {
        let background = prepared.scene.background;
        let built = Built {
            format: self.format,
            scale: prepared.world.exponent,
            too_fine: S::resolution(self.scene, self.settings)
                .err()
                .map(|fine| fine.to_string()),
            tree: TreeStats {
                kind: self.settings.tree.kind,
                nodes: u64::from(summary.inner + summary.leaves),
                links: u64::from(summary.links),
                depth: summary.depth,
                unsplit: u64::from(summary.unsplit),
            },
            size: self.settings.size_of(self.scene),
            active: prepared.frame.active().clone(),
            block: prepared.frame.block(),
            background: (level(background), intensity(background)),
        };
        Box::new(PreparedScene {
            prepared,
            tree,
            built,
            max_depth: self.settings.max_depth,
            cut_off: S::from_f64(self.settings.cut_off),
        })
    }
}

/// Saturations are counted by whoever traced: two renderings in one process are told apart.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::Interrupt;
    use crate::tile::Tile;
    use octray_core::frame::Region;
    use octray_core::scalar::Fixed;
    use octray_prepare::saturation::PerThread;
    use std::thread;

    /// A ball below so many lights, each of which alone fits the format.
    fn renderer(lights: usize) -> Box<dyn Renderer> {
        let file =
            "v 0 0 6 at 0 0 0 up 0 1 0 angle 40 l 0 5 6 6 f 0 0 0 1 1 1 0 0 0 1 0 0 s 0 0 0 2";
        let scene = octray_scenes::parse(file).unwrap();
        let settings = RenderSettings {
            size: Some((32, 24)),
            max_depth: 2,
            ..RenderSettings::DEFAULT
        };
        let mut prepared = Fixed::<28, PerThread>::quantised(&scene, &settings).unwrap();
        prepared.scene.lights = vec![prepared.scene.lights[0]; lights];
        let all = every_object(&prepared.scene);
        let summary = BuildStats::of_list(all.len() as u32);
        let request = Request {
            scene: &scene,
            settings: &settings,
            format: Format::I4F28,
        };
        request.ready(prepared, OwnedAccelerator::BruteForce(all), summary)
    }

    /// Traces the picture's rows one by one, so that two threads are sure to be at it at once; how many results were
    /// clamped.
    fn saturations(renderer: &dyn Renderer) -> u64 {
        let mut worker = renderer.worker(&Interrupt::new());
        for row in 0..24 {
            let mut levels = [[0; 3]; 32];
            worker.trace(Tile {
                region: Region {
                    columns: 0..32,
                    rows: row..row + 1,
                },
                levels: &mut levels,
                intensities: None,
            });
            thread::yield_now();
        }
        worker.saturations()
    }

    #[test]
    fn two_renderings_in_one_process_are_told_apart() {
        // Quantising refuses lights whose sum overflows, so that they are put in afterwards.
        let (bright, dim) = (renderer(2), renderer(1));
        let alone = saturations(&*bright);
        assert!(alone > 0);
        assert_eq!(saturations(&*dim), 0);
        thread::scope(|scope| {
            let bright = scope.spawn(|| saturations(&*bright));
            let dim = scope.spawn(|| saturations(&*dim));
            assert_eq!((bright.join().unwrap(), dim.join().unwrap()), (alone, 0));
        });
        // On one thread, in turns.
        let (mut loud, mut quiet) = (
            bright.worker(&Interrupt::new()),
            dim.worker(&Interrupt::new()),
        );
        for row in 0..24 {
            for worker in [&mut loud, &mut quiet] {
                worker.probe(&Region {
                    columns: 0..32,
                    rows: row..row + 1,
                });
            }
        }
        assert_eq!((loud.saturations(), quiet.saturations()), (alone, 0));
    }
}
