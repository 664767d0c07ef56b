//! What a fixed-point format does when a result leaves its range.

/// Whether sums and products of a fixed-point format are checked, and who counts those that had to
/// be clamped to the format's range.
///
/// Core keeps no count of its own: it has neither threads nor statics. An implementation with an
/// operating system keeps one for each thread, so that two renderings in one process are counted
/// apart; `()` checks and counts nothing and costs nothing.
pub trait SaturationCounter: 'static {
    /// Whether sums and products are checked at all. Unchecked ones wrap, in fewer instructions.
    const CHECKED: bool;

    /// One result was clamped.
    fn saturated();
}

/// Nothing is checked: for boards, whose scenes are proved not to overflow beforehand.
impl SaturationCounter for () {
    const CHECKED: bool = false;

    #[inline(always)]
    fn saturated() {}
}
