//! A tree as a drawing: the camera's ray on top, the transmitted ray to the left, the reflected one to the right.

use super::node::{FOLLOWERS, Light, Node, NotTraced};
use super::{Report, Trace, pair};
use octray_scenes::name;
use std::fmt::{self, Write};

/// Displays a report as an SVG file.
pub(super) struct Drawing<'a>(pub(super) &'a Report);

/// Sizes in pixels: a box, the gaps beside and below it, a light, the margin, and the lines above the tree.
const WIDTH: f64 = 176.0;
const TEXT: f64 = 69.0;
const GAP: f64 = 18.0;
const FALL: f64 = 46.0;
const LIGHT: f64 = 16.0;
const MARGIN: f64 = 16.0;
const HEAD: f64 = 62.0;

/// How far down rays go that are not traced, with their names.
const STUB: (f64, f64) = (20.0, 32.0);

/// Lights in a row of a box.
const ACROSS: usize = 9;

/// What both of two trees have in common, and what only one has.
const SAME: &str = "#4a5568";
const OTHER: &str = "#c1121f";

/// A box with its place: its middle and its upper edge.
struct Placed<'a> {
    pair: [Option<&'a Node>; 2],
    node: &'a Node,
    x: f64,
    y: f64,
    height: f64,
    followers: Vec<Placed<'a>>,
}

impl fmt::Display for Drawing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let report = self.0;
        let (mut body, mut left, mut bottom) = (String::new(), MARGIN, HEAD);
        for (i, trace) in report.traces.iter().enumerate() {
            let other = match report.traces.len() {
                2 => Some(&report.traces[1 - i]),
                _ => None,
            };
            let start = left;
            heading(&mut body, trace, start)?;
            for (place, ray) in trace.rays.iter().enumerate() {
                // A tree alone is compared with itself.
                let against = other.map_or(Some(ray), |other| other.rays.get(place));
                let placed = place_ray([Some(ray), against], &mut left, HEAD);
                if let Some(placed) = placed {
                    bottom = bottom.max(draw(&mut body, &placed)?);
                }
            }
            left = left.max(start + 2.0 * WIDTH) + 2.0 * GAP;
        }
        let (width, height) = (left - 2.0 * GAP + MARGIN, bottom + MARGIN);
        writeln!(
            f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">"
        )?;
        writeln!(
            f,
            "<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>"
        )?;
        let scene = escaped(&name::line(&report.scene));
        let (column, row) = report.pixel;
        let title = format!("{scene}, pixel {column},{row}");
        writeln!(f, "<title>{title}</title>")?;
        writeln!(
            f,
            "<text x=\"{MARGIN}\" y=\"22\" font-size=\"14\">{title}</text>"
        )?;
        write!(f, "{body}")?;
        writeln!(f, "</svg>")
    }
}

/// The format and the colour of the pixel, above a tree.
fn heading(out: &mut String, trace: &Trace, x: f64) -> fmt::Result {
    let name = trace.arith.with_format(Some(trace.format));
    let [r, g, b] = trace.level;
    writeln!(
        out,
        "<rect x=\"{x}\" y=\"32\" width=\"16\" height=\"16\" fill=\"rgb({r},{g},{b})\" stroke=\"{SAME}\"/>"
    )?;
    let none = match trace.rays.is_empty() {
        true => ", no ray: nothing but background is there",
        false => "",
    };
    let x = x + 22.0;
    writeln!(
        out,
        "<text x=\"{x}\" y=\"44\">{name}: {r} {g} {b}{none}</text>"
    )
}

/// Places a ray above those that follow from it; `left` is where there is room, `y` the upper edge. `None` if the first of
/// the pair is.
fn place_ray<'a>(pair: [Option<&'a Node>; 2], left: &mut f64, y: f64) -> Option<Placed<'a>> {
    let node = pair[0]?;
    let rows = node.lights.len().div_ceil(ACROSS);
    let height = TEXT + rows as f64 * (LIGHT + 2.0) + 4.0;
    let start = *left;
    let followers: Vec<_> = pair::followers(pair)
        .into_iter()
        .filter_map(|pair| place_ray(pair, left, y + height + FALL))
        .collect();
    let x = match (followers.first(), followers.last()) {
        (Some(first), Some(last)) => f64::midpoint(first.x, last.x),
        _ => start + WIDTH / 2.0,
    };
    *left = left.max(start + WIDTH + GAP);
    Some(Placed {
        pair,
        node,
        x,
        y,
        height,
        followers,
    })
}

