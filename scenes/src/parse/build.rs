//! Builds the scene from entities.

use super::entity::Entity;
use super::header::Header;
use crate::check::{self, Fault, Oddity};
use crate::diagnostic::{Diagnostic, MistakeKind, Sink, WarningKind};
use crate::model::{Checker, Light, Object, Point, Scene, Shape, Surface};
use crate::word::{Keyword, Span};

/// A scene under construction.
#[derive(Debug, Default)]
pub(super) struct Builder {
    header: Header,
    lights: Vec<Light>,
    /// Lights without a colour; theirs depends on the total number of lights.
    colourless: Vec<usize>,
    surfaces: Vec<Surface>,
    /// What a checker's colour is multiplied by, if the last entity was a surface: NFF's Kd, or `None` for a surface of
    /// the thesis, whose checker has an ambient colour, too.
    checkered_by: Option<Option<f64>>,
    objects: Vec<Object>,
    vertices: Vec<Point>,
    normals: Vec<Point>,
    /// Whether there was any entity.
    begun: bool,
}

impl Builder {
    /// Adds `entity` with its `numbers` to the scene, or reports what is wrong with it.
    pub(super) fn add(&mut self, entity: &Entity<'_>, numbers: &[f64], mistakes: &mut Sink) {
        self.begun = true;
        self.header.pass(entity.keyword);
        let is_object = matches!(
            entity.keyword,
            Keyword::Sphere | Keyword::Cone | Keyword::Cuboid | Keyword::Polygon | Keyword::Patch
        );
        if is_object && self.surfaces.is_empty() {
            mistakes.push(MistakeKind::NoSurface, entity.span);
            self.surfaces.push(Surface::default()); // Report it once.
        }
        let after_surface = match entity.keyword {
            Keyword::Checker => self.checkered_by,
            _ => None,
        };
        self.checkered_by = None;
        if entity.valid {
            match self.place(entity, numbers, after_surface, mistakes) {
                Ok(()) => return,
                Err(Diagnostic { kind, span }) => mistakes.push(kind, span),
            }
        }
        // What is wrong shall not be reported as missing too.
        match entity.keyword {
            Keyword::Surface => self.surfaces.push(Surface::default()),
            keyword => self.header.mark_invalid(keyword, entity.span),
        }
    }

    /// Returns the number of objects so far.
    pub(super) fn objects(&self) -> usize {
        self.objects.len()
    }

    /// Returns the scene. Missing or contradictory parts are reported in `mistakes`; after any mistake the scene is
    /// meaningless.
    pub(super) fn finish(mut self, source: &str, mistakes: &mut Sink) -> Scene {
        let brightness = 1.0 / (self.lights.len() as f64).sqrt();
        for index in self.colourless {
            self.lights[index].colour = [brightness; 3];
        }
        let end = source.trim_end().len();
        let end = Span { start: end, end };
        if !self.begun && mistakes.is_empty() {
            mistakes.push(MistakeKind::Empty, end);
        }
        let mut scene = self.header.finish(end, mistakes);
        scene.lights = self.lights;
        scene.surfaces = self.surfaces;
        scene.objects = self.objects;
        scene.vertices = self.vertices;
        scene.normals = self.normals;
        scene
    }

    fn place(
        &mut self,
        entity: &Entity<'_>,
        numbers: &[f64],
        after_surface: Option<Option<f64>>,
        mistakes: &mut Sink,
    ) -> Result<(), Diagnostic> {
        let shape = match entity.keyword {
            Keyword::Light => return self.light(entity, numbers),
            Keyword::Surface => return self.surface(entity, numbers),
            Keyword::Checker => return self.checker(entity, numbers, after_surface),
            Keyword::Sphere => sphere(entity, numbers)?,
            Keyword::Cone => cone(entity, numbers)?,
            Keyword::Cuboid => cuboid(entity, numbers)?,
            Keyword::Polygon | Keyword::Patch => {
                match self.polygon_or_patch(entity, numbers, mistakes)? {
                    Some(shape) => shape,
                    None => return Ok(()),
                }
            }
            _ => return self.header.place(entity, numbers),
        };
        let surface = self.surfaces.len() - 1;
        let surface = u32::try_from(surface).map_err(|_| entity.fault(0..0, Fault::TooLarge))?;
        self.objects.push(Object { shape, surface });
        Ok(())
    }

