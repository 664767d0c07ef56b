//! The parts that a scene has once: the camera, which is spread over several entities, the resolution and the
//! background.

use super::entity::Entity;
use crate::check::{self, Fault};
use crate::diagnostic::{Diagnostic, MistakeKind, Sink};
use crate::model::{Camera, Colour, Point, Projection, Scene};
use crate::word::{Keyword, Span};

/// The parts that have been read so far.
#[derive(Debug, Default)]
pub(super) struct Header {
    /// The position, if it follows `v` directly.
    viewpoint: Option<Part<Option<Point>>>,
    from: Option<Part<Point>>,
    at: Option<Part<Point>>,
    up: Option<Part<Point>>,
    angle: Option<Part<f64>>,
    hither: Option<Part<f64>>,
    projection: Option<Part<Projection>>,
    /// Width and height.
    resolution: Option<Part<[u32; 2]>>,
    /// The background, and the zenith if it is another.
    background: Option<Part<(Colour, Option<Colour>)>>,
    /// Whether the parser is inside the `v` of NFF, where a resolution has its width first.
    inside_nff: bool,
    /// The first resolution outside the `v` of NFF, and the first surface of the thesis.
    of_thesis: [Option<Span>; 2],
    /// Whether a part of the camera was wrong, so that the whole cannot be checked.
    invalid: bool,
}

#[derive(Clone, Copy, Debug)]
struct Part<T> {
    value: T,
    /// The place of its keyword.
    keyword: Span,
    /// The place of its numbers.
    numbers: Span,
}

impl Header {
    /// Notes that an entity begins: the `v` of NFF ends at the first keyword that does not belong to it.
    pub(super) fn pass(&mut self, keyword: Keyword) {
        self.inside_nff &= matches!(
            keyword,
            Keyword::From
                | Keyword::At
                | Keyword::Up
                | Keyword::Angle
                | Keyword::Hither
                | Keyword::Resolution
                | Keyword::View
        );
    }

    /// Notes that there was a `keyword` with a mistake.
    pub(super) fn mark_invalid(&mut self, keyword: Keyword, span: Span) {
        if keyword == Keyword::Viewpoint && self.viewpoint.is_none() {
            self.viewpoint = Some(Part {
                value: None,
                keyword: span,
                numbers: span,
            });
            self.inside_nff = true;
        }
        self.invalid |= matches!(
            keyword,
            Keyword::Viewpoint | Keyword::From | Keyword::At | Keyword::Up | Keyword::Angle
        );
    }

    /// Notes that there was a surface in the form of the thesis.
    pub(super) fn pass_surface_of_thesis(&mut self, span: Span) {
        self.of_thesis[1].get_or_insert(span);
    }

    /// Reports what is of the thesis if the viewpoint is NFF's: a file has one dialect.
    fn check_dialect(&self, mistakes: &mut Sink) {
        let is_nff = (self.viewpoint).is_some_and(|viewpoint| viewpoint.value.is_none());
        if self.invalid || !is_nff {
            return;
        }
        let keywords = [Keyword::Resolution, Keyword::Surface];
        for (keyword, span) in keywords.into_iter().zip(self.of_thesis) {
            if let Some(span) = span {
                mistakes.push(MistakeKind::MixedDialects { keyword }, span);
            }
        }
    }

    /// Stores the part that `entity` holds.
    pub(super) fn place(&mut self, entity: &Entity<'_>, numbers: &[f64]) -> Result<(), Diagnostic> {
        match entity.keyword {
            Keyword::Viewpoint => {
                let position = match *numbers {
                    [] => None,
                    [x, y, z] => Some([x, y, z]),
                    _ => return Err(entity.count(numbers, &[3])),
                };
                put(&mut self.viewpoint, position, entity, 2)?;
                self.inside_nff = position.is_none();
                Ok(())
            }
            Keyword::From => put(&mut self.from, entity.exactly(numbers)?, entity, 0),
            Keyword::At => put(&mut self.at, entity.exactly(numbers)?, entity, 0),
            Keyword::Up => put(&mut self.up, entity.exactly(numbers)?, entity, 0),
            Keyword::Angle => {
                let [angle] = entity.exactly(numbers)?;
                put(&mut self.angle, angle, entity, 0)
            }
            Keyword::Hither => {
                let [hither] = entity.exactly(numbers)?;
                put(&mut self.hither, hither, entity, 0)
            }
            Keyword::Resolution => {
                let sizes: [f64; 2] = entity.exactly(numbers)?;
                for (index, &size) in sizes.iter().enumerate() {
                    check::resolution(size)
                        .map_err(|fault| entity.fault(index..index + 1, fault))?;
                }
                let mut sizes = sizes.map(|size| size as u32);
                if !self.inside_nff {
                    sizes.reverse();
                    self.of_thesis[0].get_or_insert(entity.span);
                }
                put(&mut self.resolution, sizes, entity, 0)
            }
            Keyword::Background => {
                let colours = match *numbers {
                    [r, g, b] => ([r, g, b], None),
                    [r, g, b, zr, zg, zb] => ([r, g, b], Some([zr, zg, zb])),
                    _ => return Err(entity.count(numbers, &[3, 6])),
                };
                entity.not_negative(0, numbers)?;
                put(&mut self.background, colours, entity, 0)
            }
            _ => {
                let projection = entity.projection(numbers)?;
                put(&mut self.projection, projection, entity, 0)
            }
        }
    }

