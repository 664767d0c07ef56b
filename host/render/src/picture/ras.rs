//! Sun rasterfile: eight big-endian words, a colour map, rows padded to 16 bits (Sun's `rasterfile(5)`).

use super::malformed::malformed;
use super::{Dither, Picture, palette};
use crate::tile::Level;
use std::io::{self, BufRead, ErrorKind, Read, Write};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// Bits per pixel of a Sun rasterfile.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum RasDepth {
    /// Black and white, what a pixel is off going to its neighbours.
    #[strum(serialize = "1")]
    One,
    /// 256 colours in a map; exact when the picture has no more.
    #[default]
    #[strum(serialize = "8")]
    Eight,
    /// True colour.
    #[strum(serialize = "24")]
    TwentyFour,
    /// True colour with an unused byte before each pixel.
    #[strum(serialize = "32")]
    ThirtyTwo,
}

const MAGIC: u32 = 0x59a6_6a95;
/// Types: raw data as in the oldest files, raw data, and raw data with red first.
const RT_OLD: u32 = 0;
const RT_STANDARD: u32 = 1;
const RT_FORMAT_RGB: u32 = 3;
/// Colour maps: none, and all reds, then all greens, then all blues.
const RMT_NONE: u32 = 0;
const RMT_EQUAL_RGB: u32 = 1;
/// Colours in the map that is written.
const COLOURS: usize = 256;

/// Write the levels as `RT_STANDARD`: as bits, through a map of 256 colours, or as blue, green, red.
pub(super) fn write(picture: &Picture, depth: RasDepth, out: &mut dyn Write) -> io::Result<()> {
    match depth {
        RasDepth::Eight => write_mapped(picture, out),
        RasDepth::One => write_bits(picture, out),
        RasDepth::TwentyFour => write_true_colour(picture, 24, out),
        RasDepth::ThirtyTwo => write_true_colour(picture, 32, out),
    }
}

/// Without a map, a bit that is set is black.
fn write_bits(picture: &Picture, out: &mut dyn Write) -> io::Result<()> {
    write_header(picture, 1, 0, out)?;
    let bits = Dither::Diffusion.bits(picture);
    for row in bits.chunks_exact(picture.width() as usize) {
        let byte = |white: &[bool]| {
            let black = white.iter().enumerate().filter(|(_, white)| !**white);
            black.fold(0, |byte, (i, _)| byte | 0x80 >> i)
        };
        write_row(&row.chunks(8).map(byte).collect::<Vec<u8>>(), out)?;
    }
    Ok(())
}

fn write_mapped(picture: &Picture, out: &mut dyn Write) -> io::Result<()> {
    let mut indexed = palette::reduce(picture);
    indexed.colours.resize(COLOURS, [0; 3]);
    write_header(picture, 8, 3 * COLOURS as u32, out)?;
    for channel in 0..3 {
        let plane: Vec<u8> = indexed.colours.iter().map(|rgb| rgb[channel]).collect();
        out.write_all(&plane)?;
    }
    for row in indexed.indices.chunks_exact(picture.width() as usize) {
        write_row(row, out)?;
    }
    Ok(())
}

fn write_true_colour(picture: &Picture, depth: u32, out: &mut dyn Write) -> io::Result<()> {
    write_header(picture, depth, 0, out)?;
    let unused = if depth == 32 { &[0][..] } else { &[] };
    for row in picture.rows() {
        let mut bytes = Vec::with_capacity(4 * row.len());
        for [r, g, b] in row {
            bytes.extend_from_slice(unused);
            bytes.extend([b, g, r]);
        }
        write_row(&bytes, out)?;
    }
    Ok(())
}

fn write_header(picture: &Picture, depth: u32, map: u32, out: &mut dyn Write) -> io::Result<()> {
    let (width, height) = picture.size();
    let length = u32::try_from(row_bytes(width, depth) * u64::from(height))
        .map_err(|_| io::Error::new(ErrorKind::InvalidInput, "too large for a Sun rasterfile"))?;
    let map_type = if map == 0 { RMT_NONE } else { RMT_EQUAL_RGB };
    for word in [
        MAGIC,
        width,
        height,
        depth,
        length,
        RT_STANDARD,
        map_type,
        map,
    ] {
        out.write_all(&word.to_be_bytes())?;
    }
    Ok(())
}

fn write_row(row: &[u8], out: &mut dyn Write) -> io::Result<()> {
    out.write_all(row)?;
    if row.len() % 2 == 1 {
        out.write_all(&[0])?;
    }
    Ok(())
}

/// Bytes of a row, padded to 16 bits.
fn row_bytes(width: u32, depth: u32) -> u64 {
    (u64::from(width) * u64::from(depth)).div_ceil(16) * 2
}

