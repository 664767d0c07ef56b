//! A picture: which pixels are worth a ray, and the rows that one thread renders.

use crate::accel::Accelerator;
use crate::camera::Camera;
use crate::features::FeatureSet;
use crate::observe::RayObserver;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::trace::{TraceScalar, Tracer, Workspace};
use crate::vec3::{Vec3, vec3};
use core::ops::Range;

/// The shadow cache is cleared at every column that is a multiple of this. So what is counted is the same however a
/// picture is cut, if it is cut at these columns. It costs less than a hundredth of the instructions.
pub const RUN: u32 = 8;

/// A rectangle of pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// Columns.
    pub columns: Range<u32>,
    /// Rows.
    pub rows: Range<u32>,
}

/// A picture to be rendered: a camera, a size, and how many rays a pixel gets.
///
/// ```
/// use octray_core::camera::{Camera, Projection};
/// use octray_core::frame::{Frame, Region};
/// use octray_core::vec3::vec3;
///
/// let camera = Camera {
///     origin: vec3(0.0, 0.0, 5.0),
///     forward: vec3(0.0, 0.0, -1.0),
///     right: vec3(0.4, 0.0, 0.0),
///     up: vec3(0.0, 0.3, 0.0),
///     projection: Projection::Perspective,
/// };
/// // One ray for each pixel of 320 × 240; nothing but background is outside the active region.
/// let frame = Frame::new(camera, 320, 240, 1, 1, Region { columns: 40..280, rows: 30..240 });
/// let (x, y) = frame.sample_position(160, 120, 0, 0);
/// let ray = frame.camera().row(y).ray(x);
/// assert!((x, y) == (1.0 / 320.0, -1.0 / 240.0) && ray.direction.z < -0.999f32);
/// ```
#[derive(Clone, Debug)]
pub struct Frame<S: Scalar>(FrameParams<S>);

/// What a [`Frame`] consists of, to be stored and read back by [`Frame::from_params`].
#[derive(Clone, Debug)]
pub struct FrameParams<S: Scalar> {
    /// Where rays start.
    pub camera: Camera<S>,
    /// The pixels that rays are sent through.
    pub active: Region,
    /// The side of the square of pixels that one ray colours, 1 to [`Frame::MAX_BLOCK`].
    pub block: u32,
    /// Rays per pixel in each direction, 1 to 255.
    pub samples: u32,
    /// Columns, 1 to 65535.
    pub width: u32,
    /// Rows, 1 to 65535.
    pub height: u32,
    /// The reciprocal of samples · width.
    pub inv_width: S::Reciprocal,
    /// The reciprocal of samples · height.
    pub inv_height: S::Reciprocal,
    /// The weight of one of the samples, 1/samples².
    pub sample_weight: S,
}

impl<S: TraceScalar> Frame<S> {
    /// The largest side of a square of pixels that one ray colours. The middle of such a square may lie outside of a small
    /// picture; this far is within what [`Ratio`](crate::scalar::Ratio) and the camera allow.
    pub const MAX_BLOCK: u32 = 8;

