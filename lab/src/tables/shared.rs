//! The tables of how processors share a picture: VIII and IX, simulated. One ray colours four pixels, as in the thesis.

use super::number::TableNumber;
use super::runs::{Runs, TraceCounts};
use super::subject::{FIGURES, SceneVariant};
use super::table::{Base, Compare, Draft, DraftLine, Quantity};
use super::traced::{BLOCKED, REFLECTED};
use crate::simulate::{Machine, Outcome, simulate};
use octray_core::frame::Region;
use octray_render::cost::CostMap;
use octray_render::error::Error;
use octray_render::scheduler::{Policy, Scheduler};
use octray_render::tile::TileSize;
use std::num::{NonZeroU32, NonZeroUsize};

/// The first lights of each figure, as in the thesis.
pub const LIGHTS: [usize; 5] = [10, 8, 10, 6, 6];

/// The figures of table VIII: 20 and 22.
pub const OF_EIGHT: [usize; 2] = [1, 3];

/// Rows of a tile in table VIII, H in the thesis.
pub const ROWS: [u32; 8] = [2, 4, 8, 16, 32, 64, 128, 256];

/// Numbers of processors in table IX.
pub const PROCESSORS: [u32; 2] = [1, 7];

/// Numbers of processors in figure 25.
pub const MOST_PROCESSORS: u32 = 96;

/// The thesis's policies, which the tables compare.
pub const POLICIES: [Policy; 2] = [Policy::Static, Policy::Dynamic];

/// The coherence of the thesis's machine ([`Machine::coherence`]), as far as its table IX tells: with it, seven ideal
/// processors come to its mean dynamic speed-up of 6.83 (6.91 without).
pub const COHERENCE: f64 = 0.0003;

/// How well speed-ups are to agree, and how well curves of time against H.
const SPEED_UP_WITHIN: f64 = 0.05;
const TIME_WITHIN: f64 = 0.1;

/// The parameters of the simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simulation {
    /// The processors of table VIII.
    pub processors: NonZeroU32,
    /// The rows of a tile in table IX.
    pub rows: NonZeroU32,
    /// The machine.
    pub machine: Machine,
}

/// The cost of each pixel of a figure.
#[derive(Clone, Debug)]
pub struct Figure {
    name: &'static str,
    counts: TraceCounts,
    map: CostMap,
    region: Region,
}

impl Figure {
    /// Traces all five figures.
    ///
    /// # Errors
    /// Those of [`Runs::map`] and [`Runs::count`].
    pub fn all(runs: &Runs<'_>) -> Result<Vec<Self>, Error> {
        let figures = FIGURES.into_iter().zip(LIGHTS).map(|(subject, lights)| {
            let variant = SceneVariant::lit(subject, lights).four_pixels_per_ray();
            let (map, region) = runs.map(variant)?;
            Ok(Self {
                name: subject.name,
                counts: runs.count(variant)?,
                map,
                region,
            })
        });
        figures.collect()
    }

    /// Simulates sharing the picture in tiles of this many rows.
    fn share(
        &self,
        policy: Policy,
        rows: NonZeroU32,
        processors: NonZeroU32,
        machine: &Machine,
    ) -> Outcome {
        let tiles = TileSize::strip(rows).cut(&self.region);
        let costs: Vec<f64> = tiles.map(|tile| self.map.cost(&tile)).collect();
        // A 32-bit number fits.
        let processors = NonZeroUsize::try_from(processors).unwrap_or(NonZeroUsize::MAX);
        let deal = Scheduler::new(policy, costs.len(), processors, Vec::new());
        simulate(&costs, &deal, machine)
    }
}

/// The results of all simulations.
#[derive(Clone, Debug)]
pub struct Outcomes {
    /// The rows of a tile, or the numbers of processors.
    pub across: Vec<u32>,
    /// For each figure its name, and for each value across the result of each of [`POLICIES`].
    pub figures: Vec<(&'static str, Vec<[Outcome; 2]>)>,
}

impl Outcomes {
    /// Table VIII and figure 24: against the rows of a tile, of its two figures.
    pub fn by_rows(figures: &[Figure], simulation: &Simulation) -> Self {
        let figures: Vec<&Figure> = OF_EIGHT.iter().filter_map(|i| figures.get(*i)).collect();
        Self::of(&figures, &ROWS, |figure, policy, rows| {
            figure.share(policy, rows, simulation.processors, &simulation.machine)
        })
    }

    /// Table IX and figure 25: against the number of processors.
    pub fn by_processors(figures: &[Figure], across: &[u32], simulation: &Simulation) -> Self {
        let figures: Vec<&Figure> = figures.iter().collect();
        Self::of(&figures, across, |figure, policy, processors| {
            figure.share(policy, simulation.rows, processors, &simulation.machine)
        })
    }

