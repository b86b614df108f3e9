//! The geometric derivation in pairs, with a bound on the error of the very case.
//!
//! With v = u² = 2⁻¹⁰⁶, P = |o| |d|, M = |o × d|, m the larger of o·o and r², o = c - p exactly a pair, r² too but for what
//! underflows, and by the bounds in [`pair`](crate::arithmetic::pair), to first order:
//!
//! ```text
//! a             a compensated dot product                                            |error| ≤  8 v a
//! h             d·o.hi: 8 v P;  d·o.lo, at most u P: 3 v P;  their addition: 5 v P    |error| ≤ 16 v P
//! o × d         o.hi products and their difference exact;  what is rounded in the difference of the products' low parts, 1 v,
//!               in each product with o.lo, 1 v, in the difference of these, 1 v, and in two additions, 2 v and 3 v, each of
//!               |o_j d_k| + |o_k d_j|: at most √2 P altogether                       |error| ≤ 12 v P
//! M²            of each square: the product with the low part 2 v, the square of that 1 v, an addition 3 v; of their sum
//!               12 v;  and 2 M |error of o × d| + |that|²            |error| ≤ 18 v M² + 24 v M P + 144 v² P²
//! r² a          a: 8 v;  the product 16 v                                            |error| ≤ 24 v r² a
//! discriminant  their difference: 12 v (r² a + M²)        |error| ≤ 36 v r² a + 30 v M² + 24 v M P + 144 v² P²
//! power         see there
//! ```

use glam::DVec3;

use super::crossing::{Crossings, Estimate, Found, Line, Root, Side, Verdict};
use super::format::Format;
use super::integers;
use super::surface::power;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    COMPENSATED_DOT_ERROR, Pair, QUOTIENT_ERROR, ROOT_ERROR, SUM_ERROR, V, compensated_dot,
    fast_two_sum, two_difference, two_product, two_sum,
};
use crate::arithmetic::scaling::{exponent, scale};
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// Of h, in P.
pub(super) const H_ERROR: f64 = 16.0 * V;
/// Of o × d, in P.
pub(super) const MOMENT_ERROR: f64 = 12.0 * V;
/// Of the discriminant, in r² a + M (M + P); a tenth part for the rounding of this bound.
pub(super) const DISCRIMINANT_ERROR: f64 = 40.0 * V;
/// Of the discriminant too, in P²; likewise.
pub(super) const MOMENT_ERROR_SQUARED: f64 = 160.0 * V * V;
/// Of a root besides what h, the discriminant and the power bring with them, in itself: of a, and of the quotient, and two to spare.
const ROOT_QUOTIENT_ERROR: f64 = COMPENSATED_DOT_ERROR + QUOTIENT_ERROR + 2.0 * V;

/// Lengths and directions, each divided by a power of two that brings them near 1.
pub(super) struct Scaled {
    pub(super) o: Triple<Pair>,
    pub(super) d: Triple<f64>,
    pub(super) radius: f64,
    length_exponent: i32,
    direction_exponent: i32,
}

impl Scaled {
    /// `None` where the difference of the positions is no pair, or all lengths are zero.
    #[inline(always)]
    pub(super) fn new(line: &Line) -> Option<Self> {
        /// Fourth powers of what lies within this of 1 neither overflow nor lose anything in a pair.
        const NEAR: i32 = 200;
        let o = line.o();
        let is_pair = |pair: Pair| pair.hi.is_finite() && pair.lo.is_finite();
        let longest = o.x.hi.abs().max(o.y.hi.abs()).max(o.z.hi.abs()).max(line.radius);
        if !(is_pair(o.x) && is_pair(o.y) && is_pair(o.z)) || longest == 0.0 {
            return None;
        }
        let Line { direction, radius, .. } = *line;
        let d = Triple::from(direction);
        let length_exponent = exponent(longest);
        let direction_exponent = exponent(direction.abs().max_element());
        if length_exponent.abs() < NEAR && direction_exponent.abs() < NEAR {
            return Some(Self { o, d, radius, length_exponent: 0, direction_exponent: 0 });
        }
        // What this rounds, far below the largest of its kind, is below every error bound.
        let shorten = |x: f64| scale(x, -length_exponent);
        Some(Self {
            o: o.map(|pair| Pair { hi: shorten(pair.hi), lo: shorten(pair.lo) }),
            d: d.map(|x| scale(x, -direction_exponent)),
            radius: shorten(radius),
            length_exponent,
            direction_exponent,
        })
    }

