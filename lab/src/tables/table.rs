//! A table of ours beside the thesis's.

use super::number::Number;
use super::thesis::{Datum, Place, Thesis};
use serde::Serialize;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: &'static str,
    /// The name under which the thesis's figures are found, most often the same.
    pub thesis: &'static str,
    /// Our unit; empty for a mere count.
    pub unit: &'static str,
    /// How many decimals it is told with.
    pub decimals: usize,
    /// Whether it is told as a ratio to the first variant's, too.
    pub ratio: bool,
    /// If our unit is the thesis's: by what share the two may differ and still agree.
    pub within: Option<f64>,
}

impl Quantity {
    /// A count that is ours alone; only ratios compare.
    pub const fn count(name: &'static str) -> Self {
        Self {
            name,
            thesis: name,
            unit: "",
            decimals: 0,
            ratio: true,
            within: None,
        }
    }

    /// A time, by [`octray_render::cost`]; only ratios compare.
    pub const fn instructions(name: &'static str) -> Self {
        Self {
            unit: "M instructions",
            decimals: 1,
            ..Self::count(name)
        }
    }

    /// A count that has to be the thesis's, but for a share.
    pub const fn rays(name: &'static str, within: f64) -> Self {
        Self {
            within: Some(within),
            ..Self::count(name)
        }
    }
}

/// To what line ratios are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// The first one of the same scene.
    OfScene,
    /// The first one.
    OfTable,
}

/// Scene, variant, and a value for each quantity.
pub type DraftLine = (String, String, Vec<f64>);

/// A table before it is compared: what came out here.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Which one.
    pub number: Number,
    /// What the columns after scene and variant hold.
    pub quantities: Vec<Quantity>,
    /// To what line ratios are.
    pub base: Base,
    /// Its lines.
    pub lines: Vec<DraftLine>,
    /// What is to be said of it.
    pub notes: Vec<String>,
}

/// A table of ours beside the thesis's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// Which one.
    pub table: Number,
    /// What it shows.
    pub title: &'static str,
    /// What the variants are.
    pub variants: &'static str,
    /// What the columns hold.
    #[serde(skip)]
    pub quantities: Vec<Quantity>,
    /// Its lines.
    pub lines: Vec<Line>,
    /// What the thesis has in this table that belongs to none of the lines.
    pub also: Vec<Datum>,
    /// What is to be said of it.
    pub notes: Vec<String>,
}

/// A scene in a variant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// The scene.
    pub scene: String,
    /// The variant.
    pub variant: String,
    /// A value for each quantity.
    pub values: Vec<Value>,
}

/// What came out here, beside the thesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// What it is.
    pub quantity: &'static str,
    /// Our unit.
    pub unit: &'static str,
    /// Ours.
    pub ours: f64,
    /// Its ratio to the first variant's; `None` for that itself.
    pub ratio: Option<f64>,
    /// The thesis's, for each machine that it has in this column.
    pub thesis: Vec<Given>,
}

/// What the thesis has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Given {
    /// On which machine; empty if that does not matter.
    pub machine: String,
    /// Its figure, if at hand.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// Its ratio to the first variant's, as far as at hand.
    pub ratio: Option<f64>,
    /// Ours over it: figures of the same unit, otherwise ratios.
    pub ours_over_thesis: Option<f64>,
    /// On which page.
    pub page: Option<u32>,
}

