//! The sphere.

use core::marker::PhantomData;
use core::ops::Range;

use glam::DVec3;

use crate::algebraic::Quadratic;
use crate::arithmetic::pair::{Pair, two_difference};
use crate::arithmetic::rounding::RoundDown;
use crate::geometric::ClosestApproach;
use crate::root::chord::Derivation;
use crate::sealed::{Crate, Internal, Operation};
use crate::{Hit, Hittable, Ray, Vector, rejection};

/// A sphere: a center and a radius.
///
/// Whether a ray hits it is decided exactly, and the distance is correctly rounded. Its nearest hit and occlusion come from the
/// trait [`Hittable`], which must be in scope (`use eyeray::Hittable`).
///
/// ```
/// use eyeray::{Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let sphere = Sphere::new(vec3(0.0, 0.0, -4.0), 1.0);
/// let ray = Ray::new(Vec3::ZERO, vec3(0.0, 0.0, -2.0));
///
/// // The ray enters at z = -3, 1.5 lengths of its direction away, and leaves at z = -5.
/// assert_eq!(sphere.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(1.5));
/// assert_eq!(sphere.roots(&ray), Some([1.5, 2.5]));
/// ```
///
/// # What is promised
///
/// For all finite values of a ray's and a sphere's fields, in `f32` and in `f64`, with t for the exact real root of those values
/// as they are:
///
/// 1. Hit or miss is never wrong, and each root is t rounded to the nearest number of the format, ties to even, with overflow
///    to infinity and gradual underflow. So [`Algebraic`](crate::Algebraic) and [`Geometric`](crate::Geometric) give the same
///    roots, bit for bit, on every machine, with fused multiply-add or without.
/// 2. A line that touches the sphere hits it, with two equal roots. A sphere of radius 0 is hit if and only if the line goes
///    through its center.
/// 3. A NaN or an infinity in the ray or the sphere, a zero direction or a negative radius gives `None`. Nothing panics, and
///    no result is NaN.
/// 4. The direction need not be unit, and t counts in its lengths: of 2ᵏ times the direction, t is 2⁻ᵏ times as large,
///    exactly.
/// 5. A ray is a half-line: a hit is at the smallest root that, as returned, is finite, above 0 and in the range.
/// 6. Each coordinate of [`Hit::point`] is off by at most 0.51 ulp of itself, plus the smaller of 2⁻³⁰ of the distance travelled
///    (t times the direction's length) and 2⁻²⁴ of the radius; with `DVec3`, these are 2⁻⁶⁰ and 2⁻⁵³. Instead of 0.51 ulp it is 1
///    ulp where the coordinate is subnormal or, in `f64`, below 2⁻⁸⁴⁸. Each coordinate of [`Hit::normal`], the outward unit
///    normal, is off by at most 2 ulp of 1; at radius 0, where there is none, it points back along the ray.
/// 7. A ray of [`Hit::spawn`] never hits the surface that it leaves, if the radius is at least 1,000 ulp of the coordinates of
///    the point. It starts no farther from it than stated at [`spawn`](Hit::spawn).
/// 8. Of many spheres, the one returned is that whose exact root is least among those accepted by point 5, also where distances
///    round to the same number; of equal exact roots, the one of the lowest index: [`nearest`](crate::nearest) tells among what.
///
/// # How
///
/// `intersect` uses the quadratic formula, as [`Algebraic`](crate::Algebraic) does, in `f64` and with a bound on its error. Where
/// that decides the hit, and both ends of the interval around the root round to the same number (Ziv's test), that is the answer.
/// Otherwise more exact arithmetic takes over, step by step: `f64` with a bound on the error of the case at hand, then pairs of
/// `f64`, and integers where pairs do not decide either.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Sphere<V: Vector = glam::Vec3> {
    /// The center.
    pub center: V,
    /// The radius. A sphere of radius 0 is a point. No ray hits a sphere with a negative radius.
    pub radius: V::Scalar,
}

impl<V: Vector> Sphere<V> {
    /// Creates a sphere. Any value is allowed.
    #[inline]
    #[must_use]
    pub const fn new(center: V, radius: V::Scalar) -> Self {
        Self { center, radius }
    }

