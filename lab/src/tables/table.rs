//! A table of our results beside the thesis's.

use super::number::TableNumber;
use super::thesis::{Datum, Place, Thesis};
use serde::Serialize;

/// The content of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: &'static str,
    /// The name of the thesis's quantity, usually the same.
    pub thesis: &'static str,
    /// Our unit; empty for a count.
    pub unit: &'static str,
    /// The number of decimals to print.
    pub decimals: usize,
    /// Whether the ratio to the first variant is printed too.
    pub ratio: bool,
    /// What of it is compared with the thesis.
    pub compare: Compare,
}

/// What of our number is compared with the thesis's, and the relative difference within which they agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compare {
    /// Nothing.
    Nothing,
    /// The number itself: it has the same unit.
    Value(f64),
    /// Its ratio to that of the first variant.
    Ratio(f64),
}

impl Quantity {
    /// Returns a count that is not compared.
    pub const fn count(name: &'static str) -> Self {
        Self {
            name,
            thesis: name,
            unit: "",
            decimals: 0,
            ratio: false,
            compare: Compare::Nothing,
        }
    }

    /// Returns a time, by [`octray_render::cost`], whose ratios must agree within a share.
    pub const fn instructions(name: &'static str, within: f64) -> Self {
        Self {
            unit: "M instructions",
            decimals: 1,
            ratio: true,
            compare: Compare::Ratio(within),
            ..Self::count(name)
        }
    }

    /// Returns a count that must agree with the thesis's within a share.
    pub const fn rays(name: &'static str, within: f64) -> Self {
        Self {
            compare: Compare::Value(within),
            ..Self::count(name)
        }
    }
}

/// The line to which ratios refer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// The first one of the same scene.
    OfScene,
    /// The first one.
    OfTable,
}

/// Scene, variant, and a value per quantity.
pub type DraftLine = (String, String, Vec<f64>);

/// A table of our results, before the comparison.
#[derive(Clone, Debug)]
pub struct Draft {
    /// The number of the table.
    pub number: TableNumber,
    /// The contents of the columns after scene and variant.
    pub quantities: Vec<Quantity>,
    /// The line to which ratios refer.
    pub base: Base,
    /// Whether the pictures have the thesis's size. If not, its counts are printed, but ours are not compared.
    pub full_size: bool,
    /// Its lines.
    pub lines: Vec<DraftLine>,
    /// Remarks.
    pub notes: Vec<String>,
}

/// A table of our results beside the thesis's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// The number of the table.
    pub table: TableNumber,
    /// The title.
    pub title: &'static str,
    /// The heading of the variants.
    pub variants: &'static str,
    /// The contents of the columns.
    #[serde(skip)]
    pub quantities: Vec<Quantity>,
    /// Its lines.
    pub lines: Vec<TableLine>,
    /// The thesis's numbers of this table that belong to none of the lines.
    pub also: Vec<Datum>,
    /// Remarks.
    pub notes: Vec<String>,
}

/// A scene in a variant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableLine {
    /// The scene.
    pub scene: String,
    /// The variant.
    pub variant: String,
    /// A value per quantity.
    pub values: Vec<Value>,
}

/// Our value, beside the thesis's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// The name of the quantity.
    pub quantity: &'static str,
    /// Our unit.
    pub unit: &'static str,
    /// Our value.
    pub ours: f64,
    /// Its ratio to the first variant's; `None` for the first variant.
    pub ratio: Option<f64>,
    /// The thesis's values, one per machine in this column.
    pub thesis: Vec<Given>,
}

/// A value of the thesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Given {
    /// The machine; empty if it does not matter.
    pub machine: String,
    /// The number, if known.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// Its ratio to the first variant's, if known.
    pub ratio: Option<f64>,
    /// Ours over the thesis's, of what is compared.
    pub ours_over_thesis: Option<f64>,
    /// The page.
    pub page: Option<u32>,
}

impl Draft {
    /// Compares the draft with the thesis.
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
        let lines: Vec<TableLine> = (self.lines.iter())
            .map(|line| TableLine {
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

    /// Returns the place of a line's number in the thesis.
    fn place<'a>(&'a self, line: &'a DraftLine, i: usize) -> Place<'a> {
        Place {
            table: self.number,
            scene: &line.0,
            variant: &line.1,
            quantity: self.quantities[i].thesis,
        }
    }

    /// Returns whether a number of the thesis belongs to a line.
    fn has(&self, datum: &Datum) -> bool {
        let of_line = |line| (0..self.quantities.len()).any(|i| datum.is_at(self.place(line, i)));
        self.lines.iter().any(of_line)
    }

    /// Returns the line to which a ratio refers; `None` for that line itself.
    fn base(&self, line: &DraftLine, i: usize) -> Option<&DraftLine> {
        let found = (self.lines.iter())
            .find(|other| self.base == Base::OfTable || other.0 == line.0)
            .filter(|base| (&base.0, &base.1) != (&line.0, &line.1));
        found.filter(|_| self.quantities[i].ratio)
    }

    fn ratio(&self, line: &DraftLine, i: usize) -> Option<f64> {
        quotient(line.2[i], self.base(line, i)?.2[i])
    }

    /// Returns the thesis's value from a machine.
    fn given(&self, line: &DraftLine, i: usize, machine: &str, thesis: &Thesis) -> Given {
        let place = self.place(line, i);
        let (value, stated_ratio) = (thesis.value(place, machine), thesis.ratio(place, machine));
        let computed = || {
            let base = self.place(self.base(line, i)?, i);
            quotient(value?.value, thesis.value(base, machine)?.value)
        };
        let ratio = stated_ratio.map(|datum| datum.value).or_else(computed);
        Given {
            machine: machine.into(),
            value: value.map(|datum| datum.value),
            unit: value.map_or(String::new(), |datum| datum.unit.clone()),
            ratio,
            ours_over_thesis: match self.quantities[i].compare {
                Compare::Value(_) if self.full_size => value.and_then(|datum| {
                    // None of either is agreement.
                    let none = datum.value == 0.0 && line.2[i] == 0.0;
                    quotient(line.2[i], datum.value).or(none.then_some(1.0))
                }),
                Compare::Ratio(_) => quotient(
                    self.ratio(line, i).unwrap_or(f64::NAN),
                    ratio.unwrap_or(f64::NAN),
                ),
                _ => None,
            },
            page: value.or(stated_ratio).and_then(|datum| datum.page),
        }
    }
}

/// Returns a quotient if it is a number.
fn quotient(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|quotient| quotient.is_finite())
}

/// Returns the machines for which the thesis has a quantity.
fn machines<'a>(placed: &[&'a Datum], quantity: &Quantity) -> Vec<&'a str> {
    let mut machines: Vec<&str> = Vec::new();
    for datum in placed {
        if datum.quantity == quantity.thesis && !machines.contains(&&*datum.machine) {
            machines.push(&datum.machine);
        }
    }
    machines
}