    fn of(
        figures: &[&Figure],
        across: &[u32],
        share: impl Fn(&Figure, Policy, NonZeroU32) -> Outcome,
    ) -> Self {
        let values = || across.iter().copied().filter_map(NonZeroU32::new);
        let of = |figure: &Figure| {
            values()
                .map(|value| POLICIES.map(|policy| share(figure, policy, value)))
                .collect()
        };
        Self {
            across: across.to_vec(),
            figures: figures
                .iter()
                .map(|figure| (figure.name, of(figure)))
                .collect(),
        }
    }

    /// Returns in how many of all combinations the dynamic schedule is not slower.
    fn dynamic_is_no_slower(&self) -> (usize, usize) {
        let all = || self.figures.iter().flat_map(|(_, outcomes)| outcomes);
        // Not counting rounding errors.
        let no_slower =
            |[fixed, dynamic]: &&[Outcome; 2]| dynamic.time <= fixed.time * (1.0 + 1e-9);
        (all().filter(no_slower).count(), all().count())
    }

    /// Returns the value across with the highest speed-up of a policy in one of the figures, and that speed-up.
    pub fn best(both: &[[Outcome; 2]], across: &[u32], policy: usize) -> Option<(u32, f64)> {
        let speed_ups = both.iter().map(|both| both[policy].speed_up);
        // Of equal ones the first.
        let all = across.iter().copied().zip(speed_ups).rev();
        all.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn lines(&self, values: impl Fn(&str, &[Outcome; 2]) -> Vec<f64>) -> Vec<DraftLine> {
        let values = &values;
        (self.figures.iter())
            .flat_map(|(name, outcomes)| {
                self.across.iter().zip(outcomes).map(move |(across, both)| {
                    let values = values(name, both);
                    ((*name).to_owned(), across.to_string(), values)
                })
            })
            .collect()
    }
}

/// Makes table VIII; `full_size` as in [`Draft`].
pub fn eight(outcomes: &Outcomes, simulation: &Simulation, full_size: bool) -> Draft {
    let (no_slower, all) = outcomes.dynamic_is_no_slower();
    Draft {
        number: TableNumber::Eight,
        quantities: vec![
            Quantity::instructions("time, static", TIME_WITHIN),
            Quantity::instructions("time, dynamic", TIME_WITHIN),
        ],
        base: Base::OfScene,
        full_size,
        lines: outcomes.lines(|_, both| both.iter().map(|outcome| outcome.time / 1e6).collect()),
        notes: vec![
            format!("Dynamic takes no longer than static in {no_slower} of {all} cases."),
            description(
                simulation,
                &format!("on {} processors", simulation.processors),
            ),
            "The table does not tell its number of processors. By it and table IX they are 7.02 and 7.04 times as fast as \
             one: all eight of the thesis's machine. Beyond H = 32 a few tiles decide, and where a picture's costs lie is known of \
             ours only."
                .into(),
        ],
    }
}

/// Makes table IX; `full_size` as in [`Draft`].
pub fn nine(
    outcomes: &Outcomes,
    figures: &[Figure],
    simulation: &Simulation,
    full_size: bool,
) -> Draft {
    let (no_slower, all) = outcomes.dynamic_is_no_slower();
    let time = |name| Quantity {
        compare: Compare::Nothing,
        ratio: false,
        ..Quantity::instructions(name, 0.0)
    };
    let speed_up = |name| Quantity {
        decimals: 2,
        ..Quantity::rays(name, SPEED_UP_WITHIN)
    };
    let lines = outcomes.lines(|name, both| {
        let rays = figures.iter().find(|figure| figure.name == name);
        let rays = rays.map_or([f64::NAN; 2], |figure| {
            let rays = &figure.counts.rays;
            [rays.reflected, rays.blocked].map(|rays| rays as f64)
        });
        let times = both.iter().map(|outcome| outcome.time / 1e6);
        let speed_ups = both.iter().map(|outcome| outcome.speed_up);
        times.chain(speed_ups).chain(rays).collect()
    });
    Draft {
        number: TableNumber::Nine,
        quantities: vec![
            time("time, static"),
            time("time, dynamic"),
            speed_up("speed-up, static"),
            speed_up("speed-up, dynamic"),
            REFLECTED,
            BLOCKED,
        ],
        base: Base::OfScene,
        full_size,
        lines,
        notes: vec![
            format!("Dynamic is no slower than static in {no_slower} of {all} cases."),
            description(
                simulation,
                &format!("in tiles of H = {} rows", simulation.rows),
            ),
            format!(
                "Lights: {}. The thesis contradicts itself in figure 20: its 32,306 reflected rays are those of figure \
                 19, where a quarter of table II's 135,368 is 33,842; and its 37,148 blocked light tests are not a \
                 quarter of table II's 170,282 either, which is 42,570.",
                LIGHTS.map(|lights| lights.to_string()).join(", ")
            ),
        ],
    }
}

/// Describes the simulation.
fn description(simulation: &Simulation, how: &str) -> String {
    let Machine {
        hand_out,
        contention,
        coherence,
        serial,
    } = simulation.machine;
    let machine = match simulation.machine == Machine::default() {
        true => "an ideal machine, where the thesis's processors share a bus".into(),
        false => format!(
            "a machine with {hand_out} instructions to hand out a tile, contention {contention}, coherence {coherence} \
             and {serial} serial instructions"
        ),
    };
    format!("Simulated {how} from what each ray costs, 4 pixels per ray, on {machine}.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use octray_render::interrupt::Interrupt;

    fn simulation(machine: Machine) -> Simulation {
        Simulation {
            processors: NonZeroU32::new(7).unwrap(),
            rows: NonZeroU32::new(4).unwrap(),
            machine,
        }
    }

    /// A picture of 16 rows; the lower half costs three times as much.
    fn figure() -> Figure {
        let costs: Vec<Vec<f64>> = (0..16)
            .map(|row| vec![if row < 8 { 1e6 } else { 3e6 }])
            .collect();
        let region = Region {
            columns: 0..1,
            rows: 0..16,
        };
        Figure {
            name: "halves",
            counts: TraceCounts::default(),
            map: CostMap::new(region.clone(), 1, &costs),
            region,
        }
    }

    #[test]
    fn a_single_tile_is_not_shared_and_several_are() {
        let ideal = simulation(Machine::default());
        let outcomes = Outcomes::by_rows(&[figure(), figure()], &ideal);
        let draft = eight(&outcomes, &ideal, true);
        let times: Vec<_> = draft.lines.iter().map(|line| line.2[1]).collect();
        // Tiles of two rows: four of cost 2, four of cost 6 on seven processors. From 16 rows on there is one tile.
        assert_eq!(times, [8.0, 12.0, 24.0, 32.0, 32.0, 32.0, 32.0, 32.0]);
    }

    #[test]
    fn speed_up_is_one_on_one_processor_and_never_above_their_number() {
        let ideal = simulation(Machine::default());
        let outcomes = Outcomes::by_processors(&[figure()], &[1, 2, 7, 8], &ideal);
        for (processors, both) in outcomes.across.iter().zip(&outcomes.figures[0].1) {
            for outcome in both {
                assert!(outcome.speed_up <= f64::from(*processors));
            }
        }
        assert_eq!(
            outcomes.figures[0].1[0].map(|outcome| outcome.speed_up),
            [1.0; 2]
        );
    }

    #[test]
    fn the_machine_is_described() {
        let ideal = description(&simulation(Machine::default()), "so");
        assert!(ideal.contains("ideal"), "{ideal}");
        let bus = description(
            &simulation(Machine {
                contention: 0.02,
                ..Machine::default()
            }),
            "so",
        );
        assert!(bus.contains("contention 0.02"), "{bus}");
    }

    #[test]
    fn with_coherence_the_speed_up_peaks_where_one_more_slows_all_down_by_more() {
        let region = Region {
            columns: 0..1,
            rows: 0..4000,
        };
        let even = Figure {
            map: CostMap::new(region.clone(), 1, &vec![vec![1.0]; 4000]),
            region,
            ..figure()
        };
        let machine = Machine {
            coherence: 0.01,
            ..Machine::default()
        };
        let across: Vec<u32> = (1..=40).collect();
        let one_row = Simulation {
            rows: NonZeroU32::MIN,
            ..simulation(machine)
        };
        let outcomes = Outcomes::by_processors(&[even], &across, &one_row);
        // n / (1 + 0.01 n (n - 1)) is largest at 10.
        let (best, speed_up) = Outcomes::best(&outcomes.figures[0].1, &across, 1).unwrap();
        assert_eq!(best, 10);
        assert!((speed_up - 10.0 / 1.9).abs() < 0.01, "{speed_up}");
    }

    #[test]
    fn every_figure_is_shared() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((32, 32)), false, &interrupt);
        let figures = Figure::all(&runs).unwrap();
        let simulation = simulation(Machine::default());
        let outcomes = Outcomes::by_processors(&figures, &PROCESSORS, &simulation);
        let nine = nine(&outcomes, &figures, &simulation, false);
        assert_eq!(nine.lines.len(), 5 * PROCESSORS.len());
    }
}
