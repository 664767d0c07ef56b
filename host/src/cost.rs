//! What parts of a picture cost to trace: a weighted sum of counted events, which unlike time is the same
//! every time.

use octray_core::observe::{Counters, RayKind};

/// How many events there are weights for.
pub const EVENTS: usize = 6;

/// What is counted, in the order of [`events`] and [`WEIGHTS`].
pub const NAMES: [&str; EVENTS] = [
    "primary ray",
    "reflected or transmitted ray",
    "shadow ray",
    "light in sight",
    "step",
    "test",
];

/// Machine instructions for each event, on x86-64 in f32 with the tight tree: what
/// `cargo bench -p octray --bench weights` fits to instructions counted by Callgrind. Other arithmetics and
/// trees cost more or less, but in much the same places.
pub const WEIGHTS: [f64; EVENTS] = [100.0, 100.0, 100.0, 50.0, 50.0, 100.0];

/// The events that make up the cost of what was counted.
pub fn events(counters: &Counters) -> [u64; EVENTS] {
    let rays = |kind| counters.rays_of(kind);
    [
        rays(RayKind::Primary),
        rays(RayKind::Reflected) + rays(RayKind::Transmitted),
        rays(RayKind::Shadow),
        rays(RayKind::Shadow) - counters.blocked,
        counters.steps,
        counters.tests,
    ]
}

/// The cost of what was counted, in instructions.
pub fn cost(counters: &Counters) -> f64 {
    let events = events(counters).map(|count| count as f64);
    events
        .iter()
        .zip(WEIGHTS)
        .map(|(count, weight)| count * weight)
        .sum()
}
