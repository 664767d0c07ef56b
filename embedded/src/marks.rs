//! Marks around what is to be counted by QEMU's plugin of octray, in `firmware-sim/count`. `octray measure` runs its
//! firmware with it.

/// Counts from here on, until [`end`].
///
/// ```no_run
/// # fn filter() {}
/// use octray_embedded::marks::{begin, end};
///
/// begin();
/// filter();
/// end();
/// ```
#[inline(always)]
pub fn begin() {
    octray_begin();
}

/// Counts no more, until [`begin`].
#[inline(always)]
pub fn end() {
    octray_end();
}

/// What the emulator's plugin looks for.
#[allow(unsafe_code, reason = "the linker's names")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn octray_begin() {
    // The barrier keeps the linker from folding it with `octray_end`.
    core::hint::black_box(1u32);
}

#[allow(unsafe_code, reason = "the linker's names")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn octray_end() {
    core::hint::black_box(2u32);
}