    fn light(&mut self, entity: &Entity<'_>, numbers: &[f64]) -> Result<(), Diagnostic> {
        let (position, colour) = match *numbers {
            [x, y, z] => {
                self.colourless.push(self.lights.len());
                ([x, y, z], [0.0; 3])
            }
            [x, y, z, brightness] => ([x, y, z], [brightness; 3]),
            [x, y, z, r, g, b] => ([x, y, z], [r, g, b]),
            _ => return Err(entity.count(numbers, &[3, 4, 6])),
        };
        entity.not_negative(3, &numbers[3..])?;
        self.lights.push(Light { position, colour });
        Ok(())
    }

    fn surface(&mut self, entity: &Entity<'_>, numbers: &[f64]) -> Result<(), Diagnostic> {
        let (mut surface, ior) = match *numbers {
            [r, g, b, kd, ks, shine, t, ior] => {
                let surface = Surface {
                    diffuse: [kd * r, kd * g, kd * b],
                    specular: [ks; 3],
                    shine,
                    reflect: ks,
                    refract: t,
                    ..Surface::default()
                };
                (surface, Some((7, ior)))
            }
            [
                ar,
                ag,
                ab,
                dr,
                dg,
                db,
                sr,
                sg,
                sb,
                shine,
                reflect,
                refract,
                ref rest @ ..,
            ] if rest.len() <= 1 => {
                let surface = Surface {
                    ambient: [ar, ag, ab],
                    diffuse: [dr, dg, db],
                    specular: [sr, sg, sb],
                    shine,
                    reflect,
                    refract,
                    ..Surface::default()
                };
                self.header.pass_surface_of_thesis(entity.span);
                (surface, rest.first().map(|&ior| (12, ior)))
            }
            _ => return Err(entity.count(numbers, &[8, 12, 13])),
        };
        let coefficients = ior.map_or(numbers.len(), |(index, _)| index);
        entity.not_negative(0, &numbers[..coefficients])?;
        // An opaque surface has no inside; files hold 0 or anything else there.
        if let Some((index, ior)) = ior.filter(|_| surface.refract > 0.0) {
            surface.ior = ior;
            check::surface(&surface).map_err(|fault| entity.fault(index..index + 1, fault))?;
        }
        check::surface(&surface).map_err(|fault| entity.fault(0..4, fault))?;
        self.surfaces.push(surface);
        self.checkered_by = Some((numbers.len() == 8).then(|| numbers[3]));
        Ok(())
    }

    /// Adds other colours to the surface that was read just before.
    fn checker(
        &mut self,
        entity: &Entity<'_>,
        numbers: &[f64],
        after_surface: Option<Option<f64>>,
    ) -> Result<(), Diagnostic> {
        let (Some(kd), Some(surface)) = (after_surface, self.surfaces.last_mut()) else {
            return Err(entity.mistake(0..0, MistakeKind::LooseChecker));
        };
        let (size, ambient, diffuse) = match (kd, numbers) {
            (Some(kd), &[size, r, g, b]) => (size, [0.0; 3], [kd * r, kd * g, kd * b]),
            (None, &[size, ar, ag, ab, dr, dg, db]) => (size, [ar, ag, ab], [dr, dg, db]),
            (Some(_), _) => return Err(entity.count(numbers, &[4])),
            (None, _) => return Err(entity.count(numbers, &[7])),
        };
        entity.not_negative(1, &numbers[1..])?;
        let checker = Checker {
            size,
            ambient,
            diffuse,
        };
        check::checker(&checker).map_err(|fault| entity.fault(0..1, fault))?;
        surface.checker = Some(checker);
        Ok(())
    }

