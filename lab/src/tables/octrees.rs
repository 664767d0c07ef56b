//! Table I: the plain octree against the modified one, and the ways to walk them.

use super::number::TableNumber;
use super::plane;
use super::runs::{Runs, TraceCounts};
use super::subject::{FIGURES, SceneVariant};
use super::table::{Base, Draft, DraftLine, Quantity};
use octray_core::accel::OctreeVariant;
use octray_prepare::{TreeKind, Walk};
use octray_render::error::Error;

/// The ways to walk an octree, in the order of the columns.
pub const WALKS: [Walk; 3] = [Walk::Ordered, Walk::Neighbour, Walk::Links];

const TREES: [(TreeKind, OctreeVariant); 2] = [
    (TreeKind::Plain, OctreeVariant::Plain),
    (TreeKind::Modified, OctreeVariant::Modified),
];

/// The columns: those of the thesis, and what each walk visits.
const COLUMNS: [Quantity; 6] = [
    compared("voxel tests"),
    compared("surface tests"),
    compared("nodes"),
    Quantity::count("node visits, ordered"),
    Quantity::count("neighbour"),
    Quantity::count("links"),
];

/// A count that is the thesis's for its three rays.
const fn compared(name: &'static str) -> Quantity {
    Quantity {
        ratio: true,
        ..Quantity::rays(name, 0.0)
    }
}

const MEASURED: [Quantity; 3] = [
    measured("ms, ordered"),
    measured("ms, neighbour"),
    measured("ms, links"),
];

const fn measured(name: &'static str) -> Quantity {
    Quantity {
        decimals: 1,
        ..Quantity::count(name)
    }
}

/// Makes table I.
///
/// # Errors
/// Those of [`Runs::count`].
pub fn one(runs: &Runs<'_>) -> Result<Draft, Error> {
    let mut lines = of_the_plane(runs)?;
    let in_plane = lines.len();
    for subject in FIGURES {
        for (tree, _) in TREES {
            let walked = |walk| {
                let variant = SceneVariant::of(subject);
                runs.count(SceneVariant {
                    tree,
                    walk,
                    ..variant
                })
            };
            let counts = [walked(WALKS[0])?, walked(WALKS[1])?, walked(WALKS[2])?];
            lines.push((
                subject.name.into(),
                tree.name().into(),
                values(runs, &counts),
            ));
        }
    }
    let figures = &lines[in_plane..];
    let fewer = |column: usize| {
        let pairs = figures.chunks(2);
        pairs
            .filter(|pair| pair[1].2[column] < pair[0].2[column])
            .count()
    };
    let notes = vec![
        format!(
            "The thesis claims that the modified octree takes fewer tests and less memory. Of the five figures it \
             crosses fewer voxels in {}, tests fewer surfaces in {} and has fewer nodes in {}.",
            fewer(0),
            fewer(1),
            fewer(2)
        ),
        "R1 to R3 are rays in a plane scene. Its nodes are those that the plane cuts, the maxima are one object in a \
         cell and two levels. The thesis's layout is not at hand: ours was searched for so that all counts are the \
         thesis's. The figures have the depth and the leaves that `octray render` gives them."
            .into(),
        "A voxel is a cell that a ray crosses on its way from cell to cell, as the thesis has it; surfaces are tested \
         in each."
            .into(),
        format!(
            "A node visit is a look at a cell, inner ones included. Over ordered, neighbour (each cell from the root) \
             takes {}, links (from face to face) {}.",
            times(figures, 4, 3),
            times(figures, 5, 3)
        ),
    ];
    let measured = if runs.time { &MEASURED[..] } else { &[] };
    Ok(Draft {
        number: TableNumber::One,
        quantities: COLUMNS.iter().chain(measured).copied().collect(),
        base: Base::OfScene,
        // The three rays are the same at every size.
        full_size: true,
        lines,
        notes,
    })
}

/// The lines of the three rays.
fn of_the_plane(runs: &Runs<'_>) -> Result<Vec<DraftLine>, Error> {
    let [plain, modified] = TREES.map(|(_, variant)| plane::rays(variant));
    let mut lines = Vec::new();
    for rays in plain?.into_iter().zip(modified?) {
        for ((tree, _), ray) in TREES.into_iter().zip([rays.0, rays.1]) {
            let counts = [ray.voxels, ray.tests, ray.nodes].into_iter();
            let mut values: Vec<f64> = counts.chain(ray.visits).map(|n| n as f64).collect();
            if runs.time {
                values.extend([f64::NAN; 3]);
            }
            lines.push((ray.name.into(), tree.name().into(), values));
        }
    }
    Ok(lines)
}

/// The values of a figure.
fn values(runs: &Runs<'_>, counts: &[TraceCounts; 3]) -> Vec<f64> {
    let by_cells = &counts[1];
    let own = [by_cells.voxels, by_cells.tests, by_cells.nodes].into_iter();
    let visits = counts.iter().map(|counts| counts.steps);
    let mut values: Vec<f64> = own.chain(visits).map(|n| n as f64).collect();
    if runs.time {
        values.extend(counts.iter().map(|counts| counts.seconds * 1e3));
    }
    values
}

/// The range of a column over another one.
fn times(lines: &[DraftLine], column: usize, over: usize) -> String {
    let shares = lines.iter().map(|line| line.2[column] / line.2[over]);
    let (least, most) = shares.fold((f64::INFINITY, 0.0), |(least, most), share| {
        (f64::min(least, share), f64::max(most, share))
    });
    format!("{least:.2} to {most:.2} times as many")
}
