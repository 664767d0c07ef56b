//! A picture in at most 256 colours.

use super::Picture;
use crate::tile::Level;
use quantette::deps::palette::{Srgb, cast};
use quantette::{ImageRef, PaletteSize, Pipeline};
use std::collections::BTreeSet;
use std::io::{self, ErrorKind};

/// Colours, at most 256 of them, and for each pixel the colour it has.
pub(super) struct Indexed {
    /// The colours.
    pub(super) colours: Vec<Level>,
    /// One index into the colours for each pixel.
    pub(super) indices: Vec<u8>,
}

/// Give each pixel one of at most 256 colours: its own where the picture has no more than that, else the
/// nearest one of a palette by Wu's method, without dithering. The same picture always gives the same bytes.
///
/// # Errors
/// When the picture has more pixels than the quantiser takes (2³² − 1).
pub(super) fn reduce(picture: &Picture) -> io::Result<Indexed> {
    let levels = picture.levels();
    if let Some(exact) = exact(levels) {
        return Ok(exact);
    }
    let pixels = cast::from_array_slice::<Srgb<u8>>(levels);
    let image = ImageRef::new(picture.width(), picture.height(), pixels).map_err(|_| {
        io::Error::new(
            ErrorKind::InvalidInput,
            "too large for a map of 256 colours",
        )
    })?;
    let (colours, indices) = Pipeline::new()
        .palette_size(PaletteSize::MAX)
        .ditherer(None)
        .input_image(image)
        .output_srgb8_indexed_image()
        .into_parts();
    Ok(Indexed {
        colours: cast::into_array_vec(colours),
        indices,
    })
}

/// The picture's own colours in ascending order, if there are at most 256.
fn exact(levels: &[Level]) -> Option<Indexed> {
    let mut colours = BTreeSet::new();
    let mut last = None;
    for level in levels {
        if last != Some(level) {
            colours.insert(*level);
            last = Some(level);
        }
        if colours.len() > 256 {
            return None;
        }
    }
    let colours: Vec<_> = colours.into_iter().collect();
    let index = |level| colours.binary_search(level).ok().map(|index| index as u8);
    let indices = levels.iter().map(index).collect::<Option<_>>()?;
    Some(Indexed { colours, indices })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(levels: &[Level]) -> Picture {
        Picture::from_levels(levels.len() as u32, 1, levels.to_vec()).unwrap()
    }

    fn show(indexed: &Indexed) -> Vec<Level> {
        let colour = |index: &u8| indexed.colours[usize::from(*index)];
        indexed.indices.iter().map(colour).collect()
    }

    #[test]
    fn up_to_256_colours_are_kept_exactly() {
        let levels: Vec<Level> = (0..1000_u32)
            .map(|i| [(i % 256) as u8, (i * 31 % 256) as u8, 7])
            .collect();
        let indexed = reduce(&picture(&levels)).unwrap();
        assert_eq!(indexed.colours.len(), 256);
        assert_eq!(show(&indexed), levels);
    }

    #[test]
    fn more_colours_come_close_and_always_the_same_way() {
        let levels: Vec<Level> = (0..64 * 64_u32)
            .map(|i| [(i % 64) as u8 * 4, (i / 64) as u8 * 4, 128])
            .collect();
        let first = reduce(&picture(&levels)).unwrap();
        let again = reduce(&picture(&levels)).unwrap();
        assert_eq!(
            (&first.colours, &first.indices),
            (&again.colours, &again.indices)
        );
        assert!(first.colours.len() <= 256);
        // 4096 colours on a square of side 252. The best RGB palette, 16 × 16 cells, is 3.7 levels off in
        // the mean; the perceptual one gives the eye's favourites more. One colour for all is 59 off.
        let shown = show(&first);
        let pairs = shown.as_flattened().iter().zip(levels.as_flattened());
        let squares = pairs.map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2));
        let rmse = (squares.sum::<f64>() / 4096.0 / 3.0).sqrt();
        assert!(rmse < 8.0, "{rmse}");
    }
}
