//! One row of the results: the combination, and its measurement.

use super::board::Board;
use super::count::{Count, is_float_library};
use super::cycles::Estimate;
use super::job::Goal;
use super::memory::Memory;
use super::reference::Reference;
use octray_prepare::{Arith, FirmwareTree, Format};
use octray_render::stats::Rays;
use serde::Serialize;

/// A scene on a board in an arithmetic, measured.
#[derive(Clone, Debug, Serialize)]
pub struct FrameRow {
    /// The scene's name.
    pub scene: String,
    /// The number of its objects.
    pub objects: usize,
    /// The number of its lights that were kept.
    pub lights: usize,
    /// Whether nothing reflected or refracted.
    pub opaque: bool,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The maximum number of bounces.
    pub max_depth: u32,
    /// Pixels that one ray colours.
    pub pixels_per_ray: u32,
    /// Rays of a smaller weight were not traced.
    pub cut_off: f64,
    /// The board.
    pub board: &'static Board,
    /// The arithmetic that was asked for.
    pub arith: Arith,
    /// The tree.
    pub tree: FirmwareTree,
    /// What the compiler optimized for.
    pub optimize: Goal,
    /// `ok`, or why there are no numbers.
    pub outcome: String,
    /// The numbers, if there are any.
    #[serde(flatten)]
    pub cost: Option<Cost>,
    /// Each function's own instructions, the most expensive first.
    #[serde(skip)]
    pub functions: Vec<(String, u64)>,
}

/// The columns of comma-separated values: those of every row, in order.
pub const COLUMNS: [&str; 41] = [
    "scene",
    "objects",
    "lights",
    "opaque",
    "width",
    "height",
    "max_depth",
    "pixels_per_ray",
    "cut_off",
    "board",
    "target",
    "core",
    "arith",
    "format",
    "tree",
    "optimize",
    "outcome",
    "instructions",
    "per_pixel",
    "rays",
    "per_ray",
    "closest_rays",
    "per_closest_ray",
    "shadow_rays",
    "per_shadow_ray",
    "load_store",
    "branch",
    "multiply",
    "divide",
    "float",
    "other",
    "float_library",
    "estimated_cycles_least",
    "estimated_cycles_most",
    "estimate_source",
    "computed_pixels_per_s_mhz",
    "flash",
    "ram",
    "stack",
    "psnr",
    "hash",
];

/// The cost of a frame. Instructions and rays are exact; cycles are an estimate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// The target triple in Rust.
    pub target: &'static str,
    /// The core.
    pub core: &'static str,
    /// The number format that was used.
    pub format: Format,
    /// Instructions of the frame, without start-up and without the panel.
    pub instructions: u64,
    /// Instructions per pixel.
    pub per_pixel: f64,
    /// Rays of all kinds, as the host counts them.
    pub rays: u64,
    /// Instructions per ray.
    pub per_ray: f64,
    /// Rays that search for the closest hit: all except shadow rays.
    pub closest_rays: u64,
    /// Instructions of the search, per ray that searches for the closest hit.
    pub per_closest_ray: Option<f64>,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// Instructions of the search, per ray to a light.
    pub per_shadow_ray: Option<f64>,
    /// Loads and stores.
    pub load_store: u64,
    /// Jumps, calls, returns.
    pub branch: u64,
    /// Integer multiplications.
    pub multiply: u64,
    /// Integer divisions.
    pub divide: u64,
    /// Instructions of the floating-point unit.
    pub float: u64,
    /// The rest.
    pub other: u64,
    /// The instructions in the library that emulates floating point, included above.
    pub float_library: u64,
    /// Estimated cycles: lower bound.
    pub estimated_cycles_least: Option<u64>,
    /// Estimated cycles: upper bound.
    pub estimated_cycles_most: Option<u64>,
    /// The source of the table for the estimate.
    pub estimate_source: Option<&'static str>,
    /// Pixels per second and MHz at one instruction per cycle: computed, not measured.
    pub computed_pixels_per_s_mhz: f64,
    /// Bytes of code and constants.
    pub flash: u64,
    /// Bytes of variables.
    pub ram: u64,
    /// Maximum depth of the stack in bytes.
    pub stack: u64,
    /// Distance from the picture in `f64` (PSNR), in dB; `None` if they are equal.
    pub psnr: Option<f64>,
    /// The picture's hash.
    pub hash: String,
}

impl FrameRow {
    /// Returns the instructions of the frame.
    pub fn instructions(&self) -> Option<u64> {
        self.cost.as_ref().map(|cost| cost.instructions)
    }
}

impl Cost {
    /// Combines the counts of the board with the host's data of the picture.
    pub fn new(
        board: &Board,
        count: &Count,
        reference: &Reference,
        memory: Memory,
        stack: u64,
        hash: String,
    ) -> Self {
        let traced = &reference.traced;
        let pixels = traced.picture.levels().len() as u64;
        let rays = Rays::of(&traced.counters);
        let closest = rays.primary + rays.reflected + rays.transmitted;
        let (found, finding) = count.calls_of("nearest");
        let seeking = count.calls_of("any_hit").1 + count.calls_of("blocks").1;
        // If the search is not a function of its own, or is also called for other purposes, its cost is unknown.
        let known = found == closest && found > 0;
        let per = |n: u64, of: u64| n as f64 / of as f64;
        let estimate = board.cycles.and_then(|table| table.estimate(count));
        let estimate = estimate.map(|Estimate { least, most }| (least, most));
        Self {
            target: board.target,
            core: board.core,
            format: traced.format,
            instructions: count.instructions,
            per_pixel: per(count.instructions, pixels),
            rays: rays.total(),
            per_ray: per(count.instructions, rays.total()),
            closest_rays: closest,
            per_closest_ray: known.then(|| per(finding, closest)),
            shadow_rays: rays.shadow,
            per_shadow_ray: (known && rays.shadow > 0).then(|| per(seeking, rays.shadow)),
            load_store: count.class("load-store"),
            branch: count.class("branch"),
            multiply: count.class("multiply"),
            divide: count.class("divide"),
            float: count.class("float"),
            other: count.class("other"),
            float_library: count.in_functions(is_float_library),
            estimated_cycles_least: estimate.map(|(least, _)| least),
            estimated_cycles_most: estimate.map(|(_, most)| most),
            estimate_source: (estimate.and(board.cycles)).map(|table| table.source),
            computed_pixels_per_s_mhz: 1e6 * per(pixels, count.instructions),
            flash: memory.flash,
            ram: memory.ram,
            stack,
            psnr: reference.psnr.is_finite().then_some(reference.psnr),
            hash,
        }
    }
}
