//! Every operation returns the same bits as the hardware. NaN differs between machines, and is as the compiler's
//! routines return it.

use octray_soft_float as soft;

/// Returns zeros, the least and the largest subnormal and normal numbers, infinity, NaN with payloads, and fractions
/// that round up, down and to even, at many exponents; all with both signs.
fn special() -> Vec<u32> {
    let exponents = [
        0, 1, 2, 22, 23, 24, 25, 26, 63, 64, 65, 100, 101, 102, 103, 104, 125, 126, 127, 128, 129,
        150, 151, 157, 158, 159, 160, 190, 191, 192, 230, 253, 254, 255,
    ];
    let fractions = [
        0, 1, 2, 3, 0x7f_ffff, 0x7f_fffe, 0x7f_fffd, 0x40_0000, 0x3f_ffff, 0x40_0001, 0x20_0000,
        0x7f_f000, 0x00_0fff, 0x00_1000, 0x2a_aaaa, 0x55_5555, 0x35_04f3, 0x35_04f4,
    ];
    exponents
        .into_iter()
        .flat_map(|e: u32| fractions.map(|f| e << 23 | f))
        .flat_map(|x| [x, x | 1 << 31])
        .collect()
}

/// Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as u32
    }
}

/// Tests all pairs of special values, five million pairs of arbitrary values, and five million pairs of close values,
/// where sums cancel.
fn pairs(mut test: impl FnMut(u32, u32)) {
    let special = special();
    for &a in &special {
        for &b in &special {
            test(a, b);
        }
    }
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..5_000_000 {
        test(random.next(), random.next());
        let (a, b) = (random.next(), random.next());
        let near = (a & 0x7f80_0000).wrapping_add_signed(((b as i32) >> 27) << 23);
        test(a, near & 0x7f80_0000 | b & 0x807f_ffff);
    }
}

/// Returns the bits of an operation's result: computed by the hardware, but NaN as documented.
fn expected(a: u32, b: u32, f: impl Fn(f32, f32) -> f32) -> u32 {
    let [x, y] = [a, b].map(f32::from_bits);
    let result = f(x, y);
    if x.is_nan() {
        a | 1 << 22
    } else if y.is_nan() {
        b | 1 << 22
    } else if result.is_nan() {
        0x7fc0_0000
    } else {
        result.to_bits()
    }
}

#[track_caller]
fn same(name: &str, ours: impl Fn(u32, u32) -> u32, theirs: impl Fn(f32, f32) -> f32 + Copy) {
    pairs(|a, b| {
        let (found, expected) = (ours(a, b), expected(a, b, theirs));
        assert_eq!(
            found, expected,
            "{a:08x} {name} {b:08x}: {found:08x}, not {expected:08x}"
        );
    });
}

#[test]
fn sums() {
    same("+", soft::add, |a, b| a + b);
}

#[test]
fn differences() {
    // Subtraction flips the sign of a NaN, as the compiler's routine does.
    pairs(|a, b| assert_eq!(soft::sub(a, b), soft::add(a, b ^ 1 << 31)));
}

#[test]
fn products() {
    same("*", soft::mul, |a, b| a * b);
}

#[test]
fn quotients() {
    same("/", soft::div, |a, b| a / b);
}

#[test]
fn comparisons() {
    pairs(|a, b| {
        let [x, y] = [a, b].map(f32::from_bits);
        assert_eq!(soft::equal(a, b), x == y, "{a:08x} = {b:08x}");
        assert_eq!(soft::less(a, b), x < y, "{a:08x} < {b:08x}");
        assert_eq!(soft::less_equal(a, b), x <= y, "{a:08x} <= {b:08x}");
        assert_eq!(
            soft::unordered(a, b),
            x.is_nan() || y.is_nan(),
            "{a:08x} ? {b:08x}"
        );
    });
}

/// Returns special values, random values, and the first numbers of all 65,536 blocks of 65,536.
fn singles() -> impl Iterator<Item = u32> {
    let mut random = Random(0x0123_4567_89ab_cdef);
    let random = std::iter::repeat_with(move || random.next()).take(5_000_000);
    special()
        .into_iter()
        .chain((0..=u32::MAX).step_by(1 << 16))
        .chain(random)
}

#[test]
fn roots() {
    for x in singles() {
        let root = f32::from_bits(x).sqrt();
        let expected = match (f32::from_bits(x).is_nan(), root.is_nan()) {
            (true, _) => x | 1 << 22,
            (false, true) => 0x7fc0_0000,
            (false, false) => root.to_bits(),
        };
        assert_eq!(soft::sqrt(x), expected, "{x:08x}");
    }
    // Every significand, at an even and an odd exponent.
    for x in 0x3f80_0000..=0x407f_ffff {
        assert_eq!(soft::sqrt(x), f32::from_bits(x).sqrt().to_bits(), "{x:08x}");
    }
}

#[test]
fn integers() {
    let close =
        (0..32).flat_map(|bit| (-3..=3).map(move |near| (1u32 << bit).wrapping_add_signed(near)));
    for x in singles().chain(close) {
        let y = f32::from_bits(x);
        assert_eq!(soft::to_i32(x), y as i32, "{x:08x}");
        assert_eq!(soft::to_u32(x), y as u32, "{x:08x}");
        assert_eq!(soft::from_u32(x), (x as f32).to_bits(), "{x}");
        assert_eq!(soft::from_i32(x as i32), (x as i32 as f32).to_bits(), "{x}");
    }
}