    /// Returns the axis-aligned bounding box: its lowest and its highest corner, each coordinate rounded outwards.
    ///
    /// The box of a sphere with a negative radius, a NaN or an infinity, which no ray hits, is empty: from +∞ to -∞.
    ///
    /// ```
    /// use eyeray::Sphere;
    /// use glam::{Vec3, vec3};
    ///
    /// let sphere = Sphere::new(vec3(0.5, 1.0, 1e10), 0.1);
    /// let (low, high) = sphere.bounds();
    ///
    /// // 1e10 ± 0.1 lies between the neighbors of 1e10, which are 1,024 away.
    /// assert_eq!((low.z, high.z), (1e10 - 1024.0, 1e10 + 1024.0));
    /// assert!(f64::from(low.x) <= 0.5 - f64::from(sphere.radius));
    /// assert!(f64::from(high.x) >= 0.5 + f64::from(sphere.radius));
    /// ```
    #[must_use]
    pub fn bounds(&self) -> (V, V) {
        V::perform(Bounds(self))
    }

    /// Returns both roots along the whole line, ascending, behind the origin too. `None` where the line misses.
    ///
    /// Use this one: it takes the faster of the two derivations. [`roots_algebraic`](Self::roots_algebraic) and
    /// [`roots_geometric`](Self::roots_geometric) return the same, bit for bit, and are for comparing them.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere};
    /// use glam::Vec3;
    ///
    /// let sphere = Sphere::new(Vec3::ZERO, 1.0);
    /// let ray = Ray::new(Vec3::Z * 3.0, Vec3::NEG_Z);
    /// assert_eq!(sphere.roots(&ray), Some([2.0, 4.0]));
    ///
    /// // A ray starts inside a sphere if and only if its roots lie on either side of 0.
    /// let is_inside = |[near, far]: [f32; 2]| near < 0.0 && 0.0 < far;
    /// assert_eq!(sphere.roots(&ray).map(is_inside), Some(false));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn roots(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        self.roots_by::<Quadratic>(ray)
    }

    /// Returns both roots along the whole line, ascending, behind the origin too, by the quadratic formula: see
    /// [`Algebraic`](crate::Algebraic). `None` where the line misses.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere};
    /// use glam::{DVec3, dvec3};
    ///
    /// let sphere = Sphere::new(DVec3::ZERO, 5.0);
    /// let ray = Ray::new(dvec3(1.0, 3.0, 0.0), dvec3(2.0, 0.0, 0.0));
    /// assert_eq!(sphere.roots_algebraic(&ray), Some([-2.5, 1.5]));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn roots_algebraic(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        self.roots_by::<Quadratic>(ray)
    }

    /// Returns both roots along the whole line, ascending, behind the origin too, by the closest approach: see
    /// [`Geometric`](crate::Geometric). `None` where the line misses.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere};
    /// use glam::{DVec3, dvec3};
    ///
    /// // The line touches the sphere: two equal roots.
    /// let sphere = Sphere::new(DVec3::ZERO, 5.0);
    /// let ray = Ray::new(dvec3(-6.0, 5.0, 0.0), dvec3(2.0, 0.0, 0.0));
    /// assert_eq!(sphere.roots_geometric(&ray), Some([3.0, 3.0]));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn roots_geometric(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        self.roots_by::<ClosestApproach>(ray)
    }

    /// Returns where the ray leaves the sphere, if `t` > 0 and in `range` there. `None` also where the line misses.
    ///
    /// [`intersect`](Hittable::intersect) returns where the ray enters or, from inside, leaves. The two together give what the
    /// ray passes through of the sphere, with both points and normals, as constructive solid geometry needs it. The normal is
    /// outward here, too.
    ///
    /// A line that touches the sphere leaves it where it enters. From far away, both `t` may be equal also where the line passes
    /// through: the point and the normal are then still those of the exit.
    ///
    /// ```
    /// use eyeray::{Hittable, Ray, Sphere};
    /// use glam::{DVec3, dvec3};
    ///
    /// let all = 0.0..f64::INFINITY;
    /// let sphere = Sphere::new(DVec3::ZERO, 1.0);
    /// let ray = Ray::new(dvec3(0.0, 0.0, 3.0), DVec3::NEG_Z);
    /// let exit = sphere.exit(&ray, all.clone());
    /// assert_eq!(exit.map(|exit| (exit.t, exit.normal)), Some((4.0, DVec3::NEG_Z)));
    ///
    /// // From 1e17 away, 2 is less than the distance between two numbers.
    /// let far_away = Ray::new(dvec3(0.0, 0.0, 1e17), DVec3::NEG_Z);
    /// let entry = sphere.intersect(&far_away, all.clone());
    /// let exit = sphere.exit(&far_away, all);
    /// assert_eq!(entry.map(|entry| (entry.t, entry.point)), Some((1e17, DVec3::Z)));
    /// assert_eq!(exit.map(|exit| (exit.t, exit.point)), Some((1e17, DVec3::NEG_Z)));
    /// ```
    #[must_use]
    pub fn exit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        let [near, far] = self.roots(ray)?;
        if !range.contains(&far) {
            None
        } else if near < far {
            self.intersect(ray, far..range.end)
        } else {
            V::perform(ExitAtSameT { sphere: self, ray })
        }
    }

    /// Where the ray meets the sphere first, by that derivation.
    #[inline(always)]
    pub(crate) fn intersect_by<D: Derivation>(
        &self,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<Hit<V>> {
        V::perform(Intersection { sphere: self, ray, range, derivation: PhantomData::<D> })
    }

    /// Both roots, by that derivation.
    #[inline(always)]
    fn roots_by<D: Derivation>(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        V::perform(Roots { sphere: self, ray, derivation: PhantomData::<D> })
    }
}

