//! Conversions from and to the numbers of the crate `fixed`: each against that crate's own arithmetic.

use fastrand::Rng;
use fixed::traits::Fixed as AnyFixed;
use fixed::types::extra::{U4, U7, U8, U12, U16, U20, U24, U28, U32, U127};
use fixed::types::{I0F32, I4F4, I32F32, I64F64, I128F0, U0F64, U8F8, U32F0};
use fixed::{FixedI32, FixedI64, FixedI128, FixedU128};
use octray_core::quantize::Quantize;
use octray_core::scalar::{Fixed, Fixed64, Scalar};

/// Bit patterns, the ends among them.
fn patterns(seed: u64) -> impl Iterator<Item = i64> {
    let mut rng = Rng::with_seed(seed);
    let ends = [
        0,
        1,
        -1,
        i64::MAX,
        i64::MIN,
        i64::MIN + 1,
        1 << 31,
        -1 << 31,
    ];
    let random = (0..20_000).map(move |_| rng.i64(..) >> rng.u32(..64));
    ends.into_iter().chain(random)
}

#[test]
fn as_many_fraction_bits_are_the_same_bits_both_ways() {
    macro_rules! same {
        ($($f:literal $frac:ty),*) => {$(
            for bits in patterns($f).map(|bits| bits as i32) {
                let theirs = FixedI32::<$frac>::from_bits(bits);
                let ours = Fixed::<$f>::from(theirs);
                assert_eq!(ours.to_bits(), bits);
                assert_eq!(FixedI32::<$frac>::from(ours), theirs);
                assert_eq!(ours.to_f64(), theirs.to_num::<f64>());
            }
        )*};
    }
    same!(4 U4, 7 U7, 8 U8, 12 U12, 16 U16, 20 U20, 24 U24, 28 U28);
    for bits in patterns(64) {
        let theirs = I32F32::from_bits(bits);
        let ours = Fixed64::<()>::from(theirs);
        assert_eq!((ours.to_bits(), I32F32::from(ours)), (bits, theirs));
    }
}

#[test]
fn a_wider_number_holds_every_narrower_one() {
    for bits in patterns(1).map(|bits| bits as i32) {
        macro_rules! exact {
            ($($f:literal $frac:ty),*) => {$(
                let theirs = FixedI32::<$frac>::from_bits(bits);
                let wide = FixedI64::<U32>::from_num(theirs);
                assert_eq!(Fixed64::<()>::from(theirs).to_bits(), wide.to_bits());
                assert_eq!(I32F32::from(Fixed::<$f>::from_bits(bits)), wide);
            )*};
        }
        exact!(4 U4, 16 U16, 28 U28);
        // Ours have no such format.
        let fraction = I0F32::from_bits(bits);
        assert_eq!(Fixed64::<()>::from(fraction).to_bits(), i64::from(bits));
    }
}

/// ⌊x · 2ᶠ + ½⌋ with the other crate's widest numbers, clamped to our range.
fn nearest(x: impl AnyFixed, f: u32, most: i64) -> i64 {
    let x: I64F64 = x.saturating_to_num();
    let scaled = x.saturating_mul(I64F64::from_num(1u64 << f));
    let whole = scaled.saturating_add(I64F64::from_num(0.5)).floor();
    whole.saturating_to_num::<i64>().clamp(-most, most)
}

fn comes_in<T: AnyFixed>(seed: u64) {
    for bits in patterns(seed) {
        let x = I64F64::from_bits(i128::from(bits) << (seed % 60));
        let x: T = x.wrapping_to_num();
        macro_rules! rounds {
            ($($f:literal),*) => {$(
                let ours = Fixed::<$f>::from_fixed_rounded(x).to_bits();
                assert_eq!(i64::from(ours), nearest(x, $f, i32::MAX.into()), "{x} to {}", $f);
            )*};
        }
        rounds!(4, 8, 16, 28);
        let ours = Fixed64::<()>::from_fixed_rounded(x).to_bits();
        assert_eq!(ours, nearest(x, 32, i64::MAX), "{x}");
    }
}

#[test]
fn any_number_comes_in_as_the_nearest_with_halves_up_and_clamped() {
    comes_in::<I4F4>(1);
    comes_in::<U8F8>(2);
    comes_in::<FixedI32<U28>>(3);
    comes_in::<U32F0>(4);
    comes_in::<U0F64>(5);
    comes_in::<I32F32>(30);
    comes_in::<I64F64>(59);
    comes_in::<I128F0>(45);
    comes_in::<FixedI128<U127>>(6);
    comes_in::<FixedU128<U127>>(7);
    let half = U8F8::from_num(0.03125);
    assert_eq!(Fixed::<4>::from_fixed_rounded(half).to_bits(), 1);
    let below = I64F64::from_num(-0.03125);
    assert_eq!(Fixed::<4>::from_fixed_rounded(below).to_bits(), 0);
    assert_eq!(
        Fixed::<4>::from_fixed_rounded(below - I64F64::DELTA).to_bits(),
        -1
    );
    assert_eq!(Fixed::<16>::from_fixed_rounded(I128F0::MIN), -Fixed::MAX);
    assert_eq!(Fixed64::<()>::from_fixed_rounded(I128F0::MAX), Fixed64::MAX);
}

fn goes_out<T: AnyFixed>(seed: u64) {
    for bits in patterns(seed) {
        let wanted = |x: I32F32| -> T {
            let x = I64F64::from_num(x);
            // The two neighbours on the grid of `T`, clamped; the nearer, or the upper.
            let step = I64F64::from_bits((1i128 << 64) >> T::FRAC_NBITS.min(64));
            let low = I64F64::from_bits(x.to_bits() & !(step.to_bits() - 1));
            let near = if x - low >= low + step - x {
                low + step
            } else {
                low
            };
            near.saturating_to_num()
        };
        let wide = Fixed64::<()>::from_bits(bits);
        let exact = T::FRAC_NBITS >= 32;
        let wanted = |x: I32F32| {
            if exact {
                x.saturating_to_num()
            } else {
                wanted(x)
            }
        };
        assert_eq!(wide.to_fixed_rounded::<T>(), wanted(wide.into()), "{bits}");
        let narrow = Fixed::<16>::from_bits(bits as i32);
        assert_eq!(
            narrow.to_fixed_rounded::<T>(),
            wanted(narrow.into()),
            "{bits}"
        );
        let fine = Fixed::<28>::from_bits(bits as i32);
        assert_eq!(fine.to_fixed_rounded::<T>(), wanted(fine.into()), "{bits}");
    }
}

#[test]
fn a_number_goes_out_as_the_nearest_with_halves_up_and_clamped() {
    goes_out::<I4F4>(1);
    goes_out::<U8F8>(2);
    goes_out::<FixedI32<U24>>(3);
    goes_out::<U32F0>(4);
    goes_out::<U0F64>(5);
    goes_out::<I32F32>(6);
    goes_out::<I64F64>(7);
    goes_out::<I128F0>(8);
    goes_out::<FixedU128<U127>>(9);
    let half = Fixed::<16>::from_f64(-2.5);
    assert_eq!(half.to_fixed_rounded::<I128F0>(), -2);
    assert_eq!(Fixed::<16>::from_f64(2.5).to_fixed_rounded::<U32F0>(), 3);
    assert_eq!(half.to_fixed_rounded::<U8F8>(), 0);
    assert_eq!(Fixed64::<()>::MAX.to_fixed_rounded::<I4F4>(), I4F4::MAX);
}