/// States how many numbers agree, and names the others; `None` if none is compared.
fn agreement(lines: &[TableLine], column: usize, quantity: &Quantity) -> Option<String> {
    let (what, within) = match quantity.compare {
        Compare::Nothing => return None,
        Compare::Value(within) => ("", within),
        Compare::Ratio(within) => ("ratios ", within),
    };
    let mut compared = 0;
    let mut others = Vec::new();
    for line in lines {
        for given in &line.values[column].thesis {
            let Some(share) = given.ours_over_thesis else {
                continue;
            };
            compared += 1;
            if (share - 1.0).abs() > within {
                let machine = match &*given.machine {
                    "" => String::new(),
                    machine => format!(", {machine}"),
                };
                let TableLine { scene, variant, .. } = line;
                others.push(format!("{scene}, {variant}{machine}: {share:.2}"));
            }
        }
    }
    let (name, percent) = (quantity.name, within * 100.0);
    let agree = compared - others.len();
    let rest = match &*others {
        [] => String::from("."),
        others => format!("; ours / thesis of the others: {}.", others.join("; ")),
    };
    (compared > 0).then(|| {
        format!("{name}: {agree} of {compared} {what}are within {percent} % of the thesis's{rest}")
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
            number: TableNumber::Four,
            quantities: vec![
                Quantity::instructions("time", 0.1),
                Quantity::rays("reflected rays", 0.05),
            ],
            base,
            full_size: true,
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
        // A value that the thesis states as a ratio.
        let sun = &table.lines[3].values[0].thesis[1];
        let expected = (Some(1.5), Some(2.0 / 1.5));
        assert_eq!((sun.ratio, sun.ours_over_thesis), expected);
        // The first variant has no ratio, but the thesis's number.
        let first = &table.lines[0].values[0];
        assert_eq!((first.ratio, first.thesis[0].ratio), (None, None));
        assert_eq!(first.thesis[0].value, Some(8.0));
    }

    #[test]
    fn values_of_the_same_unit_are_compared_directly() {
        let table = draft(Base::OfScene).beside(&thesis(LINES).unwrap());
        assert_eq!(
            table.lines[1].values[1].thesis[0].ours_over_thesis,
            Some(1.04)
        );
        let said = [
            "A note.",
            "time: 0 of 2 ratios are within 10 % of the thesis's; ours / thesis of the others: figure-19, \
             reflective, Balance 8000: 1.20; figure-20, reflective, Sun 3/110: 1.33.",
            "reflected rays: 1 of 2 are within 5 % of the thesis's; ours / thesis of the others: figure-20, \
             reflective: 1.06.",
        ];
        assert_eq!(table.notes, said);
    }

    #[test]
    fn counts_of_other_sizes_are_not_compared() {
        let small = Draft {
            full_size: false,
            ..draft(Base::OfScene)
        };
        let table = small.beside(&thesis(LINES).unwrap());
        let rays = &table.lines[1].values[1].thesis[0];
        assert_eq!((rays.value, rays.ours_over_thesis), (Some(1000.0), None));
        assert_eq!(
            table.lines[1].values[0].thesis[0].ours_over_thesis,
            Some(1.2)
        );
    }

    #[test]
    fn none_of_both_agrees() {
        let lines = "IV,figure-19,opaque,reflected rays,,0,,";
        let table = draft(Base::OfScene).beside(&thesis(lines).unwrap());
        let none = &table.lines[0].values[1].thesis[0];
        assert_eq!(none.ours_over_thesis, Some(1.0));
    }

    #[test]
    fn numbers_that_belong_to_no_line_are_kept() {
        let table = draft(Base::OfScene).beside(&thesis(LINES).unwrap());
        let also: Vec<String> = table.also.iter().map(Datum::to_string).collect();
        assert_eq!(also, ["figure-24, reflected rays, reflective: 1"]);
    }

    #[test]
    fn ratios_may_refer_to_the_first_line_of_the_table() {
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
