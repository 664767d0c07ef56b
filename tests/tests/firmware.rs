//! The firmware on every board: it builds without warnings, renders the same bytes as the host in fixed point and in
//! floats (soft and hard), needs no divisions in fixed point, uses the floating-point unit's square roots, and stays
//! within the documented memory.
//!
//! Boards whose target is not installed, or whose emulator is missing, are skipped and reported.

use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind};
use octray_core::accel::BuildOptions;
use octray_core::quantize::Quantize;
use octray_core::scalar::Fixed;
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_prepare::format::Format;
use octray_prepare::plan::{Plan, fingerprint};
use octray_prepare::quantise::quantise;
use octray_prepare::saturation::{PerThread, saturations};
use octray_prepare::settings::{PixelsPerRay, RenderSettings};
use octray_prepare::tree::{Growth, OwnedBvh8};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, thread};

/// A board that the emulator supports.
#[derive(Clone, Copy, Debug)]
struct Board {
    target: &'static str,
    machine: &'static str,
}

const fn board(target: &'static str, machine: &'static str) -> Board {
    Board { target, machine }
}

const MICROBIT: Board = board("thumbv6m-none-eabi", "microbit");

const BOARDS: [Board; 8] = [
    MICROBIT,
    board("thumbv7m-none-eabi", "lm3s6965evb"),
    board("thumbv7em-none-eabi", "mps2-an386"),
    board("thumbv7em-none-eabihf", "mps2-an386"),
    board("thumbv7em-none-eabihf", "mps2-an500"),
    board("riscv32imac-unknown-none-elf", "virt"),
    board("riscv32imac-unknown-none-elf", "sifive_e"),
    board("riscv32imafc-unknown-none-elf", "virt"),
];

impl Board {
    fn is_arm(self) -> bool {
        self.target.starts_with("thumb")
    }

    fn emulator(self) -> &'static str {
        match self.is_arm() {
            true => "qemu-system-arm",
            false => "qemu-system-riscv32",
        }
    }

    /// Returns how to install what is missing, if anything.
    fn missing(self) -> Option<String> {
        let found = Command::new("rustc")
            .args(["--print", "target-libdir", "--target", self.target])
            .output()
            .is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir());
        if !found {
            return Some(format!("rustup target add {}", self.target));
        }
        let runs = Command::new(self.emulator()).arg("--version").output();
        let package = ["qemu-system-misc", "qemu-system-arm"][usize::from(self.is_arm())];
        (!runs.is_ok_and(|output| output.status.success()))
            .then(|| format!("apt-get install {package}"))
    }
}

/// The rendering.
#[derive(Clone, Copy, Debug)]
struct Job {
    scene: &'static str,
    arith: &'static str,
    size: (u32, u32),
    tree: &'static str,
}

/// Locks the build folder, which all boards share.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Builds the firmware; any warning fails the test.
fn build(board: Board, job: Job) -> PathBuf {
    build_with(board, job, &[])
}

fn build_with(board: Board, job: Job, arguments: &[&str]) -> PathBuf {
    build_as(board, job, arguments, None)
}

/// As a plan says, if there is one.
fn build_as(board: Board, job: Job, arguments: &[&str], plan: Option<&Path>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("firmware");
    let (width, height) = job.size;
    let output = Command::new(env!("CARGO"))
        .current_dir(root())
        .args([
            "build",
            "-p",
            "octray-firmware-sim",
            "--profile",
            "firmware",
        ])
        .args(["--target", board.target])
        .args(arguments)
        .env("CARGO_TARGET_DIR", &folder)
        .env("OCTRAY_SCENE", job.scene)
        .env("OCTRAY_ARITH", job.arith)
        .env("OCTRAY_SIZE", format!("{width}x{height}"))
        .env("OCTRAY_BOARD", board.machine)
        .env("OCTRAY_TREE", job.tree)
        .env_remove("OCTRAY_MAX_DEPTH")
        .env_remove("OCTRAY_LEAF_SIZE")
        .env_remove("OCTRAY_COUNTS")
        .env_remove("RUSTFLAGS")
        .env("OCTRAY_PLAN", plan.unwrap_or(Path::new("")))
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{board:?} {job:?}\n{stderr}");
    assert!(!stderr.contains("warning"), "{board:?} {job:?}\n{stderr}");
    folder
        .join(board.target)
        .join("firmware")
        .join("octray-firmware")
}

