//! Finds the newest record of `octray measure`, and its chart, for `octray tables` and `octray report`.

use std::error::Error;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::var("CARGO_MANIFEST_DIR")? + "/record";
    println!("cargo::rerun-if-changed={folder}");
    let files = fs::read_dir(&folder)?.collect::<Result<Vec<_>, _>>()?;
    let records = files.iter().filter_map(|file| {
        let name = file.file_name().into_string().ok()?;
        is_date(name.strip_suffix(".csv")?).then_some(name)
    });
    let newest = records.max().ok_or("lab/record holds no YYYY-MM-DD.csv")?;
    println!("cargo::rustc-env=OCTRAY_RECORD={folder}/{newest}");
    let chart = newest.replace(".csv", ".svg");
    if !fs::exists(format!("{folder}/{chart}"))? {
        return Err(format!("lab/record holds no {chart}").into());
    }
    println!("cargo::rustc-env=OCTRAY_RECORD_CHART={folder}/{chart}");
    println!("cargo::rustc-env=OCTRAY_RECORD_NAME=lab/record/{newest}");
    Ok(())
}

/// Returns whether a text is a date such as `2026-11-25`.
fn is_date(text: &str) -> bool {
    text.len() == 10
        && (text.bytes().enumerate()).all(|(i, byte)| match i {
            4 | 7 => byte == b'-',
            _ => byte.is_ascii_digit(),
        })
}
