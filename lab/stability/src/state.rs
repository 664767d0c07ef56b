//! The measures of a form at one value of a sweep, and their rating.

use serde::Serialize;

/// The worst errors of all cases at one value of a sweep, and the number of wrong cases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ErrorStats {
    /// The number of cases.
    pub cases: u32,
    /// Decisions for a hit where there is none (each sweep defines what a hit is).
    pub false_hits: u32,
    /// Decisions for a miss where there is a hit.
    pub false_misses: u32,
    /// Points or directions on the wrong side of the surface.
    pub wrong_side: u32,
    /// Saturations of fixed-point numbers.
    pub saturations: u32,
    /// The largest error, in the sweep's unit; at most [`ErrorStats::LARGEST`].
    pub error: f64,
    /// The largest angle between a computed direction and the true one, in radians.
    pub angle: f64,
}

impl ErrorStats {
    /// The recorded error of cases whose error is larger or NaN.
    pub const LARGEST: f64 = 1e9;

    /// Counts a case, and whether its decision is right. Returns true if both are a hit.
    pub fn decide(&mut self, truth: bool, found: bool) -> bool {
        self.cases += 1;
        self.false_hits += u32::from(found && !truth);
        self.false_misses += u32::from(truth && !found);
        truth && found
    }

    /// Records an error.
    pub fn err(&mut self, error: f64) {
        self.error = worse(self.error, error);
    }

    /// Records an angle.
    pub fn turn(&mut self, angle: f64) {
        self.angle = worse(self.angle, angle);
    }

    /// Returns the share of cases with wrong decisions.
    pub fn wrong_share(&self) -> f64 {
        share(self.false_hits + self.false_misses, self.cases)
    }

    /// Returns the share of cases on the wrong side.
    pub fn side_share(&self) -> f64 {
        share(self.wrong_side, self.cases)
    }
}

fn share(part: u32, whole: u32) -> f64 {
    f64::from(part) / f64::from(whole.max(1))
}

fn worse(a: f64, b: f64) -> f64 {
    // NaN counts as the largest error.
    if b.abs() <= ErrorStats::LARGEST {
        a.max(b.abs())
    } else {
        ErrorStats::LARGEST
    }
}

/// The rating of a form at one value of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// The difference is invisible.
    Holds,
    /// Visible, but recognisable.
    Degrades,
    /// Wrong.
    Breaks,
}

impl State {
    /// All states, from best to worst.
    pub const ALL: [Self; 3] = [Self::Holds, Self::Degrades, Self::Breaks];

    /// Returns its character for tables and records.
    pub const fn symbol(self) -> char {
        match self {
            Self::Holds => '+',
            Self::Degrades => '~',
            Self::Breaks => 'x',
        }
    }
}

/// The cause of a state.
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

/// The limits of one measure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StateLimit {
    /// The largest value that holds.
    pub holds: f64,
    /// The largest value that does not break.
    pub degrades: f64,
}

/// Returns a limit.
pub const fn limit(holds: f64, degrades: f64) -> StateLimit {
    StateLimit { holds, degrades }
}

impl StateLimit {
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

/// The limits of a sweep's measures; a measure without limits is not rated. Any saturation degrades.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StateLimits {
    /// Limit of [`ErrorStats::wrong_share`].
    pub wrong: Option<StateLimit>,
    /// Limit of [`ErrorStats::error`].
    pub error: Option<StateLimit>,
    /// Limit of [`ErrorStats::angle`].
    pub angle: Option<StateLimit>,
    /// Limit of [`ErrorStats::side_share`].
    pub side: Option<StateLimit>,
}

impl StateLimits {
    /// No limits, as base of others.
    pub const NONE: Self = Self {
        wrong: None,
        error: None,
        angle: None,
        side: None,
    };

    /// Returns the worst state of any measure, and the first measure in that state. Without a case the state is broken.
    pub fn judge(&self, errors: &ErrorStats) -> (State, Cause) {
        if errors.cases == 0 {
            return (State::Breaks, Cause::Refused);
        }
        let wrong = if errors.false_hits > errors.false_misses {
            Cause::FalseHits
        } else {
            Cause::FalseMisses
        };
        let measures = [
            (self.wrong, errors.wrong_share(), wrong),
            (self.side, errors.side_share(), Cause::Side),
            (self.error, errors.error, Cause::Error),
            (self.angle, errors.angle, Cause::Angle),
            (
                Some(limit(0.0, f64::INFINITY)),
                f64::from(errors.saturations),
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
