//! What the core links where there is no floating point: no soft-float routine, no formatting, no
//! panic.

use object::read::archive::ArchiveFile;
use object::{Object, ObjectSymbol};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const TARGET: &str = "thumbv6m-none-eabi";

/// All that the compiler's own library may be asked for: memory, shifts and products of 64 bits,
/// 32-bit quotients (builders only), leading zeros.
const ALLOWED: &[&str] = &[
    "__aeabi_lasr",
    "__aeabi_llsl",
    "__aeabi_llsr",
    "__aeabi_lmul",
    "__aeabi_memclr",
    "__aeabi_memclr4",
    "__aeabi_memclr8",
    "__aeabi_memcpy",
    "__aeabi_memcpy4",
    "__aeabi_memcpy8",
    "__aeabi_memmove",
    "__aeabi_memmove4",
    "__aeabi_memset",
    "__aeabi_memset4",
    "__aeabi_uidiv",
    "__aeabi_uidivmod",
    "__clzsi2",
    "__clzdi2",
    "__ctzsi2",
];

#[test]
fn fixed_point_links_no_float_no_formatting_and_no_panic() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/thumb");
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("thumb");
    let output = Command::new(env!("CARGO"))
        .args(["build", "--release", "--target", TARGET])
        .current_dir(&package)
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    if text.contains("target may not be installed") {
        eprintln!("not tested: {TARGET} is not installed");
        return;
    }
    assert!(output.status.success(), "{text}");

    let library = target.join(TARGET).join("release/liboctray_thumb.a");
    let bytes = std::fs::read(library).unwrap();
    let archive = ArchiveFile::parse(bytes.as_slice()).unwrap();
    let (mut wanted, mut defined) = (BTreeSet::new(), BTreeSet::new());
    for member in archive.members() {
        let member = member.unwrap();
        // The other members are the compiler's library, linked only as far as it is wanted.
        if !String::from_utf8_lossy(member.name()).starts_with("octray_thumb-") {
            continue;
        }
        let object = object::File::parse(member.data(bytes.as_slice()).unwrap()).unwrap();
        for symbol in object.symbols() {
            let name = symbol.name().unwrap_or_default().to_owned();
            if symbol.is_undefined() && !name.is_empty() {
                wanted.insert(name);
            } else {
                defined.insert(name);
            }
        }
    }
    let entries = [
        "octray_bvh8",
        "octray_compact_bvh8",
        "octray_octree",
        "octray_brute_force",
    ];
    assert!(entries.iter().all(|e| defined.contains(*e)), "{defined:?}");

    let strange: Vec<_> = wanted
        .difference(&defined)
        .filter(|name| !ALLOWED.contains(&name.as_str()))
        .collect();
    assert!(strange.is_empty(), "linked from elsewhere: {strange:?}");
    let panics: Vec<_> = defined
        .iter()
        .filter(|name| {
            ["panic", "unwrap_failed", "expect_failed", "slice_index"]
                .iter()
                .any(|p| name.contains(p))
        })
        .filter(|name| !name.contains("rust_begin_unwind"))
        .collect();
    assert!(panics.is_empty(), "panic paths: {panics:?}");
    let formatting: Vec<_> = defined
        .iter()
        .filter(|name| name.contains("4core3fmt"))
        .collect();
    assert!(formatting.is_empty(), "formatting: {formatting:?}");
}
