//! o·o - r², the power of a line's origin, where nearly all of it cancels: in halves of 26 bits, in pairs, in three floats, and as
//! closely as floats go.
//!
//! In plain `f64` it is part of a [`chord`](super::chord), and exact integers of it are in `narrow` and `surds`.

use glam::DVec3;

use super::line::Line;
use crate::arithmetic::half::{Half, Halves, splitter};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    Pair, U, V, compensated_dot, fast_two_sum, two_difference, two_product, two_sum,
};

#[cfg(test)]
mod tests;

/// From the ray's origin to the center in halves: `o` is that rounded, and what was rounded goes into the low part.
#[inline(always)]
pub(super) fn to_center(line: Line, o: DVec3, splitter: f64) -> Halves {
    let Halves { high, low } = Halves::new(o, splitter);
    let rounded = DVec3::from(line.o().map(|o| o.lo));
    Halves { high, low: low + rounded }
}

/// o·o - r² in halves, off by at most 2⁻⁷⁶ m besides the rounding of the result, with `o` rounded and m as `larger`.
///
/// The sum of high parts is exact. What is rounded are o.low, 2⁻⁸⁰ of |o|, and the products and sums with low parts, of at most
/// 2⁻²⁵ m each.
#[inline(always)]
pub(super) fn power_in_halves(line: Line, o: DVec3, larger: f64) -> f64 {
    let splitter = splitter(larger);
    let Halves { high, low } = to_center(line, o, splitter);
    let radius = Half::new(line.radius, splitter);
    let leading = high.dot(high) - radius.high * radius.high;
    leading + (low.dot(o + high) - radius.low * (line.radius + radius.high))
}

/// Of the power in pairs, in m.
///
/// What is rounded in o·o is 8 v, in 2 o·o.lo 6 v, the square of o.lo 1 v, and three additions 5, 7 and 9 v: 36 v.
pub(super) const POWER_ERROR: f64 = 40.0 * V;

/// o·o - r² in pairs, and m.
#[inline(always)]
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
pub(super) fn accurate_power(exact_o: Triple<Pair>, radius: f64) -> (Pair, f64) {
    const CLOSE_ERROR: f64 = 1500.0 * U * V;
    const CLOSE: f64 = 1.0 / 1_073_741_824.0; // 2^-30
    const CLOSER: f64 = CLOSE * CLOSE * CLOSE; // 2^-90

    let (power, larger) = power_in_pairs(exact_o, radius);
    if power.hi.abs() > CLOSE * larger {
        return (power, POWER_ERROR * larger);
    }
    let (power, rest) = Terms::new(exact_o, radius).sum();
    if power.hi.abs() > CLOSER * larger {
        return (power, CLOSE_ERROR * larger + 2.0 * V * power.hi.abs());
    }
    (power, closest_error(exact_o, radius, power, rest))
}

/// The same, with an error of what there is of a rest: for where the power is likely to be 0, or next to it.
#[inline(always)]
pub(super) fn closest_power(exact_o: Triple<Pair>, radius: f64) -> (Pair, f64) {
    let (power, rest) = Terms::new(exact_o, radius).sum();
    (power, closest_error(exact_o, radius, power, rest))
}

/// The error by what there is of a rest, the sum of whose magnitudes is given.
///
/// The power is 0 for sure only where every term is exact: where o is a number in each coordinate, and no square underflows.
#[inline(always)]
fn closest_error(exact_o: Triple<Pair>, radius: f64, power: Pair, rest: f64) -> f64 {
    /// Of the rest's terms. The first of the low sums' errors passes most additions: 8 of the others, that of the smaller terms,
    /// and that to the low part of the whole, 10 in all. The magnitudes are rounded as often, which is of the second order.
    const REST_ERROR: f64 = 16.0 * U;
    let Triple { x, y, z } = exact_o.map(|o| o.lo == 0.0 && is_whole(o.hi));
    let is_zero = power.hi == 0.0 && rest == 0.0 && is_whole(radius) && x && y && z;
    // The least is for what may underflow.
    let error = REST_ERROR * rest + 2.0 * V * power.hi.abs() + f64::MIN_POSITIVE;
    if is_zero { 0.0 } else { error }
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
