//! Where labels of points go: near them, and never over one another.

/// A rectangle in pixels; right and bottom do not belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    /// Its leftmost column.
    pub left: i32,
    /// Its uppermost row.
    pub top: i32,
    /// The column beyond it.
    pub right: i32,
    /// The row below it.
    pub bottom: i32,
}

/// A label that has its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where its text goes.
    pub place: Rect,
    /// Where a line from the point to it ends, if it is so far away that it needs one.
    pub leader: Option<(i32, i32)>,
}

/// Half the side of a marker, with the room around it.
pub const MARKER: i32 = 8;

/// How far a label may be from its marker before a line has to lead to it.
const NEAR: i32 = 5;

/// How much farther away a label had better be than struck through by a line.
const STRUCK: i32 = 200;

/// The directions to try, in the order in which a reader likes them: right, left, above, below, corners.
const DIRECTIONS: [(f64, f64); 16] = [
    (1.0, 0.0),
    (-1.0, 0.0),
    (0.0, -1.0),
    (0.0, 1.0),
    (1.0, -1.0),
    (-1.0, -1.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, -0.5),
    (-1.0, -0.5),
    (1.0, 0.5),
    (-1.0, 0.5),
    (0.5, -1.0),
    (-0.5, -1.0),
    (0.5, 1.0),
    (-0.5, 1.0),
];

/// Finds places for labels of these sizes (width, height) at these points, one after the other, inside of a
/// rectangle. A place is bad if it or the line to it meets labels, lines or markers, or what else is to
/// be avoided, and a little the farther away it is; the least bad one is taken.
pub fn place(
    points: &[(i32, i32)],
    sizes: &[(i32, i32)],
    within: Rect,
    avoid: &[Rect],
) -> Vec<Label> {
    let mut placed: Vec<(Label, (i32, i32))> = Vec::new();
    for (&point, &size) in points.iter().zip(sizes) {
        let surroundings = Surroundings {
            points,
            avoid,
            placed: &placed,
        };
        let best = candidates(point, size, within)
            .min_by_key(|label| surroundings.badness(label, point))
            .unwrap_or_else(|| beside(point, size));
        placed.push((best, point));
    }
    placed.into_iter().map(|(label, _)| label).collect()
}

/// To the right of its point, whatever is there: for a label that is larger than all there is.
fn beside((x, y): (i32, i32), (width, height): (i32, i32)) -> Label {
    let (left, top) = (x + MARKER, y - height / 2);
    Label {
        place: Rect {
            left,
            top,
            right: left + width,
            bottom: top + height,
        },
        leader: None,
    }
}

/// All places that are tried, the nearest first.
fn candidates(
    (x, y): (i32, i32),
    (width, height): (i32, i32),
    within: Rect,
) -> impl Iterator<Item = Label> {
    let farthest = (within.right - within.left).max(within.bottom - within.top);
    let distances = std::iter::successors(Some(0), |d| Some(d + NEAR + d / 4));
    distances
        .take_while(move |d| *d < farthest)
        .flat_map(move |d| DIRECTIONS.map(|direction| (d, direction)))
        .map(move |(d, (dx, dy))| {
            let away = |side: i32| f64::from(MARKER + d) + f64::from(side) / 2.0;
            let middle = (
                f64::from(x) + dx * away(width),
                f64::from(y) + dy * away(height),
            );
            let left = (middle.0 - f64::from(width) / 2.0).round() as i32;
            let top = (middle.1 - f64::from(height) / 2.0).round() as i32;
            let place = Rect {
                left,
                top,
                right: left + width,
                bottom: top + height,
            };
            Label {
                place,
                leader: (d > NEAR).then(|| place.nearest((x, y))),
            }
        })
        .filter(move |label| within.holds(&label.place))
}

/// What is there already.
struct Surroundings<'a> {
    points: &'a [(i32, i32)],
    avoid: &'a [Rect],
    placed: &'a [(Label, (i32, i32))],
}

impl Surroundings<'_> {
    fn badness(&self, label: &Label, point: (i32, i32)) -> i32 {
        let place = &label.place;
        let mut badness = (place.distance(point) / 2).max(0);
        let line = label.leader.map(|end| (point, end));
        for (other, origin) in self.placed {
            if other.place.meets(place) {
                badness += 100_000;
            }
            if other
                .leader
                .is_some_and(|end| place.crossed((*origin, end)))
            {
                badness += 10_000;
            }
            if line.is_some_and(|line| other.place.crossed(line)) {
                badness += 10_000;
            }
        }
        for &other in self.points {
            let marker = Rect::around(other);
            if marker.meets(place) {
                badness += 1_000;
            }
            // Markers that hide the point itself cannot be kept clear of.
            if line.is_some_and(|line| !marker.contains(point) && marker.crossed(line)) {
                badness += 100;
            }
        }
        let met = self.avoid.iter().filter(|rect| rect.meets(place)).count();
        // A label that is struck through is hard to read: it had better be as many pixels away.
        badness + STRUCK / 2 * met as i32
    }
}