/// Runs it. A run that exceeds the timeout is a failure.
fn run(board: Board, firmware: &Path) -> Output {
    let mut command = Command::new(board.emulator());
    command.args(["-M", board.machine]);
    if !board.is_arm() && board.machine == "virt" {
        command.args(["-bios", "none"]);
    }
    command
        .args(["-semihosting-config", "enable=on,target=native"])
        .args(["-display", "none", "-monitor", "none", "-serial", "none"])
        .args(["-icount", "shift=0", "-kernel"])
        .arg(firmware);
    run_for(command, Duration::from_secs(120))
}

/// Runs it and returns its output, line by line.
fn emulate(board: Board, firmware: &Path) -> Vec<(String, String)> {
    let output = run(board, firmware);
    let text = [&*output.stdout, &*output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    assert!(
        output.status.success(),
        "{board:?}: {}\n{text}",
        output.status
    );
    text.lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(name, value)| (name.into(), value.into()))
        .collect()
}

fn run_for(mut command: Command, time: Duration) -> Output {
    use std::process::Stdio;
    let mut child = (command.stdin(Stdio::null()))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begin.elapsed() > time {
            child.kill().unwrap();
            panic!("{command:?} did not end");
        }
        thread::sleep(Duration::from_millis(10));
    }
    child.wait_with_output().unwrap()
}

fn value<'a>(lines: &'a [(String, String)], name: &str) -> &'a str {
    lines
        .iter()
        .find(|(n, _)| n == name)
        .map(|(_, value)| &**value)
        .unwrap_or_else(|| panic!("no {name} in {lines:?}"))
}

/// Returns the hash of the host's picture, with the host's own tree.
fn hash_here<S: Quantize>(job: Job) -> String {
    let scene = octray_scenes::read(root().join(job.scene)).unwrap();
    let (width, height) = job.size;
    let view = RenderSettings {
        size: Some(job.size),
        ..RenderSettings::DEFAULT
    };
    let before = saturations();
    let mut prepared = quantise::<S>(&scene, &view).unwrap();
    let options = BuildOptions {
        depth: 24,
        leaf_size: 2,
    };
    let growth = Growth {
        options,
        arena: None,
    };
    let (tree, _) = OwnedBvh8::build(&mut prepared.scene, &growth);
    let scene = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene,
        accelerator: &tree.tree(),
        max_depth: view.max_depth,
        cut_off: S::from_f64(1.0 / 512.0),
    };
    let mut workspace = Workspace {
        rays: &mut [QueuedRay::EMPTY; 10],
        stack: &mut Default::default(),
        shadow_cache: &mut vec![None; scene.lights.len()],
    };
    let background = scene.background.to_array().map(S::level);
    let mut levels = vec![background; (width * height) as usize];
    prepared
        .frame
        .render(0..height, &tracer, &mut workspace, &mut (), |x, y, c| {
            levels[(y * width + x) as usize] = c.to_array().map(S::level);
        });
    assert_eq!(saturations(), before, "{job:?}");
    let bytes = [width.to_le_bytes(), height.to_le_bytes()].concat();
    let hash = (bytes.iter().chain(levels.as_flattened()))
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
        });
    format!("{hash:016x}")
}

/// Renders on every board, compares with the host, and passes each program to `look`.
fn same_everywhere(job: Job, expected: &str, look: impl Fn(Board, &[u8])) {
    let _alone = alone();
    for board in BOARDS {
        if let Some(install) = board.missing() {
            eprintln!("skipped {board:?}: {install}");
            continue;
        }
        let firmware = build(board, job);
        look(board, &fs::read(&firmware).unwrap());
        let lines = emulate(board, &firmware);
        assert_eq!(value(&lines, "hash"), expected, "{board:?} {job:?}");
        assert_eq!(value(&lines, "arith"), job.arith);
    }
}

