//! The thesis's table III with today's boards: the cost of a picture on one core without and with its floating-point
//! unit, and the cost of emulated floats relative to fixed point.

use super::row::FrameRow;
use super::table::{left, table};
use octray_prepare::Arith;
use octray_render::counts::thousands;

/// Pairs of boards with the same core: without and with its floating-point unit.
pub const CORES: [(&str, &str); 2] = [("m4", "m4f"), ("rv32imac", "rv32imafc")];

/// The values of the thesis's table III for two pictures on a Sun 3/110: minutes without the floating-point chip over
/// minutes with it.
pub const THESIS: &str = "2.50 and 2.58 in the thesis, table III";

/// A scene in an arithmetic on a core without and with its floating-point unit.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Without.
    pub without: &'a FrameRow,
    /// With.
    pub with: &'a FrameRow,
}

impl Pair<'_> {
    /// Returns instructions without the unit over instructions with it.
    pub fn ratio(&self) -> f64 {
        per_pixel(self.without) / per_pixel(self.with)
    }
}

/// Returns instructions per pixel; NaN if there are none.
pub fn per_pixel(row: &FrameRow) -> f64 {
    row.cost.as_ref().map_or(f64::NAN, |cost| cost.per_pixel)
}

/// Returns the pairs of one core, in the order of the rows.
pub fn pairs<'a>(rows: &'a [FrameRow], (without, with): (&str, &str)) -> Vec<Pair<'a>> {
    let measured = |name: &str, row: &FrameRow| row.board.name == name && row.cost.is_some();
    (rows.iter().filter(|row| measured(without, row)))
        .filter_map(|row| {
            let same = |other: &&FrameRow| {
                measured(with, other) && other.scene == row.scene && other.arith == row.arith
            };
            let with = rows.iter().find(same)?;
            Some(Pair { without: row, with })
        })
        .collect()
}

/// Formats the tables for which there are rows.
pub fn text(rows: &[FrameRow]) -> String {
    let mut text = String::new();
    for core in CORES {
        let pairs = pairs(rows, core);
        if !pairs.is_empty() {
            text += &without_and_with(&pairs, core);
        }
    }
    text + &float_and_fixed(rows)
}

fn without_and_with(pairs: &[Pair<'_>], (without, with): (&str, &str)) -> String {
    let mut table = table(&["scene", "arithmetic", without, with, "ratio"]);
    left(&mut table, 2);
    let mut ariths: Vec<Arith> = Vec::new();
    for pair in pairs {
        let arith = pair.without.arith;
        if !ariths.contains(&arith) {
            ariths.push(arith);
        }
        let count = |row| thousands(per_pixel(row).round() as u64);
        table.add_row([
            pair.without.scene.clone(),
            arith.name().into(),
            count(pair.without),
            count(pair.with),
            format!("{:.2}", pair.ratio()),
        ]);
    }
    for arith in ariths {
        let of_arith = pairs.iter().filter(|pair| pair.without.arith == arith);
        let mean = geometric_mean(of_arith.map(Pair::ratio));
        table.add_row([
            "geometric mean".into(),
            arith.name().into(),
            String::new(),
            String::new(),
            format!("{mean:.2}"),
        ]);
    }
    format!("\nInstructions per pixel without and with a floating-point unit ({THESIS})\n{table}\n")
}

/// Formats, per board, the geometric mean over the scenes of `f32` over the chosen fixed point.
fn float_and_fixed(rows: &[FrameRow]) -> String {
    let mut boards: Vec<&str> = Vec::new();
    for row in rows {
        if !boards.contains(&row.board.name) {
            boards.push(row.board.name);
        }
    }
    let mut table = table(&["board", "f32 / fixed", "least PSNR of fixed, dB"]);
    left(&mut table, 1);
    for board in boards {
        let of = |arith| {
            (rows.iter())
                .filter(move |row| row.board.name == board && row.arith == arith)
                .filter(|row| row.cost.is_some())
        };
        let pairs: Vec<(&FrameRow, &FrameRow)> = of(Arith::F32)
            .filter_map(|float| Some((float, of(Arith::Auto).find(|r| r.scene == float.scene)?)))
            .collect();
        if pairs.is_empty() {
            continue;
        }
        let ratios = pairs.iter().map(|(a, b)| per_pixel(a) / per_pixel(b));
        let worst = (pairs.iter())
            .filter_map(|(_, fixed)| fixed.cost.as_ref()?.psnr)
            .min_by(f64::total_cmp);
        table.add_row([
            board.into(),
            format!("{:.2}", geometric_mean(ratios)),
            worst.map_or("equal".into(), |psnr| format!("{psnr:.1}")),
        ]);
    }
    if table.row_count() == 0 {
        return String::new();
    }
    format!(
        "\nInstructions in f32 over those in fixed point, geometric mean over the scenes\n{table}\n"
    )
}

/// Returns the geometric mean of positive values; 1 if there are none.
pub(crate) fn geometric_mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), x| (sum + x.ln(), count + 1));
    (sum / f64::from(count.max(1))).exp()
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::board::BOARDS;
    use super::super::report::tests::example;
    use super::*;

    /// A scene in f32 and in fixed point on four boards, with these instructions per pixel.
    pub(in super::super) fn rows() -> Vec<FrameRow> {
        let costs = [
            ("m4", 900.0, 300.0),
            ("m4f", 100.0, 200.0),
            ("rv32imac", 800.0, 400.0),
            ("rv32imafc", 100.0, 400.0),
        ];
        let row = |name: &str, arith, per_pixel| {
            let mut row = example();
            row.board = BOARDS.iter().find(|board| board.name == name).unwrap();
            row.arith = arith;
            if let Some(cost) = &mut row.cost {
                cost.per_pixel = per_pixel;
            }
            row
        };
        let both =
            |(name, float, fixed)| [row(name, Arith::F32, float), row(name, Arith::Auto, fixed)];
        costs.into_iter().flat_map(both).collect()
    }

    #[test]
    fn pairs_have_the_same_core() {
        let rows = rows();
        let ratios = |core| -> Vec<_> { pairs(&rows, core).iter().map(Pair::ratio).collect() };
        assert_eq!(ratios(CORES[0]), [9.0, 1.5]);
        assert_eq!(ratios(CORES[1]), [8.0, 1.0]);
        let text = text(&rows);
        assert!(text.contains("| m4        |        3.00 |"), "{text}");
        assert!(text.contains("9.00 |"), "{text}");
    }

    #[test]
    fn failures_and_single_boards_have_no_ratio() {
        let mut rows = rows();
        rows.truncate(2);
        assert!(pairs(&rows, CORES[0]).is_empty());
        rows[0].cost = None;
        assert_eq!(text(&rows), "");
    }
}
