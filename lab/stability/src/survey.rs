//! Measures all methods, and finds their limits.

use crate::method::{About, Method};
use crate::number::ARITHMETICS;
use crate::state::{Cause, ErrorStats, State};
use std::num::NonZeroUsize;
use std::ops::RangeInclusive;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// The measurement of one form at one value of a sweep, in one arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// The measures.
    pub errors: ErrorStats,
    /// Their rating.
    pub state: State,
    /// The cause of that rating.
    pub cause: Cause,
    /// Whether the arithmetic admits the scene that belongs to the value.
    pub admitted: bool,
}

/// The measurement of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The method's description.
    pub about: About,
    /// By form, then by arithmetic, then by value.
    cells: Vec<Cell>,
}

impl Outcome {
    /// Returns the cells of form `form` in arithmetic `arithmetic` of [`ARITHMETICS`], one per value.
    pub fn row(&self, form: usize, arithmetic: usize) -> &[Cell] {
        let length = self.about.values.len();
        let start = (form * ARITHMETICS.len() + arithmetic) * length;
        &self.cells[start..start + length]
    }

    /// Returns the range of values around the easiest one in which no state is worse than `state`, or `None` if the
    /// easiest value's state is.
    pub fn limits(
        &self,
        form: usize,
        arithmetic: usize,
        state: State,
    ) -> Option<RangeInclusive<f64>> {
        self.around_home(form, arithmetic, |cell| cell.state <= state)
    }

    /// Returns the range of values around the easiest one whose scenes an arithmetic admits, or `None` if it does not
    /// admit that one.
    pub fn admitted(&self, arithmetic: usize) -> Option<RangeInclusive<f64>> {
        self.around_home(0, arithmetic, |cell| cell.admitted)
    }

    fn around_home(
        &self,
        form: usize,
        arithmetic: usize,
        good: impl Fn(&Cell) -> bool,
    ) -> Option<RangeInclusive<f64>> {
        let (row, values) = (self.row(form, arithmetic), self.about.values);
        let home = values.iter().position(|v| *v == self.about.home)?;
        let good = |i: &usize| good(&row[*i]);
        if !good(&home) {
            return None;
        }
        let first = (0..=home).rev().take_while(good).last()?;
        let last = (home..values.len()).take_while(good).last()?;
        Some(values[first]..=values[last])
    }
}

/// The measurements of several methods.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// One per method, in their order.
    pub outcomes: Vec<Outcome>,
}

/// Returns the number of steps of [`survey`].
pub fn steps(methods: &[Method]) -> usize {
    methods.iter().map(|m| m.about.values.len()).sum::<usize>() * ARITHMETICS.len()
}

/// Measures methods on several threads. `proceed` is called before each step; if it returns false, the survey is given
/// up. The result does not depend on the number of threads.
pub fn survey(
    methods: &[Method],
    threads: NonZeroUsize,
    proceed: &(dyn Fn() -> bool + Sync),
) -> Option<Survey> {
    let jobs: Vec<(usize, usize, usize)> = (methods.iter().enumerate())
        .flat_map(|(m, method)| {
            (0..ARITHMETICS.len())
                .flat_map(move |a| (0..method.about.values.len()).map(move |v| (m, a, v)))
        })
        .collect();
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(jobs.len()));
    let work = || {
        let mut mine = Vec::new();
        while let Some(&(m, a, v)) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            if !proceed() {
                break;
            }
            let method = &methods[m];
            let value = method.about.values[v];
            mine.push(((m, a, v), method.admits(a, value), method.measure(a, value)));
        }
        // A poisoned lock means that a thread has panicked, and then the scope panics too.
        if let Ok(mut done) = done.lock() {
            done.extend(mine);
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads.get().min(jobs.len()) {
            // If a thread cannot be started, the survey only takes longer.
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let done = done.into_inner().ok()?;
    (done.len() == jobs.len()).then(|| gather(methods, done))
}

/// A place in a survey (method, arithmetic, value), whether it is admitted, and the measures of its forms.
type Measured = ((usize, usize, usize), bool, Vec<ErrorStats>);

fn gather(methods: &[Method], done: Vec<Measured>) -> Survey {
    let mut outcomes: Vec<Outcome> = methods
        .iter()
        .map(|method| {
            let about = method.about;
            let nothing = Cell {
                errors: ErrorStats::default(),
                state: State::Breaks,
                cause: Cause::Refused,
                admitted: false,
            };
            let count = about.forms.len() * ARITHMETICS.len() * about.values.len();
            Outcome {
                about,
                cells: vec![nothing; count],
            }
        })
        .collect();
    for ((m, a, v), admitted, all_errors) in done {
        let outcome = &mut outcomes[m];
        let about = outcome.about;
        assert_eq!(
            all_errors.len(),
            about.forms.len(),
            "forms of {}",
            about.name
        );
        for (form, errors) in all_errors.into_iter().enumerate() {
            let place = (form * ARITHMETICS.len() + a) * about.values.len() + v;
            let (state, cause) = about.limits.judge(&errors);
            outcome.cells[place] = Cell {
                errors,
                state,
                cause,
                admitted,
            };
        }
    }
    Survey { outcomes }
}
