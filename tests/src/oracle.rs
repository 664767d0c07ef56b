//! The oracle: a slow, simple `f64` renderer of the rendering model, with which octray is compared pixel by pixel.
//!
//! It shares no code with octray: it has its own reader of scene files, tests every object for every ray, and recurses.
//! It expects valid scenes and panics with a message on others.
//!
//! Where the model leaves a choice, the oracle does the following:
//! - Each sample is clamped to [0, 1] before the samples of a pixel are averaged.
//! - Of several objects hit at the same distance, the first in the file is visible.
//! - A ray of weight 0 is not traced, even when the cut-off is 0; a shadow ray is traced only if
//!   N·L > 0.
//! - The rays of a parallel view start in the plane through the viewpoint, with either camera.
//! - A patch is hit like a polygon and, like one, is entered at each hit; its normals are interpolated as they are in
//!   the file, and the sum is normalised and turned to face the ray.
//! - "t > 0" from a point on a surface: the ray starts off the surface by 1e-9 of the coordinates' size, along the
//!   geometric normal, on the side of its direction. "t < 1" to a light: the ray ends up to 1e-9 of its length before
//!   the light.

mod camera;
mod cone;
mod polygon;
mod read;
mod shape;
mod trace;
mod vector;

use camera::Camera;
use trace::Tracer;
use vector::V3;

/// The settings of a rendering.
#[derive(Clone, Debug)]
pub struct Options {
    /// Width and height in pixels, in place of the file's; the framing stays the same.
    pub size: Option<(u32, u32)>,
    /// 1, or 4: one ray through the centre of each 2 × 2 block colours all four pixels. A block that extends beyond the
    /// right or bottom edge keeps its centre.
    pub pixels_per_ray: u32,
    /// K: each pixel (or block) is the mean of K × K rays through the centres of equal sub-cells.
    pub samples: u32,
    /// The maximum number of bounces before a ray; 0 traces primary rays only.
    pub max_depth: u32,
    /// Rays of a smaller weight are not traced.
    pub cut_off: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: None,
            pixels_per_ray: 1,
            samples: 1,
            max_depth: 8,
            cut_off: 1.0 / 512.0,
        }
    }
}

/// Numbers of rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays from the eye.
    pub primary: u64,
    /// Rays from the eye that hit an object.
    pub eye_hits: u64,
    /// Rays traced towards a light.
    pub shadow: u64,
    /// Rays towards a light that hit an object.
    pub blocked: u64,
    /// Rays traced in the mirror direction.
    pub reflected: u64,
    /// Rays traced through a surface.
    pub transmitted: u64,
}

impl Counts {
    fn add(&mut self, other: &Self) {
        self.primary += other.primary;
        self.eye_hits += other.eye_hits;
        self.shadow += other.shadow;
        self.blocked += other.blocked;
        self.reflected += other.reflected;
        self.transmitted += other.transmitted;
    }
}

/// A rendered scene.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green and blue of each pixel, rows from top to bottom.
    pub rgb: Vec<u8>,
    /// The numbers of traced rays.
    pub counts: Counts,
}

/// Renders the text of a scene file on all cores.
///
/// # Panics
/// If the scene is not valid, or `pixels_per_ray` is no square, or `samples` or a size is 0.
#[must_use]
pub fn render(source: &str, options: &Options) -> Picture {
    let side = options.pixels_per_ray.isqrt();
    assert!(
        side > 0 && side * side == options.pixels_per_ray,
        "pixels per ray must be a square"
    );
    assert!(options.samples > 0, "samples must be at least 1");
    let scene = read::scene(source);
    let camera = Camera::new(&scene.view, options.size);
    let tracer = Tracer {
        scene: &scene,
        max_depth: options.max_depth,
        cut_off: options.cut_off,
    };
    let (width, height) = camera.size();
    let columns = width.div_ceil(side);

    let mut rgb = vec![0; 3 * width as usize * height as usize];
    let mut counts = Counts::default();
    let rows = on_all_cores(height.div_ceil(side), |row| {
        let mut counts = Counts::default();
        let cell = |column| {
            cell_colour(
                &tracer,
                &camera,
                (column, row),
                side,
                options.samples,
                &mut counts,
            )
        };
        let colours: Vec<[u8; 3]> = (0..columns).map(cell).collect();
        (colours, counts)
    });
    for (row, (colours, row_counts)) in rows.iter().enumerate() {
        counts.add(row_counts);
        let top = row * side as usize;
        for y in top..(top + side as usize).min(height as usize) {
            for x in 0..width as usize {
                let at = 3 * (y * width as usize + x);
                rgb[at..at + 3].copy_from_slice(&colours[x / side as usize]);
            }
        }
    }
    Picture {
        width,
        height,
        rgb,
        counts,
    }
}

/// Returns the object that the ray through each pixel's centre hits first, by its index in the file from 0; rows from
/// top to bottom. Of the options only `size` is used.
///
/// # Panics
/// If the scene is not valid, or a size is 0.
#[must_use]
pub fn first_object(source: &str, options: &Options) -> Vec<Option<u32>> {
    let scene = read::scene(source);
    let camera = Camera::new(&scene.view, options.size);
    let tracer = Tracer {
        scene: &scene,
        max_depth: 0,
        cut_off: 0.0,
    };
    let (width, height) = camera.size();
    let pixel = |x: u32, y: u32| {
        let ray = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
        tracer
            .nearest(&ray)
            .map(|(object, _)| u32::try_from(object).expect("too many objects"))
    };
    on_all_cores(height, |y| {
        (0..width).map(|x| pixel(x, y)).collect::<Vec<_>>()
    })
    .concat()
}

/// Returns the colour of one cell of `side` × `side` pixels, as bytes.
fn cell_colour(
    tracer: &Tracer<'_>,
    camera: &Camera,
    (column, row): (u32, u32),
    side: u32,
    samples: u32,
    counts: &mut Counts,
) -> [u8; 3] {
    let place = |cell: u32, sample: u32| {
        (f64::from(cell) + (f64::from(sample) + 0.5) / f64::from(samples)) * f64::from(side)
    };
    let mut sum = V3::ZERO;
    for b in 0..samples {
        for a in 0..samples {
            let ray = camera.ray(place(column, a), place(row, b));
            sum = sum + tracer.eye_ray(&ray, counts).map(|c| c.clamp(0.0, 1.0));
        }
    }
    let mean = sum * (1.0 / f64::from(samples * samples));
    [mean.x, mean.y, mean.z].map(to_byte)
}

/// Returns the byte nearest to 255 times a channel in [0, 1].
fn to_byte(channel: f64) -> u8 {
    (255.0 * channel + 0.5).floor() as u8
}

/// Returns the results of `work` for 0, 1, … `rows` − 1, in this order.
fn on_all_cores<T: Send>(rows: u32, work: impl Fn(u32) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let work = &work;
    let mut results: Vec<(u32, T)> = std::thread::scope(|scope| {
        let share = |first| {
            move || {
                (first..rows)
                    .step_by(threads)
                    .map(|row| (row, work(row)))
                    .collect::<Vec<_>>()
            }
        };
        let running: Vec<_> = (0..rows)
            .take(threads)
            .map(|first| scope.spawn(share(first)))
            .collect();
        running
            .into_iter()
            .flat_map(|thread| thread.join().expect("a rendering thread panicked"))
            .collect()
    });
    results.sort_by_key(|&(row, _)| row);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests;
