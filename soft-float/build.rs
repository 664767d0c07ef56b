//! Derives the features of the target's core from the target's name, because `target_feature` on stable compilers does
//! not contain them.
//!
//! | flag | meaning |
//! | --- | --- |
//! | `soft_f32` | an Arm or RISC-V core on which the compiler calls routines for `f32` |
//! | `long_multiply` | multiplies 32 x 32 to 64 bits in one or two instructions |
//! | `divide` | divides 32 by 32 bits in one instruction |
//! | `leading_zeros` | counts leading zeros in one instruction |
//!
//! `OCTRAY_SOFT_FLOAT_PLAIN=1` disables the last three, so that a host can test the code for the smallest cores.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=OCTRAY_SOFT_FLOAT_PLAIN");
    println!("cargo::rustc-check-cfg=cfg(soft_f32, long_multiply, divide, leading_zeros)");
    let target = env::var("TARGET").unwrap_or_default();
    let cpu = target.split('-').next().unwrap_or_default();
    let plain = env::var("OCTRAY_SOFT_FLOAT_PLAIN").is_ok_and(|value| value != "0");
    // Arm's microcontroller cores with the full Thumb-2 instruction set have all of these instructions.
    let large_arm = cpu.starts_with("thumbv7") || cpu == "thumbv8m.main";
    let (soft, arithmetic, leading_zeros) = match cpu.strip_prefix("riscv32") {
        Some(letters) => (
            !letters.contains(['f', 'g']),
            letters.contains(['m', 'g']),
            false,
        ),
        None if cpu.starts_with("thumb") => (target.ends_with("eabi"), large_arm, large_arm),
        None => (false, true, true),
    };
    let flags = [
        ("soft_f32", soft),
        ("long_multiply", arithmetic && !plain),
        ("divide", arithmetic && !plain),
        ("leading_zeros", leading_zeros && !plain),
    ];
    for (flag, _) in flags.iter().filter(|(_, has)| *has) {
        println!("cargo::rustc-cfg={flag}");
    }
}
