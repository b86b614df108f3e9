//! `f64`: the first try in `f64`, and one step of Newton's with a residual in which no rounding error is lost.

use core::cmp::Ordering;
use core::ops::Range;

use glam::DVec3;

use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{V, compensated_dot, two_difference, two_product};
use crate::chord::{Chord, Derivation};
use crate::first_try::{BothRoots, FirstTry, both_roots, nearest_ahead};
use crate::geometric::ClosestApproach;
use crate::hit::Found;
use crate::precision::Precision;
use crate::refine::{self, Crossings, Line, Target};
use crate::second_try::{Estimate, Root, SecondTry, second_try};
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
mod tests;

/// Whether a square, a or the larger of o·o and r², is between 2⁻⁴⁸⁰ and 2⁴⁸⁰: then no product of two of them overflows, and
/// what underflows on the way is far below the error bounds.
#[inline(always)]
fn is_safe(square: f64) -> bool {
    const LEAST: u64 = (1023 - 480) << 52;
    const SPAN: u64 = 960 << 52;
    // Above the span are all negative numbers, infinities and NaN.
    square.to_bits().wrapping_sub(LEAST) < SPAN
}

/// Of the residual that [`Setting::polish`] takes, in m, besides its own last place: what is rounded in it.
///
/// To first order, in u² m, and at the far root of a ray from the surface through the center, t |d| = 2 |o|, where it is most:
/// of the compensated a and h 32 each, and of o·o 8; of the products with what was rounded in o 12, of the product a.lo t 12,
/// of the additions up to `slope_low` 16 + 28 + 32 + 32, of its product with t 32; of `power_low` 1 + 6 + 4 + 6 + 6; and of the
/// last additions 38 + 38. That makes 335.
const RESIDUAL_ERROR: f64 = 340.0 * V;

/// A line and a sphere.
struct Setting {
    origin: DVec3,
    center: DVec3,
    direction: DVec3,
    radius: f64,
    /// Negative where the radius is.
    radius_squared: f64,
}

impl Setting {
    #[inline(always)]
    fn new(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>) -> Self {
        Self {
            origin: ray.origin,
            center: sphere.center,
            direction: ray.direction,
            radius: sphere.radius,
            radius_squared: sphere.radius * sphere.radius.abs(),
        }
    }

    /// The chord in plain `f64`, unless its terms might overflow or underflow.
    #[inline(always)]
    fn chord<D: Derivation>(&self) -> Option<Chord<f64>> {
        let chord = D::chord(
            Triple::from(self.center - self.origin),
            Triple::from(self.direction),
            self.radius_squared,
        );
        let larger = if chord.power > 0.0 { chord.distance_squared } else { self.radius_squared };
        (is_safe(chord.a) && is_safe(larger)).then_some(chord)
    }

    /// The root near `t`, and where it is from the center.
    ///
    /// One step of Newton's on the quadratic f(t) = a t² - 2 h t + power, whose slope at the roots is ∓2 √discriminant. By the
    /// bounds of the first try, e = [`RELATIVE_ERROR`](crate::first_try::RELATIVE_ERROR) = 2⁻³⁴·⁸ for t and as much for the
    /// slope, and with t a ≤ 2 √(a m) and √discriminant ≥ √(CLEAR a m), the relative error after it is at most
    /// e² t a / (2 √discriminant) ≤ e² / √CLEAR < 2⁻⁶² for the curvature, e² for the slope, and what f is off by: no rounding
    /// error of a leading term is lost, and those of the others are [`RESIDUAL_ERROR`], which moves t by less than 2⁻⁷⁵ of itself.
    /// The final sum is rounded, by half an ulp.
    #[inline(always)]
    fn polish(&self, t: f64, half_chord: f64) -> (f64, DVec3) {
        // Taken here, because here the division does not have to wait for anything.
        let inverse_slope = (2.0 * half_chord).recip();
        let correction = self.residual(t) * inverse_slope;
        (t + correction, self.offset(t, correction))
    }

    /// a t² - 2 h t + power for a `t` near a root, so that it is nearly all cancellation: off by a unit in its own last place,
    /// and [`RESIDUAL_ERROR`].
    #[inline(always)]
    fn residual(&self, t: f64) -> f64 {
        // The coefficients, which need not wait for t.
        let d = Triple::from(self.direction);
        let o_exact = Triple::from(self.center).zip(Triple::from(self.origin), two_difference);
        let o = o_exact.map(|o| o.hi);
        let o_low = o_exact.map(|o| o.lo);
        let a = compensated_dot(d, d);
        let h = compensated_dot(d, o);
        let distance_squared = compensated_dot(o, o);
        let radius_squared = two_product(self.radius, self.radius);
        let power = two_difference(distance_squared.hi, radius_squared.hi);
        let h_low = h.lo + d.dot(o_low);
        let power_low = power.lo + ((distance_squared.lo - radius_squared.lo) + 2.0 * o.dot(o_low));

        // (a t - 2 h) t + power.
        let at = two_product(a.hi, t);
        let slope = two_difference(at.hi, 2.0 * h.hi);
        let slope_low = slope.lo + (at.lo + (a.lo * t - 2.0 * h_low));
        let product = two_product(slope.hi, t);
        (product.hi + power.hi) + (product.lo + (slope_low * t + power_low))
    }

    /// From the center to where the ray is at `t + correction`: `(t + correction) d - o`.
    #[inline(always)]
    fn offset(&self, t: f64, correction: f64) -> DVec3 {
        let coordinate = |d: f64, c: f64, p: f64| {
            let o = two_difference(c, p);
            let step = two_product(t, d);
            let offset = two_difference(step.hi, o.hi);
            offset.hi + (offset.lo + (step.lo - o.lo) + correction * d)
        };
        DVec3::new(
            coordinate(self.direction.x, self.center.x, self.origin.x),
            coordinate(self.direction.y, self.center.y, self.origin.y),
            coordinate(self.direction.z, self.center.z, self.origin.z),
        )
    }
}

