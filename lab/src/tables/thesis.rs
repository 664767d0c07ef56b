//! The known numbers of the thesis, from a file of comma-separated values.

use super::number::TableNumber;
use octray_render::error::Error;
use octray_scenes::{input, name::Shown};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The numbers that come with octray; the file's header describes the columns.
const KNOWN: &str = include_str!("thesis.csv");

/// The unit of a value that is a ratio to the first variant.
const RATIO: &str = "ratio";

/// A number of the thesis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Datum {
    /// Its table.
    pub table: TableNumber,
    /// Its scene; empty if not known.
    pub scene: String,
    /// Its variant of the scene.
    pub variant: String,
    /// What it counts.
    pub quantity: String,
    /// The machine on which it was measured; empty if that does not matter.
    pub machine: String,
    /// The number, finite.
    pub value: f64,
    /// Its unit; empty for a count.
    pub unit: String,
    /// Its page; `None` if not known.
    pub page: Option<u32>,
}

/// The place of a number.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The table.
    pub table: TableNumber,
    /// The scene.
    pub scene: &'a str,
    /// The variant.
    pub variant: &'a str,
    /// The quantity.
    pub quantity: &'a str,
}

/// The most bytes of a file of figures.
pub(super) const MOST_CSV: u64 = 1 << 26;

/// All known numbers of the thesis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thesis(Vec<Datum>);

impl Thesis {
    /// Reads a file, or the numbers that come with octray.
    ///
    /// # Errors
    /// [`Error::Read`] if the file cannot be read, [`Error::Failed`] if it has the wrong form.
    pub fn read(path: Option<&Path>) -> Result<Self, Error> {
        let Some(path) = path else {
            return Self::parse(KNOWN, "thesis.csv");
        };
        let text = input::read_text(path, MOST_CSV).map_err(|source| Error::read(path, source))?;
        Self::parse(&text, &Shown(path).to_string())
    }

    /// Those of a text, which is called `name` where it is not of the form.
    ///
    /// # Errors
    /// [`Error::Failed`] if it is not.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        let failed = |why: &dyn std::fmt::Display| Error::Failed(format!("{name}: {why}"));
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut data: Vec<Datum> = Vec::new();
        for datum in reader.deserialize() {
            let datum: Datum = datum.map_err(|error| failed(&error))?;
            if !datum.value.is_finite() {
                return Err(failed(&format!("{} is not a number", datum.value)));
            }
            let twice = data.iter().any(|other| {
                !datum.scene.is_empty()
                    && other.is_at(datum.place())
                    && other.machine == datum.machine
                    && other.is_ratio() == datum.is_ratio()
            });
            if twice {
                return Err(failed(&format!("{datum} is there twice")));
            }
            data.push(datum);
        }
        Ok(Self(data))
    }

    /// Returns the numbers of a table.
    pub fn of(&self, table: TableNumber) -> impl Iterator<Item = &Datum> {
        self.0.iter().filter(move |datum| datum.table == table)
    }

    /// Returns a number that is not a ratio.
    pub fn value(&self, place: Place<'_>, machine: &str) -> Option<&Datum> {
        self.at(place, machine).find(|datum| !datum.is_ratio())
    }

    /// Returns a ratio to the first variant.
    pub fn ratio(&self, place: Place<'_>, machine: &str) -> Option<&Datum> {
        self.at(place, machine).find(|datum| datum.is_ratio())
    }

    fn at(&self, place: Place<'_>, machine: &str) -> impl Iterator<Item = &Datum> {
        (self.0.iter()).filter(move |datum| datum.is_at(place) && datum.machine == machine)
    }
}

impl Datum {
    /// Returns its place.
    pub fn place(&self) -> Place<'_> {
        Place {
            table: self.table,
            scene: &self.scene,
            variant: &self.variant,
            quantity: &self.quantity,
        }
    }

    /// Returns whether it belongs to a place.
    pub fn is_at(&self, place: Place<'_>) -> bool {
        self.table == place.table
            && self.scene == place.scene
            && self.variant == place.variant
            && self.quantity == place.quantity
    }

    /// Returns whether it is a ratio to the first variant.
    pub fn is_ratio(&self) -> bool {
        self.unit == RATIO
    }
}

/// Displays it like `time, without: ratio 2.5, Sun 3/110`.
impl std::fmt::Display for Datum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            scene,
            variant,
            quantity,
            machine,
            value,
            unit,
            page,
            ..
        } = self;
        match &**scene {
            "" => write!(f, "{quantity}, {variant}: ")?,
            scene => write!(f, "{scene}, {quantity}, {variant}: ")?,
        }
        match &**unit {
            "" => write!(f, "{value}")?,
            RATIO => write!(f, "ratio {value}")?,
            unit => write!(f, "{value} {unit}")?,
        }
        if !machine.is_empty() {
            write!(f, ", {machine}")?;
        }
        match page {
            Some(page) => write!(f, ", page {page}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Parses a thesis with these lines.
    pub(in super::super) fn thesis(lines: &str) -> Result<Thesis, String> {
        let head = "table,scene,variant,quantity,machine,value,unit,page\n";
        Thesis::parse(&format!("{head}{lines}"), "a.csv").map_err(|error| error.to_string())
    }

    #[test]
    fn the_shipped_numbers_are_exactly_the_known_ones() {
        let known = Thesis::read(None).unwrap();
        let tables = <TableNumber as strum::VariantArray>::VARIANTS
            .iter()
            .copied();
        let counts: Vec<usize> = tables.map(|number| known.of(number).count()).collect();
        assert_eq!(counts, [18, 8, 8, 6, 20, 8, 8, 32, 40]);
        let of = |scene, variant| Place {
            table: TableNumber::Nine,
            scene,
            variant,
            quantity: "speed-up, dynamic",
        };
        let speed_up = known.value(of("figure-21", "7"), "").unwrap();
        assert_eq!((speed_up.value, speed_up.page), (6.97, Some(65)));
    }

    #[test]
    fn values_and_ratios_are_found_at_their_places() {
        let thesis = thesis(
            "II, figure-19, 2 lights, time, Balance 8000, 61, minutes, 70\n\
             # nothing\n\
             II,figure-19,2 lights,time,Sun 3/110,1.5,ratio,",
        )
        .unwrap();
        let place = Place {
            table: TableNumber::Two,
            scene: "figure-19",
            variant: "2 lights",
            quantity: "time",
        };
        let found = thesis.value(place, "Balance 8000").unwrap();
        assert_eq!((found.value, found.page), (61.0, Some(70)));
        assert!(thesis.ratio(place, "Balance 8000").is_none());
        assert!(thesis.value(place, "Sun 3/110").is_none());
        assert_eq!(thesis.ratio(place, "Sun 3/110").unwrap().value, 1.5);
    }

    #[test]
    fn mistakes_are_reported_with_their_place() {
        for (lines, expected) in [
            (
                "X,figure-19,a,time,,1,,",
                "a.csv: CSV deserialize error: record 1 (line: 2",
            ),
            ("II,figure-19,a,time,,many,,", "invalid float literal"),
            ("II,figure-19,a,time,,inf,,", "inf is not a number"),
            ("II,figure-19,a,time,,1", "found record with 6 fields"),
            (
                "II,figure-19,a,time,,1,,\nII,figure-19,a,time,,2,,",
                "figure-19, time, a: 2 is there twice",
            ),
        ] {
            let message = thesis(lines).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
    }
}
