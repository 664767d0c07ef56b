//! Random scene files with all that the model has: every shape, both dialects, every camera.

use fastrand::Rng;
use octray_scenes::point::{add, cross, dot, times};
use std::f64::consts::TAU;
use std::fmt::Write;

type Point = [f64; 3];

/// A scene of some objects for rays to be shot at; what it looks like does not matter. By turns it
/// holds coincident objects, tiny and huge ones, tiles that share edges, boxes on planes and shells
/// around each other.
pub fn objects(seed: u64) -> String {
    let mut strew = Strew::new(seed);
    strew.line("v 0 0 3 at 0 0 0 up 0 1 0 angle 40 l 2 3 4 1");
    strew.line("f 0.1 0.1 0.1 0.5 0.5 0.5 0.3 0.3 0.3 20 0.3 0.4 1.5");
    let count = match seed % 10 {
        0 => 1 + strew.rng.usize(..4),
        9 => 150,
        _ => 8 + strew.rng.usize(..40),
    };
    let size = if count > 100 { 0.15 } else { 0.5 };
    for i in 0..count {
        let size = match (seed % 7, i % 4) {
            (3, 0) => size * 1e-4,
            (3, 1) => size * 8.0,
            (4, _) => size * 10f64.powf(-4.0 * strew.rng.f64()),
            _ => size * strew.between(0.2, 1.0),
        };
        let centre = strew.inside(1.0);
        let before = strew.text.len();
        strew.shape(i + seed as usize, centre, size);
        if seed % 5 == 1 && strew.rng.bool() {
            let again = strew.text[before..].to_owned();
            strew.text += &again;
        }
    }
    match seed % 6 {
        0 => strew.tiles(5),
        1 => strew.boxes_at_the_ground(0.0),
        2 => strew.blocks(3),
        3 => strew.shells(),
        4 => strew.needles(),
        _ => {}
    }
    strew.text
}

/// A scene to be looked at, in either dialect, with any camera and some of everything.
pub fn picture(seed: u64) -> String {
    let mut strew = Strew::new(seed);
    let ground = strew.rng.u8(..5) > 0;
    match seed % 4 {
        0 | 1 => strew.thesis_camera(),
        2 => strew.aimed_camera(),
        _ => strew.nff_camera(),
    }
    if strew.rng.bool() {
        let [r, g, b] = strew.colour();
        strew.line(&format!("b {r} {g} {b}{}", strew.zenith(seed)));
    }
    strew.lights(seed % 4 == 3);
    if ground {
        strew.surface(seed % 4 == 3);
        strew.ground();
    }
    let count = 3 + strew.rng.usize(..14);
    for i in 0..count {
        strew.surface(seed % 4 == 3);
        let size = strew.between(0.25, 0.7);
        let centre = strew.inside(0.9);
        if strew.rng.u8(..8) == 0 && ground {
            strew.boxes_at_the_ground(1e-3);
        } else {
            strew.shape(i + seed as usize, centre, size);
        }
    }
    strew.text
}

/// The ground's height, in the unit cube that things are strewn in.
const GROUND: f64 = -1.0;

struct Strew {
    rng: Rng,
    text: String,
    /// Where the unit cube lies in the scene: its middle, and how large it is.
    middle: Point,
    scale: f64,
}

impl Strew {
    fn new(seed: u64) -> Self {
        Self {
            rng: Rng::with_seed(seed),
            text: String::new(),
            middle: [0.0; 3],
            scale: 1.0,
        }
    }

    fn line(&mut self, line: &str) {
        self.text += line;
        self.text += "\n";
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.rng.f64()
    }

    fn inside(&mut self, half: f64) -> Point {
        [(); 3].map(|()| self.between(-half, half))
    }

    fn direction(&mut self) -> Point {
        loop {
            let p = self.inside(1.0);
            let square = dot(p, p);
            if 0.01 < square && square < 1.0 {
                return times(p, 1.0 / square.sqrt());
            }
        }
    }

    /// Two unit vectors across a random direction and each other; sometimes along axes.
    fn plane(&mut self) -> [Point; 2] {
        match self.rng.u8(..8) {
            0 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            1 => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            2 => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            _ => {
                let u = self.direction();
                let v = cross(u, self.direction());
                let length = dot(v, v).sqrt();
                if length < 0.1 {
                    return self.plane();
                }
                [u, times(v, 1.0 / length)]
            }
        }
    }

