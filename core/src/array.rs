//! Arrays of three, element by element.

/// The array of what `f` returns for each element, inlined wherever it is used.
///
/// The standard library's `map` calls `f` through functions that end in other codegen units than the caller. Hosts are
/// built without link-time optimisation, which would put them together again. Firmware is built with it, and keeps the
/// code that its records were measured with.
#[inline(always)]
pub(crate) fn map3<T, U>(all: [T; 3], f: impl Fn(T) -> U) -> [U; 3] {
    #[cfg(target_os = "none")]
    return all.map(f);
    #[cfg(not(target_os = "none"))]
    {
        let [a, b, c] = all;
        [f(a), f(b), f(c)]
    }
}
