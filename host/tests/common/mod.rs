//! What tests of the command share.
#![allow(dead_code, reason = "each test uses some of it")]

use snapbox::cmd::{Command, cargo_bin};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

pub(crate) fn octray(folder: &Path, line: &str) -> Command {
    Command::new(cargo_bin!("octray"))
        .current_dir(folder)
        .args(line.split_whitespace())
}

pub(crate) fn ppm(levels: &[[u8; 3]]) -> Vec<u8> {
    let mut bytes = format!("P6\n{} 1\n255\n", levels.len()).into_bytes();
    bytes.extend(levels.as_flattened());
    bytes
}

/// Three pictures: `a.ppm`, `b.ppm` of the same size, and `wide.ppm`.
pub(crate) fn pictures() -> TempDir {
    let folder = TempDir::new().unwrap();
    let write = |name, levels: &[_]| fs::write(folder.path().join(name), ppm(levels)).unwrap();
    write("a.ppm", &[[0, 0, 0], [10, 10, 10], [100, 100, 100]]);
    write("b.ppm", &[[0, 1, 0], [12, 10, 10], [100, 100, 90]]);
    write("wide.ppm", &[[0; 3]; 4]);
    folder
}

pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}
