//! What makes a scene large.

use super::super::camera::starts;
use super::super::extent::{Extent, shape_box};
use octray_core::camera::View;
use octray_scenes::model::{Point, Scene};

/// Returns the name of the one object, light or viewpoint without which the scene would have less than half its size, if
/// there is one besides `object`, an index.
pub(super) fn culprit(
    scene: &Scene,
    rays: &View,
    extent: &Extent,
    object: usize,
) -> Option<String> {
    let objects = scene.objects.iter().enumerate().map(|(i, object)| {
        let name = format!("object {}", i + 1);
        (Part::Object(i), name, shape_box(scene, &object.shape))
    });
    let lights = (scene.lights.iter().enumerate()).filter(|(_, light)| !extent.is_far(light));
    let lights =
        lights.map(|(i, light)| (Part::Light, format!("light {}", i + 1), [light.position; 2]));
    let starts = starts(rays)
        .into_iter()
        .map(|p| (Part::Start, "the viewpoint".into(), [p; 2]));
    let parts: Vec<(Part, String, [Point; 2])> = objects.chain(lights).chain(starts).collect();
    let is_start = |part: &Part| *part == Part::Start;
    // Whoever it is, it alone reaches a side of the whole.
    let mut at_sides: Vec<usize> = (0..6)
        .filter_map(|side| {
            let reach = |[low, high]: &[Point; 2]| match side < 3 {
                true => -low[side],
                false => high[side - 3],
            };
            (0..parts.len()).max_by(|&a, &b| reach(&parts[a].2).total_cmp(&reach(&parts[b].2)))
        })
        .collect();
    at_sides.sort_unstable();
    at_sides.dedup();
    let size_without = |left_out: usize| {
        let others = parts.iter().enumerate().filter(|(i, (part, ..))| {
            *i != left_out && !(is_start(part) && is_start(&parts[left_out].0))
        });
        Extent::around(others.map(|(_, (_, _, bounds))| *bounds)).diagonal()
    };
    let least = at_sides
        .into_iter()
        .map(|i| (i, size_without(i)))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (part, name, _) = &parts[least.0];
    (least.1 < extent.diagonal() / 2.0 && *part != Part::Object(object)).then(|| name.clone())
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Object(usize),
    Light,
    Start,
}
