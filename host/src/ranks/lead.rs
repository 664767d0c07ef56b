//! The first rank: sends the work to the others, hands out tiles, receives results, and traces meanwhile.

use super::{
    COUNTS, NONE, RESULT, RankCounts, RankJob, TILE, arrived, broadcast, buffer, failed, pause,
};
use crate::job::RenderJob;
use mpi::point_to_point::{MatchedReceiveVec, Message, Status};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination};
use octray_core::frame::Region;
use octray_core::observe::Counters;
use octray_render::cost;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::picture::Picture;
use octray_render::progress::Progress;
use octray_render::render;
use octray_render::render::Rendering;
use octray_render::renderer::{self, Renderer};
use octray_render::schedule::Schedule;
use octray_render::scheduler::Scheduler;
use octray_render::stats::{Messages, Work};
use octray_render::tile::TileBuffer;
use octray_scenes::model::Scene;
use std::borrow::Cow;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// The first rank.
pub(super) struct Leader<'a> {
    world: &'a SimpleCommunicator,
    state: State,
}

/// The state of the other ranks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// They wait for the scene.
    Waiting,
    /// They trace.
    Working,
    /// They have finished.
    Done,
}

impl<'a> Leader<'a> {
    pub(super) fn new(world: &'a SimpleCommunicator) -> Self {
        let state = State::Waiting;
        Self { world, state }
    }

    /// Whether the others still wait for the scene.
    pub(super) fn others_wait(&self) -> bool {
        self.state == State::Waiting
    }

    /// Whether no other rank is working.
    pub(super) fn others_idle(&self) -> bool {
        self.state != State::Working
    }

    /// Traces the job together with the others.
    ///
    /// # Errors
    /// Those of [`render::render_with`], and [`Error::Failed`] for an invalid message.
    pub(super) fn trace(
        &mut self,
        scene: &Scene,
        job: &RenderJob,
        progress: &dyn Progress,
        interrupt: &Interrupt,
    ) -> Result<Rendering, Error> {
        let begin = Instant::now();
        let renderer = renderer::prepare(scene, &job.settings)?;
        let build = begin.elapsed();
        let begin = Instant::now();
        let (mut picture, region) = render::blank(&*renderer, job.output.holds_intensities())?;
        let ranks = self.world.size() as usize;
        let threads = NonZeroUsize::new(ranks).unwrap_or(NonZeroUsize::MIN);
        // A message is too expensive for smaller tiles to pay.
        let shape = (job.work.tile).unwrap_or_else(|| Schedule::largest(renderer.built().block));
        let parts: Vec<_> = shape.cut(&region).collect();
        let order = render::order(&*renderer, job.work.policy, &parts, interrupt)?;
        let intensities = job.output.holds_intensities();
        if parts
            .first()
            .is_some_and(|part| buffer(part, intensities).is_none())
        {
            let why = format!("tiles of {shape} are too large for a message: choose smaller ones");
            return Err(failed(why));
        }
        let rank_job = RankJob {
            scene: Cow::Borrowed(scene),
            settings: job.settings,
            shape,
            intensities,
        };
        broadcast(self.world, Some(&rank_job));
        self.state = State::Working;
        // As with threads, time before the first tile counts neither as idle nor as rendering.
        let tracing = Instant::now();
        let count = parts.len();
        progress.start(count);
        let (own, mut messages, all_counts) = {
            let mut dispatcher = Dispatcher {
                world: self.world,
                scheduler: Scheduler::new(job.work.policy, count, threads, order),
                parts,
                picture: &mut picture,
                progress,
                messages: Messages::default(),
                all_counts: vec![None; ranks],
            };
            let own = dispatcher.run(&*renderer, interrupt)?;
            (own, dispatcher.messages, dispatcher.all_counts)
        };
        self.state = State::Done;
        let tracing = tracing.elapsed().as_secs_f64();
        let (mut counters, mut saturations) = (Counters::default(), 0);
        let all_counts: Vec<_> = all_counts.into_iter().map(|it| it.unwrap_or(own)).collect();
        for counts in &all_counts {
            counters.add(&counts.counters());
            saturations += counts.saturations;
        }
        let busy: f64 = all_counts.iter().map(|counts| counts.busy).sum();
        if busy > 0.0 && messages.count > 0 {
            let share = messages.seconds / messages.count as f64 / busy;
            messages.hand_out = share * cost::cost(&counters);
        }
        let times = (build, begin.elapsed());
        let idle = |counts: &RankCounts| (tracing - counts.busy).max(0.0);
        let work = Work {
            threads: ranks,
            schedule: job.work.policy,
            tile: shape,
            tiles: count,
            messages: Some(messages),
            idle: all_counts.iter().map(idle).collect(),
        };
        let built = renderer.built();
        Ok(render::rendering(
            built,
            picture,
            counters,
            saturations,
            times,
            work,
        ))
    }
}

