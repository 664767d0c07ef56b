//! Measures the maximum depth of the stack: the free memory below it is filled with a pattern and examined afterwards.

use core::ptr;

const PAINT: u32 = 0xcccc_cccc;

/// Where fewer words than these are left, the stack counts as overflown: a function need not write into all of its part
/// of the stack, and may step over so many.
const GUARD: usize = 16;

// From the linker scripts of cortex-m-rt and riscv-rt.
unsafe extern "C" {
    static mut __ebss: u32;
    static _stack_start: u32;
}

/// Returns the lowest word that the stack may grow to.
fn lowest() -> *mut u32 {
    &raw mut __ebss
}

/// Fills the memory that the stack has not reached yet.
#[inline(never)]
pub(super) fn paint() {
    let here = 0u32;
    // This function's own part of the stack is above these words.
    let end = (&raw const here as usize).saturating_sub(128);
    let mut word = lowest();
    while (word as usize) < end {
        // SAFETY: the word is between the variables and the stack; nothing else uses it.
        unsafe {
            ptr::write_volatile(word, PAINT);
            word = word.add(1);
        }
    }
}

/// Returns the bytes from the top of the stack to the lowest overwritten word, or `None` if that is one of the lowest
/// [`GUARD`].
pub(super) fn deepest() -> Option<u32> {
    let top = &raw const _stack_start as usize;
    let mut word = lowest();
    // SAFETY: the word is in memory, below the stack's top.
    while (word as usize) < top && unsafe { ptr::read_volatile(word) } == PAINT {
        // SAFETY: the same.
        word = unsafe { word.add(1) };
    }
    (word >= lowest().wrapping_add(GUARD)).then_some((top - word as usize) as u32)
}
