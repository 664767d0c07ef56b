#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| octray_fuzz::plan(bytes));
