//! What a frame costs, on one of several scales.

use super::ChartJob;
use super::accuracy::build;
use super::callgrind::Callgrind;
use crate::measure;
use crate::measure::board::{self, BOARDS, Board};
use crate::measure::emulate::Emulator;
use crate::measure::frames::{Bench, NamedScene, SEARCH};
use crate::measure::job::{FirmwareOptions, Goal, MeasureJob};
use crate::measure::source_tree::SourceTree;
use crate::plan::choice::PER_PIXEL;
use octray_core::observe::Counters;
use octray_prepare::{FirmwareTree, RenderSettings, TreeKind};
use octray_render::adaptive;
use octray_render::cost;
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::progress::Progress;
use octray_render::renderer::Renderer;
use octray_render::schedule::Schedule;
use octray_scenes::model::Scene;
use octray_scenes::reduce::Reduction;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What counts as cost; always of a whole frame, on one thread, without reading the scene and building the tree.
#[derive(Clone, Copy, Debug)]
pub enum CostKind {
    /// Seconds on this machine.
    HostTime,
    /// Instructions of this machine, counted by Callgrind.
    HostInstructions,
    /// Instructions estimated from counted rays, steps and tests: the same for all arithmetics, which makes it
    /// fit to compare settings only.
    Events,
    /// Instructions of a board, counted in the emulator.
    Board(&'static Board),
}

impl CostKind {
    /// The kind that a word on the command line names.
    ///
    /// # Errors
    /// If there is none; says which there are.
    pub fn named(name: &str) -> Result<Self, String> {
        let hosts = [Self::HostTime, Self::HostInstructions, Self::Events];
        let all = || hosts.into_iter().chain(BOARDS.iter().map(Self::Board));
        all().find(|kind| kind.name() == name).ok_or_else(|| {
            let names: Vec<_> = all().map(Self::name).collect();
            format!("expected one of {}", names.join(", "))
        })
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::HostTime => "host-time",
            Self::HostInstructions => "host-instructions",
            Self::Events => "events",
            Self::Board(board) => board.name,
        }
    }

    /// What it is counted in.
    pub fn unit(self) -> &'static str {
        match self {
            Self::HostTime => "seconds",
            _ => "instructions",
        }
    }

    /// An amount of it, to read.
    pub fn amount(self, cost: f64) -> String {
        format!("{} {}", self.figure(cost), self.unit())
    }

    /// The same without the unit.
    pub fn figure(self, cost: f64) -> String {
        match self {
            Self::HostTime => format!("{cost:.6}"),
            _ => thousands(cost.round() as u64),
        }
    }

    /// What it is, in words.
    pub fn words(self) -> String {
        match self {
            Self::HostTime => "seconds per frame on this machine, one thread".into(),
            Self::HostInstructions => "instructions per frame on this machine".into(),
            Self::Events => "instructions per frame, estimated from counted events".into(),
            Self::Board(board) => {
                format!("instructions per frame on {}, {}", board.name, board.core)
            }
        }
    }
}

/// The firmware's tree of the same kind, if it has that.
pub fn tree_on_boards(tree: TreeKind) -> Option<FirmwareTree> {
    match tree {
        TreeKind::CompactBvh8 => Some(FirmwareTree::COMPACT),
        TreeKind::None => Some(FirmwareTree::NONE),
        TreeKind::Bvh8 | TreeKind::Modified | TreeKind::Plain => None,
    }
}

/// A run on an emulated board that takes longer has no end.
const PATIENCE: Duration = Duration::from_secs(1800);

/// Measures costs.
#[derive(Debug)]
pub struct Meter<'a> {
    job: &'a ChartJob,
    callgrind: Option<Callgrind>,
    /// The firmware's sources, and the emulator's plugin.
    workshop: Option<(SourceTree, PathBuf)>,
    /// Asks to stop.
    pub interrupt: &'a Interrupt,
}

/// For each setting its cost, or why it has none.
pub type Costs = Vec<Result<f64, String>>;

impl<'a> Meter<'a> {
    /// Finds the tools that it takes to measure costs of these kinds.
    ///
    /// # Errors
    /// [`Error::Failed`] with what is missing, and how to install it.
    pub fn new(
        job: &'a ChartJob,
        kinds: &[CostKind],
        interrupt: &'a Interrupt,
    ) -> Result<Self, Error> {
        let mut boards = Vec::new();
        let mut callgrind = None;
        for kind in kinds {
            match kind {
                CostKind::Board(board) => boards.push(*board),
                CostKind::HostInstructions => callgrind = Some(Callgrind::find()?),
                CostKind::HostTime | CostKind::Events => {}
            }
        }
        let workshop = match &*boards {
            [] => None,
            boards => {
                let root = SourceTree::root()?;
                board::require(boards, &root)?;
                let workspace = SourceTree::open(root)?;
                let plugin = measure::plugin(&workspace, interrupt)?;
                Some((workspace, plugin))
            }
        };
        Ok(Self {
            job,
            callgrind,
            workshop,
            interrupt,
        })
    }

