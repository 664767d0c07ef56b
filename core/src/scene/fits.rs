//! Whether a scene whose objects move is still in the room that its numbers leave.

use super::Scene;
use crate::camera::Camera;
use crate::features::FeatureSet;
use crate::object::ObjectRef;
use crate::quantize::Quantize;
use crate::ray::Aabb;
use crate::vec3::{Axis, Vec3};
use core::fmt::{self, Display, Formatter};

/// What is outside of the room of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OutOfRoom {
    /// An object.
    Object(ObjectRef),
    /// A light, by its place in [`Scene::lights`].
    Light(usize),
    /// A place where rays of the camera start.
    Viewpoint,
    /// Nothing alone, but two things are farther apart than [`Scene::diameter`].
    Diameter,
}

impl Display for OutOfRoom {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Object(object) => {
                let (kind, index) = (object.kind(), object.index());
                write!(f, "{kind:?} {index} is outside of the scene's room")
            }
            Self::Light(index) => write!(f, "light {index} is outside of the scene's room"),
            Self::Viewpoint => f.write_str("the viewpoint is outside of the scene's room"),
            Self::Diameter => f.write_str("the scene is larger than its diameter"),
        }
    }
}

impl core::error::Error for OutOfRoom {}

impl<S: Quantize, const FEATURES: FeatureSet> Scene<'_, S, FEATURES> {
    /// Whether the scene, seen by this camera, fits its room: no number of its rendering overflows, and no hit is beyond
    /// its diameter. What is moved is to be checked before the picture is rendered; in fixed point a picture of a scene
    /// that does not fit is wrong. Whether an object is in the [active region](crate::frame::Frame::active) of a picture
    /// is another question.
    ///
    /// No coordinate may be farther from the origin than half of [`Scene::diameter`] in fixed point, and in no format two
    /// points of objects, near lights and viewpoint farther apart than it.
    ///
    /// # Errors
    /// What is outside.
    pub fn fits(&self, camera: &Camera<S>) -> Result<(), OutOfRoom> {
        let slack = self.shapes.slack;
        // Boxes are wider than their shapes.
        let margin = slack + slack;
        let reach = match S::FRACTION_BITS {
            Some(_) => self.diameter * S::ratio(1, S::whole_reciprocal(2)) + margin,
            None => S::MAX,
        };
        let point = |p: Vec3<S>| Aabb { low: p, high: p };
        let mut all: Option<Aabb<S>> = None;
        let mut include = |part: Aabb<S>, name| {
            // Not a number is outside, too.
            let is_inside = |p: Vec3<S>| p.to_array().iter().all(|x| x.abs() <= reach);
            if !is_inside(part.low) || !is_inside(part.high) {
                return Err(name);
            }
            let all = all.get_or_insert(part);
            for axis in Axis::ALL {
                all.low[axis] = all.low[axis].min(part.low[axis]);
                all.high[axis] = all.high[axis].max(part.high[axis]);
            }
            Ok(())
        };
        for object in self.shapes.refs() {
            include(self.shapes.bounds(object), OutOfRoom::Object(object))?;
        }
        for (i, light) in self.lights.iter().enumerate() {
            if light.parallax.is_none() {
                include(point(light.position), OutOfRoom::Light(i))?;
            }
        }
        for start in camera.starts() {
            include(point(start), OutOfRoom::Viewpoint)?;
        }
        let all = all.unwrap_or_default();
        let apart = (all.high - all.low).square_wide();
        if apart <= (self.diameter + margin + margin).square() {
            Ok(())
        } else {
            Err(OutOfRoom::Diameter)
        }
    }
}
