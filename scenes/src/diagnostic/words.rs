//! The texts of error messages: a title, and a label for the place.

use super::{MOST, MistakeKind, WarningKind};
use crate::check::Fault;
use crate::word::Keyword;

const KEYWORDS: &str =
    "expected one of `v at up angle view resolution b l f s c box p pp`, in lower case";

/// Returns title and label of `kind`; `found` is the text at its place, escaped for printing.
pub(super) fn describe(kind: &MistakeKind, found: &str) -> (String, String) {
    let owned = |title: &str, label: &str| (title.to_owned(), label.to_owned());
    match kind {
        // Such a space looks like one, and joins what it parts.
        MistakeKind::UnknownKeyword | MistakeKind::NotANumber | MistakeKind::StrayNumber
            if let Some(space) = foreign_space(found) =>
        {
            let name = match space {
                '\u{a0}' => "a no-break space",
                _ => "a space",
            };
            let code = u32::from(space);
            (
                format!("`{found}` holds {name} (U+{code:04X})"),
                "expected blanks, tabs or line ends between words".to_owned(),
            )
        }
        MistakeKind::Empty => owned(
            "the file holds no scene",
            "expected at least a viewpoint: `v x y z`",
        ),
        MistakeKind::Binary => (
            "not a text file".to_owned(),
            format!("found control characters in `{found}`, expected a scene file"),
        ),
        MistakeKind::UnknownKeyword => (format!("unknown keyword `{found}`"), KEYWORDS.to_owned()),
        MistakeKind::StrayNumber => (
            format!("`{found}` where a keyword must be"),
            KEYWORDS.to_owned(),
        ),
        MistakeKind::NotANumber => (
            format!("`{found}` is not a number"),
            match found.contains('#') {
                true => "expected a number, and white space before a comment".to_owned(),
                false => "expected a number or a keyword".to_owned(),
            },
        ),
        MistakeKind::NotFinite => (
            format!("`{found}` is not finite"),
            "expected a number of at most 1.797e308 in size".to_owned(),
        ),
        MistakeKind::MixedDialects { keyword } => match keyword {
            Keyword::Resolution => owned(
                "`resolution` outside the `v` of an NFF file",
                "expected it after `hither` of `v from ...`, width first: here it may mean either order",
            ),
            _ => owned(
                "`f` of the thesis in an NFF file",
                "expected 8 numbers (r g b Kd Ks shine T ior), as `v` has no numbers of its own: a file has one dialect",
            ),
        },
        MistakeKind::Texture => (
            format!("`{found}` belongs to textures"),
            "expected no textures: octray draws none; remove them and what belongs to them"
                .to_owned(),
        ),
        MistakeKind::Sense8 => owned(
            "this is Sense8's Neutral File Format, not Haines's",
            "expected a viewpoint: only the name NFF is the same; convert the file",
        ),
        MistakeKind::Count { keyword, found, .. } => (
            format!("`{}` with {}", keyword.text(), numbers(*found)),
            format!("expected {}", keyword.wants()),
        ),
        MistakeKind::VertexCount {
            keyword,
            vertices,
            found,
        } => {
            let (each, what) = match keyword {
                Keyword::Patch => (6, "x y z and normal x y z"),
                _ => (3, "x y z"),
            };
            let wanted = u64::from(*vertices) * each;
            (
                format!(
                    "`{} {vertices}` with {} after it",
                    keyword.text(),
                    numbers(*found)
                ),
                format!("expected {wanted}: {what} of {vertices} vertices"),
            )
        }
        MistakeKind::NotACount => (
            format!("`{found}` is not a number of vertices"),
            format!("expected a whole number from 3 to {}", u32::MAX),
        ),
        MistakeKind::View => (
            "unknown view".to_owned(),
            format!("expected {}, found `{found}`", Keyword::View.wants()),
        ),
        MistakeKind::NoSurface => owned(
            "object before the first surface",
            "expected an `f` with the surface of this object before it",
        ),
        MistakeKind::LooseChecker => owned(
            "`checker` that does not follow a surface",
            "expected the `f` that it belongs to right before it",
        ),
        MistakeKind::Duplicate { keyword, .. } => (
            format!("a second `{}`", keyword.text()),
            "expected only one in a file".to_owned(),
        ),
        MistakeKind::NoViewpoint => owned(
            "no viewpoint",
            "the file ends here; expected `v x y z` somewhere in it",
        ),
        MistakeKind::Incomplete { missing } => {
            let missing: Vec<_> = missing
                .iter()
                .map(|keyword| format!("`{}`", keyword.text()))
                .collect();
            (
                format!("camera without {}", missing.join(" and ")),
                "expected `at`, `up` and `angle` together, and `from` if this `v` has no position"
                    .to_owned(),
            )
        }
        MistakeKind::TwoEyes => owned(
            "`from` beside a `v` that has a position",
            "expected the position either after `v` or after `from`",
        ),
        MistakeKind::Fault(fault) => {
            let expected = expected(fault);
            let label = match tells_found(fault) {
                true => expected,
                false => format!("{expected}, found `{found}`"),
            };
            (fault.to_string(), label)
        }
    }
}

