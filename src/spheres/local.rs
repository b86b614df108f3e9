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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::testing::{Dyadic, Float, Random};

    /// A number that is no more than an exact one, and of `f32` the next but a few.
    fn assert_just_below(found: f32, exact: &Dyadic, size: f64, case: &str) {
        let off = exact - &Dyadic::exactly(found.into());
        assert!(!off.is_negative(), "{found:e} for {case}");
        let allowed =
            3.0 * f64::EPSILON * size + 1.01 * f64::from(f32::EPSILON) * f64::from(found).abs();
        assert!(
            off.approximately() <= allowed + f64::from(f32::from_bits(1)),
            "{found:e} for {case}"
        );
    }

    /// A range as a ray has it that begins anew has every t that is rounded into the range, and little more.
    fn ranges_are_rounded_outwards<V: Vector>()
    where
        V::Scalar: Float,
    {
        let mut random = Random::new(1);
        for round in 0..20_000 {
            let t = V::Scalar::from_f64(random.float(-20..=20).abs());
            let moved = [0.0, f64::from(to_f32(t)), random.float(-20..=20).abs()][round % 3];
            let case = std::format!("{t}, moved by {moved}");
            let [exact_t, exact_moved] = [t.into(), moved].map(Dyadic::exactly);
            let size = Into::<f64>::into(t) + moved;

            let end = local_end(t, moved);
            assert_just_below(-end, &(&exact_moved - &exact_t), size, &case);

            // Of what is rounded to t, the least may be nearly the float before.
            let before = V::Scalar::from_ordinal(t.ordinal() - 1);
            let exact_start = &Dyadic::exactly(before.into()) - &exact_moved;
            assert_just_below(local_start::<V>(t, moved), &exact_start, size, &case);
            // There is nothing behind the origin.
            for start in [0.0, -1.0, f64::NEG_INFINITY] {
                let start = local_start::<V>(V::Scalar::from_f64(start), moved);
                assert_just_below(start, &-&exact_moved, moved, &case);
            }
        }
        assert_eq!(local_end(V::Scalar::INFINITY, 7.0), f32::INFINITY);
        assert_eq!(local_end(V::Scalar::INFINITY, 0.0), f32::INFINITY);
    }

    #[test]
    fn ranges_are_rounded_outwards_in_both_precisions() {
        ranges_are_rounded_outwards::<Vec3>();
        ranges_are_rounded_outwards::<DVec3>();
    }

    /// A moved ray begins before its closest approach to the center, outside of twice the extent there, and on the ray.
    #[test]
    fn a_moved_ray_begins_before_what_it_comes_to() {
        let mut random = Random::new(2);
        for _ in 0..20_000 {
            let mut vector = |most| DVec3::from([0; 3].map(|_| random.float(-4..=most)));
            let (origin, direction) = (vector(12), vector(4));
            let extent = random.float(-4..=4).abs();
            let approach = Approach::new(origin, direction, extent);
            let at = |t: f64| (origin + direction * t).length();
            let closest = -origin.dot(direction) / direction.length_squared();
            let moved = approach.moved(f64::INFINITY);
            let before = (closest - moved.t) * direction.length();
            let case = || std::format!("{origin} {direction} {extent}: {moved:?}, not {closest}");
            assert!(
                (moved.origin - (origin + direction * moved.t)).length() <= 1e-12 * origin.length()
            );
            let squared = approach.distance_squared();
            if closest <= 0.0 {
                assert_eq!((moved.t, squared), (0.0, f64::INFINITY), "{}", case());
            } else {
                let error = 1e-12 * origin.length_squared();
                assert!((squared - at(closest).powi(2)).abs() <= error, "{}", case());
            }
            if moved.t > 0.0 {
                // At least 4 extents over √3, and no more than 4.
                assert!(
                    before > 2.3 * extent && before > origin.length() * LEAST_PART / 1.8,
                    "{}",
                    case()
                );
                let most = (4.0 * extent).max(1.74 * origin.length() * LEAST_PART);
                assert!(before < 1.001 * most, "{}", case());
                let half = 0.5 * moved.t;
                assert_eq!(approach.moved(half).t, half);
            } else {
                assert!(
                    moved.t == 0.0
                        && before
                            <= 1.001 * (4.0 * extent).max(1.74 * origin.length() * LEAST_PART),
                    "{}",
                    case()
                );
            }
        }
    }
}
