//! The five kinds of shape: each says where a ray meets it, what box it lies in, and what its
//! surface is like at a point.
//!
//! A hit counts only if the computed point lies in the shape's own box. That makes a hit, in any
//! arithmetic however coarse, something that a tree of boxes cannot miss. For spheres and boxes in
//! arithmetics whose [hits lie within the slack](crate::scalar::Tolerance::HITS_WITHIN_SLACK) it
//! goes without asking.

mod bands;
mod cone;
mod cone_of;
mod contact;
mod cuboid;
mod ends;
mod even_odd;
mod patch;
mod plane;
mod polygon;
mod shapes;
mod sphere;
mod triangle;

pub use bands::{Bands, Outlines};
pub use cone::Cone;
pub use cone_of::cone_box;
pub use contact::Contact;
pub use cuboid::Cuboid;
pub(crate) use even_odd::encloses;
pub use patch::Patch;
pub use plane::Plane;
pub use polygon::Polygon;
pub use shapes::Shapes;
pub use sphere::Sphere;
pub use triangle::Triangle;