    /// A picture of `width` × `height` pixels, each 1 to 65535 (clamped).
    ///
    /// One ray colours `block` × `block` pixels (1 to [`Self::MAX_BLOCK`]), or `samples` × `samples` rays (1 to 255 each
    /// way) are averaged in it. No ray is sent outside of `active`, where nothing is to be seen but
    /// background.
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
        Self(FrameParams {
            camera,
            active: Region {
                columns: active.columns.start..active.columns.end.min(width),
                rows: active.rows.start..active.rows.end.min(height),
            },
            block: block.clamp(1, Self::MAX_BLOCK),
            samples,
            width,
            height,
            inv_width: S::whole_reciprocal(samples * width),
            inv_height: S::whole_reciprocal(samples * height),
            sample_weight: S::ratio(1, whole),
        })
    }

    /// A picture of `width` × `height` pixels with a ray for each of them.
    pub fn whole(camera: Camera<S>, width: u32, height: u32) -> Self {
        let active = Region {
            columns: 0..width,
            rows: 0..height,
        };
        Self::new(camera, width, height, 1, 1, active)
    }

    /// The same picture from another camera: of all pixels, as others may see something now.
    #[must_use]
    pub fn from_camera(&self, camera: Camera<S>) -> Self {
        let FrameParams {
            width,
            height,
            block,
            samples,
            ..
        } = self.0;
        let active = Region {
            columns: 0..width,
            rows: 0..height,
        };
        Self::new(camera, width, height, block, samples, active)
    }

    /// The picture that [`Frame::params`] came from.
    pub const fn from_params(params: FrameParams<S>) -> Self {
        Self(params)
    }

    /// What it consists of.
    pub const fn params(&self) -> &FrameParams<S> {
        &self.0
    }

    /// The pixels that rays are sent through.
    pub const fn active(&self) -> &Region {
        &self.0.active
    }

    /// The side of the square of pixels that one ray colours.
    pub const fn block(&self) -> u32 {
        self.0.block
    }

    /// Renders the active pixels of some rows, and passes each to `put` with its column, its row
    /// and its colour, not clamped. Blocks that begin above the rows are not rendered.
    pub fn render<A: Accelerator<S, FEATURES>, O: RayObserver<S>, const FEATURES: FeatureSet>(
        &self,
        rows: Range<u32>,
        tracer: &Tracer<'_, S, A, FEATURES>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
        put: impl FnMut(u32, u32, Vec3<S>),
    ) {
        let columns = self.0.active.columns.clone();
        self.render_region(&Region { columns, rows }, tracer, workspace, observer, put);
    }

    /// The same for a rectangle of pixels. Blocks that begin above the rectangle or to its left are not rendered.
    pub fn render_region<
        A: Accelerator<S, FEATURES>,
        O: RayObserver<S>,
        const FEATURES: FeatureSet,
    >(
        &self,
        region: &Region,
        tracer: &Tracer<'_, S, A, FEATURES>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
        mut put: impl FnMut(u32, u32, Vec3<S>),
    ) {
        let both = |a: &Range<u32>, b: &Range<u32>| a.start.max(b.start)..a.end.min(b.end);
        let rows = both(&region.rows, &self.0.active.rows);
        let columns = both(&region.columns, &self.0.active.columns);
        // Another value, which only `from_params` can bring, must not loop for ever.
        let block = self.0.block.clamp(1, Self::MAX_BLOCK);
        // Some cores have no division.
        let first = |range: &Range<u32>| match block.is_power_of_two() {
            true => (range.start + block - 1) & !(block - 1),
            false => range.start.next_multiple_of(block),
        };
        let mut row = first(&rows);
        while row < rows.end {
            let line = self.0.camera.row(self.sample_y(row, 0));
            let mut column = first(&columns);
            while column < columns.end {
                if column % RUN == 0 || column == first(&columns) {
                    workspace.clear_shadow_cache();
                }
                let colour = if self.0.samples == 1 {
                    let ray = line.ray(self.sample_x(column, 0));
                    tracer.radiance(ray, workspace, observer)
                } else {
                    self.average(column, row, tracer, workspace, observer)
                };
                for y in row..(row + block).min(rows.end) {
                    for x in column..(column + block).min(columns.end) {
                        put(x, y, colour);
                    }
                }
                column += block;
            }
            row += block;
        }
    }

    /// The mean colour of the samples of the block whose upper left pixel is given.
    #[inline(never)]
    fn average<A: Accelerator<S, FEATURES>, O: RayObserver<S>, const FEATURES: FeatureSet>(
        &self,
        column: u32,
        row: u32,
        tracer: &Tracer<'_, S, A, FEATURES>,
        workspace: &mut Workspace<'_, S, A::Stack>,
        observer: &mut O,
    ) -> Vec3<S> {
        let mut sum = Vec3::ZERO;
        for sub_row in 0..self.0.samples {
            let line = self.0.camera.row(self.sample_y(row, sub_row));
            for sub_column in 0..self.0.samples {
                let ray = line.ray(self.sample_x(column, sub_column));
                let colour = tracer.radiance(ray, workspace, observer);
                sum = sum + clamp(colour) * self.0.sample_weight;
            }
        }
        sum
    }

    /// Where in the camera's picture a sample lies, from −1 to 1.
    #[inline(always)]
    pub fn sample_position(&self, column: u32, row: u32, sub_column: u32, sub_row: u32) -> (S, S) {
        (
            self.sample_x(column, sub_column),
            self.sample_y(row, sub_row),
        )
    }

    /// The ray through a place of the picture, in units of a 2·samples-th of a pixel from its upper left corner.
    pub fn ray_at(&self, x: u32, y: u32) -> Ray<S> {
        self.0.camera.row(self.y_at(y)).ray(self.x_at(x))
    }

    #[inline(always)]
    fn sample_x(&self, column: u32, sub: u32) -> S {
        self.x_at(self.sample_centre(column, sub))
    }

    #[inline(always)]
    fn sample_y(&self, row: u32, sub: u32) -> S {
        self.y_at(self.sample_centre(row, sub))
    }

    #[inline(always)]
    fn x_at(&self, x: u32) -> S {
        let width = self.0.samples * self.0.width;
        S::ratio(x as i32 - width as i32, self.0.inv_width)
    }

    #[inline(always)]
    fn y_at(&self, y: u32) -> S {
        let height = self.0.samples * self.0.height;
        S::ratio(height as i32 - y as i32, self.0.inv_height)
    }

    /// The middle of a sample in units of a 2·samples-th of a pixel, from the upper left corner.
    #[inline(always)]
    fn sample_centre(&self, start: u32, sub: u32) -> u32 {
        2 * self.0.samples * start + self.0.block * (2 * sub + 1)
    }

    /// The camera.
    pub const fn camera(&self) -> &Camera<S> {
        &self.0.camera
    }
}

#[inline(always)]
fn clamp<S: Scalar>(c: Vec3<S>) -> Vec3<S> {
    let unit = |x: S| x.max(S::ZERO).min(S::ONE);
    vec3(unit(c.x), unit(c.y), unit(c.z))
}
