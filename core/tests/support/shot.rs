//! Pictures of scenes, without a tree, and how far apart they are.

use octray_core::accel::BruteForce;
use octray_core::features::ALL_FEATURES;
use octray_core::quantize::Quantize;
use octray_core::trace::{QueuedRay, Tracer, required_rays};
use octray_prepare::RenderSettings;
use octray_prepare::quantise::quantise;
use octray_prepare::tree::every_object;

/// The picture of a scene's text, as levels.
pub(crate) fn take<S: Quantize>(text: &str) -> Vec<[u8; 3]> {
    let scene = octray_scenes::parse(text).unwrap_or_else(|e| panic!("{}", e.draw("scene", text)));
    let settings = RenderSettings::DEFAULT;
    let prepared = quantise::<S>(&scene, &settings).expect("the scene fits the format");
    let all = every_object(&prepared.scene);
    let scene_ = prepared.scene.scene();
    let tracer = Tracer {
        scene: &scene_,
        accelerator: &BruteForce(&all),
        max_depth: settings.max_depth,
        cut_off: S::from_f64(1.0 / 512.0),
    };
    let mut rays = vec![QueuedRay::EMPTY; required_rays(settings.max_depth, ALL_FEATURES)];
    let mut shadow_cache = vec![None; scene_.lights.len()];
    let mut stack = ();
    let mut workspace = tracer
        .workspace(&mut rays, &mut stack, &mut shadow_cache)
        .expect("room enough");
    let (width, height) = settings.size_of(&scene);
    let mut levels = vec![[0; 3]; (width * height) as usize];
    prepared.frame.render(
        0..height,
        &tracer,
        &mut workspace,
        &mut (),
        |x, y, colour| {
            levels[(y * width + x) as usize] = colour.to_array().map(S::level);
        },
    );
    levels
}

/// How unlike pictures are, over all that are added.
#[derive(Clone, Copy, Default)]
pub(crate) struct Unlike {
    square: f64,
    levels: usize,
}

impl Unlike {
    /// Adds a picture and what it should be: each pixel like the nearest of that pixel in `truths`.
    pub(crate) fn add(&mut self, picture: &[[u8; 3]], truths: &[&[[u8; 3]]]) {
        for (i, pixel) in picture.iter().enumerate() {
            let off = truths.iter().map(|truth| {
                let channel = |k: usize| u32::from(pixel[k].abs_diff(truth[i][k])).pow(2);
                channel(0) + channel(1) + channel(2)
            });
            self.square += f64::from(off.min().unwrap_or(0));
            self.levels += 3;
        }
    }

    /// The peak signal-to-noise ratio, in decibels.
    pub(crate) fn decibels(&self) -> f64 {
        10.0 * (255.0 * 255.0 * self.levels as f64 / self.square).log10()
    }
}
