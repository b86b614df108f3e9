//! From close to the surface, in `f64`: the small root from a power in three floats.
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

use glam::DVec3;

use super::answer::{Found, Side};
use super::chord::Chord;
use super::format::Format;
use super::line::Line;
use super::points::{self, Crossing, Near};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    Pair, U, V, compensated_dot, fast_two_sum, two_difference, two_product, two_sum,
};

#[cfg(test)]
mod tests;

/// The least 2 s², in a m.
const CLEAR: f64 = 1.0 / 65536.0;

/// Of the root, as a part of itself, besides what the power brings with it: 2⁻⁷⁰.
const ROOT_ERROR: f64 = U / 131_072.0;

/// Whether a line starts close enough to the surface.
#[inline(always)]
pub(super) fn is_close(chord: &Chord<f64>, half_chord: f64, larger: f64) -> bool {
    let Chord { a, h, power, .. } = *chord;
    let a_larger = a * larger;
    // With a thousandth of the square to spare for what the plain power errs by.
    a * power.abs() < h * h * (1.0 / 17.0) && 2.0 * half_chord * half_chord > CLEAR * a_larger
}

/// The small root, from a power whose sign is certain, and its relative error.
#[inline(always)]
pub(super) fn small_root(
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
pub(super) fn hit(
    line: Line,
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
    points::surely(line, Format::F64, t, crossing)
}
