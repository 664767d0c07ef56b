//! octray
fn main() {}
