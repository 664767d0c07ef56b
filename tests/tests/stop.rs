//! One Ctrl-C or SIGTERM ends any command within a second, wherever it is, and leaves nothing behind.
#![cfg(target_os = "linux")]

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A second, and what a machine takes that does much else.
const SOON: Duration = Duration::from_secs(6);

/// Until a command is at its work.
const BEGUN: Duration = Duration::from_millis(300);

/// Glass and mirrors in one another: rays double at every bounce.
const HALL: &str = "v 0 0 4 at 0 0 0 up 0 1 0 angle 60 resolution 16 16 b 0.2 0.3 0.4
l 0 5 5 1 f 0 0 0 0.1 0.1 0.1 0.1 0.1 0.1 9 1 1 1.3
s 0 0 0 9 s 0 0 0 8.5 s 0 0 0 8 s 1 0 0 1.5 s -2 0 0 1 s 0 2 0 1.2 s 0 -2 0 1.1";

/// Balls so near to each other that a tree of cells hardly ever separates them.
fn crowd() -> String {
    let ball = |i: u32| {
        format!(
            "s {} {} 0 1\n",
            f64::from(i % 50) * 1e-6,
            f64::from(i / 50) * 1e-6
        )
    };
    let balls: String = (0..3000).map(ball).collect();
    format!("v 0 0 4 at 0 0 0 up 0 1 0 angle 60 l 0 5 5 1 f 1 1 1 1 0 0 0 0 {balls}")
}

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("hall.scene", HALL);
    write("crowd.scene", &crowd());
    let ball = "s 0 0 0 1 ".repeat(3_000_000);
    write("long.scene", &format!("v 0 0 9 f 1 1 1 1 0 0 0 0 {ball}"));
    let made = Command::new("mkfifo")
        .arg(folder.path().join("fifo"))
        .status();
    assert!(made.unwrap().success());
    folder
}

fn start(folder: &Path, line: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_octray-command"))
        .current_dir(folder)
        .env("TMPDIR", folder)
        .args(line.split_whitespace())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits until a command handles signals: before that, it has not begun.
fn listens(child: &Child) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    caught.unwrap_or(0) & 0b10 != 0
}

/// Sends a signal to a command that is at its work. How it ended; `None` if it had done all its work before.
fn stopped(mut child: Child, signal: &str) -> Option<(ExitStatus, Duration)> {
    // Waiting would close it.
    let _stdin = child.stdin.take();
    while !listens(&child) {
        if child.try_wait().unwrap().is_some() {
            return None;
        }
        thread::sleep(Duration::from_millis(5));
    }
    thread::sleep(BEGUN);
    if child.try_wait().unwrap().is_some() {
        return None;
    }
    let begin = Instant::now();
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args([signal, &id])
            .status()
            .unwrap()
            .success()
    );
    let status = child.wait().unwrap();
    Some((status, begin.elapsed()))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Checks that a command that takes minutes, or for ever, ends soon after either signal.
fn check(lines: &[&str], may_be_done: bool) {
    let folder = folder();
    let before = names(folder.path());
    for line in lines {
        for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
            let child = start(folder.path(), line);
            match stopped(child, signal) {
                None => assert!(may_be_done, "{line}: done"),
                Some((status, took)) => {
                    assert_eq!(status.code(), Some(code), "{line}");
                    assert!(took < SOON, "{line}: {took:?}");
                }
            }
            assert_eq!(names(folder.path()), before, "{line}");
        }
    }
}

#[test]
fn while_one_pixel_branches_for_ever() {
    let deep = "--max-depth 64 --cut-off 0";
    check(
        &[
            &format!("render hall.scene -o a.png --threads 1 --size 1x1 {deep}"),
            &format!("render hall.scene -o a.png --threads 3 --tile-rows 65535 {deep}"),
            &format!("render hall.scene -o a.png --schedule cost-ordered {deep}"),
            &format!("render hall.scene -o a.png --samples adaptive --threads 2 {deep}"),
            &format!("render hall.scene -o a.png --frames 3 --orbit 9 {deep}"),
            &format!("render hall.scene -o a.apng --frames 3 --orbit 9 {deep}"),
            "schedule hall.scene --csv a.csv --max-depth 64",
        ],
        false,
    );
}