    /// What each setting costs in a scene.
    ///
    /// # Errors
    /// [`Error::Interrupted`], or if a tool cannot be run.
    pub fn costs(
        &self,
        kind: CostKind,
        scene: &NamedScene,
        settings: &[RenderSettings],
        progress: &dyn Progress,
    ) -> Result<Costs, Error> {
        if let CostKind::HostTime = kind {
            return self.times(&scene.scene, settings, progress);
        }
        let cost = |setting: &RenderSettings| {
            self.interrupt.check()?;
            let cost = match (kind, &self.callgrind, &self.workshop) {
                (CostKind::HostInstructions, Some(callgrind), _) => {
                    callgrind.count(&scene.path, setting, self.interrupt)?
                }
                (CostKind::Board(board), _, Some((workspace, plugin))) => {
                    self.on_board(board, scene, setting, workspace, plugin)?
                }
                _ => Ok(events(&scene.scene, setting, self.interrupt)?),
            };
            progress.step();
            Ok(cost)
        };
        settings.iter().map(cost).collect()
    }

    /// The median time of several rounds. In each round every setting has its turn, so that a slow moment of
    /// the machine does not fall on one of them alone.
    fn times(
        &self,
        scene: &Scene,
        settings: &[RenderSettings],
        progress: &dyn Progress,
    ) -> Result<Costs, Error> {
        let engines: Vec<_> = (settings.iter())
            .map(|setting| build(scene, setting))
            .collect::<Result<_, _>>()?;
        let mut times = vec![Vec::new(); engines.len()];
        for _ in 0..self.job.rounds.get() {
            let engines = engines.iter().zip(settings);
            for ((renderer, setting), times) in engines.zip(&mut times) {
                self.interrupt.check()?;
                times.push(time(&**renderer, setting, self.interrupt)?);
            }
        }
        engines.iter().for_each(|_| progress.step());
        Ok(times.into_iter().map(|times| Ok(median(times))).collect())
    }

    fn on_board(
        &self,
        board: &'static Board,
        scene: &NamedScene,
        setting: &RenderSettings,
        workspace: &SourceTree,
        plugin: &std::path::Path,
    ) -> Result<Result<f64, String>, Error> {
        let Some(tree) = tree_on_boards(setting.tree.kind) else {
            return Ok(Err(format!(
                "boards have no {} tree",
                setting.tree.kind.name()
            )));
        };
        let bench = Bench {
            sources: workspace,
            emulator: &Emulator {
                plugin,
                patience: PATIENCE,
                watch: SEARCH,
            },
            progress: &(),
            interrupt: self.interrupt,
        };
        let job = MeasureJob {
            kernels: false,
            scenes: Vec::new(),
            reduction: Reduction::default(),
            boards: vec![board],
            ariths: vec![setting.arith],
            settings: *setting,
            build: FirmwareOptions {
                tree,
                optimize: Goal::Speed,
            },
            patience: PATIENCE,
            functions: 0,
            json: None,
            csv: None,
            chart: None,
        };
        let rows = bench.frames(std::slice::from_ref(scene), &job)?;
        let row = rows.first();
        let why = || row.map_or("not measured".into(), |row| row.outcome.clone());
        let instructions = row.and_then(measure::row::FrameRow::instructions);
        Ok(instructions.map(|count| count as f64).ok_or_else(why))
    }
}

fn events(scene: &Scene, setting: &RenderSettings, interrupt: &Interrupt) -> Result<f64, Error> {
    let renderer = build(scene, setting)?;
    let counters = count(&*renderer, setting, interrupt)?;
    let (width, height) = renderer.built().size;
    let background = PER_PIXEL * f64::from(width) * f64::from(height);
    Ok(cost::cost(&counters).max(background))
}

fn time(
    renderer: &dyn Renderer,
    setting: &RenderSettings,
    interrupt: &Interrupt,
) -> Result<f64, Error> {
    let begin = Instant::now();
    count(renderer, setting, interrupt)?;
    Ok(begin.elapsed().as_secs_f64())
}

/// Traces the picture in this thread, and returns what was counted.
fn count(
    renderer: &dyn Renderer,
    setting: &RenderSettings,
    interrupt: &Interrupt,
) -> Result<Counters, Error> {
    let Some(how) = setting.adaptive else {
        let mut worker = renderer.worker(interrupt);
        worker.probe(&renderer.built().active);
        interrupt.check()?;
        return Ok(*worker.counters());
    };
    let alone = Schedule {
        threads: NonZeroUsize::MIN,
        ..Schedule::default()
    };
    let rendered = adaptive::render(renderer, how, &alone, false, &(), interrupt)?;
    Ok(rendered.1)
}

/// The middle one; the lower of two.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[(times.len() - 1) / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_named_by_its_name() {
        for name in ["host-time", "host-instructions", "events", "m0", "rv32imac"] {
            assert_eq!(CostKind::named(name).unwrap().name(), name);
        }
        let text = CostKind::named("host").unwrap_err();
        assert!(text.starts_with("expected one of host-time, "), "{text}");
        assert!(text.ends_with("rv32imafc"), "{text}");
    }

    #[test]
    fn a_median_is_a_time_that_was_measured() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.0);
    }
}
