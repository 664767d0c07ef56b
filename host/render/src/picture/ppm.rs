//! Portable pixmap, P6 with 255 levels.

use super::malformed::malformed;
use super::{Picture, netpbm};
use std::io::{self, BufRead, Write};

/// Write the levels.
pub(super) fn write(picture: &Picture, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "P6\n{} {}\n255\n", picture.width(), picture.height())?;
    out.write_all(picture.levels().as_flattened())
}

/// Read the first picture of the file.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Picture> {
    netpbm::word(input)?;
    let (width, height) = netpbm::size(input)?;
    let most: u32 = netpbm::number(input, "number of levels")?;
    if most != 255 {
        return Err(malformed(format!(
            "the pixmap has levels up to {most}; only 255 is read"
        )));
    }
    let mut levels = Vec::new();
    for _ in 0..u64::from(width) * u64::from(height) {
        let mut pixel = [0; 3];
        input.read_exact(&mut pixel)?;
        levels.push(pixel);
    }
    Picture::from_levels(width, height, levels).ok_or_else(|| malformed("the picture is cut short"))
}
