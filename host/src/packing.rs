//! How a picture is packed for threads: the shape of packets and the policy that deals them, where the user
//! leaves that open.
//!
//! A coarse probe tells what parts of the picture cost; the simulation ([`crate::simulate`]) tells how long the
//! threads would take with each packing. Nothing depends on time measured: a scene is packed alike each time.
//!
//! By estimate all that takes less than 0.3 % of the time that the threads take to trace; as caches are cold then, it was
//! 0.4 % of figure 19 on two threads. Where even the smallest probe takes longer (512 x 512 pixels on more than four
//! threads) nothing is probed: tiles dealt dynamically, so small that each thread gets a good many of them, waste less
//! than finding out would.

mod search;

use crate::cost::{CostMap, dearest_first};
use crate::deal::Policy;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::job::WorkOptions;
use crate::packets::Shape;
use octray_core::frame::Region;
use octray_engine::{Built, Engine};
use search::Search;
use serde::Serialize;
use std::num::{NonZeroU32, NonZeroUsize};
use std::time::Instant;

/// Instructions that each packet costs its thread beyond its pixels: those that Callgrind counts of a picture
/// in packets of one pixel beyond the same in whole rows.
pub const PER_PACKET: f64 = 1300.0;

/// Instructions that a thread could do while a packet that is handed out to it keeps the others from theirs:
/// 11 ns, as two threads took that did nothing but draw packets.
pub const HAND_OUT: f64 = 100.0;

/// The same where packets are dealt by messages to the ranks of an MPI job: 0.65 us, as the statistics of such a
/// rendering tell for two ranks on one machine.
pub const MESSAGE: f64 = 8200.0;

/// The time for probing, and the time for simulating, as shares of the time for tracing on all threads.
const SHARE: f64 = 0.001;

/// Pixels that are probed at least: with fewer, nothing is known of what parts of the picture cost.
const FEWEST: f64 = 64.0;

/// Pixels that are probed at most.
const MOST: f64 = 1024.0;

/// Instructions to simulate that a processor asks for a packet, the packet's cost being looked up: what Callgrind
/// counts in [`Search::best`].
const EVENT: f64 = 600.0;

/// A packing that wastes no more than this share of the time is not worth improving.
const WASTE: f64 = 0.002;

/// What is taken if nothing is to be chosen, and what is tried first else.
pub const FIXED: (Policy, Shape) = (
    Policy::Dynamic,
    Shape::tile(const { NonZeroU32::new(16).unwrap() }),
);

/// The policies to choose from; among equally good ones the first, which relies the least on estimates.
const POLICIES: [Policy; 6] = [
    Policy::Dynamic,
    Policy::Guided,
    Policy::WorkStealing,
    Policy::CostOrdered,
    Policy::Static,
    Policy::Prescheduled,
];

/// Sides of tiles to choose from. Among equally good shapes the first is taken, and rays that are near each
/// other find the same objects: with 16 x 16 pixels the figures take the fewest instructions.
const TILES: [u32; 4] = [16, 8, 32, 64];

/// Without a probe the first side of tiles with which each thread gets so many: in the figures the loss at the end is
/// then about as large as what more packets would cost.
const UNPROBED: [(u32, usize); 3] = [(16, 64), (8, 24), (4, 0)];

/// Rows of strips to choose from, after tiles.
const STRIPS: [u32; 5] = [1, 2, 4, 8, 16];

/// How a picture is packed.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    /// Which thread gets which packet.
    pub policy: Policy,
    /// How large packets are.
    pub shape: Shape,
    /// The packets from the dearest to the cheapest if the policy asks for it, else nothing.
    pub order: Vec<u32>,
    /// Why, if it was chosen.
    pub forecast: Option<Forecast>,
}

/// Why a packing was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Forecast {
    /// Pixels that were traced to find out what parts of the picture cost.
    pub probed: u64,
    /// Packings that were simulated.
    pub simulated: usize,
    /// Seconds for both.
    pub seconds: f64,
    /// The speed-up that the simulation expects, the time for the probe included.
    pub speed_up: f64,
    /// The speed-up that it expects of [`FIXED`] without a probe.
    pub fixed: f64,
}