impl Draft {
    /// The table beside what the thesis has.
    pub fn beside(self, thesis: &Thesis) -> Table {
        let (placed, also): (Vec<&Datum>, Vec<&Datum>) =
            (thesis.of(self.number)).partition(|datum| self.has(datum));
        let machines: Vec<Vec<&str>> = (self.quantities.iter())
            .map(|quantity| machines(&placed, quantity))
            .collect();
        let value = |line: &DraftLine, i: usize| Value {
            quantity: self.quantities[i].name,
            unit: self.quantities[i].unit,
            ours: line.2[i],
            ratio: self.ratio(line, i),
            thesis: (machines[i].iter())
                .map(|machine| self.given(line, i, machine, thesis))
                .collect(),
        };
        let lines: Vec<Line> = (self.lines.iter())
            .map(|line| Line {
                scene: line.0.clone(),
                variant: line.1.clone(),
                values: (0..self.quantities.len()).map(|i| value(line, i)).collect(),
            })
            .collect();
        let agreements = (self.quantities.iter().enumerate())
            .filter_map(|(i, quantity)| agreement(&lines, i, quantity));
        Table {
            table: self.number,
            title: self.number.title(),
            variants: self.number.variants(),
            notes: self.notes.iter().cloned().chain(agreements).collect(),
            also: also.into_iter().cloned().collect(),
            quantities: self.quantities,
            lines,
        }
    }

    /// Where the thesis would have the figure of a line.
    fn place<'a>(&'a self, line: &'a DraftLine, i: usize) -> Place<'a> {
        Place {
            table: self.number,
            scene: &line.0,
            variant: &line.1,
            quantity: self.quantities[i].thesis,
        }
    }

    /// Whether a figure of the thesis belongs to a line.
    fn has(&self, datum: &Datum) -> bool {
        let of_line = |line| (0..self.quantities.len()).any(|i| datum.is_at(self.place(line, i)));
        self.lines.iter().any(of_line)
    }

    /// The line to which a ratio is; `None` for that line itself.
    fn base(&self, line: &DraftLine, i: usize) -> Option<&DraftLine> {
        let found = (self.lines.iter())
            .find(|other| self.base == Base::OfTable || other.0 == line.0)
            .filter(|base| (&base.0, &base.1) != (&line.0, &line.1));
        found.filter(|_| self.quantities[i].ratio)
    }

    fn ratio(&self, line: &DraftLine, i: usize) -> Option<f64> {
        quotient(line.2[i], self.base(line, i)?.2[i])
    }

    /// What the thesis has from a machine.
    fn given(&self, line: &DraftLine, i: usize, machine: &str, thesis: &Thesis) -> Given {
        let place = self.place(line, i);
        let (value, told) = (thesis.value(place, machine), thesis.ratio(place, machine));
        let computed = || {
            let base = self.place(self.base(line, i)?, i);
            quotient(value?.value, thesis.value(base, machine)?.value)
        };
        let ratio = told.map(|datum| datum.value).or_else(computed);
        Given {
            machine: machine.into(),
            value: value.map(|datum| datum.value),
            unit: value.map_or(String::new(), |datum| datum.unit.clone()),
            ratio,
            ours_over_thesis: match self.quantities[i].within {
                Some(_) => value.and_then(|datum| quotient(line.2[i], datum.value)),
                None => quotient(
                    self.ratio(line, i).unwrap_or(f64::NAN),
                    ratio.unwrap_or(f64::NAN),
                ),
            },
            page: value.or(told).and_then(|datum| datum.page),
        }
    }
}

/// A quotient that is a number.
fn quotient(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|quotient| quotient.is_finite())
}

/// The machines from which there is a quantity.
fn machines<'a>(placed: &[&'a Datum], quantity: &Quantity) -> Vec<&'a str> {
    let mut machines: Vec<&str> = Vec::new();
    for datum in placed {
        if datum.quantity == quantity.thesis && !machines.contains(&&*datum.machine) {
            machines.push(&datum.machine);
        }
    }
    machines
}

