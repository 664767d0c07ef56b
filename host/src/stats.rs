//! Statistics of a rendering: the object that `--stats json` prints.

use octray_core::observe::Counters;
use octray_prepare::format::{Arith, Format};
use octray_render::counts::SceneCounts;
use octray_render::renderer::TreeStats;
use octray_render::stats::{Rays, Work};
use serde::{Serialize, Serializer};

/// The statistics of one rendering. The JSON object has the serialised fields, in this order; the summary prints the
/// others.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// The scene file as it was named.
    pub scene: String,
    /// The scene's contents.
    #[serde(skip)]
    pub facts: SceneCounts,
    /// The picture file as it was named.
    #[serde(skip)]
    pub picture: String,
    /// The arithmetic that was asked for.
    pub arith: Arith,
    /// The number format that was used.
    pub format: Format,
    /// The power of two by which the scene was scaled to fit the format.
    #[serde(skip)]
    pub scale: i32,
    /// What is too fine for the format, if anything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub too_fine: Option<String>,
    /// Lights that shine: fewer than the file's if some were left out.
    pub lights: usize,
    /// Whether surfaces were kept from reflecting and refracting.
    pub opaque: bool,
    /// Columns and rows of the picture.
    pub size: (u32, u32),
    /// Rays by kind.
    pub rays: Rays,
    /// Visited nodes, or cells of an octree.
    pub steps: u64,
    /// Cells of an octree crossed, if it was walked from cell to cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voxels: Option<u64>,
    /// Tests of a ray against an object.
    pub tests: u64,
    /// Primary rays that hit an object.
    pub hits: u64,
    /// Fixed-point results that were clamped to the format's range.
    pub saturations: u64,
    /// Rays and nodes that exceeded a capacity.
    pub dropped: Dropped,
    /// The tree.
    pub tree: TreeStats,
    /// Time per stage.
    pub seconds: Seconds,
    /// How the work was shared.
    #[serde(flatten)]
    pub work: Work,
    /// [`octray_render::picture::Picture::hash`] of the picture; 16 hexadecimal digits in JSON.
    #[serde(serialize_with = "hexadecimal")]
    pub hash: u64,
}

/// Rays and nodes that exceeded a capacity. Every number is 0 unless octray has a bug, because its capacities suffice for
/// any scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Dropped {
    /// Reflected and transmitted rays that were not traced.
    pub rays: u64,
    /// Nodes of the tree that were not visited.
    pub nodes: u64,
    /// Shadow rays to lights beyond the shadow cache; the picture is the same, only slower.
    pub uncached: u64,
}

impl Dropped {
    /// Those that were counted.
    pub fn of(counters: &Counters) -> Self {
        Self {
            rays: counters.dropped.rays,
            nodes: counters.dropped.children,
            uncached: counters.dropped.uncached,
        }
    }
}

/// Wall-clock time of each stage, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Reading the scene.
    pub parse: f64,
    /// Converting it and building the tree.
    pub build: f64,
    /// Tracing.
    pub render: f64,
}

fn hexadecimal<S: Serializer>(hash: &u64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{hash:016x}"))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use octray_prepare::TreeKind;
    use octray_render::schedule::Schedule;
    use octray_render::scheduler::Policy;

    /// Statistics in which all numbers are different.
    pub(crate) fn example() -> Stats {
        Stats {
            scene: "scenes/figure-19.scene".into(),
            facts: SceneCounts {
                spheres: 62,
                polygons: 1,
                surfaces: 3,
                lights: 2,
                ..SceneCounts::default()
            },
            picture: "figure-19.png".into(),
            arith: Arith::Auto,
            format: Format::I12F20,
            scale: -3,
            too_fine: None,
            lights: 2,
            opaque: false,
            size: (512, 256),
            rays: Rays {
                primary: 131_072,
                shadow: 200_000,
                blocked: 34_567,
                reflected: 50_001,
                transmitted: 0,
            },
            steps: 1_234_567,
            voxels: None,
            tests: 765_432,
            hits: 180_000,
            saturations: 5,
            dropped: Dropped {
                rays: 2,
                nodes: 3,
                uncached: 4,
            },
            tree: TreeStats {
                kind: TreeKind::Bvh8,
                nodes: 11,
                links: 63,
                depth: 4,
                unsplit: 0,
            },
            seconds: Seconds {
                parse: 0.000_75,
                build: 0.0025,
                render: 0.25,
            },
            work: Work {
                threads: 2,
                schedule: Policy::Dynamic,
                tile: Schedule::TILE,
                tiles: 64,
                messages: None,
                idle: vec![0.0005, 0.0],
            },
            hash: 0x0012_3456_789a_bcde,
        }
    }

    #[test]
    fn the_json_object_has_the_documented_fields_in_order() {
        let text = serde_json::to_string(&example()).unwrap();
        let expected = concat!(
            r#"{"scene":"scenes/figure-19.scene","arith":"auto","format":"i12f20","lights":2,"opaque":false,"size":[512,256],"#,
            r#""rays":{"primary":131072,"shadow":200000,"blocked":34567,"reflected":50001,"transmitted":0},"#,
            r#""steps":1234567,"tests":765432,"hits":180000,"saturations":5,"dropped":{"rays":2,"nodes":3,"uncached":4},"#,
            r#""tree":{"kind":"bvh8","nodes":11,"links":63,"depth":4,"unsplit":0},"#,
            r#""seconds":{"parse":0.00075,"build":0.0025,"render":0.25},"#,
            r#""threads":2,"schedule":"dynamic","tile":{"rows":16,"columns":16},"tiles":64,"#,
            r#""messages":null,"#,
            r#""idle":[0.0005,0.0],"hash":"00123456789abcde"}"#,
        );
        assert_eq!(text, expected);
    }
}
