//! The algebraic derivation: the ray in the equation of the sphere, solved for t by the quadratic formula.

use core::ops::Range;

use crate::arithmetic::number::{Number, Triple};
use crate::root::chord::{Chord, Derivation};
use crate::sealed::Crate;
use crate::{Hit, Hittable, Ray, Sphere, Vector, rejection};

/// A sphere whose roots are found by the quadratic formula: the algebraic derivation.
///
/// A point x is on the sphere with center c and radius r if `(x - c)·(x - c) = r²`, and on the ray with origin p and direction d
/// if
/// `x = p + t d`. Together, with `o = c - p`,
///
/// ```text
/// (t d - o)·(t d - o) = r²
/// (d·d) t² - 2 (d·o) t + (o·o - r²) = 0
/// t = (d·o ± √discriminant) / d·d,   discriminant = (d·o)² - (d·d) (o·o - r²)
/// ```
///
/// The direction need not be a unit vector. The roots are the same as those of [`Geometric`](crate::Geometric), bit for bit:
/// [`Sphere`] states what is promised. [`Sphere`] itself uses the faster of the two; this type is for comparing them.
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
#[doc(alias("quadratic", "discriminant"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "Sphere<V>: serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "Sphere<V>: serde::Deserialize<'de>")))]
#[repr(transparent)]
pub struct Algebraic<V: Vector = glam::Vec3>(pub Sphere<V>);

impl<V: Vector> Hittable<V> for Algebraic<V> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        self.0.intersect_by::<Quadratic>(ray, range)
    }

    #[inline(always)]
    fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        rejection::may_hit(&self.0, ray, range)
    }

    #[inline(always)]
    fn as_sphere(&self) -> Option<Sphere<V>> {
        Some(self.0)
    }

    #[inline(always)]
    fn may_hit_four(objects: &[Self; 4], ray: &Ray<V>, range: Range<V::Scalar>, _: Crate) -> u32 {
        rejection::may_hit_four(objects.each_ref().map(|Self(sphere)| sphere), ray, range)
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
