//! Points of a chart, and what is chosen among them.

use super::ChartJob;
use super::accuracy::{Accuracy, decibels};
use super::callgrind;
use super::choose::{self, Rank};
use super::cost::{CostKind, tree_on_boards};
use super::setting::{self, Setting};
use octray_prepare::RenderSettings;
use octray_render::metric::Difference;
use serde::Serialize;
use std::path::{Path, PathBuf};
use strum::{EnumMessage, EnumString, IntoStaticStr, VariantArray};

/// What accuracy is relative to.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    Serialize,
    VariantArray,
    EnumMessage,
    EnumString,
    IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "lowercase")]
pub enum Against {
    /// f64 of the same settings: the error of the arithmetic alone.
    Same,
    /// f64 with many rays per pixel and every bounce that shows: the error of arithmetic and settings together.
    Converged,
}

/// What to choose by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wishes {
    /// What accuracy is relative to.
    pub against: Against,
    /// The fewest decibels that are good enough.
    pub min_psnr: f64,
    /// The most that a frame may cost, if that is limited.
    pub budget: Option<f64>,
}

/// How far off a picture is and what it costs, or why that is not known.
pub type Measured = Result<(Accuracy, f64), String>;

/// A setting that was measured.
#[derive(Clone, Debug)]
pub struct Point {
    /// The setting.
    pub setting: RenderSettings,
    /// Its name among those of its panel.
    pub label: String,
    /// How far off its picture is.
    pub accuracy: Accuracy,
    /// What a frame costs.
    pub cost: f64,
    /// Whether no other point is better in cost and accuracy.
    pub on_frontier: bool,
    /// What it is chosen as.
    pub chosen_as: Vec<String>,
}

/// A setting without a point.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The setting.
    pub setting: RenderSettings,
    /// Its name among those of its panel.
    pub label: String,
    /// Why.
    pub why: String,
}

/// A choice, and the point that was chosen if there is one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// By what.
    pub name: String,
    /// Which of the panel's points.
    pub point: Option<usize>,
}

/// All points of a scene on one scale of cost.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The scene's name.
    pub scene: String,
    /// The scene's file, as it was named.
    pub path: PathBuf,
    /// Columns and rows.
    pub size: (u32, u32),
    /// What cost is.
    pub kind: CostKind,
    /// What was chosen by.
    pub wishes: Wishes,
    /// The points, in the order of their settings.
    pub points: Vec<Point>,
    /// The settings without a point.
    pub refused: Vec<Refused>,
    /// The bounces that the converged picture lacks, in words, if any.
    pub unexplored: Option<String>,
    /// What was chosen.
    pub choices: Vec<Chosen>,
}

impl Panel {
    /// Finds the frontier, and chooses.
    pub fn new(
        scene: &str,
        path: &Path,
        kind: CostKind,
        job: &ChartJob,
        measured: Vec<(RenderSettings, Measured)>,
    ) -> Self {
        let settings: Vec<RenderSettings> = measured.iter().map(|(setting, _)| *setting).collect();
        let mut panel = Self {
            scene: scene.into(),
            path: path.into(),
            size: job.size,
            kind,
            wishes: job.wishes,
            points: Vec::new(),
            refused: Vec::new(),
            unexplored: None,
            choices: Vec::new(),
        };
        for (setting, outcome) in measured {
            let label = setting.label(&settings);
            match outcome {
                Ok((accuracy, cost)) => panel.points.push(Point {
                    setting,
                    label,
                    accuracy,
                    cost,
                    on_frontier: false,
                    chosen_as: Vec::new(),
                }),
                Err(why) => panel.refused.push(Refused {
                    setting,
                    label,
                    why,
                }),
            }
        }
        panel.choose();
        panel
    }

    /// The picture's distance from what accuracy is relative to.
    pub fn difference<'a>(&self, point: &'a Point) -> &'a Difference {
        match self.wishes.against {
            Against::Same => &point.accuracy.same,
            Against::Converged => &point.accuracy.converged,
        }
    }

    /// The picture, and the settings that all points have in common, in words.
    pub fn common(&self) -> String {
        let settings = self.points.iter().map(|point| point.setting);
        let settings: Vec<RenderSettings> = settings.collect();
        let (width, height) = self.size;
        format!("{width} x {height} pixels{}", setting::common(&settings))
    }

    fn choose(&mut self) {
        let ranks: Vec<Rank> = (self.points.iter())
            .map(|point| Rank {
                cost: point.cost,
                error: self.difference(point).rmse(),
                decibels: decibels(self.difference(point)),
            })
            .collect();
        for i in choose::frontier(&ranks) {
            self.points[i].on_frontier = true;
        }
        let Wishes {
            min_psnr, budget, ..
        } = self.wishes;
        let mut choose = |name: String, short: String, point: Option<usize>| {
            if let Some(i) = point {
                self.points[i].chosen_as.push(short);
            }
            self.choices.push(Chosen { name, point });
        };
        choose(
            format!("fastest with at least {min_psnr} dB"),
            format!("fastest ≥ {min_psnr} dB"),
            choose::fastest(&ranks, min_psnr),
        );
        if let Some(budget) = budget {
            let amount = self.kind.amount(budget);
            choose(
                format!("most accurate within {amount}"),
                format!("best within {amount}"),
                choose::most_accurate(&ranks, budget),
            );
        }
        choose("knee".into(), "knee".into(), choose::knee(&ranks));
    }

    /// The command that gives the point's picture, and on a board its cost too.
    pub fn command(&self, setting: &RenderSettings) -> String {
        let mut words = vec!["octray".to_owned()];
        let file = self.path.to_string_lossy().into_owned();
        if let CostKind::Board(board) = self.kind {
            words.extend(["measure".into(), file]);
            words.push(format!("--target={}", board.name));
            let tree = tree_on_boards(setting.tree.kind).unwrap_or_default();
            words.extend(setting.measure_arguments(tree));
        } else {
            words.extend(["render".into(), file]);
            words.extend(setting.render_arguments());
            words.push("--threads=1".into());
        }
        words
            .iter()
            .map(|word| quoted(word))
            .collect::<Vec<_>>()
            .join(" ")
    }

    /// What comes before a point's command so that it counts the point's cost.
    pub fn counting(&self) -> Option<String> {
        match self.kind {
            CostKind::HostInstructions => Some(callgrind::command()),
            _ => None,
        }
    }
}

