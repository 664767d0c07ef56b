//! Marks for an emulator's plugin: which instructions are to be counted.

/// From here on instructions count.
#[unsafe(no_mangle)]
#[inline(never)]
pub(super) extern "C" fn octray_resume() {
    // The barrier keeps it from being folded with `octray_pause`.
    core::hint::black_box(1u32);
}

/// From here on they do not.
#[unsafe(no_mangle)]
#[inline(never)]
pub(super) extern "C" fn octray_pause() {
    core::hint::black_box(2u32);
}
