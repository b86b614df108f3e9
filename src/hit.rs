//! Where a ray meets a surface, and the rays that leave from there.

use crate::{Ray, Vector};

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<V: Vector = glam::Vec3> {
    /// The distance along the ray, in lengths of its direction.
    pub t: V::Scalar,
    /// The point of the surface.
    pub point: V,
    /// The outward unit normal there.
    pub normal: V,
    /// How far along the normal a spawned ray starts from `point`.
    pub(crate) clearance: V::Scalar,
}

impl<V: Vector> Hit<V> {
    /// Whether the ray meets the surface from outside, against the normal.
    #[inline]
    pub fn front_face(&self, ray: &Ray<V>) -> bool {
        ray.direction.dot(self.normal) < V::Scalar::default()
    }

    /// A ray that leaves the surface here along `direction`, to whichever side that points.
    #[inline]
    #[must_use]
    pub fn spawn(&self, direction: V) -> Ray<V> {
        let outwards = direction.dot(self.normal) >= V::Scalar::default();
        let clearance = if outwards { self.clearance } else { -self.clearance };
        Ray::new(self.point + self.normal * clearance, direction)
    }
}
