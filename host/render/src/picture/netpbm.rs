//! The header that portable pixmaps and portable float maps share: words between white space.

use super::malformed::malformed;
use std::io::{self, BufRead};
use std::str::FromStr;

/// More than any number of a header needs.
const LONGEST_WORD: usize = 64;

/// More white space and comments than any header has before a word.
const LONGEST_GAP: usize = 1 << 16;

/// Pictures of more pixels are not read.
const MOST_PIXELS: u64 = 1 << 32;

/// Read the next word: skip white space and `#` comments, and consume the one white space after it.
pub(super) fn word(input: &mut dyn BufRead) -> io::Result<String> {
    let mut word = String::new();
    let mut comment = false;
    for _ in 0..LONGEST_GAP {
        match byte(input)? {
            b'\n' if comment => comment = false,
            _ if comment => {}
            b'#' if word.is_empty() => comment = true,
            space if space.is_ascii_whitespace() => {
                if !word.is_empty() {
                    return Ok(word);
                }
            }
            _ if word.len() == LONGEST_WORD => return Err(malformed("the header is no header")),
            other => word.push(char::from(other)),
        }
    }
    Err(malformed("the header does not end"))
}

/// Read the next word as a number called `name` in errors.
pub(super) fn number<T: FromStr>(input: &mut dyn BufRead, name: &str) -> io::Result<T> {
    let word = word(input)?;
    word.parse().map_err(|_| {
        malformed(format!(
            "the {name} in the header is '{}'",
            word.escape_debug()
        ))
    })
}

/// Read width and height, both at least 1.
pub(super) fn size(input: &mut dyn BufRead) -> io::Result<(u32, u32)> {
    let size = (number(input, "width")?, number(input, "height")?);
    match size {
        (0, _) | (_, 0) => Err(malformed("the picture has no pixels")),
        (width, height) if u64::from(width) * u64::from(height) > MOST_PIXELS => Err(malformed(
            format!("{width} x {height} pixels are more than {MOST_PIXELS}"),
        )),
        _ => Ok(size),
    }
}

fn byte(input: &mut dyn BufRead) -> io::Result<u8> {
    let mut byte = [0];
    input.read_exact(&mut byte)?;
    Ok(byte[0])
}