    /// A root in units of the caller's, if that is exact.
    #[inline(always)]
    pub(super) fn unscaled_root(&self, t: Pair) -> Option<Pair> {
        /// 2⁻⁹⁰⁰: far enough above the subnormal numbers for the low part to be whole.
        const LEAST: f64 = f64::from_bits((1023 - 900) << 52);
        let e = self.length_exponent - self.direction_exponent;
        if e == 0 {
            return Some(t);
        }
        let unscaled = Pair { hi: scale(t.hi, e), lo: scale(t.lo, e) };
        (unscaled.hi.is_finite() && unscaled.hi.abs() > LEAST).then_some(unscaled)
    }

    pub(super) fn o_high(&self) -> DVec3 {
        self.o.map(|o| o.hi).into()
    }

    pub(super) fn o_low(&self) -> DVec3 {
        self.o.map(|o| o.lo).into()
    }
}

/// The chord in pairs, with its errors.
pub(super) struct InPairs<'a> {
    line: &'a Line,
    format: Format,
    scaled: Scaled,
    pub(super) a: Pair,
    pub(super) h: Pair,
    /// o × d.
    pub(super) moment: Triple<Pair>,
    /// √discriminant.
    pub(super) half_chord: Pair,
    pub(super) half_chord_error: f64,
    /// P.
    reach: f64,
}

/// o × d.
#[inline(always)]
pub(super) fn moment(o: Triple<Pair>, d: Triple<f64>) -> Triple<Pair> {
    let coordinate = |oj: Pair, dk: f64, ok: Pair, dj: f64| {
        let (x, y) = (two_product(oj.hi, dk), two_product(ok.hi, dj));
        let difference = two_difference(x.hi, y.hi);
        let low = (x.lo - y.lo) + (oj.lo * dk - ok.lo * dj);
        fast_two_sum(difference.hi, difference.lo + low)
    };
    Triple {
        x: coordinate(o.y, d.z, o.z, d.y),
        y: coordinate(o.z, d.x, o.x, d.z),
        z: coordinate(o.x, d.y, o.y, d.x),
    }
}

/// The square of a vector's length.
#[inline(always)]
fn square(vector: Triple<Pair>) -> Pair {
    let [x, y, z] = [vector.x, vector.y, vector.z].map(|coordinate| {
        let square = two_product(coordinate.hi, coordinate.hi);
        Pair { hi: square.hi, lo: square.lo + 2.0 * (coordinate.hi * coordinate.lo) }
    });
    let xy = two_sum(x.hi, y.hi);
    let xyz = two_sum(xy.hi, z.hi);
    Pair { hi: xyz.hi, lo: (x.lo + y.lo) + (z.lo + (xy.lo + xyz.lo)) }
}

/// Takes the chord of a valid line.
#[inline(always)]
pub(super) fn chord(line: &Line, format: Format) -> Verdict<InPairs<'_>> {
    let Some(scaled) = Scaled::new(line) else { return Verdict::Doubt };
    let Scaled { o, d, radius, .. } = scaled;
    let a = compensated_dot(d, d);
    let radius_squared = two_product(radius, radius);
    let moment = moment(o, d);
    let moment_squared = square(moment);
    let a_radius_squared = two_product(a.hi, radius_squared.hi);
    let a_radius_squared_low =
        a_radius_squared.lo + (a.hi * radius_squared.lo + a.lo * radius_squared.hi);
    let difference = two_difference(a_radius_squared.hi, moment_squared.hi);
    let discriminant =
        fast_two_sum(difference.hi, difference.lo + (a_radius_squared_low - moment_squared.lo));

    let o_high = Triple::from(scaled.o_high());
    let reach_squared = a.hi * o_high.dot(o_high);
    let error = DISCRIMINANT_ERROR
        * (a_radius_squared.hi + moment_squared.hi + sqrt(moment_squared.hi) * sqrt(reach_squared))
        + MOMENT_ERROR_SQUARED * reach_squared;
    if discriminant.hi < -error {
        return Verdict::Miss;
    }
    if discriminant.hi <= error {
        return Verdict::Doubt;
    }
    let half_chord = discriminant.sqrt();
    let h = compensated_dot(d, o_high);
    let h_low = h.lo + d.dot(scaled.o_low().into());
    Verdict::Hit(InPairs {
        line,
        format,
        a,
        h: fast_two_sum(h.hi, h_low),
        moment,
        half_chord,
        // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
        half_chord_error: error / half_chord.hi + ROOT_ERROR * half_chord.hi,
        reach: sqrt(reach_squared),
        scaled,
    })
}

