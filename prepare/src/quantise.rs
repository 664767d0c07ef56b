//! Converts a parsed scene to one arithmetic: places it, scales it, and checks that it fits.
//!
//! The scene is moved and scaled by a power of two. In floating point, the middle of the objects becomes the origin,
//! where numbers are finest, and the diagonal becomes 1 to 2. In fixed point, the middle of everything, including
//! lights and viewpoint, becomes the origin, and the diagonal becomes as large as the format allows for every
//! coordinate, distance and difference of points to fit. Values that cannot be scaled (colours, refraction indices) are
//! checked by [`limits`], which names the value that would overflow. [`fn@resolution`] reports what a format is too
//! coarse for.

mod camera;
mod checker;
mod extent;
mod resolution;
mod shapes;

pub use crate::limits::{Bound, Overflow, bounds, limits};
pub use extent::Extent;
pub use resolution::{TooFine, grain, resolution};

use crate::settings::RenderSettings;
use octray_core::checker::Checker;
use octray_core::frame::Frame;
use octray_core::object::{ObjectKind, ObjectRef};
use octray_core::quantize::Quantize;
use octray_core::scalar::{Exponent, Scalar};
use octray_core::scene::{Attributes, Light, Parallax, Scene, Sky, Surface};
use octray_core::shape::{Cone, Cuboid, Outlines, Patch, Polygon, Shapes, Sphere, Triangle};
use octray_core::vec3::Vec3;
use octray_core::world::World;
use octray_scenes::model;

/// A scene in the numbers of one format, owned.
#[derive(Clone, Debug, Default)]
pub struct Quantised<S: Scalar> {
    /// Spheres.
    pub spheres: Vec<Sphere<S>>,
    /// Polygons of three vertices.
    pub triangles: Vec<Triangle<S>>,
    /// Polygons of more vertices.
    pub polygons: Vec<Polygon<S>>,
    /// Truncated cones.
    pub cones: Vec<Cone<S>>,
    /// Boxes.
    pub cuboids: Vec<Cuboid<S>>,
    /// Projected vertices of polygons.
    pub corners: Vec<[S; 2]>,
    /// Where the edges of polygons' bands begin.
    pub bands: Vec<u32>,
    /// The edges of those bands.
    pub edges: Vec<[[S; 2]; 2]>,
    /// Patches.
    pub patches: Vec<Patch<S>>,
    /// Unit normals of patches.
    pub normals: Vec<Vec3<S>>,
    /// Attributes of all objects, by [`ObjectKind`].
    pub attributes: [Vec<Attributes>; 5],
    /// Surfaces.
    pub surfaces: Vec<Surface<S>>,
    /// Lights.
    pub lights: Vec<Light<S>>,
    /// The background.
    pub background: Vec3<S>,
    /// How it changes with the direction.
    pub sky: Sky<S>,
    /// The checkers of surfaces.
    pub checkers: Vec<Checker<S>>,
    /// How far hits may be off their shapes.
    pub slack: S,
    /// The largest distance between two points.
    pub diameter: S,
    all_attributes: Vec<Attributes>,
}

/// A quantised scene with the picture to be made of it.
#[derive(Debug)]
pub struct Prepared<S: Quantize> {
    /// The scene.
    pub scene: Quantised<S>,
    /// The picture.
    pub frame: Frame<S>,
    /// The place of the scene.
    pub world: World,
}

/// Converts a scene and its view to format `S`.
///
/// # Errors
/// If a colour, a coefficient, a refraction index or a transmitted share does not fit the format.
pub fn quantise<S: Quantize>(
    scene: &model::Scene,
    settings: &RenderSettings,
) -> Result<Prepared<S>, Overflow> {
    limits::<S>(scene, settings.max_depth)?;
    let rays = settings.rays(scene);
    let extent = Extent::of(scene, &rays);
    let world = extent.world::<S>();
    let frame = settings.frame::<S>(&rays, scene, &extent, &world);
    let mut quantised = Quantised {
        slack: world.slack(),
        diameter: world.diameter(),
        surfaces: scene.surfaces.iter().map(surface).collect(),
        lights: (scene.lights.iter())
            .map(|of_scene| light(of_scene, extent.is_far(of_scene), &world))
            .collect(),
        background: vector(scene.background),
        sky: checker::sky(scene),
        ..Quantised::default()
    };
    for (of_surface, surface) in scene.surfaces.iter().zip(&mut quantised.surfaces) {
        if let Some(of_surface) = &of_surface.checker {
            quantised
                .checkers
                .push(checker::checker(of_surface, &world));
            surface.checker = quantised.checkers.len() as u32;
        }
    }
    for (id, object) in scene.objects.iter().enumerate() {
        quantised.add(scene, id as u32, object, &world);
    }
    quantised.gather();
    Ok(Prepared {
        scene: quantised,
        frame,
        world,
    })
}

