//! Scenes made ready to be traced: one face for every arithmetic and every tree.
//!
//! Arithmetic and tree are chosen at run time among all that are compiled in, and only here, so that each pair of
//! them is compiled once, whoever traces: `octray render`, the simulation of schedules, the ranks of a distributed
//! rendering. [`prepare()`] makes a [`Renderer`], whose [`Worker`]s fill tiles of the picture.

pub use crate::build::{PrepareError, prepare};

use crate::interrupt::Interrupt;
use crate::pixel_trace::PixelTrace;
use crate::tile::{Intensity, Level, Tile};
use octray_core::frame::Region;
use octray_core::observe::Counters;
use octray_prepare::format::Format;
use octray_prepare::settings::TreeKind;
use serde::Serialize;

/// A scene in one arithmetic, with one tree.
pub trait Renderer: Send + Sync {
    /// What there is to know of it.
    fn built(&self) -> &Built;

    /// Somebody who traces parts of the picture, for one thread, until asked to stop: what is traced after that is
    /// incomplete, so whoever lets it trace [checks](Interrupt::check) afterwards. It looks at the budget of rays only
    /// now and then, and takes the rest off it when dropped.
    fn worker(&self, interrupt: &Interrupt) -> Box<dyn Worker + '_>;
}

/// Traces parts of a picture, one after the other, and counts.
pub trait Worker: Send {
    /// Fills a tile: its pixels, and the background where nothing is to be seen.
    fn trace(&mut self, tile: Tile<'_>);

    /// Traces some pixels only to count what they cost. What it learnt of the scene before is kept, so pixel
    /// by pixel costs what all of them at once do.
    fn probe(&mut self, region: &Region);

    /// What the camera's rays through the blocks that begin in a row meet first, from left to right; the
    /// samples of a block follow each other.
    fn first_hits(&mut self, row: u32) -> Vec<Option<FirstHit>>;

    /// Traces the rays that colour a pixel of the picture, and tells what each meets. The pixel is the picture's; what is
    /// counted is as if it had been the first of its tile.
    fn trace_pixel(&mut self, column: u32, row: u32) -> PixelTrace;

    /// Traces rays through places of the picture, in units of a 2·samples-th of a pixel from its upper left corner. Returns
    /// what they bring, clamped. What is counted does not depend on what was traced before.
    fn trace_places(&mut self, places: &[(u32, u32)]) -> Vec<Intensity>;

    /// What was counted so far.
    fn counters(&self) -> &Counters;

    /// Fixed-point results that had to be clamped to the format's range while this worker traced.
    fn saturations(&self) -> u64;
}

/// What a ray of the camera meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// The object's place in the scene file, counted from 0.
    pub object: u32,
    /// How far away, in units of the scene file.
    pub distance: f64,
}

/// What there is to know of a scene that was made ready.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    /// The number format.
    pub format: Format,
    /// The scene was scaled by 2 to this power.
    pub scale: i32,
    /// What the format is too coarse for, if anything.
    pub too_fine: Option<String>,
    /// The tree.
    pub tree: TreeStats,
    /// Columns and rows of the picture.
    pub size: (u32, u32),
    /// The pixels that may show anything but background.
    pub active: Region,
    /// The side of the square of pixels that one ray colours.
    pub block: u32,
    /// The background.
    pub background: (Level, Intensity),
}

impl Built {
    /// What tiles are cut of: the rows that may show anything but background, whole.
    pub fn region(&self) -> Region {
        Region {
            columns: 0..self.size.0,
            rows: self.active.rows.clone(),
        }
    }
}

/// The tree that was built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct TreeStats {
    /// Its kind.
    pub kind: TreeKind,
    /// Nodes.
    pub nodes: u64,
    /// Links from leaves to objects.
    pub links: u64,
    /// The deepest level of nodes, the root being level 0.
    pub depth: u32,
    /// Leaves that hold more objects than asked for because the arena was full.
    pub unsplit: u64,
}
