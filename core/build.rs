//! Sets what stable compilers do not show in `target_feature`, by the target's name: whether a
//! RISC-V target has the F extension (`scalar::root`), whether an Arm target lacks a long
//! multiplication (`scalar::multiply`), whether leading zeros are to be counted without an
//! instruction (`scalar::zeros`), and whether floats are emulated (`scalar::whole`,
//! `shape`).

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!(
        "cargo::rustc-check-cfg=cfg(octray_riscv_f, octray_armv6m, octray_no_clz, octray_soft_float)"
    );
    let target = env::var("TARGET").unwrap_or_default();
    if target.starts_with("thumbv6m") {
        println!("cargo::rustc-cfg=octray_armv6m");
    }
    let extensions = target
        .split_once('-')
        .and_then(|(cpu, _)| cpu.strip_prefix("riscv32").or(cpu.strip_prefix("riscv64")));
    if extensions.is_some_and(|letters| letters.contains(['f', 'g'])) {
        println!("cargo::rustc-cfg=octray_riscv_f");
    }
    if target.starts_with("thumbv6m") || target.starts_with("riscv32") {
        println!("cargo::rustc-cfg=octray_no_clz");
    }
    let soft_riscv = extensions.is_some_and(|letters| !letters.contains(['f', 'g']));
    if soft_riscv || target.starts_with("thumb") && !target.ends_with("hf") {
        println!("cargo::rustc-cfg=octray_soft_float");
    }
}
