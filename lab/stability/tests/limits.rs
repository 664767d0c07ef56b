//! Asserts the limits: no state may get worse, and improvements must be recorded.
//!
//! `OCTRAY_UPDATE_LIMITS=1` rewrites the record; read the changes before committing them.

use octray_stability::survey::survey;
use octray_stability::{record, sweep};
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::thread::available_parallelism;

#[test]
fn methods_hold_where_the_record_says() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("record/limits.csv");
    let threads = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let survey = survey(sweep::ALL, threads, &|| true).expect("it is not stopped");
    if std::env::var_os("OCTRAY_UPDATE_LIMITS").is_some() {
        fs::write(&file, record::write(&survey)).expect("the record can be written");
        return;
    }
    let recorded = fs::read_to_string(&file).expect("there is a record");
    let changes = record::compare(&recorded, &survey);
    assert!(changes.is_empty(), "{}", changes.join("\n"));
}
