//! The picture formats: told by a file's extension when written, by its first bytes when read.

use super::malformed::malformed;
use super::ras::RasDepth;
use super::{Picture, intensity, pfm, png, ppm, ras};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::output;
use octray_scenes::input;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, BufRead, BufReader, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// A picture format, by its extension.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, VariantArray, EnumMessage, EnumString, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Format {
    /// Portable Network Graphics, 8-bit RGB; animated if there are several pictures.
    Png,
    /// Portable pixmap P6, 8-bit RGB.
    Ppm,
    /// Portable float map PF: intensities, little-endian, the bottom row first.
    Pfm,
    /// Sun rasterfile.
    Ras,
    /// The thesis's intensity file: the place and the intensities of every pixel, as text.
    Int,
}

impl Format {
    /// Every format with its extension.
    pub const ALL: [(&str, Self); 6] = [
        ("png", Self::Png),
        ("apng", Self::Png),
        ("ppm", Self::Ppm),
        ("pfm", Self::Pfm),
        ("ras", Self::Ras),
        ("int", Self::Int),
    ];

    /// The format that a file's extension names, whatever its case.
    ///
    /// # Errors
    /// A sentence naming the known extensions.
    pub fn of(path: &Path) -> Result<Self, String> {
        let extension = path.extension().unwrap_or_default();
        Self::ALL
            .iter()
            .find(|(known, _)| extension.eq_ignore_ascii_case(known))
            .map(|(_, format)| *format)
            .ok_or_else(|| unknown(extension))
    }
}

fn unknown(extension: &OsStr) -> String {
    let known = Format::ALL.map(|(name, _)| format!(".{name}")).join(", ");
    match extension.is_empty() {
        true => format!("a picture's name ends in one of {known}"),
        false => format!(
            "'.{}' is no picture format known here; the known ones are {known}",
            extension.to_string_lossy()
        ),
    }
}

/// A picture file to write: its name, and the format its extension names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The file.
    pub path: PathBuf,
    /// Its format.
    pub format: Format,
}

impl Target {
    /// The target that `path` names. What has no name of its own, standard output or a pipe, gets PNG.
    ///
    /// # Errors
    /// As [`Format::of`]; if a picture would go to a terminal.
    pub fn new(path: PathBuf) -> Result<Self, String> {
        not_to_terminal(&path)?;
        let is_stdout = output::is_stdout(&path);
        let is_pipe = || fs::metadata(&path).is_ok_and(|found| !found.is_file() && !found.is_dir());
        let format = match Format::of(&path) {
            Err(_) if is_stdout || is_pipe() => Format::Png,
            known => known?,
        };
        Ok(Self { path, format })
    }

    /// The target that `path` names, in this format whatever the name says.
    ///
    /// # Errors
    /// If a picture would go to a terminal.
    pub fn in_format(path: PathBuf, format: Format) -> Result<Self, String> {
        not_to_terminal(&path)?;
        Ok(Self { path, format })
    }

    /// Whether the format holds intensities rather than levels.
    pub fn holds_intensities(&self) -> bool {
        matches!(self.format, Format::Pfm | Format::Int)
    }

    /// Write `picture` whole or not at all.
    ///
    /// # Errors
    /// As [`output::write_file`].
    pub fn write(
        &self,
        picture: &Picture,
        ras_depth: RasDepth,
        interrupt: &Interrupt,
    ) -> Result<(), Error> {
        output::write_file(&self.path, interrupt, |out| {
            encode(picture, self.format, ras_depth, out)
        })
    }
}

fn not_to_terminal(path: &Path) -> Result<(), String> {
    match output::is_stdout(path) && io::stdout().is_terminal() {
        true => Err("standard output is a terminal: expected a pipe or a file".into()),
        false => Ok(()),
    }
}

fn encode(
    picture: &Picture,
    format: Format,
    ras_depth: RasDepth,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Png => png::write(picture, png::Compression::Fast, out),
        Format::Ppm => ppm::write(picture, out),
        Format::Pfm => pfm::write(picture, out),
        Format::Ras => ras::write(picture, ras_depth, out),
        Format::Int => intensity::write(picture, out),
    }
}

/// Read a picture of any of the formats, told by its first bytes, from a file, a pipe or, if the path is `-`, standard
/// input.
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or is no such picture.
pub fn read(path: &Path) -> Result<Picture, Error> {
    read_first(path).map(|(picture, _)| picture)
}

/// The same of what may be an animation: its first picture, and how many it has.
///
/// # Errors
/// Those of [`read`].
pub fn read_first(path: &Path) -> Result<(Picture, u32), Error> {
    input::stream(path)
        .and_then(|file| decode_first(&mut BufReader::new(file)))
        .map_err(|source| match source.kind() {
            ErrorKind::UnexpectedEof => Error::read(path, malformed("the picture is cut short")),
            _ => Error::read(path, source),
        })
}

/// Reads a picture of any of the formats, told by its first bytes, from what is no file.
///
/// # Errors
/// When it cannot be read or is no such picture.
pub fn decode(input: &mut dyn BufRead) -> io::Result<Picture> {
    decode_first(input).map(|(picture, _)| picture)
}

