//! The values of a call by name, and which of them a fault is about.

use crate::check::Fault;
use crate::model::{Camera, Colour, Point, Surface};
use crate::write::Number;
use std::fmt;

/// One value of a call.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value {
    name: &'static str,
    /// Which of several of this name, from 0.
    index: Option<usize>,
    numbers: [f64; 3],
    /// How many of the numbers there are: 1 or 3.
    count: usize,
    /// Whether it may be below 0.
    signed: bool,
}

impl Value {
    /// A point or a direction.
    pub(super) fn point(name: &'static str, point: Point) -> Self {
        Self {
            name,
            index: None,
            numbers: point,
            count: 3,
            signed: true,
        }
    }

    /// Three numbers that are not below 0.
    pub(super) fn colour(name: &'static str, colour: Colour) -> Self {
        Self {
            signed: false,
            ..Self::point(name, colour)
        }
    }

    /// A number that is not below 0.
    pub(super) fn number(name: &'static str, number: f64) -> Self {
        Self {
            count: 1,
            ..Self::colour(name, [number; 3])
        }
    }

    fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        if let Some(index) = self.index {
            write!(f, " {}", index + 1)?;
        }
        match *self.numbers() {
            [x, y, z] => write!(f, " [{}, {}, {}]", Number(x), Number(y), Number(z)),
            _ => write!(f, " {}", Number(self.numbers[0])),
        }
    }
}

/// Returns the value that `fault` is about.
pub(super) fn blamed<'v>(fault: &Fault, values: &'v [Value]) -> Option<&'v Value> {
    let named = |end: &str| values.iter().rev().find(|value| value.name.ends_with(end));
    let with = |wrong: fn(&Value, f64) -> bool| {
        let is_wrong = |value: &&Value| value.numbers().iter().any(|n| wrong(value, *n));
        values.iter().find(is_wrong)
    };
    match fault {
        Fault::NotFinite => with(|_, number| !number.is_finite()),
        Fault::Negative | Fault::NegativeRadius => {
            with(|value, number| !value.signed && number < 0.0)
        }
        Fault::ZeroRadius | Fault::ZeroRadii => named("radius"),
        Fault::BaseIsTop => named("top"),
        Fault::FlatBox { .. } => named("size"),
        Fault::CheckerSize => named("checker size"),
        Fault::RefractionIndex => named("ior"),
        Fault::ViewpointInPlane => named("viewpoint"),
        Fault::FromIsAt => named("at"),
        Fault::ZeroUp | Fault::UpParallel => named("up"),
        // Of a call with one value, it is that.
        _ => values.last(),
    }
}

/// Returns the vertex or normal that a fault of a polygon or a patch is about, if it is about one.
pub(super) fn of_corners(
    corners: impl ExactSizeIterator<Item = (Point, Option<Point>)> + Clone,
    fault: &Fault,
) -> Option<Value> {
    let at = |name, index, point| Value {
        index: Some(index),
        ..Value::point(name, point)
    };
    let vertex = |index| {
        let (vertex, _) = corners.clone().nth(index)?;
        Some(at("vertex", index, vertex))
    };
    let normal = |index| {
        let (_, normal) = corners.clone().nth(index)?;
        Some(at("normal", index, normal?))
    };
    let mut indices = 0..corners.len();
    match *fault {
        Fault::TooFewVertices => Some(Value::number("number of vertices", corners.len() as f64)),
        Fault::NotPlanar { vertex: index, .. } => vertex(index),
        Fault::ZeroNormal { vertex: index } => normal(index),
        Fault::NotFinite => indices.find_map(|index| {
            let is_wrong = |value: &Value| value.numbers().iter().any(|n| !n.is_finite());
            vertex(index)
                .filter(is_wrong)
                .or_else(|| normal(index).filter(is_wrong))
        }),
        _ => None,
    }
}

/// Returns the values of a camera.
pub(super) fn of_camera(camera: &Camera) -> Vec<Value> {
    match *camera {
        Camera::Thesis { viewpoint, .. } => vec![Value::point("viewpoint", viewpoint)],
        Camera::Nff {
            from,
            at,
            up,
            angle,
            ..
        } => vec![
            Value::point("from", from),
            Value::point("at", at),
            Value::point("up", up),
            Value::number("angle", angle),
        ],
    }
}

/// Returns the values of a surface.
pub(super) fn of_surface(surface: &Surface) -> Vec<Value> {
    let Surface {
        ambient,
        diffuse,
        specular,
        shine,
        reflect,
        refract,
        ior,
        checker,
    } = *surface;
    let mut values = vec![
        Value::colour("ambient", ambient),
        Value::colour("diffuse", diffuse),
        Value::colour("specular", specular),
        Value::number("shine", shine),
        Value::number("reflect", reflect),
        Value::number("refract", refract),
        Value::number("ior", ior),
    ];
    if let Some(checker) = checker {
        values.extend([
            Value::colour("checker ambient", checker.ambient),
            Value::colour("checker diffuse", checker.diffuse),
            Value::number("checker size", checker.size),
        ]);
    }
    values
}

/// Returns what tells surfaces apart.
pub(super) fn bits(surface: &Surface) -> [u64; 21] {
    let values = of_surface(surface);
    let numbers = values.iter().flat_map(Value::numbers).map(|n| n.to_bits());
    let mut bits = [0; 21];
    bits[20] = u64::from(surface.checker.is_some());
    bits.iter_mut()
        .zip(numbers)
        .for_each(|(bit, number)| *bit = number);
    bits
}
