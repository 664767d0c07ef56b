//! What is drawn with memory of a size that is known when the program is compiled: the host's picture, or an error.

use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb888};
use octray_core::accel::{BuildOptions, CompactBvh8, CompactStack, compact_words};
use octray_core::frame::{Frame, FrameParams};
use octray_core::scalar::Fixed;
use octray_core::trace::Tracer;
use octray_embedded::diffusion::{Diffused, TooWide};
use octray_embedded::hash::HashPanel;
use octray_embedded::{DeviceTree, DrawError, Renderer};
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, quantise};

type S = Fixed<16>;

const OPTIONS: BuildOptions = BuildOptions {
    depth: 8,
    leaf_size: 1,
};

/// Glass and mirrors, so that rays wait.
const SCENE: &str = "v 0 0 6 at 0 0 0 up 0 1 0 angle 40 l 2 3 4 1 l -3 4 3 1
    f 0.1 0.1 0.1 0.3 0.3 0.3 0.3 0.3 0.3 20 0.3 0.6 1.5
    s 0 0 0 1 s 1.2 0.5 -1 0.7 s -1.1 -0.4 -1 0.8 box 0 -2 0 4 0.2 4";

fn prepared() -> Prepared<S> {
    let scene = octray_scenes::parse(SCENE).unwrap();
    let settings = RenderSettings {
        size: Some((40, 30)),
        ..RenderSettings::DEFAULT
    };
    quantise::<S>(&scene, &settings).unwrap()
}

/// Calls `check` with what to draw.
fn with_tracer(check: impl FnOnce(&Prepared<S>, &Tracer<'_, S, CompactBvh8<'_>>)) {
    let prepared = prepared();
    let scene = prepared.scene.scene();
    let mut tree = DeviceTree::<4, { compact_words(4) }>::new();
    tree.build(&scene, OPTIONS).unwrap();
    let tracer = Tracer {
        scene: &scene,
        accelerator: &tree.tree(),
        max_depth: 4,
        cut_off: S::nearest(1.0 / 512.0),
    };
    check(&prepared, &tracer);
}

#[test]
fn all_ways_to_draw_give_one_picture() {
    with_tracer(|prepared, tracer| {
        let frame = &prepared.frame;
        let mut hashes = Vec::new();
        let mut panel = HashPanel::new(40, 30);
        let mut four_rows = Renderer::<S, CompactStack<64>, 5, 2, 160>::new();
        four_rows.draw(frame, tracer, &mut panel).unwrap();
        hashes.push(panel.hash());
        let mut panel = HashPanel::new(40, 30);
        let mut seven_rows = Renderer::<S, CompactStack<64>, 5, 2, 299>::new();
        seven_rows.draw(frame, tracer, &mut panel).unwrap();
        hashes.push(panel.hash());

        let mut pixels = vec![[0; 3]; 40 * 30];
        let put = |x, y, level| pixels[(y * 40 + x) as usize] = level;
        four_rows.pixels(frame, tracer, put).unwrap();
        let mut rows = Vec::new();
        for top in (0..30).step_by(3) {
            rows.extend_from_slice(four_rows.strip(top..top + 3, frame, tracer).unwrap());
        }
        assert!(rows == pixels);
        let mut panel = HashPanel::new(40, 30);
        let colours = pixels.iter().map(|&[r, g, b]| Rgb888::new(r, g, b));
        let places = (0..).map(|i| (i % 40, i / 40).into());
        let drawn = places
            .zip(colours)
            .map(|(place, colour)| Pixel(place, colour));
        panel.draw_iter(drawn).unwrap();
        hashes.push(panel.hash());
        assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:x?}");
    });
}

