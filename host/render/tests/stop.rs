//! Work stops within a tile, however many rays one pixel branches into: on request, or when its budget is spent.

use octray_core::observe::RayKind;
use octray_prepare::RenderSettings;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::render::{Rendering, render_with};
use octray_render::schedule::Schedule;
use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

/// Shells of glass that mirror: every hit makes two rays.
const SHELLS: &str = "v 0 0 4 at 0 0 0 up 0 1 0 angle 50 resolution 8 8 l 0 5 5 1
    f 0 0 0 0.1 0.1 0.1 0 0 0 1 1 1 1.2  s 0 0 0 9 s 0 0 0 8 s 0 0 0 2 s 0 0 0 1";

fn render(depth: u32, threads: usize, interrupt: &Interrupt) -> Result<Rendering, Error> {
    let scene = octray_scenes::parse(SHELLS).unwrap();
    let settings = RenderSettings {
        max_depth: depth,
        cut_off: 0.0,
        ..RenderSettings::DEFAULT
    };
    let schedule = Schedule {
        threads: NonZeroUsize::new(threads).unwrap(),
        ..Schedule::default()
    };
    render_with(&scene, &settings, &schedule, false, &(), interrupt)
}

/// Without looking between rays, this would not end before the sun does.
#[test]
fn a_request_ends_a_pixel_that_branches_for_ever() {
    for threads in [1, 2] {
        let interrupt = Interrupt::new();
        let result = thread::scope(|scope| {
            let work = scope.spawn(|| render(64, threads, &interrupt));
            thread::sleep(Duration::from_millis(50));
            interrupt.request();
            work.join().unwrap()
        });
        assert!(matches!(result, Err(Error::Interrupted)));
    }
}

/// Whether a picture keeps to its budget depends on nothing but its rays.
#[test]
fn a_budget_is_exact_on_any_number_of_threads() {
    let whole = render(9, 1, &Interrupt::new()).unwrap();
    let counters = &whole.counters;
    let rays = counters.all_rays() - counters.rays_of(RayKind::Shadow);
    assert!(rays > 10_000, "{rays}");
    for threads in [1, 2, 3] {
        let with = |budget| render(9, threads, &Interrupt::new().with_budget(budget));
        assert_eq!(with(rays).unwrap().picture, whole.picture);
        for budget in [rays - 1, rays / 2, 1] {
            let result = with(budget);
            assert!(matches!(result, Err(Error::TooManyRays(most)) if most == budget));
        }
    }
}
