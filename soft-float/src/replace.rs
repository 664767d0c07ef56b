//! Exports the functions under the compiler's own names. Its routines are weak symbols, so the linker uses these
//! functions instead. They pass an `f32` in an integer register, as a `u32` is passed.

use crate as soft;

/// Exports functions under their names for the linker.
macro_rules! replace {
    ($($(#[$doc:meta])* fn $name:ident($($x:ident: $t:ty),+) -> $r:ty $body:block)+) => {
        $(
            $(#[$doc])*
            // SAFETY: this is the compiler's name for a function of this signature and meaning.
            #[unsafe(no_mangle)]
            pub(crate) extern "C" fn $name($($x: $t),+) -> $r $body
        )+
    };
}

#[cfg(target_arch = "arm")]
replace! {
    fn __aeabi_fadd(a: u32, b: u32) -> u32 { soft::add(a, b) }
    fn __aeabi_fsub(a: u32, b: u32) -> u32 { __aeabi_fadd(a, b ^ 1 << 31) }
    fn __aeabi_fmul(a: u32, b: u32) -> u32 { soft::mul(a, b) }
    fn __aeabi_fdiv(a: u32, b: u32) -> u32 { soft::div(a, b) }
    fn __aeabi_fcmpeq(a: u32, b: u32) -> i32 { soft::equal(a, b) as i32 }
    fn __aeabi_fcmplt(a: u32, b: u32) -> i32 { soft::less(a, b) as i32 }
    fn __aeabi_fcmple(a: u32, b: u32) -> i32 { soft::less_equal(a, b) as i32 }
    fn __aeabi_fcmpgt(a: u32, b: u32) -> i32 { soft::less(b, a) as i32 }
    fn __aeabi_fcmpge(a: u32, b: u32) -> i32 { soft::less_equal(b, a) as i32 }
    fn __aeabi_fcmpun(a: u32, b: u32) -> i32 { soft::unordered(a, b) as i32 }
    fn __aeabi_i2f(x: i32) -> u32 { soft::from_i32(x) }
    fn __aeabi_ui2f(x: u32) -> u32 { soft::from_u32(x) }
    fn __aeabi_f2iz(x: u32) -> i32 { soft::to_i32(x) }
    fn __aeabi_f2uiz(x: u32) -> u32 { soft::to_u32(x) }
}

// Comparisons return a number that the compiler compares with 0.
#[cfg(target_arch = "riscv32")]
replace! {
    fn __addsf3(a: u32, b: u32) -> u32 { soft::add(a, b) }
    fn __subsf3(a: u32, b: u32) -> u32 { __addsf3(a, b ^ 1 << 31) }
    fn __mulsf3(a: u32, b: u32) -> u32 { soft::mul(a, b) }
    fn __divsf3(a: u32, b: u32) -> u32 { soft::div(a, b) }
    fn __eqsf2(a: u32, b: u32) -> i32 { !soft::equal(a, b) as i32 }
    fn __nesf2(a: u32, b: u32) -> i32 { !soft::equal(a, b) as i32 }
    fn __ltsf2(a: u32, b: u32) -> i32 { -(soft::less(a, b) as i32) }
    fn __lesf2(a: u32, b: u32) -> i32 { !soft::less_equal(a, b) as i32 }
    fn __gtsf2(a: u32, b: u32) -> i32 { soft::less(b, a) as i32 }
    fn __gesf2(a: u32, b: u32) -> i32 { soft::less_equal(b, a) as i32 - 1 }
    fn __unordsf2(a: u32, b: u32) -> i32 { soft::unordered(a, b) as i32 }
    fn __floatsisf(x: i32) -> u32 { soft::from_i32(x) }
    fn __floatunsisf(x: u32) -> u32 { soft::from_u32(x) }
    fn __fixsfsi(x: u32) -> i32 { soft::to_i32(x) }
    fn __fixunssfsi(x: u32) -> u32 { soft::to_u32(x) }
}