fn decode_first(input: &mut dyn BufRead) -> io::Result<(Picture, u32)> {
    if input.fill_buf()?.starts_with(b"\x89PNG") {
        return png::read(input);
    }
    decode_still(input).map(|picture| (picture, 1))
}

fn decode_still(input: &mut dyn BufRead) -> io::Result<Picture> {
    match input.fill_buf()? {
        [b'P', b'6', ..] => ppm::read(input),
        [b'P', b'F' | b'f', ..] => pfm::read(input),
        [0x59, 0xa6, 0x6a, 0x95, ..] => ras::read(input),
        bytes if bytes.starts_with(intensity::MAGIC) => intensity::read(input),
        [] => Err(malformed("the file is empty")),
        _ => Err(malformed(
            "not a picture known here (PNG, PPM P6, PFM, Sun rasterfile or intensity file)",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Dither;
    use crate::tile::Level;

    /// More than 256 colours, no symmetry.
    fn colourful(width: u32, height: u32) -> Picture {
        let levels = (0..width * height)
            .map(|i| [i * 7, i * 13 + 5, i * 31 + 90].map(|v| v as u8) as Level)
            .collect();
        Picture::from_levels(width, height, levels).unwrap()
    }

    fn round_trip(picture: &Picture, format: Format, depth: RasDepth) -> Picture {
        let mut bytes = Vec::new();
        encode(picture, format, depth, &mut bytes).unwrap();
        let decoded = decode(&mut bytes.as_slice()).unwrap();
        for cut in (0..bytes.len()).step_by(1 + bytes.len() / 100) {
            assert!(
                decode(&mut &bytes[..cut]).is_err(),
                "{format:?} cut to {cut}"
            );
        }
        decoded
    }

    #[test]
    fn every_format_gives_back_its_levels_at_odd_and_even_widths() {
        for (width, height) in [(1, 1), (3, 2), (4, 3), (17, 5), (16, 20)] {
            let picture = colourful(width, height);
            for (_, format) in Format::ALL {
                for depth in [RasDepth::TwentyFour, RasDepth::ThirtyTwo] {
                    let back = round_trip(&picture, format, depth);
                    assert_eq!(back.size(), (width, height), "{format:?}");
                    assert_eq!(back.levels(), picture.levels(), "{format:?}");
                }
            }
        }
    }

    #[test]
    fn a_damaged_file_is_read_or_refused_but_never_panics() {
        let picture = colourful(5, 4);
        for (_, format) in Format::ALL {
            for depth in RasDepth::VARIANTS.iter().copied() {
                let mut bytes = Vec::new();
                encode(&picture, format, depth, &mut bytes).unwrap();
                for place in 0..bytes.len().min(200) {
                    for damage in [0, 1, 2, 3, 9, 24, 32, b'-', b'9', 0x7f, 0xff] {
                        let mut damaged = bytes.clone();
                        damaged[place] = damage;
                        let _ = decode(&mut damaged.as_slice());
                    }
                }
            }
        }
    }

    #[test]
    fn a_rasterfile_with_a_map_is_exact_up_to_256_colours() {
        for (width, height) in [(16, 16), (17, 15), (1, 2)] {
            let picture = colourful(width, height);
            assert_eq!(round_trip(&picture, Format::Ras, RasDepth::Eight), picture);
        }
    }

    #[test]
    fn intensities_survive_a_float_map_bit_for_bit() {
        let rgb = [[0.1, 0.2, 0.3], [1.5, -0.0, 1e-30], [0.999, 0.5, 0.25]];
        let picture = Picture::from_intensities(1, 3, rgb.to_vec()).unwrap();
        for format in [Format::Pfm, Format::Int] {
            assert_eq!(round_trip(&picture, format, RasDepth::Eight), picture);
        }
    }

    #[test]
    fn a_rasterfile_of_one_bit_is_the_dithered_picture_at_any_width() {
        for (width, height) in [(1, 1), (7, 3), (8, 2), (16, 2), (17, 5), (31, 4)] {
            let picture = colourful(width, height);
            let back = round_trip(&picture, Format::Ras, RasDepth::One);
            assert_eq!(back, Dither::Diffusion.apply(&picture));
            assert_eq!(round_trip(&back, Format::Ras, RasDepth::One), back);
        }
    }

    #[test]
    fn an_unknown_extension_is_told_with_the_known_ones() {
        assert_eq!(Format::of(Path::new("a/b.PNG")), Ok(Format::Png));
        for name in ["a.bmp", "a", "png", "a.png/b"] {
            let text = Format::of(Path::new(name)).unwrap_err();
            assert!(
                text.contains(".png, .apng, .ppm, .pfm, .ras, .int"),
                "{text}"
            );
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        for bytes in [
            &b""[..],
            b"GIF89a",
            b"P6\n2 2\n65535\n",
            b"P6\n0 2\n255\n",
            b"P6 99999999999 2 255 ",
            b"PF\n1 1\n0\n",
            b"PF\n1 1\nnan\n",
            b"P6\n-1 2\n255\n",
        ] {
            assert!(decode(&mut &*bytes).is_err(), "{bytes:?}");
        }
    }
}
