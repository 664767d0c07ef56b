//! Single operations on boards: what one call of each costs, in instructions.
//!
//! The program `octray-kernels` calls each kernel on a set of inputs, the same in every arithmetic,
//! and the emulator's plugin counts the instructions from entry to return. Costs are means over the
//! inputs, less what an empty function takes.

mod table;

use super::board::{self, Board};
use super::emulate::{Emulator, Run};
use super::job::MeasureJob;
use super::report::{Report, With};
use super::workspace::Workspace;
use octray_prepare::choice::Choice;
use octray_prepare::{Arith, Format};
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::output;
use octray_render::progress::{Bar, Progress};
use serde::Serialize;
use table::{failures, text};

/// The program, and its feature.
const PROGRAM: (&str, Option<&str>) = ("octray-kernels", Some("kernels"));

/// The functions to watch.
const WATCH: &str = "kernel_*";

/// How a kernel's cost comes out of what was counted.
#[derive(Clone, Copy, Debug)]
enum Cost {
    /// Calls of one function, less as many of the empty one.
    Of(&'static str),
    /// Calls of the first function, less as many of the second: per call, or per so many as the
    /// program tells under a name.
    Beyond(&'static str, &'static str, Option<&'static str>),
}

/// The kernels, in the table's order.
const KERNELS: [(&str, Cost); 14] = [
    ("add", Cost::Of("kernel_add")),
    ("mul", Cost::Of("kernel_mul")),
    ("div", Cost::Of("kernel_div")),
    ("sqrt", Cost::Of("kernel_sqrt")),
    ("1/sqrt", Cost::Of("kernel_inverse_sqrt")),
    ("dot", Cost::Of("kernel_dot")),
    ("normalise", Cost::Of("kernel_normalise")),
    ("hit sphere", Cost::Of("kernel_sphere")),
    ("hit triangle", Cost::Of("kernel_triangle")),
    ("hit polygon", Cost::Of("kernel_polygon")),
    ("hit cone", Cost::Of("kernel_cone")),
    ("hit box", Cost::Of("kernel_box")),
    (
        "voxel step",
        Cost::Beyond("kernel_walk", "kernel_root", Some("steps")),
    ),
    (
        "shaded light",
        Cost::Beyond("kernel_two_lights", "kernel_one_light", None),
    ),
];

/// A kernel on a board in an arithmetic.
#[derive(Clone, Debug, Serialize)]
struct Row {
    kernel: &'static str,
    board: &'static Board,
    target: &'static str,
    core: &'static str,
    arith: Arith,
    /// The number format that was used.
    format: Option<Format>,
    /// `ok`, or why there are no numbers.
    outcome: String,
    /// How often the kernel was executed.
    calls: Option<u64>,
    /// Of all these calls, without the calls themselves.
    instructions: Option<u64>,
    /// Instructions per call.
    per_call: Option<f64>,
    /// Hit tests: how many calls hit.
    hits: Option<u64>,
}

/// The columns of comma-separated values: those of every row, in order.
const COLUMNS: [&str; 11] = [
    "kernel",
    "board",
    "target",
    "core",
    "arith",
    "format",
    "outcome",
    "calls",
    "instructions",
    "per_call",
    "hits",
];

/// Measures the kernels, and tells.
///
/// # Errors
/// When something is missing, a result cannot be written, or any combination failed: then all
/// others have been told.
pub fn run(job: &MeasureJob, interrupt: &Interrupt) -> Result<(), Error> {
    let root = Workspace::root()?;
    board::require(&job.boards, &root)?;
    let workspace = Workspace::open(root)?;
    let plugin = super::plugin(&workspace, interrupt)?;
    let emulator = Emulator {
        plugin: &plugin,
        patience: job.patience,
        watch: WATCH,
    };
    let progress = Bar::new("measuring");
    progress.start(job.ariths.len() * job.boards.len());
    let mut rows = Vec::new();
    for &board in &job.boards {
        for &arith in &job.ariths {
            let variables = [
                ("OCTRAY_SCENE", "firmware-sim/kernels.scene"),
                ("OCTRAY_ARITH", arith.name()),
                ("OCTRAY_TREE", "compact-bvh8"),
                // As many nodes as there can be.
                ("OCTRAY_LEAF_SIZE", "1"),
            ];
            let goal = job.build.optimize;
            let built = workspace.firmware(PROGRAM, board, goal, &variables, interrupt)?;
            let run = match built {
                Ok(program) => emulator.run(board, &program, interrupt)?,
                Err(why) => Err(format!("not built: {why}")),
            };
            rows.extend(KERNELS.map(|kernel| row(kernel, board, arith, &run)));
            progress.step();
        }
    }
    drop(progress);
    let report = Report {
        with: With::of(&workspace, &job.boards),
        rows,
    };
    report.write(&COLUMNS, job, interrupt)?;
    output::write_stdout(interrupt, |out| {
        out.write_all(text(&report.rows).as_bytes())
    })?;
    super::all_done(failures(&report.rows).len())
}

fn row(
    (kernel, cost): (&'static str, Cost),
    board: &'static Board,
    arith: Arith,
    run: &Result<Run, String>,
) -> Row {
    let told = |name: &str| run.as_ref().ok()?.told.get(name);
    let measured = run.as_ref().map_err(Clone::clone).and_then(|run| {
        measure(cost, run).ok_or_else(|| "not called as often as it should".into())
    });
    let shape = kernel.strip_prefix("hit ");
    Row {
        kernel,
        board,
        target: board.target,
        core: board.core,
        arith,
        format: told("arith").and_then(|name| Format::named(name)),
        calls: measured.as_ref().ok().map(|m| m.0),
        instructions: measured.as_ref().ok().map(|m| m.1),
        per_call: (measured.as_ref().ok()).map(|&(calls, n)| n as f64 / calls as f64),
        hits: shape.and_then(|shape| told(shape)?.parse().ok()),
        outcome: measured.err().unwrap_or_else(|| "ok".into()),
    }
}

/// Calls and their instructions; `None` if two functions were not called equally often.
fn measure(cost: Cost, run: &Run) -> Option<(u64, u64)> {
    let of = |function| Some(run.count.calls_of(function)).filter(|(calls, _)| *calls > 0);
    match cost {
        Cost::Of(function) => {
            let (calls, instructions) = of(function)?;
            let (empty_calls, empty) = of("kernel_empty")?;
            Some((
                calls,
                instructions.checked_sub(calls * (empty / empty_calls))?,
            ))
        }
        Cost::Beyond(more, less, unit) => {
            let (calls, instructions) = of(more)?;
            let (less_calls, less) = of(less)?;
            let units = match unit {
                None => calls,
                Some(name) => run.told.get(name)?.parse().ok().filter(|n| *n > 0)?,
            };
            let beyond = instructions.checked_sub(less)?;
            (calls == less_calls).then_some((units, beyond))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::count::Count;
    use super::*;
    use std::collections::BTreeMap;

    fn run(told: &[(&str, &str)]) -> Run {
        let report = "instructions 9\ncalls 4 12 a::kernel_empty\ncalls 2 30 a::kernel_add\n\
            calls 5 500 a::kernel_walk\ncalls 5 100 a::kernel_root\n\
            calls 3 90 a::kernel_two_lights\ncalls 2 30 a::kernel_one_light\n";
        let told = told.iter().map(|&(name, n)| (name.into(), n.into()));
        Run {
            told: told.collect::<BTreeMap<_, _>>(),
            count: Count::parse(report).unwrap(),
        }
    }

    #[test]
    fn calls_are_not_part_of_the_cost() {
        assert_eq!(measure(Cost::Of("kernel_add"), &run(&[])), Some((2, 24)));
        assert_eq!(measure(Cost::Of("kernel_mul"), &run(&[])), None);
    }

    #[test]
    fn differences_are_of_equally_many_calls() {
        let step = Cost::Beyond("kernel_walk", "kernel_root", Some("steps"));
        assert_eq!(measure(step, &run(&[("steps", "8")])), Some((8, 400)));
        assert_eq!(measure(step, &run(&[("steps", "0")])), None);
        assert_eq!(measure(step, &run(&[])), None);
        let light = Cost::Beyond("kernel_two_lights", "kernel_one_light", None);
        assert_eq!(measure(light, &run(&[])), None);
    }

    #[test]
    fn a_run_that_failed_has_no_numbers() {
        let row = row(
            KERNELS[0],
            &board::BOARDS[0],
            Arith::F32,
            &Err("trapped".into()),
        );
        assert_eq!(row.outcome, "trapped");
        assert_eq!(
            (row.calls, row.instructions, row.per_call),
            (None, None, None)
        );
    }
}
