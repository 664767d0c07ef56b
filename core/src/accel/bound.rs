//! The numbers that boxes are held in, apart from the scene's own arithmetic.

use crate::array::map3;
use crate::scalar::{whole_f32, whole_f64};
use core::fmt::Debug;

/// A number for coordinates of boxes and distances along a ray: `f32`, `f64`, or the bits of a
/// fixed-point format as `i32` or `i64`.
pub trait BoundScalar: Copy + Debug + Default + PartialOrd + Send + Sync + 'static {
    /// 0.
    const ZERO: Self;
    /// Beyond every box and every distance.
    const MAX: Self;
    /// Before every box.
    const MIN: Self;

    /// What a distance along an axis is multiplied with to give the distance along the ray.
    type Inverse: Copy + Debug;

    /// The distance at which a ray from `origin` meets the plane; monotone in the plane.
    fn distance(self, origin: Self, inverse: Self::Inverse) -> Self;

    /// Rounds a box's low face down, so far that no point above `self` is left out for rounding.
    fn round_down(self) -> Self;

    /// Rounds a box's high face up, so far that no point below `self` is left out for rounding.
    fn round_up(self) -> Self;

    /// The middle of two coordinates.
    fn midpoint(self, other: Self) -> Self;

    /// The smaller of two.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// A surface area, or a cost.
    type Area: Copy + PartialOrd;

    /// No area.
    const NO_AREA: Self::Area;

    /// The area of half the surface of a box with these sides, all ≥ 0.
    fn half_area(sides: [Self; 3]) -> Self::Area;

    /// The volume of a box with these sides, all ≥ 0, up to a factor.
    fn volume(sides: [Self; 3]) -> Self::Area;

    /// The sum of two areas.
    fn add_areas(a: Self::Area, b: Self::Area) -> Self::Area;

    /// An area times a count.
    fn scale_area(area: Self::Area, count: u32) -> Self::Area;

    /// `self` − `other` for `self` ≥ `other`.
    fn difference(self, other: Self) -> Self;

    /// Which of `bins` equal parts of `low` … `high` holds `self`.
    fn bin_index(self, low: Self, high: Self, bins: u32) -> u32;

    /// A coordinate or a length on the grid: an integer, with [`BoundScalar::GRID_SLACK`] at most
    /// between what a ray's computed point rounds to and where the ray truly is. Coordinates of a
    /// scene, and their differences, stay below 2³¹.
    fn to_grid(self) -> i32;

    /// See [`BoundScalar::to_grid`].
    const GRID_SLACK: i32;

    /// `self` less twice [`BoundScalar::GRID_SLACK`].
    fn lowered(self) -> Self;

    /// `self` and twice [`BoundScalar::GRID_SLACK`].
    fn raised(self) -> Self;
}

macro_rules! float_bound {
    ($t:ident, unit: $unit:expr, least: $least:expr, whole: $whole:ident) => {
        impl BoundScalar for $t {
            const ZERO: Self = 0.0;
            const MAX: Self = $t::MAX;
            const MIN: Self = $t::MIN;

            type Inverse = Self;

            #[inline(always)]
            fn distance(self, origin: Self, inverse: Self) -> Self {
                (self - origin) * inverse
            }

            #[cfg_attr(not(target_os = "none"), inline(always))]
            fn round_down(self) -> Self {
                self - (self.abs() * (2.0 * $unit) + $least)
            }

            #[cfg_attr(not(target_os = "none"), inline(always))]
            fn round_up(self) -> Self {
                self + (self.abs() * (2.0 * $unit) + $least)
            }

            fn midpoint(self, other: Self) -> Self {
                self * 0.5 + other * 0.5
            }

            type Area = Self;

            const NO_AREA: Self = 0.0;

            fn half_area([x, y, z]: [Self; 3]) -> Self {
                x * y + y * z + z * x
            }

            fn volume([x, y, z]: [Self; 3]) -> Self {
                x * y * z
            }

            fn add_areas(a: Self, b: Self) -> Self {
                a + b
            }

            fn scale_area(area: Self, count: u32) -> Self {
                area * count as Self
            }

            fn difference(self, other: Self) -> Self {
                self - other
            }

            fn bin_index(self, low: Self, high: Self, bins: u32) -> u32 {
                let position = (self - low) / (high - low) * bins as Self;
                (position as u32).min(bins - 1)
            }

            // Scenes are scaled to a diagonal of 1 to 2. Coordinates of up to 2 have steps of 2⁻²² of
            // a unit in `f32`, 2⁷ on the grid; points are off by a few.
            #[inline(always)]
            fn to_grid(self) -> i32 {
                $whole::<29>(self)
            }

            const GRID_SLACK: i32 = 1 << 10;

            fn lowered(self) -> Self {
                self - MARGIN as $t
            }

            fn raised(self) -> Self {
                self + MARGIN as $t
            }
        }
    };
}

