//! Parsers of values on the command line, with range checks.

use crate::diff::Share;
use clap::builder::{PathBufValueParser, PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use octray_prepare::choice::Choice;
use octray_prepare::{Adaptive, Samples};
use octray_render::picture::Target;
use std::ffi::OsStr;
use std::marker::PhantomData;
use std::num::{NonZeroU32, NonZeroUsize};
use std::str::FromStr;

/// Parses the name of a picture file whose extension states its format.
pub fn target() -> impl TypedValueParser<Value = Target> {
    PathBufValueParser::new().try_map(Target::new)
}

/// Two opposite corners of a box, in scene units.
pub type Room = [[f64; 3]; 2];

/// Parses two opposite corners of a box.
pub fn room(text: &str) -> Result<Room, String> {
    let expected = || "expected six numbers x,y,z,x,y,z: two opposite corners of a box".to_owned();
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let [a, b, c, d, e, f] = numbers
        .ok()
        .filter(|numbers| numbers.iter().all(|x| x.is_finite()))
        .and_then(|numbers| <[f64; 6]>::try_from(numbers).ok())
        .ok_or_else(expected)?;
    Ok([[a, b, c], [d, e, f]])
}

/// Parses one of a list of names; help shows the list with the meaning of each name.
pub fn choice<T: Choice>() -> ChoiceParser<T> {
    ChoiceParser {
        ignore_case: false,
        named: PhantomData,
    }
}

/// Parses the names of a [`Choice`].
#[derive(Clone, Debug)]
pub struct ChoiceParser<T> {
    ignore_case: bool,
    named: PhantomData<fn() -> T>,
}

impl<T> ChoiceParser<T> {
    /// Ignores the case of letters.
    #[must_use]
    pub fn ignore_case(self) -> Self {
        Self {
            ignore_case: true,
            ..self
        }
    }
}

impl<T: Choice> TypedValueParser for ChoiceParser<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let text = value.to_string_lossy();
        let is = |name: &str| match self.ignore_case {
            true => name.eq_ignore_ascii_case(&text),
            false => name == text,
        };
        let mut all = T::all().into_iter();
        let found = all.find(|value| value.names().iter().any(|name| is(name)));
        found.ok_or_else(|| {
            let mut error = clap::Error::new(ErrorKind::InvalidValue).with_cmd(command);
            if let Some(argument) = argument {
                let name = ContextValue::String(argument.to_string());
                error.insert(ContextKind::InvalidArg, name);
            }
            let value = ContextValue::String(text.into_owned());
            error.insert(ContextKind::InvalidValue, value);
            let names = T::all().into_iter().map(|value| value.name().to_owned());
            error.insert(
                ContextKind::ValidValue,
                ContextValue::Strings(names.collect()),
            );
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let shown = |value: T| {
            let names = value.names().into_iter();
            let others = names.filter(move |name| *name != value.name());
            PossibleValue::new(value.name())
                .aliases(others)
                .help(value.help())
        };
        Some(Box::new(T::all().into_iter().map(shown)))
    }
}

/// Parses `WxH`, both from 1 to 65535.
///
/// # Errors
/// States what was expected.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse::<u16>().ok().filter(|side| *side > 0);
    text.split_once(['x', 'X'])
        .and_then(|(width, height)| Some((side(width)?.into(), side(height)?.into())))
        .ok_or_else(|| "expected WIDTHxHEIGHT such as 640x480, each from 1 to 65535".into())
}

/// Parses `K` or `adaptive[:LEVELS[:THRESHOLD]]`.
///
/// # Errors
/// States what was expected.
pub fn samples(text: &str) -> Result<Samples, String> {
    let uniform = text.parse().ok().filter(|k| (1..=64).contains(k));
    let adaptive = || {
        let mut words = text.split(':');
        (words.next() == Some("adaptive")).then_some(())?;
        let mut how = Adaptive::DEFAULT;
        if let Some(levels) = words.next() {
            let levels = levels.parse().ok();
            how.levels = levels.filter(|n| (1..=Adaptive::MOST_LEVELS).contains(n))?;
        }
        if let Some(threshold) = words.next() {
            how.threshold = threshold.parse().ok()?;
        }
        words.next().is_none().then_some(how)
    };
    uniform
        .map(Samples::Uniform)
        .or_else(|| adaptive().map(Samples::Adaptive))
        .ok_or_else(|| {
            format!(
                "expected a number from 1 to 64, or adaptive[:LEVELS[:THRESHOLD]] with 1 to {} levels and a threshold \
                 from 0 to 255",
                Adaptive::MOST_LEVELS
            )
        })
}

/// Parses `K` where there are no adaptive samples.
///
/// # Errors
/// States what was expected.
pub fn uniform_samples(text: &str) -> Result<u32, String> {
    match samples(text) {
        Ok(Samples::Uniform(samples)) => Ok(samples),
        Ok(Samples::Adaptive(_)) => {
            Err("expected a number from 1 to 64: adaptive samples are for octray render".into())
        }
        Err(_) => Err("expected a number from 1 to 64".into()),
    }
}