    fn colour(&mut self) -> Point {
        [(); 3].map(|()| self.rng.f64())
    }

    fn place(&self, p: Point) -> String {
        let p = add(self.middle, times(p, self.scale));
        format!("{} {} {}", p[0], p[1], p[2])
    }

    /// Shape number `which` of all, `size` being about its radius.
    fn shape(&mut self, which: usize, centre: Point, size: f64) {
        match which % 10 {
            0 | 1 => self.sphere(centre, size * 0.6),
            2 => self.cuboid(centre, size),
            3 => {
                let top = self.rng.f64() * size * 0.5;
                self.cone(centre, size, top);
            }
            4 => self.cone(centre, size, 0.0),
            5 => self.cylinder(centre, size),
            6 => self.ring_polygon(centre, size, 3, false),
            7 => {
                let corners = 4 + self.rng.usize(..5);
                let crossing = self.rng.u8(..4) == 0;
                self.ring_polygon(centre, size, corners, crossing);
            }
            8 => self.star(centre, size),
            _ => self.patch(centre, size),
        }
    }

    fn sphere(&mut self, centre: Point, radius: f64) {
        let line = format!("s {} {}", self.place(centre), radius * self.scale);
        self.line(&line);
    }

    fn cuboid(&mut self, centre: Point, size: f64) {
        let [x, y, z] = [(); 3].map(|()| self.between(0.1, 1.2) * size * self.scale);
        let line = format!("box {} {x} {y} {z}", self.place(centre));
        self.line(&line);
    }

    fn cone(&mut self, centre: Point, size: f64, top_radius: f64) {
        let half = times(self.direction(), size * self.between(0.1, 0.7));
        let base_radius = size * self.between(0.1, 0.6);
        self.cone_between(
            (sub(centre, half), base_radius),
            (add(centre, half), top_radius),
        );
    }

    fn cylinder(&mut self, centre: Point, size: f64) {
        let axis = match self.rng.u8(..2) {
            0 => [0.0, 1.0, 0.0],
            _ => self.direction(),
        };
        let half = times(axis, size * 0.5);
        let radius = size * self.between(0.05, 0.4);
        self.cone_between((sub(centre, half), radius), (add(centre, half), radius));
    }

    fn cone_between(&mut self, base: (Point, f64), top: (Point, f64)) {
        let line = format!(
            "c {} {} {} {}",
            self.place(base.0),
            base.1 * self.scale,
            self.place(top.0),
            top.1 * self.scale
        );
        self.line(&line);
    }

    /// A polygon with corners on a circle; a crossing one joins every second of an odd number.
    fn ring_polygon(&mut self, centre: Point, size: f64, corners: usize, crossing: bool) {
        let (corners, step) = match crossing {
            true => (corners | 1, 2),
            false => (corners, 1),
        };
        let [u, v] = self.plane();
        let start = self.rng.f64();
        let points: Vec<Point> = (0..corners)
            .map(|i| {
                let turn = start + (i * step % corners) as f64 / corners as f64;
                let (y, x) = (turn * TAU).sin_cos();
                add(centre, add(times(u, x * size), times(v, y * size)))
            })
            .collect();
        self.polygon(&points);
    }

    fn star(&mut self, centre: Point, size: f64) {
        let tips = 3 + self.rng.usize(..4);
        let [u, v] = self.plane();
        let points: Vec<Point> = (0..2 * tips)
            .map(|i| {
                let (y, x) = (i as f64 / (2 * tips) as f64 * TAU).sin_cos();
                let reach = if i % 2 == 0 { size } else { size * 0.35 };
                add(centre, add(times(u, x * reach), times(v, y * reach)))
            })
            .collect();
        self.polygon(&points);
    }

    fn polygon(&mut self, points: &[Point]) {
        let mut line = format!("p {}", points.len());
        for point in points {
            let _ = write!(line, "  {}", self.place(*point));
        }
        self.line(&line);
    }