/// Twice the grid's slack, 2¹¹, where 1 is 2²⁹.
const MARGIN: f32 = 1.0 / (1 << 18) as f32;

float_bound!(f32, unit: 1.0 / (1u64 << 24) as f32, least: 1.0 / (1u64 << 40) as f32, whole: whole_f32);
float_bound!(f64, unit: 1.0 / (1u64 << 53) as f64, least: 1.0 / (1u64 << 60) as f64, whole: whole_f64);

/// The reciprocal of a direction in fixed point: a signed mantissa and a right shift.
#[derive(Clone, Copy, Debug)]
pub struct Shifted<M> {
    pub(super) mantissa: M,
    pub(super) shift: u8,
}

macro_rules! fixed_bound {
    ($t:ident, $unsigned:ident, $wide:ident, area_shift: $down:expr, below_grid: $below:expr) => {
        impl BoundScalar for $t {
            const ZERO: Self = 0;
            const MAX: Self = $t::MAX;
            const MIN: Self = -$t::MAX;

            type Inverse = Shifted<$t>;

            #[inline(always)]
            fn distance(self, origin: Self, inverse: Shifted<$t>) -> Self {
                let along = $wide::from(self.saturating_sub(origin));
                let raw = (along * $wide::from(inverse.mantissa))
                    >> (u32::from(inverse.shift) & ($wide::BITS - 1));
                if raw == $wide::from(raw as $t) {
                    raw as $t
                } else if raw < 0 {
                    Self::MIN
                } else {
                    Self::MAX
                }
            }

            #[cfg_attr(not(target_os = "none"), inline(always))]
            fn round_down(self) -> Self {
                Ord::max(self.saturating_sub(4), Self::MIN)
            }

            #[cfg_attr(not(target_os = "none"), inline(always))]
            fn round_up(self) -> Self {
                self.saturating_add(4)
            }

            fn midpoint(self, other: Self) -> Self {
                (self >> 1) + (other >> 1)
            }

            // Sides are cut to 20 bits, so that a million times the sum of three products fits.
            type Area = u64;

            const NO_AREA: u64 = 0;

            fn half_area(sides: [Self; 3]) -> u64 {
                let [x, y, z] = map3(sides, |s| (s as $unsigned >> $down) as u64);
                x * y + y * z + z * x
            }

            fn volume(sides: [Self; 3]) -> u64 {
                let [x, y, z] = map3(sides, |s| (s as $unsigned >> $down) as u64);
                x * y * z
            }

            fn add_areas(a: u64, b: u64) -> u64 {
                a.saturating_add(b)
            }

            fn scale_area(area: u64, count: u32) -> u64 {
                area.saturating_mul(u64::from(count))
            }

            fn difference(self, other: Self) -> Self {
                self.saturating_sub(other)
            }

            fn bin_index(self, low: Self, high: Self, bins: u32) -> u32 {
                let width = (high.wrapping_sub(low) as $unsigned) / bins as $unsigned + 1;
                ((self.wrapping_sub(low) as $unsigned / width) as u32).min(bins - 1)
            }

            #[inline(always)]
            fn to_grid(self) -> i32 {
                (self >> $below) as i32
            }

            const GRID_SLACK: i32 = 4;

            fn lowered(self) -> Self {
                self.saturating_sub(8 << $below)
            }

            fn raised(self) -> Self {
                self.saturating_add(8 << $below)
            }
        }
    };
}

fixed_bound!(i32, u32, i64, area_shift: 12, below_grid: 0);
fixed_bound!(i64, u64, i128, area_shift: 44, below_grid: 32);
