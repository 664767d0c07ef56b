//! Cortex-M: cortex-m-rt starts the program and enables the floating-point unit.

use cortex_m_rt::{ExceptionFrame, entry, exception};

#[entry]
fn main() -> ! {
    super::run()
}

#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    super::fault()
}
