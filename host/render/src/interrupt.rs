//! Requests to stop, polled by whatever takes long: from outside, or because a budget of rays is spent.

use crate::error::Error;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A flag that long work polls; clones share it.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    requested: Arc<AtomicBool>,
    budget: Option<Arc<Budget>>,
}

/// How many rays may be traced, and how many were.
#[derive(Debug)]
struct Budget {
    most: u64,
    traced: AtomicU64,
}

impl Interrupt {
    /// A flag that only [`Interrupt::request`] sets.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same flag, for work that may trace no more than this many rays on all threads together. Shadow rays do not
    /// count: there are no more of them than lights for each other ray.
    pub fn with_budget(&self, rays: u64) -> Self {
        Self {
            requested: Arc::clone(&self.requested),
            budget: Some(Arc::new(Budget {
                most: rays,
                traced: AtomicU64::new(0),
            })),
        }
    }

    /// Ask the work to stop.
    pub fn request(&self) {
        self.requested.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to stop. A spent budget does not ask.
    pub fn requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }

    /// [`Error::Interrupted`] once the work was asked to stop, [`Error::TooManyRays`] once the budget is spent.
    pub fn check(&self) -> Result<(), Error> {
        if self.requested() {
            return Err(Error::Interrupted);
        }
        match &self.budget {
            Some(budget) if budget.is_spent() => Err(Error::TooManyRays(budget.most)),
            _ => Ok(()),
        }
    }

    /// Takes rays that were traced off the budget. Whether to trace no more.
    pub(crate) fn spend(&self, rays: u64) -> bool {
        if let Some(budget) = &self.budget {
            budget.traced.fetch_add(rays, Ordering::Relaxed);
        }
        self.check().is_err()
    }
}

impl Budget {
    fn is_spent(&self) -> bool {
        self.traced.load(Ordering::Relaxed) > self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spent_budget_stops_only_its_own_work() {
        let interrupt = Interrupt::new();
        let limited = interrupt.with_budget(10);
        assert!(!limited.spend(10));
        limited.check().unwrap();
        assert!(limited.clone().spend(1));
        assert!(matches!(limited.check(), Err(Error::TooManyRays(10))));
        assert!(!limited.requested());
        interrupt.check().unwrap();
        interrupt.with_budget(10).check().unwrap();
    }

    #[test]
    fn a_request_reaches_all_work_with_a_budget() {
        let interrupt = Interrupt::new();
        let limited = interrupt.with_budget(10);
        interrupt.request();
        assert!(matches!(limited.check(), Err(Error::Interrupted)));
        assert!(limited.spend(0));
    }
}