/// Draws a ray and those that follow. Returns the lowest edge.
fn draw(out: &mut String, placed: &Placed<'_>) -> Result<f64, fmt::Error> {
    let Placed {
        pair,
        node,
        x,
        y,
        height,
        followers,
    } = placed;
    let mut lowest = y + height;
    for below in followers {
        let (x1, y1, x2, y2) = (x, y + height, below.x, below.y);
        let dash = match below.node.kind {
            "transmitted" => " stroke-dasharray=\"5 3\"",
            _ => "",
        };
        writeln!(
            out,
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" stroke=\"{SAME}\"{dash}/>"
        )?;
        lowest = lowest.max(draw(out, below)?);
    }
    for ray in &node.not_traced {
        draw_not_traced(out, ray, *x, y + height)?;
        lowest = lowest.max(y + height + STUB.1);
    }
    let colour = |differs| if differs { OTHER } else { SAME };
    let line = colour(pair::rays_differ(*pair));
    let (left, thick) = (x - WIDTH / 2.0, if line == OTHER { 3 } else { 1 });
    writeln!(
        out,
        "<rect x=\"{left}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{height}\" rx=\"4\" fill=\"#f7f9fc\" \
         stroke=\"{line}\" stroke-width=\"{thick}\"/>"
    )?;
    let [r, g, b] = (node.light).map(|light| (255.0 * light.clamp(0.0, 1.0) + 0.5) as u8);
    writeln!(
        out,
        "<rect x=\"{}\" y=\"{}\" width=\"10\" height=\"{}\" fill=\"rgb({r},{g},{b})\"/>",
        left + 4.0,
        y + 4.0,
        height - 8.0
    )?;
    let distance = node.distance.map(|distance| format!("at {distance:.2}"));
    let lines = [
        format!("{}, weight {:.3}", node.kind, node.weight),
        node.meets(),
        distance.unwrap_or_default(),
        format!("nodes {}, tests {}", node.cost.nodes, node.cost.tests),
    ];
    for (i, text) in lines.iter().enumerate() {
        let (x, y) = (left + 20.0, y + 16.0 + 15.0 * i as f64);
        let bold = if i == 1 { " font-weight=\"bold\"" } else { "" };
        writeln!(out, "<text x=\"{x}\" y=\"{y}\"{bold}>{text}</text>")?;
    }
    let pairs = pair::lights(*pair);
    for (i, light) in node.lights.iter().enumerate() {
        let number = light.light;
        let differs =
            (pairs.iter()).any(|(other, pair)| *other == number && pair::lights_differ(*pair));
        let (column, row) = (i % ACROSS, i / ACROSS);
        let x = left + 28.0 + column as f64 * LIGHT;
        let y = y + TEXT + 6.0 + row as f64 * (LIGHT + 2.0);
        draw_light(out, light, colour(differs), x, y)?;
    }
    Ok(lowest)
}

/// A ray that is not traced: a thin line that ends below the box, at the side where the ray would go; pointing at it tells
/// why.
fn draw_not_traced(out: &mut String, ray: &NotTraced, middle: f64, y: f64) -> fmt::Result {
    let aside = match ray.kind == FOLLOWERS[0] {
        true => -WIDTH / 4.0,
        false => WIDTH / 4.0,
    };
    let (kind, reason, x) = (ray.kind, ray.reason(), middle + aside);
    let (end, below) = (y + STUB.0, y + STUB.1 - 3.0);
    writeln!(
        out,
        "<g><title>{kind}: {reason}</title><line x1=\"{x}\" y1=\"{y}\" x2=\"{x}\" y2=\"{end}\" stroke=\"{SAME}\" \
         stroke-width=\"0.7\" stroke-dasharray=\"2 2\"/><text x=\"{x}\" y=\"{below}\" font-size=\"8\" \
         text-anchor=\"middle\" fill=\"{SAME}\">{kind}: not traced</text></g>"
    )
}

/// A light: yellow if it shines, dark if it is blocked; pointing at it tells by what.
fn draw_light(out: &mut String, light: &Light, line: &str, x: f64, y: f64) -> fmt::Result {
    let (fill, ink) = match light.blocked_by {
        None => ("#ffd60a", "#1d2733"),
        Some(_) => ("#3d4654", "#ffffff"),
    };
    let (number, state, below) = (light.light, light.state(), y + 3.0);
    writeln!(
        out,
        "<g><title>light {number}: {state}</title><circle cx=\"{x}\" cy=\"{y}\" r=\"7\" fill=\"{fill}\" \
         stroke=\"{line}\"/><text x=\"{x}\" y=\"{below}\" font-size=\"8\" text-anchor=\"middle\" \
         fill=\"{ink}\">{number}</text></g>"
    )
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;")
}
