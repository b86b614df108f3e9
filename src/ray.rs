//! A ray: the half line `r(t) = p + t d`, t > 0.

use crate::Vector;

/// A ray, the half line `r(t) = p + t d` for t > 0, with p the [`origin`](Self::origin) and d the
/// [`direction`](Self::direction).
///
/// The direction need not be unit. Every distance `t` along a ray counts in lengths of its direction, so scaling the
/// direction by a > 0 leaves the half line as it is and divides every `t` by a.
///
#[doc = include_str!("diagrams/ray.svg")]
///
/// Any value is allowed in the fields. A ray with a NaN, an infinity or a zero direction meets nothing.
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
pub struct Ray<V = glam::Vec3> {
    /// Where the ray starts: the lecture's p.
    pub origin: V,
    /// Where it goes, and the unit in which distances along it count: the lecture's d.
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
    /// Where a ray hits a surface, [`Hit::point`](crate::Hit::point) is more accurate: it is computed in more digits from a `t` that
    /// is not rounded yet, and each coordinate is rounded once.
    #[inline]
    #[must_use]
    #[doc(alias("point_at", "get_point"))]
    pub fn at(&self, t: V::Scalar) -> V {
        self.origin + self.direction * t
    }
}
