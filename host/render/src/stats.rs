//! What a rendering cost, counted.

use crate::scheduler::Policy;
use crate::tile::TileSize;
use octray_core::observe::{Counters, RayKind};
use serde::Serialize;

/// Rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Rays {
    /// From the eye.
    pub primary: u64,
    /// Towards a light.
    pub shadow: u64,
    /// Those of them that met something on the way.
    pub blocked: u64,
    /// Mirrored.
    pub reflected: u64,
    /// Passed on through a transparent surface.
    pub transmitted: u64,
}

impl Rays {
    /// Those that were counted.
    pub fn of(counters: &Counters) -> Self {
        Self {
            primary: counters.rays_of(RayKind::Primary),
            shadow: counters.rays_of(RayKind::Shadow),
            blocked: counters.blocked,
            reflected: counters.rays_of(RayKind::Reflected),
            transmitted: counters.rays_of(RayKind::Transmitted),
        }
    }

    /// All rays; the blocked ones are among the shadow rays.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflected + self.transmitted
    }
}

/// How threads did the work.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Work {
    /// Threads that traced.
    pub threads: usize,
    /// How tiles were dealt to them.
    pub schedule: Policy,
    /// How large tiles were.
    pub tile: TileSize,
    /// How many there were.
    pub tiles: usize,
    /// What went between the ranks of an MPI job, if it was one; a rank counts as a thread.
    pub messages: Option<Messages>,
    /// For how many seconds each thread had nothing to work on, from the start of all to the end of the last.
    pub idle: Vec<f64>,
}

/// Tiles that came back to the first rank of an MPI job.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Messages {
    /// How many.
    pub count: u64,
    /// Their bytes.
    pub bytes: u64,
    /// For how many seconds the first rank took tiles back and handed out others.
    pub seconds: f64,
    /// Instructions ([`crate::cost`]) that a rank traces while the first one does that with one tile: for
    /// `octray schedule --messages --hand-out`.
    pub hand_out: f64,
}