#[test]
fn too_little_room_is_told() {
    with_tracer(|prepared, tracer| {
        let frame = &prepared.frame;
        let mut panel = HashPanel::new(40, 30);
        let mut narrow = Renderer::<S, CompactStack<64>, 5, 2, 39>::new();
        let pixels = 40;
        let drawn = narrow.draw(frame, tracer, &mut panel);
        assert_eq!(drawn, Err(DrawError::StripTooSmall { pixels }));
        assert_eq!(drawn.unwrap_err().to_string(), "the strip takes 40 pixels");
        let strip = narrow.strip(0..1, frame, tracer).err();
        assert_eq!(strip, Some(DrawError::StripTooSmall { pixels }));
        let params = FrameParams {
            block: 2,
            ..frame.params().clone()
        };
        let squares = Frame::from_params(params);
        let mut four_rows = Renderer::<S, CompactStack<64>, 5, 2, 160>::new();
        let cut = four_rows.strip(1..3, &squares, tracer).err();
        assert_eq!(cut, Some(DrawError::SquaresCut { side: 2 }));
        assert!(four_rows.strip(2..4, &squares, tracer).is_ok());
        let mut few = Renderer::<S, CompactStack<64>, 1, 2, 40>::new();
        let drawn = few.draw(frame, tracer, &mut panel).unwrap_err();
        assert!(
            matches!(drawn, DrawError::RaysDropped { rays: 1.. }),
            "{drawn}"
        );
        // A shadow cache of fewer places than lights costs time, not light.
        let mut whole = HashPanel::new(40, 30);
        let mut without_cache = Renderer::<S, CompactStack<64>, 5, 0, 40>::new();
        without_cache.draw(frame, tracer, &mut whole).unwrap();
        let mut cached = HashPanel::new(40, 30);
        let mut with_cache = Renderer::<S, CompactStack<64>, 5, 2, 40>::new();
        with_cache.draw(frame, tracer, &mut cached).unwrap();
        assert_eq!(whole.hash(), cached.hash());
    });
}

#[test]
fn a_tree_without_room_is_the_tree_of_nothing() {
    let prepared = prepared();
    let scene = prepared.scene.scene();
    let mut few_objects = DeviceTree::<3, 99>::new();
    assert_eq!(few_objects.build(&scene, OPTIONS).unwrap_err().links, 4);
    assert!(few_objects.tree().words().is_empty());
    let mut few_words = DeviceTree::<4, 3>::new();
    assert!(few_words.build(&scene, OPTIONS).is_err());
    assert!(few_words.tree().links().is_empty());
    let mut enough = DeviceTree::<4, { compact_words(4) }>::new();
    enough.build(&scene, OPTIONS).unwrap();
    let mut copy = DeviceTree::<4, { compact_words(4) }>::new();
    copy.copy(&enough.tree()).unwrap();
    assert_eq!(copy.tree().words(), enough.tree().words());
    assert!(few_words.copy(&enough.tree()).is_err());
    copy.refit(&scene);
    assert_eq!(copy.tree().words(), enough.tree().words());
}

struct Bits(Vec<bool>);

impl OriginDimensions for Bits {
    fn size(&self) -> Size {
        Size::new(40, 30)
    }
}

impl DrawTarget for Bits {
    type Color = BinaryColor;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Self::Error> {
        for Pixel(place, colour) in pixels {
            self.0[(place.y * 40 + place.x) as usize] = colour.is_on();
        }
        Ok(())
    }
}

#[test]
fn black_and_white_have_the_mean_of_the_picture_however_it_is_cut() {
    with_tracer(|prepared, tracer| {
        let frame = &prepared.frame;
        let mut renderer = Renderer::<S, CompactStack<64>, 5, 2, 160>::new();
        let mut sum = 0.0;
        let luma =
            |[r, g, b]: [u8; 3]| 0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b);
        let put = |_, _, level| sum += luma(level) / 255.0;
        renderer.pixels(frame, tracer, put).unwrap();
        let mut bits = Bits(vec![false; 1200]);
        let mut diffused = Diffused::<_, 40>::new(&mut bits).unwrap();
        renderer.draw(frame, tracer, &mut diffused).unwrap();
        // Once more on the same panel: nothing is left over from the first picture.
        renderer.draw(frame, tracer, &mut diffused).unwrap();
        let white = bits.0.iter().filter(|on| **on).count() as f64;
        assert!((white - sum).abs() < 12.0, "{white} for {sum}");
        let mut whole = Bits(vec![false; 1200]);
        let mut diffused = Diffused::<_, 40>::new(&mut whole).unwrap();
        let mut one_strip = Renderer::<S, CompactStack<64>, 5, 2, 1200>::new();
        one_strip.draw(frame, tracer, &mut diffused).unwrap();
        assert!(whole.0 == bits.0);
        let narrow = Diffused::<_, 39>::new(&mut whole).err();
        assert_eq!(narrow, Some(TooWide { columns: 40 }));
    });
}
