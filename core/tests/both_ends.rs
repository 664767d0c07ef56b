//! Rays at both of their ends: every shape, seen and lit from both sides, looks in every arithmetic as it does in `f64`;
//! and a light that a surface holds lights what it would light from just beside it.

#[path = "support/room.rs"]
mod room;
#[path = "support/shot.rs"]
mod shot;

use octray_core::quantize::Quantize;
use octray_core::scalar::{Approx, Fixed};
use octray_prepare::saturation::PerThread;
use room::{Held, Room};
use shot::{Unlike, take};

const SCENES: u64 = 12;

macro_rules! in_arithmetics {
    ($($name:ident: $s:ty, sides: $sides:expr, lights: $lights:expr;)*) => {
        mod every_shape_from_both_sides {
            use super::*;
            $(#[test] fn $name() { every_shape_from_both_sides::<$s>($sides); })*
        }
        mod a_light_on_a_surface {
            use super::*;
            $(#[test] fn $name() { a_light_on_a_surface::<$s>($lights); })*
        }
    };
}

in_arithmetics! {
    f64: f64, sides: 99.0, lights: 60.0;
    f32: f32, sides: 55.0, lights: 50.0;
    approx2: Approx<2>, sides: 45.0, lights: 45.0;
    i4f28: Fixed<28, PerThread>, sides: 50.0, lights: 50.0;
    i8f24: Fixed<24, PerThread>, sides: 45.0, lights: 45.0;
    i12f20: Fixed<20, PerThread>, sides: 45.0, lights: 45.0;
    i16f16: Fixed<16, PerThread>, sides: 32.0, lights: 32.0;
}

/// The errors of all scenes of a shape count together, or a single pixel on an outline would decide.
fn every_shape_from_both_sides<S: Quantize>(least: f64) {
    let mut low = Vec::new();
    for shape in room::SHAPES {
        for inside in [false, true] {
            let mut unlike = Unlike::default();
            for seed in 0..SCENES {
                let text = Room::new(seed).with(shape, inside);
                unlike.add(&take::<S>(&text), &[&take::<f64>(&text)]);
            }
            if unlike.decibels() < least {
                let side = if inside { "inside" } else { "outside" };
                low.push(format!(
                    "{shape:?} from {side}: {:.1} dB",
                    unlike.decibels()
                ));
            }
        }
    }
    assert!(low.is_empty(), "{}: {}", S::NAME, low.join(", "));
}

/// The light is beside the surface by a billionth of the scene: on the one side or on the other, as the surface itself
/// does not hide what is on either.
fn a_light_on_a_surface<S: Quantize>(least: f64) {
    let mut low = Vec::new();
    for holder in Held::ALL {
        let mut unlike = Unlike::default();
        for seed in 0..SCENES {
            let room = Room::new(seed);
            let [on, before, behind] = [0.0, 1e-9, -1e-9].map(|by| room.lit_from(holder, by));
            let picture = take::<S>(&on);
            unlike.add(&picture, &[&take::<f64>(&before), &take::<f64>(&behind)]);
        }
        if unlike.decibels() < least {
            low.push(format!("on {holder:?}: {:.1} dB", unlike.decibels()));
        }
    }
    assert!(low.is_empty(), "{}: {}", S::NAME, low.join(", "));
}