/// Packs a region of the picture for as many threads as there are, in the way that is asked for where it is.
///
/// # Errors
/// [`Error::Interrupted`] if it was.
pub fn choose(
    engine: &dyn Engine,
    region: &Region,
    work: &WorkOptions,
    interrupt: &Interrupt,
) -> Result<Packing, Error> {
    let built = engine.built();
    let mut policy = work.policy.unwrap_or(FIXED.0);
    let mut shape = work.packet.unwrap_or(unprobed(region, work));
    let open = (work.policy.is_none() || work.packet.is_none()) && is_worth_a_probe(built, work);
    if work.threads.get() == 1 || !(open || policy == Policy::CostOrdered) {
        return Ok(Packing {
            policy,
            shape,
            order: Vec::new(),
            forecast: None,
        });
    }
    let begin = Instant::now();
    let apart = apart(built, work.threads);
    let cell = NonZeroU32::new(apart * built.block).unwrap_or(NonZeroU32::MIN);
    let map = CostMap::probe(engine, cell, interrupt)?;
    let search = Search {
        map: &map,
        region,
        threads: work.threads,
        messages: work.mpi,
        serial: map.cost(region) / f64::from(apart).powi(2),
    };
    let mut forecast = None;
    if open {
        let candidates = candidates(work, built.block);
        let (best, fixed, simulated) = search.best(&candidates);
        (policy, shape) = (best.policy, best.shape);
        forecast = Some(Forecast {
            probed: map.cells() as u64,
            simulated,
            speed_up: best.speed_up(search.serial),
            fixed: fixed.speed_up(0.0),
            seconds: begin.elapsed().as_secs_f64(),
        });
    }
    let order = match policy {
        Policy::CostOrdered => dearest_first(&search.estimates(shape)),
        _ => Vec::new(),
    };
    Ok(Packing {
        policy,
        shape,
        order,
        forecast,
    })
}

/// The packets to take without a probe.
fn unprobed(region: &Region, work: &WorkOptions) -> Shape {
    // A message costs so much that more of them gain nothing.
    if work.threads.get() == 1 || work.mpi {
        return FIXED.1;
    }
    let mut sides = UNPROBED.into_iter().filter_map(|(side, packets)| {
        let shape = Shape::tile(NonZeroU32::new(side)?);
        (shape.count(region) / work.threads >= packets).then_some(shape)
    });
    sides.next().unwrap_or(FIXED.1)
}

/// Whether the smallest probe takes no more than its share of the time.
fn is_worth_a_probe(built: &Built, work: &WorkOptions) -> bool {
    FEWEST * work.threads.get() as f64 <= SHARE * blocks(built)
}

/// How many blocks there are that one ray colours.
fn blocks(built: &Built) -> f64 {
    let Region { columns, rows } = &built.active;
    columns.len() as f64 * rows.len() as f64 / f64::from(built.block).powi(2)
}

/// How many blocks the probed ones are apart.
fn apart(built: &Built, threads: NonZeroUsize) -> u32 {
    let share = threads.get() as f64 / SHARE;
    let one_in = share.max(blocks(built) / MOST).min(blocks(built) / FEWEST);
    one_in.sqrt().max(1.0) as u32
}

