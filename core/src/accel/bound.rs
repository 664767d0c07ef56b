//! The numbers that boxes are cut with, apart from the scene's own arithmetic.

use core::fmt::Debug;

/// A plane's coordinate, and a distance along a ray.
pub trait BoundScalar: Copy + Debug + Default + PartialOrd + Send + Sync + 'static {
    /// 0.
    const ZERO: Self;
    /// Beyond every box and every distance.
    const MAX: Self;
    /// Before every box.
    const MIN: Self;

    /// What a distance along an axis is multiplied with to give the distance along the ray.
    type Inverse: Copy + Debug;

    /// The distance at which a ray from `origin` comes to the plane; monotone in the plane.
    fn distance(self, origin: Self, inverse: Self::Inverse) -> Self;

    /// The coordinate of a box's low face that is sure to let in all that lies above `self`.
    fn round_down(self) -> Self;

    /// The coordinate of a box's high face that is sure to let in all that lies below `self`.
    fn round_up(self) -> Self;

    /// The middle of two coordinates.
    fn midpoint(self, other: Self) -> Self;

    /// Clips a ray against eight boxes. Returns the distance at which each is entered, not less
    /// than 0, and a bit for each box that is entered before it is left and not beyond `limit`.
    #[inline(always)]
    fn clip_boxes(
        boxes: SlabPlanes<'_, Self>,
        origin: [Self; 3],
        inv_direction: &[InvDirection<Self>; 3],
        limit: Self,
    ) -> ([Self; 8], u32) {
        let mut entry = [Self::ZERO; 8];
        let mut exit = [limit; 8];
        for i in 0..3 {
            for k in 0..8 {
                let near = boxes.near[i][k].distance(origin[i], inv_direction[i].near);
                let far = boxes.far[i][k].distance(origin[i], inv_direction[i].far);
                entry[k] = near.max(entry[k]);
                exit[k] = far.min(exit[k]);
            }
        }
        let met = |mask, k: usize| mask | u32::from(entry[k] <= exit[k]) << k;
        (entry, (0..8).fold(0, met))
    }

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
}

/// The planes of eight boxes that a ray comes to first and last on each axis.
#[derive(Clone, Copy, Debug)]
pub struct SlabPlanes<'a, P> {
    /// Where it may enter.
    pub near: [&'a [P; 8]; 3],
    /// Where it may leave.
    pub far: [&'a [P; 8]; 3],
}

/// The reciprocal of a ray's direction along one axis.
///
/// Let u be the unit of rounding, d the direction's component, o the origin's, [l, h] a box's side
/// widened by [`BoundScalar::round_down`] and [`BoundScalar::round_up`], and P = o ⊕ (t ⊗ d) a point with
/// l' ≤ P ≤ h', where l' and h' are the sides before widening. Say d > 0. With three roundings
/// between P and t, t d (1 + 3u) ≥ l' − u|l'| − o and, with three more in the walk, the distance
/// (l − o) ⊗ 1/d is at most t (1 + 6u) if l ≤ l' − u|l'|: that is what the widening is for. `near`
/// is 1/d less 8u of it, so the box is entered at ≤ t; `far` is 1/d and 8u more, so it is left at
/// ≥ t. In fixed point the same holds with absolute errors: P is off by half a unit, and the
/// widening is four. A component that is 0, or so small that o ⊕ (t ⊗ d) = o, is replaced by the
/// smallest one that is not: a box whose widened side holds o is entered before every t and left
/// after, one whose side does not hold it is missed.
#[derive(Clone, Copy, Debug)]
pub struct InvDirection<P: BoundScalar> {
    /// Whether the ray goes down the axis.
    pub negative: bool,
    /// For the plane where a box is entered.
    pub near: P::Inverse,
    /// For the plane where it is left.
    pub far: P::Inverse,
}

macro_rules! float_bound {
    ($t:ident, unit: $unit:expr, least: $least:expr $(, $clip:item)?) => {
        impl BoundScalar for $t {
            const ZERO: Self = 0.0;
            const MAX: Self = $t::MAX;
            const MIN: Self = $t::MIN;

            type Inverse = Self;

            #[inline(always)]
            fn distance(self, origin: Self, inverse: Self) -> Self {
                (self - origin) * inverse
            }

            $($clip)?

            fn round_down(self) -> Self {
                self - (self.abs() * (2.0 * $unit) + $least)
            }

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
        }

        impl InvDirection<$t> {
            /// Of a direction's component.
            #[inline(always)]
            pub fn of(d: $t) -> Self {
                // Scenes are scaled to a size of about 1, so this moves nothing by a unit.
                const LEAST: $t = $least * $least;
                let d = if d.abs() < LEAST {
                    LEAST.copysign(d)
                } else {
                    d
                };
                let inverse = 1.0 / d;
                Self {
                    negative: d < 0.0,
                    near: inverse * (1.0 - 8.0 * $unit),
                    far: inverse * (1.0 + 8.0 * $unit),
                }
            }
        }
    };
}

float_bound!(
    f32, unit: 1.0 / (1u64 << 24) as f32, least: 1.0 / (1u64 << 40) as f32,
    // The default loop does not become vector instructions by itself; the results are the same.
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    #[inline(always)]
    fn clip_boxes(boxes: SlabPlanes<'_, Self>, origin: [Self; 3], inv_direction: &[InvDirection<Self>; 3], limit: Self) -> ([Self; 8], u32) {
        use wide::f32x8;
        let (mut entry, mut exit) = (f32x8::splat(0.0), f32x8::splat(limit));
        for i in 0..3 {
            let o = f32x8::splat(origin[i]);
            let near = (f32x8::new(*boxes.near[i]) - o) * f32x8::splat(inv_direction[i].near);
            let far = (f32x8::new(*boxes.far[i]) - o) * f32x8::splat(inv_direction[i].far);
            entry = near.fast_max(entry);
            exit = far.fast_min(exit);
        }
        (entry.to_array(), entry.simd_le(exit).to_bitmask())
    }
);
float_bound!(f64, unit: 1.0 / (1u64 << 53) as f64, least: 1.0 / (1u64 << 60) as f64);

/// A signed mantissa and a right shift.
#[derive(Clone, Copy, Debug)]
pub struct Shifted<M> {
    mantissa: M,
    shift: u8,
}

macro_rules! fixed_bound {
    ($t:ident, $unsigned:ident, $wide:ident, area_shift: $down:expr) => {
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

            fn round_down(self) -> Self {
                Ord::max(self.saturating_sub(4), Self::MIN)
            }

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
                let [x, y, z] = sides.map(|s| (s as $unsigned >> $down) as u64);
                x * y + y * z + z * x
            }

            fn volume(sides: [Self; 3]) -> u64 {
                let [x, y, z] = sides.map(|s| (s as $unsigned >> $down) as u64);
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
        }

        impl InvDirection<$t> {
            /// Of a component with the given sign whose reciprocal is mantissa · 2^−shift, with a
            /// relative error below 2^−27; the mantissa has the component's sign.
            #[inline(always)]
            pub fn new(negative: bool, mantissa: $t, shift: u8) -> Self {
                let slack = if negative { -16 } else { 16 };
                Self {
                    negative,
                    near: Shifted {
                        mantissa: mantissa - slack,
                        shift,
                    },
                    far: Shifted {
                        mantissa: mantissa.saturating_add(slack),
                        shift,
                    },
                }
            }
        }
    };
}

fixed_bound!(i32, u32, i64, area_shift: 12);
fixed_bound!(i64, u64, i128, area_shift: 44);
