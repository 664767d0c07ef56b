//! Arguments of `octray schedule`.

use super::value;
use crate::deal::Policy;
use crate::job::Arith;
use crate::packets::Shape;
use crate::simulate::Machine;
use crate::sweep::SweepJob;
use clap::{Args, ValueEnum};
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Arguments of `octray schedule`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
Lists are such as 1,2,7 or 1..1024, which doubles: 1, 2, 4 and so on up to 1024. Costs are in instructions, \
estimated from counted events, and the same every time. The machine is ideal unless told otherwise.")]
pub struct ScheduleArgs {
    /// The scene file
    scene: PathBuf,
    /// Numbers of processors
    #[arg(long, value_name = "LIST", default_value = "1..1024", value_parser = value::doubling)]
    processors: value::Whole,
    /// Rows of packets that are strips
    #[arg(long, value_name = "LIST", default_value = "1..256", value_parser = value::doubling)]
    packet_rows: value::Whole,
    /// Sides of packets that are square tiles
    #[arg(long, value_name = "LIST", default_value = "4..256", value_parser = value::doubling)]
    tiles: value::Whole,
    /// Which processor gets which packet [default: all]
    #[arg(long, value_name = "HOW", value_enum, value_delimiter = ',')]
    policy: Vec<Policy>,
    /// Columns and rows; the framing stays [default: the scene's own]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    size: Option<(u32, u32)>,
    /// The arithmetic to trace in
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    arith: Arith,
    /// Instructions for which a packet that comes from others keeps them from handing out another
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    hand_out: f64,
    /// By how much of itself each further busy processor slows all of them
    #[arg(long, value_name = "C", default_value = "0", value_parser = value::not_negative)]
    contention: f64,
    /// Instructions that one processor does before the others begin
    #[arg(long, value_name = "I", default_value = "0", value_parser = value::not_negative)]
    serial: f64,
    /// Print one JSON object with every combination instead of a table of the best
    #[arg(long)]
    json: bool,
}

impl ScheduleArgs {
    /// The job that these arguments ask for.
    pub fn job(self) -> SweepJob {
        let strips = self.packet_rows.0.into_iter().map(Shape::strip);
        let tiles = self.tiles.0.into_iter().map(|side| Shape {
            rows: side,
            columns: Some(side),
        });
        let processors = self.processors.0.into_iter();
        SweepJob {
            scene: self.scene,
            processors: processors
                .filter_map(|count: NonZeroU32| NonZeroUsize::try_from(count).ok())
                .collect(),
            shapes: strips.chain(tiles).collect(),
            policies: match self.policy.is_empty() {
                true => Policy::value_variants().to_vec(),
                false => self.policy,
            },
            size: self.size,
            arith: self.arith,
            machine: Machine {
                hand_out: self.hand_out,
                contention: self.contention,
                serial: self.serial,
            },
            json: self.json,
        }
    }
}