/// Checks that no division of the compiler's library is linked, not even outside of the tracer.
fn divides_by_no_routine(board: Board, elf: &[u8]) {
    let elf = object::File::parse(elf).unwrap();
    let names: Vec<_> = elf.symbols().filter_map(|s| s.name().ok()).collect();
    assert!(names.iter().any(|name| name.contains("trace")), "stripped");
    let routines = [
        "__aeabi_idiv",
        "__aeabi_uidiv",
        "__aeabi_ldivmod",
        "__aeabi_uldivmod",
        "__divsi3",
        "__divdi3",
        "__modsi3",
        "__moddi3",
        "__udivsi3",
        "__udivdi3",
        "__udivmod",
        "__umodsi3",
        "__umoddi3",
        "div_rem",
    ];
    let divides: Vec<_> = (names.iter())
        .filter(|name| routines.iter().any(|routine| name.contains(routine)))
        .collect();
    assert!(divides.is_empty(), "{board:?}: {divides:?}");
}

/// Checks that square roots use the instruction of the floating-point unit, not libm.
fn takes_roots_by_the_unit(board: Board, elf: &[u8]) {
    let is_root: fn(u32) -> bool = match board.target {
        // VSQRT.F32, with any registers. The first half-word comes first.
        "thumbv7em-none-eabihf" => |word| word.rotate_left(16) & 0xffbf_0fd0 == 0xeeb1_0ac0,
        // FSQRT.S, with any registers and rounding mode.
        "riscv32imafc-unknown-none-elf" => |word| word & 0xfff0_007f == 0x5800_0053,
        _ => return,
    };
    let elf = object::File::parse(elf).unwrap();
    let found = (elf.sections())
        .filter(|section| section.kind() == SectionKind::Text)
        .filter_map(|section| section.data().ok())
        // Instructions start at even addresses.
        .flat_map(|code| (0..code.len() / 2).filter_map(|i| code[2 * i..].first_chunk()))
        .any(|bytes| is_root(u32::from_le_bytes(*bytes)));
    assert!(found, "{board:?}: no instruction for square roots");
    let libm = (elf.symbols().filter_map(|s| s.name().ok())).any(|name| name.contains("sqrtf"));
    assert!(!libm, "{board:?}: libm's square root is linked");
}

const SMALL: (u32, u32) = (32, 24);

#[test]
fn fixed_point_is_the_same_everywhere() {
    let job = Job {
        scene: "scenes/figure-22.scene",
        arith: "i16f16",
        size: SMALL,
        tree: "packed",
    };
    same_everywhere(
        job,
        &hash_here::<Fixed<16, PerThread>>(job),
        divides_by_no_routine,
    );
}

#[test]
fn floats_are_the_same_everywhere() {
    let job = Job {
        scene: "scenes/glass.scene",
        arith: "f32",
        size: SMALL,
        tree: "packed",
    };
    same_everywhere(job, &hash_here::<f32>(job), takes_roots_by_the_unit);
}

/// The firmware's own float routines and the compiler's agree on boards that use either.
#[test]
fn emulated_floats_equal_the_compilers() {
    let _alone = alone();
    let job = Job {
        scene: "scenes/glass.scene",
        arith: "f32",
        size: SMALL,
        tree: "packed",
    };
    let expected = hash_here::<f32>(job);
    for board in [MICROBIT, BOARDS[1], BOARDS[5]] {
        if let Some(install) = board.missing() {
            eprintln!("skipped {board:?}: {install}");
            continue;
        }
        let lines = emulate(board, &build_with(board, job, &["--no-default-features"]));
        assert_eq!(value(&lines, "hash"), expected, "{board:?}");
        let own = build(board, job);
        let bytes = fs::read(&own).unwrap();
        let symbols = String::from_utf8_lossy(&bytes);
        assert!(
            !symbols.contains("compiler_builtins5float3add"),
            "{board:?} adds by the compiler's routine"
        );
    }
}