impl InPairs<'_> {
    /// The root on that side, unless it might be of either sign.
    #[inline(always)]
    pub(super) fn estimate(&self, side: Side) -> Option<Estimate> {
        let Self { a, h, half_chord, .. } = *self;
        let [sum, other] = match side {
            Side::Near => [h - half_chord, h + half_chord],
            Side::Far => [h + half_chord, h - half_chord],
        };
        let error =
            H_ERROR * self.reach + self.half_chord_error + SUM_ERROR * (h.hi.abs() + half_chord.hi);
        let exponent = self.scaled.length_exponent;
        // The errors of quotients are doubled for their terms of second order.
        if sum.hi.abs() > 0.5 * h.hi.abs() {
            let relative_error = 2.0 * (error / sum.hi.abs()) + ROOT_QUOTIENT_ERROR;
            return Some(Estimate { t: sum / a, relative_error, exponent });
        }
        // That sum cancels; the product of the roots is power / a.
        let (power, power_error) = power(self.scaled.o, self.scaled.radius);
        let power_relative_error = power_error / power.hi.abs();
        (power_relative_error < 0.5).then(|| Estimate {
            t: power / other,
            relative_error: 2.0 * (error / other.hi.abs() + power_relative_error)
                + ROOT_QUOTIENT_ERROR,
            exponent,
        })
    }
}

impl Crossings for InPairs<'_> {
    #[inline(always)]
    fn root(&self, side: Side) -> Option<Root> {
        let estimate = self.estimate(side)?;
        let unscaled = self.scaled.unscaled_root(estimate.t)?;
        let t = self.format.round(unscaled, estimate.relative_error, |midpoint| {
            integers::compare_root(self.line, side, midpoint)
        })?;
        Some(Root { t, estimate })
    }

    #[inline(always)]
    fn hit(&self, side: Side, root: Root) -> Option<Found> {
        let offset_error = MOMENT_ERROR * self.reach + self.half_chord_error;
        let Scaled { d, radius, length_exponent, .. } = self.scaled;
        let Self { a, moment, half_chord, .. } = *self;
        let crossing = Crossing { d, radius, length_exponent, a, moment, half_chord, offset_error };
        crossing.hit(self.line, self.format, side, root)
    }
}

/// What the points of the crossings follow from, in scaled units.
pub(super) struct Crossing {
    pub(super) d: Triple<f64>,
    pub(super) radius: f64,
    pub(super) length_exponent: i32,
    pub(super) a: Pair,
    /// o × d.
    pub(super) moment: Triple<Pair>,
    /// √discriminant.
    pub(super) half_chord: Pair,
    /// How far off the moment and half the chord may be together.
    pub(super) offset_error: f64,
}

impl Crossing {
    /// The hit at a root, if its point is within half the tolerance.
    #[inline(always)]
    pub(super) fn hit(&self, line: &Line, format: Format, side: Side, root: Root) -> Option<Found> {
        let Root { t, estimate } = root;
        let Self { d, radius, length_exponent, .. } = *self;
        let length = sqrt(self.a.hi);
        let travelled = scale(estimate.t.hi.abs() * length, estimate.exponent);
        let is_close = travelled <= line.radius;
        let tolerance = format.point_tolerance();
        let allowed = if is_close {
            tolerance.of_radius * radius
        } else {
            // In scaled units, as the radius.
            (tolerance.of_radius * radius)
                .min(tolerance.of_distance * scale(travelled, -length_exponent))
        };
        let is_certain = self.offset_error <= 0.5 * allowed * length
            && (!is_close || estimate.relative_error < 0.5 * tolerance.of_distance);
        if !is_certain {
            return None;
        }

        // From the foot of the closest approach, at (o × d) × d / a from the center, half a chord to either side.
        let along = if side == Side::Near { -self.half_chord } else { self.half_chord };
        let foot = moment(self.moment, d);
        let offset = foot.zip(d, |foot, d| without_dust((foot + along.times(d)) / self.a));
        let (start, exponent, step) = if is_close {
            (line.origin, estimate.exponent, d.map(|d| without_dust(estimate.t.times(d))))
        } else {
            (line.center, length_exponent, offset)
        };
        let point = Triple::from(start).zip(step, |start, step| {
            let sum = two_sum(start, scale(step.hi, exponent));
            // Not where it overflows.
            let low = sum.lo + scale(step.lo, exponent);
            if sum.hi.is_finite() { sum.hi + low } else { sum.hi }
        });
        let normal = offset.map(|offset| offset.hi / radius);
        Some(Found { t, point: point.into(), normal: normal.into() })
    }
}

/// A coordinate of a vector of about unit length, zero where it is so small that the low part of a product underflowed on the way:
/// what is left of such a part depends on whether the machine has a fused multiply-add.
#[inline(always)]
fn without_dust(coordinate: Pair) -> Pair {
    const DUST: f64 = f64::from_bits((1023 - 800) << 52); // 2^-800
    // A zero of the same sign.
    if coordinate.hi.abs() < DUST { Pair::from(coordinate.hi * 0.0) } else { coordinate }
}
