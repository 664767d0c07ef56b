//! Links between the faces of neighbours (section 5.2.2 of the thesis: the modified tree "connects the face of
//! neighboring subspaces (cells) at the same level directly to one another").

use super::cells::OUTSIDE;
use super::line::Face;
use super::node::OctreeNode;
use super::{Octree, Walk};
use crate::accel::bound::BoundScalar;
use crate::vec3::Axis;

/// The nodes behind a cell's faces: low and high along x, y and z.
pub type FaceLinks = [u32; 6];

impl<'a, B: BoundScalar> Octree<'a, B> {
    /// The same tree to be walked along links, which are written to lent memory. A face's link leads to
    /// the neighbour of the same level, or to a larger node if that is no single node of that level; from
    /// a cluster box to the cell around it.
    ///
    /// `None` if there is not room for the links of each node.
    #[must_use]
    pub fn with_links(self, room: &'a mut [FaceLinks]) -> Option<Self> {
        let links = room.get_mut(..self.nodes.len())?;
        links.fill([OUTSIDE; 6]);
        // Parts come after their cell: its links are there.
        for (index, cell) in self.nodes.iter().enumerate() {
            if cell.is_leaf() {
                continue;
            }
            let of_cell = *links.get(index)?;
            let parts = self.parts(cell);
            for (part, of_part) in parts.iter().zip(links.get_mut(cell.first as usize..)?) {
                for face in Face::all() {
                    let behind = if cell.is_cluster() {
                        index as u32
                    } else if is_at(part, cell, face) {
                        let outer = *of_cell.get(face.index())?;
                        let beyond = self.nodes.get(outer as usize);
                        let same = beyond.and_then(|beyond| self.part_behind(beyond, part, face));
                        same.unwrap_or(outer)
                    } else {
                        let same = self.part_behind(cell, part, face);
                        same.unwrap_or(index as u32)
                    };
                    *of_part.get_mut(face.index())? = behind;
                }
            }
        }
        Some(Self {
            neighbours: links,
            walk: Walk::Links,
            ..self
        })
    }

    fn parts(&self, cell: &OctreeNode<B>) -> &'a [OctreeNode<B>] {
        let first = cell.first as usize;
        let end = first + cell.count() as usize;
        self.nodes.get(first..end).unwrap_or_default()
    }

    /// The part of `cell` that covers a face of `part` from the other side.
    fn part_behind(&self, cell: &OctreeNode<B>, part: &OctreeNode<B>, face: Face) -> Option<u32> {
        if cell.is_leaf() || cell.is_cluster() {
            return None;
        }
        let covers = |other: &OctreeNode<B>| {
            Axis::ALL.into_iter().all(|axis| {
                let (other, part) = (&other.bounds, &part.bounds);
                if axis != face.axis {
                    other.low[axis] <= part.low[axis] && part.high[axis] <= other.high[axis]
                } else if face.low {
                    other.high[axis] == part.low[axis]
                } else {
                    other.low[axis] == part.high[axis]
                }
            })
        };
        let place = self.parts(cell).iter().position(covers)?;
        Some(cell.first + place as u32)
    }
}

/// Whether a face of a part is on the face of its cell.
fn is_at<B: BoundScalar>(part: &OctreeNode<B>, cell: &OctreeNode<B>, face: Face) -> bool {
    let plane = |node: &OctreeNode<B>| {
        let side = if face.low {
            node.bounds.low
        } else {
            node.bounds.high
        };
        side[face.axis]
    };
    plane(part) == plane(cell)
}
