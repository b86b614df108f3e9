//! `f32`: computed in `f64`, where the inputs and most of their products are exact, and rounded once.

use core::cmp::Ordering;
use core::ops::Range;

use glam::{DVec3, Vec3};

use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::U;
use crate::arithmetic::rounding::{round_to_f32, round_to_f32_exactly, rounds_safely};
use crate::chord::{Chord, Derivation};
use crate::first_try::{BothRoots, FirstTry, RELATIVE_ERROR, both_roots, nearest_ahead};
use crate::hit::Found;
use crate::precision::Precision;
use crate::refine::{self, Crossings, Line, Target};
use crate::second_try::{Estimate, SecondTry, second_try};
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
mod tests;

/// The first try's error in units of the last of 53 places, at most its relative error over 2⁻⁵³.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "294,912")]
const MARGIN: u32 = (RELATIVE_ERROR / U) as u32;

/// A line and a sphere in `f64`.
struct Setting {
    /// From the ray's origin to the center, rounded.
    o: DVec3,
    direction: DVec3,
    /// Negative where the radius is.
    radius_squared: f64,
}

impl Setting {
    #[inline(always)]
    fn new(sphere: &Sphere<Vec3>, ray: &Ray<Vec3>) -> Self {
        let radius = f64::from(sphere.radius);
        Self {
            o: sphere.center.as_dvec3() - ray.origin.as_dvec3(),
            direction: ray.direction.as_dvec3(),
            radius_squared: radius * radius.abs(),
        }
    }

    #[inline(always)]
    fn chord<D: Derivation>(&self) -> Chord<f64> {
        D::chord(Triple::from(self.o), Triple::from(self.direction), self.radius_squared)
    }
}

impl Precision for Vec3 {
    // Inlined always: so that what a caller does not use of the hit is not computed.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
    fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        let setting = Setting::new(sphere, ray);
        match nearest_ahead(&setting.chord::<D>(), setting.radius_squared) {
            FirstTry::Miss => return None,
            FirstTry::Root { numerator, denominator, .. } => {
                let t = numerator / denominator;
                let rounded = t as f32;
                // Below the range, the other root may be in it; below the normal numbers, rounding is another matter.
                if rounds_safely::<MARGIN>(t)
                    && rounded >= range.start
                    && rounded >= f32::MIN_POSITIVE
                {
                    let offset = setting.direction * t - setting.o;
                    return (rounded < range.end)
                        .then(|| hit(sphere, found(sphere, rounded, offset)));
                }
                if t < 0.0 {
                    return None;
                }
            }
            FirstTry::Doubt => {}
        }
        let Found { t, offset, normal } = refined(sphere, ray, range)?;
        Some(hit(sphere, Found { t, offset, normal }))
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
    fn roots<D: Derivation>(sphere: &Sphere, ray: &Ray) -> Option<[f32; 2]> {
        let setting = Setting::new(sphere, ray);
        match both_roots(&setting.chord::<D>(), setting.radius_squared) {
            BothRoots::Miss => return None,
            BothRoots::Roots { t: [near, far], .. }
                if rounds_safely::<MARGIN>(near) && rounds_safely::<MARGIN>(far) =>
            {
                let rounded = [near as f32, far as f32];
                if rounded[0].is_normal() && rounded[1].is_normal() {
                    return Some(rounded);
                }
            }
            _ => {}
        }
        roots_refined(sphere, ray)
    }
}

/// The hit at `t`, with `offset` from the center to it.
#[inline(always)]
fn found(sphere: &Sphere, t: f32, offset: DVec3) -> Found<Vec3> {
    let normal = offset * f64::from(sphere.radius).recip();
    // The point is rounded here and once more when it is added to the center: 1 ulp.
    Found { t, offset: offset.as_vec3(), normal: normal.as_vec3() }
}

/// The hit.
#[inline(always)]
fn hit(sphere: &Sphere, found: Found<Vec3>) -> Hit {
    let Found { t, offset, normal } = found;
    Hit {
        t,
        point: sphere.center + offset,
        normal,
        clearance: clearance(sphere.center, sphere.radius),
    }
}

/// How far along the normal a spawned ray starts.
///
/// With m = max |center coordinate| + radius, an ulp of m is at most 2⁻²³ m. The point is off by at most 1.5 ulp a coordinate
/// and the spawned origin is rounded by half an ulp a coordinate, together at most 2 √3 < 3.47 ulp of distance. So 4 ulp, and 4
/// of the smallest numbers, where an ulp is no smaller than that.
#[inline(always)]
fn clearance(center: Vec3, radius: f32) -> f32 {
    const FOUR_ULPS: f32 = 4.0 * f32::EPSILON;
    const FOUR_LEAST: f32 = f32::from_bits(4);
    // Not `f32::max`, which takes care of NaN: here there is none.
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let Vec3 { x, y, z } = center.abs();
    larger(larger(x, y), z) * FOUR_ULPS + (radius * FOUR_ULPS + FOUR_LEAST)
}

/// Both crossings where the first try left a doubt.
#[inline(always)]
fn crossings(sphere: &Sphere, ray: &Ray) -> Option<Crossings<f32>> {
    let line = Line::new(sphere, ray);
    let settled = match second_try(line.o(), line.direction.into(), line.radius) {
        SecondTry::Miss => return None,
        SecondTry::Hit(estimate) => settle(&estimate, &line),
        SecondTry::Doubt => None,
    };
    settled.or_else(|| refine::crossings(&line))
}

/// The crossings of the second try, where their errors allow.
#[inline(always)]
fn settle(estimate: &Estimate, line: &Line) -> Option<Crossings<f32>> {
    let Estimate { a, moment, half_chord, error, roots } = *estimate;
    let bound = f32::NORMAL_ERROR * line.radius;
    if error * error > bound * bound * a {
        return None;
    }
    let [near, far] =
        roots.map(|root| round_to_f32(root.numerator / root.denominator, root.relative_error));
    let t = [near?, far?];
    Some(Crossings::new(t, line.direction.into(), moment, a, half_chord, line.radius))
}

/// Both roots where the first try left a doubt.
#[cold]
#[inline(never)]
fn roots_refined(sphere: &Sphere, ray: &Ray) -> Option<[f32; 2]> {
    crossings(sphere, ray).map(|crossings| crossings.t)
}

/// The nearest hit where the first try left a doubt.
#[cold]
#[inline(never)]
fn refined(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Found<Vec3>> {
    let (t, normal) = crossings(sphere, ray)?.nearest(&range)?;
    let offset = normal * f64::from(sphere.radius);
    Some(Found { t, offset: offset.as_vec3(), normal: normal.as_vec3() })
}

impl Target for f32 {
    const NORMAL_ERROR: f64 = f32::EPSILON as f64 / 64.0;

    fn settle(t: f64, relative_error: f64) -> Option<f32> {
        round_to_f32(t, relative_error)
    }

    fn settle_exactly(t: f64, compare: impl FnOnce(f64) -> Ordering) -> f32 {
        round_to_f32_exactly(t, compare)
    }
}
