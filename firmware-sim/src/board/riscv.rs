//! RISC-V: start-up by riscv-rt, which also switches the floating-point unit on.

use riscv_rt::{TrapFrame, entry};

#[entry]
fn main() -> ! {
    super::run()
}

/// Called for every exception, as none has a handler of its own.
#[unsafe(no_mangle)]
extern "C" fn ExceptionHandler(_: &TrapFrame) -> ! {
    super::tell::text("fault\n");
    semihosting::process::exit(102)
}