#[test]
fn while_the_laboratory_works() {
    check(
        &[
            "plan hall.scene --size 600x600 --emit a.plan",
            "chart hall.scene --size 600x600 --cost events --csv a.csv",
            "stability --json a.json",
            "report hall.scene -o a.html --size 600x600",
        ],
        true,
    );
}

#[test]
fn while_nobody_writes_to_a_pipe() {
    check(
        &[
            "check fifo",
            "render fifo -o a.png",
            "render hall.scene --path fifo -o a.png",
            "trace fifo -p 0,0",
            "convert fifo a.png",
            "overlaps fifo",
            "diff fifo fifo -o a.png",
            "bake --plan fifo hall.scene -o a.rs",
            "tables --thesis fifo -o a.txt",
            "render - -o a.png",
        ],
        false,
    );
}

#[test]
fn while_a_scene_is_parsed_and_made_ready() {
    check(
        &[
            "check long.scene",
            "render long.scene -o a.png --tree plain --size 9x9",
            "render long.scene -o a.png --wire --size 9x9",
            "trace long.scene -p 0,0 -o a.svg",
            "overlaps long.scene",
            "overlaps crowd.scene",
            "render crowd.scene -o a.png --tree plain --tree-depth 24 --leaf-size 1 --arena 99999999",
            "bake long.scene -o a.rs",
        ],
        true,
    );
}

/// A reader that takes nothing: the command waits for it.
#[test]
fn while_nobody_reads_the_result() {
    let folder = folder();
    let mut child = start(folder.path(), "generate terrain --count 300000");
    let mut start = [0; 9];
    child
        .stdout
        .as_mut()
        .unwrap()
        .read_exact(&mut start)
        .unwrap();
    let (status, took) = stopped(child, "-TERM").unwrap();
    assert_eq!(status.code(), Some(143));
    assert!(took < SOON, "{took:?}");
}

/// What a killed process leaves is gone after the next.
#[test]
fn a_killed_process_leaves_nothing_for_long() {
    let folder = folder();
    let before = names(folder.path());
    // It has opened its file, and waits for the rest of a picture.
    let mut child = start(folder.path(), "generate terrain --count 2000000 -o a.scene");
    let begin = Instant::now();
    while names(folder.path()) == before && begin.elapsed() < SOON {
        thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let mut next = start(folder.path(), "generate soup --count 3 -o b.scene");
    assert!(next.wait().unwrap().success());
    let left: Vec<_> = names(folder.path())
        .into_iter()
        .filter(|name| name.starts_with(".octray"))
        .collect();
    assert_eq!(left, [""; 0]);
}

#[test]
fn a_scene_and_its_picture_go_through_pipes() {
    let folder = folder();
    let made = start(folder.path(), "generate soup --count 9")
        .wait_with_output()
        .unwrap();
    let mut child = start(folder.path(), "render - -o - --size 20x10");
    child.stdin.take().unwrap().write_all(&made.stdout).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    fs::write(folder.path().join("soup.scene"), &made.stdout).unwrap();
    for line in [
        "render soup.scene -o soup.png --size 20x10",
        "render soup.scene -o /dev/stdout --size 20x10",
    ] {
        let same = start(folder.path(), line).wait_with_output().unwrap();
        let picture = match same.stdout.starts_with(b"\x89PNG") {
            true => same.stdout,
            false => fs::read(folder.path().join("soup.png")).unwrap(),
        };
        assert_eq!(picture, output.stdout, "{line}");
    }
    // What is told besides is no part of the picture.
    assert!(String::from_utf8_lossy(&output.stderr).contains("20 x 10 pixels"));
    let unnamed = start(folder.path(), "render -").wait_with_output().unwrap();
    assert_eq!(unnamed.status.code(), Some(2));
    // Both through pipes that have names.
    let path = folder.path().join("fifo");
    let reader = thread::spawn(move || fs::read(path).unwrap());
    let named = start(folder.path(), "render soup.scene -o fifo --size 20x10");
    assert!(named.wait_with_output().unwrap().status.success());
    assert_eq!(reader.join().unwrap(), output.stdout);
}
