//! Records of `octray measure --csv`, and the newest one that comes with octray.

use octray_prepare::{Arith, Format};
use serde::Deserialize;

/// The newest record.
pub const NEWEST: &str = include_str!(env!("OCTRAY_RECORD"));
/// Its path in the sources.
pub const NAME: &str = env!("OCTRAY_RECORD_NAME");
/// Its chart: SVG.
pub const CHART: &str = include_str!(env!("OCTRAY_RECORD_CHART"));

/// The record of table III.
pub const TABLE_III: &str = include_str!("../../record/table-iii.csv");
/// Its path in the sources.
pub const TABLE_III_NAME: &str = "lab/record/table-iii.csv";

/// The cost of a picture on a board: the columns that tables show. If there are no numbers, the run failed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RecordRow {
    /// The scene's name.
    pub scene: String,
    /// How many of the first lights were kept; all if `None`.
    #[serde(default)]
    pub lights: Option<usize>,
    /// Whether nothing reflected or refracted.
    #[serde(default)]
    pub opaque: bool,
    /// The board's name.
    pub board: String,
    /// The requested arithmetic.
    pub arith: Arith,
    /// The number format that was used; `None` if there are no numbers.
    #[serde(default)]
    pub format: Option<Format>,
    /// `ok`, or why there are no numbers.
    #[serde(default)]
    pub outcome: String,
    /// Instructions per pixel.
    pub per_pixel: Option<f64>,
    /// Bytes of code and constants.
    #[serde(default)]
    pub flash: Option<u64>,
    /// Bytes of variables.
    #[serde(default)]
    pub ram: Option<u64>,
    /// Maximum depth of the stack in bytes.
    #[serde(default)]
    pub stack: Option<u64>,
    /// Distance from the picture in `f64` (PSNR), in dB; `None` if they are equal or there are no numbers.
    #[serde(default)]
    pub psnr: Option<f64>,
    /// The commit that was measured.
    pub commit: String,
    /// The compiler.
    pub toolchain: String,
    /// The emulator.
    pub emulator: String,
}

/// Parses the rows of a record.
///
/// # Errors
/// If it is invalid.
pub fn read(text: &str) -> Result<Vec<RecordRow>, csv::Error> {
    csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .collect()
}
