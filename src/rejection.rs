//! Early rejection: a test in a few operations, in the scene's own precision, of whether a ray misses a sphere. A sphere that the
//! ray misses may pass the test; a sphere that it hits is never rejected. The filter of the collections (`spheres::filter`) is
//! the same test in `f32`, over many spheres at a time, of numbers that have been rounded before: one derivation is for both.
//!
//! A hit with t from `start` to `end` is a point of that segment of the ray. So a sphere is rejected where the segment stays
//! clear of its ball: where the point of the segment nearest to the center, at t = m, is farther from it than the radius. With
//! o = c - p, h = d·o, a = d·d, and s = a m,
//!
//! ```text
//! s = h, but at least a start (and 0) and at most a end
//! |m d - o|² - r² = (o·o - r²) - T > 0,   T = 2 h m - a m² = s (2 h - s) / a
//! ```
//!
//! That rejects the spheres before the start and those beyond the nearest hit so far along with those beside the ray. For the
//! whole line s = h and T = h² / a, which is quicker and goes first. Only 1 / a takes a division, and in a loop it is computed
//! once for all spheres.
//!
//! **The error.** With u half an ulp of 1 (2⁻²⁴, in `f64` 2⁻⁵³) and every operation rounded,
//!
//! ```text
//! o·o - r²   o twice, a product, 3 sums                 is off by at most  6 u o·o
//!            r² a product, its factor a product, a sum  is off by at most  3 u r²
//! h          o, a product, 2 sums                       is off by at most  4 u |o| |d|, and so T by 8 u |o| |d| m
//! T          a 3, the quotient 1, 2 products            is off by at most  6 u |T| besides
//!            (h - s) + h, 2 sums                                           u |T| and u s |h - s| / a
//! a start    a 3, a product, t was rounded 1            is off by at most  5 u of itself, and so T by 10 u s |h - s| / a
//! a end      a 3, a product                             is off by at most  4 u of itself: no more
//! ```
//!
//! (The t of a hit, as returned, is no less than the start: so the exact t is no less than (1 - u) of it.)
//!
//! Now let the ray hit: o·o ≤ r² + T. Let q = m |d| be the distance to the point at m, and e = |h - s| / |d| how far that is from
//! the closest approach: s |h - s| / a = q e.
//!
//! *Up to the closest approach*, q + e = h / |d|. So T = q (q + 2 e) and q e ≤ T / 2. With the distance of the center from the
//! line, at most r, |o| q ≤ q √((h / |d|)² + r²) ≤ h m + r² / 2 ≤ T + r² / 2. Together the errors are at most, with 2 u T for the
//! two sums,
//!
//! ```text
//! 6 u (r² + T) + 3 u r² + 8 u (T + r² / 2) + 8 u T + 8 u T / 2 = 13 u r² + 26 u T
//! ```
//!
//! *Beyond it*, the start is behind the closest approach: T = q (q - 2 e), and as the point at m is in the ball, e ≤ r. If T is
//! not negative, q = e + √(e² + T), and with e √(e² + T) ≤ e² + T / 2, q e ≤ 2 r² + T / 2. Likewise with |o|² ≤ r² + T,
//! |o| q ≤ r √(r² + T) + r² + T ≤ 2 r² + 1.5 T. Together the errors are at most
//!
//! ```text
//! 6 u (r² + T) + 3 u r² + 8 u (2 r² + 1.5 T) + 7 u T + 11 u (2 r² + T / 2) = 47 u r² + 30.5 u T
//! ```
//!
//! If T is negative, q ≤ 2 e, and o·o + |T| ≤ r²: so |o| q and q e are at most 2 r². Together the errors are at most
//!
//! ```text
//! 7 u (o·o + |T|) + 3 u r² + 16 u r² + 22 u r² = 48 u r²
//! ```
//!
//! **Rounded numbers.** In the filter, c and p are relative to a center of the collection, and d is of any precision. Rounded to
//! `f32`, c is off by at most u |c|, p by 1.25 u |p|, and d by u |d|. So where the ray hits at t, the rounded ray passes the
//! rounded center within r + u |c| + 1.25 u |p| + u t |d|. There t |d| ≤ |o| + r, and |p| ≤ |c| + |o|:
//!
//! ```text
//! r (1 + u) + 2.25 u |c| + 2.25 u |o| ≤ R (1 + u) + 2.25 u |o|,   R = r + 3 u |c|
//! ```
//!
//! With R for the radius, the center counts no more. The square of the whole is at most R² + 2 u R² + 4.5 u R |o|, and with
//! 2 R |o| ≤ R² + o·o ≤ 2 R² + T, at most R² (1 + 6.5 u) + 2.25 u T, without the last term if T is negative. With the above, that
//! makes 53.5 u R² + 32.75 u T, or 54.5 u R².
//!
//! So T is made larger by `MARGIN`, 36 u, and r² by three times that, 108 u: of this, a negative T, which is made still less,
//! takes 36 u at most. That leaves 17.5 u r² and 3.25 u T. All terms of the second order are together below 10,000 u² (r² + |T|),
//! which is less than a 1,000th of u (r² + |T|).
//!
//! The last subtraction is only compared with a constant, which its rounding does not change.
//!
//! **Underflow.** For directions of length 2⁻³⁰ to 2⁶⁰ (in `f64`, 2⁻²⁵⁰ to 2⁵⁰⁰), a and 1 / a are normal numbers. A product that
//! underflows has an additional error of up to 2⁻¹⁵⁰ (2⁻¹⁰⁷⁵). In h, this error is multiplied by 2 |o| / |d|, in a start and a
//! end by 2 e / |d|, in a start that is subnormal by 2 e |d|, and in s / a by 2 |o| |d|, where e ≤ |o| + r: together less than
//! 2⁻⁸⁸ |o| (2⁻⁵⁷³ |o|). If |o| < 2⁻¹² (2⁻⁴⁰⁰), this and the errors of the squares are less than `LEAST`, which the result has to
//! exceed. Otherwise they are far below u o·o. For all other directions, 1 / a is set to NaN, so that nothing is rejected.
//!
//! **Overflow and NaN.** Overflow in o·o, h or T and an infinite radius make the result infinite or NaN. Only a finite result
//! rejects. Where `end` is not positive there is no hit, and either answer is right. What is not rejected so is looked at again:
//! a sphere with a NaN, an infinity or a negative radius, which nothing hits, is rejected at last.

