//! What every rank but the first does: trace what it is told to.

use super::{IN_HAND, NONE, PACKET, Plan, REQUEST, RESULT, TALLY, Tally, arrived, failed, pause};
use crate::error::Error;
use crate::interrupt::Interrupt;
use mpi::point_to_point::MatchedReceiveVec;
use mpi::topology::{Process, SimpleCommunicator};
use mpi::traits::{Communicator, Destination};
use octray_core::packet::Region;
use octray_core::scalar;
use octray_engine::packet::Packet;
use octray_engine::{self as engine, Worker};
use std::time::{Duration, Instant};

/// Works for the first rank until there is nothing left.
///
/// # Errors
/// [`Error::Interrupted`] if it was, [`Error::Failed`] when there is no memory for the scene or messages make
/// no sense.
pub(super) fn serve(world: &SimpleCommunicator, interrupt: &Interrupt) -> Result<(), Error> {
    let bytes = super::receive_broadcast(world);
    let plan: Option<Plan<'_>> = postcard::from_bytes(&bytes)
        .map_err(|cause| failed(format!("the scene did not arrive whole: {cause}")))?;
    let Some(plan) = plan else {
        return Ok(());
    };
    drop(bytes);
    let engine = engine::build(&plan.scene, plan.arith, &plan.tree, &plan.view)?;
    let region = engine.built().region();
    let parts: Vec<_> = plan.shape.cut(&region).collect();
    let leader = world.process_at_rank(0);
    let mut worker = engine.worker();
    let mut busy = Duration::ZERO;
    let before = scalar::saturations();
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
        let part = part.ok_or_else(|| failed(format!("there is no packet {index}")))?;
        let begin = Instant::now();
        let message = trace(&mut *worker, index, part, plan.intensities);
        busy += begin.elapsed();
        leader.send_with_tag(&message[..], RESULT);
    }
    let saturations = scalar::saturations().wrapping_sub(before);
    let tally = Tally::new(worker.counters(), saturations, busy);
    let bytes = postcard::to_stdvec(&tally).map_err(|cause| failed(cause.to_string()))?;
    leader.send_with_tag(&bytes[..], TALLY);
    Ok(())
}

/// The number of the next packet, or [`NONE`], as soon as it comes.
fn next(leader: &Process<'_>, interrupt: &Interrupt) -> Result<u32, Error> {
    loop {
        interrupt.check()?;
        let Some(arrived) = arrived(leader) else {
            pause();
            continue;
        };
        let (bytes, status) = arrived.matched_receive_vec::<u8>();
        return match <[u8; 4]>::try_from(bytes) {
            Ok(bytes) if status.tag() == PACKET => Ok(u32::from_le_bytes(bytes)),
            _ => Err(failed("a message makes no sense".into())),
        };
    }
}

/// A packet traced: its number, its levels and its intensities if they are wanted.
fn trace(worker: &mut dyn Worker, index: u32, part: &Region, intensities: bool) -> Vec<u8> {
    let (width, height) = (part.columns.len(), part.rows.len());
    let mut levels = vec![[0; 3]; width * height];
    let mut fine = intensities.then(|| vec![[0.0; 3]; width * height]);
    worker.trace(Packet {
        region: part.clone(),
        levels: levels.chunks_mut(width).collect(),
        intensities: fine.as_mut().map(|fine| fine.chunks_mut(width).collect()),
    });
    let mut message = index.to_le_bytes().to_vec();
    message.extend_from_slice(levels.as_flattened());
    for value in fine.iter().flatten().flatten() {
        message.extend_from_slice(&f32::to_le_bytes(*value));
    }
    message
}
