//! Portable float map: 32-bit floats, the bottom row first, the scale's sign telling the byte order.

use super::malformed::malformed;
use super::{Picture, netpbm};
use crate::tile::Intensity;
use std::io::{self, BufRead, Write};

/// Write the intensities little-endian; a picture without them gives level/255.
pub(super) fn write(picture: &Picture, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "PF\n{} {}\n-1.0\n", picture.width(), picture.height())?;
    let width = picture.width().max(1) as usize;
    match picture.intensities() {
        Some(intensities) => write_rows(intensities.chunks_exact(width), out, |c| c),
        None => write_rows(picture.rows(), out, |level| f32::from(level) / 255.0),
    }
}

fn write_rows<'a, T: Copy + 'a>(
    rows: impl DoubleEndedIterator<Item = &'a [[T; 3]]>,
    out: &mut dyn Write,
    intensity: impl Fn(T) -> f32,
) -> io::Result<()> {
    for sample in rows.rev().flat_map(<[_]>::as_flattened) {
        out.write_all(&intensity(*sample).to_le_bytes())?;
    }
    Ok(())
}

/// Read a colour (`PF`) or a grey (`Pf`) map of either byte order. The size of the scale is ignored, as
/// common readers do.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Picture> {
    let channels = match netpbm::word(input)?.as_str() {
        "PF" => 3,
        "Pf" => 1,
        _ => return Err(malformed("not a portable float map")),
    };
    let (width, height) = netpbm::size(input)?;
    let scale: f32 = netpbm::number(input, "scale")?;
    let float: fn([u8; 4]) -> f32 = match scale {
        _ if scale < 0.0 => f32::from_le_bytes,
        _ if scale > 0.0 => f32::from_be_bytes,
        _ => return Err(malformed(format!("the scale in the header is {scale}"))),
    };
    let mut upwards: Vec<Intensity> = Vec::new();
    for pixel in 0..u64::from(width) * u64::from(height) {
        let mut samples = [0.0; 3];
        for sample in &mut samples[..channels] {
            let mut bytes = [0; 4];
            input.read_exact(&mut bytes)?;
            *sample = float(bytes);
            if sample.is_nan() {
                let (row, column) = (pixel / u64::from(width), pixel % u64::from(width));
                let row = u64::from(height) - 1 - row;
                return Err(malformed(format!(
                    "the pixel in column {column}, row {row} (from 0) is not a number (NaN)"
                )));
            }
        }
        if channels == 1 {
            samples = [samples[0]; 3];
        }
        upwards.push(samples);
    }
    let downwards = upwards.chunks_exact(width as usize).rev().flatten();
    Picture::from_intensities(width, height, downwards.copied().collect())
        .ok_or_else(|| malformed("the picture is cut short"))
}
