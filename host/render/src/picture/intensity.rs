//! The intensity file (thesis, 5.6): the coordinates of every pixel and its red, green and blue, as text.
//!
//! ```text
//! intensity 640 480
//! 0 0 0.1 0.25 0.5
//! 1 0 0.1 0.25 0.5
//! ```
//!
//! The first line has columns and rows. The others have column, row, red, green and blue of a pixel, row by row from the
//! upper left corner, 1 being full intensity. Lines that begin with `#`, and empty ones, mean nothing. The thesis prints no
//! example; the first line, by which a file that is cut short is told, is ours.

use super::malformed::malformed;
use super::{Picture, netpbm};
use crate::tile::Intensity;
use std::io::{self, BufRead, Read, Write};

/// The word that begins a file.
pub(super) const MAGIC: &[u8] = b"intensity";

/// The first line.
const FORM: &str = "'intensity COLUMNS ROWS' of 1 to 4294967296 pixels";

/// No line is longer.
const LONGEST_LINE: u64 = 1024;

/// Write the intensities in as many digits as it takes to read them back; a picture without them gives level/255.
pub(super) fn write(picture: &Picture, out: &mut dyn Write) -> io::Result<()> {
    let (width, height) = picture.size();
    writeln!(out, "intensity {width} {height}")?;
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let mut pixel = |(x, y): (u32, u32), [r, g, b]: Intensity| writeln!(out, "{x} {y} {r} {g} {b}");
    match picture.intensities() {
        Some(intensities) => (places.zip(intensities)).try_for_each(|(at, rgb)| pixel(at, *rgb)),
        None => (places.zip(picture.levels()))
            .try_for_each(|(at, level)| pixel(at, level.map(|level| f32::from(level) / 255.0))),
    }
}

/// Read a picture.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Picture> {
    let mut lines = Lines { input, number: 0 };
    let header = lines.next()?.unwrap_or_default();
    let rest = header
        .strip_prefix("intensity")
        .map(|rest| format!("{}\n", rest.trim()))
        .unwrap_or_default();
    let (width, height) =
        netpbm::size(&mut rest.as_bytes()).map_err(|_| lines.expected(FORM, &header))?;
    let mut intensities = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let Some(line) = lines.next()? else {
                return Err(io::ErrorKind::UnexpectedEof.into());
            };
            let pixel = pixel(&line, (x, y));
            let form = || format!("'{x} {y} RED GREEN BLUE'");
            intensities.push(pixel.ok_or_else(|| lines.expected(&form(), &line))?);
        }
    }
    if let Some(line) = lines.next()? {
        return Err(lines.expected("no more pixels", &line));
    }
    Picture::from_intensities(width, height, intensities)
        .ok_or_else(|| malformed("the picture is cut short"))
}

/// The pixel of a line, if it is the one at this place.
fn pixel(line: &str, (x, y): (u32, u32)) -> Option<Intensity> {
    let mut words = line.split_ascii_whitespace();
    let place = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
    let mut channel = || (words.next()?.parse().ok()).filter(|number: &f32| !number.is_nan());
    let pixel = [channel()?, channel()?, channel()?];
    (place == (x, y) && words.next().is_none()).then_some(pixel)
}

/// The lines that mean something.
struct Lines<'a> {
    input: &'a mut dyn BufRead,
    /// The last one's number, counted from 1.
    number: u64,
}

impl Lines<'_> {
    /// The next line without the white space around it; `None` at the end of the file.
    fn next(&mut self) -> io::Result<Option<String>> {
        loop {
            let mut line = Vec::new();
            self.number += 1;
            (&mut *self.input)
                .take(LONGEST_LINE)
                .read_until(b'\n', &mut line)?;
            if line.is_empty() {
                return Ok(None);
            }
            if !line.ends_with(b"\n") {
                let number = self.number;
                return Err(match line.len() as u64 {
                    LONGEST_LINE => malformed(format!("line {number} is too long")),
                    // Its last number may be, too.
                    _ => io::ErrorKind::UnexpectedEof.into(),
                });
            }
            let line = String::from_utf8_lossy(&line);
            let line = line.trim();
            if !line.is_empty() && !line.starts_with('#') {
                return Ok(Some(line.into()));
            }
        }
    }

    /// The error for the last line.
    fn expected(&self, form: &str, line: &str) -> io::Error {
        let shown: String = line.chars().take(60).collect();
        let (number, shown) = (self.number, shown.escape_debug());
        malformed(format!("line {number}: expected {form}, found '{shown}'"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> io::Result<Picture> {
        read(&mut text.as_bytes())
    }

    #[test]
    fn the_file_is_the_documented_one() {
        let picture =
            Picture::from_intensities(2, 1, vec![[0.1, 1.5, 0.0], [1.0, 0.25, 0.5]]).unwrap();
        let mut bytes = Vec::new();
        write(&picture, &mut bytes).unwrap();
        let text = "intensity 2 1\n0 0 0.1 1.5 0\n1 0 1 0.25 0.5\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), text);
        assert_eq!(read_text(text).unwrap(), picture);
        let spaced =
            "# made by hand\nintensity  2\t1\r\n\n 0 0  0.1 1.5 0\n# next\n1 0 1 .25 5e-1\n";
        // What begins with a comment is no file of ours to `decode`, but read all the same.
        assert_eq!(read_text(spaced).unwrap(), picture);
    }

    #[test]
    fn a_mistake_is_told_with_its_line_and_what_was_expected() {
        let cases = [
            (
                "intensity 2\n",
                "line 1: expected 'intensity COLUMNS ROWS' of 1 to 4294967296 pixels, found 'intensity 2'",
            ),
            (
                "intensity 0 3\n",
                "line 1: expected 'intensity COLUMNS ROWS' of 1 to 4294967296 pixels, found 'intensity 0 3'",
            ),
            (
                "intensity 99999 99999\n",
                "line 1: expected 'intensity COLUMNS ROWS' of 1 to 4294967296 pixels, found 'intensity 99999 99999'",
            ),
            (
                "intensity 1 1\n0 0 1 nan 1\n",
                "line 2: expected '0 0 RED GREEN BLUE', found '0 0 1 nan 1'",
            ),
            (
                "intensity 2 1\n0 0 1 1 1\n0 1 1 1 1\n",
                "line 3: expected '1 0 RED GREEN BLUE', found '0 1 1 1 1'",
            ),
            (
                "intensity 1 1\n\n0 0 1 one 1\n",
                "line 3: expected '0 0 RED GREEN BLUE', found '0 0 1 one 1'",
            ),
            (
                "intensity 1 1\n0 0 1 1 1\n0 1 1 1 1\n",
                "line 3: expected no more pixels, found '0 1 1 1 1'",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(read_text(text).unwrap_err().to_string(), message);
        }
        for text in ["intensity 1 2\n0 0 1 1 1\n", "intensity 1 1\n0 0 1 1 0.5"] {
            let cut = read_text(text).unwrap_err();
            assert_eq!(cut.kind(), io::ErrorKind::UnexpectedEof);
        }
        let endless = format!("intensity 1 1\n0 0 1 1 1{}", " 1".repeat(2000));
        assert_eq!(
            read_text(&endless).unwrap_err().to_string(),
            "line 2 is too long"
        );
    }
}
