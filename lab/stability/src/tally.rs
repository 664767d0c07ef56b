//! What is measured of a form at one place of a sweep, and what that makes of it.

use serde::Serialize;

/// The worst of all cases at one place of a sweep, and how many went wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// How many cases there were.
    pub cases: u32,
    /// Decisions for a hit where there is none (what a sweep calls a hit, it says).
    pub false_hits: u32,
    /// Decisions for a miss where there is a hit.
    pub false_misses: u32,
    /// Points or directions on the wrong side of the surface.
    pub wrong_side: u32,
    /// Saturations of fixed-point numbers.
    pub saturations: u32,
    /// The largest error, in the sweep's unit; at most [`Tally::LARGEST`].
    pub error: f64,
    /// The largest angle between a direction found and the true one, in radians.
    pub angle: f64,
}

impl Tally {
    /// What errors that are larger, or no number, count as.
    pub const LARGEST: f64 = 1e9;

    /// Counts a case, and whether it was decided as it should be. True if both say hit.
    pub fn decide(&mut self, truth: bool, found: bool) -> bool {
        self.cases += 1;
        self.false_hits += u32::from(found && !truth);
        self.false_misses += u32::from(truth && !found);
        truth && found
    }

    /// Takes note of an error.
    pub fn err(&mut self, error: f64) {
        self.error = worse(self.error, error);
    }

    /// Takes note of an angle.
    pub fn turn(&mut self, angle: f64) {
        self.angle = worse(self.angle, angle);
    }

    /// The share of cases with wrong decisions.
    pub fn wrong_share(&self) -> f64 {
        share(self.false_hits + self.false_misses, self.cases)
    }

    /// The share of cases on the wrong side.
    pub fn side_share(&self) -> f64 {
        share(self.wrong_side, self.cases)
    }
}

fn share(part: u32, whole: u32) -> f64 {
    f64::from(part) / f64::from(whole.max(1))
}

fn worse(a: f64, b: f64) -> f64 {
    // What is no number is as bad as can be.
    if b.abs() <= Tally::LARGEST {
        a.max(b.abs())
    } else {
        Tally::LARGEST
    }
}

/// What a form is worth at one place of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// Nobody would see the difference.
    Holds,
    /// Visible, but recognisable.
    Degrades,
    /// Not what it should be.
    Breaks,
}

impl State {
    /// All states, from good to bad.
    pub const ALL: [Self; 3] = [Self::Holds, Self::Degrades, Self::Breaks];

    /// One character for tables and records.
    pub const fn symbol(self) -> char {
        match self {
            Self::Holds => '+',
            Self::Degrades => '~',
            Self::Breaks => 'x',
        }
    }
}

/// What made a state no better than it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// Nothing: it holds.
    None,
    /// There was no case: the arithmetic refuses the scene.
    Refused,
    /// Wrong decisions, most of them for a hit.
    FalseHits,
    /// Wrong decisions, most of them for a miss.
    FalseMisses,
    /// Points or directions on the wrong side.
    Side,
    /// Errors.
    Error,
    /// Angles.
    Angle,
    /// Saturations alone.
    Saturations,
}

/// Up to where a measure holds, and beyond where it breaks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// The largest value that holds.
    pub holds: f64,
    /// The largest value that does not break.
    pub degrades: f64,
}

/// A bound.
pub const fn bound(holds: f64, degrades: f64) -> Bound {
    Bound { holds, degrades }
}

impl Bound {
    fn judge(&self, value: f64) -> State {
        if value <= self.holds {
            State::Holds
        } else if value <= self.degrades {
            State::Degrades
        } else {
            State::Breaks
        }
    }
}

/// The bounds of a sweep's measures; what has none is not judged. Any saturation degrades.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// Of [`Tally::wrong_share`].
    pub wrong: Option<Bound>,
    /// Of [`Tally::error`].
    pub error: Option<Bound>,
    /// Of [`Tally::angle`].
    pub angle: Option<Bound>,
    /// Of [`Tally::side_share`].
    pub side: Option<Bound>,
}

impl Bounds {
    /// No bounds, to be added to.
    pub const NONE: Self = Self {
        wrong: None,
        error: None,
        angle: None,
        side: None,
    };

    /// The worst state of any measure, and the first measure in that state. What was never tried breaks.
    pub fn judge(&self, tally: &Tally) -> (State, Cause) {
        if tally.cases == 0 {
            return (State::Breaks, Cause::Refused);
        }
        let wrong = if tally.false_hits > tally.false_misses {
            Cause::FalseHits
        } else {
            Cause::FalseMisses
        };
        let measures = [
            (self.wrong, tally.wrong_share(), wrong),
            (self.side, tally.side_share(), Cause::Side),
            (self.error, tally.error, Cause::Error),
            (self.angle, tally.angle, Cause::Angle),
            (
                Some(bound(0.0, f64::INFINITY)),
                f64::from(tally.saturations),
                Cause::Saturations,
            ),
        ];
        let mut worst = (State::Holds, Cause::None);
        for (bound, value, cause) in measures {
            let state = bound.map_or(State::Holds, |bound| bound.judge(value));
            if state > worst.0 {
                worst = (state, cause);
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds {
        wrong: Some(bound(0.0, 0.1)),
        error: Some(bound(0.01, 0.25)),
        ..Bounds::NONE
    };

    #[test]
    fn the_worst_measure_counts() {
        let mut tally = Tally::default();
        assert!(tally.decide(true, true));
        tally.err(0.01);
        assert_eq!(BOUNDS.judge(&tally), (State::Holds, Cause::None));
        tally.err(-0.02);
        assert_eq!(BOUNDS.judge(&tally), (State::Degrades, Cause::Error));
        assert!(!tally.decide(true, false));
        assert_eq!(BOUNDS.judge(&tally), (State::Breaks, Cause::FalseMisses));
    }

    #[test]
    fn what_is_not_a_number_breaks_and_saturations_degrade() {
        let mut tally = Tally::default();
        tally.decide(true, true);
        tally.err(f64::NAN);
        assert_eq!(BOUNDS.judge(&tally), (State::Breaks, Cause::Error));
        let saturated = Tally {
            cases: 1,
            saturations: 1,
            ..Tally::default()
        };
        assert_eq!(
            BOUNDS.judge(&saturated),
            (State::Degrades, Cause::Saturations)
        );
    }

    #[test]
    fn an_angle_without_a_bound_is_not_judged() {
        let mut tally = Tally {
            cases: 1,
            ..Tally::default()
        };
        tally.turn(3.0);
        assert_eq!(BOUNDS.judge(&tally).0, State::Holds);
    }

    #[test]
    fn without_a_case_nothing_holds() {
        let nothing = BOUNDS.judge(&Tally::default());
        assert_eq!(nothing, (State::Breaks, Cause::Refused));
    }
}
