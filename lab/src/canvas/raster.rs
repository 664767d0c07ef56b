//! Charts in pixels: their SVG, drawn by resvg with the only font there is.

use super::FONT;
use octray_render::error::Error;
use octray_render::picture::Picture;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{self, Options, Tree};
use std::sync::{Arc, LazyLock};

/// Nothing but the font that figures are laid out in.
static OPTIONS: LazyLock<Options<'static>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_source(Source::Binary(Arc::new(FONT)));
    let family = (fonts.faces().next()).map(|face| face.families[0].0.clone());
    fonts.set_sans_serif_family(family.unwrap_or_default());
    Options {
        fontdb: Arc::new(fonts),
        ..Options::default()
    }
});

/// The picture of an SVG that has no transparent pixel.
pub(super) fn picture(svg: &str) -> Result<Picture, Error> {
    let failed = |why| Error::Failed(format!("cannot draw a chart: {why}"));
    let tree = Tree::from_str(&crisp(svg), &OPTIONS)
        .map_err(|cause: usvg::Error| failed(cause.to_string()))?;
    let size = tree.size().to_int_size();
    let (width, height) = (size.width(), size.height());
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| failed("it is too large".into()))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    let levels = pixels
        .pixels()
        .iter()
        .map(|p| [p.red(), p.green(), p.blue()]);
    Picture::from_levels(width, height, levels.collect())
        .ok_or_else(|| failed("it has lost pixels".into()))
}

/// The SVG with every rectangle and every line along a row or a column on whole pixels, as places are whole numbers.
fn crisp(svg: &str) -> String {
    let mut parts = svg.split('<');
    let mut crisp = String::from(parts.next().unwrap_or_default());
    for part in parts {
        crisp.push('<');
        match part.split_once(' ') {
            Some((name, rest)) if is_straight(name, rest) => {
                crisp.extend([name, " shape-rendering=\"crispEdges\" ", rest]);
            }
            _ => crisp.push_str(part),
        }
    }
    crisp
}

/// Whether an element is a rectangle or such a line.
fn is_straight(name: &str, attributes: &str) -> bool {
    let points = attributes
        .split_once("points=\"")
        .map_or("", |(_, points)| points);
    let points = points.split('"').next().unwrap_or_default();
    let points: Vec<_> = (points.split_whitespace())
        .filter_map(|point| point.split_once(','))
        .collect();
    let along = |pair: &[(&str, &str)]| pair[0].0 == pair[1].0 || pair[0].1 == pair[1].1;
    name == "rect" || (name == "polyline" && points.windows(2).all(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn white(inside: &str) -> Picture {
        let svg = format!(
            "<svg width=\"80\" height=\"30\" xmlns=\"http://www.w3.org/2000/svg\">\
             <rect x=\"0\" y=\"0\" width=\"80\" height=\"30\" fill=\"#FFFFFF\"/>{inside}</svg>"
        );
        picture(&svg).unwrap()
    }

    /// For each column whether anything is drawn there.
    fn columns(picture: &Picture) -> Vec<bool> {
        let inked = |x: usize| picture.rows().any(|row| row[x][0] < 128);
        (0..80).map(inked).collect()
    }

    #[test]
    fn a_line_along_a_column_is_one_pixel_wide() {
        let line = "<polyline fill=\"none\" stroke=\"#000000\" stroke-width=\"1\" points=\"20,5 20,25 \"/>";
        let picture = white(line);
        let inked = picture.rows().flatten().filter(|level| **level != [255; 3]);
        assert!(inked.clone().all(|level| *level == [0; 3]));
        assert_eq!(inked.count(), 20);
    }

    #[test]
    fn letters_of_a_word_stand_close() {
        let text = "<text x=\"5\" y=\"5\" dy=\"0.76em\" font-family=\"sans-serif\" font-size=\"13\">epsilon</text>";
        let columns = columns(&white(text));
        let first = columns.iter().position(|inked| *inked).unwrap();
        let last = columns.iter().rposition(|inked| *inked).unwrap();
        assert!((35..55).contains(&(last - first)), "{first} to {last}");
        let gaps = columns[first..=last].split(|inked| *inked).map(<[_]>::len);
        assert!(gaps.max().unwrap() <= 2);
    }
}