/// How many of the figures that ought to agree do; `None` if none is at hand.
fn agreement(lines: &[Line], column: usize, quantity: &Quantity) -> Option<String> {
    let within = quantity.within?;
    let compared: Vec<f64> = (lines.iter())
        .flat_map(|line| &line.values[column].thesis)
        .filter_map(|given| given.ours_over_thesis)
        .collect();
    let agree = compared
        .iter()
        .filter(|share| (**share - 1.0).abs() <= within);
    (!compared.is_empty()).then(|| {
        let (name, percent) = (quantity.name, within * 100.0);
        let (agree, all) = (agree.count(), compared.len());
        format!("{name}: {agree} of {all} are within {percent} % of the thesis's.")
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::thesis::tests::thesis;
    use super::*;

    /// Two scenes in two variants.
    pub(in super::super) fn draft(base: Base) -> Draft {
        let line = |scene: &str, variant: &str, time, rays| {
            (scene.into(), variant.into(), vec![time, rays])
        };
        Draft {
            number: Number::Four,
            quantities: vec![
                Quantity::instructions("time"),
                Quantity::rays("reflected rays", 0.05),
            ],
            base,
            lines: vec![
                line("figure-19", "opaque", 10.0, 0.0),
                line("figure-19", "reflective", 30.0, 1040.0),
                line("figure-20", "opaque", 20.0, 0.0),
                line("figure-20", "reflective", 40.0, 1060.0),
            ],
            notes: vec!["A note.".into()],
        }
    }

    const LINES: &str = "\
IV,figure-19,opaque,time,Balance 8000,8,minutes,60
IV,figure-19,reflective,time,Balance 8000,20,minutes,60
IV,figure-20,reflective,time,Sun 3/110,1.5,ratio,
IV,figure-19,reflective,reflected rays,,1000,,61
IV,figure-20,reflective,reflected rays,,1000,,61
IV,figure-24,reflective,reflected rays,,1,,
V,figure-19,opaque,time,,1,,";

    #[test]
    fn ratios_are_computed_on_both_sides() {
        let table = draft(Base::OfScene).beside(&thesis(LINES).unwrap());
        let value = &table.lines[1].values[0];
        assert_eq!(value.ratio, Some(3.0));
        let [balance, sun] = &*value.thesis else {
            panic!("{:?}", value.thesis)
        };
        assert_eq!(balance.ratio, Some(2.5));
        assert_eq!(balance.ours_over_thesis, Some(1.2));
        assert_eq!((balance.value, balance.page), (Some(20.0), Some(60)));
        assert_eq!((sun.value, sun.ratio), (None, None));
        // A ratio that is given as such.
        let sun = &table.lines[3].values[0].thesis[1];
        let expected = (Some(1.5), Some(2.0 / 1.5));
        assert_eq!((sun.ratio, sun.ours_over_thesis), expected);
        // The first variant has no ratio, but its figure.
        let first = &table.lines[0].values[0];
        assert_eq!((first.ratio, first.thesis[0].ratio), (None, None));
        assert_eq!(first.thesis[0].value, Some(8.0));
    }

    #[test]
    fn what_has_the_same_unit_is_compared_directly() {
        let table = draft(Base::OfScene).beside(&thesis(LINES).unwrap());
        assert_eq!(
            table.lines[1].values[1].thesis[0].ours_over_thesis,
            Some(1.04)
        );
        let said = "reflected rays: 1 of 2 are within 5 % of the thesis's.";
        assert_eq!(table.notes, ["A note.", said]);
    }

    #[test]
    fn what_belongs_nowhere_is_not_lost() {
        let table = draft(Base::OfScene).beside(&thesis(LINES).unwrap());
        let also: Vec<String> = table.also.iter().map(Datum::to_string).collect();
        assert_eq!(also, ["figure-24, reflected rays, reflective: 1"]);
    }

    #[test]
    fn ratios_may_be_to_the_first_line_of_all() {
        let table = draft(Base::OfTable).beside(&Thesis::default());
        let ratios: Vec<_> = table
            .lines
            .iter()
            .map(|line| line.values[0].ratio)
            .collect();
        assert_eq!(ratios, [None, Some(3.0), Some(2.0), Some(4.0)]);
        assert!(table.also.is_empty() && table.lines[1].values[0].thesis.is_empty());
    }
}
