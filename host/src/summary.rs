//! The statistics of a rendering as a readable summary.

use crate::stats::Stats;
use octray_render::counts::thousands;
use octray_render::stats::Messages;
use octray_scenes::name;
use std::fmt;

/// Displays [`Stats`] as aligned lines, each with a line end.
pub struct Summary<'a>(pub &'a Stats);

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let stats = self.0;
        let (rays, seconds) = (&stats.rays, &stats.seconds);
        let scene = name::line(&stats.scene);
        let opaque = if stats.opaque { ", all opaque" } else { "" };
        line(f, "scene", &format!("{scene}: {}{opaque}", stats.facts))?;
        let (width, height) = stats.size;
        let picture = format!(
            "{}: {width} x {height} pixels, hash {:016x}",
            name::line(&stats.picture),
            stats.hash
        );
        line(f, "picture", &picture)?;
        line(f, "arithmetic", &arithmetic(stats))?;
        if let Some(too_fine) = &stats.too_fine {
            line(f, "too coarse", too_fine)?;
        }
        line(f, "tree", &tree(stats))?;
        count(f, "rays", rays.total(), "")?;
        count(f, "  primary", rays.primary, "")?;
        let blocked = format!("  {} of them blocked", thousands(rays.blocked));
        count(f, "  shadow", rays.shadow, &blocked)?;
        count(f, "  reflected", rays.reflected, "")?;
        count(f, "  transmitted", rays.transmitted, "")?;
        count(
            f,
            "node visits",
            stats.steps,
            &per_ray(stats.steps, rays.total()),
        )?;
        if let Some(voxels) = stats.voxels {
            count(f, "voxels", voxels, &per_ray(voxels, rays.total()))?;
        }
        count(
            f,
            "object tests",
            stats.tests,
            &per_ray(stats.tests, rays.total()),
        )?;
        count(f, "hits", stats.hits, "  of the primary rays")?;
        if stats.saturations > 0 {
            count(f, "saturations", stats.saturations, "")?;
        }
        let dropped = &stats.dropped;
        let capacities = [
            (
                "dropped rays",
                dropped.rays,
                "  by lack of capacity: the picture lacks their light",
            ),
            (
                "dropped nodes",
                dropped.nodes,
                "  by lack of capacity: the picture may lack objects",
            ),
            (
                "uncached",
                dropped.uncached,
                "  shadow rays to lights beyond the shadow cache: slower",
            ),
        ];
        for (name, number, what) in capacities.into_iter().filter(|(_, number, _)| *number > 0) {
            count(f, name, number, what)?;
        }
        let stages = [
            ("parse", seconds.parse),
            ("build", seconds.build),
            ("render", seconds.render),
        ];
        let stages = stages.map(|(stage, seconds)| format!("{stage} {}", duration(seconds)));
        line(f, "time", &stages.join(", "))?;
        line(f, "work", &work(stats))?;
        if let Some(sent) = &stats.work.messages {
            line(f, "messages", &messages(sent))?;
        }
        line(f, "idle", &idle(&stats.work.idle))?;
        Ok(())
    }
}

fn line(f: &mut fmt::Formatter<'_>, name: &str, text: &str) -> fmt::Result {
    writeln!(f, "{name:<14}{text}")
}

fn count(f: &mut fmt::Formatter<'_>, name: &str, number: u64, more: &str) -> fmt::Result {
    writeln!(f, "{name:<14}{:>15}{more}", thousands(number))
}

fn arithmetic(stats: &Stats) -> String {
    let name = stats.arith.with_format(Some(stats.format));
    let scale = match stats.scale {
        0 => String::new(),
        power => format!(", scene scaled by 2^{power}"),
    };
    format!("{name}{scale}")
}

fn tree(stats: &Stats) -> String {
    let tree = &stats.tree;
    let unsplit = match tree.unsplit {
        0 => String::new(),
        leaves => format!(
            ", arena full: {} leaves larger than asked for",
            thousands(leaves)
        ),
    };
    format!(
        "{}: {} nodes, {} links, depth {}{unsplit}",
        tree.kind.name(),
        thousands(tree.nodes),
        thousands(tree.links),
        tree.depth
    )
}

fn per_ray(number: u64, rays: u64) -> String {
    match rays {
        0 => String::new(),
        _ => format!("  {:.2} per ray", number as f64 / rays as f64),
    }
}

fn work(stats: &Stats) -> String {
    let speed = match stats.seconds.render {
        seconds if seconds > 0.0 && stats.rays.total() > 0 => {
            let speed = stats.rays.total() as f64 / seconds;
            format!("{} rays/s, ", thousands(speed.round() as u64))
        }
        _ => String::new(),
    };
    let work = &stats.work;
    let plural = |count| if count == 1 { "" } else { "s" };
    let one = work.messages.map_or("thread", |_| "rank");
    format!(
        "{speed}{} {one}{}, {} tile{} of {}, {} schedule",
        work.threads,
        plural(work.threads),
        thousands(work.tiles as u64),
        plural(work.tiles),
        work.tile,
        work.schedule.name()
    )
}

