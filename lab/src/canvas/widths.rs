//! Texts of an SVG, as wide as they were measured.
//!
//! What shows an SVG has other fonts than the one that figures are laid out in, and wider letters would run
//! into what stands beside them. So each text carries its width, and letters are squeezed into it.

use plotters::style::{FontDesc, FontFamily, FontStyle};
use std::fmt::Write;

/// How many times the size of letters the height of their line is.
const LINE: f64 = 1.24;

/// The SVG with the width of each text that has several letters.
pub(super) fn held(svg: &str) -> String {
    let mut parts = svg.split("<text ");
    let mut held = String::from(parts.next().unwrap_or_default());
    for part in parts {
        held.push_str("<text ");
        if let Some(width) = width(part) {
            let _ = write!(
                held,
                "textLength=\"{width}\" lengthAdjust=\"spacingAndGlyphs\" "
            );
        }
        held.push_str(part);
    }
    held
}

/// The width of a text in pixels, from its attributes and what stands between its tags.
fn width(part: &str) -> Option<u32> {
    let (attributes, rest) = part.split_once('>')?;
    let (_, size) = attributes.split_once("font-size=\"")?;
    let size: f64 = size.split_once('"')?.0.parse().ok()?;
    let text = unescaped(rest.split_once("</text>")?.0.trim());
    let font = FontDesc::new(FontFamily::SansSerif, size * LINE, FontStyle::Normal);
    let (width, _) = font.box_size(&text).ok()?;
    (text.chars().count() > 1 && width > 0).then_some(width)
}

/// What was written for a reader of XML, as it is read.
fn unescaped(text: &str) -> String {
    [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&apos;", "'"),
        ("&amp;", "&"),
    ]
    .into_iter()
    .fold(text.into(), |text: String, (written, read)| {
        text.replace(written, read)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_told_their_widths_and_nothing_else_changes() {
        super::super::register();
        let text =
            |size, text| format!("<text x=\"1\" font-size=\"{size}\">\n{text}\n</text>\n<rect/>");
        let svg = format!(
            "<svg>{}{}{}</svg>",
            text(10, "wider"),
            text(20, "wider"),
            text(9, "1")
        );
        let held = held(&svg);
        let widths: Vec<u32> = (held.split("textLength=\"").skip(1))
            .map(|part| part.split_once('"').unwrap().0.parse().unwrap())
            .collect();
        assert_eq!(widths.len(), 2, "{held}");
        assert!(widths[0].abs_diff(widths[1] / 2) <= 1, "{widths:?}");
        let without = widths.iter().fold(held, |held, width| {
            held.replace(
                &format!("textLength=\"{width}\" lengthAdjust=\"spacingAndGlyphs\" "),
                "",
            )
        });
        assert_eq!(without, svg);
    }

    #[test]
    fn what_was_escaped_is_measured_as_it_is_read() {
        assert_eq!(
            unescaped("a &lt; b &amp;lt; &quot;c&quot;"),
            "a < b &lt; \"c\""
        );
    }
}