/// Read a rasterfile that is not run-length encoded, of 1, 8, 24 or 32 bits a pixel.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Picture> {
    let mut header = [0; 8];
    for word in &mut header {
        let mut bytes = [0; 4];
        input.read_exact(&mut bytes)?;
        *word = u32::from_be_bytes(bytes);
    }
    let [_, width, height, depth, _length, kind, map_type, map_bytes] = header;
    if width == 0 || height == 0 {
        return Err(malformed("the picture has no pixels"));
    }
    if !matches!(kind, RT_OLD | RT_STANDARD | RT_FORMAT_RGB) {
        return Err(malformed(format!(
            "rasterfiles of type {kind} are not read, only raw ones (0, 1 and 3)"
        )));
    }
    let map = read_map(input, depth, map_type, map_bytes)?;
    let red_first = kind == RT_FORMAT_RGB;
    let pixel = |bytes: &[u8]| -> Option<Level> {
        match *bytes {
            [index] => map.get(usize::from(index)).copied(),
            [r, g, b] | [_, r, g, b] if red_first => Some([r, g, b]),
            [b, g, r] | [_, b, g, r] => Some([r, g, b]),
            _ => None,
        }
    };
    if !matches!(depth, 1 | 8 | 24 | 32) || (depth > 8 && map_bytes > 0) {
        return Err(malformed(format!(
            "rasterfiles of {depth} bits with a map of {map_bytes} bytes are not read"
        )));
    }
    let used = width as usize * depth as usize / 8;
    let no_colour = || malformed("a pixel's colour is not in the map");
    let mut levels = Vec::new();
    let mut row = Vec::new();
    for _ in 0..height {
        row.clear();
        let wanted = row_bytes(width, depth);
        if input.take(wanted).read_to_end(&mut row)? as u64 != wanted {
            return Err(ErrorKind::UnexpectedEof.into());
        }
        if depth == 1 {
            let bit = |x: usize| map.get(usize::from(row[x / 8] >> (7 - x % 8) & 1));
            for x in 0..width as usize {
                levels.push(*bit(x).ok_or_else(no_colour)?);
            }
            continue;
        }
        for bytes in row[..used].chunks_exact(depth as usize / 8) {
            levels.push(pixel(bytes).ok_or_else(no_colour)?);
        }
    }
    Picture::from_levels(width, height, levels).ok_or_else(|| malformed("the picture is cut short"))
}

/// The colour map, or what holds where there is none: white and black for bits, else the greys.
fn read_map(
    input: &mut dyn BufRead,
    depth: u32,
    map_type: u32,
    bytes: u32,
) -> io::Result<Vec<Level>> {
    if bytes == 0 && depth == 1 {
        return Ok(vec![[255; 3], [0; 3]]);
    }
    if bytes == 0 {
        return Ok((0..=255).map(|grey| [grey; 3]).collect());
    }
    if map_type != RMT_EQUAL_RGB || !bytes.is_multiple_of(3) || bytes > 3 * COLOURS as u32 {
        return Err(malformed(format!(
            "colour maps of type {map_type} and {bytes} bytes are not read"
        )));
    }
    let mut planes = vec![0; bytes as usize];
    input.read_exact(&mut planes)?;
    let colours = planes.len() / 3;
    Ok((0..colours)
        .map(|i| [planes[i], planes[colours + i], planes[2 * colours + i]])
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bytes_are_those_of_the_manual_page() {
        let picture = Picture::from_levels(1, 2, vec![[1, 2, 3], [4, 5, 6]]).unwrap();
        let mut mapped = Vec::new();
        write(&picture, RasDepth::Eight, &mut mapped).unwrap();
        #[rustfmt::skip]
        let header = [
            0x59, 0xa6, 0x6a, 0x95, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 8,
            0, 0, 0, 4, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 3, 0,
        ];
        assert_eq!(mapped[..32], header);
        assert_eq!((mapped[32], mapped[33]), (1, 4));
        assert_eq!((mapped[32 + 256], mapped[33 + 256]), (2, 5));
        assert_eq!((mapped[32 + 512], mapped[33 + 512]), (3, 6));
        assert_eq!(mapped[32 + 768..], [0, 0, 1, 0]);

        let mut colour = Vec::new();
        write(&picture, RasDepth::TwentyFour, &mut colour).unwrap();
        assert_eq!(
            colour[12..32],
            [0, 0, 0, 24, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0]
        );
        assert_eq!(colour[32..], [3, 2, 1, 0, 6, 5, 4, 0]);

        let mut wide = Vec::new();
        write(&picture, RasDepth::ThirtyTwo, &mut wide).unwrap();
        assert_eq!(wide[12..20], [0, 0, 0, 32, 0, 0, 0, 8]);
        assert_eq!(wide[32..], [0, 3, 2, 1, 0, 6, 5, 4]);

        // Nine pixels: black, white, black, six times white.
        let levels = [0, 255, 0, 255, 255, 255, 255, 255, 255].map(|level| [level; 3]);
        let picture = Picture::from_levels(9, 1, levels.to_vec()).unwrap();
        let mut bits = Vec::new();
        write(&picture, RasDepth::One, &mut bits).unwrap();
        assert_eq!(bits[12..20], [0, 0, 0, 1, 0, 0, 0, 2]);
        assert_eq!(bits[32..], [0b1010_0000, 0]);
    }

    #[test]
    fn bits_are_read_through_a_map_if_there_is_one() {
        let picture = Picture::from_levels(3, 1, vec![[0; 3], [255; 3], [0; 3]]).unwrap();
        let mut bytes = Vec::new();
        write(&picture, RasDepth::One, &mut bytes).unwrap();
        (bytes[27], bytes[31]) = (1, 6);
        // Reds, greens, blues of 0 and of 1.
        bytes.splice(32..32, [10, 20, 30, 40, 50, 60]);
        let read = read(&mut &*bytes).unwrap();
        assert_eq!(read.levels(), [[20, 40, 60], [10, 30, 50], [20, 40, 60]]);
    }
}
