//! Arguments of `octray plan`.

use crate::cli::{files, value};
use clap::Args;
use octray_lab::measure::board::{self, Board};
use octray_lab::plan::job::{Bounds, Numbers, PlanJob, memory};
use octray_prepare::choice::Choice;
use octray_render::error::Error;
use std::path::PathBuf;

/// Arguments of `octray plan`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Boards: m0 (Cortex-M0, micro:bit), m3, m4 (without its floating-point unit), m4f, m7f,
rv32imac, sifive-e, rv32imafc. A target's name means its first board.

The scene is rendered many times on this machine. A model that was fitted to measurements (octray measure) predicts
the cost of a frame on the board; its error is printed. The exit code is 1 if nothing fits: then the output states which
limit fails by how much, and what would fit.")]
pub struct PlanArgs {
    /// The scene file
    scene: PathBuf,
    /// The board
    #[arg(long, alias = "targets", value_name = "BOARD", default_value = "m0", value_parser = board::named)]
    target: Boards,
    /// Bytes of flash [default: those of the firmware's memory layout]
    #[arg(long, value_name = "N")]
    flash: Option<u64>,
    /// Bytes of RAM, including the stack [default: those of the firmware's memory layout]
    #[arg(long, value_name = "N")]
    ram: Option<u64>,
    /// Minimum PSNR against the picture in f64 with all bounces, in dB
    #[arg(long, value_name = "dB", default_value = "40", value_parser = value::not_negative)]
    min_psnr: f64,
    /// Columns and rows; the framing stays the same [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// The arithmetics to consider
    #[arg(long, value_name = "FAMILY", value_parser = value::choice::<Numbers>(), default_value = Numbers::default().name())]
    arith: Numbers,
    /// Build the firmware, run it in the emulator, and print the errors of the predictions
    #[arg(long)]
    measure: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Write the plan for `octray bake --plan`, and for the firmware's build as OCTRAY_PLAN
    #[arg(long, value_name = "FILE")]
    emit: Option<PathBuf>,
}

/// The boards of one name.
type Boards = Vec<&'static Board>;

impl PlanArgs {
    /// Returns the job.
    ///
    /// # Errors
    /// [`Error::Usage`] if the plan would replace the scene.
    pub fn job(self) -> Result<PlanJob, Error> {
        files::distinct([&self.scene], &self.emit)?;
        // Names that name no board were refused.
        let board = *(self.target.first()).ok_or_else(|| Error::Usage("no board".into()))?;
        let (flash, ram) = memory(board);
        Ok(PlanJob {
            scene: self.scene,
            board,
            bounds: Bounds {
                flash: self.flash.unwrap_or(flash),
                ram: self.ram.unwrap_or(ram),
                min_psnr: self.min_psnr,
            },
            numbers: self.arith,
            size: self.size,
            measure: self.measure,
            json: self.json,
            emit: self.emit,
        })
    }
}