#[test]
fn a_tree_may_be_built_on_the_device_or_left_out() {
    let _alone = alone();
    if let Some(install) = MICROBIT.missing() {
        eprintln!("skipped: {install}");
        return;
    }
    let job = |tree| Job {
        scene: "scenes/figure-22.scene",
        arith: "i16f16",
        size: SMALL,
        tree,
    };
    let expected = hash_here::<Fixed<16, PerThread>>(job("packed"));
    for tree in ["device", "none"] {
        let lines = emulate(MICROBIT, &build(MICROBIT, job(tree)));
        assert_eq!(value(&lines, "hash"), expected, "{tree}");
    }
}

/// If a plan has too few rays, the board reports it instead of showing a wrong picture.
#[test]
fn dropped_rays_are_reported() {
    let _alone = alone();
    if let Some(install) = MICROBIT.missing() {
        eprintln!("skipped: {install}");
        return;
    }
    let job = Job {
        scene: "scenes/glass.scene",
        arith: "i16f16",
        size: SMALL,
        tree: "none",
    };
    let scene = octray_scenes::read(root().join(job.scene)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("glass.plan");
    let run_with = |rays| {
        let plan = Plan {
            scene: fingerprint(&scene),
            format: Format::I16F16,
            size: SMALL,
            pixels_per_ray: PixelsPerRay::One,
            max_depth: 8,
            cut_off: 1.0 / 512.0,
            tree: None,
            on_device: false,
            rays,
        };
        fs::write(&file, plan.to_string()).unwrap();
        let output = run(MICROBIT, &build_as(MICROBIT, job, &[], Some(&file)));
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text).into_owned();
        (output.status.code(), text)
    };
    let (code, text) = run_with(1);
    assert_eq!(code, Some(104), "{text}");
    assert!(text.contains("\ndropped "), "{text}");
    // Fewer than are proved to be enough, but this scene branches no more than this.
    let (code, text) = run_with(8);
    assert_eq!(code, Some(0), "{text}");
    assert!(!text.contains("dropped"), "{text}");
    assert!(
        text.contains(&hash_here::<Fixed<16, PerThread>>(job)),
        "{text}"
    );
}

/// Returns the bytes of flash: everything that is loaded.
fn flash(firmware: &Path) -> u64 {
    sum_sections(firmware, |name| {
        !name.starts_with(".bss") && !name.starts_with(".uninit")
    })
}

fn ram(firmware: &Path) -> u64 {
    sum_sections(firmware, |name| {
        [".data", ".bss", ".uninit"]
            .iter()
            .any(|start| name.starts_with(start))
    })
}

fn sum_sections(firmware: &Path, counts: impl Fn(&str) -> bool) -> u64 {
    let bytes = fs::read(firmware).unwrap();
    let elf = object::File::parse(&*bytes).unwrap();
    elf.sections()
        .filter(|section| match section.flags() {
            SectionFlags::Elf { sh_flags, .. } => (sh_flags & object::elf::SHF_ALLOC).0 != 0,
            _ => false,
        })
        .filter(|section| section.name().is_ok_and(&counts))
        .map(|section| section.size())
        .sum()
}

#[test]
fn figure_22_fits_the_smallest_board() {
    let _alone = alone();
    if let Some(install) = MICROBIT.missing() {
        eprintln!("skipped: {install}");
        return;
    }
    let job = Job {
        scene: "scenes/figure-22.scene",
        arith: "auto",
        size: (160, 120),
        tree: "auto",
    };
    let firmware = build(MICROBIT, job);
    let lines = emulate(MICROBIT, &firmware);
    let stack: u64 = value(&lines, "stack").parse().unwrap();
    let (flash, ram) = (flash(&firmware), ram(&firmware) + stack);
    assert!(flash <= 32 << 10, "{flash} bytes of flash");
    assert!(ram <= 8 << 10, "{ram} bytes of RAM");
}

#[test]
fn features_that_a_scene_lacks_are_not_linked() {
    let _alone = alone();
    if let Some(install) = MICROBIT.missing() {
        eprintln!("skipped: {install}");
        return;
    }
    let job = Job {
        scene: "tests/scenes/spheres.scene",
        arith: "auto",
        size: (160, 120),
        tree: "auto",
    };
    let flash = flash(&build(MICROBIT, job));
    assert!(flash <= 12 << 10, "{flash} bytes of flash");
}