impl<V: Vector> Hittable<V> for Sphere<V> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        // The faster of the two derivations where neither is in doubt.
        self.intersect_by::<Quadratic>(ray, range)
    }

    #[inline(always)]
    fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        rejection::may_hit(self, ray, range)
    }

    #[inline(always)]
    fn as_sphere(&self) -> Option<Sphere<V>> {
        Some(*self)
    }

    #[inline(always)]
    fn may_hit_four(objects: &[Self; 4], ray: &Ray<V>, range: Range<V::Scalar>, _: Crate) -> u32 {
        rejection::may_hit_four(objects.each_ref(), ray, range)
    }
}

/// [`Sphere::intersect_by`].
struct Intersection<'a, V: Vector, D> {
    sphere: &'a Sphere<V>,
    ray: &'a Ray<V>,
    range: Range<V::Scalar>,
    derivation: PhantomData<D>,
}

impl<V: Vector, D: Derivation> Operation<V> for Intersection<'_, V, D> {
    type Output = Option<Hit<V>>;

    #[inline(always)]
    fn run(self) -> Option<Hit<V>>
    where
        V: Internal,
    {
        V::intersect::<D>(self.sphere, self.ray, self.range)
    }
}

/// [`Sphere::exit`] where both roots round to the same number.
struct ExitAtSameT<'a, V: Vector> {
    sphere: &'a Sphere<V>,
    ray: &'a Ray<V>,
}

impl<V: Vector> Operation<V> for ExitAtSameT<'_, V> {
    type Output = Option<Hit<V>>;

    fn run(self) -> Option<Hit<V>>
    where
        V: Internal,
    {
        V::exit_at_same_t(self.sphere, self.ray)
    }
}

/// [`Sphere::roots_by`].
struct Roots<'a, V: Vector, D> {
    sphere: &'a Sphere<V>,
    ray: &'a Ray<V>,
    derivation: PhantomData<D>,
}

impl<V: Vector, D: Derivation> Operation<V> for Roots<'_, V, D> {
    type Output = Option<[V::Scalar; 2]>;

    #[inline(always)]
    fn run(self) -> Option<[V::Scalar; 2]>
    where
        V: Internal,
    {
        V::roots::<D>(self.sphere, self.ray)
    }
}

/// [`Sphere::bounds`].
struct Bounds<'a, V: Vector>(&'a Sphere<V>);

impl<V: Vector> Operation<V> for Bounds<'_, V> {
    type Output = (V, V);

    fn run(self) -> (V, V)
    where
        V: Internal,
    {
        let Self(sphere) = self;
        let center = sphere.center.to_f64();
        let radius: f64 = sphere.radius.into();
        if !(center.is_finite() && (0.0..f64::INFINITY).contains(&radius)) {
            return (V::from_f64(DVec3::INFINITY), V::from_f64(DVec3::NEG_INFINITY));
        }
        // Upwards is downwards in the mirror.
        let round_down = |center: DVec3| {
            V::from_f64(DVec3::from_array(center.to_array().map(|c| {
                let Pair { hi, lo } = two_difference(c, radius);
                V::Scalar::round_down(hi, lo).into()
            })))
        };
        (round_down(center), -round_down(-center))
    }
}
