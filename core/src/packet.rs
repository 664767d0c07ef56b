//! A picture and its parts: which pixels are worth a ray, and the rows that one thread renders.

use crate::camera::Camera;
use crate::observe::Observer;
use crate::octree::Accelerator;
use crate::scalar::Scalar;
use crate::trace::{Tracer, Workspace};
use crate::vec3::{Vec3, vec3};
use core::ops::Range;

/// A rectangle of pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// Columns.
    pub columns: Range<u32>,
    /// Rows.
    pub rows: Range<u32>,
}

/// A picture to be rendered.
#[derive(Clone, Debug)]
pub struct Frame<S: Scalar> {
    camera: Camera<S>,
    active: Region,
    block: u32,
    samples: u32,
    width: u32,
    height: u32,
    across: S::Reciprocal,
    down: S::Reciprocal,
    share: S,
}

impl<S: Scalar> Frame<S> {
    /// A picture of `width` × `height` pixels, each at least 1 and at most 65535.
    ///
    /// One ray colours `block` × `block` pixels (1 or 2), or `samples` × `samples` rays (at most
    /// 255) are averaged in it. No ray is sent outside of `active`, where nothing is to be seen
    /// but background.
    pub fn new(
        camera: Camera<S>,
        width: u32,
        height: u32,
        block: u32,
        samples: u32,
        active: Region,
    ) -> Self {
        let (width, height) = (width.clamp(1, 65_535), height.clamp(1, 65_535));
        let samples = samples.clamp(1, 255);
        let whole = S::whole_reciprocal(samples * samples);
        Self {
            camera,
            active: Region {
                columns: active.columns.start..active.columns.end.min(width),
                rows: active.rows.start..active.rows.end.min(height),
            },
            block: block.clamp(1, 2),
            samples,
            width,
            height,
            across: S::whole_reciprocal(samples * width),
            down: S::whole_reciprocal(samples * height),
            share: S::ratio(1, whole),
        }
    }

    /// The pixels that rays are sent through.
    pub const fn active(&self) -> &Region {
        &self.active
    }

    /// The side of the square of pixels that one ray colours.
    pub const fn block(&self) -> u32 {
        self.block
    }

    /// Renders the active pixels of some rows, and hands each to `put` with its column, its row
    /// and its colour in [0, 1]. Blocks that begin above the rows are not rendered.
    pub fn render<A: Accelerator<S>, O: Observer>(
        &self,
        rows: Range<u32>,
        tracer: &Tracer<'_, S, A>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
        mut put: impl FnMut(u32, u32, Vec3<S>),
    ) {
        workspace.forget();
        let rows = rows.start.max(self.active.rows.start)..rows.end.min(self.active.rows.end);
        let columns = self.active.columns.clone();
        let starts = |range: &Range<u32>| {
            (range.start.next_multiple_of(self.block)..range.end).step_by(self.block as usize)
        };
        for row in starts(&rows) {
            for column in starts(&columns) {
                let colour = self.colour(column, row, tracer, workspace, observer);
                for y in row..(row + self.block).min(rows.end) {
                    for x in column..(column + self.block).min(columns.end) {
                        put(x, y, colour);
                    }
                }
            }
        }
    }

    /// The colour of the block whose upper left pixel is given.
    #[inline(always)]
    fn colour<A: Accelerator<S>, O: Observer>(
        &self,
        column: u32,
        row: u32,
        tracer: &Tracer<'_, S, A>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
    ) -> Vec3<S> {
        if self.samples == 1 {
            let (x, y) = self.place(column, row, 0, 0);
            return clamp(tracer.radiance(self.camera.ray(x, y), workspace, observer));
        }
        let mut sum = Vec3::ZERO;
        for sub_row in 0..self.samples {
            for sub_column in 0..self.samples {
                let (x, y) = self.place(column, row, sub_column, sub_row);
                let colour = tracer.radiance(self.camera.ray(x, y), workspace, observer);
                sum = sum + clamp(colour) * self.share;
            }
        }
        clamp(sum)
    }

    /// Where in the camera's picture a sample lies, from −1 to 1.
    #[inline(always)]
    pub fn place(&self, column: u32, row: u32, sub_column: u32, sub_row: u32) -> (S, S) {
        // In units of a 2·samples-th of a pixel, from the upper left corner: twice the block's
        // start, and the middle of the sub-cell.
        let at = |start: u32, sub: u32| 2 * self.samples * start + self.block * (2 * sub + 1);
        let (width, height) = (self.samples * self.width, self.samples * self.height);
        let x = at(column, sub_column) as i32 - width as i32;
        let y = height as i32 - at(row, sub_row) as i32;
        (S::ratio(x, self.across), S::ratio(y, self.down))
    }

    /// The camera.
    pub const fn camera(&self) -> &Camera<S> {
        &self.camera
    }
}

#[inline(always)]
fn clamp<S: Scalar>(c: Vec3<S>) -> Vec3<S> {
    let unit = |x: S| x.max(S::ZERO).min(S::ONE);
    vec3(unit(c.x), unit(c.y), unit(c.z))
}
