//! A shape in front of a wall: turned anyhow, of any size, anywhere.

use fastrand::Rng;

/// The shapes that are looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    Ball,
    /// A cylinder as long as wide.
    Tin,
    /// A long cylinder.
    Tube,
    /// A truncated cone.
    Lampshade,
    /// A cone with a tip.
    Hat,
    /// A cone much wider than high.
    Dish,
    Cuboid,
    Triangle,
    Hexagon,
}

/// All of them.
pub(crate) const SHAPES: [Kind; 9] = [
    Kind::Ball,
    Kind::Tin,
    Kind::Tube,
    Kind::Lampshade,
    Kind::Hat,
    Kind::Dish,
    Kind::Cuboid,
    Kind::Triangle,
    Kind::Hexagon,
];

/// Where a light is held.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Held {
    Wall,
    SlantedTriangle,
    Ball,
    BetweenBallAndWall,
    Cylinder,
    Cone,
    Tip,
    FaceOfBox,
    EdgeOfBox,
}

impl Held {
    /// All places.
    pub(crate) const ALL: [Self; 9] = [
        Self::Wall,
        Self::SlantedTriangle,
        Self::Ball,
        Self::BetweenBallAndWall,
        Self::Cylinder,
        Self::Cone,
        Self::Tip,
        Self::FaceOfBox,
        Self::EdgeOfBox,
    ];

    /// The point that holds the light, the normal there, and the shape.
    fn place(self, room: &Room) -> ([f64; 3], [f64; 3], String) {
        match self {
            Self::Wall => ([1.3, -1.5, 1.1], [0.0, 1.0, 0.0], String::new()),
            Self::SlantedTriangle => (
                [1.0, 0.5, 1.0],
                [0.0, -0.8, 0.6],
                room.polygon(&[[0.2, 0.2, 0.6], [1.8, 0.2, 0.6], [1.0, 1.1, 1.8]]),
            ),
            Self::Ball => (
                [0.6, 0.64, 0.48],
                [0.6, 0.64, 0.48],
                room.sphere([0.0; 3], 1.0),
            ),
            Self::BetweenBallAndWall => (
                [0.7, -1.5, 0.9],
                [0.0, -1.0, 0.0],
                room.sphere([0.7, -0.9, 0.9], 0.6),
            ),
            Self::Cylinder => (
                [1.3, 0.1, 1.4],
                [0.6, 0.0, 0.8],
                room.cone([1.0, -0.5, 1.0], 0.5, [1.0, 1.0, 1.0], 0.5),
            ),
            Self::Cone => (
                [1.36, 0.0, 1.48],
                [0.6, 0.5, 0.8],
                room.cone([1.0, -0.8, 1.0], 1.0, [1.0, 0.8, 1.0], 0.2),
            ),
            Self::Tip => (
                [1.0, 0.4, 1.0],
                [1.0, 0.0, 0.3],
                room.cone([1.0, 1.2, 1.0], 0.5, [1.0, 0.4, 1.0], 0.0),
            ),
            Self::FaceOfBox => (
                [1.1, 0.3, 0.6],
                [0.0, -1.0, 0.0],
                room.cuboid([1.0, 0.5, 0.5], [1.0, 0.4, 1.0]),
            ),
            Self::EdgeOfBox => (
                [1.5, 0.3, 0.6],
                [1.0, -1.0, 0.0],
                room.cuboid([1.0, 0.5, 0.5], [1.0, 0.4, 1.0]),
            ),
        }
    }
}

/// A place for scenes: its axes, its size and its middle. Boxes lie along the axes, so every third place does.
pub(crate) struct Room {
    axes: [[f64; 3]; 3],
    size: f64,
    middle: [f64; 3],
    seed: u64,
}

const MATTE: &str = "f 0.1 0.1 0.1  0.7 0.6 0.5  0 0 0  1 0 0\n";
const MIRROR: &str = "f 0.05 0.05 0.05  0.3 0.3 0.3  0.3 0.3 0.3  20 0.6 0\n";
const GLASS: &str = "f 0.02 0.02 0.02  0.1 0.1 0.1  0.3 0.3 0.3  20 0.1 0.8 1.5\n";

impl Room {
    pub(crate) fn new(seed: u64) -> Self {
        let mut rng = Rng::with_seed(seed);
        let mut number = |low: f64, high: f64| low + (high - low) * rng.f64();
        let [w, x, y, z] = loop {
            let q = [(); 4].map(|()| number(-1.0, 1.0));
            let square: f64 = q.iter().map(|c| c * c).sum();
            if (0.1..1.0).contains(&square) {
                break q.map(|c| c / square.sqrt());
            }
        };
        let turned = [
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ];
        let size = 10f64.powf(number(-4.0, 5.0));
        let away = if seed % 4 == 1 { 30.0 } else { 1.0 };
        let middle = [(); 3].map(|()| number(-1.0, 1.0) * away * size);
        let straight = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self {
            axes: if seed.is_multiple_of(3) {
                straight
            } else {
                turned
            },
            size,
            middle,
            seed,
        }
    }

