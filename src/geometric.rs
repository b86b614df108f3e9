//! The geometric derivation: the closest approach to the center, and half a chord to either side.

use core::ops::Range;

use crate::arithmetic::number::{Number, Triple};
use crate::root::chord::{Chord, Derivation};
use crate::sealed::Crate;
use crate::{Hit, Hittable, Ray, Sphere, Vector, rejection};

/// A sphere whose roots are found by the closest approach and the half-chord: the geometric derivation.
///
/// The line is closest to the center c at `t_m`, at a distance of `l_m`. If `l_m` is at most the radius r, the line intersects
/// the sphere half a chord before and half a chord after this point, at `t_m - Δt` and `t_m + Δt`.
///
#[doc = include_str!("diagrams/closest_approach.svg")]
///
/// The point of closest approach, the center and the origin p form a right triangle, and so do the point of closest approach, the
/// center and either intersection, where n is the normal. With `o = c - p`, and every t in lengths of the direction d,
///
/// ```text
/// t_m  = o·d / d·d
/// l_m² = o·o - (o·d)² / d·d = |o × d|² / d·d        (Lagrange's identity)
/// Δt   = √((r² - l_m²) / d·d) = √(r² (d·d) - |o × d|²) / d·d
/// ```
///
/// In the lecture (see below) the sphere is the unit sphere at the origin and the direction is a unit vector, so that `t_m =
/// -p·d`,
/// `l_m² = p·p - (p·d)²` and `Δt = √(1 - l_m²)`.
///
/// The form with the cross product does not subtract two large squares, and so loses little of `l_m` even where the sphere
/// is far away. The roots are the same as those of [`Algebraic`](crate::Algebraic), bit for bit: [`Sphere`] states what is
/// promised.
///
/// Source: S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*.
///
/// ```
/// use eyeray::{Geometric, Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let sphere = Geometric(Sphere::new(Vec3::ZERO, 1.0));
/// let ray = Ray::new(vec3(0.0, 0.0, 5.0), vec3(0.0, 0.0, -2.0));
/// assert_eq!(sphere.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(2.0));
/// ```
#[doc(alias("closest_approach", "half_chord"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "Sphere<V>: serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "Sphere<V>: serde::Deserialize<'de>")))]
#[repr(transparent)]
pub struct Geometric<V: Vector = glam::Vec3>(pub Sphere<V>);

impl<V: Vector> Hittable<V> for Geometric<V> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        self.0.intersect_by::<ClosestApproach>(ray, range)
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

/// The geometric derivation.
#[derive(Debug)]
pub(crate) enum ClosestApproach {}

impl Derivation for ClosestApproach {
    #[inline(always)]
    fn chord<N: Number>(o: Triple<N>, d: Triple<N>, radius_squared: N) -> Chord<N> {
        // The closest approach, t_m = h / a.
        let a = d.dot(d);
        let h = d.dot(o);

        // Its distance from the center: o × d is l_m long, times the direction's length.
        let moment = o.cross(d);
        let a_closest_squared = moment.dot(moment);

        // Half the chord, by Pythagoras: (a Δt)² = a (r² - l_m²).
        let discriminant = a * radius_squared - a_closest_squared;

        let distance_squared = o.dot(o);
        let power = distance_squared - radius_squared;
        Chord { a, h, distance_squared, power, discriminant }
    }
}
