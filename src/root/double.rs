//! `f64`: the plain step, a correction of its root, and one rounding.

use core::ops::Range;

use glam::DVec3;

use super::answer::{Found, Question, Side};
use super::chord::{Chord, Derivation};
use super::format::Format;
use super::halves::{self, Correction};
use super::line::{Line, Setting};
use super::plain::{self, Both, Nearest};
use super::precision::Precision;
use super::{ask_carefully, near_surface, power, ties};
use crate::algebraic::Quadratic;
use crate::arithmetic::pair::LEAST_PAIR;
use crate::float::sqrt;
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
pub(super) mod tests;

/// Whether a square, a or the larger of o·o and r², is between 2⁻⁴⁸⁰ and 2⁴⁸⁰: then no product of two of them overflows, and
/// what underflows on the way is far below the error bounds.
#[inline(always)]
pub(super) fn is_safe(square: f64) -> bool {
    const LEAST: u64 = (1023 - 480) << 52;
    const SPAN: u64 = 960 << 52;
    // Above the span are all negative numbers, infinities and NaN.
    square.to_bits().wrapping_sub(LEAST) < SPAN
}

impl Setting {
    /// The chord, unless its terms might overflow or underflow.
    #[inline(always)]
    fn safe_chord<D: Derivation>(&self) -> Option<Chord<f64>> {
        let chord = self.chord::<D>();
        (is_safe(chord.a) && is_safe(self.larger(&chord))).then_some(chord)
    }

    /// m.
    #[inline(always)]
    fn larger(&self, chord: &Chord<f64>) -> f64 {
        if chord.power > 0.0 { chord.distance_squared } else { self.radius_squared }
    }

    #[inline(always)]
    fn correction(&self, chord: &Chord<f64>) -> Correction {
        Correction::new(self.line, self.o, chord, self.radius_squared)
    }
}

/// The nearest hit where the plain step is in doubt: from close to the surface by a finer power.
#[cold]
#[inline(never)]
fn nearest_again(line: &Line, range: Range<f64>) -> Option<Found> {
    if !Format::F64.has_few_steps() {
        if let Some(nearest) = from_the_surface(*line, &range) {
            return nearest;
        }
    }
    ask_carefully(line, Format::F64, &Question::Nearest(range))?.nearest()
}

/// 2⁻⁵⁰⁰, the square of which is not safe.
const LEAST_LENGTH: f64 = f64::from_bits((1023 - 500) << 52);

/// The nearest hit of a line that starts close to the surface, or that there is none; `None` where that is not certain.
#[inline(always)]
#[expect(clippy::option_option, reason = "a certain miss is an answer, too")]
fn from_the_surface(line: Line, range: &Range<f64>) -> Option<Option<Found>> {
    // No product of subnormal numbers is of use, and each takes long.
    if line.radius < LEAST_LENGTH || line.direction.abs().max_element() < LEAST_LENGTH {
        return None;
    }
    let setting = Setting::of(line);
    let radius_squared = setting.radius_squared;
    let chord = setting.safe_chord::<Quadratic>()?;
    let half_chord = sqrt(chord.discriminant);
    let larger = chord.distance_squared.max(radius_squared);
    if !near_surface::is_close(&chord, half_chord, larger) {
        return None;
    }
    let o = line.o();
    let power = power::accurate_power(o, line.radius);
    // As certain as rounding needs, too.
    if power.1 > f64::EPSILON / 1024.0 * power.0.hi.abs() {
        return None;
    }
    let (is_outside, is_behind) = (power.0.hi > 0.0, chord.h < 0.0);
    if is_behind && power.0.hi >= 0.0 {
        // Both roots are behind, or the far one is 0.
        return Some(None);
    }
    if is_outside || is_behind {
        let root = near_surface::small_root(o, line.direction.into(), &chord, half_chord, power);
        if root.0.hi.abs() < LEAST_PAIR {
            return None;
        }
        let side = if is_outside { Side::Near } else { Side::Far };
        let t = Format::F64.round(root.0, root.1, |midpoint| {
            ties::compare_root(&{ line }, side, midpoint, None)
        })?;
        if t > 0.0 && range.contains(&t) {
            return near_surface::hit(line, o, side, root, t).map(Some);
        }
        if is_behind || t >= range.start {
            return Some(None);
        }
    }
    // The far root, where nothing cancels.
    let t = plain::far_root(&chord, half_chord);
    let size = radius_squared * larger;
    let corrected = setting.correction(&chord).correct_surely(t, half_chord, size)?;
    if !range.contains(&corrected.t.hi) {
        return Some(None);
    }
    corrected.hit(line, sqrt(chord.a), sqrt(larger), half_chord).map(Some)
}

