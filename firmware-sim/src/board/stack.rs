//! How deep the stack has ever been: the free memory below it is painted, and looked at again
//! afterwards.

use core::ptr;

const PAINT: u32 = 0xcccc_cccc;

// From the linker scripts of cortex-m-rt and riscv-rt.
unsafe extern "C" {
    static mut __ebss: u32;
    static _stack_start: u32;
}

/// The lowest word that the stack may grow to.
fn lowest() -> *mut u32 {
    &raw mut __ebss
}

/// Paints all that the stack has not reached yet.
#[inline(never)]
pub(super) fn paint() {
    let here = 0u32;
    // Whatever this function itself keeps there stays below these words.
    let end = (&raw const here as usize).saturating_sub(128);
    let mut word = lowest();
    while (word as usize) < end {
        // SAFETY: it lies between the variables and the stack; nobody else uses it.
        unsafe {
            ptr::write_volatile(word, PAINT);
            word = word.add(1);
        }
    }
}

/// Bytes from the top of the stack to the lowest word that is not painted any more; `None` if
/// there is no paint left.
pub(super) fn deepest() -> Option<u32> {
    let top = &raw const _stack_start as usize;
    let mut word = lowest();
    // SAFETY: it lies in memory, below the stack's top.
    while (word as usize) < top && unsafe { ptr::read_volatile(word) } == PAINT {
        // SAFETY: the same.
        word = unsafe { word.add(1) };
    }
    (word != lowest()).then_some((top - word as usize) as u32)
}