/// Describes the tiles that other ranks returned.
fn messages(sent: &Messages) -> String {
    let Messages {
        count,
        bytes,
        seconds,
        hand_out,
    } = *sent;
    format!(
        "other ranks returned {} tiles in {} bytes; each took the first rank {} or {} instructions",
        thousands(count),
        thousands(bytes),
        duration(seconds / count.max(1) as f64),
        thousands(hand_out.round() as u64)
    )
}

/// Describes how long the threads were idle.
fn idle(idle: &[f64]) -> String {
    let longest = idle.iter().copied().fold(0.0, f64::max);
    let shortest = idle.iter().copied().fold(longest, f64::min);
    match idle.len() {
        1..=8 => idle
            .iter()
            .map(|s| duration(*s))
            .collect::<Vec<_>>()
            .join(", "),
        _ => format!("{} to {} per thread", duration(shortest), duration(longest)),
    }
}

/// Formats seconds with three digits and a suitable unit.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.000_999_5 => format!("{:.0} us", s * 1e6),
        s if s < 0.099_95 => format!("{:.1} ms", s * 1e3),
        s if s < 0.999_5 => format!("{:.0} ms", s * 1e3),
        s if s < 99.95 => format!("{s:.2} s"),
        s => format!("{s:.0} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::tests::example;
    use snapbox::{assert_data_eq, str};

    #[test]
    fn the_summary_has_the_documented_form() {
        assert_data_eq!(
            Summary(&example()).to_string(),
            str![[r#"
scene         scenes/figure-19.scene: 62 spheres, 1 polygon, 3 surfaces, 2 lights
picture       figure-19.png: 512 x 256 pixels, hash 00123456789abcde
arithmetic    auto: i12f20, scene scaled by 2^-3
tree          bvh8: 11 nodes, 63 links, depth 4
rays                  381,073
  primary             131,072
  shadow              200,000  34,567 of them blocked
  reflected            50,001
  transmitted               0
node visits         1,234,567  3.24 per ray
object tests          765,432  2.01 per ray
hits                  180,000  of the primary rays
saturations                 5
dropped rays                2  by lack of capacity: the picture lacks their light
dropped nodes               3  by lack of capacity: the picture may lack objects
uncached                    4  shadow rays to lights beyond the shadow cache: slower
time          parse 750 us, build 2.5 ms, render 250 ms
work          1,524,292 rays/s, 2 threads, 64 tiles of 16 x 16 pixels, dynamic schedule
idle          500 us, 0 us

"#]]
        );
    }

    #[test]
    fn a_full_arena_is_reported_and_plain_arithmetic_named_once() {
        let mut stats = example();
        (stats.arith, stats.format, stats.scale) =
            (octray_prepare::Arith::F32, octray_prepare::Format::F32, 0);
        (stats.tree.unsplit, stats.seconds.render) = (7, 0.0);
        stats.too_fine = Some("f32 resolves little".into());
        let text = Summary(&stats).to_string();
        assert!(text.contains("arithmetic    f32\n"), "{text}");
        assert!(text.contains("depth 4, arena full: 7 leaves"), "{text}");
        assert!(!text.contains("rays/s"), "{text}");
        assert!(
            text.contains("\ntoo coarse    f32 resolves little\n"),
            "{text}"
        );
    }

    #[test]
    fn voxels_are_told_where_rays_go_from_cell_to_cell() {
        let mut stats = example();
        stats.voxels = Some(762_146);
        let text = Summary(&stats).to_string();
        assert!(
            text.contains("\nvoxels                762,146  2.00 per ray\n"),
            "{text}"
        );
    }

    #[test]
    fn messages_between_ranks_are_reported() {
        let mut stats = example();
        stats.work.messages = Some(Messages {
            count: 1000,
            bytes: 772_000,
            seconds: 0.004,
            hand_out: 34_567.8,
        });
        let text = Summary(&stats).to_string();
        assert!(text.contains("2 ranks, 64 tiles"), "{text}");
        let expected = "messages      other ranks returned 1,000 tiles in 772,000 bytes; \
            each took the first rank 4 us or 34,568 instructions";
        assert!(text.contains(expected), "{text}");
    }

    #[test]
    fn the_idle_time_of_many_threads_is_a_range() {
        let times: Vec<_> = (1..=9).map(|i| f64::from(i) * 1e-3).collect();
        assert_eq!(idle(&times), "1.0 ms to 9.0 ms per thread");
        assert_eq!(idle(&times[..2]), "1.0 ms, 2.0 ms");
    }

    #[test]
    fn durations_have_a_suitable_unit() {
        let cases = [
            (0.000_001, "1 us"),
            (0.000_999_6, "1.0 ms"),
            (0.0123, "12.3 ms"),
            (0.25, "250 ms"),
            (0.9996, "1.00 s"),
            (12.3456, "12.35 s"),
            (1234.5, "1234 s"),
        ];
        for (seconds, text) in cases {
            assert_eq!(duration(seconds), text);
        }
    }
}