/// All ways to pack that the user leaves open, those that are to be preferred first.
fn candidates(work: &WorkOptions, block: u32) -> Vec<(Policy, Shape)> {
    let sides = |all: &'static [u32]| {
        let whole = all.iter().filter(move |side| **side >= block);
        whole.filter_map(|side| NonZeroU32::new(*side))
    };
    let shapes = match work.packet {
        Some(shape) => vec![shape],
        None => (sides(&TILES).map(Shape::tile))
            .chain(sides(&STRIPS).map(Shape::strip))
            .collect(),
    };
    let policies = match work.policy {
        Some(policy) => vec![policy],
        None => POLICIES.to_vec(),
    };
    let all = |policy| shapes.iter().map(move |shape| (policy, *shape));
    policies.into_iter().flat_map(all).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_engine::options::{Arith, PixelsPerRay, Tree, TreeOptions, ViewOptions};
    use octray_scenes::model::Scene;

    /// A ball in a corner of a picture of 128 x 128 pixels.
    const BALL: &str = "v 0 0 -300 resolution 128 128 l 0 0 -300 1
        f 1 1 1 1 1 1 0 0 0 0 0 0 s -30 30 40 30 p 4 -60 -60 60 60 -60 60 60 60 60 -60 60 60";

    fn scene() -> Scene {
        octray_scenes::parse::parse(BALL).unwrap()
    }

    fn engine(scene: &Scene, size: u32, pixels_per_ray: PixelsPerRay) -> Box<dyn Engine> {
        let tree = TreeOptions::of(Tree::Tight);
        let view = ViewOptions {
            size: Some((size, size)),
            pixels_per_ray,
            samples: 1,
            max_depth: 8,
            cut_off: 0.0,
        };
        octray_engine::build(scene, Arith::F32, &tree, &view).unwrap()
    }

    /// In a picture so large that its choice is worth a probe on up to seven threads.
    fn packing(work: &WorkOptions) -> Packing {
        packing_at(1000, work)
    }

    fn packing_at(size: u32, work: &WorkOptions) -> Packing {
        let engine = engine(&scene(), size, PixelsPerRay::One);
        let region = engine.built().region();
        choose(&*engine, &region, work, &Interrupt::new()).unwrap()
    }

    fn work(threads: usize, policy: Option<Policy>, rows: Option<u32>) -> WorkOptions {
        WorkOptions {
            threads: NonZeroUsize::new(threads).unwrap(),
            policy,
            packet: rows.and_then(NonZeroU32::new).map(Shape::strip),
            pin: false,
            mpi: false,
        }
    }

    #[test]
    fn what_is_asked_for_is_taken() {
        for policy in [Policy::Static, Policy::CostOrdered] {
            let packing = packing(&work(2, Some(policy), Some(3)));
            assert_eq!(packing.policy, policy);
            assert_eq!(packing.shape.to_string(), "3 rows");
            assert_eq!(packing.forecast, None);
            let ordered = packing.order.len();
            assert_eq!(ordered > 0, policy == Policy::CostOrdered);
        }
        let only_policy = packing(&work(2, Some(Policy::Static), None));
        assert_eq!(only_policy.policy, Policy::Static);
        assert!(only_policy.forecast.is_some());
        let only_shape = packing(&work(2, None, Some(3)));
        assert_eq!(only_shape.shape.to_string(), "3 rows");
        assert!(only_shape.forecast.is_some());
    }

    #[test]
    fn one_thread_needs_no_choice() {
        let packing = packing(&work(1, None, None));
        assert_eq!((packing.policy, packing.shape), FIXED);
        assert_eq!(packing.forecast, None);
    }

    #[test]
    fn the_choice_is_as_good_as_what_needs_no_probe_but_for_the_probe() {
        for threads in [2, 3, 7] {
            let forecast = packing(&work(threads, None, None)).forecast.unwrap();
            assert!(forecast.speed_up <= threads as f64, "{forecast:?}");
            assert!(forecast.speed_up > forecast.fixed * 0.997, "{forecast:?}");
        }
    }

    #[test]
    fn the_probe_takes_its_share_and_sees_enough() {
        for size in [8, 128, 1000, 4000] {
            let engine = engine(&scene(), size, PixelsPerRay::One);
            let blocks = blocks(engine.built());
            for threads in [2, 7, 100, 65_536] {
                let probed = |apart: u32| blocks / f64::from(apart).powi(2);
                let work = work(threads, None, None);
                let apart = apart(engine.built(), work.threads);
                assert!(probed(apart) >= FEWEST.min(blocks), "{size} {threads}");
                assert!(apart == 1 || probed(apart + 1) <= MOST, "{size} {threads}");
                if is_worth_a_probe(engine.built(), &work) {
                    let share = probed(apart + 1) / blocks * threads as f64;
                    assert!(share <= SHARE, "{size} {threads}: {share}");
                }
            }
        }
    }

    #[test]
    fn without_a_probe_every_thread_gets_a_good_many_tiles() {
        // The square is 625 pixels wide.
        let shape = |threads| {
            let packing = packing_at(1000, &work(threads, None, None));
            assert_eq!(packing.forecast, None, "{threads}");
            packing.shape.to_string()
        };
        assert_eq!(shape(20), "16 x 16 pixels");
        assert_eq!(shape(100), "8 x 8 pixels");
        assert_eq!(shape(65_536), "4 x 4 pixels");
        let ordered = packing_at(128, &work(20, Some(Policy::CostOrdered), None));
        assert_eq!(ordered.forecast, None);
        assert!(!ordered.order.is_empty());
        let ranks = WorkOptions {
            mpi: true,
            ..work(100, None, None)
        };
        assert_eq!(packing_at(128, &ranks).shape, FIXED.1);
    }

    #[test]
    fn a_scene_is_packed_alike_each_time() {
        let all = || {
            let packing = packing(&work(7, None, None));
            (
                packing.policy,
                packing.shape,
                packing.forecast.map(|f| f.speed_up),
            )
        };
        assert_eq!(all(), all());
    }

    #[test]
    fn blocks_that_one_ray_colours_are_not_cut() {
        for (_, shape) in candidates(&work(2, None, None), 2) {
            let sides = [Some(shape.rows), shape.columns];
            assert!(
                sides.iter().flatten().all(|side| side.get() % 2 == 0),
                "{shape}"
            );
        }
    }

    #[test]
    fn nothing_to_see_is_packed_all_the_same() {
        let scene = octray_scenes::parse::parse("v 0 0 -9 resolution 8 8").unwrap();
        let engine = engine(&scene, 8, PixelsPerRay::Four);
        let region = engine.built().region();
        for policy in [None, Some(Policy::CostOrdered)] {
            let work = work(4, policy, None);
            let packing = choose(&*engine, &region, &work, &Interrupt::new()).unwrap();
            assert_eq!(packing.forecast, None);
        }
    }
}
