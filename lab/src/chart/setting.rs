//! What a picture is rendered with: all combinations of what is chosen from, and their names.

use octray_prepare::choice::Choice;
use octray_prepare::{
    Arith, FirmwareTree, PixelsPerRay, RenderSettings, Samples, TreeKind, TreeSettings,
};

/// What to choose from; each list has at least one value, and none twice.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Arithmetics.
    pub ariths: Vec<Arith>,
    /// Trees.
    pub trees: Vec<TreeKind>,
    /// The most bounces.
    pub max_depths: Vec<u32>,
    /// Weights below which a ray is not traced.
    pub cut_offs: Vec<f64>,
    /// Pixels that one ray colours.
    pub pixels_per_ray: Vec<PixelsPerRay>,
    /// Rays per pixel.
    pub samples: Vec<Samples>,
}

impl Grid {
    /// Every combination but those of several pixels per ray with several rays per pixel, which
    /// contradict each other. Arithmetics change last, so that labels of like points are neighbours.
    pub fn settings(&self, size: (u32, u32)) -> Vec<RenderSettings> {
        let mut settings = Vec::new();
        for &samples in &self.samples {
            for &pixels_per_ray in &self.pixels_per_ray {
                if samples != Samples::Uniform(1) && pixels_per_ray != PixelsPerRay::One {
                    continue;
                }
                for &cut_off in &self.cut_offs {
                    for &max_depth in &self.max_depths {
                        for &tree in &self.trees {
                            let setting = RenderSettings {
                                tree: TreeSettings::of(tree),
                                size: Some(size),
                                max_depth,
                                cut_off,
                                pixels_per_ray,
                                ..RenderSettings::DEFAULT.with_samples(samples)
                            };
                            let ariths = self.ariths.iter();
                            settings
                                .extend(ariths.map(|&arith| RenderSettings { arith, ..setting }));
                        }
                    }
                }
            }
        }
        settings
    }

    /// How many there would be, contradictions included.
    pub fn len(&self) -> usize {
        [
            self.ariths.len(),
            self.trees.len(),
            self.max_depths.len(),
            self.cut_offs.len(),
            self.pixels_per_ray.len(),
            self.samples.len(),
        ]
        .into_iter()
        .fold(1, usize::saturating_mul)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether settings differ in nothing but arithmetic and tree, so that f64 of the same settings is one
    /// picture for all.
    pub fn is_of_one_picture(&self) -> bool {
        let others = [
            self.max_depths.len(),
            self.cut_offs.len(),
            self.pixels_per_ray.len(),
            self.samples.len(),
        ];
        others == [1; 4]
    }
}

/// Settings as points of a chart.
pub trait Setting: Sized {
    /// The same picture without any error of its arithmetic.
    #[must_use]
    fn in_f64(&self) -> Self;

    /// A short name that tells it from the others: what they have in common is left out. `d4` are 4 bounces,
    /// `c1/64` is a cut-off, `4px` a ray for four pixels, `3x3` are nine rays for one pixel, `adaptive:2:8` those of
    /// `--samples`.
    fn label(&self, others: &[Self]) -> String;

    /// The arguments of `octray render` that give the picture.
    fn render_arguments(&self) -> Vec<String>;

    /// The arguments of `octray measure` that give the picture, with a board's `tree`.
    fn measure_arguments(&self, tree: FirmwareTree) -> Vec<String>;
}

/// `640x480`; nothing for a scene's own size.
fn size_argument(settings: &RenderSettings) -> Option<String> {
    let (width, height) = settings.size?;
    Some(format!("--size={width}x{height}"))
}

impl Setting for RenderSettings {
    fn in_f64(&self) -> Self {
        Self {
            arith: Arith::F64,
            tree: TreeSettings::default(),
            ..*self
        }
    }

    fn label(&self, others: &[Self]) -> String {
        let mut words = Vec::new();
        if others.iter().any(|other| other.arith != self.arith) {
            words.push(self.arith.name().to_owned());
        }
        if others.iter().any(|other| other.tree.kind != self.tree.kind) {
            words.push(match self.tree.kind {
                TreeKind::None => "no tree".into(),
                tree => tree.name().into(),
            });
        }
        if others.iter().any(|other| other.max_depth != self.max_depth) {
            words.push(format!("d{}", self.max_depth));
        }
        if others.iter().any(|other| other.cut_off != self.cut_off) {
            words.push(format!("c{}", fraction(self.cut_off)));
        }
        let pixels = |setting: &Self| (setting.pixels_per_ray, setting.rays_per_pixel());
        if others.iter().any(|other| pixels(other) != pixels(self)) {
            words.push(match pixels(self) {
                (PixelsPerRay::One, Samples::Uniform(samples)) => format!("{samples}x{samples}"),
                (PixelsPerRay::One, adaptive) => adaptive.to_string(),
                (pixels, _) => format!("{}px", pixels.number()),
            });
        }
        match words.is_empty() {
            true => self.arith.name().into(),
            false => words.join(" "),
        }
    }

    fn render_arguments(&self) -> Vec<String> {
        let arguments = [
            Some(format!("--arith={}", self.arith.name())),
            size_argument(self),
            Some(format!("--tree={}", self.tree.kind.name())),
            Some(format!("--max-depth={}", self.max_depth)),
            Some(format!("--cut-off={}", fraction(self.cut_off))),
            Some(format!("--pixels-per-ray={}", self.pixels_per_ray.number())),
            Some(format!("--samples={}", self.rays_per_pixel())),
        ];
        arguments.into_iter().flatten().collect()
    }

