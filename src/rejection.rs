//! Early rejection: whether a ray certainly misses a sphere, in a few operations of the scene's own precision. It may let a sphere
//! pass that the ray misses; it never rejects one that it hits.
//!
//! A hit with t in (0, end) is a point of the segment from the ray's origin to `end`. So a sphere is rejected where that segment
//! stays clear of its ball: where the point of the segment nearest to the center, at t = m, is farther from it than the radius.
//! With o = c - p, h = d·o, a = d·d, and s = a m,
//!
//! ```text
//! s = h, but at least 0 and at most a end
//! |m d - o|² - r² = (o·o - r²) - T > 0,   T = 2 h m - a m² = s (2 h - s) / a
//! ```
//!
//! That rejects the spheres behind the origin and those beyond the nearest hit so far along with those beside the ray. Of a ray, only
//! 1 / a takes a division, and it is the same for all spheres of a loop.
//!
//! **The error.** With u half an ulp of 1 (2⁻²⁴, in `f64` 2⁻⁵³) and every operation rounded,
//!
//! ```text
//! o·o - r²   o twice, a product, 3 sums                 is off by at most  6 u o·o
//!            r² a product, its factor a product, a sum  is off by at most  3 u r²
//! h          o, a product, 2 sums                       is off by at most  4 u |o| |d|, and so T by 8 u |o| |d| m
//! T          a 3, the quotient 1, 2 products, 2 sums    is off by at most  8 u T besides
//! a end      a 3, a product                             is off by at most  4 u a end, and so T by 4 u T
//! ```
//!
//! Now let the ray hit: o·o ≤ r² + T. With the distance q = m |d| to the point at m, that to the closest approach, h / |d| ≥ q, and
//! that of the center from the line, at most r: |o| |d| m = q √((h / |d|)² + r²) ≤ h m + r² / 2 ≤ T + r² / 2. Together the errors
//! are at most
//!
//! ```text
//! 6 u (r² + T) + 3 u r² + 8 u (T + r² / 2) + 8 u T + 4 u T = 13 u r² + 26 u T
//! ```
//!
//! So r² is made larger by `MARGIN`, 16 u, and T by twice that. The rest is far more than all terms of the second order.
//!
//! **Underflow.** Of directions of 2⁻³⁰ to 2⁶⁰ (in `f64`, 2⁻²⁵⁰ to 2⁵⁰⁰), a is a normal number and so is 1 / a. A product that
//! underflows is off by 2⁻¹⁵⁰ (2⁻¹⁰⁷⁵) more: in h and in a end, that is multiplied by 2 |o| / |d|, and in s / a by 2 |o| |d|,
//! together below 2⁻⁸⁸ |o| (2⁻⁵⁷³ |o|). Either |o| < 2⁻¹² (2⁻⁴⁰⁰), and that and what is lost of the squares is below `LEAST`, which
//! the result has to exceed, or it is far below u o·o. For all other rays, 1 / a is taken to be NaN.
//!
//! **Overflow and NaN.** T is never below zero where `end` is above it, so that what overflows in h or T makes the result -∞ or NaN, as
//! does an infinite radius. What overflows in o·o makes it +∞ or NaN. Only a finite result rejects. Where `end` is not above zero
//! nothing is hit, and any answer will do. A negative radius passes as its magnitude would: the exact routine knows.

use glam::{DVec3, Mat4, Vec3, Vec4};

use crate::{Ray, Scalar, Sphere, Vector};

/// The constants of the derivation above in a precision.
pub trait Bounds: Sized {
    /// By which part of themselves r², and by twice of which T, is made larger: 16 u.
    const MARGIN: Self;
    /// What the result has to exceed: more than underflow can take from it.
    const LEAST: Self;
    /// The least and the largest square of a direction's length.
    const SQUARES: [Self; 2];
    /// What no ray of another length is rejected with.
    const NAN: Self;
}

impl Bounds for f32 {
    const MARGIN: Self = 8.0 * f32::EPSILON;
    const LEAST: Self = f32::from_bits((127 - 99) << 23); // 2^-99
    const SQUARES: [Self; 2] =
        [f32::from_bits((127 - 60) << 23), f32::from_bits((127 + 120) << 23)];
    const NAN: Self = f32::NAN;
}

