//! The examples are built and run as their reader would, each a project of its own, and make the pictures that the host
//! makes of their scenes.

use octray_render::{Arith, RenderSettings, picture, render, scenes};
use octray_scenes::model::{Scene, Shape};
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where all examples are built.
fn target() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("../examples")
}

/// Runs cargo in an example's folder, without the settings of this build.
fn cargo(example: &str, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .arg("--locked")
        .current_dir(root().join("examples").join(example))
        .env("CARGO_TARGET_DIR", target())
        .env_remove("CARGO_BUILD_TARGET")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match output.status.success() {
        true => Ok(text(&output.stdout)),
        false => Err(text(&output.stderr)),
    }
}

/// The lines that an example prints on an emulated board; none if there is no emulator or no library for its target.
fn emulated(example: &str, emulator: &str) -> Option<Vec<String>> {
    if Command::new(emulator).arg("--version").output().is_err() {
        eprintln!("not tested: {emulator} is missing");
        return None;
    }
    match cargo(example, &["run", "--release"]) {
        Ok(text) => Some(text.lines().map(str::to_owned).collect()),
        Err(why) if why.contains("target may not be installed") => {
            eprintln!("not tested: the target of {example} is not installed");
            None
        }
        Err(why) => panic!("{example}: {why}"),
    }
}

/// The hash of a scene's picture.
fn hash(scene: &Scene, arith: Arith, size: (u32, u32)) -> String {
    let settings = RenderSettings {
        arith,
        size: Some(size),
        ..RenderSettings::DEFAULT
    };
    let rendering = render(scene, &settings).unwrap();
    format!("{:016x}", rendering.picture.hash())
}

#[test]
fn examples_use_the_versions_that_are_tested() {
    let packages = |folder: &Path| -> Vec<String> {
        let lock = std::fs::read_to_string(folder.join("Cargo.lock")).unwrap();
        let pair = |package: &str| package.lines().take(3).collect::<Vec<_>>().join(" ");
        lock.split("[[package]]").skip(1).map(pair).collect()
    };
    let known = packages(&root());
    let mut count = 0;
    for folder in std::fs::read_dir(root().join("examples")).unwrap() {
        let folder = folder.unwrap().path();
        if !folder.join("Cargo.toml").is_file() {
            continue;
        }
        count += 1;
        let name = folder.file_name().unwrap().to_string_lossy();
        for package in packages(&folder) {
            let ours = package.contains(&format!("{name:?}")) || known.contains(&package);
            assert!(
                ours,
                "{name}: {package} is not in the workspace's Cargo.lock: copy that, then `cargo metadata`"
            );
        }
    }
    assert!(count >= 4);
}

#[test]
fn hello_host_saves_its_picture() {
    let built = cargo("hello-host", &["build"]);
    assert!(built.is_ok(), "{built:?}");
    let folder = tempfile::tempdir().unwrap();
    let program = format!("debug/hello-host{}", std::env::consts::EXE_SUFFIX);
    let run = Command::new(target().join(program))
        .current_dir(&folder)
        .output()
        .unwrap();
    // Fixed point: the same on every machine.
    let hash = "4af436c2965fff68";
    let text = String::from_utf8_lossy(&run.stdout);
    assert_eq!(text, format!("hello.png: hash {hash}\n"));
    let saved = picture::read(&folder.path().join("hello.png")).unwrap();
    assert_eq!(format!("{:016x}", saved.hash()), hash);
}

#[test]
fn hello_makes_the_hosts_picture_on_boards() {
    let scene = scenes::read(root().join("scenes/figure-22.scene")).unwrap();
    let hash = hash(&scene, Arith::Auto, (64, 48));
    for (example, emulator) in [
        ("hello-cortex-m", "qemu-system-arm"),
        ("hello-riscv", "qemu-system-riscv32"),
    ] {
        if let Some(lines) = emulated(example, emulator) {
            let expected = format!("figure-22 in i4f28: hash {hash}");
            assert_eq!(lines, [expected], "{example}");
        }
    }
}

/// The pictures of a ball that is moved, in memory that is lent, are those of scenes that have it there.
#[test]
fn a_bouncing_ball_is_where_the_host_puts_it() {
    let mut scene = scenes::read(root().join("examples/bouncing-ball/ball.scene")).unwrap();
    scene.room = Some([[-0.5, 0.0, -0.5], [0.5, 2.6, 0.5]]);
    let mut expected = Vec::new();
    for height in [1.8125, 1.75, 1.625] {
        let Shape::Sphere { centre, .. } = &mut scene.objects[0].shape else {
            panic!("object 0 is the ball");
        };
        centre[1] = height;
        expected.push(hash(&scene, Arith::I16F16, (64, 48)));
    }
    if let Some(lines) = emulated("bouncing-ball", "qemu-system-arm") {
        assert_eq!(lines, expected);
    }
    let triple = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
    if cfg!(not(target_os = "linux")) {
        return;
    }
    let built = cargo("bouncing-ball", &["build", "--target", &triple]);
    assert!(built.is_ok(), "{built:?}");
    let folder = tempfile::tempdir().unwrap();
    let run = Command::new(target().join(triple).join("debug/bouncing-ball"))
        .current_dir(&folder)
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[..3], expected);
    // The ball comes back to where it was.
    assert_eq!((lines.len(), lines.last()), (26, lines.first()));
    let bytes = std::fs::read(folder.path().join("bounce.apng")).unwrap();
    assert!(bytes.windows(4).filter(|chunk| chunk == b"fcTL").count() == 26);
}
