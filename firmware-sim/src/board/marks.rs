//! Marks for an emulator's plugin: they start and stop counting.

/// Instructions count from here on.
#[unsafe(no_mangle)]
#[inline(never)]
pub(super) extern "C" fn octray_resume() {
    // The barrier prevents that the linker folds it with `octray_pause`.
    core::hint::black_box(1u32);
}

/// Instructions do not count from here on.
#[unsafe(no_mangle)]
#[inline(never)]
pub(super) extern "C" fn octray_pause() {
    core::hint::black_box(2u32);
}
