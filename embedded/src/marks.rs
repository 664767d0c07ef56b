//! Marks around what is to be measured. `octray measure --elf` counts the instructions between them, whatever the
//! program does there.

/// Counts from here on, until [`end`].
///
/// ```no_run
/// # fn filter() {}
/// use octray_embedded::marks::{begin, end};
///
/// begin();
/// filter();
/// end();
/// ```
#[inline(always)]
pub fn begin() {
    octray_begin();
}

/// Counts no more, until [`begin`].
#[inline(always)]
pub fn end() {
    octray_end();
}

/// What the emulator's plugin looks for.
#[allow(unsafe_code, reason = "the linker's names")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn octray_begin() {
    // The barrier keeps the linker from folding it with `octray_end`.
    core::hint::black_box(1u32);
}

#[allow(unsafe_code, reason = "the linker's names")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn octray_end() {
    core::hint::black_box(2u32);
}

/// Evaluates an expression between marks of a name of its own, so that several parts of a program are counted in one run.
/// A name can be used once in a program; the part may be run many times.
///
/// ```no_run
/// # fn filter(_: u32) -> u32 { 0 }
/// let filtered = octray_embedded::marked!(filter, filter(7));
/// ```
#[macro_export]
macro_rules! marked {
    ($name:ident, $part:expr) => {{
        mod marks {
            #[unsafe(export_name = concat!("octray_begin_", stringify!($name)))]
            #[inline(never)]
            pub extern "C" fn begin() {
                ::core::hint::black_box(stringify!($name));
            }

            #[unsafe(export_name = concat!("octray_end_", stringify!($name)))]
            #[inline(never)]
            pub extern "C" fn end() {
                ::core::hint::black_box((stringify!($name), 1u8));
            }
        }
        marks::begin();
        let result = $part;
        marks::end();
        result
    }};
}
