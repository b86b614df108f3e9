//! `f32`: the plain step in `f64`, where the inputs and most of their products are exact, and one rounding.

use core::borrow::Borrow;
use core::ops::Range;

use glam::Vec3;

use super::chord::{Chord, Derivation};
use super::crossing::{Found, Line, Setting, Side, Verdict};
use super::format::Format;
use super::halves;
use super::plain::{self, Both, Nearest};
use super::precision::Precision;
use super::{both_carefully_f32, integers, nearest_carefully_f32, surface};
use crate::arithmetic::comparison::{exceeds, is_not_positive};
use crate::arithmetic::pair::U;
use crate::arithmetic::rounding::rounds_safely;
use crate::float::{HAS_F64, sqrt};
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
pub(super) mod tests;

/// The part `clear` of the plain step.
///
/// The smaller, the more rays are decided there, but the less is known of each root; at 2⁻¹⁶ one easy case in 230 has a root too
/// close to the middle of two `f32`.
pub(super) const CLEAR: f64 = 1.0 / 65536.0;

/// The plain step's error in units of the last of 53 places, at most its relative error over 2⁻⁵³.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1,179,648")]
const MARGIN: u32 = (plain::ROOT_ERROR / CLEAR / U) as u32;

/// Up to this square of distance over radius, t d - o is a good way from the center to the point.
///
/// With |o| ≤ 128 r, the error of t moves the point by no more than 18 u / [`CLEAR`] of 129 r, which is 2⁻²⁵ r.
const NEAR: f64 = 16384.0;

impl Setting {
    /// The hit at a root of the plain step, with the root rounded, from no farther than [`NEAR`].
    #[inline(always)]
    fn found(&self, t: f64, rounded: f32) -> Found {
        let Self { line, o, .. } = *self;
        let step = line.direction * t;
        let normal = (step - o) * line.radius.recip();
        Found { t: rounded.into(), point: line.origin + step, normal }
    }

    /// The same from afar, where the error of t would move the point: by the closest approach.
    ///
    /// Its foot, (h / a) d - o, is off by 8 u |o| along d, what h brings besides o's error, a, its reciprocal and a product; and by
    /// u |o| each for o and for the product with d: by less than 10 u |o|. The square of half the chord's length is off by
    /// 4 u r |o| for what the foot errs by at right angles to d, and by 5 u r²; that error along d counts as a square, as next to
    /// nothing. So half the length, s / √a, is off by less than 5 u r |o| over itself, and 4 u r.
    ///
    /// A root that is not rough has s / √a > 2⁻¹⁶ |o|, and both are off by less than 2⁻³¹ r. Of a rough one, s² is at least 43 u a m:
    /// then |o| < 2²³·⁸ r and s / √a > 2⁻²³·⁸ |o|, and they are off by 2⁻²⁵·⁸ r and 2⁻²⁶·⁸ r: by less than 2⁻²⁵ r together.
    #[inline(always)]
    fn found_from_afar(&self, chord: &Chord<f64>, rounded: f32) -> Found {
        let Self { line, o, radius_squared } = *self;
        let per_a = chord.a.recip();
        // From the center to the closest approach, and the square of half the chord's length.
        let foot = line.direction * (chord.h * per_a) - o;
        let square = radius_squared - foot.length_squared();
        let along = if is_not_positive(square) { 0.0 } else { sqrt(square * per_a) };
        let offset = foot - line.direction * along;
        let normal = offset * line.radius.recip();
        Found { t: rounded.into(), point: line.center + offset, normal }
    }
}

/// Rounds a root of the plain step that is close to the middle of two `f32`.
#[cold]
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "it is rounded already")]
fn round_carefully(line: &Line, t: f64, half_chord: f64) -> Option<f32> {
    let side = if half_chord > 0.0 { Side::Near } else { Side::Far };
    let compare = |midpoint| integers::compare_root(line, side, midpoint);
    Format::F32.round(t.into(), plain::ROOT_ERROR / CLEAR, compare).map(|t| t as f32)
}

