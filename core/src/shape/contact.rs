//! A surface at the point where a ray meets it.

use crate::vec3::Vec3;

/// What a surface is like at the point where a ray meets it.
#[derive(Clone, Copy, Debug)]
pub struct Contact<S> {
    /// The point, refined onto the surface.
    pub point: Vec3<S>,
    /// The surface's own unit normal: outward for closed shapes, either way for flat ones.
    pub outward: Vec3<S>,
    /// The size of a curved shape, 0 for a flat one; see
    /// [`Tolerance::surface_error`](crate::scalar::Tolerance::surface_error).
    pub curvature_extent: S,
    /// Whether the shape has an inside.
    pub closed: bool,
}