impl<S: Quantize> Quantised<S> {
    /// Returns the scene as the tracer uses it.
    pub fn scene(&self) -> Scene<'_, S> {
        let shapes = self.shapes();
        Scene {
            shapes,
            attributes: &self.all_attributes,
            first: Scene::first_of(&shapes),
            surfaces: &self.surfaces,
            lights: &self.lights,
            background: self.background,
            sky: self.sky,
            checkers: &self.checkers,
            diameter: self.diameter,
        }
    }

    /// Returns the geometry.
    pub fn shapes(&self) -> Shapes<'_, S> {
        Shapes {
            spheres: &self.spheres,
            triangles: &self.triangles,
            polygons: &self.polygons,
            cones: &self.cones,
            cuboids: &self.cuboids,
            outlines: Outlines {
                corners: &self.corners,
                bands: &self.bands,
                edges: &self.edges,
            },
            patches: &self.patches,
            normals: &self.normals,
            slack: self.slack,
        }
    }

    /// Sorts the objects of each kind by their first occurrence in `links`, so that objects that are tested together
    /// are adjacent, and renumbers them in `links`.
    pub fn reorder(&mut self, links: &mut [ObjectRef]) {
        let mut places: [Vec<u32>; 5] =
            ObjectKind::ALL.map(|kind| vec![u32::MAX; self.shapes().count(kind)]);
        let mut orders: [Vec<u32>; 5] = Default::default();
        for link in links {
            let kind = link.kind() as usize;
            let place = &mut places[kind][link.index()];
            if *place == u32::MAX {
                *place = orders[kind].len() as u32;
                orders[kind].push(link.index() as u32);
            }
            *link = ObjectRef::new(link.kind(), *place).marked_last(link.is_last());
        }
        for kind in ObjectKind::ALL {
            let order = &mut orders[kind as usize];
            let unlinked = places[kind as usize].iter().enumerate();
            order.extend(
                unlinked
                    .filter(|(_, place)| **place == u32::MAX)
                    .map(|(i, _)| i as u32),
            );
            permute(&mut self.attributes[kind as usize], order);
            match kind {
                ObjectKind::Sphere => permute(&mut self.spheres, order),
                ObjectKind::Triangle => permute(&mut self.triangles, order),
                ObjectKind::Polygon => permute(&mut self.polygons, order),
                ObjectKind::Cone => permute(&mut self.cones, order),
                ObjectKind::Cuboid => permute(&mut self.cuboids, order),
            }
        }
        self.gather();
    }

    fn gather(&mut self) {
        self.all_attributes = self.attributes.concat();
    }
}

fn permute<T: Copy>(things: &mut Vec<T>, order: &[u32]) {
    *things = order.iter().map(|&i| things[i as usize]).collect();
}

fn surface<S: Quantize>(surface: &model::Surface) -> Surface<S> {
    let whole = surface.shine.floor().min(f64::from(u32::MAX));
    Surface {
        ambient: vector(surface.ambient),
        diffuse: vector(surface.diffuse),
        specular: vector(surface.specular),
        shine: Exponent {
            whole: whole as u32,
            fraction: S::from_f64((surface.shine - whole).min(1.0)),
        },
        reflect: S::from_f64(surface.reflect),
        refract: S::from_f64(surface.refract),
        entering: S::from_f64(1.0 / surface.ior),
        leaving: S::from_f64(surface.ior),
        checker: 0,
    }
}

fn light<S: Quantize>(light: &model::Light, is_far: bool, world: &World) -> Light<S> {
    let colour = vector(light.colour);
    if !is_far {
        return Light::new(world.place(light.position), colour);
    }
    let away = [0, 1, 2].map(|i| light.position[i] / 4.0 - world.centre[i] / 4.0);
    let quarter = away[0].hypot(away[1]).hypot(away[2]);
    let distance = world.length(quarter) * 4.0;
    let exponent = match S::FRACTION_BITS {
        Some(_) => -distance.log2().ceil().clamp(0.0, 31.0),
        None => 0.0,
    };
    Light {
        position: vector(away.map(|x| x / quarter)),
        colour,
        parallax: Some(Parallax {
            share: S::from_f64(1.0 / (distance * exponent.exp2())),
            exponent: exponent as i8,
        }),
    }
}

fn vector<S: Quantize>(v: [f64; 3]) -> Vec3<S> {
    v.map(S::from_f64).into()
}