/// The power where the plain one is too small to be certain.
#[cfg_attr(not(target_os = "none"), inline(always))]
#[cfg_attr(target_os = "none", inline(never))]
fn fine_power(sphere: &Sphere, ray: &Ray, larger: f64) -> f64 {
    let Setting { line, o, .. } = Setting::new(sphere, ray);
    halves::power(line, o, larger)
}

/// The nearest root of a line that starts exactly on the surface: its roots are 0 and 2 h / a.
#[cold]
#[inline(never)]
fn from_the_surface(line: &Line, chord: &Chord<f64>) -> Nearest {
    let Chord { a, h, distance_squared, .. } = *chord;
    let (power, error) = surface::power(line.o(), line.radius);
    // With h² > clear a m, h errs by less than the plain step's roots.
    if line.radius < 0.0
        || power.hi != 0.0
        || error != 0.0
        || h * h <= CLEAR * (a * distance_squared)
    {
        Nearest::Doubt
    } else if h < 0.0 {
        Nearest::Miss
    } else {
        Nearest::Root { t: 2.0 * h / a, half_chord: -h }
    }
}

/// The nearest hit where the plain step is in doubt: once more, as below.
#[cold]
#[inline(never)]
fn nearest_again<D: Derivation>(
    sphere: &Sphere,
    ray: &Ray,
    line: &Line,
    range: Range<f32>,
) -> Option<Found> {
    match plain_steps::<D, _>(&Setting::new(sphere, ray), sphere, ray, || line, &range) {
        Verdict::Miss => None,
        Verdict::Hit(found) => Some(found),
        Verdict::Doubt => {
            nearest_carefully_f32(sphere, ray, line, range.start.into()..range.end.into())
        }
    }
}

/// The nearest hit, by a call: where `f64` is software, that costs next to nothing, and copies of the plain steps much.
#[inline(never)]
fn intersect_by_a_call<D: Derivation>(
    sphere: &Sphere,
    ray: &Ray,
    range: Range<f32>,
) -> Option<Hit> {
    let setting = Setting::new(sphere, ray);
    // Where it is asked for, so that it need not be kept at hand.
    let line = || Line::new(sphere, ray);
    let found = match plain_steps::<D, _>(&setting, sphere, ray, line, &range) {
        Verdict::Miss => return None,
        Verdict::Hit(found) => found,
        Verdict::Doubt => {
            nearest_carefully_f32(sphere, ray, &line(), range.start.into()..range.end.into())?
        }
    };
    Some(hit(setting.line, found))
}

/// Takes the plain step, with a finer power close to the surface, and with the bound of the case from afar.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn plain_steps<D: Derivation, L: Borrow<Line>>(
    setting: &Setting,
    sphere: &Sphere,
    ray: &Ray,
    line: impl Fn() -> L,
    &Range { start, end }: &Range<f32>,
) -> Verdict<Found> {
    let chord = setting.chord::<D>();
    let fine_power = || {
        let larger = chord.distance_squared.max(setting.radius_squared);
        Some(fine_power(sphere, ray, larger))
    };
    let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
    // Below the range, the other root may be in it; below the normal numbers, rounding is another matter.
    let is_certain = |rounded: f32| rounded >= start && rounded >= f32::MIN_POSITIVE;
    let nearest = match plain::nearest_ahead(&chord, setting.radius_squared, CLEAR, fine_power) {
        Nearest::Doubt => from_the_surface(line().borrow(), &chord),
        nearest => nearest,
    };
    let (rounded, near) = match nearest {
        Nearest::Root { t, .. } if rounds_safely::<MARGIN>(t) => (t as f32, Some(t)),
        Nearest::Root { t, half_chord } => {
            let Some(rounded) = round_carefully(line().borrow(), t, half_chord) else {
                return Verdict::Doubt;
            };
            (rounded, Some(t))
        }
        Nearest::Rough { t, error } => {
            let [low, rounded] = [(t - error) as f32, (t + error) as f32];
            if low != rounded || !is_far {
                return Verdict::Doubt;
            }
            (rounded, None)
        }
        Nearest::Miss => return Verdict::Miss,
        Nearest::Doubt => return Verdict::Doubt,
    };
    if !is_certain(rounded) {
        return Verdict::Doubt;
    }
    if rounded >= end || end.is_nan() {
        return Verdict::Miss;
    }
    Verdict::Hit(match near {
        Some(t) if !is_far => setting.found(t, rounded),
        _ => setting.found_from_afar(&chord, rounded),
    })
}