impl Rect {
    /// The marker of a point.
    fn around((x, y): (i32, i32)) -> Self {
        let half = MARKER - 2;
        Self {
            left: x - half,
            top: y - half,
            right: x + half,
            bottom: y + half,
        }
    }

    /// Whether they have a pixel in common.
    pub fn meets(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn holds(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }

    fn contains(&self, (x, y): (i32, i32)) -> bool {
        (self.left..self.right).contains(&x) && (self.top..self.bottom).contains(&y)
    }

    /// The place in it that is nearest to a point.
    fn nearest(&self, (x, y): (i32, i32)) -> (i32, i32) {
        (
            x.clamp(self.left, self.right - 1),
            y.clamp(self.top, self.bottom - 1),
        )
    }

    fn distance(&self, point: (i32, i32)) -> i32 {
        let (x, y) = self.nearest(point);
        (x - point.0).abs() + (y - point.1).abs()
    }

    /// Whether a line comes through it.
    fn crossed(&self, (from, to): ((i32, i32), (i32, i32))) -> bool {
        let around = Self {
            left: from.0.min(to.0),
            top: from.1.min(to.1),
            right: from.0.max(to.0) + 1,
            bottom: from.1.max(to.1) + 1,
        };
        if !self.meets(&around) {
            return false;
        }
        let steps = (to.0 - from.0).abs().max((to.1 - from.1).abs()).max(1);
        (0..=steps).any(|step| {
            let along = |a: i32, b: i32| a + (b - a) * step / steps;
            self.contains((along(from.0, to.0), along(from.1, to.1)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WITHIN: Rect = Rect {
        left: 0,
        top: 0,
        right: 800,
        bottom: 480,
    };

    /// Points in a part of the plot, some of them at the same place.
    fn strewn(seed: u64, count: usize, (width, height): (u64, u64)) -> Vec<(i32, i32)> {
        let mut state = seed;
        let mut next = move |below| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 33) % below) as i32
        };
        (0..count)
            .map(|_| (20 + next(width), 20 + next(height)))
            .collect()
    }

    #[test]
    fn labels_do_not_overlap_and_stay_inside() {
        for seed in 0..6 {
            for spread in [(760, 440), (200, 100), (30, 400), (1, 1)] {
                let points = strewn(seed, 40, spread);
                let sizes: Vec<_> = (0..40).map(|i| (30 + 2 * i, 15)).collect();
                let labels = place(&points, &sizes, WITHIN, &[]);
                for (i, label) in labels.iter().enumerate() {
                    assert!(WITHIN.holds(&label.place));
                    let (width, height) = sizes[i];
                    assert_eq!(label.place.right - label.place.left, width);
                    assert_eq!(label.place.bottom - label.place.top, height);
                    let others = &labels[i + 1..];
                    assert!(
                        !others.iter().any(|other| other.place.meets(&label.place)),
                        "seed {seed}, spread {spread:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_lonely_label_is_beside_its_point_and_a_distant_one_has_a_line() {
        let alone = place(&[(100, 100)], &[(50, 14)], WITHIN, &[]);
        assert_eq!((alone[0].place.left, alone[0].place.top), (108, 93));
        assert_eq!(alone[0].leader, None);
        let crowded = place(&[(100, 100); 12], &[(50, 14); 12], WITHIN, &[]);
        let far = crowded.iter().filter(|label| label.leader.is_some());
        assert!(far.count() > 0);
        for label in &crowded {
            let distance = label.place.distance((100, 100));
            assert!(
                label.leader.is_some() || distance <= 3 * MARKER,
                "{distance}"
            );
        }
    }

    #[test]
    fn what_is_to_be_avoided_is_avoided_where_there_is_room() {
        let line = Rect {
            left: 100,
            top: 100,
            right: 400,
            bottom: 101,
        };
        let labels = place(&[(100, 100)], &[(50, 14)], WITHIN, &[line]);
        assert!(!labels[0].place.meets(&line));
    }

    #[test]
    fn a_label_that_fits_nowhere_is_still_there() {
        let labels = place(&[(10, 10)], &[(900, 14)], WITHIN, &[]);
        assert_eq!(labels[0].place.right - labels[0].place.left, 900);
    }
}