use core::ops::Range;

use glam::{DVec3, Mat4, Vec3, Vec4};

use crate::sealed::{Internal, Operation};
use crate::{Ray, Scalar, Sphere, Vector};

/// The constants of the derivation above in a precision.
pub trait Bounds: Sized {
    /// The relative increase of T, and a third of that of r²: 36 u.
    const MARGIN: Self;
    /// The bound that the result has to exceed: more than the errors by underflow.
    const LEAST: Self;
    /// The least and the largest square of the length of a direction with which spheres are rejected.
    const SQUARES: [Self; 2];
    /// NaN, for all other directions.
    const NAN: Self;
}

impl Bounds for f32 {
    /// Proved in `tests/proofs/rejection.g`.
    const MARGIN: Self = 18.0 * f32::EPSILON;
    const LEAST: Self = f32::from_bits((127 - 99) << 23); // 2^-99
    const SQUARES: [Self; 2] =
        [f32::from_bits((127 - 60) << 23), f32::from_bits((127 + 120) << 23)];
    const NAN: Self = f32::NAN;
}

impl Bounds for f64 {
    /// Proved in `tests/proofs/rejection.g`.
    const MARGIN: Self = 18.0 * f64::EPSILON;
    const LEAST: Self = f64::from_bits((1023 - 970) << 52); // 2^-970
    const SQUARES: [Self; 2] =
        [f64::from_bits((1023 - 500) << 52), f64::from_bits((1023 + 1000) << 52)];
    const NAN: Self = f64::NAN;
}

/// Whether the sphere is one that a ray can hit: not so if it has a NaN, an infinity or a negative radius.
pub(crate) fn can_be_hit<V: Vector>(sphere: &Sphere<V>) -> bool {
    let radius = sphere.radius;
    sphere.center.to_f64().is_finite() && radius >= V::Scalar::ZERO && radius < V::Scalar::INFINITY
}

/// Whether the ray may hit the sphere in a range.
// Inlined always, as all here: so that a loop computes once what is the ray's.
#[inline(always)]
pub(crate) fn may_hit<V: Vector>(
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    range: Range<V::Scalar>,
) -> bool {
    V::perform(One { sphere, ray, range })
}

/// Which of the spheres the ray may hit in a range: the bit `1 << i` is that of `spheres[i]`.
#[inline(always)]
pub(crate) fn may_hit_four<V: Vector>(
    spheres: [&Sphere<V>; 4],
    ray: &Ray<V>,
    range: Range<V::Scalar>,
) -> u32 {
    V::perform(Four { spheres, ray, range })
}

/// [`may_hit`].
struct One<'a, V: Vector> {
    sphere: &'a Sphere<V>,
    ray: &'a Ray<V>,
    range: Range<V::Scalar>,
}

impl<V: Vector> Operation<V> for One<'_, V> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool
    where
        V: Internal,
    {
        may_hit_within(V::Scalar::MARGIN, self.sphere, self.ray, self.range)
    }
}

/// [`may_hit_four`].
struct Four<'a, V: Vector> {
    spheres: [&'a Sphere<V>; 4],
    ray: &'a Ray<V>,
    range: Range<V::Scalar>,
}

