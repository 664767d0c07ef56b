//! Measures single operations on boards: the instructions of one call.
//!
//! The program `octray-kernels` calls each kernel on a set of inputs, which is the same in every arithmetic. The
//! emulator's plugin counts the instructions from entry to return. Costs are means over the inputs, without the
//! instructions of an empty function.

mod table;

use super::board::{self, Board};
use super::emulate::{Emulator, Run};
use super::job::MeasureJob;
use super::report::{MeasureReport, With};
use super::source_tree::SourceTree;
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

/// How a kernel's cost follows from the counts.
#[derive(Clone, Copy, Debug)]
enum Cost {
    /// Calls of one function, minus as many calls of the empty one.
    Of(&'static str),
    /// Calls of the first function, minus as many calls of the second: per call, or per unit that the program counts
    /// under a name.
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
struct KernelRow {
    kernel: &'static str,
    board: &'static Board,
    target: &'static str,
    core: &'static str,
    arith: Arith,
    /// The number format that was used.
    format: Option<Format>,
    /// `ok`, or why there are no numbers.
    outcome: String,
    /// The number of calls.
    calls: Option<u64>,
    /// The instructions of all these calls, without the calls themselves.
    instructions: Option<u64>,
    /// Instructions per call.
    per_call: Option<f64>,
    /// Hit tests: the number of hits.
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

/// Measures the kernels and prints the results.
///
/// # Errors
/// If something is missing, a result cannot be written, or a combination failed; then the others are printed first.
pub fn run(job: &MeasureJob, interrupt: &Interrupt) -> Result<(), Error> {
    let root = SourceTree::root()?;
    board::require(&job.boards, &root)?;
    let sources = SourceTree::open(root)?;
    let plugin = super::plugin(&sources, interrupt)?;
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
                // The largest possible number of nodes.
                ("OCTRAY_LEAF_SIZE", "1"),
            ];
            let goal = job.build.optimize;
            let built = sources.firmware(PROGRAM, board, goal, &variables, interrupt)?;
            let run = match built {
                Ok(program) => emulator.run(board, &program, interrupt)?,
                Err(why) => Err(format!("not built: {why}")),
            };
            rows.extend(KERNELS.map(|kernel| row(kernel, board, arith, &run)));
            progress.step();
        }
    }
    drop(progress);
    let report = MeasureReport {
        with: With::of(&sources, &job.boards),
        rows,
    };
    report.write(&COLUMNS, job, interrupt)?;
    let results = job.json.iter().chain(&job.csv);
    output::write_report(results, interrupt, |out| {
        out.write_all(text(&report.rows).as_bytes())
    })?;
    super::all_done(failures(&report.rows).len())
}

fn row(
    (kernel, cost): (&'static str, Cost),
    board: &'static Board,
    arith: Arith,
    run: &Result<Run, String>,
) -> KernelRow {
    let value = |name: &str| run.as_ref().ok()?.values.get(name);
    let measured = run
        .as_ref()
        .map_err(Clone::clone)
        .and_then(|run| measure(cost, run).ok_or_else(|| "a wrong number of calls".into()));
    let shape = kernel.strip_prefix("hit ");
    KernelRow {
        kernel,
        board,
        target: board.target,
        core: board.core,
        arith,
        format: value("arith").and_then(|name| Format::named(name)),
        calls: measured.as_ref().ok().map(|m| m.0),
        instructions: measured.as_ref().ok().map(|m| m.1),
        per_call: (measured.as_ref().ok()).map(|&(calls, n)| n as f64 / calls as f64),
        hits: shape.and_then(|shape| value(shape)?.parse().ok()),
        outcome: measured.err().unwrap_or_else(|| "ok".into()),
    }
}

/// Returns the number of calls and their instructions; `None` if two functions were not called equally often.
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
                Some(name) => run.values.get(name)?.parse().ok().filter(|n| *n > 0)?,
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

    fn run(values: &[(&str, &str)]) -> Run {
        let report = "instructions 9\ncalls 4 12 a::kernel_empty\ncalls 2 30 a::kernel_add\n\
            calls 5 500 a::kernel_walk\ncalls 5 100 a::kernel_root\n\
            calls 3 90 a::kernel_two_lights\ncalls 2 30 a::kernel_one_light\n";
        let values = values.iter().map(|&(name, n)| (name.into(), n.into()));
        Run {
            values: values.collect::<BTreeMap<_, _>>(),
            count: Count::parse(report).unwrap(),
        }
    }

    #[test]
    fn calls_are_not_part_of_the_cost() {
        assert_eq!(measure(Cost::Of("kernel_add"), &run(&[])), Some((2, 24)));
        assert_eq!(measure(Cost::Of("kernel_mul"), &run(&[])), None);
    }

    #[test]
    fn differences_need_equal_numbers_of_calls() {
        let step = Cost::Beyond("kernel_walk", "kernel_root", Some("steps"));
        assert_eq!(measure(step, &run(&[("steps", "8")])), Some((8, 400)));
        assert_eq!(measure(step, &run(&[("steps", "0")])), None);
        assert_eq!(measure(step, &run(&[])), None);
        let light = Cost::Beyond("kernel_two_lights", "kernel_one_light", None);
        assert_eq!(measure(light, &run(&[])), None);
    }

    #[test]
    fn a_failed_run_has_no_numbers() {
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
