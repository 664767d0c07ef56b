//! Methods measured everywhere, and the limits that come of it.

use crate::method::{About, Method};
use crate::number::ARITHMETICS;
use crate::tally::{Cause, State, Tally};
use std::num::NonZeroUsize;
use std::ops::RangeInclusive;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What was measured at one value of a sweep, in one arithmetic, of one form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// The measures.
    pub tally: Tally,
    /// What they are worth.
    pub state: State,
    /// What made them so.
    pub cause: Cause,
    /// Whether the arithmetic admits the scene that the value stands for.
    pub admitted: bool,
}

/// One method, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// What the method is about.
    pub about: About,
    /// By form, by arithmetic, by value.
    cells: Vec<Cell>,
}

impl Outcome {
    /// The cells of form `form` in arithmetic `arithmetic` of [`ARITHMETICS`], value by value.
    pub fn row(&self, form: usize, arithmetic: usize) -> &[Cell] {
        let length = self.about.values.len();
        let start = (form * ARITHMETICS.len() + arithmetic) * length;
        &self.cells[start..start + length]
    }

    /// The values around the gentlest one up to which the states are no worse than `state`; none
    /// if not even there.
    pub fn limits(
        &self,
        form: usize,
        arithmetic: usize,
        state: State,
    ) -> Option<RangeInclusive<f64>> {
        self.around_home(form, arithmetic, |cell| cell.state <= state)
    }

    /// The values around the gentlest one whose scenes an arithmetic admits; none if not even that.
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

/// Methods, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// One for each method, in their order.
    pub outcomes: Vec<Outcome>,
}

/// How many steps [`survey`] takes.
pub fn steps(methods: &[Method]) -> usize {
    methods.iter().map(|m| m.about.values.len()).sum::<usize>() * ARITHMETICS.len()
}

/// Measures methods on some threads. `proceed` is called before each step; where it says no, all
/// is given up. The result does not depend on the threads.
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
        // A poisoned lock means that a thread has panicked, and with it the scope.
        if let Ok(mut done) = done.lock() {
            done.extend(mine);
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads.get().min(jobs.len()) {
            // Without more threads it takes longer.
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let done = done.into_inner().ok()?;
    (done.len() == jobs.len()).then(|| gather(methods, done))
}

/// A place in a survey (method, arithmetic, value), whether it is admitted, and its forms' tallies.
type Measured = ((usize, usize, usize), bool, Vec<Tally>);

fn gather(methods: &[Method], done: Vec<Measured>) -> Survey {
    let mut outcomes: Vec<Outcome> = methods
        .iter()
        .map(|method| {
            let about = method.about;
            let nothing = Cell {
                tally: Tally::default(),
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
    for ((m, a, v), admitted, tallies) in done {
        let outcome = &mut outcomes[m];
        let about = outcome.about;
        assert_eq!(tallies.len(), about.forms.len(), "forms of {}", about.name);
        for (form, tally) in tallies.into_iter().enumerate() {
            let place = (form * ARITHMETICS.len() + a) * about.values.len() + v;
            let (state, cause) = about.bounds.judge(&tally);
            outcome.cells[place] = Cell {
                tally,
                state,
                cause,
                admitted,
            };
        }
    }
    Survey { outcomes }
}
