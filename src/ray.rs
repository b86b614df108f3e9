//! A ray: the half-line `r(t) = p + t d`, t > 0.

use crate::Vector;

/// A ray, `r(t) = p + t d` for t > 0: a half-line from its origin p along its direction d.
///
/// Rays are used to see (the eye rays of a [`Camera`](crate::Camera)), to pick what is below the mouse, to test whether something
/// is in the line of sight (shadow rays), and to follow light that is reflected or refracted
/// ([`Hit::spawn`](crate::Hit::spawn)).
///
/// The direction need not be a unit vector. Every distance `t` along a ray counts in lengths of its direction: scaling the
/// direction by a > 0 leaves the half-line as it is and divides every `t` by a.
///
#[doc = include_str!("diagrams/ray.svg")]
///
/// Any value is allowed in the fields. A ray with a NaN, an infinity or a zero direction hits nothing.
///
/// ```
/// use eyeray::Ray;
/// use glam::vec3;
///
/// let ray = Ray::new(vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, -2.0));
/// assert_eq!(ray.at(1.5), vec3(0.0, 1.0, -3.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Ray<V: Vector = glam::Vec3> {
    /// The point where the ray starts.
    pub origin: V,
    /// The direction, whose length is the unit of distances along the ray.
    pub direction: V,
}

impl<V: Vector> Ray<V> {
    /// Creates the ray from `origin` along `direction`.
    #[inline]
    #[must_use]
    pub const fn new(origin: V, direction: V) -> Self {
        Self { origin, direction }
    }

    /// Returns the point `origin + t direction`, computed in the precision of `V`.
    ///
    /// Where a ray hits a surface, [`Hit::point`](crate::Hit::point) is more accurate: it is computed in more digits from a `t`
    /// that is not rounded yet, and each coordinate is rounded once.
    #[inline]
    #[must_use]
    #[doc(alias("point_at", "get_point"))]
    pub fn at(&self, t: V::Scalar) -> V {
        self.origin + self.direction * t
    }
}
