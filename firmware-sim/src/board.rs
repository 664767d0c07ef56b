//! The part that all boards share: the frame with the marks for counting instructions, the report and the exit.

#[cfg(target_arch = "arm")]
mod cortex_m;
mod print;
#[cfg(target_arch = "riscv32")]
mod riscv;
mod stack;

use crate::baked::{CUT_OFF, FEATURES, FRAME, HEIGHT, LIGHTS, MAX_DEPTH, RAYS, S, SCENE, WIDTH};
use core::convert::Infallible;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::primitives::Rectangle;
use octray_core::accel::Accelerator;
use octray_core::trace::Tracer;
use octray_embedded::hash::HashPanel;
use octray_embedded::render::ROWS;
use octray_embedded::{DrawError, Renderer, marks};
use semihosting::process::exit;

/// Pixels of a strip.
const PIXELS: usize = WIDTH as usize * ROWS as usize;

/// Renders, reports, exits.
fn run() -> ! {
    stack::paint();
    let (hash, dropped) = frame();
    let deepest = stack::deepest();
    print::text("scene ");
    print::text(crate::baked::NAME);
    print::text("\narith ");
    print::text(crate::baked::ARITH);
    print::text("\nhash ");
    print::hexadecimal(hash);
    print::number("stack", deepest.unwrap_or(0));
    if dropped > 0 {
        print::number("dropped", dropped);
    }
    print::text("\n");
    exit(match deepest {
        Some(_) if dropped > 0 => 104,
        Some(_) => 0,
        None => 103,
    })
}

/// Says that an exception was taken, and whether for want of stack.
fn fault() -> ! {
    print::text("fault\n");
    exit(if stack::deepest().is_some() { 102 } else { 103 })
}

/// [`trace`] with the baked tree.
#[cfg(not(octray_device_tree))]
fn frame() -> (u64, u32) {
    trace(&crate::baked::TREE)
}

/// Builds the tree in its own memory, and [`trace`]; 0 if the tree does not fit.
#[cfg(octray_device_tree)]
fn frame() -> (u64, u32) {
    use crate::baked::{GROWTH, OBJECTS, TREE_WORDS};
    use octray_core::accel::CompactBvh8;
    use octray_core::object::ObjectRef;
    use octray_core::ray::Aabb;

    let mut words = [0; TREE_WORDS];
    let mut links = [ObjectRef::default(); OBJECTS];
    // A function of its own, so that its boxes are freed before the picture is rendered.
    #[inline(never)]
    fn build<'a>(words: &'a mut [u32], links: &'a mut [ObjectRef]) -> Option<CompactBvh8<'a>> {
        let mut boxes = [Aabb::default(); OBJECTS];
        CompactBvh8::build(
            &SCENE.shapes,
            SCENE.diameter,
            words,
            links,
            &mut boxes,
            GROWTH,
        )
        .ok()
        .map(|(tree, _)| tree)
    }
    build(&mut words, &mut links).map_or((0, 0), |tree| trace(&tree))
}

/// Renders the picture and returns its hash, and how many rays found no room.
#[inline(never)]
fn trace<A: Accelerator<S, FEATURES>>(tree: &A) -> (u64, u32) {
    let tracer = Tracer {
        scene: &SCENE,
        accelerator: tree,
        max_depth: MAX_DEPTH,
        cut_off: CUT_OFF,
    };
    let mut renderer = Renderer::<S, A::Stack, RAYS, LIGHTS, PIXELS>::new();
    let mut panel = Panel(HashPanel::new(WIDTH, HEIGHT));
    marks::begin();
    let drawn = renderer.draw(&FRAME, &tracer, &mut panel);
    marks::end();
    let dropped = match drawn {
        Err(DrawError::RaysDropped { rays }) => rays,
        _ => 0,
    };
    (panel.0.hash(), dropped)
}

/// The panel; its instructions are excluded from the count.
struct Panel(HashPanel);

impl OriginDimensions for Panel {
    fn size(&self) -> Size {
        self.0.size()
    }
}

impl DrawTarget for Panel {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.0.draw_iter(pixels)
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb888>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        marks::end();
        let drawn = self.0.fill_contiguous(area, colours);
        marks::begin();
        drawn
    }
}
