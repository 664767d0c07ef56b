//! The ball and what it needs to be drawn, on any display.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::Rgb888;
use octray_core::accel::BuildError;
use octray_core::scalar::Scalar;
use octray_core::scene::{OutOfRoom, Scene};
use octray_core::shape::{Shapes, Sphere};
use octray_core::trace::Tracer;
use octray_embedded::{DeviceTree, DrawError};

octray_embedded::scene! { pub mod baked = "ball"; }

use baked::{FEATURES, FRAME, GROWTH, OBJECTS, S, SCENE, SPHERES, TREE_WORDS};

/// The ball's place among the spheres.
const BALL: usize = baked::BY_ID[0].index();
/// What it falls faster by with each picture.
const GRAVITY: S = baked::length(0.0625);

/// A ball that bounces for ever.
pub struct Bounce {
    spheres: [Sphere<S>; SPHERES.len()],
    /// How far it falls with each picture.
    fall: S,
    tree: DeviceTree<OBJECTS, TREE_WORDS>,
    renderer: baked::Renderer,
}

impl Bounce {
    /// The ball where it is in the scene file, at rest.
    pub fn new() -> Result<Self, BuildError> {
        let mut bounce = Self {
            spheres: SPHERES,
            fall: S::ZERO,
            tree: DeviceTree::new(),
            renderer: baked::Renderer::new(),
        };
        bounce.rebuild()?;
        Ok(bounce)
    }

    /// Moves the ball, which leaves the floor as fast as it meets it.
    pub fn step(&mut self) {
        let ball = &mut self.spheres[BALL];
        let lowest = baked::place([0.0, 0.0, 0.0]).y + ball.radius;
        self.fall = self.fall + GRAVITY;
        if ball.centre.y - self.fall < lowest {
            self.fall = GRAVITY - self.fall;
        }
        ball.centre.y = ball.centre.y - self.fall;
    }

    /// The scene with the ball where it is now.
    fn scene(spheres: &[Sphere<S>]) -> Scene<'_, S, FEATURES> {
        Scene {
            shapes: Shapes {
                spheres,
                ..SCENE.shapes
            },
            ..SCENE
        }
    }

    /// Whether everything is where the numbers have room for it.
    pub fn fits(&self) -> Result<(), OutOfRoom> {
        Self::scene(&self.spheres).fits(FRAME.camera())
    }

    /// Builds the tree anew.
    pub fn rebuild(&mut self) -> Result<(), BuildError> {
        self.tree.build(&Self::scene(&self.spheres), GROWTH)
    }

    /// Fits the tree to the ball's place, which takes less.
    pub fn refit(&mut self) {
        self.tree.refit(&Self::scene(&self.spheres));
    }

    /// Draws the picture.
    pub fn draw<D>(&mut self, display: &mut D) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color: From<Rgb888>>,
    {
        let tracer = Tracer {
            scene: &Self::scene(&self.spheres),
            accelerator: &self.tree.tree(),
            max_depth: baked::MAX_DEPTH,
            cut_off: baked::CUT_OFF,
        };
        self.renderer.draw(&FRAME, &tracer, display)
    }
}
