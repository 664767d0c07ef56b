//! Prints text and numbers by semihosting, without the formatting machinery, which would not fit. Reports panics.

use core::panic::PanicInfo;
use semihosting::process::exit;
use semihosting::sys::arm_compat::sys_writec;

/// Prints a text.
pub(super) fn text(text: &str) {
    for byte in text.bytes() {
        sys_writec(byte);
    }
}

/// Prints a name and a number on a line of their own.
pub(super) fn number(name: &str, number: u32) {
    text("\n");
    text(name);
    text(" ");
    digits(number);
}

/// Prints a decimal number by subtraction: a division would link the library's routine on cores without the
/// instruction.
fn digits(mut number: u32) {
    let mut begun = false;
    for exponent in (0..10).rev() {
        let power = 10u32.pow(exponent);
        let mut digit = b'0';
        while number >= power {
            number -= power;
            digit += 1;
        }
        begun |= digit != b'0' || exponent == 0;
        if begun {
            sys_writec(digit);
        }
    }
}

/// Prints sixteen hexadecimal digits.
pub(super) fn hexadecimal(number: u64) {
    for nibble in (0..16).rev() {
        let digit = (number >> (4 * nibble)) as u8 & 15;
        sys_writec(digit + if digit < 10 { b'0' } else { b'a' - 10 });
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    text("panic\n");
    exit(101)
}
