//! High shininess.

use crate::exact::{exact, near};
use crate::method::{About, Form, SHIPPED, Sweep};
use crate::number::{Number, counted};
use crate::random::Random;
use crate::setting::Setting;
use crate::state::{ErrorStats, StateLimits, limit};
use micromath::F32Ext;
use octray_core::scalar::Exponent;

/// Powers with exponents of 1 to 10⁵, of cosines for which the result is between 0 and 1.
#[derive(Debug)]
pub struct Power;

impl Sweep for Power {
    const ABOUT: About = About {
        name: "power",
        title: "Shininess",
        axis: "exponent",
        unit: "grey levels",
        values: &[
            1.0, 1.5, 2.0, 3.0827, 5.0, 10.0, 20.0, 50.0, 87.3, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3,
            1e4, 2e4, 5e4, 1e5,
        ],
        home: 1.0,
        forms: &[
            Form {
                name: SHIPPED,
                label: "repeated squaring",
            },
            Form {
                name: "bit-trick",
                label: "2^(n · log2 x), both by bit tricks",
            },
        ],
        limits: StateLimits {
            error: Some(limit(0.5, 8.0)),
            ..StateLimits::NONE
        },
    };

    fn setting(_: f64) -> Setting {
        Setting::pixel(1.0)
    }

    fn measure<S: Number>(value: f64) -> Vec<ErrorStats> {
        let mut all_errors = vec![ErrorStats::default(); 2];
        let mut random = Random::new(3);
        let whole = value.floor();
        let exponent = Exponent {
            whole: whole as u32,
            fraction: S::from_f64(value - whole),
        };
        // With the rounded fraction.
        let power = exact(whole) + exponent.fraction.exact();
        for _ in 0..48 {
            let cosine = S::from_f64(libm::pow(random.between(0.001, 1.0), 1.0 / value));
            let truth = if cosine >= S::ONE {
                exact(1.0)
            } else {
                cosine.exact().powf(&power)
            };
            let forms: [fn(S, Exponent<S>) -> S; 2] = [S::power, bit_trick];
            for (form, errors) in forms.iter().zip(&mut all_errors) {
                let (found, saturations) = counted(|| form(cosine, exponent));
                errors.cases += 1;
                errors.saturations += saturations;
                errors.err(255.0 * near(&(found.exact() - &truth)));
            }
        }
        all_errors
    }
}

/// Computes in 32-bit floats, whatever the format.
fn bit_trick<S: Number>(x: S, exponent: Exponent<S>) -> S {
    let power = f64::from(exponent.whole) + exponent.fraction.to_f64();
    let result = F32Ext::powf(x.to_f64() as f32, power as f32);
    S::from_f64(f64::from(result))
}