impl Precision for DVec3 {
    const UNIT_ULP: f64 = f64::EPSILON;
    const LEAST_POSITIVE: f64 = f64::from_bits(1);

    #[inline(always)]
    fn next_above(t: f64) -> f64 {
        f64::from_bits(t.to_bits().wrapping_add(1))
    }

    #[inline(always)]
    fn intersect<D: Derivation>(
        sphere: &Sphere<Self>,
        ray: &Ray<Self>,
        range: Range<f64>,
    ) -> Option<Hit<Self>> {
        let setting = Setting::new(sphere, ray);
        let line = setting.line;
        if let Some(chord) = setting.safe_chord::<D>() {
            match plain::nearest_ahead(&chord, setting.radius_squared, halves::CLEAR, || None) {
                Nearest::Miss => return None,
                Nearest::Root { t, half_chord } => {
                    let size = setting.radius_squared * setting.larger(&chord);
                    let correction = setting.correction(&chord);
                    let (mut t, mut is_far) = (t, half_chord < 0.0);
                    let half_chord = half_chord.abs();
                    // One copy of the code for both roots.
                    while let Some(root) = correction.correct_surely(t, half_chord, size) {
                        let t_rounded = root.t.hi;
                        if t_rounded >= range.start {
                            return (t_rounded < range.end).then(|| {
                                let normal = root.offset() / line.radius;
                                hit(line, t_rounded, root.point(), normal)
                            });
                        }
                        if is_far {
                            return None;
                        }
                        // Where the near root is below the range, the far one may be in it.
                        (t, is_far) = (plain::far_root(&chord, half_chord), true);
                    }
                }
                Nearest::Doubt => {}
            }
        }
        let found = nearest_again(&Line::new(sphere, ray), range)?;
        Some(hit(line, found.t, found.point, found.normal))
    }

    fn exit_at_same_t(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<Hit<Self>> {
        let line = Line::new(sphere, ray);
        let found = ask_carefully(&line, Format::F64, &Question::Exit)?.nearest()?;
        Some(hit(line, found.t, found.point, found.normal))
    }

    #[inline(always)]
    fn roots<D: Derivation>(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<[f64; 2]> {
        let setting = Setting::new(sphere, ray);
        if let Some(chord) = setting.safe_chord::<D>() {
            match plain::both(&chord, setting.radius_squared, halves::CLEAR, || None) {
                Both::Miss => return None,
                Both::Roots { t: [near, far], half_chord } => {
                    let correction = setting.correction(&chord);
                    let size = setting.radius_squared * setting.larger(&chord);
                    let near = correction.correct_surely(near, half_chord, size);
                    let far = correction.correct_surely(far, half_chord, size);
                    if let (Some(near), Some(far)) = (near, far) {
                        return Some([near.t.hi, far.t.hi]);
                    }
                }
                Both::Doubt => {}
            }
        }
        ask_carefully(&Line::new(sphere, ray), Format::F64, &Question::Both)?.roots()
    }
}

/// The hit.
#[inline(always)]
fn hit(line: Line, t: f64, point: DVec3, normal: DVec3) -> Hit<DVec3> {
    Hit { t, point, normal, error: point_error(t, line) }
}

/// How far off the point may be besides the rounding of its coordinates, and more: see [`Hit::clearance`].
///
/// As for `f32`, where the point may be off by the smaller of 2⁻⁶⁰ of the distance travelled and 2⁻⁵³ of the radius, and the
/// normal by e < √3 2⁻⁵².
#[inline(always)]
fn point_error(t: f64, line: Line) -> f64 {
    const OF_DISTANCE: f64 = f64::EPSILON / 64.0;
    const OF_RADIUS: f64 = f64::EPSILON;
    const OF_CURVATURE: f64 = 2.0 * f64::EPSILON * f64::EPSILON;
    // Not `f64::max`, which takes care of NaN: here there is none.
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    let DVec3 { x, y, z } = line.direction.abs();
    let travelled = t * larger(larger(x, y), z);
    smaller(travelled * OF_DISTANCE, line.radius * OF_RADIUS) + line.radius * OF_CURVATURE
}
