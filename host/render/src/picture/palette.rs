//! A picture in at most 256 colours.

use super::Picture;
use crate::tile::Level;
use std::ops::Range;

/// How many colours there may be.
const COLOURS: usize = 256;

/// Colours, at most 256 of them, and for each pixel the colour it has.
pub(super) struct Indexed {
    /// The colours.
    pub(super) colours: Vec<Level>,
    /// One index into the colours for each pixel.
    pub(super) indices: Vec<u8>,
}

/// Gives each pixel one of at most 256 colours: its own where the picture has no more than that, else the
/// nearest one of a palette, without dithering. The same picture always gives the same bytes.
pub(super) fn reduce(picture: &Picture) -> Indexed {
    let levels = picture.levels();
    let mut counted = count(levels);
    let colours: Vec<Level> = match counted.len() <= COLOURS {
        true => counted.iter().map(|(colour, _)| *colour).collect(),
        false => palette(&mut counted.clone()),
    };
    for (colour, index) in &mut counted {
        *index = nearest(&colours, *colour) as u64;
    }
    let index = |level: &Level| {
        let at = counted.partition_point(|(colour, _)| colour < level);
        counted[at].1 as u8
    };
    Indexed {
        indices: levels.iter().map(index).collect(),
        colours,
    }
}

/// A colour and how many pixels have it.
type Counted = (Level, u64);

/// The picture's colours in ascending order.
fn count(levels: &[Level]) -> Vec<Counted> {
    let mut sorted = levels.to_vec();
    sorted.sort_unstable();
    let same = sorted.chunk_by(|a, b| a == b);
    same.map(|same| (same[0], same.len() as u64)).collect()
}

/// The colour that is nearest to another by the sum of the squares of what its channels are off.
fn nearest(colours: &[Level], colour: Level) -> usize {
    let distance = |other: &Level| -> u32 {
        let channels = other.iter().zip(colour);
        channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let near = (0..colours.len()).min_by_key(|i| distance(&colours[*i]));
    near.unwrap_or_default()
}

/// A palette by cutting boxes in two, always the one of the largest error (Heckbert 1982, cut where Wu 1991 cuts).
fn palette(counted: &mut [Counted]) -> Vec<Level> {
    let all = Sums::of(counted);
    let mut boxes: Vec<(Range<usize>, Sums)> = vec![(0..counted.len(), all)];
    while boxes.len() < COLOURS {
        let error = |i: &usize| boxes[*i].1.error();
        let worst = (0..boxes.len()).max_by(|a, b| error(a).total_cmp(&error(b)));
        let worst = worst.unwrap_or_default();
        let Range { start, end } = boxes[worst].0;
        if end - start < 2 {
            break;
        }
        let middle = start + cut(&mut counted[start..end]);
        boxes[worst] = (start..middle, Sums::of(&counted[start..middle]));
        boxes.push((middle..end, Sums::of(&counted[middle..end])));
    }
    boxes.iter().map(|(_, sums)| sums.mean()).collect()
}

/// Sorts a box of two colours or more along the channel of the largest error, and says where to cut it so that
/// the errors of both halves are least.
fn cut(counted: &mut [Counted]) -> usize {
    let mut high = Sums::of(counted);
    let mut low = Sums::default();
    let spread = |axis: &usize| high.spread(*axis);
    let axis = (0..3).max_by(|a, b| spread(a).total_cmp(&spread(b)));
    let axis = axis.unwrap_or_default();
    counted.sort_unstable_by_key(|(colour, _)| (colour[axis], *colour));
    let (mut least, mut at) = (f64::INFINITY, 1);
    for i in 1..counted.len() {
        low.add(counted[i - 1], 1.0);
        high.add(counted[i - 1], -1.0);
        let error = low.error() + high.error();
        if error < least {
            (least, at) = (error, i);
        }
    }
    at
}

/// Sums over pixels: their count, and for each channel the levels and their squares. All are whole numbers, so exact.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    levels: [f64; 3],
    squares: [f64; 3],
}

impl Sums {
    fn of(counted: &[Counted]) -> Self {
        let mut sums = Self::default();
        counted.iter().for_each(|counted| sums.add(*counted, 1.0));
        sums
    }

    fn add(&mut self, (colour, count): Counted, sign: f64) {
        let count = sign * count as f64;
        self.count += count;
        for (axis, level) in colour.map(f64::from).into_iter().enumerate() {
            self.levels[axis] += count * level;
            self.squares[axis] += count * level * level;
        }
    }

