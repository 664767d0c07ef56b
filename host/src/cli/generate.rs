//! Arguments of `octray generate`.

use crate::generate::GenerateJob;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, value_parser};
use octray_scenes::generate::{SceneKind, Spec};
use std::path::PathBuf;

/// Arguments of `octray generate`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
The same kind, count and seed give the same scene on every machine.")]
pub struct GenerateArgs {
    /// What the scene shows
    #[arg(value_parser = kind())]
    kind: SceneKind,
    /// Number of objects, including the ground; terrains and trees may have a few fewer
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = value_parser!(u32).range(1..=MOST))]
    count: u32,
    /// Seed of the random numbers; another seed gives another scene of the same kind
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// The scene file [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The largest number of objects that fits comfortably into memory.
const MOST: i64 = 10_000_000;

impl GenerateArgs {
    /// Returns the job.
    pub fn job(self) -> GenerateJob {
        GenerateJob {
            spec: Spec {
                kind: self.kind,
                objects: self.count as usize,
            },
            seed: self.seed,
            output: self.output,
        }
    }
}

fn kind() -> impl TypedValueParser<Value = SceneKind> {
    let values = SceneKind::ALL.map(|kind| PossibleValue::new(kind.name()).help(description(kind)));
    PossibleValuesParser::new(values).try_map(|name| {
        let named = SceneKind::ALL.into_iter().find(|kind| kind.name() == name);
        named.ok_or("no such kind")
    })
}

fn description(kind: SceneKind) -> &'static str {
    match kind {
        SceneKind::Flake => "Spheres that carry smaller spheres, and so on",
        SceneKind::Lattice => "A cube of spheres joined by rods",
        SceneKind::Terrain => "Fractal mountains of triangles around a lake",
        SceneKind::Tree => "A tree of cones and spheres",
        SceneKind::Soup => "Shapes of all kinds placed at random",
    }
}
