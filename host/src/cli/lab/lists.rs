//! Lists on the command line.

use crate::cli::value::{MOST, positive};
use std::num::NonZeroU32;

/// A list of whole numbers, none of them 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Whole(pub(super) Vec<NonZeroU32>);

/// Parses whole numbers such as `1,2,7`, or `1..1024`: the first number, doubled while it is at most the last.
pub(super) fn doubling(text: &str) -> Result<Whole, String> {
    let numbers = match text.split_once("..") {
        Some((first, last)) => {
            let (first, last) = (
                positive::<NonZeroU32>(first)?,
                positive::<NonZeroU32>(last)?,
            );
            let next = |n: &NonZeroU32| n.checked_mul(const { NonZeroU32::new(2).unwrap() });
            std::iter::successors(Some(first), next)
                .take_while(|n| *n <= last)
                .collect()
        }
        None => text
            .split(',')
            .map(positive)
            .collect::<Result<Vec<_>, _>>()?,
    };
    match numbers.iter().all(|n| n.get() <= MOST) && !numbers.is_empty() {
        true => Ok(Whole(numbers)),
        false => Err(format!(
            "expected numbers from 1 to {MOST} such as 1,2,7 or 1..1024"
        )),
    }
}

/// Removes duplicates; the first occurrence stays.
pub(super) fn once<T>(all: impl IntoIterator<Item = T>, same: impl Fn(&T, &T) -> bool) -> Vec<T> {
    let mut found: Vec<T> = Vec::new();
    for item in all {
        if !found.iter().any(|known| same(known, &item)) {
            found.push(item);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_numbers() {
        let numbers = |text| doubling(text).map(|list| list.0.iter().map(|n| n.get()).collect());
        assert_eq!(numbers("1,7,2"), Ok(vec![1, 7, 2]));
        assert_eq!(numbers("1..9"), Ok(vec![1, 2, 4, 8]));
        assert_eq!(numbers("3..3"), Ok(vec![3]));
        for wrong in ["", "0", "1,", "0..4", "4..1", "1..", "99999", "a"] {
            assert!(doubling(wrong).is_err(), "{wrong}");
        }
    }
}
