//! The part that all boards share: the frame with the marks for counting instructions, the report and the exit.

#[cfg(target_arch = "arm")]
mod cortex_m;
mod dropped;
mod marks;
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
use marks::{octray_pause, octray_resume};
use octray_core::accel::Accelerator;
use octray_core::trace::{QueuedRay, Tracer, Workspace};
use octray_embedded::hash::HashPanel;
use octray_embedded::render::{ROWS, render};
use semihosting::process::exit;

/// Renders, reports, exits.
fn run() -> ! {
    stack::paint();
    let hash = frame();
    let deepest = stack::deepest();
    print::text("scene ");
    print::text(crate::baked::NAME);
    print::text("\narith ");
    print::text(crate::baked::ARITH);
    print::text("\nhash ");
    print::hexadecimal(hash);
    print::number("stack", deepest.unwrap_or(0));
    let dropped = dropped::total();
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

/// Renders the picture with the baked tree and returns its hash.
#[cfg(not(octray_device_tree))]
fn frame() -> u64 {
    trace(&crate::baked::TREE)
}

/// Builds the tree in its own memory, renders the picture and returns its hash; 0 if the tree does not fit.
#[cfg(octray_device_tree)]
fn frame() -> u64 {
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
    build(&mut words, &mut links).map_or(0, |tree| trace(&tree))
}

/// Renders the picture and returns its hash.
#[inline(never)]
fn trace<A: Accelerator<S, FEATURES>>(tree: &A) -> u64 {
    let tracer = Tracer {
        scene: &SCENE,
        accelerator: tree,
        max_depth: MAX_DEPTH,
        cut_off: CUT_OFF,
    };
    let mut rays = [QueuedRay::EMPTY; RAYS];
    let mut shadow_cache = [None; LIGHTS];
    let mut workspace = Workspace {
        rays: &mut rays,
        stack: &mut A::Stack::default(),
        shadow_cache: &mut shadow_cache,
    };
    let mut strip = [[0; 3]; WIDTH as usize * ROWS as usize];
    let mut panel = Panel(HashPanel::new(WIDTH, HEIGHT));
    octray_resume();
    let Ok(()) = render(
        &mut panel,
        &FRAME,
        &tracer,
        &mut workspace,
        &mut strip,
        &mut dropped::DropCounter,
    );
    octray_pause();
    panel.0.hash()
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
        octray_pause();
        let drawn = self.0.fill_contiguous(area, colours);
        octray_resume();
        drawn
    }
}
