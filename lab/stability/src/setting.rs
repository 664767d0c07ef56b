//! The scenes that belong to values of sweeps: they decide whether a format admits the value, and how it is scaled.

use octray_core::quantize::Quantize;
use octray_prepare::RenderSettings;
use octray_prepare::quantise::{Prepared, limits, quantise, resolution};
use octray_scenes::model::{Camera, Light, Object, Point, Projection, Scene, Shape, Surface};

/// A scene and the view of it.
#[derive(Clone, Debug)]
pub struct Setting {
    scene: Scene,
    view: RenderSettings,
}

impl Setting {
    /// Returns an empty scene, seen from `eye` in a picture of one pixel, so that the pixel is not too fine.
    pub fn empty(eye: Point) -> Self {
        let scene = Scene {
            camera: Camera::Nff {
                from: eye,
                at: eye.map(|x| if x == 0.0 { 1.0 } else { x / 2.0 }),
                up: [0.3, 0.5, 0.8],
                angle: 45.0,
                projection: Projection::Perspective,
            },
            width: 1,
            height: 1,
            background: [0.0; 3],
            zenith: None,
            room: None,
            lights: vec![Light {
                position: eye,
                colour: [1.0; 3],
            }],
            surfaces: vec![Surface::default()],
            objects: Vec::new(),
            vertices: Vec::new(),
            normals: Vec::new(),
        };
        let view = RenderSettings {
            max_depth: 1,
            ..RenderSettings::DEFAULT
        };
        Self { scene, view }
    }

    /// Returns a shape seen from `eye`.
    pub fn of(shape: Shape, eye: Point) -> Self {
        Self::empty(eye).and(shape)
    }

    /// Returns a sphere of this radius around the origin; the eye is at this distance from its centre.
    pub fn sphere(radius: f64, distance: f64) -> Self {
        let centre = [0.0; 3];
        Self::of(Shape::Sphere { centre, radius }, [distance, 0.0, 0.0])
    }

    /// Returns a sphere in a picture whose pixel is this wide, in radians.
    pub fn pixel(angle: f64) -> Self {
        Self::sphere(1.0, 3.0).in_pixels_of(angle)
    }

    /// Sets the width of a pixel, in radians. Parts of a surface smaller than a pixel need not be right, and so for
    /// rays at a small angle to it.
    #[must_use]
    pub fn in_pixels_of(mut self, radians: f64) -> Self {
        if let Camera::Nff { angle, .. } = &mut self.scene.camera {
            *angle = radians.to_degrees();
        }
        self
    }

    /// Adds a shape.
    #[must_use]
    pub fn and(mut self, shape: Shape) -> Self {
        self.scene.objects.push(Object { shape, surface: 0 });
        self
    }

    /// Adds a polygon.
    #[must_use]
    pub fn and_polygon(mut self, vertices: &[Point]) -> Self {
        let (first, count) = (self.scene.vertices.len() as u32, vertices.len() as u32);
        self.scene.vertices.extend(vertices);
        self.and(Shape::Polygon { first, count })
    }

    /// Makes everything reflect this share, up to `max_depth` times.
    #[must_use]
    pub fn reflecting(mut self, reflect: f64, max_depth: u32) -> Self {
        self.view.max_depth = max_depth;
        for surface in &mut self.scene.surfaces {
            surface.reflect = reflect;
        }
        self
    }

    /// Returns the setting in a format, or `None` if it would overflow.
    pub fn prepare<S: Quantize>(&self) -> Option<Prepared<S>> {
        quantise(&self.scene, &self.view).ok()
    }

    /// Returns whether a format admits it: nothing overflows, and nothing is too fine.
    pub fn admitted<S: Quantize>(&self) -> bool {
        limits::<S>(&self.scene, self.view.max_depth).is_ok()
            && resolution::<S>(&self.scene, &self.view).is_ok()
    }
}
