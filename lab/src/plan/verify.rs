//! Verifies a plan: builds the firmware from it, and runs it on the emulated board.

use super::decision::{Cost, Strip};
use super::events::{Probe, ROWS};
use crate::measure::board::{self, Board};
use crate::measure::emulate::Emulator;
use crate::measure::job::Goal;
use crate::measure::memory::Memory;
use crate::measure::source_tree::SourceTree;
use crate::measure::{self, frames};
use octray_prepare::plan::Plan;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_scenes::model::Scene;
use serde::Serialize;
use std::fs;
use std::path::Path;
use std::time::Duration;

/// The timeout of a frame.
const PATIENCE: Duration = Duration::from_secs(300);

/// The measurement, and the relative errors of the prediction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Verification {
    /// Instructions, without start-up and panel.
    pub instructions: u64,
    /// The dearest strip.
    pub dearest: Strip,
    /// The relative error of its prediction.
    pub dearest_error: f64,
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of variables and of the maximum stack depth.
    pub ram: u64,
    /// The relative errors of predicted instructions, flash and RAM; positive if the prediction is too large.
    pub errors: [f64; 3],
}

/// Builds the firmware for a plan and runs it; its picture must equal the host's.
///
/// # Errors
/// [`Error::Failed`] if target or emulator are missing, or the firmware cannot be built, fails, or renders another
/// picture; [`Error::Interrupted`].
pub fn run(
    path: &Path,
    scene: &Scene,
    plan: &Plan,
    cost: &Cost,
    board: &'static Board,
    interrupt: &Interrupt,
) -> Result<Verification, Error> {
    let failed = |why: String| Error::Failed(format!("the firmware on {board}: {why}"));
    let expected = Probe::render(scene, plan, interrupt)?.picture.hash();
    let root = SourceTree::root()?;
    board::require(&[board], &root)?;
    let sources = SourceTree::open(root)?;
    let plugin = measure::plugin(&sources, interrupt)?;
    let path = fs::canonicalize(path).map_err(|cause| Error::read(path, cause))?;
    let folder = tempfile::tempdir()
        .map_err(|cause| Error::Failed(format!("cannot make a temporary folder: {cause}")))?;
    let file = folder.path().join("plan");
    fs::write(&file, plan.to_string()).map_err(|cause| Error::write(&file, cause))?;
    let (scene, file) = (path.to_string_lossy(), file.to_string_lossy());
    let firmware = ("octray-firmware", None);
    let variables = [("OCTRAY_SCENE", &*scene), ("OCTRAY_PLAN", &*file)];
    let program = sources.firmware(firmware, board, Goal::Speed, &variables, interrupt)?;
    let program = program.map_err(failed)?;
    let emulator = Emulator {
        plugin: &plugin,
        patience: PATIENCE,
        watch: frames::SEARCH,
    };
    let run = emulator.run(board, &program, interrupt)?.map_err(failed)?;
    let value = |name| run.values.get(name).cloned().unwrap_or_default();
    let (hash, expected) = (value("hash"), format!("{expected:016x}"));
    if hash != expected {
        return Err(failed(format!(
            "its picture's hash is {hash}, the host's {expected}"
        )));
    }
    let stack: u64 = value("stack")
        .parse()
        .map_err(|_| failed("its stack is not known".into()))?;
    let bytes = fs::read(&program).map_err(|cause| Error::read(&program, cause))?;
    let memory = Memory::of(&bytes).map_err(|why| failed(why.to_string()))?;
    let measured = [run.count.instructions, memory.flash, memory.ram + stack];
    let predicted = [cost.instructions, cost.flash, cost.ram];
    let [instructions, flash, ram] = measured;
    let dearest = Strip {
        instructions: run.count.longest,
        mean: run.count.instructions / u64::from(plan.size.1.div_ceil(ROWS as u32).max(1)),
    };
    Ok(Verification {
        instructions,
        dearest,
        dearest_error: cost.dearest.instructions as f64 / dearest.instructions as f64 - 1.0,
        flash,
        ram,
        errors: [0, 1, 2].map(|i| predicted[i] as f64 / measured[i] as f64 - 1.0),
    })
}
