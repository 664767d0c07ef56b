//! `octray render --mpi` on the ranks of an MPI job: the picture equals that of one machine, and a failed job leaves
//! nothing behind. Needs `--features mpi` and Open MPI.
#![cfg(feature = "mpi")]

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const OCTRAY: &str = env!("CARGO_BIN_EXE_octray-command");

/// A ball between mirrors, and a background above and below.
const SCENE: &str = "v 0 0 -300 resolution 61 83 b 0.2 0.3 0.5 l 100 200 -300 1
    f 0.1 0 0 0.5 0.4 0.2 0.3 0.3 0.3 9 0.4 0 s 0 0 40 18
    f 0 0 0 0.1 0.1 0.1 0 0 0 1 0.8 0 p 4 -30 -20 10 -30 20 10 -10 20 90 -10 -20 90";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.scene"), SCENE).unwrap();
    folder
}

/// Returns a command with any number of ranks on this machine.
fn mpirun(folder: &Path) -> Command {
    let mut command = Command::new("mpirun");
    command
        .current_dir(folder)
        .args(["--oversubscribe", "--allow-run-as-root"]);
    command
}

fn run(folder: &Path, ranks: u32, line: &str) -> Output {
    let mut command = mpirun(folder);
    command.args(["-n", &ranks.to_string(), OCTRAY]);
    command.args(line.split_whitespace()).output().unwrap()
}

/// Returns the statistics of a rendering without MPI.
fn alone(folder: &Path, line: &str) -> Value {
    let mut command = Command::new(OCTRAY);
    command.current_dir(folder).args(line.split_whitespace());
    let output = command.args(["--stats", "json"]).output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn ranks_draw_the_picture_of_one_machine() {
    let folder = folder();
    let path = folder.path();
    let option_sets = [
        "",
        "--schedule static --tile-rows 4",
        "--schedule work-stealing --tile-rows 5 --tile-columns 8",
    ];
    for (ending, arith) in [("png", "f32"), ("pfm", "i16f16")] {
        alone(
            path,
            &format!("render a.scene --arith {arith} -o one.{ending}"),
        );
        let one = fs::read(path.join("one").with_extension(ending)).unwrap();
        for (ranks, options) in [1, 2, 4].into_iter().zip(option_sets) {
            let line = format!(
                "render a.scene --mpi --arith {arith} --stats json {options} -o b.{ending}"
            );
            let output = run(path, ranks, &line);
            assert!(output.status.success(), "{ranks}: {}", text(&output.stderr));
            let many = fs::read(path.join("b").with_extension(ending)).unwrap();
            assert!(one == many, "{ranks} ranks {options}: another picture");
            let stats: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(stats["threads"], ranks);
            let idle = stats["idle"].as_array().map(Vec::len);
            assert_eq!(idle, Some(ranks as usize));
            let messages = &stats["messages"];
            let count = |field: &str| messages[field].as_u64().unwrap();
            let tiles = stats["tiles"].as_u64().unwrap();
            assert!(count("count") <= tiles);
            if ranks == 1 {
                assert_eq!(count("bytes"), 0);
            }
            if count("count") > 0 {
                assert!(messages["hand_out"].as_f64().unwrap() > 0.0);
            }
            if options.contains("static") {
                // With two ranks, the second one has every other tile.
                assert_eq!((ranks, count("count")), (2, tiles / 2));
            }
            let line = format!("render a.scene --arith {arith} -o c.{ending}");
            let same = alone(path, &line);
            for field in ["rays", "steps", "tests", "hits", "saturations"] {
                assert_eq!(
                    stats[field], same[field],
                    "{ranks} ranks {options}: {field}"
                );
            }
        }
    }
    assert_eq!(
        names(path),
        [
            "a.scene", "b.pfm", "b.png", "c.pfm", "c.png", "one.pfm", "one.png"
        ]
    );
}

#[test]
fn other_ranks_need_no_files() {
    let folder = folder();
    let elsewhere = TempDir::new().unwrap();
    let mut command = mpirun(folder.path());
    let line = "render a.scene --mpi --stats none --schedule static --tile-rows 4 -o b.png";
    command.args(["-n", "1", OCTRAY]).args(line.split(' '));
    command
        .args([":", "-n", "2", "-wdir"])
        .arg(elsewhere.path());
    command.arg(OCTRAY).args(line.split(' '));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    alone(folder.path(), "render a.scene -o one.png");
    let bytes = |name| fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("b.png") == bytes("one.png"), "another picture");
    assert!(names(elsewhere.path()).is_empty());
}

#[test]
fn a_scene_with_mistakes_ends_all_ranks_with_one_message() {
    let folder = folder();
    fs::write(folder.path().join("bad.scene"), "v 0 0 -9 blob 1").unwrap();
    let output = run(folder.path(), 3, "render bad.scene --mpi");
    assert_eq!(output.status.code(), Some(1));
    let stderr = text(&output.stderr);
    assert_eq!(
        stderr.matches("bad.scene:1:10: error").count(),
        1,
        "{stderr}"
    );
    assert_eq!(names(folder.path()), ["a.scene", "bad.scene"]);
}

/// One rank is killed while it works.
#[test]
fn a_rank_that_dies_is_reported_and_leaves_no_picture() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("b.png"), "old").unwrap();
    let line = "render a.scene --mpi --size 2000x2000 --samples 32 -o b.png";
    let mut command = mpirun(path);
    command.args(["-n", "1", OCTRAY]).args(line.split(' '));
    command.args([
        ":",
        "-n",
        "1",
        "sh",
        "-c",
        "echo $$ > pid; exec \"$0\" \"$@\"",
        OCTRAY,
    ]);
    command.args(line.split(' '));
    let job = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let job = job.unwrap();
    let begin = Instant::now();
    let pid = loop {
        let pid = fs::read_to_string(path.join("pid")).unwrap_or_default();
        if pid.ends_with('\n') {
            break pid;
        }
        assert!(
            begin.elapsed() < Duration::from_secs(60),
            "no rank has started"
        );
        sleep(Duration::from_millis(20));
    };
    // The picture takes minutes; after this time it is incomplete.
    sleep(Duration::from_secs(2));
    let kill = Command::new("kill").args(["-KILL", pid.trim()]).status();
    assert!(kill.unwrap().success());
    let output = job.wait_with_output().unwrap();
    let stderr = text(&output.stderr);
    assert!(!output.status.success(), "{stderr}");
    assert!(
        stderr.contains("rank 1") && stderr.contains("signal 9"),
        "{stderr}"
    );
    assert_eq!(names(path), ["a.scene", "b.png", "pid"]);
    assert_eq!(fs::read(path.join("b.png")).unwrap(), b"old");
}
