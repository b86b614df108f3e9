//! Where a ray meets a surface, and the rays that leave from there.

use glam::DVec3;

use crate::{Ray, Vector};

/// Where a ray meets a surface.
///
/// ```
/// use eyeray::{Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let sphere = Sphere::new(Vec3::ZERO, 1.0);
/// let ray = Ray::new(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, -1.0));
///
/// if let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) {
///     assert_eq!(hit.t, 2.0);
///     assert_eq!(hit.point, vec3(0.0, 0.0, 1.0));
///     assert_eq!(hit.normal, vec3(0.0, 0.0, 1.0));
///     assert!(hit.front_face(&ray));
///
///     // A mirror image of the ray leaves for good: nothing to tune.
///     let reflected = hit.spawn(ray.direction.reflect(hit.normal));
///     assert!(sphere.intersect(&reflected, 0.0..f32::INFINITY).is_none());
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit<V: Vector = glam::Vec3> {
    /// The distance along the ray, in lengths of its direction.
    pub t: V::Scalar,
    /// The point of the surface.
    pub point: V,
    /// The outward unit normal there, whichever side the ray comes from.
    pub normal: V,
    /// How far along the normal a spawned ray starts from `point`.
    pub(crate) clearance: V::Scalar,
}

impl<V: Vector> Hit<V> {
    /// A hit on a surface of your own.
    ///
    /// `clearance` is how far along the normal, to one side or the other, the rays of [`spawn`](Self::spawn) start: more
    /// than `point` is off, so that they start on the side that they leave to.
    ///
    /// ```
    /// use core::ops::Range;
    /// use eyeray::{Hit, Hittable, Ray};
    /// use glam::Vec3;
    ///
    /// /// The plane y = 0.
    /// struct Floor;
    ///
    /// impl Hittable for Floor {
    ///     fn intersect(&self, ray: &Ray, range: Range<f32>) -> Option<Hit> {
    ///         let t = -ray.origin.y / ray.direction.y;
    ///         let point = ray.at(t).with_y(0.0);
    ///         // Ahead, whatever the range says, and finite: not along the floor.
    ///         let is_hit = t > 0.0 && range.contains(&t) && point.is_finite();
    ///         is_hit.then(|| Hit::new(t, point, Vec3::Y, f32::EPSILON))
    ///     }
    /// }
    ///
    /// let ray = Ray::new(Vec3::Y, Vec3::NEG_Y);
    /// assert_eq!(Floor.intersect(&ray, 0.0..2.0).map(|hit| hit.t), Some(1.0));
    ///
    /// // It lies behind this ray, which looks up, and that one leaves it.
    /// let (up, leaving) = (Ray::new(Vec3::Y, Vec3::Y), Ray::new(Vec3::ZERO, Vec3::Y));
    /// assert!([up, leaving].iter().all(|ray| !Floor.occludes(ray, -2.0..2.0)));
    /// ```
    #[inline]
    pub const fn new(t: V::Scalar, point: V, normal: V, clearance: V::Scalar) -> Self {
        Self { t, point, normal, clearance }
    }

    /// Whether `ray` meets the surface from outside, against the normal.
    #[inline]
    pub fn front_face(&self, ray: &Ray<V>) -> bool {
        self.outwards(ray.direction) < 0.0
    }

    /// A ray that leaves the surface here along `direction`: outwards where that points to the side of the normal or along
    /// the surface, inwards otherwise.
    ///
    /// A ray that leaves a [`Sphere`](crate::Sphere) outwards never meets it again, and one that goes inwards meets its far
    /// wall, if the radius is at least 1,000 ulp of the sphere's coordinates: the ray starts a little off the surface on the
    /// side that it leaves to, by a distance taken from the bounds on all rounding errors. So every range can begin at 0.
    ///
    /// Source: C. Wächter and N. Binder, *A Fast and Robust Method for Avoiding Self-Intersection*, Ray Tracing Gems,
    /// chapter 6, for the idea of an offset along the normal that follows from the errors instead of from the scene.
    #[inline]
    #[must_use]
    pub fn spawn(&self, direction: V) -> Ray<V> {
        let clearance =
            if self.outwards(direction) < 0.0 { -self.clearance } else { self.clearance };
        Ray::new(self.point + self.normal * clearance, direction)
    }

    /// Has the sign of `direction`·normal.
    #[inline]
    fn outwards(&self, direction: V) -> f64 {
        // So that even products of subnormal numbers do not vanish, nor those of the largest overflow.
        const SMALL: f64 = 1e-30;
        let direction: DVec3 = direction.to_f64();
        let scale = if direction.abs().max_element() < SMALL { SMALL.recip() } else { 0.25 };
        (direction * scale).dot(self.normal.to_f64())
    }
}