/// Hands out tiles and receives results.
struct Dispatcher<'a> {
    world: &'a SimpleCommunicator,
    scheduler: Scheduler,
    parts: Vec<Region>,
    picture: &'a mut Picture,
    progress: &'a dyn Progress,
    messages: Messages,
    /// The counts of the ranks that have finished.
    all_counts: Vec<Option<RankCounts>>,
}

impl Dispatcher<'_> {
    /// Traces tiles, and answers the other ranks between them, until all have finished. Returns what this rank did.
    fn run(&mut self, renderer: &dyn Renderer, interrupt: &Interrupt) -> Result<RankCounts, Error> {
        let mut worker = renderer.worker(interrupt);
        let mut busy = Duration::ZERO;
        loop {
            interrupt.check()?;
            while let Some((message, status)) = arrived(&self.world.any_process()) {
                self.answer(message, status)?;
            }
            let next = self.scheduler.next(0);
            if let Some(assignment) = next {
                let begin = Instant::now();
                let mut part = self.part(assignment.tile);
                worker.trace(part.tile());
                interrupt.check()?;
                busy += begin.elapsed();
                self.picture.put(&part);
                self.progress.step();
            } else if self.all_counts.iter().skip(1).all(Option::is_some) {
                let (counters, saturations) = (worker.counters(), worker.saturations());
                return Ok(RankCounts::new(counters, saturations, busy));
            } else {
                pause();
            }
        }
    }

    /// Receives a message of a rank and sends it the next tile.
    fn answer(&mut self, message: Message, status: Status) -> Result<(), Error> {
        let begin = Instant::now();
        let (rank, tag) = (status.source_rank(), status.tag());
        let nonsense = || failed(format!("rank {rank} sent an invalid message"));
        let (bytes, _) = (message, status).matched_receive_vec::<u8>();
        if tag == COUNTS {
            let counts = postcard::from_bytes(&bytes).map_err(|_| nonsense())?;
            self.all_counts[rank as usize] = Some(counts);
            return Ok(());
        }
        if tag == RESULT {
            self.keep(&bytes).ok_or_else(nonsense)?;
            self.progress.step();
        }
        let next = self.scheduler.next(rank as usize);
        let next = next.map_or(NONE, |assignment| assignment.tile as u32);
        let to = self.world.process_at_rank(rank);
        to.send_with_tag(&next.to_le_bytes()[..], TILE);
        self.messages.count += u64::from(tag == RESULT);
        self.messages.bytes += bytes.len() as u64;
        self.messages.seconds += begin.elapsed().as_secs_f64();
        Ok(())
    }

    /// Returns an empty buffer for a tile.
    fn part(&self, index: usize) -> TileBuffer {
        TileBuffer::black(
            self.parts[index].clone(),
            self.picture.intensities().is_some(),
        )
    }

    /// Copies a received tile into the picture; `None` if the message is invalid.
    fn keep(&mut self, bytes: &[u8]) -> Option<()> {
        let (index, pixels) = bytes.split_first_chunk()?;
        let index = u32::from_le_bytes(*index) as usize;
        self.parts.get(index)?;
        let mut part = self.part(index);
        let (coarse, fine) = pixels.split_at_checked(3 * part.levels.len())?;
        part.levels.as_flattened_mut().copy_from_slice(coarse);
        let (fine, rest) = fine.as_chunks();
        let mut fine = fine.iter().map(|bytes| f32::from_le_bytes(*bytes));
        for value in part.intensities.iter_mut().flatten().flatten() {
            *value = fine.next()?;
        }
        let whole = rest.is_empty() && fine.next().is_none();
        whole.then(|| self.picture.put(&part))
    }
}
