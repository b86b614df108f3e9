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

use super::chord::Chord;
use super::crossing::{Found, Line, Side};
use super::format::Format;
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

/// Of the power in pairs, in m.
///
/// What is rounded in o·o is 8 v, in 2 o·o.lo 6 v, the square of o.lo 1 v, and three additions 5, 7 and 9 v: 36 v.
pub(super) const POWER_ERROR: f64 = 40.0 * V;

/// o·o - r² in pairs, and m.
#[cfg_attr(not(target_os = "none"), inline(always))]
#[cfg_attr(target_os = "none", inline(never))]
pub(super) fn power_in_pairs(exact_o: Triple<Pair>, radius: f64) -> (Pair, f64) {
    let (o, o_low) = (exact_o.map(|o| o.hi), exact_o.map(|o| o.lo));
    let radius_squared = two_product(radius, radius);
    let distance_squared = compensated_dot(o, o);
    let difference = two_difference(distance_squared.hi, radius_squared.hi);
    let low = (distance_squared.lo - radius_squared.lo) + 2.0 * o.dot(o_low);
    // Where the difference is smaller than the low part, at most 8 u m, it is that of squares within twice each other, and so a
    // multiple of 2⁻⁵⁴ m, far above the last place of the low part.
    let power = fast_two_sum(difference.hi, difference.lo + low);
    (power, distance_squared.hi.max(radius_squared.hi))
}

/// o·o - r², and how far off that may be, which is not at all where that is 0.
///
/// First in pairs. Where their error is much of the power, what cancels is added up by two sums whose errors are kept: of the
/// leading terms, and of the at most 10 u m in the low parts and errors of these. The rest, at most 93 v m, is added up plainly,
/// and errs by 1,400 u³ m. Where that is still much, by what there really is of a rest: with coordinates of few digits, nothing.
#[inline(always)]
pub(super) fn power(exact_o: Triple<Pair>, radius: f64) -> (Pair, f64) {
    const CLOSE_ERROR: f64 = 1500.0 * U * V;
    const CLOSE: f64 = 1.0 / 1_073_741_824.0; // 2^-30
    const CLOSER: f64 = CLOSE * CLOSE * CLOSE; // 2^-90

    let (power, larger) = power_in_pairs(exact_o, radius);
    if power.hi.abs() > CLOSE * larger {
        return (power, POWER_ERROR * larger);
    }
    let terms = Terms::new(exact_o, radius);
    let (power, ..) = terms.sum();
    if power.hi.abs() > CLOSER * larger {
        return (power, CLOSE_ERROR * larger + 2.0 * V * power.hi.abs());
    }
    closest_power(exact_o, radius)
}

/// The same, with an error of what there is of a rest: for where the power is likely to be 0, or next to it.
///
/// It is 0 for sure only where every term is exact: where o is a number in each coordinate, and no square underflows.
#[cold]
#[inline(never)]
pub(super) fn closest_power(exact_o: Triple<Pair>, radius: f64) -> (Pair, f64) {
    /// Of the rest's terms. The first of the low sums' errors passes most additions: 8 of the others, that of the smaller terms,
    /// and that to the low part of the whole, 10 in all. The magnitudes are rounded as often, which is of the second order.
    const REST_ERROR: f64 = 16.0 * U;
    let (power, rest) = Terms::new(exact_o, radius).sum();
    let Triple { x, y, z } = exact_o.map(|o| o.lo == 0.0 && is_whole(o.hi));
    let is_zero = power.hi == 0.0 && rest == 0.0 && is_whole(radius) && x && y && z;
    // The least is for what may underflow.
    let error = REST_ERROR * rest + 2.0 * V * power.hi.abs() + f64::MIN_POSITIVE;
    (power, if is_zero { 0.0 } else { error })
}

/// The terms of o·o - r².
struct Terms {
    leading: f64,
    low: [f64; 10],
    /// What is smaller still.
    rest: [f64; 4],
}

impl Terms {
    #[inline(always)]
    fn new(exact_o: Triple<Pair>, radius: f64) -> Self {
        let (o, o_low) = (exact_o.map(|o| o.hi), exact_o.map(|o| o.lo));
        let radius_squared = two_product(radius, radius);
        let Triple { x, y, z } = o.map(|o| two_product(o, o));
        let cross = o.zip(o_low, |o, low| two_product(2.0 * o, low));
        let xy = two_sum(x.hi, y.hi);
        let xyz = two_sum(xy.hi, z.hi);
        let leading = two_difference(xyz.hi, radius_squared.hi);
        Self {
            leading: leading.hi,
            low: [
                x.lo,
                y.lo,
                z.lo,
                -radius_squared.lo,
                xy.lo,
                xyz.lo,
                leading.lo,
                cross.x.hi,
                cross.y.hi,
                cross.z.hi,
            ],
            rest: [cross.x.lo, cross.y.lo, cross.z.lo, o_low.dot(o_low)],
        }
    }

    /// Their sum, and that of the rest's magnitudes.
    #[inline(always)]
    fn sum(&self) -> (Pair, f64) {
        let Self { leading, low: [first, others @ ..], rest: [x, y, z, square] } = *self;
        let (low, rest, magnitude) =
            others.into_iter().fold((first, 0.0, 0.0), |(low, rest, magnitude), term| {
                let sum = two_sum(low, term);
                (sum.hi, rest + sum.lo, magnitude + sum.lo.abs())
            });
        let rest = rest + ((x + y) + (z + square));
        let magnitude = magnitude + ((x.abs() + y.abs()) + (z.abs() + square));
        let sum = two_sum(leading, low);
        (two_sum(sum.hi, sum.lo + rest), magnitude)
    }
}

/// Whether the square of a number is exactly a pair, because nothing of it underflows.
#[inline(always)]
fn is_whole(x: f64) -> bool {
    const LEAST: f64 = f64::from_bits((1023 - 450) << 52); // 2^-450
    x == 0.0 || x.abs() > LEAST
}

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
    let crossing = Crossing::new(side, point, offset, line.radius);
    points::surely(line, Format::F64, t, crossing)
}
