//! The square root of an `f32`: by the target's instruction where there is one that libm does not
//! use. Either is rounded to nearest, so the bits are the same.
//!
//! The only module with unsafe code: two instructions that read and write one register each.
#![allow(unsafe_code)]

/// √`x` for `x` ≥ 0.
#[inline(always)]
pub(super) fn sqrt_f32(x: f32) -> f32 {
    #[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
    return vsqrt(x);
    #[cfg(octray_riscv_f)]
    return fsqrt(x);
    #[cfg(not(any(all(target_arch = "arm", target_abi = "eabihf"), octray_riscv_f)))]
    return libm::sqrtf(x);
}

/// By the floating-point unit of Cortex-M4F, M7 and A. Inline assembly can name its registers in
/// nightly compilers only; by the hard-float calling convention argument and result are in s0.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[unsafe(naked)]
extern "C" fn vsqrt(_x: f32) -> f32 {
    // SAFETY: it changes s0 alone, and returns to its caller.
    // The instruction is vsqrt.f32 s0, s0, written as a number: the assembler does not know here that
    // the target has a floating-point unit.
    core::arch::naked_asm!(".inst.w 0xeeb10ac0", "bx lr")
}

/// By the F extension.
#[cfg(octray_riscv_f)]
#[inline(always)]
fn fsqrt(x: f32) -> f32 {
    let root: f32;
    // SAFETY: it reads one register and writes one.
    unsafe {
        core::arch::asm!(
            "fsqrt.s {root}, {x}",
            root = lateout(freg) root,
            x = in(freg) x,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    root
}