    /// The sum of the squares of what a channel is off its mean.
    fn spread(&self, axis: usize) -> f64 {
        self.squares[axis] - self.levels[axis] * self.levels[axis] / self.count
    }

    /// The same for all channels.
    fn error(&self) -> f64 {
        (0..3).map(|axis| self.spread(axis)).sum()
    }

    fn mean(&self) -> Level {
        self.levels
            .map(|levels| (levels / self.count).round() as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(levels: &[Level]) -> Picture {
        Picture::from_levels(levels.len() as u32, 1, levels.to_vec()).unwrap()
    }

    fn show(indexed: &Indexed) -> Vec<Level> {
        let colour = |index: &u8| indexed.colours[usize::from(*index)];
        indexed.indices.iter().map(colour).collect()
    }

    #[test]
    fn up_to_256_colours_are_kept_exactly() {
        let levels: Vec<Level> = (0..1000_u32)
            .map(|i| [(i % 256) as u8, (i * 31 % 256) as u8, 7])
            .collect();
        let indexed = reduce(&picture(&levels));
        assert_eq!(indexed.colours.len(), 256);
        assert_eq!(show(&indexed), levels);
    }

    #[test]
    fn more_colours_come_close_and_always_the_same_way() {
        let levels: Vec<Level> = (0..64 * 64_u32)
            .map(|i| [(i % 64) as u8 * 4, (i / 64) as u8 * 4, 128])
            .collect();
        let first = reduce(&picture(&levels));
        let again = reduce(&picture(&levels));
        assert_eq!(
            (&first.colours, &first.indices),
            (&again.colours, &again.indices)
        );
        assert!(first.colours.len() <= 256);
        // 4096 colours on a square of side 252. The best palette, 16 × 16 cells, is 3.65 levels off in the mean of
        // squares; one colour for all is 59 off.
        let shown = show(&first);
        let rmse = (error(&shown, &levels) / 4096.0 / 3.0).sqrt();
        assert!(rmse < 3.66, "{rmse}");
    }

    /// The sum of the squares of what channels are off.
    fn error(shown: &[Level], levels: &[Level]) -> f64 {
        let pairs = shown.as_flattened().iter().zip(levels.as_flattened());
        pairs.map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum()
    }

    /// Colours as they come, strewn over a part of the cube.
    fn strewn(seed: u64, count: usize, most: Level) -> Vec<Level> {
        let mut state = seed;
        let mut next = |below: u8| {
            state = (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
            ((state >> 33) % u64::from(below)) as u8
        };
        (0..count).map(|_| most.map(&mut next)).collect()
    }

    /// The error of levels that all get their mean, straight from its definition.
    fn spread(levels: &[Counted]) -> f64 {
        let pixels =
            || (levels.iter()).flat_map(|(level, n)| (0..*n).map(|_| level.map(f64::from)));
        let count = pixels().count() as f64;
        let mean = [0, 1, 2].map(|axis| pixels().map(|pixel| pixel[axis]).sum::<f64>() / count);
        let axes =
            pixels().flat_map(|pixel| [0, 1, 2].map(|axis| (pixel[axis] - mean[axis]).powi(2)));
        axes.sum()
    }

    #[test]
    fn a_box_is_cut_where_its_halves_are_off_least() {
        for seed in 0..50 {
            let mut counted = count(&strewn(seed, 60, [30, 9, 5]));
            let at = cut(&mut counted);
            let halves = |at| spread(&counted[..at]) + spread(&counted[at..]);
            let least = (1..counted.len()).map(halves).fold(f64::INFINITY, f64::min);
            assert!((halves(at) - least).abs() < 1e-6 * least, "seed {seed}");
            assert!(halves(at) < spread(&counted));
        }
    }

    #[test]
    fn every_pixel_has_the_nearest_colour() {
        let levels = strewn(7, 5000, [255; 3]);
        let indexed = reduce(&picture(&levels));
        for (level, shown) in levels.iter().zip(show(&indexed)) {
            let off = |colour: Level| error(&[colour], &[*level]);
            let least = (indexed.colours.iter()).map(|colour| off(*colour));
            assert_eq!(off(shown), least.fold(f64::INFINITY, f64::min));
        }
    }
}
