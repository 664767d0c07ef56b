//! Bakes the scene and copies the board's memory layout.
//!
//! | variable | what | default |
//! | --- | --- | --- |
//! | `OCTRAY_SCENE` | the scene file, relative to the workspace | `scenes/figure-22.scene` |
//! | `OCTRAY_LIGHTS` | how many of its first lights are kept | all |
//! | `OCTRAY_OPAQUE` | `1`: no surface reflects or refracts | `0` |
//! | `OCTRAY_ARITH` | the arithmetic | `auto` |
//! | `OCTRAY_SIZE` | columns x rows | `160x120` |
//! | `OCTRAY_TREE` | `compact-bvh8`, `device` (the same, built on the board), `none`, or `auto`: the cheaper one |
//! `auto` |
//! | `OCTRAY_MAX_DEPTH` | maximum number of bounces | 8 |
//! | `OCTRAY_LEAF_SIZE` | nodes of up to this many objects are not divided | 1 if a hit test costs far more than a box
//! test, otherwise 2 |
//! | `OCTRAY_PIXELS_PER_RAY` | 1, or 4 in squares of two by two | 1 |
//! | `OCTRAY_CUT_OFF` | rays of a smaller weight, from 0 to 1, are not traced | 1/512 |
//! | `OCTRAY_PLAN` | a plan of `octray plan --emit` for this scene, which replaces all settings above except the
//! scene and what is left out of it | none |
//! | `OCTRAY_BOARD` | RISC-V only: `virt` or `sifive_e` | `virt` |

use octray_prepare::bake::{BakeOptions, bake};
use octray_prepare::choice::Choice;
use octray_prepare::plan::{Plan, PlanError};
use octray_prepare::{Arith, FirmwareTree, PixelsPerRay, RenderSettings, TreeSettings};
use octray_scenes::model::Scene;
use octray_scenes::reduce::Reduction;
use std::num::NonZeroU32;
use std::path::Path;
use std::{env, fs, process};

fn main() {
    if let Err(message) = run() {
        println!("cargo::error={message}");
        process::exit(1);
    }
}

/// Returns the value of a variable, or its default; the build is repeated when the variable changes.
fn variable(name: &str, default: &str) -> String {
    println!("cargo::rerun-if-env-changed={name}");
    env::var(name).unwrap_or_else(|_| default.into())
}

fn number(name: &str, default: u32) -> Result<u32, String> {
    let text = variable(name, &default.to_string());
    text.parse()
        .map_err(|_| format!("{name}={text}: expected a number"))
}

/// Parses one of a list of names.
fn named<T: Choice>(name: &str, default: &str) -> Result<T, String> {
    let text = variable(name, default);
    T::named(&text).ok_or_else(|| {
        let known: Vec<_> = T::all().into_iter().map(T::name).collect();
        format!("{name}={text}: expected one of {}", known.join(", "))
    })
}

fn run() -> Result<(), String> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=link");
    println!("cargo::rustc-check-cfg=cfg(octray_device_tree)");
    let out = env::var("OUT_DIR").map_err(|error| error.to_string())?;
    let source = baked()?;
    let written = fs::write(Path::new(&out).join("baked.rs"), source);
    written.map_err(|error| format!("cannot write the baked scene: {error}"))?;
    let board = variable("OCTRAY_BOARD", "virt");
    let arch = env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default();
    let bare = env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none");
    let layout = match (&*arch, &*board) {
        _ if !bare => return Ok(()),
        ("arm", _) => "cortex-m",
        ("riscv32", "virt" | "sifive_e") => &board,
        ("riscv32", _) => return Err(format!("no memory layout for board {board}")),
        _ => return Err(format!("no start-up code for {arch}")),
    };
    let copied = fs::copy(format!("link/{layout}.x"), Path::new(&out).join("memory.x"));
    copied.map_err(|error| format!("cannot copy the memory layout: {error}"))?;
    println!("cargo::rustc-link-search={out}");
    if arch == "riscv32" {
        println!("cargo::rustc-link-arg-bins=-Tmemory.x");
    }
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    Ok(())
}

