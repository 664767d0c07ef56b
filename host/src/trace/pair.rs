//! Two trees of one pixel beside each other, and where they part.

use super::node::{FOLLOWERS, Light, Node};
use serde::Serialize;

/// A place where two trees differ.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Parting {
    /// The kinds of rays that lead there, the camera's first.
    pub(super) path: Vec<&'static str>,
    /// The light that only one of them sees, counted from 1; `None` if the rays themselves differ.
    pub(super) light: Option<usize>,
    /// What it is in each of them; `None` if there is nothing of the kind.
    pub(super) found: [Option<String>; 2],
}

/// The light of this number in both; `None` where the surface does not face it.
pub(super) type LightPair<'a> = (usize, [Option<&'a Light>; 2]);

/// All lights that either surface faces, by number.
pub(super) fn lights<'a>(pair: [Option<&'a Node>; 2]) -> Vec<LightPair<'a>> {
    let of = |node: Option<&'a Node>| node.map_or(&[][..], |node| &node.lights);
    let mut numbers: Vec<_> = (pair.iter())
        .flat_map(|node| of(*node).iter().map(|light| light.light))
        .collect();
    numbers.sort_unstable();
    numbers.dedup();
    let find = |node, number| of(node).iter().find(|light| light.light == number);
    let pairs = numbers.into_iter();
    pairs
        .map(|number| (number, pair.map(|node| find(node, number))))
        .collect()
}

/// The rays that follow in either tree, by kind.
pub(super) fn followers(pair: [Option<&Node>; 2]) -> Vec<[Option<&Node>; 2]> {
    let find = |kind| pair.map(|node| node.and_then(|node| node.follower(kind)));
    let pairs = FOLLOWERS.map(find).into_iter();
    pairs.filter(|[a, b]| a.is_some() || b.is_some()).collect()
}

/// Whether two rays meet different objects, or only one of them is there.
pub(super) fn rays_differ([a, b]: [Option<&Node>; 2]) -> bool {
    a.map(|node| node.object) != b.map(|node| node.object)
}

/// Whether a light shines on only one of two surfaces. Which of several objects hides it does not matter: it is the one
/// that was found first.
pub(super) fn lights_differ(pair: [Option<&Light>; 2]) -> bool {
    let shines = |light: &Light| light.blocked_by.is_none();
    pair[0].is_some_and(shines) != pair[1].is_some_and(shines)
}

/// Where two trees part, the camera's rays first. What follows from a ray that meets something else is not compared.
pub(super) fn differences(a: &[Node], b: &[Node]) -> Vec<Parting> {
    let mut partings = Vec::new();
    for i in 0..a.len().max(b.len()) {
        compare([a.get(i), b.get(i)], &mut Vec::new(), &mut partings);
    }
    partings
}

fn compare(pair: [Option<&Node>; 2], path: &mut Vec<&'static str>, partings: &mut Vec<Parting>) {
    let Some(ray) = pair[0].or(pair[1]) else {
        return;
    };
    path.push(ray.kind);
    if rays_differ(pair) {
        partings.push(Parting {
            path: path.clone(),
            light: None,
            found: pair.map(|node| node.map(Node::meets)),
        });
    } else {
        for (number, pair) in lights(pair) {
            if lights_differ(pair) {
                partings.push(Parting {
                    path: path.clone(),
                    light: Some(number),
                    found: pair.map(|light| light.map(Light::state)),
                });
            }
        }
        for pair in followers(pair) {
            compare(pair, path, partings);
        }
    }
    path.pop();
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::node::{Cost, Names};
    use super::*;

    const COST: Cost = Cost { nodes: 1, tests: 2 };

    /// A ray that meets an object of this number and sees the first light if nothing of another number is in the way.
    pub(crate) fn node(kind: &'static str, object: u32, blocker: Option<u32>) -> Node {
        let source = "v 0 0 9 f 1 1 1 1 0 0 0 0\ns 0 0 0 1\ns 0 0 0 2\nbox 0 0 0 1 1 1";
        let scene = octray_scenes::parse(source).unwrap();
        let names = Names::new(&scene, &octray_scenes::object_lines(source));
        let mut node = Node {
            kind,
            weight: 0.5,
            object: None,
            distance: None,
            light: [0.1, 0.2, 0.3],
            cost: COST,
            lights: Vec::new(),
            rays: Vec::new(),
            not_traced: Vec::new(),
        };
        if object > 0 {
            node.object = Some(names.object(object - 1));
            node.distance = Some(2.5);
            node.lights.push(Light {
                light: 1,
                blocked_by: blocker.map(|number| names.object(number - 1)),
                cost: COST,
            });
        }
        node
    }

    #[test]
    fn equal_trees_do_not_part() {
        let mut tree = node("primary", 1, Some(2));
        tree.rays.push(node("reflected", 3, None));
        assert_eq!(differences(&[tree.clone()], &[tree]), []);
    }

    #[test]
    fn trees_part_where_objects_differ_and_where_a_light_shines_on_one() {
        let mut a = node("primary", 1, Some(2));
        let mut b = node("primary", 1, None);
        a.rays.push(node("transmitted", 2, None));
        b.rays.push(node("transmitted", 3, None));
        b.rays.push(node("reflected", 0, None));
        let partings = differences(&[a], &[b]);
        let told: Vec<_> = partings
            .iter()
            .map(|parting| (parting.path.join(" "), parting.light))
            .collect();
        let expected = [
            ("primary".into(), Some(1)),
            ("primary transmitted".into(), None),
            ("primary reflected".into(), None),
        ];
        assert_eq!(told, expected);
        assert_eq!(
            partings[1].found,
            [
                Some("sphere 2, line 3".into()),
                Some("box 3, line 4".into())
            ]
        );
        assert_eq!(partings[2].found, [None, Some("background".into())]);
    }

    #[test]
    fn another_blocker_of_the_same_light_is_no_parting() {
        let (a, b) = (node("primary", 1, Some(2)), node("primary", 1, Some(3)));
        assert_eq!(differences(&[a], &[b]), []);
    }
}