impl Precision for Vec3 {
    const UNIT_ULP: f64 = f32::EPSILON as f64;
    const LEAST_POSITIVE: f64 = f32::from_bits(1) as f64;

    // Inlined always: so that what a caller does not use of the hit is not computed.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
    fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        if !HAS_F64 {
            return intersect_by_a_call::<D>(sphere, ray, range);
        }
        let setting = Setting::new(sphere, ray);
        let chord = setting.chord::<D>();
        match plain::nearest_ahead(&chord, setting.radius_squared, CLEAR, || None) {
            Nearest::Miss => return None,
            Nearest::Root { t, .. } => {
                let rounded = t as f32;
                // Below the range, the other root may be in it; below the normal numbers, rounding is another matter.
                if rounds_safely::<MARGIN>(t)
                    && rounded >= range.start
                    && rounded >= f32::MIN_POSITIVE
                {
                    if rounded >= range.end || range.end.is_nan() {
                        return None;
                    }
                    // The two apart, so that the compiler need not keep what one of them does without.
                    return if exceeds(chord.distance_squared, NEAR, setting.radius_squared) {
                        let found = setting.found_from_afar(&chord, rounded);
                        Some(hit(setting.line, found))
                    } else {
                        Some(hit(setting.line, setting.found(t, rounded)))
                    };
                }
            }
            Nearest::Rough { .. } | Nearest::Doubt => {}
        }
        let found = nearest_again::<D>(sphere, ray, &Line::new(sphere, ray), range)?;
        Some(hit(setting.line, found))
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
    fn roots<D: Derivation>(sphere: &Sphere, ray: &Ray) -> Option<[f32; 2]> {
        let setting = Setting::new(sphere, ray);
        match plain::both(&setting.chord::<D>(), setting.radius_squared, CLEAR) {
            Both::Miss => return None,
            Both::Roots { t: [near, far], .. }
                if rounds_safely::<MARGIN>(near) && rounds_safely::<MARGIN>(far) =>
            {
                let rounded = [near as f32, far as f32];
                if rounded[0].is_normal() && rounded[1].is_normal() {
                    return Some(rounded);
                }
            }
            _ => {}
        }
        both_carefully_f32(sphere, ray, &Line::new(sphere, ray))
            .map(|roots| roots.map(|root| root as f32))
    }
}

/// The hit, rounded.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded already")]
fn hit(line: Line, found: Found) -> Hit {
    let (t, point) = (found.t as f32, found.point.as_vec3());
    Hit { t, point, normal: found.normal.as_vec3(), error: point_error(t, line) }
}

/// How far off the point may be besides the rounding of its coordinates, and more: see [`Hit::clearance`].
///
/// The point is off by at most the smaller of 2⁻³¹ of the distance travelled and 2⁻²⁵ of the radius; here are 2⁻²⁹ of the largest
/// coordinate of the way travelled, which is at least 1/√3 of it, and 2⁻²⁴ of the radius. A direction that is outward by the
/// rounded normal is inward in truth by no more than that is off, e < √3 2⁻²⁵, and passes the surface from e² r / 2 above it; here
/// are 2⁻⁴⁸ r.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "there is room for rounding")]
fn point_error(t: f32, line: Line) -> f32 {
    const OF_DISTANCE: f32 = f32::EPSILON / 64.0;
    const OF_RADIUS: f32 = f32::EPSILON / 2.0;
    const OF_CURVATURE: f32 = f32::EPSILON * f32::EPSILON / 4.0;
    // Not `f32::max`, which takes care of NaN: here there is none.
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let Vec3 { x, y, z } = line.direction.as_vec3().abs();
    let travelled = t * larger(larger(x, y), z);
    let radius = line.radius as f32;
    smaller(travelled * OF_DISTANCE, radius * OF_RADIUS) + radius * OF_CURVATURE
}