    fn patch(&mut self, centre: Point, size: f64) {
        let corners = 3 + self.rng.usize(..3);
        let [u, v] = self.plane();
        let axis = cross(u, v);
        let mut line = format!("pp {corners}");
        for i in 0..corners {
            let (y, x) = (i as f64 / corners as f64 * TAU).sin_cos();
            let outward = add(times(u, x), times(v, y));
            let n = add(axis, times(outward, 0.5));
            let place = self.place(add(centre, times(outward, size)));
            let _ = write!(line, "  {place} {} {} {}", n[0], n[1], n[2]);
        }
        self.line(&line);
    }

    fn ground(&mut self) {
        let half = self.between(1.5, 6.0);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        self.polygon(&corners.map(|[x, z]| [x * half, GROUND, z * half]));
    }

    /// Boxes whose lower faces lie in the ground's plane, or a little above it: of two surfaces in
    /// the same place it is rounding that says which is seen first.
    fn boxes_at_the_ground(&mut self, above: f64) {
        for _ in 0..3 {
            let [x, _, z] = self.inside(0.8);
            let height = self.between(0.1, 0.6);
            let place = self.place([x, GROUND + above + height / 2.0, z]);
            let [side, height] = [0.3 * self.scale, height * self.scale];
            self.line(&format!("box {place} {side} {height} {side}"));
        }
    }

    /// Squares and triangles in one plane, side by side.
    fn tiles(&mut self, n: usize) {
        let width = 2.0 / n as f64;
        for i in 0..n * n {
            let (x, z) = (-1.0 + width * (i % n) as f64, -1.0 + width * (i / n) as f64);
            let (right, back) = (x + width, z + width);
            let corner = |x, z| [x, -0.5, z];
            if i % 2 == 0 {
                self.polygon(&[
                    corner(x, z),
                    corner(right, z),
                    corner(right, back),
                    corner(x, back),
                ]);
            } else {
                self.polygon(&[corner(x, z), corner(right, z), corner(right, back)]);
                self.polygon(&[corner(x, z), corner(right, back), corner(x, back)]);
            }
        }
    }

    /// Boxes that share faces.
    fn blocks(&mut self, n: usize) {
        let side = 1.0 / n as f64;
        for i in 0..n * n * n {
            let centre = [i % n, i / n % n, i / n / n].map(|k| -0.5 + side * (k as f64 + 0.5));
            let side = side * self.scale;
            let line = format!("box {} {side} {side} {side}", self.place(centre));
            self.line(&line);
        }
    }

    /// Spheres, boxes and cylinders around one centre.
    fn shells(&mut self) {
        for i in 1..6 {
            let size = 0.15 * f64::from(i);
            self.sphere([0.1, 0.0, -0.1], size);
            self.cuboid([0.1, 0.0, -0.1], size);
            self.cone_between(([0.1, -size, -0.1], size), ([0.1, size, -0.1], size));
        }
    }

    /// Long thin cones and slivers.
    fn needles(&mut self) {
        for _ in 0..8 {
            let (a, b) = (self.inside(1.0), self.inside(1.0));
            let radius = 10f64.powf(self.between(-5.0, -2.0));
            let top_radius = radius * self.rng.f64();
            self.cone_between((a, radius), (b, top_radius));
            let c = add(b, times(self.direction(), 1e-3));
            self.polygon(&[a, b, c]);
        }
    }

    /// The thesis's camera, off centre; one pixel is one unit.
    fn thesis_camera(&mut self) {
        let (width, height) = (
            self.between(60.0, 140.0).floor(),
            self.between(60.0, 140.0).floor(),
        );
        self.scale = height.min(width) * self.between(0.4, 0.8);
        let behind = self.rng.u8(..4) == 0;
        let side = if behind { -1.0 } else { 1.0 };
        let depth = -side * self.between(0.0, 1.5) * self.scale;
        self.middle = [0.1 * self.scale, 0.2 * self.scale, depth];
        let [x, y] = [(); 2].map(|()| self.between(-1.0, 1.0) * self.scale);
        let z = side * self.between(2.0, 5.0) * self.scale;
        self.line(&format!("v {x} {y} {z}"));
        if self.rng.u8(..3) == 0 {
            self.line("view parallel");
        }
        self.line(&format!("resolution {height} {width}"));
    }

