//! Cortex-M: start-up by cortex-m-rt, which also switches the floating-point unit on.

use cortex_m_rt::{ExceptionFrame, entry, exception};

#[entry]
fn main() -> ! {
    super::run()
}

#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    super::tell::text("fault\n");
    semihosting::process::exit(102)
}