    /// A shape with a mirror, glass or neither as its surface, and a ball beside it; seen from outside or inside, with a
    /// lamp on either side.
    pub(crate) fn with(&self, kind: Kind, inside: bool) -> String {
        let straight = Self {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            ..*self
        };
        let room = if matches!(kind, Kind::Cuboid) {
            &straight
        } else {
            self
        };
        let surface = [MATTE, MIRROR, GLASS][self.seed as usize / 2 % 3];
        let shape = match kind {
            Kind::Ball => room.sphere([0.0; 3], 1.0),
            Kind::Tin => room.cone([0.0, -1.0, 0.0], 1.0, [0.0, 1.0, 0.0], 1.0),
            Kind::Tube => room.cone([0.0, -4.0, 0.0], 0.5, [0.0, 4.0, 0.0], 0.5),
            Kind::Lampshade => room.cone([0.0, -1.0, 0.0], 1.2, [0.0, 1.0, 0.0], 0.4),
            Kind::Hat => room.cone([0.0, -1.0, 0.0], 1.2, [0.0, 1.0, 0.0], 0.0),
            Kind::Dish => room.cone([0.0, -0.1, 0.0], 0.2, [0.0, 0.1, 0.0], 1.8),
            Kind::Cuboid => room.cuboid([0.0; 3], [1.4, 1.6, 1.8]),
            Kind::Triangle => room.polygon(&[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.5], [0.0, 1.0, 0.2]]),
            Kind::Hexagon => room.polygon(&[
                [1.0, 0.0, 0.0],
                [0.5, 0.8, 0.0],
                [-0.5, 0.8, 0.0],
                [-1.0, 0.0, 0.0],
                [-0.5, -0.8, 0.0],
                [0.5, -0.8, 0.0],
            ]),
        };
        let solid = !matches!(kind, Kind::Triangle | Kind::Hexagon);
        let (eye, at, lamp, angle) = match (inside, solid, kind) {
            (false, ..) => ([3.0, 2.0, 5.0], [0.0; 3], [-3.0, 5.0, 4.0], 35),
            (true, false, _) => ([-2.0, 1.0, -4.0], [0.0; 3], [3.0, 4.0, -4.0], 35),
            (.., Kind::Dish) => (
                [0.1, 0.05, 0.02],
                [0.9, 0.02, -0.35],
                [0.3, 0.04, -0.02],
                80,
            ),
            _ => ([0.1, -0.3, 0.2], [0.9, -0.5, -0.35], [-0.2, -0.4, 0.15], 80),
        };
        let near = match (inside && solid, kind) {
            (true, Kind::Dish) => String::new(),
            (true, _) => room.sphere([0.35, -0.5, -0.1], 0.08),
            (false, _) => room.sphere([1.5, -1.0, -1.2], 0.6),
        };
        [
            room.seen(eye, at, angle),
            room.light(lamp, 0.7),
            room.light([0.05, 6.0, 0.1], 0.3),
            room.wall(-4.5),
            surface.into(),
            shape,
            MATTE.into(),
            near,
        ]
        .concat()
    }

    /// A few shapes, lit from where a surface holds the light, or from `by` in front of it.
    pub(crate) fn lit_from(&self, holder: Held, by: f64) -> String {
        let straight = Self {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            ..*self
        };
        let room = match holder {
            Held::FaceOfBox | Held::EdgeOfBox => &straight,
            _ => self,
        };
        let (point, normal, shape) = holder.place(room);
        let light = [0, 1, 2].map(|i| point[i] + by * normal[i]);
        [
            room.seen([3.2, 2.1, 4.3], [0.0, -0.5, 0.0], 45),
            room.light(light, 1.0),
            room.wall(-1.5),
            room.sphere([-0.9, -0.7, 0.6], 0.8),
            shape,
            MIRROR.replace("0.3 0.3 0.3  20", "0 0 0  1"),
            room.cone([-1.2, -1.5, 2.2], 0.5, [-1.2, 0.0, 2.2], 0.1),
        ]
        .concat()
    }

    fn seen(&self, eye: [f64; 3], at: [f64; 3], angle: u32) -> String {
        let (eye, at, up) = (self.place(eye), self.place(at), self.turn([0.0, 1.0, 0.0]));
        let [x, y, z] = up;
        format!(
            "v {eye}\nat {at}\nup {x} {y} {z}\nangle {angle}\nresolution 32 32\nb 0.2 0.3 0.5\n"
        )
    }

    fn light(&self, at: [f64; 3], brightness: f64) -> String {
        format!("l {} {brightness}\n", self.place(at))
    }

    fn wall(&self, y: f64) -> String {
        let square = [
            [-4.0, y, -4.0],
            [4.0, y, -4.0],
            [4.0, y, 4.0],
            [-4.0, y, 4.0],
        ];
        format!("{MATTE}{}", self.polygon(&square))
    }

    fn sphere(&self, centre: [f64; 3], radius: f64) -> String {
        format!("s {} {}\n", self.place(centre), radius * self.size)
    }

    fn cone(&self, base: [f64; 3], base_radius: f64, top: [f64; 3], top_radius: f64) -> String {
        let (base, top) = (self.place(base), self.place(top));
        let [r, q] = [base_radius, top_radius].map(|r| r * self.size);
        format!("c {base} {r} {top} {q}\n")
    }

    fn cuboid(&self, centre: [f64; 3], size: [f64; 3]) -> String {
        let [x, y, z] = size.map(|side| side * self.size);
        format!("box {} {x} {y} {z}\n", self.place(centre))
    }

    fn polygon(&self, corners: &[[f64; 3]]) -> String {
        let corners: Vec<String> = corners.iter().map(|p| self.place(*p)).collect();
        format!("p {} {}\n", corners.len(), corners.join("  "))
    }

    fn turn(&self, v: [f64; 3]) -> [f64; 3] {
        self.axes
            .map(|axis| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2])
    }

    fn place(&self, p: [f64; 3]) -> String {
        let p = self.turn(p);
        let [x, y, z] = [0, 1, 2].map(|i| p[i] * self.size + self.middle[i]);
        format!("{x} {y} {z}")
    }
}
