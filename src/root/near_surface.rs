//! From close to the surface: the small root from a power in three floats.
//!
//! There nearly all of the power o·o - r² cancels, and nothing else does: the discriminant is nearly h². The small root solves
//! t (2 h - a t) = power, and is taken from that where a |power| < h² / 16, so that s, half the chord, is more than 0.96 |h|, and
//! 2 s² > 2⁻¹⁶ a m. A root by the bounds of the plain step, but with this power, errs by e < 2⁻³³ of itself. It is corrected by
//! one step of Newton's. What the root errs by after that comes from these, as a part of itself:
//!
//! ```text
//! the power           what it errs by, as a part of itself
//! the curvature       e² a t / 2 s, where a t < s / 29              < 2⁻⁷¹
//! the slope           e times what it errs by, 4 u √(a m) / s       < 2⁻⁷⁵
//! compensated a, h    32 v √(a m) / 2 s                             < 2⁻⁹⁰
//! the rest            a few v
//! ```

use core::ops::Range;

use glam::DVec3;

use super::answer::{Found, Side};
use super::chord::Chord;
use super::format::Format;
use super::line::{Line, Setting};
use super::points::{self, Crossing, Near};
use super::{halves, plain, power, ties};
use crate::algebraic::Quadratic;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    LEAST_PAIR, Pair, U, V, compensated_dot, fast_two_sum, two_difference, two_product, two_sum,
};
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// The least 2 s², in a m.
const CLEAR: f64 = 1.0 / 65536.0;

/// Of the root, as a part of itself, besides what the power brings with it: 2⁻⁷⁰.
const ROOT_ERROR: f64 = U / 131_072.0;

/// Whether a line starts close enough to the surface.
#[inline(always)]
fn is_close(chord: &Chord<f64>, half_chord: f64, larger: f64) -> bool {
    let Chord { a, h, power, .. } = *chord;
    let a_larger = a * larger;
    // With a thousandth of the square to spare for what the plain power errs by.
    a * power.abs() < h * h * (1.0 / 17.0) && 2.0 * half_chord * half_chord > CLEAR * a_larger
}

/// The small root, from a power whose sign is certain, and its relative error.
#[inline(always)]
fn small_root(
    o: Triple<Pair>,
    d: Triple<f64>,
    chord: &Chord<f64>,
    half_chord: f64,
    (power, power_error): (Pair, f64),
) -> (Pair, f64) {
    let sum = if chord.h < 0.0 { chord.h - half_chord } else { chord.h + half_chord };
    let t = power.hi / sum;
    let a = compensated_dot(d, d);
    let h = compensated_dot(d, o.map(|o| o.hi));
    let h_low = h.lo + d.dot(o.map(|o| o.lo));

    // power - t (2 h - a t), over the slope 2 (h - a t).
    let at = two_product(a.hi, t);
    let slope = two_difference(2.0 * h.hi, at.hi);
    let slope_low = slope.lo + (2.0 * h_low - (at.lo + a.lo * t));
    let product = two_product(slope.hi, t);
    let residual = (power.hi - product.hi) + (power.lo - (product.lo + slope_low * t));
    let correction = residual / (slope.hi - at.hi);
    (fast_two_sum(t, correction), power_error / power.hi.abs() + ROOT_ERROR)
}

/// The hit at the small root, if that and its relative error make certain how it is rounded.
///
/// A product of the root and a coordinate of the direction errs by 4 v besides; of the low parts of a sum two additions are
/// rounded, and that of the error. No coordinate of o is above 1.1 r, and the way is a seventeenth of r.
#[inline(always)]
fn hit(
    line: Line,
    format: Format,
    o: Triple<Pair>,
    side: Side,
    (root, relative_error): (Pair, f64),
    t: f64,
) -> Option<Found> {
    const PRODUCT_ERROR: f64 = 6.0 * V;
    const SUM_ERROR: f64 = 4.0 * V;
    let d = Triple::from(line.direction);
    let step = d.map(|d| root.times(d));
    let sum = |start: Pair, step: Pair| {
        let sum = two_sum(start.hi, step.hi);
        Pair { hi: sum.hi, lo: sum.lo + (start.lo + step.lo) }
    };
    let size = |v: DVec3| v.x.abs() + v.y.abs() + v.z.abs();
    let of_root = (relative_error + PRODUCT_ERROR) * (root.hi.abs() * size(line.direction));
    let point = Triple::from(line.origin).zip(step, |p, step| sum(p.into(), step));
    let offset = o.zip(step, |o, step| sum(-o, step));
    let point = Near::within(point, of_root + SUM_ERROR * (size(line.origin) + line.radius));
    let offset = Near::within(offset, of_root + SUM_ERROR * (2.0 * line.radius));
    let crossing = Crossing { side, point, offset };
    points::surely(line, format, t, crossing)
}

/// 2⁻⁵⁰⁰, the square of which is not safe.
const LEAST_LENGTH: f64 = f64::from_bits((1023 - 500) << 52);

/// The nearest hit of a line that starts close to the surface, or that there is none; `None` where that is not certain.
#[inline(always)]
#[expect(clippy::option_option, reason = "a certain miss is an answer, too")]
pub(super) fn from_the_surface(
    line: Line,
    format: Format,
    range: &Range<f64>,
) -> Option<Option<Found>> {
    // No product of subnormal numbers is of use, and each takes long.
    if line.radius < LEAST_LENGTH || line.direction.abs().max_element() < LEAST_LENGTH {
        return None;
    }
    let setting = Setting::of(line);
    let radius_squared = setting.radius_squared;
    let chord = setting.safe_chord::<Quadratic>()?;
    let half_chord = sqrt(chord.discriminant);
    let larger = setting.larger(&chord);
    if !is_close(&chord, half_chord, larger) {
        return None;
    }
    let o = line.o();
    let power = power::accurate_power(o, line.radius);
    // As certain as rounding needs, too.
    if power.1 > f64::EPSILON / 1024.0 * power.0.hi.abs() {
        return None;
    }
    let (is_outside, is_behind) = (power.0.hi > 0.0, chord.h < 0.0);
    let is_accepted = |t: f64| t > 0.0 && range.contains(&t);
    if is_behind && power.0.hi >= 0.0 {
        // Both roots are behind, or the far one is 0.
        return Some(None);
    }
    if is_outside || is_behind {
        let root = small_root(o, line.direction.into(), &chord, half_chord, power);
        if root.0.hi.abs() < LEAST_PAIR {
            return None;
        }
        let side = if is_outside { Side::Near } else { Side::Far };
        let compare = |midpoint| ties::compare_root(&{ line }, side, midpoint, None);
        let t = format.round(root.0, root.1, compare)?;
        if is_accepted(t) {
            return hit(line, format, o, side, root, t).map(Some);
        }
        if is_behind || t > 0.0 && t >= range.start {
            return Some(None);
        }
    }
    // The far root, where nothing cancels.
    let t = plain::far_root(&chord, half_chord);
    let size = radius_squared * larger;
    let corrected = setting.correction(&chord).correct_surely(t, half_chord, size)?;
    let t = format.round(corrected.t, halves::ROOT_ERROR, |_| None)?;
    if !is_accepted(t) {
        return Some(None);
    }
    corrected.hit(line, format, t, [sqrt(chord.a), sqrt(larger), half_chord]).map(Some)
}
