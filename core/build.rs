//! Tells `scalar::root` whether a RISC-V target has the F extension, which stable compilers do not
//! say in `target_feature`, and `scalar::multiply` whether an Arm target lacks a long
//! multiplication; the target's name does.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(octray_riscv_f, octray_armv6m)");
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
}