fn baked() -> Result<String, String> {
    let path = Path::new("..").join(variable("OCTRAY_SCENE", "scenes/figure-22.scene"));
    println!("cargo::rerun-if-changed={}", path.display());
    let mut scene = octray_scenes::read(&path).map_err(|error| error.to_string())?;
    (reduction()?.apply(&mut scene)).map_err(|error| format!("OCTRAY_LIGHTS: {error}"))?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let plan = variable("OCTRAY_PLAN", "");
    if !plan.is_empty() {
        let plan = read_plan(&Path::new("..").join(plan))?;
        let options = plan.options(&scene, &name);
        let options = options.map_err(|error| format!("OCTRAY_PLAN: {error}"))?;
        return baked_as(&scene, &options);
    }
    let size = variable("OCTRAY_SIZE", "160x120");
    let (width, height) = (size.split_once('x'))
        .and_then(|(w, h)| Some((w.parse::<u16>().ok()?, h.parse::<u16>().ok()?)))
        .filter(|(w, h)| *w > 0 && *h > 0)
        .ok_or_else(|| format!("OCTRAY_SIZE={size}: expected columns x rows such as 160x120"))?;
    let target = env::var("TARGET").unwrap_or_default();
    let arith: Arith = named("OCTRAY_ARITH", "auto")?;
    let tree: FirmwareTree = named("OCTRAY_TREE", "auto")?;
    let max_depth = number("OCTRAY_MAX_DEPTH", RenderSettings::DEFAULT.max_depth)?;
    let format = arith.format(&scene, max_depth);
    let kind = tree.kind_for(scene.objects.len(), format, Some(&target));
    let options = BakeOptions {
        name: &name,
        settings: RenderSettings {
            arith,
            tree: TreeSettings {
                // 0 means the default.
                leaf_size: NonZeroU32::new(number("OCTRAY_LEAF_SIZE", 0)?),
                ..TreeSettings::of(kind)
            },
            size: Some((width.into(), height.into())),
            pixels_per_ray: named::<PixelsPerRay>("OCTRAY_PIXELS_PER_RAY", "1")?,
            max_depth,
            cut_off: cut_off()?,
            ..RenderSettings::DEFAULT
        },
        on_device: tree.on_device,
        target: Some(&target),
        rays: None,
    };
    baked_as(&scene, &options)
}

fn reduction() -> Result<Reduction, String> {
    let lights = variable("OCTRAY_LIGHTS", "");
    let opaque = variable("OCTRAY_OPAQUE", "0");
    Ok(Reduction {
        lights: match &*lights {
            "" => None,
            text => Some(
                (text.parse()).map_err(|_| format!("OCTRAY_LIGHTS={text}: expected a number"))?,
            ),
        },
        opaque: match &*opaque {
            "0" => false,
            "1" => true,
            other => return Err(format!("OCTRAY_OPAQUE={other}: expected 0 or 1")),
        },
    })
}

fn cut_off() -> Result<f64, String> {
    let text = variable(
        "OCTRAY_CUT_OFF",
        &RenderSettings::DEFAULT.cut_off.to_string(),
    );
    (text.parse().ok())
        .filter(|weight| (0.0..=1.0).contains(weight))
        .ok_or_else(|| format!("OCTRAY_CUT_OFF={text}: expected a number from 0 to 1"))
}

fn baked_as(scene: &Scene, options: &BakeOptions<'_>) -> Result<String, String> {
    if options.on_device {
        println!("cargo::rustc-cfg=octray_device_tree");
    }
    bake(scene, options)
        .map(|baked| baked.source)
        .map_err(|error| error.to_string())
}

fn read_plan(path: &Path) -> Result<Plan, String> {
    println!("cargo::rerun-if-changed={}", path.display());
    let at = |error: String| format!("{}: {error}", path.display());
    let text = fs::read_to_string(path).map_err(|error| at(error.to_string()))?;
    text.parse()
        .map_err(|error: PlanError| at(error.to_string()))
}
