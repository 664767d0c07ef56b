//! What is read from files, each reader on any bytes: it answers or refuses, and never panics. What it takes for
//! whole it reads again from its own writing.
//!
//! `cargo +nightly fuzz run scene ../scenes ../scenes/invalid` lets libFuzzer look for bytes that break this;
//! `tests/tests/readers.rs` tries some with every run of the tests.

use octray_lab::plan::record;
use octray_lab::tables::thesis::Thesis;
use octray_prepare::plan::Plan;
use octray_render::picture::{self, Picture};

/// A scene.
pub fn scene(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let scene = match octray_scenes::parse(&text) {
        Ok(scene) => scene,
        Err(mistakes) => {
            assert!(!mistakes.draw("any.scene", &text).is_empty());
            return;
        }
    };
    let mut written = Vec::new();
    octray_scenes::write(&scene, &mut written).unwrap();
    let written = String::from_utf8(written).unwrap();
    if let Err(mistakes) = octray_scenes::parse(&written) {
        panic!("{}", mistakes.draw("written.scene", &written));
    }
}

/// A picture of any format, which is told by its first bytes.
pub fn picture(bytes: &[u8]) {
    let Ok(picture) = picture::decode(&mut &*bytes) else {
        return;
    };
    let again = picture.png().unwrap();
    let again: Picture = picture::decode(&mut &*again).unwrap();
    assert_eq!(again.levels(), picture.levels());
}

/// A plan.
pub fn plan(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match text.parse::<Plan>() {
        Ok(plan) => assert_eq!(plan.to_string().parse(), Ok(plan)),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// The thesis's figures, and the record that the planner's model is fitted to.
pub fn csv(bytes: &[u8]) {
    let _ = Thesis::parse(&String::from_utf8_lossy(bytes), "any.csv");
    let _ = record::read(bytes);
}
