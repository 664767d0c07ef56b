//! How many rays the laboratory traces for a picture. The rays of a hall of glass and mirrors double at every bounce: such
//! a picture is explored as deep as a budget allows, and the rest is told as unexplored.

use octray_render::error::Error;

/// Per ray of the camera: ten times what pictures of glass and mirrors take that come to an end.
const PER_PRIMARY: u64 = 64;

/// Even a small picture may take as many.
const LEAST: u64 = 1 << 19;

/// Returns the most rays, without shadow rays, of a picture of so many columns and rows with `samples` × `samples` rays
/// per pixel.
pub fn rays((width, height): (u32, u32), samples: u32) -> u64 {
    let samples = u64::from(samples);
    let primary = (u64::from(width) * u64::from(height)).saturating_mul(samples * samples);
    primary.saturating_mul(PER_PRIMARY).max(LEAST)
}

/// Returns what `trace` gives with the most bounces, up to `most`, with which it keeps to its budget, and their number.
///
/// # Errors
/// [`Error::TooManyRays`] if it does not even without bounces; other errors of `trace`.
pub fn deepest<T>(
    most: u32,
    mut trace: impl FnMut(u32) -> Result<T, Error>,
) -> Result<(u32, T), Error> {
    let mut attempt = |depth| match trace(depth) {
        Ok(traced) => Ok(Some(traced)),
        Err(Error::TooManyRays(_)) if depth > 0 => Ok(None),
        Err(error) => Err(error),
    };
    if let Some(traced) = attempt(most)? {
        return Ok((most, traced));
    }
    // More bounces take more rays.
    let (mut low, mut high) = (0, most);
    let mut best = None;
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        match attempt(middle)? {
            Some(traced) => (low, best) = (middle, Some(traced)),
            None => high = middle,
        }
    }
    match best {
        Some(traced) => Ok((low, traced)),
        None => Ok((0, trace(0)?)),
    }
}

/// Returns a sentence about the bounces that were not explored; `None` if all were.
pub fn unexplored(explored: u32, most: u32, budget: u64) -> Option<String> {
    (explored < most).then(|| {
        let more = explored + 1;
        let why = Error::TooManyRays(budget);
        format!("more than {explored} bounces were not explored: with {more}, {why}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deepest_picture_within_the_budget_is_found() {
        for (affordable, most) in [(0, 9), (1, 9), (5, 9), (8, 9), (9, 9), (64, 64), (0, 0)] {
            let mut tried = 0;
            let trace = |depth| {
                tried += 1;
                match depth <= affordable {
                    true => Ok(depth),
                    false => Err(Error::TooManyRays(1)),
                }
            };
            assert_eq!(deepest(most, trace).unwrap(), (affordable, affordable));
            assert!(tried <= 8, "{tried}");
        }
    }

    #[test]
    fn a_picture_that_takes_too_many_rays_without_bounces_is_refused() {
        let result = deepest(9, |_| -> Result<(), _> { Err(Error::TooManyRays(7)) });
        assert!(matches!(result, Err(Error::TooManyRays(7))));
    }

    #[test]
    fn what_was_not_explored_is_told() {
        assert_eq!(unexplored(64, 64, 9), None);
        let text = unexplored(11, 64, 524_288).unwrap();
        assert_eq!(
            text,
            "more than 11 bounces were not explored: with 12, the picture takes more than 524,288 rays, not counting \
             shadow rays"
        );
    }
}
