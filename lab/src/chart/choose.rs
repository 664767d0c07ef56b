//! Which points no other beats, and which of them to take.

/// A point as it is compared: both are better the smaller they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rank {
    /// What it costs, above 0.
    pub cost: f64,
    /// How far off it is.
    pub error: f64,
    /// The same in decibels: finite, and larger where the error is smaller.
    pub decibels: f64,
}

impl Rank {
    /// Whether it is no worse in cost and error than another, and better in one of them.
    pub fn dominates(&self, other: &Self) -> bool {
        self.cost <= other.cost
            && self.error <= other.error
            && (self.cost < other.cost || self.error < other.error)
    }
}

/// The points that none dominates, from the cheapest to the dearest: the Pareto frontier. Points alike in both
/// are all on it.
pub fn frontier(points: &[Rank]) -> Vec<usize> {
    let mut best: Vec<usize> = (0..points.len())
        .filter(|&i| !points.iter().any(|other| other.dominates(&points[i])))
        .collect();
    best.sort_by(|&a, &b| points[a].cost.total_cmp(&points[b].cost));
    best
}

/// The cheapest point of at least so many decibels.
pub fn fastest(points: &[Rank], decibels: f64) -> Option<usize> {
    frontier(points)
        .into_iter()
        .find(|&i| points[i].decibels >= decibels)
}

/// The most accurate point that costs at most so much.
pub fn most_accurate(points: &[Rank], budget: f64) -> Option<usize> {
    let best = frontier(points);
    let affordable = |i: &usize| points[*i].cost <= budget;
    let least = best.iter().copied().rfind(affordable)?;
    // Of points alike the first one.
    best.into_iter().find(|&i| points[i] == points[least])
}

/// Where more accuracy begins to cost more than it did: the point of the frontier that lies farthest above
/// the straight line between its ends, with decibels over the logarithm of the cost. `None` if no point lies above it.
pub fn knee(points: &[Rank]) -> Option<usize> {
    let best = frontier(points);
    let place = |i: usize| (points[i].cost.ln(), points[i].decibels);
    let (first, last) = (place(*best.first()?), place(*best.last()?));
    let slope = (last.1 - first.1) / (last.0 - first.0);
    let above = |&i: &usize| {
        let (x, y) = place(i);
        y - first.1 - slope * (x - first.0)
    };
    best.into_iter()
        .filter(|i| above(i) > 1e-9)
        .reduce(|a, b| if above(&b) > above(&a) { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rank(cost: f64, decibels: f64) -> Rank {
        Rank {
            cost,
            error: 10f64.powf(-decibels / 20.0),
            decibels,
        }
    }

    /// Points strewn by a simple generator of random numbers, on a coarse grid so that some are alike.
    fn strewn(seed: u64) -> Vec<Rank> {
        let mut state = seed;
        let mut next = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            f64::from((state >> 60) as u32)
        };
        (0..40).map(|_| rank(1.0 + next(), 20.0 + next())).collect()
    }

    #[test]
    fn no_point_of_the_frontier_is_dominated_and_every_other_is_by_one_of_it() {
        for seed in 0..200 {
            let points = strewn(seed);
            let best = frontier(&points);
            assert!(!best.is_empty());
            for (i, point) in points.iter().enumerate() {
                let dominated = |by: &[usize]| by.iter().any(|&j| points[j].dominates(point));
                let all: Vec<_> = (0..points.len()).collect();
                assert_eq!(best.contains(&i), !dominated(&all), "seed {seed}");
                assert_eq!(best.contains(&i), !dominated(&best), "seed {seed}");
            }
            // Along it both cost and accuracy rise.
            for pair in best.windows(2) {
                let (a, b) = (points[pair[0]], points[pair[1]]);
                assert!(a == b || (a.cost < b.cost && a.error > b.error));
            }
        }
    }

    #[test]
    fn what_is_chosen_keeps_the_bound_and_nothing_that_keeps_it_is_better() {
        for seed in 0..200 {
            let points = strewn(seed);
            for bound in 18..38 {
                let bound = f64::from(bound);
                let good = points.iter().filter(|point| point.decibels >= bound);
                let least = good.map(|point| point.cost).min_by(f64::total_cmp);
                assert_eq!(fastest(&points, bound).map(|i| points[i].cost), least);
                let cheap = points.iter().filter(|point| point.cost <= bound - 18.0);
                let most = cheap.map(|point| point.decibels).max_by(f64::total_cmp);
                let chosen = most_accurate(&points, bound - 18.0);
                assert_eq!(chosen.map(|i| points[i].decibels), most);
            }
        }
    }

    #[test]
    fn the_knee_is_where_the_curve_bends_most() {
        let bent = [
            rank(1.0, 10.0),
            rank(10.0, 45.0),
            rank(100.0, 50.0),
            rank(1000.0, 55.0),
            rank(500.0, 20.0),
        ];
        assert_eq!(knee(&bent), Some(1));
        let straight = [rank(1.0, 10.0), rank(10.0, 20.0), rank(100.0, 30.0)];
        assert_eq!(knee(&straight), None);
        let hollow = [rank(1.0, 10.0), rank(10.0, 11.0), rank(100.0, 30.0)];
        assert_eq!(knee(&hollow), None);
        assert_eq!(knee(&bent[..2]), None);
        assert_eq!(knee(&bent[..1]), None);
        assert_eq!(knee(&[]), None);
    }

    #[test]
    fn nothing_is_chosen_where_nothing_is_good_enough() {
        let points = [rank(10.0, 30.0)];
        assert_eq!(fastest(&points, 40.0), None);
        assert_eq!(most_accurate(&points, 9.0), None);
        assert_eq!(frontier(&[]), [0; 0]);
    }
}
