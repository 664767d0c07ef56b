//! The words of scene files, and places in them.

/// A range of bytes of the source; always on character boundaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// The words of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keyword {
    /// `v`
    Viewpoint,
    /// `from`
    From,
    /// `at`
    At,
    /// `up`
    Up,
    /// `angle`
    Angle,
    /// `hither`
    Hither,
    /// `resolution`
    Resolution,
    /// `view`
    View,
    /// `b`
    Background,
    /// `l`
    Light,
    /// `f`
    Surface,
    /// `s`
    Sphere,
    /// `c`
    Cone,
    /// `box`
    Cuboid,
    /// `p`
    Polygon,
    /// `pp`
    Patch,
}

/// Words of extensions of NFF that describe textures.
const OF_TEXTURES: [&str; 8] = ["tess", "tex", "texture", "map", "tt", "tp", "tpp", "uv"];

/// The ends of names of pictures.
const OF_PICTURES: [&str; 17] = [
    ".bmp", ".exr", ".gif", ".hdr", ".jpeg", ".jpg", ".pcx", ".pic", ".png", ".ppm", ".ras",
    ".rgb", ".sgi", ".tga", ".tif", ".tiff", ".txr",
];

/// Returns whether a word that is no keyword belongs to a texture: it describes one, or names a picture.
pub(crate) fn belongs_to_textures(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    OF_TEXTURES.contains(&&*text) || OF_PICTURES.iter().any(|end| text.ends_with(end))
}

impl Keyword {
    /// Returns the keyword as it is written.
    pub fn text(self) -> &'static str {
        match self {
            Self::Viewpoint => "v",
            Self::From => "from",
            Self::At => "at",
            Self::Up => "up",
            Self::Angle => "angle",
            Self::Hither => "hither",
            Self::Resolution => "resolution",
            Self::View => "view",
            Self::Background => "b",
            Self::Light => "l",
            Self::Surface => "f",
            Self::Sphere => "s",
            Self::Cone => "c",
            Self::Cuboid => "box",
            Self::Polygon => "p",
            Self::Patch => "pp",
        }
    }

    /// Describes what must follow the keyword.
    pub fn wants(self) -> &'static str {
        match self {
            Self::Viewpoint => "3 numbers (x y z), or none, then `from`, `at`, `up` and `angle`",
            Self::From | Self::At | Self::Up => "3 numbers: x y z",
            Self::Angle => "1 number: degrees",
            Self::Hither => "1 number",
            Self::Resolution => {
                "2 numbers: height then width, or width then height inside the `v` of NFF"
            }
            Self::View => "`parallel` or `perspective`",
            Self::Background => "3 numbers: red green blue",
            Self::Light => "3 numbers (x y z), 4 (x y z brightness) or 6 (x y z red green blue)",
            Self::Surface => {
                "8 numbers (r g b Kd Ks shine T ior), or 12 or 13 \
                 (ar ag ab dr dg db sr sg sb shine reflect refract [ior])"
            }
            Self::Sphere => "4 numbers: x y z radius",
            Self::Cone => "8 numbers: base x y z radius, top x y z radius",
            Self::Cuboid => "6 numbers: centre x y z, side lengths x y z",
            Self::Polygon => "the number of vertices, then x y z of each",
            Self::Patch => "the number of vertices, then x y z and normal x y z of each",
        }
    }

    pub(crate) fn of(text: &str) -> Option<Self> {
        Some(match text {
            "v" => Self::Viewpoint,
            "from" => Self::From,
            "at" => Self::At,
            "up" => Self::Up,
            "angle" => Self::Angle,
            "hither" => Self::Hither,
            "resolution" => Self::Resolution,
            "view" => Self::View,
            "b" => Self::Background,
            "l" => Self::Light,
            "f" => Self::Surface,
            "s" => Self::Sphere,
            "c" => Self::Cone,
            "box" => Self::Cuboid,
            "p" => Self::Polygon,
            "pp" => Self::Patch,
            _ => return None,
        })
    }
}
