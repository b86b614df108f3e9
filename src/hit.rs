//! The hit: where a ray meets a surface, and the rays that leave from there.

mod sign;

use core::fmt::{self, Debug, Formatter};

use crate::arithmetic::rounding::RoundDown;
use crate::sealed::{Internal, Operation};
use crate::{Ray, Scalar, Vector};

/// A hit of a ray on a surface: the distance, the point and the normal.
///
/// [`Hittable::intersect`](crate::Hittable::intersect) returns it, and [`spawn`](Self::spawn) creates the rays that leave from
/// it.
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
///     // The reflected ray does not hit the sphere again, with no epsilon to tune.
///     let reflected = hit.spawn(ray.direction.reflect(hit.normal));
///     assert!(sphere.intersect(&reflected, 0.0..f32::INFINITY).is_none());
/// }
/// ```
#[derive(Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit<V: Vector = glam::Vec3> {
    /// The distance along the ray, in lengths of its direction.
    pub t: V::Scalar,
    /// The point of intersection.
    pub point: V,
    /// The outward unit normal at the point, also if the ray comes from inside.
    pub normal: V,
    /// A bound on the error of the point, without the final rounding of its coordinates.
    pub(crate) error: V::Scalar,
}

impl<V: Vector> Hit<V> {
    /// Creates a hit, for an implementation of [`Hittable`](crate::Hittable).
    ///
    /// `error` is a bound on the distance of `point` from the surface, without the final rounding of its coordinates. The rays of
    /// [`spawn`](Self::spawn) start at the distance `error` plus a few ulp from `point`, along the normal, so that they start on
    /// the side to which they leave.
    ///
    /// - On the plane y = h, set the point's y to h: it is on the plane, and `error` is 0. On any other plane, the distance of
    ///   `point` from it, computed in `f64`, is an `error`.
    /// - An instance, a shape with a transform, asks the shape with the ray brought into the shape's coordinates, the direction
    ///   not normalized: then t is the same. Transform the point and the normal back, normalize the normal, and take
    ///   [`clearance`](Self::clearance) times the largest scale of the transform for `error`, and some ulp of the largest
    ///   coordinate of the transform's translation and of the point more.
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
    ///         // A hit is ahead, whatever the range, and finite: a ray along the floor has none.
    ///         let is_hit = t > 0.0 && range.contains(&t) && point.is_finite();
    ///         is_hit.then(|| Hit::new(t, point, Vec3::Y, 0.0))
    ///     }
    /// }
    ///
    /// let ray = Ray::new(Vec3::Y, Vec3::NEG_Y);
    /// assert_eq!(Floor.intersect(&ray, 0.0..2.0).map(|hit| hit.t), Some(1.0));
    ///
    /// // A ray that points away from the floor does not hit it, nor one that starts on it.
    /// let (up, leaving) = (Ray::new(Vec3::Y, Vec3::Y), Ray::new(Vec3::ZERO, Vec3::Y));
    /// assert!([up, leaving].iter().all(|ray| !Floor.occludes(ray, -2.0..2.0)));
    /// ```
    #[inline]
    #[must_use]
    pub const fn new(t: V::Scalar, point: V, normal: V, error: V::Scalar) -> Self {
        Self { t, point, normal, error }
    }

    /// Returns whether `ray` hits the surface from outside, against the normal.
    #[inline]
    #[must_use]
    pub fn front_face(&self, ray: &Ray<V>) -> bool {
        self.outwards(ray.direction) < 0.0
    }

    /// Returns whether `direction` points outwards, to the side of the normal.
    ///
    /// This is the side on which [`spawn`](Self::spawn) starts a ray along `direction`. It follows from the sign of the exact dot
    /// product with [`normal`](Self::normal), which neither rounding nor underflow changes. A direction at a right angle to the
    /// normal counts as outward, one with a NaN does not. Use this instead of `direction.dot(hit.normal) > 0.0` to tell
    /// reflection from refraction, or which medium a ray enters.
    ///
    /// ```
    /// use eyeray::{Hittable, Ray, Sphere};
    /// use glam::Vec3;
    ///
    /// let ray = Ray::new(Vec3::Z * 3.0, Vec3::NEG_Z);
    /// if let Some(hit) = Sphere::new(Vec3::ZERO, 1.0).intersect(&ray, 0.0..f32::INFINITY) {
    ///     assert!(hit.is_outward(ray.direction.reflect(hit.normal)));
    ///     assert!(!hit.is_outward(ray.direction));
    /// }
    /// ```
    #[inline]
    #[must_use]
    pub fn is_outward(&self, direction: V) -> bool {
        self.outwards(direction) >= 0.0
    }

