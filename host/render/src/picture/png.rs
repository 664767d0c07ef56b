//! PNG, 8-bit RGB, by the crate `png`.

use super::Picture;
use super::malformed::malformed;
pub(super) use png::Compression;
use png::{BitDepth, ColorType, Decoder, Encoder, Transformations};
use std::io::{self, BufRead, Cursor, Write};

/// Write the levels.
///
/// Rendered pictures take a tenth more with `Compression::Fast` than with `Balanced`, in a twentieth of the time; drawings
/// take four times as much.
pub(super) fn write(
    picture: &Picture,
    compression: Compression,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut encoder = Encoder::new(out, picture.width(), picture.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(compression);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.levels().as_flattened())?;
    writer.finish()?;
    Ok(())
}

/// Read any PNG: 16 bits are cut to 8, grey is spread over the channels, alpha is dropped.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Picture> {
    // The decoder wants to seek, so it gets the file in memory.
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(refused)?;
    let (width, height) = reader.info().size();
    let (colour, _) = reader.output_color_type();
    let mut levels = Vec::new();
    if reader.info().interlaced {
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| malformed("the picture is too large"))?;
        let mut pixels = Vec::new();
        pixels
            .try_reserve_exact(size)
            .map_err(|_| malformed("the picture is too large"))?;
        pixels.resize(size, 0);
        reader.next_frame(&mut pixels).map_err(refused)?;
        append(&mut levels, &pixels, colour);
    } else {
        while let Some(row) = reader.next_row().map_err(refused)? {
            append(&mut levels, row.data(), colour);
        }
    }
    reader.finish().map_err(refused)?;
    Picture::from_levels(width, height, levels).ok_or_else(|| malformed("the picture is cut short"))
}

fn append(levels: &mut Vec<[u8; 3]>, bytes: &[u8], colour: ColorType) {
    let samples = bytes.chunks_exact(colour.samples());
    levels.extend(samples.map(|pixel| match *pixel {
        [r, g, b, ..] => [r, g, b],
        [grey, ..] => [grey; 3],
        [] => [0; 3],
    }));
}

fn refused(error: png::DecodingError) -> io::Error {
    malformed(error.to_string())
}
