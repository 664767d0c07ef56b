//! The tables of how processors share a picture: VIII and IX, simulated.

use super::number::TableNumber;
use super::runs::Runs;
use super::subject::FIGURES;
use super::table::{Base, Draft, DraftLine, Quantity};
use crate::simulate::{Machine, Outcome, simulate};
use octray_core::frame::Region;
use octray_render::cost::CostMap;
use octray_render::error::Error;
use octray_render::scheduler::{Policy, Scheduler};
use octray_render::tile::TileSize;
use std::num::{NonZeroU32, NonZeroUsize};

/// Rows of a tile in table VIII, H in the thesis.
pub const ROWS: [u32; 8] = [2, 4, 8, 16, 32, 64, 128, 256];

/// Numbers of processors in table IX.
pub const PROCESSORS: [u32; 8] = [1, 2, 3, 4, 5, 6, 7, 8];

/// The thesis's policies, which the tables compare.
pub const POLICIES: [Policy; 2] = [Policy::Static, Policy::Dynamic];

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
    map: CostMap,
    region: Region,
}

impl Figure {
    /// Traces all five figures.
    ///
    /// # Errors
    /// Those of [`Runs::map`].
    pub fn all(runs: &Runs<'_>) -> Result<Vec<Self>, Error> {
        let figures = FIGURES.into_iter().map(|subject| {
            let (map, region) = runs.map(subject)?;
            Ok(Self {
                name: subject.name,
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
    pub across: &'static [u32],
    /// For each figure its name, and for each value across the result of each of [`POLICIES`].
    pub figures: Vec<(&'static str, Vec<[Outcome; 2]>)>,
}

impl Outcomes {
    /// Table VIII: against the rows of a tile.
    pub fn by_rows(figures: &[Figure], simulation: &Simulation) -> Self {
        Self::of(figures, &ROWS, |figure, policy, rows| {
            figure.share(policy, rows, simulation.processors, &simulation.machine)
        })
    }

    /// Table IX: against the number of processors.
    pub fn by_processors(figures: &[Figure], simulation: &Simulation) -> Self {
        Self::of(figures, &PROCESSORS, |figure, policy, processors| {
            figure.share(policy, simulation.rows, processors, &simulation.machine)
        })
    }

    fn of(
        figures: &[Figure],
        across: &'static [u32],
        share: impl Fn(&Figure, Policy, NonZeroU32) -> Outcome,
    ) -> Self {
        let values = || across.iter().copied().filter_map(NonZeroU32::new);
        let of = |figure: &Figure| {
            values()
                .map(|value| POLICIES.map(|policy| share(figure, policy, value)))
                .collect()
        };
        Self {
            across,
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

    fn lines(&self, value: impl Fn(&Outcome) -> f64) -> Vec<DraftLine> {
        let value = &value;
        (self.figures.iter())
            .flat_map(|(name, outcomes)| {
                self.across.iter().zip(outcomes).map(move |(across, both)| {
                    let values = both.iter().map(value).collect();
                    ((*name).to_owned(), across.to_string(), values)
                })
            })
            .collect()
    }
}

/// Makes table VIII.
pub fn eight(outcomes: &Outcomes, simulation: &Simulation) -> Draft {
    let (no_slower, all) = outcomes.dynamic_is_no_slower();
    let best = |policy: usize| {
        let rows = outcomes.figures.iter().map(|(_, times)| {
            let of_policy = outcomes
                .across
                .iter()
                .zip(times)
                .map(|(rows, both)| (rows, both[policy].time));
            // Of equal ones the first.
            let least = of_policy.min_by(|a, b| a.1.total_cmp(&b.1));
            least.map_or(String::new(), |(rows, _)| rows.to_string())
        });
        rows.collect::<Vec<_>>().join(", ")
    };
    Draft {
        number: TableNumber::Eight,
        quantities: vec![
            Quantity::instructions("time, static"),
            Quantity::instructions("time, dynamic"),
        ],
        base: Base::OfScene,
        lines: outcomes.lines(|outcome| outcome.time / 1e6),
        notes: vec![
            format!(
                "Dynamic takes no longer than static in {no_slower} of {all} cases. The best H of the figures: static {}; \
                 dynamic {}.",
                best(0),
                best(1)
            ),
            description(
                simulation,
                &format!("on {} processors", simulation.processors),
            ),
        ],
    }
}

/// Makes table IX.
pub fn nine(outcomes: &Outcomes, simulation: &Simulation) -> Draft {
    let (no_slower, all) = outcomes.dynamic_is_no_slower();
    let speed_up = |name| Quantity {
        decimals: 2,
        ratio: false,
        within: Some(0.05),
        ..Quantity::count(name)
    };
    Draft {
        number: TableNumber::Nine,
        quantities: vec![speed_up("speed-up, static"), speed_up("speed-up, dynamic")],
        base: Base::OfScene,
        lines: outcomes.lines(|outcome| outcome.speed_up),
        notes: vec![
            format!("Dynamic is no slower than static in {no_slower} of {all} cases."),
            description(
                simulation,
                &format!("in tiles of H = {} rows", simulation.rows),
            ),
            "The thesis's table has up to 7 processors; its machine ran 8.".into(),
        ],
    }
}

/// Describes the simulation.
fn description(simulation: &Simulation, how: &str) -> String {
    let Machine {
        hand_out,
        contention,
        serial,
    } = simulation.machine;
    let machine = match simulation.machine == Machine::default() {
        true => "an ideal machine, where the thesis's processors share a bus".into(),
        false => format!(
            "a machine with {hand_out} instructions to hand out a tile, contention {contention} and {serial} \
             serial instructions"
        ),
    };
    format!("Simulated {how} from what each pixel costs, on {machine}.")
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
            map: CostMap::new(region.clone(), 1, &costs),
            region,
        }
    }

    #[test]
    fn a_single_tile_is_not_shared_and_several_are() {
        let outcomes = Outcomes::by_rows(&[figure()], &simulation(Machine::default()));
        let draft = eight(&outcomes, &simulation(Machine::default()));
        let times: Vec<_> = draft.lines.iter().map(|line| line.2[1]).collect();
        // Tiles of two rows: four of cost 2, four of cost 6 on seven processors. From 16 rows on there is one tile.
        assert_eq!(times, [8.0, 12.0, 24.0, 32.0, 32.0, 32.0, 32.0, 32.0]);
        assert!(draft.notes[0].contains("dynamic 2."), "{}", draft.notes[0]);
    }

    #[test]
    fn speed_up_is_one_on_one_processor_and_never_above_their_number() {
        let outcomes = Outcomes::by_processors(&[figure()], &simulation(Machine::default()));
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
    fn every_figure_is_shared() {
        let interrupt = Interrupt::new();
        let runs = Runs::new(Some((32, 32)), false, &interrupt);
        let figures = Figure::all(&runs).unwrap();
        let simulation = simulation(Machine::default());
        let outcomes = Outcomes::by_processors(&figures, &simulation);
        assert_eq!(
            nine(&outcomes, &simulation).lines.len(),
            5 * PROCESSORS.len()
        );
    }
}
