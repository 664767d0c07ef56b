//! The other ranks: each traces the tiles that the first rank assigns to it.

use super::{
    COUNTS, IN_HAND, NONE, REQUEST, RESULT, RankCounts, RankJob, TILE, arrived, buffer, failed,
    pause,
};
use mpi::environment::Universe;
use mpi::point_to_point::MatchedReceiveVec;
use mpi::topology::Process;
use mpi::traits::{Communicator, Destination};
use octray_core::frame::Region;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::renderer::{self, Worker};
use octray_render::tile::TileBuffer;
use std::time::{Duration, Instant};

/// Works for the first rank until no tile is left.
///
/// # Errors
/// [`Error::Interrupted`] after an interrupt, [`Error::Failed`] if there is no memory for the scene or a message is
/// invalid.
pub(super) fn serve(universe: &mut Universe, interrupt: &Interrupt) -> Result<(), Error> {
    let world = universe.world();
    let bytes = super::receive_broadcast(&world);
    let rank_job: Option<RankJob<'_>> = postcard::from_bytes(&bytes)
        .map_err(|cause| failed(format!("the scene arrived incomplete: {cause}")))?;
    let Some(rank_job) = rank_job else {
        return Ok(());
    };
    drop(bytes);
    let renderer = renderer::prepare(&rank_job.scene, &rank_job.settings)?;
    let region = renderer.built().region();
    let parts: Vec<_> = rank_job.shape.cut(&region).collect();
    // The first rank has checked that this buffer is possible.
    let size = parts
        .first()
        .map_or(Some(0), |part| buffer(part, rank_job.intensities));
    universe.set_buffer_size(size.ok_or_else(|| failed("a tile is too large".into()))?);
    let leader = world.process_at_rank(0);
    let mut worker = renderer.worker(interrupt);
    let mut busy = Duration::ZERO;
    let nothing: [u8; 0] = [];
    for _ in 0..IN_HAND {
        leader.send_with_tag(&nothing[..], REQUEST);
    }
    let mut unanswered = IN_HAND;
    while unanswered > 0 {
        let index = next(&leader, interrupt)?;
        if index == NONE {
            unanswered -= 1;
            continue;
        }
        let part = parts.get(index as usize);
        let part = part.ok_or_else(|| failed(format!("there is no tile {index}")))?;
        let begin = Instant::now();
        let message = trace(&mut *worker, index, part, rank_job.intensities);
        interrupt.check()?;
        busy += begin.elapsed();
        // An unbuffered send of more than about 256 bytes blocks until the first rank looks for messages.
        leader.buffered_send_with_tag(&message[..], RESULT);
    }
    let counts = RankCounts::new(worker.counters(), worker.saturations(), busy);
    let bytes = postcard::to_stdvec(&counts).map_err(|cause| failed(cause.to_string()))?;
    leader.send_with_tag(&bytes[..], COUNTS);
    Ok(())
}

/// Waits for the number of the next tile, or [`NONE`].
fn next(leader: &Process<'_>, interrupt: &Interrupt) -> Result<u32, Error> {
    loop {
        interrupt.check()?;
        let Some(arrived) = arrived(leader) else {
            pause();
            continue;
        };
        let (bytes, status) = arrived.matched_receive_vec::<u8>();
        return match <[u8; 4]>::try_from(bytes) {
            Ok(bytes) if status.tag() == TILE => Ok(u32::from_le_bytes(bytes)),
            _ => Err(failed("a message is invalid".into())),
        };
    }
}

/// Traces a tile. Returns the message: its number, its levels and, if requested, its intensities.
fn trace(worker: &mut dyn Worker, index: u32, part: &Region, intensities: bool) -> Vec<u8> {
    let mut part = TileBuffer::black(part.clone(), intensities);
    worker.trace(part.tile());
    let mut message = index.to_le_bytes().to_vec();
    message.extend_from_slice(part.levels.as_flattened());
    for value in part.intensities.iter().flatten().flatten() {
        message.extend_from_slice(&f32::to_le_bytes(*value));
    }
    message
}