impl<V: Vector> Operation<V> for Four<'_, V> {
    type Output = u32;

    #[inline(always)]
    fn run(self) -> u32
    where
        V: Internal,
    {
        V::may_hit_four_within(V::Scalar::MARGIN, self.spheres, self.ray, self.range)
    }
}

/// The rejection in a precision.
pub trait Rejection: Sized {
    /// [`may_hit_four`] with that margin.
    fn may_hit_four_within(
        margin: Self::Scalar,
        spheres: [&Sphere<Self>; 4],
        ray: &Ray<Self>,
        range: Range<Self::Scalar>,
    ) -> u32
    where
        Self: Vector;
}

impl Rejection for Vec3 {
    // A vector of four is one register.
    #[inline(always)]
    fn may_hit_four_within(
        margin: f32,
        spheres: [&Sphere; 4],
        ray: &Ray,
        range: Range<f32>,
    ) -> u32 {
        let [p, q, r, s] = spheres.map(|sphere| sphere.center.extend(sphere.radius));
        let transposed = Mat4::from_cols(p, q, r, s).transpose();
        let Mat4 { x_axis: x, y_axis: y, z_axis: z, w_axis: radius } = transposed;
        let Ray { origin, direction } = *ray;
        let [a, one_over_a] = squares(margin, ray);
        let [shortest, longest] = limits(a, range);
        let (x, y, z) = (x - origin.x, y - origin.y, z - origin.z);
        let power = x * x + y * y + z * z - radius * radius * (1.0 + 3.0 * margin);
        let h = x * direction.x + y * direction.y + z * direction.z;
        let are_clear = |clearance: Vec4| {
            let exceeds = clearance.cmpgt(Vec4::splat(f32::LEAST));
            (exceeds & clearance.cmplt(Vec4::INFINITY)).bitmask()
        };
        // Most spheres are beside the line.
        let beside = are_clear(power - h * one_over_a * h);
        if beside == 0b1111 {
            return 0;
        }
        let s = h.max(Vec4::splat(shortest)).min(Vec4::splat(longest));
        let near = 0b1111 & !(beside | are_clear(power - s * one_over_a * ((h - s) + h)));
        if near == 0 { 0 } else { near & can_be_hit_four(spheres) }
    }
}

impl Rejection for DVec3 {
    // Number by number, for the compiler to put into vectors of two.
    #[inline(always)]
    fn may_hit_four_within(
        margin: f64,
        spheres: [&Sphere<Self>; 4],
        ray: &Ray<Self>,
        range: Range<f64>,
    ) -> u32 {
        let Ray { origin, direction } = *ray;
        let [a, one_over_a] = squares(margin, ray);
        let limits = limits(a, range);
        let x = spheres.map(|sphere| sphere.center.x - origin.x);
        let y = spheres.map(|sphere| sphere.center.y - origin.y);
        let z = spheres.map(|sphere| sphere.center.z - origin.z);
        let (mut power, mut h, mut beside) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for i in 0..4 {
            let radius = spheres[i].radius;
            power[i] =
                x[i] * x[i] + y[i] * y[i] + z[i] * z[i] - radius * radius * (1.0 + 3.0 * margin);
            h[i] = x[i] * direction.x + y[i] * direction.y + z[i] * direction.z;
            beside[i] = power[i] - h[i] * one_over_a * h[i];
        }
        // Most spheres are beside the line. Their sum is finite only if all are.
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        let [b0, b1, b2, b3] = beside;
        let least = smaller(smaller(b0, b1), smaller(b2, b3));
        if least > f64::LEAST && (b0 + b1) + (b2 + b3) < f64::INFINITY {
            return 0;
        }
        let mut near = 0;
        for i in 0..4 {
            let may_hit = !is_clear(beside[i])
                && is_near_segment(power[i], h[i], one_over_a, limits)
                && can_be_hit(spheres[i]);
            near |= u32::from(may_hit) << i;
        }
        near
    }
}

#[inline(always)]
fn may_hit_within<V: Internal>(
    margin: V::Scalar,
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    range: Range<V::Scalar>,
) -> bool {
    let [a, one_over_a] = squares(margin, ray);
    let o = sphere.center - ray.origin;
    let power =
        o.dot(o) - sphere.radius * sphere.radius * (V::Scalar::ONE + margin + margin + margin);
    let h = ray.direction.dot(o);
    // Most spheres are beside the line.
    !is_clear(power - h * one_over_a * h)
        && is_near_segment(power, h, one_over_a, limits(a, range))
        && can_be_hit(sphere)
}