    /// Returns `scene` with these parts. Missing or contradictory ones are reported in `mistakes`.
    pub(super) fn finish(self, scene: Scene, end: Span, mistakes: &mut Sink) -> Scene {
        self.check_dialect(mistakes);
        let camera = self.camera(end).unwrap_or_else(|mistake| {
            // If a mistake ended reading, missing parts may be in the rest.
            if let Some(Diagnostic { kind, span }) = mistake.filter(|_| !mistakes.ends_reading()) {
                mistakes.push(kind, span);
            }
            scene.camera
        });
        let [width, height] = self
            .resolution
            .map_or([scene.width, scene.height], |resolution| resolution.value);
        let background = self.background.map(|background| background.value);
        let (background, zenith) = background.unwrap_or_default();
        Scene {
            camera,
            width,
            height,
            background,
            zenith,
            ..scene
        }
    }

    /// Returns the camera, or what is wrong with it unless that has been reported.
    fn camera(&self, end: Span) -> Result<Camera, Option<Diagnostic>> {
        let mistake = |span, kind| Some(Diagnostic { kind, span });
        let viewpoint = self
            .viewpoint
            .ok_or_else(|| mistake(end, MistakeKind::NoViewpoint))?;
        if self.invalid {
            return Err(None);
        }
        let projection = self
            .projection
            .map_or(Projection::Perspective, |view| view.value);
        let from = match (viewpoint.value, self.from) {
            (Some(_), Some(from)) => return Err(mistake(from.keyword, MistakeKind::TwoEyes)),
            (position, from) => position.or(from.map(|from| from.value)),
        };
        let camera = match (viewpoint.value, from, self.at, self.up, self.angle) {
            (Some(viewpoint), _, None, None, None) => Camera::Thesis {
                viewpoint,
                projection,
            },
            (_, Some(from), Some(at), Some(up), Some(angle)) => Camera::Nff {
                from,
                at: at.value,
                up: up.value,
                angle: angle.value,
                projection,
            },
            (_, from, at, up, angle) => {
                let parts = [
                    (from.is_some(), Keyword::From),
                    (at.is_some(), Keyword::At),
                    (up.is_some(), Keyword::Up),
                    (angle.is_some(), Keyword::Angle),
                ];
                let missing = parts.into_iter().filter(|part| !part.0).map(|part| part.1);
                let kind = MistakeKind::Incomplete {
                    missing: missing.collect(),
                };
                return Err(mistake(viewpoint.keyword, kind));
            }
        };
        check::camera(&camera).map_err(|fault| {
            let part = match fault {
                Fault::FromIsAt => self.at.map(|at| at.numbers),
                Fault::ZeroUp | Fault::UpParallel => self.up.map(|up| up.numbers),
                Fault::Angle => self.angle.map(|angle| angle.numbers),
                _ => None,
            };
            mistake(part.unwrap_or(viewpoint.numbers), MistakeKind::Fault(fault))
        })?;
        Ok(camera)
    }
}

/// Stores a part that must be empty. A later mistake in it refers to its numbers from `first` on.
fn put<T: Copy>(
    part: &mut Option<Part<T>>,
    value: T,
    entity: &Entity<'_>,
    first: usize,
) -> Result<(), Diagnostic> {
    if let Some(Part { keyword: first, .. }) = *part {
        let kind = MistakeKind::Duplicate {
            keyword: entity.keyword,
            first,
        };
        return Err(entity.mistake(0..0, kind));
    }
    let numbers = entity.span_of(first..first + 3);
    *part = Some(Part {
        value,
        keyword: entity.span,
        numbers,
    });
    Ok(())
}