impl Bounds for f64 {
    const MARGIN: Self = 8.0 * f64::EPSILON;
    const LEAST: Self = f64::from_bits((1023 - 970) << 52); // 2^-970
    const SQUARES: [Self; 2] =
        [f64::from_bits((1023 - 500) << 52), f64::from_bits((1023 + 1000) << 52)];
    const NAN: Self = f64::NAN;
}

/// The rejection of four spheres at a time.
pub trait Rejection: Sized {
    /// Which of the spheres the ray may hit before `end`: the bit `1 << i` is that of `spheres[i]`.
    fn may_hit_four(spheres: [&Sphere<Self>; 4], ray: &Ray<Self>, end: Self::Scalar) -> u32
    where
        Self: Vector;
}

impl Rejection for Vec3 {
    #[inline(always)]
    fn may_hit_four(spheres: [&Sphere; 4], ray: &Ray, end: f32) -> u32 {
        let columns = spheres.map(|sphere| sphere.center.extend(sphere.radius));
        let [x, y, z, w] = columns;
        let rows = Mat4::from_cols(x, y, z, w).transpose();
        let Ray { origin, direction } = *ray;
        let [a, one_over_a] = squares(ray, f32::MARGIN);
        let x = rows.x_axis - origin.x;
        let y = rows.y_axis - origin.y;
        let z = rows.z_axis - origin.z;
        let power = x * x + y * y + z * z - rows.w_axis * rows.w_axis * (1.0 + f32::MARGIN);
        let h = x * direction.x + y * direction.y + z * direction.z;
        let is_clear = |clearance: Vec4| {
            (clearance.cmpgt(Vec4::splat(f32::LEAST)) & clearance.cmplt(Vec4::INFINITY)).bitmask()
        };
        // Beside the line are most.
        let clear = is_clear(power - h * one_over_a * h);
        if clear == 0b1111 {
            return 0;
        }
        let s = h.max(Vec4::ZERO).min(Vec4::splat(a * end));
        let clear = clear | is_clear(power - s * one_over_a * ((h - s) + h));
        clear ^ 0b1111
    }
}

impl Rejection for DVec3 {
    #[inline(always)]
    fn may_hit_four(spheres: [&Sphere<Self>; 4], ray: &Ray<Self>, end: f64) -> u32 {
        let mut near = 0;
        for (place, sphere) in spheres.into_iter().enumerate() {
            near |= u32::from(!is_clear_of_line(sphere, ray)) << place;
        }
        if near == 0 {
            return 0;
        }
        for (place, sphere) in spheres.into_iter().enumerate() {
            near &= !(u32::from(!may_hit(sphere, ray, end)) << place);
        }
        near
    }
}

/// Whether the ray may hit the sphere before `end`.
// Inlined always: so that a loop computes once what is the ray's.
#[inline(always)]
pub(crate) fn may_hit<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>, end: V::Scalar) -> bool {
    let (zero, margin) = (V::Scalar::ZERO, V::Scalar::MARGIN);
    let is_clear = |clearance| clearance > V::Scalar::LEAST && clearance < V::Scalar::INFINITY;
    let [a, one_over_a] = squares(ray, margin);
    let o = sphere.center - ray.origin;
    let h = ray.direction.dot(o);
    let power = o.dot(o) - sphere.radius * sphere.radius * (V::Scalar::ONE + margin);
    // Beside the line are most.
    if is_clear(power - h * one_over_a * h) {
        return false;
    }
    let longest = a * end;
    // Comparisons that are one instruction each: `f32::clamp` looks for NaN.
    let s = if h > zero { h } else { zero };
    let s = if s < longest { s } else { longest };
    !is_clear(power - s * one_over_a * ((h - s) + h))
}

#[inline(always)]
fn is_clear_of_line(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>) -> bool {
    let [_, one_over_a] = squares(ray, f64::MARGIN);
    let o = sphere.center - ray.origin;
    let h = ray.direction.dot(o);
    let power = o.dot(o) - sphere.radius * sphere.radius * (1.0 + f64::MARGIN);
    let c = power - h * one_over_a * h;
    (c > f64::LEAST) & (c < f64::INFINITY)
}

/// a, and 1 / a made larger.
#[inline(always)]
fn squares<V: Vector>(ray: &Ray<V>, margin: V::Scalar) -> [V::Scalar; 2] {
    let a = ray.direction.dot(ray.direction);
    let [least, largest] = V::Scalar::SQUARES;
    let is_usual = a >= least && a <= largest;
    [a, if is_usual { (V::Scalar::ONE + margin + margin) / a } else { V::Scalar::NAN }]
}