/// A word as a shell reads it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+%@".contains(c);
    if word.chars().all(plain) && !word.is_empty() {
        word.into()
    } else if word.chars().any(char::is_control) {
        let escaped = word.chars().map(|c| match c {
            '\'' | '\\' => format!("\\{c}"),
            c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
            c => c.into(),
        });
        format!("$'{}'", escaped.collect::<String>())
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::accuracy::Sight;
    use super::super::setting::tests::grid;
    use super::*;
    use octray_prepare::Arith;
    use std::num::NonZeroUsize;

    /// A panel of made-up points: arithmetic, cost, and sum of squared differences.
    pub(crate) fn panel(points: &[(Arith, f64, u64)]) -> Panel {
        let ariths: Vec<_> = points.iter().map(|(arith, ..)| *arith).collect();
        let job = ChartJob {
            scenes: Vec::new(),
            grid: grid(&ariths, &[8], &[1]),
            costs: vec![CostKind::Events],
            size: (16, 16),
            converged_samples: 4,
            rounds: NonZeroUsize::MIN,
            wishes: Wishes {
                against: Against::Same,
                min_psnr: 40.0,
                budget: Some(5e6),
            },
            output: None,
            csv: None,
            json: None,
        };
        let of = |squares| Difference {
            pixels: 256,
            squares,
            largest: u8::from(squares > 0),
            beyond_1: 0,
            beyond_8: 0,
        };
        let settings = job.grid.settings(job.size);
        let measured = settings.into_iter().zip(points);
        let measured = measured.map(|(setting, (arith, cost, squares))| {
            let accuracy = Accuracy {
                format: match arith {
                    Arith::In(format) => *format,
                    Arith::Auto => octray_prepare::Format::I4F28,
                },
                same: of(*squares),
                converged: of(squares + 100),
                sight: Sight {
                    other: 0.25,
                    depth: 0.5,
                },
            };
            (setting, Ok((accuracy, *cost)))
        });
        let mut measured: Vec<_> = measured.collect();
        let refused = RenderSettings {
            arith: Arith::I4F28,
            ..measured[0].0
        };
        measured.push((refused, Err("too large".into())));
        Panel::new(
            "a",
            Path::new("a b.scene"),
            CostKind::Events,
            &job,
            measured,
        )
    }

    /// From cheap and wrong to dear and exact, and one that is beaten.
    pub(crate) fn made_up() -> Panel {
        panel(&[
            (Arith::APPROX0, 1e6, 900_000),
            (Arith::APPROX1, 2e6, 3_000),
            (Arith::F32, 4e6, 500),
            (Arith::I16F16, 8e6, 900),
            (Arith::F64, 9e6, 0),
        ])
    }

    #[test]
    fn choices_name_points_and_points_their_choices() {
        let panel = made_up();
        let frontier: Vec<_> = panel.points.iter().map(|point| point.on_frontier).collect();
        assert_eq!(frontier, [true, true, true, false, true]);
        let chosen = |i: usize| {
            panel.choices[i]
                .point
                .map(|point| &*panel.points[point].label)
        };
        assert_eq!(panel.choices[0].name, "fastest with at least 40 dB");
        assert_eq!(chosen(0), Some("approx1"));
        assert_eq!(
            panel.choices[1].name,
            "most accurate within 5,000,000 instructions"
        );
        assert_eq!(chosen(1), Some("f32"));
        assert_eq!(panel.choices[2].name, "knee");
        assert_eq!(chosen(2), Some("approx1"));
        assert_eq!(panel.points[1].chosen_as, ["fastest ≥ 40 dB", "knee"]);
        assert_eq!(panel.refused[0].label, "i4f28");
    }

    #[test]
    fn a_word_with_control_characters_stays_one_word_on_one_line() {
        assert_eq!(quoted("a'b\n\u{1b}"), r"$'a\'b\u000a\u001b'");
    }

    #[test]
    fn a_command_gives_the_point_again() {
        let panel = made_up();
        assert_eq!(
            panel.command(&panel.points[3].setting),
            "octray render 'a b.scene' --arith=i16f16 --size=16x16 --tree=bvh8 --max-depth=8 \
             --cut-off=1/512 --pixels-per-ray=1 --samples=1 --threads=1"
        );
        let board = Panel {
            kind: CostKind::named("m3").unwrap(),
            ..panel
        };
        let setting = RenderSettings {
            tree: octray_prepare::TreeSettings::of(octray_prepare::TreeKind::CompactBvh8),
            ..board.points[0].setting
        };
        assert_eq!(
            board.command(&setting),
            "octray measure 'a b.scene' --target=m3 --arith=approx0 --size=16x16 --tree=compact-bvh8 \
             --max-depth=8 --cut-off=1/512 --pixels-per-ray=1"
        );
    }

    #[test]
    fn words_are_quoted_for_the_shell() {
        assert_eq!(quoted("a/b-1.scene"), "a/b-1.scene");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(""), "''");
    }
}