/// Which of four spheres can be hit, a bit for each.
#[inline(always)]
fn can_be_hit_four<V: Vector>(spheres: [&Sphere<V>; 4]) -> u32 {
    let mut bits = 0;
    for (place, sphere) in spheres.iter().enumerate() {
        bits |= u32::from(can_be_hit(sphere)) << place;
    }
    bits
}

/// a start, or 0, and a end.
#[inline(always)]
fn limits<S: Scalar>(a: S, Range { start, end }: Range<S>) -> [S; 2] {
    [if start > S::ZERO { a * start } else { S::ZERO }, a * end]
}

/// Whether the segment between these limits may come as near as the radius.
#[inline(always)]
fn is_near_segment<S: Scalar + Bounds>(
    power: S,
    h: S,
    one_over_a: S,
    [shortest, longest]: [S; 2],
) -> bool {
    // Comparisons that are one instruction each: `f32::clamp` looks for NaN.
    let s = if h > shortest { h } else { shortest };
    let s = if s < longest { s } else { longest };
    !is_clear(power - s * one_over_a * ((h - s) + h))
}

/// Whether such a result rejects.
#[inline(always)]
fn is_clear<S: Scalar + Bounds>(clearance: S) -> bool {
    clearance > S::LEAST && clearance < S::INFINITY
}

/// a, and 1 / a increased by the margin, or NaN for unusual directions.
#[inline(always)]
fn squares<V: Internal>(margin: V::Scalar, ray: &Ray<V>) -> [V::Scalar; 2] {
    let a = ray.direction.dot(ray.direction);
    let [least, largest] = V::Scalar::SQUARES;
    let is_usual = a >= least && a <= largest;
    [a, if is_usual { (V::Scalar::ONE + margin) / a } else { V::Scalar::NAN }]
}

#[cfg(test)]
mod tests {
    use sobol_burley::sample;

    use super::*;
    use crate::Hittable;

    /// How many of the hits of random rays that graze a sphere, or end where they meet it, are rejected with that margin.
    fn rejected<V: Internal>(margin: V::Scalar, above: fn(V::Scalar) -> V::Scalar) -> u32 {
        const CASES: u32 = 60_000;
        let empty = Sphere::new(V::from_f64(DVec3::splat(1e6)), V::Scalar::ZERO);
        let mut hits = 0;
        let mut rejected = 0;
        for case in 0..CASES {
            let random = |dimension| f64::from(sample(case, dimension, 1));
            let vector = |dimension| {
                DVec3::new(random(dimension), random(dimension + 1), random(dimension + 2))
                    - DVec3::splat(0.5)
            };
            let direction = vector(0);
            let outward = direction.cross(vector(3)).normalize_or(DVec3::X);
            let center = vector(6) * 10.0;
            let radius = 0.01 + random(9) * random(9);
            let at_the_limb = 1.0 - V::Scalar::MARGIN.into() * random(10);
            let closest =
                if case % 2 == 0 { at_the_limb } else { random(10) * at_the_limb } * radius;
            let origin = center + outward * closest - direction * (20.0 * random(11));

            let sphere = Sphere::new(V::from_f64(center), V::Scalar::from_f64(radius));
            let ray = Ray::new(V::from_f64(origin), V::from_f64(direction));
            let (zero, infinity) = (V::Scalar::ZERO, V::Scalar::INFINITY);
            let Some(hit) = sphere.intersect(&ray, zero..infinity) else { continue };
            let Some([_, exit]) = sphere.roots(&ray) else { continue };
            for range in [zero..infinity, zero..above(hit.t), hit.t..above(hit.t), exit..infinity] {
                hits += 1;
                let one = may_hit_within(margin, &sphere, &ray, range.clone());
                let mut four = [&empty; 4];
                let place = case % 4;
                four[place as usize] = &sphere;
                let near = V::may_hit_four_within(margin, four, &ray, range.clone());
                assert_eq!(near & !(1 << place), 0, "a point far away passed");
                assert_eq!(
                    near != 0,
                    one,
                    "one is not as four are: {sphere:?}, {ray:?}, {range:?}"
                );
                rejected += u32::from(!one);
            }
        }
        assert!(hits > CASES / 2);
        rejected
    }

    fn above_f32(t: f32) -> f32 {
        f32::from_bits(t.to_bits() + 1)
    }

    fn above_f64(t: f64) -> f64 {
        f64::from_bits(t.to_bits() + 1)
    }

    #[test]
    fn rejects_no_sphere_that_is_hit() {
        assert_eq!(rejected::<Vec3>(f32::MARGIN, above_f32), 0);
        assert_eq!(rejected::<DVec3>(f64::MARGIN, above_f64), 0);
    }

    #[test]
    fn needs_its_margin() {
        assert!(rejected::<Vec3>(0.0, above_f32) > 0);
        assert!(rejected::<DVec3>(0.0, above_f64) > 0);
    }
}
