//! The shipped forms never break for admitted values: this connects the sweeps to [`octray_prepare::quantise::limits`]
//! and [`octray_prepare::quantise::resolution`].

use octray_stability::method::SHIPPED;
use octray_stability::number::ARITHMETICS;
use octray_stability::state::State;
use octray_stability::{record, sweep};

/// The test in `limits.rs` ensures that the record is true.
#[test]
fn no_shipped_form_breaks_where_its_scene_is_admitted() {
    let recorded = include_str!("../record/limits.csv");
    let mut broken = Vec::new();
    for method in sweep::ALL {
        let about = &method.about;
        for (a, arithmetic) in ARITHMETICS.iter().enumerate() {
            let states = record::states(recorded, [about.name, SHIPPED, arithmetic])
                .expect("every method is in the record");
            for (&value, state) in about.values.iter().zip(states.chars()) {
                if state == State::Breaks.symbol() && method.admits(a, value) {
                    broken.push(format!("{} breaks in {arithmetic} at {value}", about.name));
                }
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Without this, the test above would prove nothing.
#[test]
fn the_admitted_range_ends_where_the_format_does() {
    let sphere = &sweep::ALL[0];
    let largest = |arithmetic: &str| {
        let a = ARITHMETICS.iter().position(|name| *name == arithmetic)?;
        let values = sphere.about.values.iter();
        values.copied().rfind(|value| sphere.admits(a, *value))
    };
    assert_eq!(largest("i24f8"), Some(10.0));
    assert_eq!(largest("i16f16"), Some(2000.0));
    assert_eq!(largest("f32"), Some(2e5));
    assert_eq!(largest("f64"), Some(1e7));
    assert_eq!(largest("approx0"), Some(2.0));
}