    fn measure_arguments(&self, tree: FirmwareTree) -> Vec<String> {
        let arguments = [
            Some(format!("--arith={}", self.arith.name())),
            size_argument(self),
            Some(format!("--tree={}", tree.name())),
            Some(format!("--max-depth={}", self.max_depth)),
            Some(format!("--cut-off={}", fraction(self.cut_off))),
            Some(format!("--pixels-per-ray={}", self.pixels_per_ray.number())),
        ];
        arguments.into_iter().flatten().collect()
    }
}

/// What all settings have in common, in words, each after a comma.
pub fn common(settings: &[RenderSettings]) -> String {
    let Some(first) = settings.first() else {
        return String::new();
    };
    let same = |of: fn(&RenderSettings) -> f64| settings.iter().all(|other| of(other) == of(first));
    let mut words = Vec::new();
    if settings.iter().all(|other| other.arith == first.arith) {
        words.push(first.arith.name().into());
    }
    if settings
        .iter()
        .all(|other| other.tree.kind == first.tree.kind)
    {
        words.push(match first.tree.kind {
            TreeKind::None => "no tree".into(),
            tree => format!("{} tree", tree.name()),
        });
    }
    if same(|setting| setting.max_depth.into()) {
        words.push(match first.max_depth {
            1 => "1 bounce".into(),
            depth => format!("{depth} bounces"),
        });
    }
    if same(|setting| setting.cut_off) {
        words.push(format!("cut-off {}", fraction(first.cut_off)));
    }
    if (settings.iter()).all(|other| other.rays_per_pixel() == first.rays_per_pixel())
        && same(|setting| setting.pixels_per_ray.number().into())
    {
        words.push(match (first.pixels_per_ray, first.rays_per_pixel()) {
            (PixelsPerRay::One, Samples::Uniform(1)) => "1 ray per pixel".into(),
            (PixelsPerRay::One, Samples::Uniform(samples)) => {
                format!("{samples} x {samples} rays per pixel")
            }
            (PixelsPerRay::One, adaptive) => format!("{adaptive} rays per pixel"),
            (PixelsPerRay::Four, _) => "a ray for four pixels".into(),
            (pixels, _) => format!("a ray for {} pixels", pixels.number()),
        });
    }
    words
        .iter()
        .map(|word: &String| format!(", {word}"))
        .collect()
}

/// A weight as it is written: as one over a whole number where it is that.
pub fn fraction(weight: f64) -> String {
    let below = (1.0 / weight).round();
    if weight > 0.0 && below > 1.0 && 1.0 / below == weight {
        format!("1/{below}")
    } else {
        weight.to_string()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use octray_prepare::Adaptive;

    pub(crate) fn grid(ariths: &[Arith], max_depths: &[u32], samples: &[u32]) -> Grid {
        Grid {
            ariths: ariths.to_vec(),
            trees: vec![TreeKind::Bvh8],
            max_depths: max_depths.to_vec(),
            cut_offs: vec![1.0 / 512.0],
            pixels_per_ray: vec![PixelsPerRay::One],
            samples: samples.iter().copied().map(Samples::Uniform).collect(),
        }
    }

    #[test]
    fn every_combination_is_there_once_but_contradictions() {
        let grid = Grid {
            pixels_per_ray: vec![PixelsPerRay::One, PixelsPerRay::Four],
            cut_offs: vec![0.0, 0.5],
            trees: vec![TreeKind::Bvh8, TreeKind::None],
            ..grid(&[Arith::F32, Arith::F64], &[1, 8], &[1, 2, 3])
        };
        let settings = grid.settings((8, 8));
        assert_eq!(grid.len(), 96);
        assert_eq!(settings.len(), 64);
        for (i, setting) in settings.iter().enumerate() {
            assert!(!settings[i + 1..].contains(setting));
            let labels = settings.iter().map(|other| other.label(&settings));
            let same = labels.filter(|label| *label == setting.label(&settings));
            assert_eq!(same.count(), 1, "{}", setting.label(&settings));
        }
        assert!(!grid.is_of_one_picture());
    }

    #[test]
    fn a_label_says_what_differs_and_nothing_else() {
        let one = grid(&[Arith::F32], &[8], &[1]).settings((8, 8));
        assert_eq!(one[0].label(&one), "f32");
        let some = grid(&[Arith::F32, Arith::APPROX2], &[8], &[1, 3]).settings((8, 8));
        let labels: Vec<_> = some.iter().map(|setting| setting.label(&some)).collect();
        assert_eq!(labels, ["f32 1x1", "approx2 1x1", "f32 3x3", "approx2 3x3"]);
        let adaptive = Grid {
            samples: vec![Samples::Uniform(1), Samples::Adaptive(Adaptive::DEFAULT)],
            ..grid(&[Arith::F32], &[8], &[1])
        };
        let adaptive = adaptive.settings((8, 8));
        assert_eq!(adaptive[1].label(&adaptive), "adaptive:2:8");
        let arguments = adaptive[1].render_arguments();
        assert!(arguments.contains(&"--samples=adaptive:2:8".into()));
        let depths = grid(&[Arith::Auto], &[0, 2], &[1]).settings((8, 8));
        assert_eq!(depths[1].label(&depths), "d2");
    }

    #[test]
    fn weights_are_written_as_they_are_typed() {
        for (weight, text) in [(0.0, "0"), (1.0, "1"), (1.0 / 512.0, "1/512"), (0.3, "0.3")] {
            assert_eq!(fraction(weight), text);
        }
    }

    #[test]
    fn every_arithmetic_has_a_label_of_its_own() {
        let all = grid(&Arith::all(), &[8], &[1]).settings((8, 8));
        for setting in &all {
            assert_eq!(setting.label(&all), setting.arith.name());
        }
    }
}
