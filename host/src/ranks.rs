//! Distributes a picture over the ranks of an MPI job. The first rank reads the scene, hands out tiles, traces some
//! itself and writes the picture; the other ranks need no files.
//!
//! The parsed scene is broadcast once. A rank holds two tiles, so that it need not wait for the next one while a result
//! is in flight, and sends its results from a buffer, so that it need not wait until they are received. Every rank
//! traces on one thread; the first rank answers the others between its own tiles. If a rank dies, `mpirun` reports it
//! and ends the others; a picture is written only when it is complete.

mod lead;
mod serve;

use crate::job::RenderJob;
use crate::render;
use lead::Leader;
use mpi::point_to_point::{Message, Status};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Root, Source};
use octray_core::frame::Region;
use octray_core::observe::{Counters, QueryCounts};
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::tile::TileSize;
use octray_render::tile::{Intensity, Level};
use octray_scenes::model::Scene;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::thread;
use std::time::Duration;

/// Tag of a rank's first requests for a tile.
const REQUEST: i32 = 1;
/// Tag of a traced tile: its number and its pixels. It also requests another tile.
const RESULT: i32 = 2;
/// Tag of a rank's counts, sent when it has no more tiles.
const COUNTS: i32 = 3;
/// Tag of the number of a tile to trace, or [`NONE`].
const TILE: i32 = 4;

/// The number that means that no tile is left.
const NONE: u32 = u32::MAX;

/// Number of tiles that a rank holds.
const IN_HAND: usize = 2;

/// Bytes that a buffered message takes beyond its contents: at least MPI_BSEND_OVERHEAD, which is 128 or less in known
/// MPI libraries.
const OVERHEAD: usize = 512;

/// How long a rank sleeps when there is no message.
const PAUSE: Duration = Duration::from_micros(20);

/// The work of a rank.
#[derive(Serialize, Deserialize)]
struct RankJob<'a> {
    scene: Cow<'a, Scene>,
    settings: RenderSettings,
    shape: TileSize,
    /// Whether intensities are returned beside levels.
    intensities: bool,
}

/// What a rank counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct RankCounts {
    rays: [u64; 4],
    hits: [u64; 4],
    blocked: u64,
    /// Steps, children, outlines, edges, sides, tests and hits of [`octray_core::observe::QueryCounts`].
    searches: [([u64; 5], [u64; 5], [u64; 5]); 2],
    deepest: u64,
    saturations: u64,
    /// Rays and nodes that exceeded a capacity, and shadow rays to lights beyond the shadow cache.
    dropped: [u64; 3],
    /// Seconds of tracing.
    busy: f64,
}

impl RankCounts {
    fn new(counters: &Counters, saturations: u64, busy: Duration) -> Self {
        Self {
            rays: counters.rays,
            hits: counters.hits,
            blocked: counters.blocked,
            searches: counters.queries.map(|search| {
                let QueryCounts {
                    steps,
                    children,
                    outlines,
                    edges,
                    sides,
                    tests,
                    met,
                    ..
                } = search;
                ([steps, children, outlines, edges, sides], tests, met)
            }),
            deepest: counters.deepest,
            saturations,
            dropped: {
                let dropped = counters.dropped;
                [dropped.rays, dropped.children, dropped.uncached]
            },
            busy: busy.as_secs_f64(),
        }
    }

    fn counters(&self) -> Counters {
        let mut all = Counters::default();
        all.rays = self.rays;
        all.blocked = self.blocked;
        all.hits = self.hits;
        all.deepest = self.deepest;
        [all.dropped.rays, all.dropped.children, all.dropped.uncached] = self.dropped;
        for (query, (counts, tests, met)) in all.queries.iter_mut().zip(self.searches) {
            [
                query.steps,
                query.children,
                query.outlines,
                query.edges,
                query.sides,
            ] = counts;
            (query.tests, query.met) = (tests, met);
        }
        all
    }
}

