//! The inputs of kernels: the same on every board, and in every arithmetic as nearly the same as its numbers allow.

use crate::baked::{S, SCENE};
use octray_core::object::ObjectRef;
use octray_core::ray::Ray;
use octray_core::scalar::{Ratio, Scalar};
use octray_core::vec3::{Vec3, vec3};

/// The number of numbers.
const COUNT: u32 = 64;
/// The rays to an object form a grid of this many columns and rows.
const ACROSS: i32 = 8;

/// The width of the rays to an object, in eighths of the object's box.
pub(super) type Fan = i32;
/// So wide that some rays miss.
pub(super) const WIDE: Fan = 10;
/// So narrow that all rays hit a sphere, where light from near their origin falls on it.
pub(super) const NARROW: Fan = 3;

/// Returns the `i`th number, from ¼ to 1 in multiples of 2⁻¹⁰: no format overflows.
fn number(i: u32) -> S {
    let bits = i.wrapping_add(1).wrapping_mul(0x9e37_79b9) >> 16;
    S::ratio(256 + (bits % 769) as i32, S::whole_reciprocal(1024))
}

/// Returns the same with a sign.
fn signed(i: u32) -> S {
    let number = number(i);
    if i.wrapping_mul(0x85eb_ca6b) >> 31 == 0 {
        number
    } else {
        -number
    }
}

/// Returns positive numbers.
pub(super) fn numbers() -> impl Iterator<Item = S> {
    (0..COUNT).map(number)
}

/// Returns pairs of numbers of either sign.
pub(super) fn pairs() -> impl Iterator<Item = (S, S)> {
    (0..COUNT).map(|i| (signed(2 * i), signed(2 * i + 1)))
}

/// Returns pairs of vectors.
pub(super) fn vectors() -> impl Iterator<Item = (Vec3<S>, Vec3<S>)> {
    let vector = |i| vec3(signed(3 * i), signed(3 * i + 1), signed(3 * i + 2));
    (0..COUNT).map(move |i| (vector(2 * i), vector(2 * i + 1)))
}

/// Returns rays from the first light to a grid over an object's box, across x and y.
pub(super) fn aimed(object: ObjectRef, fan: Fan) -> impl Iterator<Item = Ray<S>> {
    let origin = SCENE
        .lights
        .first()
        .map_or(Vec3::ZERO, |light| light.position);
    let bounds = SCENE.shapes.bounds(object);
    let half = S::ratio(1, S::whole_reciprocal(2));
    let reach = (bounds.high - bounds.low) * half;
    let centre = bounds.low + reach;
    (0..ACROSS * ACROSS).map(move |i| {
        let part = |k: i32| {
            S::ratio(
                fan * (2 * k + 1 - ACROSS),
                S::whole_reciprocal(8 * ACROSS as u32),
            )
        };
        let (x, y) = (part(i % ACROSS), part(i / ACROSS));
        let target = centre + vec3(reach.x * x, reach.y * y, S::ZERO);
        Ray::new(origin, (target - origin).unit().0)
    })
}
