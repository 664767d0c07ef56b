//! PNG, 8-bit RGB, by the crate `png`.

use super::Picture;
use super::malformed::malformed;
pub(super) use png::Compression;
use png::{BitDepth, ColorType, Decoder, Encoder, Reader, Transformations, Writer};
use std::io::{self, BufRead, Cursor, Read, Write};

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

/// An animated PNG (APNG) that is being written. Programs that know none show its first picture.
#[expect(missing_debug_implementations, reason = "the encoder has none")]
pub struct Animation<'a> {
    writer: Writer<&'a mut dyn Write>,
    size: (u32, u32),
}

impl<'a> Animation<'a> {
    /// Begins a file of this many pictures of one size (columns, rows), shown over and over, so many in a second.
    ///
    /// # Errors
    /// If it cannot be written, or has no pictures.
    pub fn begin(
        out: &'a mut dyn Write,
        size: (u32, u32),
        count: u32,
        per_second: u16,
    ) -> io::Result<Self> {
        let mut encoder = Encoder::new(out, size.0, size.1);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        encoder.set_animated(count, 0)?;
        encoder.validate_sequence(true);
        encoder.set_frame_delay(1, per_second)?;
        let writer = encoder.write_header()?;
        Ok(Self { writer, size })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// If it cannot be written, is of another size, or is one too many.
    pub fn add(&mut self, picture: &Picture) -> io::Result<()> {
        if picture.size() != self.size {
            return Err(io::Error::other("the pictures differ in size"));
        }
        (self.writer).write_image_data(picture.levels().as_flattened())?;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// If it cannot be written, or pictures are missing.
    pub fn finish(self) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}

/// Bytes of signature and header, and what may come beside compressed pixels.
const HEADER: usize = 33;
const BESIDE_PIXELS: u64 = 1 << 26;

/// Read any PNG: 16 bits are cut to 8, grey is spread over the channels, alpha is dropped. Of an animation it is the first
/// picture; tells how many there are.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<(Picture, u32)> {
    // The decoder wants to seek, so it gets the file in memory.
    let bytes = whole(input)?;
    let mut reader = decoder(&bytes)?;
    let (width, height) = reader.info().size();
    let count = (reader.info().animation_control()).map_or(1, |animation| animation.num_frames);
    let (colour, _) = reader.output_color_type();
    let mut levels = Vec::new();
    if reader.info().interlaced {
        // The rows come in pieces, so that memory is needed for all of them at once. Whether they all come is found out
        // without: the size in a header may be any.
        let mut rows = decoder(&bytes)?;
        while rows.next_interlaced_row().map_err(refused)?.is_some() {}
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
    Picture::from_levels(width, height, levels)
        .map(|picture| (picture, count))
        .ok_or_else(|| malformed("the picture is cut short"))
}

/// Reads the whole file, but no more than a picture of the size in its header can take.
fn whole(input: &mut dyn BufRead) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; HEADER];
    input.read_exact(&mut bytes)?;
    let size = |at: usize| {
        bytes[at..]
            .first_chunk()
            .map_or(0, |word| u32::from_be_bytes(*word))
    };
    let [width, height] = [16, 20].map(|at| u64::from(size(at)));
    // A pixel takes up to 8 bytes, a row one more; what cannot be compressed grows a little.
    let pixels = height.saturating_mul(8 * width + 1);
    let most = pixels
        .saturating_add(pixels / 64)
        .saturating_add(BESIDE_PIXELS);
    input.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn decoder(bytes: &[u8]) -> io::Result<Reader<Cursor<&[u8]>>> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    decoder.read_info().map_err(refused)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The head of an interlaced picture of this size without pixels, as a decoder that ignores checksums takes it.
    fn head(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut info = png::Info::with_size(width, height);
        info.color_type = ColorType::Rgb;
        info.bit_depth = BitDepth::Eight;
        info.interlaced = true;
        // The encoder writes no interlaced pixels, but their header.
        let writer = Encoder::with_info(&mut bytes, info).unwrap().write_header();
        drop(writer);
        bytes
    }

    #[test]
    fn a_header_alone_takes_no_memory() {
        for (width, height) in [(1, u32::MAX >> 1), (5, 500_000_000), (40_000, 40_000)] {
            let bytes = head(width, height);
            let used = allocation_counter::measure(|| {
                read(&mut &*bytes).unwrap_err();
            });
            assert!(
                used.bytes_max < 10 << 20,
                "{width} x {height}: {}",
                used.bytes_max
            );
        }
    }

    #[test]
    fn an_animation_has_all_its_pictures_and_is_read_as_its_first() {
        let picture = |level| Picture::from_levels(2, 1, vec![[level, 2, 3]; 2]).unwrap();
        let mut bytes = Vec::new();
        let mut animation = Animation::begin(&mut bytes, (2, 1), 3, 25).unwrap();
        for level in [10, 20, 30] {
            animation.add(&picture(level)).unwrap();
        }
        assert!(animation.add(&picture(0)).is_err());
        animation.finish().unwrap();
        assert_eq!(read(&mut &*bytes).unwrap(), (picture(10), 3));
        let mut reader = decoder(&bytes).unwrap();
        let frames = reader.info().animation_control().unwrap();
        assert_eq!((frames.num_frames, frames.num_plays), (3, 0));
        for level in [10, 20, 30] {
            let mut pixels = [0; 6];
            reader.next_frame(&mut pixels).unwrap();
            assert_eq!(pixels, [level, 2, 3, level, 2, 3]);
            let shown = reader.info().frame_control().unwrap();
            assert_eq!((shown.delay_num, shown.delay_den), (1, 25));
        }
    }

    #[test]
    fn what_follows_a_picture_for_ever_is_not_read() {
        let mut bytes = Vec::new();
        let picture = Picture::from_levels(1, 1, vec![[1, 2, 3]]).unwrap();
        write(&picture, Compression::Fast, &mut bytes).unwrap();
        let endless = Read::chain(&*bytes, io::repeat(0));
        let read = read(&mut io::BufReader::new(endless)).unwrap();
        assert_eq!(read, (picture, 1));
    }
}