    /// Returns the distance from `point`, along the normal, at which the rays of [`spawn`](Self::spawn) start.
    ///
    /// It is the bound on the error of `point` plus 4 ulp of its largest coordinate. If either is infinite or NaN, the clearance
    /// is 0, and the rays start at `point` itself.
    #[inline]
    #[must_use]
    pub fn clearance(&self) -> V::Scalar {
        // With x the largest coordinate of the point, an ulp of x is at most an ulp of 1 times x. The rounding of the point is
        // half an ulp a coordinate, that of the spawned origin as much, or one where it passes a power of two: together at most
        // 1.51 √3 < 2.7 ulp of distance. Where an ulp is no smaller than the smallest numbers, there are 4 of these.
        let largest = V::Scalar::from_f64(self.point.to_f64().abs().max_element());
        let [four_ulps, four_least] = V::perform(LastPlaces).map(|x| V::Scalar::from_f64(4.0 * x));
        let clearance = largest * four_ulps + (self.error + four_least);
        // An infinite one times a zero of the normal would be NaN.
        if clearance < V::Scalar::INFINITY { clearance } else { V::Scalar::ZERO }
    }

    /// Creates a ray that leaves the surface here along `direction`: a reflected, refracted or shadow ray.
    ///
    /// The ray starts at a distance of [`clearance`](Self::clearance) from [`point`](Self::point), outside if the direction
    /// [is outward](Self::is_outward), otherwise inside. So rounding errors do not make it hit the surface that it leaves
    /// (self-intersection, shadow acne), and its range can begin at 0, with no epsilon to tune.
    ///
    /// # Clearance
    ///
    /// On a [`Sphere`](crate::Sphere), a ray that leaves outwards starts strictly outside and never hits that sphere again, and
    /// one that goes inwards starts strictly inside and hits its far wall, if the radius is at least 1,000 ulp of the coordinates
    /// of the point. The clearance follows from the bounds on all rounding errors. It is at most 32 times the sum of an ulp of
    /// the largest coordinate of the point and the smaller of 2⁻³² of the distance travelled and 2⁻²⁴ of the radius, and 2⁻⁴⁷ of
    /// the radius more (with `DVec3` 2⁻⁶², 2⁻⁵³ and 2⁻¹⁰²). So on a ground of radius 1,000 or on a planet it is a few ulp of the
    /// point's coordinates. A ray can miss what is closer to the surface than the clearance: rays that leave a ground within some
    /// 10⁻⁴ of the point (100, 0, 0) can miss a ball that touches the ground there.
    ///
    /// None of this holds where `t` leaves the range of the floats: a radius of 1e-40 hit along a direction of length 1e15 has a
    /// `t` that is rounded to a few bits or to 0, and a radius of 1e37 along a direction of length 1e-20 has none.
    ///
    /// Source: C. Wächter and N. Binder, *A Fast and Robust Method for Avoiding Self-Intersection*, Ray Tracing Gems,
    /// chapter 6, for the idea of an offset along the normal that follows from the errors instead of from the scene.
    #[inline]
    #[must_use]
    #[doc(alias("self_intersection", "offset_ray_origin", "spawn_ray"))]
    pub fn spawn(&self, direction: V) -> Ray<V> {
        let clearance = self.clearance();
        let clearance = if self.is_outward(direction) { clearance } else { -clearance };
        Ray::new(self.point + self.normal * clearance, direction)
    }

    /// Returns a number with the sign of `direction`·normal.
    #[inline]
    fn outwards(&self, direction: V) -> f64 {
        sign::of_dot(direction.to_f64(), self.normal.to_f64())
    }
}

impl<V: Vector> Debug for Hit<V> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { t, point, normal, .. } = self;
        f.debug_struct("Hit")
            .field("t", t)
            .field("point", point)
            .field("normal", normal)
            .finish_non_exhaustive()
    }
}

/// An ulp of 1, and the smallest number above 0.
struct LastPlaces;

impl<V> Operation<V> for LastPlaces {
    type Output = [f64; 2];

    #[inline(always)]
    fn run(self) -> [f64; 2]
    where
        V: Internal,
    {
        [V::Scalar::UNIT_ULP, V::Scalar::LEAST_POSITIVE]
    }
}