/// Returns title and label of a warning.
pub(crate) fn warn(kind: &WarningKind) -> (String, String) {
    match kind {
        WarningKind::NoArea { keyword } => {
            let what = match keyword {
                Keyword::Patch => "patch",
                _ => "polygon",
            };
            (
                format!("{what} without area"),
                "left out: its vertices lie on one line".to_owned(),
            )
        }
        WarningKind::RepeatedVertex { first } => (
            "vertex repeated".to_owned(),
            match first {
                true => {
                    "same as the last vertex, which needs no repeating: the polygon closes itself"
                }
                false => "same as the vertex before it",
            }
            .to_owned(),
        ),
        WarningKind::Uneven { distance } => (
            "polygon that is not quite planar".to_owned(),
            format!(
                "{} off the plane of the other vertices; the polygon is drawn flat",
                rounded(*distance)
            ),
        ),
    }
}

/// Says what was expected instead of `fault`.
pub(crate) fn expected(fault: &Fault) -> String {
    let wanted = match fault {
        Fault::NotFinite => "values whose products are finite",
        Fault::ZeroRadius => "a radius other than 0",
        Fault::NegativeRadius => "a radius above 0",
        Fault::ZeroRadii => "at least one radius other than 0",
        Fault::BaseIsTop => "a top at another place than the base",
        Fault::FlatBox { .. } => "a length above 0 for every side",
        Fault::TooFewVertices => "at least 3 vertices",
        Fault::VertexRange => "vertices that are in the scene",
        Fault::TooLarge => return format!("expected at most {} in a scene", u32::MAX),
        Fault::Collinear => "vertices that span a plane",
        Fault::NotPlanar {
            distance,
            tolerance,
            ..
        } => {
            return format!(
                "{} off the plane of the other vertices, expected no more than {}: split it into triangles",
                rounded(*distance),
                rounded(*tolerance)
            );
        }
        Fault::ZeroNormal { .. } => "a normal of any other length",
        Fault::Negative => "at least 0",
        Fault::RefractionIndex => "above 0, as the surface lets light through",
        Fault::ViewpointInPlane => "a z other than 0: the picture plane is z = 0",
        Fault::FromIsAt => return "same as the viewpoint; expected another place".to_owned(),
        Fault::CheckerSize => "a size above 0",
        Fault::ZeroUp => "a direction of any other length",
        Fault::UpParallel => "a direction that differs from the view",
        Fault::Angle => "above 0 and below 180",
        Fault::Resolution => "a whole number from 1 to 65535",
        Fault::SurfaceIndex => "the index of a surface",
    };
    format!("expected {wanted}")
}

/// Whether [`expected`] also says what is there instead.
fn tells_found(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::TooLarge | Fault::Collinear | Fault::NotPlanar { .. } | Fault::FromIsAt
    )
}

/// The line after as many mistakes as are kept.
pub(crate) fn only_the_first() -> String {
    format!("and more: only the first {MOST} mistakes are shown")
}

/// The line after as many warnings as are kept.
pub(crate) fn more_warnings(more: usize) -> String {
    let plural = if more == 1 { "" } else { "s" };
    format!("{more} more warning{plural}")
}

/// The first character that looks like a space and separates no words.
fn foreign_space(text: &str) -> Option<char> {
    (text.chars()).find(|c| c.is_whitespace() && !c.is_ascii())
}

fn numbers(count: usize) -> String {
    match count {
        0 => "no number".to_owned(),
        1 => "1 number".to_owned(),
        _ => format!("{count} numbers"),
    }
}

/// Rounds to three significant digits, in the shorter of plain and scientific notation.
fn rounded(number: f64) -> String {
    let digits = format!("{number:.2e}");
    match digits.parse::<f64>() {
        Ok(number) if (1e-3..1e6).contains(&number) => number.to_string(),
        _ => digits,
    }
}