/// Parses `x,y`, the column and the row of a pixel.
///
/// # Errors
/// States what was expected.
pub fn pixel(text: &str) -> Result<(u32, u32), String> {
    let number = |text: &str| text.trim().parse().ok();
    text.split_once(',')
        .and_then(|(column, row)| Some((number(column)?, number(row)?)))
        .ok_or_else(|| "expected COLUMN,ROW such as 100,80, both counted from 0".into())
}

/// Parses a whole number of at least 1 into one of the `NonZero` types.
pub(super) fn positive<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse()
        .map_err(|_| "expected a whole number, at least 1".into())
}

/// The largest number of processors or threads, and the largest side of a tile: no picture has more rows.
pub(super) const MOST: u32 = 65_536;

/// Parses a whole number from 1 to [`MOST`].
pub(super) fn count(text: &str) -> Result<NonZeroU32, String> {
    positive(text)
        .ok()
        .filter(|number: &NonZeroU32| number.get() <= MOST)
        .ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))
}

/// Parses a number of threads from 1 to [`MOST`].
pub(super) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    NonZeroUsize::try_from(count(text)?).map_err(|cause| cause.to_string())
}

/// Parses a weight from 0 to 1: a number, or a fraction such as `1/512`.
pub(crate) fn weight(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.parse::<f64>().ok();
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    number(above)
        .zip(number(below))
        .map(|(above, below)| above / below)
        .filter(|weight| (0.0..=1.0).contains(weight))
        .ok_or_else(|| "expected a weight from 0 to 1, such as 0.01 or 1/512".into())
}

/// Parses a finite number of at least 0.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number: &f64| number.is_finite() && *number >= 0.0)
        .ok_or_else(|| "expected a number, at least 0".into())
}

/// Parses a number of pixels, or a percentage such as `0.1%`.
pub(super) fn share(text: &str) -> Result<Share, String> {
    let expected = "expected a number of pixels, or a percentage of them such as 0.1%";
    match text.strip_suffix('%') {
        None => text.parse().map(Share::Pixels).map_err(|_| expected.into()),
        Some(percent) => not_negative(percent)
            .ok()
            .filter(|percent| *percent <= 100.0)
            .map(Share::Percent)
            .ok_or_else(|| expected.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert_eq!(size("1X65535"), Ok((1, 65535)));
        for wrong in [
            "", "640", "0x5", "5x0", "65536x1", "1x2x3", "-1x2", "1.5x2", "ax2",
        ] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers_of_samples() {
        let adaptive = |levels, threshold| Ok(Samples::Adaptive(Adaptive { levels, threshold }));
        let Adaptive { levels, threshold } = Adaptive::DEFAULT;
        assert_eq!(samples("64"), Ok(Samples::Uniform(64)));
        assert_eq!(samples("adaptive"), adaptive(levels, threshold));
        assert_eq!(samples("adaptive:6"), adaptive(6, threshold));
        assert_eq!(samples("adaptive:1:255"), adaptive(1, 255));
        for wrong in [
            "",
            "0",
            "65",
            "Adaptive",
            "adaptive:",
            "adaptive:0",
            "adaptive:7",
            "adaptive:2:256",
            "adaptive:2:3:4",
            "adaptive:2:",
            "adaptive2",
        ] {
            assert!(samples(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn adaptive_samples_are_told_apart_where_there_are_none() {
        assert_eq!(uniform_samples("64"), Ok(64));
        let adaptive = uniform_samples("adaptive:2").unwrap_err();
        assert!(adaptive.contains("are for octray render"), "{adaptive}");
        for wrong in ["0", "65", "x", "-1", "adaptive:0"] {
            let expected = "expected a number from 1 to 64";
            assert_eq!(uniform_samples(wrong), Err(expected.into()), "{wrong}");
        }
    }

    #[test]
    fn pixels() {
        assert_eq!(pixel("0,65535"), Ok((0, 65535)));
        assert_eq!(pixel("3, 4"), Ok((3, 4)));
        for wrong in ["", "3", "3,", "3,4,5", "-1,2", "1.5,2", "3x4"] {
            assert!(pixel(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn counts() {
        assert_eq!(count("1").map(NonZeroU32::get), Ok(1));
        assert_eq!(count("65536").map(NonZeroU32::get), Ok(65_536));
        assert_eq!(threads("65536").map(NonZeroUsize::get), Ok(65_536));
        assert!(threads("18446744073709551615").is_err());
        for wrong in ["", "0", "65537", "4294967296", "-1", "1.5"] {
            assert!(count(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn weights() {
        assert_eq!(weight("0"), Ok(0.0));
        assert_eq!(weight("1/512"), Ok(1.0 / 512.0));
        assert_eq!(weight("1"), Ok(1.0));
        for wrong in ["", "-0.1", "1.01", "1/0", "0/0", "nan", "inf", "1/2/3", "x"] {
            assert!(weight(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn shares() {
        assert_eq!(share("12"), Ok(Share::Pixels(12)));
        assert_eq!(share("0.5%"), Ok(Share::Percent(0.5)));
        for wrong in ["", "%", "1.5", "-1", "-1%", "101%", "nan%"] {
            assert!(share(wrong).is_err(), "{wrong}");
        }
    }
}