impl Precision for DVec3 {
    #[inline(always)]
    fn intersect<D: Derivation>(
        sphere: &Sphere<Self>,
        ray: &Ray<Self>,
        range: Range<f64>,
    ) -> Option<Hit<Self>> {
        let setting = Setting::new(sphere, ray);
        if let Some(chord) = setting.chord::<D>() {
            match nearest_ahead(&chord, setting.radius_squared) {
                FirstTry::Miss => return None,
                FirstTry::Root { numerator, denominator, half_chord } => {
                    let t = numerator / denominator;
                    if t < 0.0 {
                        return None;
                    }
                    let (t, offset) = setting.polish(t, half_chord);
                    // Below the range, the other root may be in it.
                    if t >= range.start && t > 0.0 {
                        let normal = offset / sphere.radius;
                        return (t < range.end).then(|| hit(sphere, Found { t, offset, normal }));
                    }
                }
                FirstTry::Doubt => {}
            }
        }
        let Found { t, offset, normal } = refined(sphere, ray, range)?;
        Some(hit(sphere, Found { t, offset, normal }))
    }

    #[inline(always)]
    fn roots<D: Derivation>(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<[f64; 2]> {
        let setting = Setting::new(sphere, ray);
        if let Some(chord) = setting.chord::<D>() {
            match both_roots(&chord, setting.radius_squared) {
                BothRoots::Miss => return None,
                BothRoots::Roots { t: [near, far], half_chord } => {
                    return Some([
                        setting.polish(near, half_chord).0,
                        setting.polish(far, -half_chord).0,
                    ]);
                }
                BothRoots::Doubt => {}
            }
        }
        roots_refined(sphere, ray)
    }
}

/// How far along the normal a spawned ray starts.
///
/// As for `f32`, but the point may be off by 4 ulp a coordinate: with the rounding of the spawned origin together at most
/// 4.5 √3 < 8 ulp of distance.
#[inline(always)]
fn clearance(sphere: &Sphere<DVec3>) -> f64 {
    const EIGHT_ULPS: f64 = 8.0 * f64::EPSILON;
    const EIGHT_LEAST: f64 = f64::from_bits(8);
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let DVec3 { x, y, z } = sphere.center.abs();
    larger(larger(x, y), z) * EIGHT_ULPS + (sphere.radius * EIGHT_ULPS + EIGHT_LEAST)
}

/// Both crossings where the first try left a doubt.
#[inline(always)]
fn crossings(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>) -> Option<Crossings<f64>> {
    let line = Line::new(sphere, ray);
    let setting = Setting::new(sphere, ray);
    if setting.chord::<ClosestApproach>().is_some() {
        match second_try(line.o(), line.direction.into(), line.radius) {
            SecondTry::Miss => return None,
            SecondTry::Hit(estimate) => {
                if let Some(crossings) = settle(&estimate, &setting) {
                    return Some(crossings);
                }
            }
            SecondTry::Doubt => {}
        }
    }
    refine::crossings(&line)
}

/// The roots of the second try, polished, where the errors that this leaves allow.
#[inline(always)]
fn settle(estimate: &Estimate, setting: &Setting) -> Option<Crossings<f64>> {
    let Estimate { a, half_chord, error, roots, .. } = *estimate;
    let o = setting.center - setting.origin;
    let larger = o.length_squared().max(setting.radius_squared);
    let polish = |root: Root, half_chord: f64| {
        let Root { numerator, denominator, relative_error } = root;
        let t = numerator / denominator;
        let step = relative_error * t.abs();
        let (t, offset) = setting.polish(t, half_chord);
        // As derived there: what the curvature, the slope and the residual leave, in t.
        let left = (step * (step * a + 2.0 * error) + RESIDUAL_ERROR * larger) / half_chord.abs();
        let along = setting.radius * f64::NORMAL_ERROR;
        let settled = left < f64::EPSILON / 8.0 * t.abs() && left * left * a < along * along;
        settled.then_some((t, offset / setting.radius))
    };
    let (near, far) = (polish(roots[0], half_chord)?, polish(roots[1], -half_chord)?);
    Some(Crossings { t: [near.0, far.0], normals: [near.1, far.1] })
}

/// Both roots where the first try left a doubt.
#[cold]
#[inline(never)]
fn roots_refined(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>) -> Option<[f64; 2]> {
    crossings(sphere, ray).map(|crossings| crossings.t)
}

/// The nearest hit where the first try left a doubt.
#[cold]
#[inline(never)]
fn refined(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>, range: Range<f64>) -> Option<Found<DVec3>> {
    let (t, normal) = crossings(sphere, ray)?.nearest(&range)?;
    Some(Found { t, offset: normal * sphere.radius, normal })
}

/// The hit.
#[inline(always)]
fn hit(sphere: &Sphere<DVec3>, found: Found<DVec3>) -> Hit<DVec3> {
    let Found { t, offset, normal } = found;
    Hit { t, point: sphere.center + offset, normal, clearance: clearance(sphere) }
}

impl Target for f64 {
    const NORMAL_ERROR: f64 = f64::EPSILON / 16.0;

    fn settle(t: f64, relative_error: f64) -> Option<f64> {
        // With the half ulp of its rounding, within the 1 ulp that is promised.
        (relative_error < f64::EPSILON / 8.0).then_some(t)
    }

    fn settle_exactly(t: f64, _: impl FnOnce(f64) -> Ordering) -> f64 {
        t
    }
}