    /// Returns a polygon or patch; `None` after a warning if it has no area.
    fn polygon_or_patch(
        &mut self,
        entity: &Entity<'_>,
        numbers: &[f64],
        mistakes: &mut Sink,
    ) -> Result<Option<Shape>, Diagnostic> {
        let is_patch = entity.keyword == Keyword::Patch;
        let each = if is_patch { 6 } else { 3 };
        let (count, coordinates) = announced(entity, numbers, each)?;
        let (first, first_normal) = (self.vertices.len(), self.normals.len());
        for vertex in coordinates.chunks_exact(each) {
            let (points, _) = vertex.as_chunks::<3>();
            self.vertices.push(points[0]);
            self.normals.extend(&points[1..]);
        }
        let vertices = &self.vertices[first..];
        let oddity = match check::polygon(vertices) {
            Err(Fault::Collinear) => {
                let keyword = entity.keyword;
                let warning = WarningKind::NoArea { keyword };
                mistakes.warnings.push(warning, || entity.span);
                self.vertices.truncate(first);
                self.normals.truncate(first_normal);
                return Ok(None);
            }
            checked => checked.and_then(|oddity| {
                check::normals(&self.normals[first_normal..])?;
                Ok(oddity)
            }),
        };
        let place = |vertex: usize| 1 + vertex * each..4 + vertex * each;
        let oddity = oddity.map_err(|fault| {
            let blamed = match fault {
                Fault::NotPlanar { vertex, .. } => place(vertex),
                Fault::ZeroNormal { vertex } => 4 + vertex * each..7 + vertex * each,
                _ => 0..0,
            };
            entity.fault(blamed, fault)
        })?;
        if let Some(oddity) = oddity {
            let (vertex, warning) = match oddity {
                Oddity::RepeatedVertex { vertex } => {
                    let first = vertex == 0;
                    (vertex, WarningKind::RepeatedVertex { first })
                }
                Oddity::Uneven { vertex, distance } => (vertex, WarningKind::Uneven { distance }),
            };
            mistakes
                .warnings
                .push(warning, || entity.span_of(place(vertex)));
        }
        let too_large = |_| entity.fault(0..0, Fault::TooLarge);
        let index = |list: &[Point]| u32::try_from(list.len()).map_err(too_large);
        index(&self.vertices)?;
        index(&self.normals)?;
        let (first, first_normal) = (first as u32, first_normal as u32);
        Ok(Some(match is_patch {
            true => Shape::Patch {
                first,
                count,
                first_normal,
            },
            false => Shape::Polygon { first, count },
        }))
    }
}

fn sphere(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [x, y, z, radius] = entity.exactly(numbers)?;
    let (centre, radius) = ([x, y, z], radius.abs());
    check::sphere(&centre, radius).map_err(|fault| entity.fault(3..4, fault))?;
    Ok(Shape::Sphere { centre, radius })
}

fn cone(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [bx, by, bz, br, tx, ty, tz, tr] = entity.exactly(numbers)?;
    let (base, base_radius) = ([bx, by, bz], br.abs());
    let (top, top_radius) = ([tx, ty, tz], tr.abs());
    check::cone(&base, &top, [base_radius, top_radius]).map_err(|fault| {
        let blamed = if fault == Fault::BaseIsTop {
            4..7
        } else {
            7..8
        };
        entity.fault(blamed, fault)
    })?;
    Ok(Shape::Cone {
        base,
        base_radius,
        top,
        top_radius,
    })
}

fn cuboid(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [x, y, z, sx, sy, sz] = entity.exactly(numbers)?;
    let (centre, size) = ([x, y, z], [sx, sy, sz]);
    check::cuboid(&centre, &size).map_err(|fault| {
        let blamed = if let Fault::FlatBox { axis } = fault {
            3 + axis..4 + axis
        } else {
            0..6
        };
        entity.fault(blamed, fault)
    })?;
    Ok(Shape::Cuboid { centre, size })
}

/// Splits a polygon's numbers into the number of vertices and `each` numbers per vertex.
fn announced<'n>(
    entity: &Entity<'_>,
    numbers: &'n [f64],
    each: usize,
) -> Result<(u32, &'n [f64]), Diagnostic> {
    let (&count, coordinates) = numbers
        .split_first()
        .ok_or_else(|| entity.count(numbers, &[]))?;
    if count.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&count) {
        return Err(entity.mistake(0..1, MistakeKind::NotACount));
    }
    let count = count as u32;
    if count < 3 {
        return Err(entity.fault(0..1, Fault::TooFewVertices));
    }
    let found = coordinates.len();
    let wanted = (count as usize).saturating_mul(each);
    if found != wanted {
        let blamed = if found > wanted {
            wanted + 1..found + 1
        } else {
            0..1
        };
        let kind = MistakeKind::VertexCount {
            keyword: entity.keyword,
            vertices: count,
            found,
        };
        return Err(entity.mistake(blamed, kind));
    }
    Ok((count, coordinates))
}
