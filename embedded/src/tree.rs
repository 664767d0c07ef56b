//! A tree that a device builds in its own memory, for a scene in which things move.

use heapless::Vec;
use octray_core::accel::{AccelScalar, BuildError, BuildOptions, CompactBvh8, StackTooSmall};
use octray_core::features::FeatureSet;
use octray_core::object::ObjectRef;
use octray_core::ray::Aabb;
use octray_core::scene::Scene;

/// Memory for the compact tree of at most `OBJECTS` objects in `WORDS` words:
/// [`compact_words`](octray_core::accel::compact_words)`(OBJECTS)` are always enough.
#[derive(Clone, Debug, Default)]
pub struct DeviceTree<const OBJECTS: usize, const WORDS: usize> {
    words: Vec<u32, WORDS>,
    links: Vec<ObjectRef, OBJECTS>,
    tick: u32,
}

impl<const OBJECTS: usize, const WORDS: usize> DeviceTree<OBJECTS, WORDS> {
    /// The tree of nothing: no object is met.
    pub const fn new() -> Self {
        Self {
            words: Vec::new(),
            links: Vec::new(),
            tick: 1,
        }
    }

    /// Builds the tree of a scene. Takes 24 bytes of stack for each object. With too few words parts of it stay
    /// unsplit: pictures are the same, only slower.
    ///
    /// # Errors
    /// If there are more than `OBJECTS` objects, or too few words for the root. The tree is that of nothing then.
    pub fn build<S: AccelScalar, const FEATURES: FeatureSet>(
        &mut self,
        scene: &Scene<'_, S, FEATURES>,
        options: BuildOptions,
    ) -> Result<(), BuildError> {
        let count = scene.shapes.len();
        *self = Self::new();
        let too_small = BuildError {
            nodes: 1,
            links: count,
        };
        (self.links.resize_default(count)).map_err(|_| too_small)?;
        // As many as there is room for.
        let _ = self.words.resize_default(WORDS);
        let mut boxes = [Aabb::default(); OBJECTS];
        let built = CompactBvh8::build(
            &scene.shapes,
            scene.diameter,
            &mut self.words,
            &mut self.links,
            &mut boxes,
            options,
        );
        let (used, tick) = match built {
            Ok((tree, _)) => (tree.words().len(), tree.tick()),
            Err(error) => {
                *self = Self::new();
                return Err(error);
            }
        };
        self.words.truncate(used);
        self.tick = tick;
        Ok(())
    }

    /// Takes a copy of a tree, such as a baked one, whose boxes are to be changed.
    ///
    /// # Errors
    /// If there is too little room. The tree is that of nothing then.
    pub fn copy<const ROOM: usize>(
        &mut self,
        tree: &CompactBvh8<'_, ROOM>,
    ) -> Result<(), BuildError> {
        *self = Self::new();
        let copied = (self.words.extend_from_slice(tree.words()))
            .and_then(|()| self.links.extend_from_slice(tree.links()));
        if copied.is_err() {
            *self = Self::new();
            return Err(BuildError {
                nodes: tree.words().len(),
                links: tree.links().len(),
            });
        }
        self.tick = tree.tick();
        Ok(())
    }

    /// Fits the boxes to the places of the objects, which are the same objects as when the tree was built:
    /// [`CompactBvh8::refit`].
    pub fn refit<S: AccelScalar, const FEATURES: FeatureSet>(
        &mut self,
        scene: &Scene<'_, S, FEATURES>,
    ) {
        // The words are a tree's, so it cannot fail.
        let _: Result<CompactBvh8<'_>, StackTooSmall> =
            CompactBvh8::refit(&scene.shapes, &mut self.words, &self.links, self.tick);
    }

    /// The tree, to be walked.
    pub fn tree(&self) -> CompactBvh8<'_> {
        // The words are a tree's, so it cannot fail; the tree of nothing has no words.
        CompactBvh8::new(&self.words, &self.links, self.tick).unwrap_or(CompactBvh8::NOTHING)
    }
}
