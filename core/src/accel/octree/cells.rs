//! The thesis's walk (section 5.3): cell by cell, from the point where the ray leaves one to the next.
//!
//! It is exact, as the ray is a line on the grid and all its places are compared in integers. A hit's
//! computed point lies within [`BoundScalar::GRID_SLACK`] of the line, so the cell that holds the line
//! at the hit's distance links the object: cells are linked wider by a margin of twice that. The root
//! and the cluster boxes are larger by the same margin, so that the line is in them where a hit is.

use super::line::{Face, Line, Place};
use super::node::OctreeNode;
use super::{Octree, Walk};
use crate::accel::bound::BoundScalar;
use crate::accel::query::Query;
use crate::accel::scalar::AccelScalar;
use crate::features::FeatureSet;
use crate::observe::Observer;

/// The link of a face of the root.
pub(super) const OUTSIDE: u32 = u32::MAX;

impl<B: BoundScalar> Octree<'_, B> {
    /// Steps 1 to 6. "Make sure that the point is within that voxel": the nearest hit so far ends the
    /// walk only if it is not beyond the cell; in a later cell it is found again. That the list be
    /// sorted takes no more than its first.
    #[inline(never)]
    pub(super) fn walk_cells<
        S: AccelScalar<Bound = B>,
        O: Observer,
        const ANY: bool,
        const FEATURES: FeatureSet,
    >(
        &self,
        query: &mut Query<'_, S, O, ANY, FEATURES>,
    ) {
        let line = Line::new(query.ray);
        let root = self.nodes.first();
        let Some(mut at) = root.and_then(|root| line.enter(root, Place::START)) else {
            return;
        };
        let mut from = 0;
        while let Some((index, cell)) = self.locate(&line, from, &mut at, query.observer) {
            query.observer.voxel();
            let start = cell.first as usize;
            let end = start + cell.count() as usize;
            if cell.is_leaf()
                && query.test_list::<false>(self.links.get(start..end).unwrap_or_default())
            {
                return;
            }
            let Some((exit, face)) = line.exit(cell) else {
                return;
            };
            if exit.is_beyond(query.limit.to_grid()) {
                return;
            }
            at = exit;
            match self.neighbour(&line, index, face, at) {
                Some(next) => from = next,
                None => return,
            }
        }
    }

    /// Goes down from a node that holds a place to a leaf, or to a cell whose cluster box the ray does
    /// not meet any more. Where it does, the place moves there.
    #[inline(never)]
    fn locate<O: Observer>(
        &self,
        line: &Line,
        from: usize,
        at: &mut Place,
        observer: &mut O,
    ) -> Option<(usize, &OctreeNode<B>)> {
        let mut index = from;
        loop {
            let node = self.nodes.get(index)?;
            observer.step(1);
            if node.is_leaf() {
                return Some((index, node));
            }
            let first = node.first as usize;
            let parts = self.nodes.get(first..first + node.count() as usize)?;
            if node.is_cluster() {
                let Some(entry) = line.enter(parts.first()?, *at) else {
                    return Some((index, node));
                };
                *at = entry;
                index = first;
            } else if let Ok(octants) = parts.try_into() {
                index = first + line.octant(octants, *at);
            } else {
                index = first + parts.iter().position(|part| line.is_in(part, *at))?;
            }
        }
    }

    /// Where to look for the cell at a place on a face of the cell that was left.
    #[inline(never)]
    fn neighbour(&self, line: &Line, index: usize, face: Face, at: Place) -> Option<usize> {
        if self.walk == Walk::Neighbour {
            return line.is_in(self.nodes.first()?, at).then_some(0);
        }
        // Across an edge or a corner there is more than one face to go through.
        let (mut index, mut left) = (index, Some(face));
        while let Some(face) = left {
            index = *self.neighbours.get(index)?.get(face.index())? as usize;
            left = line.has_left(self.nodes.get(index)?, at);
        }
        Some(index)
    }
}
