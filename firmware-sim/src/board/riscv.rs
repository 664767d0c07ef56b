//! RISC-V: riscv-rt starts the program and enables the floating-point unit.

use riscv_rt::{TrapFrame, entry};

#[entry]
fn main() -> ! {
    super::run()
}

/// Handles every exception, as none has a handler of its own.
#[unsafe(no_mangle)]
extern "C" fn ExceptionHandler(_: &TrapFrame) -> ! {
    super::print::text("fault\n");
    semihosting::process::exit(102)
}
