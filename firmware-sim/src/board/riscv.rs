//! RISC-V: riscv-rt starts the program and enables the floating-point unit.

use core::arch::naked_asm;
use riscv_rt::entry;

#[entry]
fn main() -> ! {
    super::run()
}

/// Takes every exception, in place of riscv-rt's routine. That saves registers on the stack; where the stack has left
/// the memory, it would never end.
#[unsafe(naked)]
#[unsafe(no_mangle)]
#[unsafe(link_section = ".trap.start")]
extern "C" fn _start_trap() -> ! {
    naked_asm!(
        ".balign 4",
        "la sp, _stack_start",
        "j {fault}",
        fault = sym fault
    )
}

extern "C" fn fault() -> ! {
    super::fault()
}