/// Runs `job` together with the other ranks; every rank calls this.
///
/// # Errors
/// On the first rank those of [`render::run`]. [`Error::Failed`] if MPI cannot be started, or the ranks are ended
/// before the picture is complete.
pub fn render(job: &RenderJob, interrupt: &Interrupt) -> Result<(), Error> {
    let mut universe = mpi::initialize().ok_or_else(|| failed("MPI cannot be started".into()))?;
    let world = universe.world();
    let done = match world.rank() {
        0 => {
            let mut leader = Leader::new(&world);
            let done = render::run(job, interrupt, |scene, job, progress, interrupt| {
                leader.trace(scene, job, progress, interrupt)
            });
            if leader.others_wait() {
                broadcast::<RankJob<'_>>(&world, None);
            }
            match leader.others_idle() {
                true => done,
                false => return exit_without_others(universe, done),
            }
        }
        rank => match serve::serve(&mut universe, interrupt) {
            Ok(()) => Ok(()),
            // The first rank reports it.
            Err(Error::Interrupted) => std::process::exit(crate::signal::INTERRUPTED.into()),
            Err(error) => {
                let failure = Err(failed(format!("rank {rank}: {error}")));
                return exit_without_others(universe, failure);
            }
        },
    };
    drop(universe);
    done
}

/// Ends without MPI's shutdown, because ranks that still work would never take part in it. `mpirun` ends them.
fn exit_without_others(
    universe: mpi::environment::Universe,
    done: Result<(), Error>,
) -> Result<(), Error> {
    std::mem::forget(universe);
    done.map_err(|error| match error {
        Error::Interrupted => failed(
            "the ranks were ended before the picture was complete; mpirun states why; no picture was written"
                .into(),
        ),
        error => error,
    })
}

/// Returns the bytes of a buffer for all results that a rank may have sent without an answer yet, or `None` if MPI
/// cannot count them.
fn buffer(largest: &Region, intensities: bool) -> Option<usize> {
    let pixels = largest.columns.len().checked_mul(largest.rows.len())?;
    let pixel = match intensities {
        true => size_of::<Level>() + size_of::<Intensity>(),
        false => size_of::<Level>(),
    };
    let result = pixels.checked_mul(pixel)?.checked_add(size_of::<u32>())?;
    // Twice the tiles in hand, because MPI may not have freed answered results yet.
    let bytes = (result + OVERHEAD).checked_mul(2 * IN_HAND)?;
    i32::try_from(bytes).is_ok().then_some(bytes)
}

/// Broadcasts a value of the first rank to all others.
fn broadcast<T: Serialize>(world: &SimpleCommunicator, value: Option<&T>) {
    // Serialising fails only for types that postcard does not support; it supports these.
    let mut bytes = postcard::to_stdvec(&value).unwrap_or_default();
    let mut length = bytes.len() as u64;
    let first = world.process_at_rank(0);
    first.broadcast_into(&mut length);
    first.broadcast_into(&mut bytes[..]);
}

/// Receives what the first rank broadcasts.
fn receive_broadcast(world: &SimpleCommunicator) -> Vec<u8> {
    let first = world.process_at_rank(0);
    let mut length = 0_u64;
    first.broadcast_into(&mut length);
    let mut bytes = vec![0; length as usize];
    first.broadcast_into(&mut bytes[..]);
    bytes
}

/// Returns the next message from `source`, if one has arrived.
fn arrived(source: &impl Source) -> Option<(Message, Status)> {
    // The first probe may find nothing and only let MPI make progress: Open MPI probes first, then receives.
    let look = || source.immediate_matched_probe();
    look().or_else(look)
}

fn pause() {
    thread::sleep(PAUSE);
}

fn failed(text: String) -> Error {
    Error::Failed(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_holds_all_results_in_flight() {
        let square = |side| Region {
            columns: 0..side,
            rows: 0..side,
        };
        let results = 2 * IN_HAND;
        assert_eq!(
            buffer(&square(16), false),
            Some(results * (4 + 256 * 3 + OVERHEAD))
        );
        assert_eq!(
            buffer(&square(16), true),
            Some(results * (4 + 256 * 15 + OVERHEAD))
        );
        assert_eq!(buffer(&square(65_535), false), None);
    }
}
