//! RISC-V: riscv-rt starts the program and enables the floating-point unit.

use core::arch::global_asm;
use riscv_rt::entry;

#[entry]
fn main() -> ! {
    super::run()
}

// Takes every exception, in place of riscv-rt's routine. That saves registers on the stack; where the stack has left the
// memory, it would never end. It has to be aligned to 4 bytes, as the lowest bits of its address are a mode.
global_asm!(
    ".section .trap.start, \"ax\"",
    ".balign 4",
    ".global _start_trap",
    "_start_trap:",
    "la sp, _stack_start",
    "j {fault}",
    fault = sym fault
);

extern "C" fn fault() -> ! {
    super::fault()
}
