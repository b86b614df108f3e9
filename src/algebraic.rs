//! Ray and sphere, algebraically: put the ray into the sphere's equation and solve for t.

use core::ops::Range;

use crate::arithmetic::number::{Number, Triple};
use crate::root::chord::{Chord, Derivation};
use crate::{Hit, Hittable, Ray, Sphere, Vector, rejection};

/// A sphere met by the algebraic derivation.
///
/// A point x is on the sphere where `(x - c)·(x - c) = r²`, and on the ray where `x = p + t d`. Together, with `o = c - p`,
///
/// ```text
/// (t d - o)·(t d - o) = r²
/// (d·d) t² - 2 (d·o) t + (o·o - r²) = 0
/// t = (d·o ± √discriminant) / d·d,   discriminant = (d·o)² - (d·d) (o·o - r²)
/// ```
///
/// The direction is not assumed to be unit. In `f32` the roots are the same, bit for bit, as those of
/// [`Geometric`](crate::Geometric): what is promised is stated at [`Sphere`].
///
/// Source: S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*.
///
/// ```
/// use eyeray::{Algebraic, Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let sphere = Algebraic(Sphere::new(Vec3::ZERO, 1.0));
/// let ray = Ray::new(vec3(0.0, 0.0, 5.0), vec3(0.0, 0.0, -2.0));
/// assert_eq!(sphere.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(2.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "Sphere<V>: serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "Sphere<V>: serde::Deserialize<'de>")))]
#[repr(transparent)]
pub struct Algebraic<V: Vector = glam::Vec3>(pub Sphere<V>);

impl<V: Vector> Hittable<V> for Algebraic<V> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        V::intersect::<Quadratic>(&self.0, ray, range)
    }

    #[inline(always)]
    fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        rejection::may_hit(&self.0, ray, range.end)
    }

    #[inline(always)]
    fn may_hit_four(objects: &[Self; 4], ray: &Ray<V>, range: Range<V::Scalar>) -> u32 {
        rejection::may_hit_four(objects.each_ref().map(|Self(sphere)| sphere), ray, range.end)
    }
}

/// The algebraic derivation.
#[derive(Debug)]
pub(crate) enum Quadratic {}

impl Derivation for Quadratic {
    #[inline(always)]
    fn chord<N: Number>(o: Triple<N>, d: Triple<N>, radius_squared: N) -> Chord<N> {
        // The coefficients of a t² - 2 h t + power = 0.
        let a = d.dot(d);
        let h = d.dot(o);
        let distance_squared = o.dot(o);
        let power = distance_squared - radius_squared;

        let discriminant = h * h - a * power;
        Chord { a, h, distance_squared, power, discriminant }
    }
}