    /// The thesis's dialect with our `at`, `up` and `angle`.
    fn aimed_camera(&mut self) {
        self.scale = 10f64.powf(self.between(-2.0, 3.0));
        self.middle = times(self.inside(5.0), self.scale);
        let (from, at, up, angle) = self.aim();
        self.line(&format!("v {from}\nat {at} up {up}\nangle {angle}"));
        if self.rng.u8(..3) == 0 {
            self.line("view parallel");
        }
        self.line("resolution 90 120 # height first");
    }

    fn nff_camera(&mut self) {
        self.scale = 10f64.powf(self.between(-2.0, 3.0));
        let (from, at, up, angle) = self.aim();
        self.line(&format!(
            "v\nfrom {from}\nat {at}\nup {up}\nangle {angle}\nhither 0.1\nresolution 110 80"
        ));
    }

    fn aim(&mut self) -> (String, String, String, f64) {
        let away = self.between(2.0, 6.0);
        let mut direction = self.direction();
        // From above the ground, and not from straight above.
        direction[1] = direction[1].abs().min(0.9);
        let at = self.inside(0.2);
        let from = add(at, times(direction, away));
        let up = match self.rng.bool() {
            true => [0.0, 1.0, 0.0],
            false => add([0.0, 1.0, 0.0], self.inside(0.3)),
        };
        let angle = self.between(20.0, 70.0);
        (
            self.place(from),
            self.place(at),
            format!("{} {} {}", up[0], up[1], up[2]),
            angle,
        )
    }

    fn lights(&mut self, nff: bool) {
        let count = self.rng.usize(..5);
        for _ in 0..count {
            let [x, y, z] = self.inside(4.0);
            let place = self.place([x, y.abs() + 0.5, z]);
            let [r, g, b] = self.colour();
            let line = match (self.rng.u8(..3), nff) {
                (0, _) => format!("l {place} {r} {g} {b}"),
                (_, true) => format!("l {place}"),
                (_, false) => format!("l {place} {r}"),
            };
            self.line(&line);
        }
    }

    /// The sky's other colour, in a third of the scenes.
    fn zenith(&self, seed: u64) -> String {
        let mut rng = Rng::with_seed(!seed);
        match rng.u8(..3) {
            0 => format!(" {} {} {}", rng.f64(), rng.f64(), rng.f64()),
            _ => String::new(),
        }
    }

    /// A checker of a surface, a fifth of the time; its cubes are no fraction of the scene.
    fn checker(&self, nff: bool) -> String {
        let mut rng = Rng::with_seed(self.text.len() as u64);
        if rng.u8(..5) > 0 {
            return String::new();
        }
        let size = self.scale * (0.07 + 0.5 * rng.f64());
        let colours = if nff { 3 } else { 6 };
        let colours: String = (0..colours)
            .map(|_| format!(" {}", 0.5 * rng.f64()))
            .collect();
        format!("\nchecker {size}{colours}")
    }

    fn surface(&mut self, nff: bool) {
        let [r, g, b] = self.colour();
        let shines = [0.0, 0.5, 1.0, 3.0827, 20.0, 87.3, 1000.0, 100_000.0];
        let shine = shines[self.rng.usize(..shines.len())];
        let (reflect, refract) = match self.rng.u8(..4) {
            0 => (0.0, 0.0),
            1 => (self.rng.f64(), 0.0),
            2 => (0.0, self.rng.f64()),
            _ => (0.5 * self.rng.f64(), 0.5 * self.rng.f64()),
        };
        let ior = match (refract > 0.0, self.rng.u8(..3)) {
            (false, _) => 0.0,
            (true, 0) => 1.0,
            (true, 1) => self.between(0.6, 1.0),
            (true, _) => self.between(1.0, 2.4),
        };
        let line = if nff {
            let diffuse = self.rng.f64();
            format!("f {r} {g} {b} {diffuse} {reflect} {shine} {refract} {ior}")
        } else {
            let [ar, ag, ab] = self.colour().map(|c| c * 0.3);
            let [sr, sg, sb] = self.colour();
            let end = if ior == 0.0 || ior == 1.0 {
                String::new()
            } else {
                format!(" {ior}")
            };
            format!("f {ar} {ag} {ab} {r} {g} {b} {sr} {sg} {sb} {shine} {reflect} {refract}{end}")
        };
        let line = line + &self.checker(nff);
        self.line(&line);
    }
}

fn sub(a: Point, b: Point) -> Point {
    add(a, times(b, -1.0))
}
