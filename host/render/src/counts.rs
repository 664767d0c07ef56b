//! What is in a scene, counted.

use octray_scenes::model::{Scene, Shape};
use std::fmt;

/// How many there are of everything in a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneCounts {
    /// Spheres.
    pub spheres: usize,
    /// Cones and cylinders.
    pub cones: usize,
    /// Boxes.
    pub boxes: usize,
    /// Polygons.
    pub polygons: usize,
    /// Patches.
    pub patches: usize,
    /// Surface properties.
    pub surfaces: usize,
    /// Lights.
    pub lights: usize,
}

impl SceneCounts {
    /// Count what is in `scene`.
    pub fn of(scene: &Scene) -> Self {
        let mut facts = Self {
            surfaces: scene.surfaces.len(),
            lights: scene.lights.len(),
            ..Self::default()
        };
        for object in &scene.objects {
            *match object.shape {
                Shape::Sphere { .. } => &mut facts.spheres,
                Shape::Cone { .. } => &mut facts.cones,
                Shape::Cuboid { .. } => &mut facts.boxes,
                Shape::Polygon { .. } => &mut facts.polygons,
                Shape::Patch { .. } => &mut facts.patches,
            } += 1;
        }
        facts
    }
}

/// One line: objects by kind (or `no objects`), surfaces, lights.
impl fmt::Display for SceneCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let objects = [
            (self.spheres, "sphere", "spheres"),
            (self.cones, "cone", "cones"),
            (self.boxes, "box", "boxes"),
            (self.polygons, "polygon", "polygons"),
            (self.patches, "patch", "patches"),
        ];
        if objects.iter().all(|(count, ..)| *count == 0) {
            write!(f, "no objects, ")?;
        }
        for (count, one, many) in objects.into_iter().filter(|(count, ..)| *count > 0) {
            write!(f, "{}, ", counted(count, one, many))?;
        }
        write!(
            f,
            "{}, {}",
            counted(self.surfaces, "surface", "surfaces"),
            counted(self.lights, "light", "lights"),
        )
    }
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!(
        "{} {}",
        thousands(count as u64),
        if count == 1 { one } else { many }
    )
}

/// A number with a comma before every three digits.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_there_is_named_and_one_is_not_plural() {
        let facts = SceneCounts {
            spheres: 7382,
            polygons: 1,
            surfaces: 2,
            lights: 1,
            ..SceneCounts::default()
        };
        let text = "7,382 spheres, 1 polygon, 2 surfaces, 1 light";
        assert_eq!(facts.to_string(), text);
        let nothing = SceneCounts::default().to_string();
        assert_eq!(nothing, "no objects, 0 surfaces, 0 lights");
    }

    #[test]
    fn thousands_are_parted_from_the_right() {
        let cases = [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (123_456, "123,456"),
            (u64::MAX, "18,446,744,073,709,551,615"),
        ];
        for (number, text) in cases {
            assert_eq!(thousands(number), text);
        }
    }
}
