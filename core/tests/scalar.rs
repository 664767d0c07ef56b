//! How exact each arithmetic is: a budget of errors, row by row, and the laws of `Scalar`.

use fastrand::Rng;
use fixed::types::extra::{U8, U12, U16, U20, U24, U28, U32};
use fixed::{FixedI32, FixedI64};
use octray_core::quantize::Quantize;
use octray_core::scalar::{Approx, Exponent, Fixed, Fixed64, SaturationCounter, Scalar};
use octray_prepare::saturation::PerThread;
use proptest::prelude::*;

/// The worst errors allowed. Floats: relative, in units of 2^−24 (`f64`: 2^−53), but for `power`.
/// Fixed point: in steps, or in parts of 2^−29 of the result where that is more.
struct Budget {
    sqrt: f64,
    quotient: f64,
    scaled: f64,
    /// A component of a unit vector, absolute.
    unit: f64,
    length: f64,
    ratio: f64,
    /// Absolute, whatever the format.
    power: f64,
}

const fn budget([sqrt, quotient, scaled, unit, length, ratio, power]: [f64; 7]) -> Budget {
    Budget {
        sqrt,
        quotient,
        scaled,
        unit,
        length,
        ratio,
        power,
    }
}

macro_rules! budgets {
    ($($name:ident: $s:ty => [$($bound:expr),*];)*) => {
        mod budget_of {
            use super::*;
            $(#[test] fn $name() { measure::<$s>(&budget([$($bound),*])); })*
        }
        mod laws_of {
            use super::*;
            $(mod $name { use super::*; laws!($s); })*
        }
    };
}

macro_rules! laws {
    ($s:ty) => {
        proptest! {
            #[test]
            fn nothing_panics(a: u64, b: u64, c: u64, n: i32, e in -127i8..=127, whole: u32) {
                every_operation::<$s>([a, b, c].map(Bits::number), n, e, whole);
            }

            #[test]
            fn sums_and_products_are_monotone(a: u64, b: u64, c: u64) {
                monotone::<$s>([a, b, c].map(Bits::moderate));
            }

            #[test]
            fn quotients_saturate(a: u64, b: u64) {
                saturates::<$s>(a.number(), b.number());
            }

            #[test]
            fn what_exceeds_by_the_shortcut_does(a: u64, b: u64, limit: u64) {
                exceeds::<$s>(a.number(), b.number(), limit.number());
            }

            #[test]
            fn local_scales_go_back(a: u64, e in -31i8..=31) {
                goes_back::<$s>(a.moderate(), e);
            }

            #[test]
            fn levels_are_the_nearest(a: u64) {
                level::<$s>(a.number());
            }
        }
    };
}

//         format                 √     a/b   a·(1/b)  unit  length  n/m   power
budgets! {
    f64: f64                 => [1.1,   1.1,   3.1,    3.0,   3.0,   2.1,  1e-15];
    f32: f32                 => [1.1,   1.1,   3.1,    3.0,   3.0,   2.1,  6e-6];
    approx0: Approx<0>       => [6e5, 2.1e6, 2.1e6,    6e5,   6e5,   2.1,  6e-6];
    approx1: Approx<1>       => [3.1e4, 2.7e5, 2.7e5,  3.1e4, 3.1e4, 2.1,  6e-6];
    approx2: Approx<2>       => [84.0, 4.1e3, 4.1e3,   84.0,  84.0,  2.1,  6e-6];
    i24f8: Fixed<8, PerThread>    => [1.1,   2.5,   2.5,    0.6,   2.0,   0.6,  2e-3];
    i20f12: Fixed<12, PerThread>  => [1.1,   2.5,   2.5,    0.6,   2.0,   0.6,  1.3e-4];
    i16f16: Fixed<16, PerThread>  => [1.1,   2.5,   2.5,    0.6,   2.0,   0.6,  9e-6];
    i12f20: Fixed<20, PerThread>  => [1.1,   2.5,   2.5,    0.6,   2.0,   0.6,  1.5e-6];
    i8f24: Fixed<24, PerThread>   => [1.1,   2.5,   2.5,    0.6,   2.0,   0.6,  1e-6];
    i4f28: Fixed<28, PerThread>   => [2.0,   2.5,   2.5,    1.5,   2.0,   1.6,  1e-6];
    wrapping: Fixed<28> => [2.0, 2.5,   2.5,    1.5,   2.0,   1.6,  1e-6];
    i32f32: Fixed64<PerThread> => [1.0,   1.0,   1.0,    0.2,   1.0,   1.0,  1e-4];
}

/// The worst errors over many operands of all sizes.
fn measure<S: Quantize>(budget: &Budget) {
    let mut rng = Rng::with_seed(1);
    let mut worst = budget_of_nothing();
    let note = |worst: &mut f64, got: S, expected: f64| {
        if expected.abs() < 0.99 * S::MAX.to_f64() {
            *worst = worst.max(error::<S>(got.to_f64(), expected));
        }
    };
    for _ in 0..200_000 {
        let (a, b) = (sized::<S>(&mut rng), sized::<S>(&mut rng));
        let (x, y) = (a.to_f64(), b.to_f64());
        note(&mut worst.sqrt, a.sqrt(), x.sqrt());
        note(&mut worst.quotient, a.quotient(b), x / y);
        note(&mut worst.scaled, a.times_reciprocal(b.reciprocal()), x / y);
        let n = rng.u32(1..1 << 24);
        let numerator = rng.i32(-(n as i32)..=n as i32);
        let ratio = S::ratio(numerator, S::whole_reciprocal(n));
        note(&mut worst.ratio, ratio, f64::from(numerator) / f64::from(n));

        let v = [a, b, sized::<S>(&mut rng)].map(|c| if rng.bool() { c } else { -c });
        let length = v.map(S::to_f64).iter().map(|c| c * c).sum::<f64>().sqrt();
        let (unit, measured) = S::unit(v);
        note(&mut worst.length, measured, length);
        for (got, component) in unit.into_iter().zip(v) {
            // Absolute, since the vector as a whole counts.
            let off = got.to_f64() - component.to_f64() / length;
            worst.unit = worst.unit.max(error::<S>(1.0 + off, 1.0));
        }

        // `i32f32` computes powers of the upper 28 fraction bits.
        let base = S::from_f64(rng.f64().powi(rng.i32(1..9)).max(1e-6));
        let exponent = Exponent {
            whole: rng.u32(..4) * rng.u32(..100),
            fraction: S::from_f64([0.0, 0.5, rng.f64()][rng.usize(..3)]).min(below_one()),
        };
        let power = f64::from(exponent.whole) + exponent.fraction.to_f64();
        let off = base.power(exponent).to_f64() - base.to_f64().powf(power);
        worst.power = worst.power.max(off.abs());
    }
    let rows = [
        ("sqrt", worst.sqrt, budget.sqrt),
        ("quotient", worst.quotient, budget.quotient),
        ("scaled", worst.scaled, budget.scaled),
        ("unit", worst.unit, budget.unit),
        ("length", worst.length, budget.length),
        ("ratio", worst.ratio, budget.ratio),
        ("power", worst.power, budget.power),
    ];
    let table: String = rows
        .iter()
        .map(|(name, worst, bound)| {
            format!("{:<8} {name:<9} {worst:>12.3e} of {bound:.3e}\n", S::NAME)
        })
        .collect();
    println!("{table}");
    assert!(
        rows.iter().all(|(_, worst, bound)| worst <= bound),
        "\n{table}"
    );
}

fn budget_of_nothing() -> Budget {
    budget([0.0; 7])
}

/// An error in the units of [`Budget`].
fn error<S: Quantize>(got: f64, expected: f64) -> f64 {
    let off = (got - expected).abs();
    match (S::FRACTION_BITS, S::NAME) {
        (Some(bits), _) => {
            off / 2f64
                .powi(-(bits as i32))
                .max(expected.abs() * 2f64.powi(-29))
        }
        (None, "f64") => off / expected.abs() * 2f64.powi(53),
        (None, _) => off / expected.abs() * 2f64.powi(24),
    }
}

/// A positive number, all sizes being alike.
fn sized<S: Quantize>(rng: &mut Rng) -> S {
    let (low, high) = match S::FRACTION_BITS {
        Some(bits) => (2f64.powi(-(bits as i32)), 0.5 * S::MAX.to_f64()),
        None => (1e-6, 1e6),
    };
    S::from_f64(low * (high / low).powf(rng.f64()))
}

/// Numbers from random bits.
trait Bits {
    /// Any there is.
    fn number<S: Any>(self) -> S;
    /// One of those whose sums and products stay in range.
    fn moderate<S: Any>(self) -> S;
}

impl Bits for u64 {
    fn number<S: Any>(self) -> S {
        S::any(self)
    }

    fn moderate<S: Any>(self) -> S {
        let unit = (self >> 11) as f64 / (1u64 << 53) as f64;
        let largest = S::MAX.to_f64().min(1e15).sqrt() / 2.0;
        S::from_f64((2.0 * unit - 1.0) * largest)
    }
}

/// A format whose every bit pattern can be made.
trait Any: Quantize {
    fn any(bits: u64) -> Self;
}

impl Any for f64 {
    fn any(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

impl Any for f32 {
    fn any(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }
}

impl<const N: u32> Any for Approx<N> {
    fn any(bits: u64) -> Self {
        Self(f32::from_bits(bits as u32))
    }
}

impl<const F: u32, C: SaturationCounter> Any for Fixed<F, C> {
    fn any(bits: u64) -> Self {
        // The ends of the range are tried more often than by chance.
        Self::from_bits(match bits >> 60 {
            0 => i32::MIN,
            1 => i32::MAX,
            2 => 0,
            3 => -1,
            _ => bits as i32 >> (bits >> 40 & 31),
        })
    }
}

impl<C: SaturationCounter> Any for Fixed64<C> {
    fn any(bits: u64) -> Self {
        let top = Self::MAX;
        match bits >> 60 {
            0 => top,
            1 => -top,
            2 => Self::ZERO,
            3 => -top - Self::from_f64(2f64.powi(-32)),
            _ => Self::from_f64(bits as i32 as f64 * 2f64.powi((bits >> 32 & 31) as i32 - 32)),
        }
    }
}

/// Law 1.
fn every_operation<S: Quantize>([a, b, c]: [S; 3], n: i32, e: i8, whole: u32) {
    let wide = S::product(a, b) + S::product(b, c) - S::product(c, a);
    let fraction = S::from_f64(f64::from(whole) / 4_294_967_296.0).min(below_one());
    let numbers = [
        a + b,
        a - b,
        a * b,
        -a,
        a.abs(),
        a.min(b),
        a.max(b),
        S::narrow(wide),
        S::sqrt_wide(wide),
        a.sqrt(),
        a.quotient(b),
        a.times_reciprocal(b.reciprocal()),
        S::ratio(n, S::whole_reciprocal(whole.clamp(1, i32::MAX as u32))),
        S::unit([a, b, c]).1,
        a.to_local(e),
        a.to_global(e),
        S::surface_error(a, b),
        a.accumulate(b),
        S::from_bound(a.to_bound()),
        S::from_f64(f64::from(n)),
        a.power(Exponent { whole, fraction }),
    ];
    for number in numbers {
        let _ = (number.level(), number.to_f64(), number.inv_direction());
    }
}

/// A number a little below 1.
fn below_one<S: Quantize>() -> S {
    S::from_f64(1.0 - 1.0 / 256.0)
}

/// Law 2.
fn monotone<S: Quantize>([a, b, c]: [S; 3]) {
    let (a, b, factor) = (a.min(b), a.max(b), c.abs());
    assert!(a + c <= b + c);
    assert!(a - c <= b - c && c - b <= c - a);
    assert!(a * factor <= b * factor);
    assert!(b * -factor <= a * -factor);
}

/// Law 3, for all that is not 0/0 and not infinite already.
fn saturates<S: Quantize>(a: S, b: S) {
    let (x, y) = (a.to_f64(), b.to_f64());
    if !x.is_finite() || !y.is_finite() || x == 0.0 {
        return;
    }
    let exact = x / y;
    let quotient = a.quotient(b).to_f64();
    assert!(!quotient.is_nan());
    if exact.abs() > 2.0 * S::MAX.to_f64() && exact.is_finite() {
        assert!(quotient.abs() >= 0.999 * S::MAX.to_f64() || S::FRACTION_BITS.is_none());
        assert_eq!(quotient < 0.0, exact < 0.0);
    }
}

/// `Scalar::quotient_exceeds` is a shortcut, never a decision of its own.
fn exceeds<S: Quantize>(a: S, b: S, limit: S) {
    let (a, b, limit) = (a.abs(), b.abs(), limit.abs());
    if a >= S::ZERO && b > S::ZERO && limit >= S::ZERO && S::quotient_exceeds(a, b, limit) {
        assert!(a.quotient(b) > limit || limit == S::MAX);
    }
}

/// What `Scalar::to_local` did not push out of the format comes back.
fn goes_back<S: Quantize>(a: S, e: i8) {
    let local = a.to_local(e);
    let fits = S::FRACTION_BITS.is_none()
        || (e >= 0 && a.to_f64().abs() * 2f64.powi(e.into()) < S::MAX.to_f64());
    if fits {
        assert_eq!(local.to_global(e), a);
    }
}

/// ⌊255 · c + ½⌋, exactly, but where rounding in the format itself comes to the border.
fn level<S: Quantize>(a: S) {
    let exact = 255.0 * a.to_f64().clamp(0.0, 1.0) + 0.5;
    let level = f64::from(a.level());
    if exact.is_nan() {
        return;
    }
    assert!(level == exact.floor() || (exact - exact.round()).abs() < 3e-5);
    assert!((level - exact.floor()).abs() <= 1.0);
}

#[test]
fn black_and_white_are_exact() {
    fn ends<S: Quantize>() {
        assert_eq!((S::ZERO.level(), S::ONE.level()), (0, 255));
        assert_eq!((S::MAX.level(), (-S::MAX).level()), (255, 0));
        assert_eq!(S::from_f64(0.5).level(), 128);
        assert_eq!(S::ZERO.power(Exponent::default()), S::ONE);
    }
    ends::<f64>();
    ends::<f32>();
    ends::<Approx<0>>();
    ends::<Fixed<8, PerThread>>();
    ends::<Fixed<16, PerThread>>();
    ends::<Fixed<28>>();
    ends::<Fixed64<PerThread>>();
}

/// Conversions and products against a fixed-point library that others wrote.
#[test]
fn fixed_point_agrees_with_another_library() {
    macro_rules! agree {
        ($f:literal, $bits:ty) => {{
            let mut rng = Rng::with_seed($f);
            for _ in 0..100_000 {
                let x = (rng.f64() - 0.5) * 2f64.powi(rng.i32(-30..34));
                let theirs = FixedI32::<$bits>::saturating_from_num(x).to_bits();
                let ours = Fixed::<$f, PerThread>::from_f64(x);
                let tie = (x * 2f64.powi($f)).fract().abs() == 0.5;
                assert!(
                    ours.to_bits() == theirs.max(-i32::MAX) || tie,
                    "{x}: {ours:?} not {theirs}"
                );
                let (a, b) = (rng.i32(..) >> rng.u32(..31), rng.i32(..) >> rng.u32(..31));
                let exact =
                    FixedI32::<$bits>::from_bits(a).wide_mul(FixedI32::<$bits>::from_bits(b));
                let rounded = (exact.to_bits() + (1 << ($f - 1))) >> $f;
                let [a, b] = [a, b].map(Fixed::<$f, PerThread>::from_bits);
                let clamped = rounded.clamp(-i64::from(i32::MAX), i64::from(i32::MAX));
                assert_eq!(i64::from((a * b).to_bits()), clamped);
                assert_eq!(
                    a.to_f64(),
                    FixedI32::<$bits>::from_bits(a.to_bits()).to_num::<f64>()
                );
            }
        }};
    }
    agree!(8, U8);
    agree!(12, U12);
    agree!(16, U16);
    agree!(20, U20);
    agree!(24, U24);
    agree!(28, U28);

    let mut rng = Rng::with_seed(64);
    for _ in 0..100_000 {
        let [x, y] = [(); 2].map(|()| f64::from(rng.i32(..)) * 2f64.powi(rng.i32(-32..-16)));
        let [a, b] = [x, y].map(FixedI64::<U32>::from_num);
        let product = (a.wide_mul(b).to_bits() + (1 << 31)) >> 32;
        let theirs = FixedI64::<U32>::from_bits(product as i64).to_num::<f64>();
        assert_eq!(
            (Fixed64::<PerThread>::from_f64(x) * Fixed64::<PerThread>::from_f64(y)).to_f64(),
            theirs
        );
        assert_eq!(
            Fixed64::<PerThread>::from_f64(x).to_f64(),
            a.to_num::<f64>()
        );
    }
}
