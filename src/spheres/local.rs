//! Coordinates in `f32` around a center, for scenes in either precision that are anywhere, and for rays that come from anywhere.
//!
//! Boxes and filters compute in `f32`, and their errors are a part of the largest number that they meet. So the coordinates are
//! those relative to a center among the spheres, and a ray that begins far away begins anew not far before them: its origin is
//! moved along it, in `f64`, and t counts from there.
//!
//! **The error of a moved origin.** With u = 2⁻²⁴ and v = 2⁻⁵³, O for the origin relative to the center, and D for how far before
//! its closest approach to the center the ray begins anew, at p = O + t d:
//!
//! ```text
//! O     a difference                is off by at most  v |O|
//! t d   a product                                      v |t d| ≤ v (|O| + |p|)
//! p     a sum                                          v |p|
//! ```
//!
//! Together 2 v (|O| + |p|). D is at least [`LEAST_PART`], 2⁻²³, of the sum of the coordinates of O, over √3, and |p| ≥ D: so |O|
//! ≤ √3 2²³ |p|, and the error is at most 2⁻²⁸ |p|, the sixteenth part of u |p|. How exactly t is the one that was meant does not
//! matter, for p is the point at the t that was found.

use glam::{DVec3, Vec3};

use crate::arithmetic::rounding::RoundDown;
use crate::sealed::{Internal, Operation};
use crate::{Scalar, Vector};

/// How far before its closest approach to the center a moved ray begins at least, in the distance from where it came.
const LEAST_PART: f64 = 1.0 / 8_388_608.0; // 2^-23

/// Rounds the coordinates to `f32`.
#[inline(always)]
pub(super) fn narrow<V: Vector>(vector: V) -> Vec3 {
    vector.to_f64().as_vec3()
}

/// Rounds a number to the nearest `f32`.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
pub(super) fn to_f32<S: Into<f64>>(number: S) -> f32 {
    number.into() as f32
}

/// The float before one that is positive.
#[inline(always)]
fn below<V: Vector>(t: V::Scalar) -> V::Scalar {
    struct Below<S>(S);

    impl<V: Vector> Operation<V> for Below<V::Scalar> {
        type Output = V::Scalar;

        #[inline(always)]
        fn run(self) -> V::Scalar
        where
            V: Internal,
        {
            self.0.next_below()
        }
    }

    V::perform(Below(t))
}

/// The start of a range, or 0, as a ray has it that begins anew at `moved`: rounded downwards.
///
/// A hit is in a range by its t as returned, which is rounded. So the exact t may be less than the start, but not than the float
/// before it.
#[inline(always)]
pub(super) fn local_start<V: Vector>(start: V::Scalar, moved: f64) -> f32 {
    let start = if start > V::Scalar::ZERO { below::<V>(start).into() } else { 0.0 };
    // Upwards is downwards in the mirror.
    if moved == 0.0 { -round_up(-start) } else { -round_up(end_after(-start, -moved)) }
}

/// The end of a range as a ray has it that begins anew at `moved`: rounded upwards.
#[inline(always)]
pub(super) fn local_end<S: Scalar>(end: S, moved: f64) -> f32 {
    if moved == 0.0 { round_up(end.into()) } else { round_up(end_after(end.into(), moved)) }
}

/// `end` - `moved`, and more than the rounding of the difference.
#[inline(always)]
fn end_after(end: f64, moved: f64) -> f64 {
    let end = end - moved;
    end + end.abs() * f64::EPSILON
}

/// The least `f32` that is no less.
#[inline(always)]
pub(super) fn round_up(number: f64) -> f32 {
    let nearest = to_f32(number);
    if f64::from(nearest) < number { -(-nearest).next_below() } else { nearest }
}

/// A ray that begins anew.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    /// Where on the ray.
    pub(super) t: f64,
    /// That point, relative to the center.
    pub(super) origin: DVec3,
}

/// How a ray from afar comes to what is around a center.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach {
    /// Relative to the center.
    origin: DVec3,
    direction: DVec3,
    /// Where on the ray the closest approach to the center is, and how far before it the ray begins anew.
    closest: f64,
    before: f64,
}

impl Approach {
    /// Of a ray with that origin relative to the center, to what is around it up to that distance, roughly.
    pub(super) fn new(origin: DVec3, direction: DVec3, extent: f64) -> Self {
        let before = (4.0 * extent).max(origin.abs().element_sum() * LEAST_PART);
        Self {
            origin,
            direction,
            closest: -origin.dot(direction) / direction.length_squared(),
            // The sum of the coordinates is between the length and √3 of it. So D is at least `before` / √3.
            before: before / direction.abs().element_sum(),
        }
    }

    /// The square of the distance at the closest approach: infinite for a ray that has left the center behind.
    pub(super) fn distance_squared(&self) -> f64 {
        if self.closest > 0.0 {
            (self.origin + self.direction * self.closest).length_squared()
        } else {
            f64::INFINITY
        }
    }

    /// The ray that begins anew, but not before its origin nor beyond `end`.
    pub(super) fn moved(&self, end: f64) -> Moved {
        let t = (self.closest - self.before).min(end).max(0.0);
        Moved { t, origin: self.origin + self.direction * t }
    }
}
