//! Builds the scene from entities: what their numbers mean, and which of them is to blame for a fault.

use super::entity::Entity;
use super::header::Header;
use crate::check::{self, Fault};
use crate::diagnostic::{Diagnostic, MistakeKind, Sink, WarningKind};
use crate::model::{Checker, Light, Scene, Shape, Surface};
use crate::word::{Keyword, Span};

/// A scene under construction.
#[derive(Debug, Default)]
pub(super) struct Builder {
    header: Header,
    /// What comes after the header.
    scene: Scene,
    /// Lights without a colour; theirs depends on the total number of lights.
    colourless: Vec<usize>,
    /// What a checker's colour is multiplied by, if the last entity was a surface: NFF's Kd, or `None` for a surface of
    /// the thesis, whose checker has an ambient colour, too.
    checkered_by: Option<Option<f64>>,
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
        if is_object && self.scene.surfaces.is_empty() {
            mistakes.push(MistakeKind::NoSurface, entity.span);
            self.scene.surfaces.push(Surface::default()); // Report it once.
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
            Keyword::Surface => self.scene.surfaces.push(Surface::default()),
            keyword => self.header.mark_invalid(keyword, entity.span),
        }
    }

    /// Returns the number of objects so far.
    pub(super) fn objects(&self) -> usize {
        self.scene.objects.len()
    }

    /// Returns the scene. Missing or contradictory parts are reported in `mistakes`; after any mistake the scene is
    /// meaningless.
    pub(super) fn finish(mut self, source: &str, mistakes: &mut Sink) -> Scene {
        let brightness = 1.0 / (self.scene.lights.len() as f64).sqrt();
        for index in self.colourless {
            self.scene.lights[index].colour = [brightness; 3];
        }
        let end = source.trim_end().len();
        let end = Span { start: end, end };
        if !self.begun && mistakes.is_empty() {
            mistakes.push(MistakeKind::Empty, end);
        }
        self.header.finish(self.scene, end, mistakes)
    }

    fn place(
        &mut self,
        entity: &Entity<'_>,
        numbers: &[f64],
        after_surface: Option<Option<f64>>,
        mistakes: &mut Sink,
    ) -> Result<(), Diagnostic> {
        let surface = || self.last_surface(entity);
        let (shape, surface) = match entity.keyword {
            Keyword::Light => return self.light(entity, numbers),
            Keyword::Surface => return self.surface(entity, numbers),
            Keyword::Checker => return self.checker(entity, numbers, after_surface),
            Keyword::Sphere => (sphere(entity, numbers)?, surface()?),
            Keyword::Cone => (cone(entity, numbers)?, surface()?),
            Keyword::Cuboid => (cuboid(entity, numbers)?, surface()?),
            Keyword::Polygon | Keyword::Patch => {
                return self.polygon_or_patch(entity, numbers, mistakes);
            }
            _ => return self.header.place(entity, numbers),
        };
        let blamed = |fault| match (fault, entity.keyword) {
            (Fault::FlatBox { axis }, _) => 3 + axis..4 + axis,
            (Fault::BaseIsTop, _) => 4..7,
            (_, Keyword::Sphere) => 3..4,
            (_, Keyword::Cone) => 7..8,
            _ => 0..6,
        };
        (self.scene.add_solid(shape, surface)).map_err(|fault| entity.fault(blamed(fault), fault))
    }

    fn light(&mut self, entity: &Entity<'_>, numbers: &[f64]) -> Result<(), Diagnostic> {
        let (position, colour) = match *numbers {
            [x, y, z] => {
                self.colourless.push(self.scene.lights.len());
                ([x, y, z], [0.0; 3])
            }
            [x, y, z, brightness] => ([x, y, z], [brightness; 3]),
            [x, y, z, r, g, b] => ([x, y, z], [r, g, b]),
            _ => return Err(entity.count(numbers, &[3, 4, 6])),
        };
        entity.not_negative(3, &numbers[3..])?;
        (self.scene.add_light(Light { position, colour }))
            .map_err(|fault| entity.fault(0..numbers.len(), fault))
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
        if let Some((_, ior)) = ior {
            surface.ior = ior;
        }
        self.scene.add_surface(surface).map_err(|fault| {
            let blamed = match (fault, ior) {
                (Fault::RefractionIndex, Some((index, _))) => index..index + 1,
                _ => 0..4,
            };
            entity.fault(blamed, fault)
        })?;
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
        let (Some(kd), Some(surface)) = (after_surface, self.scene.surfaces.last_mut()) else {
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

    /// Adds a polygon or patch; what is odd about it becomes a warning.
    fn polygon_or_patch(
        &mut self,
        entity: &Entity<'_>,
        numbers: &[f64],
        mistakes: &mut Sink,
    ) -> Result<(), Diagnostic> {
        let is_patch = entity.keyword == Keyword::Patch;
        let each = if is_patch { 6 } else { 3 };
        let coordinates = announced(entity, numbers, each)?;
        let corners = coordinates.chunks_exact(each).map(|corner| {
            let (points, _) = corner.as_chunks::<3>();
            (points[0], points.get(1).copied())
        });
        let surface = self.last_surface(entity)?;
        let place = |vertex: usize| 1 + vertex * each..4 + vertex * each;
        let oddity = self.scene.add_polygon(corners, is_patch, surface);
        let oddity = oddity.map_err(|fault| {
            let blamed = match fault {
                Fault::NotPlanar { vertex, .. } => place(vertex),
                Fault::ZeroNormal { vertex } => 4 + vertex * each..7 + vertex * each,
                _ => 0..0,
            };
            entity.fault(blamed, fault)
        })?;
        if let Some(oddity) = oddity {
            let (warning, vertex) = WarningKind::of(oddity, entity.keyword);
            let span = || vertex.map_or(entity.span, |vertex| entity.span_of(place(vertex)));
            mistakes.warnings.push(warning, span);
        }
        Ok(())
    }

    /// Returns the surface that an object has: the last one before it.
    fn last_surface(&self, entity: &Entity<'_>) -> Result<u32, Diagnostic> {
        u32::try_from(self.scene.surfaces.len() - 1)
            .map_err(|_| entity.fault(0..0, Fault::TooLarge))
    }
}

fn sphere(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [x, y, z, radius] = entity.exactly(numbers)?;
    Ok(Shape::Sphere {
        centre: [x, y, z],
        radius: radius.abs(),
    })
}

fn cone(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [bx, by, bz, br, tx, ty, tz, tr] = entity.exactly(numbers)?;
    Ok(Shape::Cone {
        base: [bx, by, bz],
        base_radius: br.abs(),
        top: [tx, ty, tz],
        top_radius: tr.abs(),
    })
}

fn cuboid(entity: &Entity<'_>, numbers: &[f64]) -> Result<Shape, Diagnostic> {
    let [x, y, z, sx, sy, sz] = entity.exactly(numbers)?;
    Ok(Shape::Cuboid {
        centre: [x, y, z],
        size: [sx, sy, sz],
    })
}

/// Returns a polygon's numbers behind the number of vertices: `each` for every vertex.
fn announced<'n>(
    entity: &Entity<'_>,
    numbers: &'n [f64],
    each: usize,
) -> Result<&'n [f64], Diagnostic> {
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
    Ok(coordinates)
}
