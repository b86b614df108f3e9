//! The origin moved along the line, exactly, to where nothing cancels, and the quadratic solved from there.
//!
//! A ray lies on the same line wherever on it its origin is. With w = t d - o, from the center to where the line is at t, the
//! quadratic from there is `a τ² + 2 (w·d) τ + (w·w - r²)`. Its discriminant, (w·d)² - a (w·w - r²), is the same for every t. Of
//! a t in `f64`, w is computed in pairs, and so is w·w - r², where nearly all cancels; all else is plain.
//!
//! **At the closest approach**, t = h / a but for rounding, the discriminant loses nothing to cancellation: w·d is next to zero
//! there, and w is no longer than a radius. Where the plain discriminant is certain enough, this move is left out. **At the
//! root**, but for rounding, τ is a correction, to third order
//!
//! ```text
//! τ = -q (1 + a q / 2 (w·d)),   q = (w·w - r²) / 2 (w·d)
//! ```
//!
//! **The errors**, with v = u², P = |o| |d|, R the larger of |w| and r, m that of o·o and r², s = √discriminant, to first order:
//!
//! ```text
//! w             all is exact but for two additions of low parts                    |error| ≤ v |w| + 4 u v (|t d| + |o|)
//! ```
//!
//! At the closest approach, where |t d| ≤ |o|, w·d is of no more than 8 u P, for what h, a and the quotient are rounded by, and
//!
//! ```text
//! w·w - r²      40 v R² as a power in pairs, and what w errs by      |error| ≤ 42 v R² + 16 u v R |o|
//! w·d           8 v compensated, the low parts 7 v, w 1 v            |error| ≤ 16 v R |d| + 24 u v P + u |w·d|
//! (w·d)²        2 (8 u P) times that, and its rounding               |error| ≤ 256 u v P R |d| + 192 u v P²
//! a (w·w - r²)  a, 3 u, the rounding of the power and the product    |error| ≤ a times that of the power + 5 u (D + (w·d)²)
//! discriminant  and the difference, u                                |error| ≤ 42 v a R² + 272 u v P R |d| + 512 u v P² + 6 u D
//! ```
//!
//! At the root, |t d| ≤ 2 √m. The correction is taken only where the bend a τ / s is at most [`MOST_BEND`], 1/64. There the line
//! at t is within |τ d| ≤ s / 64 |d| ≤ r / 64 of the root, so |w| ≤ 65/64 r, on which the 46 v and with them the 23 v below rest.
//! And the slope w·d is at least 63/64 s. After the first move, what w erred by there counts too, with |w| ≤ r + 8 u |o|.
//!
//! ```text
//! w             v |w| in each move, and 4 u v of the way and of o                  |error| ≤ 2.1 v r + 16 u v √m
//! w·w - r²      40 v |w|² ≤ 41.3 v r² as a power in pairs, 2 |w| times that of w   |error| ≤ 46 v r² + 33 u v r √m
//! t             half of that, over the slope                                       |error| ≤ 23.4 v r² / s + 17 u v r √m / s
//! ```
//!
//! Besides, τ is off by these parts of itself:
//!
//! ```text
//! the slope w·d             3 products and sums, w.hi for w, 4 u |w| |d| / |w·d|     ≤ 4.2 u r |d| / s
//! the operations            the power, its product with 1 / 2 (w·d), the reciprocal, and the sum with the term of 2nd order
//!                                                                                    ≤ 5 u
//! w + τ d, and t + τ        2 and where an error is added 1; 1                       ≤ 4 u
//! what is left out          (a τ / s)² / 2 and terms of higher order                 ≤ (a τ / s)²
//! ```

use core::cmp::Ordering;

use super::answer::{Crossings, Found, Side, Verdict};
use super::bounded_chord::Bounded;
use super::chord::Chord;
use super::format::{Format, Midpoint};
use super::line::Line;
use super::points::{self, Crossing, Near};
use super::power::power_in_pairs;
use super::ties;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    LEAST_PAIR, Pair, U, V, compensated_dot, two_difference, two_product, two_sum,
};
use crate::arithmetic::scaling::scale;
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// A plain discriminant is certain enough where it is more than so many times what it may err by.
const SURE: f64 = 1024.0;
/// And more than this part of P², 2⁻⁶⁴: then s > 2⁻³² P, and what h and the quotient err by, 12 u P, is below 2⁻¹⁷ s.
const SURE_H: f64 = U / 2048.0;

/// Of the discriminant from the closest approach, in a R², in a R |o| and in P². Proved in `tests/proofs/moved.g`.
const MOVED_ERROR: f64 = 48.0 * V;
const MOVED_REACH_ERROR: f64 = 320.0 * U * V;
const MOVED_ALONG_ERROR: f64 = 1024.0 * U * V;

/// Of w at the root, in r, and in √m. Proved in `tests/proofs/pairs.g`.
const OFFSET_ERROR: f64 = 4.0 * V;
const OFFSET_REACH_ERROR: f64 = 32.0 * U * V;
/// Of the root, in r² / s, and in r √m / s. Proved in `tests/proofs/pairs.g`.
const RESIDUAL_ERROR: f64 = 24.0 * V;
const RESIDUAL_REACH_ERROR: f64 = 32.0 * U * V;
/// Of the slope, in r |d|, and of the operations of the correction, in itself. Proved in `tests/proofs/pairs.g`.
const SLOPE_ERROR: f64 = 5.0 * U;
const CORRECTION_ERROR: f64 = 12.0 * U;
/// Of the sum that the root is, in itself.
const PAIR_ERROR: f64 = 2.0 * V;
/// Of a point, in the center and in the offset, which is less than twice the radius: of their low parts a sum is rounded, and
/// once more where the error is added.
const SUM_ERROR: f64 = 4.0 * V;
/// The largest a τ / s.
const MOST_BEND: f64 = 1.0 / 64.0;

/// The chord from a point of the line, and the line.
pub(super) struct InPairs<'a> {
    line: &'a Line,
    format: Format,
    /// t of that point.
    start: f64,
    /// From there to the center.
    o: Triple<Pair>,
    a: f64,
    /// |d|.
    length: f64,
    h: f64,
    /// √discriminant.
    half_chord: f64,
    /// √m.
    size: f64,
}

/// w = t d - o. Where it is next to nothing beside o, the low part need not be small beside the high one.
#[inline(always)]
pub(crate) fn offset(o: Triple<Pair>, d: Triple<f64>, t: f64) -> Triple<Pair> {
    o.zip(d, |o, d| {
        let step = two_product(t, d);
        let high = two_difference(step.hi, o.hi);
        let low = two_difference(step.lo, o.lo);
        let lower = two_sum(high.lo, low.hi);
        let sum = two_sum(high.hi, lower.hi);
        Pair { hi: sum.hi, lo: sum.lo + (lower.lo + low.lo) }
    })
}

/// Takes the chord of a line that is near 1, as [`Scaled`](super::scaled_line::Scaled) brings it there.
#[inline(always)]
pub(super) fn chord(line: &Line, format: Format) -> Verdict<InPairs<'_>> {
    let (o, d, radius) = (line.o(), Triple::from(line.direction), line.radius);
    let radius_squared = radius * radius;
    let bounded = Bounded::new(o.map(|o| o.hi), d, radius_squared);
    let Chord { a, h, distance_squared, discriminant, .. } = bounded.chord;
    let Bounded { error, length, distance, .. } = bounded;
    if discriminant < -error {
        return Verdict::Miss;
    }
    let reach_squared = a * distance_squared;
    let size = distance.max(radius);
    let near = InPairs { line, format, start: 0.0, o, a, length, h, half_chord: 0.0, size };
    if discriminant > SURE * error && discriminant > SURE_H * reach_squared {
        return Verdict::Hit(InPairs { half_chord: sqrt(discriminant), ..near });
    }

    let start = h / a;
    let w = offset(o, d, start).map(|w| two_sum(w.hi, w.lo));
    let (power, larger) = power_in_pairs(w, radius);
    let along = compensated_dot(d, w.map(|w| w.hi));
    let along = along.hi + (along.lo + d.dot(w.map(|w| w.lo)));
    let discriminant = along * along - a * power.hi;
    let error = a * (MOVED_ERROR * larger + MOVED_REACH_ERROR * (sqrt(larger) * distance))
        + MOVED_ALONG_ERROR * reach_squared;
    if discriminant < -error {
        return Verdict::Miss;
    }
    if discriminant > 4.0 * error {
        let half_chord = sqrt(discriminant);
        return Verdict::Hit(InPairs { start, o: w.map(|w| -w), h: -along, half_chord, ..near });
    }
    Verdict::Doubt
}

/// A root, and where the line is there.
pub(super) struct Corrected {
    side: Side,
    t: Pair,
    error: f64,
    /// Before the correction.
    w: Triple<Pair>,
    correction: f64,
}

impl InPairs<'_> {
    /// The root on that side.
    #[inline(always)]
    fn corrected(&self, side: Side) -> Option<Corrected> {
        let Self { line, start, o, a, length, h, half_chord, size, .. } = *self;
        let (d, radius) = (Triple::from(line.direction), line.radius);
        let along = if side == Side::Near { h - half_chord } else { h + half_chord };
        let way = along / a;
        let w = offset(o, d, way);
        let (power, _) = power_in_pairs(w, radius);
        let inverse_slope = (2.0 * w.map(|w| w.hi).dot(d)).recip();
        let q = power.hi * inverse_slope;
        let correction = -(q + q * (a * q * inverse_slope));
        let per_half_chord = half_chord.recip();
        let bend = a * correction * per_half_chord;
        if bend.abs() > MOST_BEND {
            return None;
        }
        let of_correction =
            SLOPE_ERROR * (radius * length * per_half_chord) + CORRECTION_ERROR + bend * bend;
        let residual_error = (RESIDUAL_ERROR * radius + RESIDUAL_REACH_ERROR * size) * radius;
        let error = residual_error * per_half_chord + correction.abs() * of_correction;
        let t = two_sum(start, way);
        let t = two_sum(t.hi, t.lo + correction);
        Some(Corrected { side, t, error, w, correction })
    }

    /// The error of where the line is at a root.
    #[inline(always)]
    fn offset_error(&self, root: &Corrected) -> f64 {
        let of_offset = OFFSET_ERROR * self.line.radius + OFFSET_REACH_ERROR * self.size;
        root.error * self.length + of_offset
    }

    /// How the root on that side compares with a number midway between its neighbors.
    ///
    /// A number within 3 times the error is nearer to this root than to the other: they are 2 s / a apart. By the moved origin,
    /// s² is above 192 v a r² + 1280 u v a r √m, so that what the power errs by makes less than s / 8 a, and the correction, at
    /// most s / 64 a, brings half of that at most; of a plain discriminant, both are less; and 2 v |t| is next to nothing beside
    /// s / a, which is above 2⁻⁷² |t|. So before the near root, and behind the far one, it is known where the closest approach is.
    #[inline(always)]
    fn compare(&self, side: Side, root: &Corrected, number: Midpoint) -> Option<Ordering> {
        let above = root.above(number);
        if above.abs() > 2.0 * (root.error + PAIR_ERROR * root.t.hi.abs()) {
            return above.partial_cmp(&0.0);
        }
        let ahead = if side == Side::Near { Ordering::Greater } else { Ordering::Less };
        ties::compare_root(self.line, side, number, Some(ahead))
    }
}

impl Crossings for InPairs<'_> {
    type Root = Corrected;

    #[inline(always)]
    fn root(&mut self, side: Side) -> Option<(f64, Corrected)> {
        let corrected = self.corrected(side)?;
        let relative_error = corrected.error / corrected.t.hi.abs() + PAIR_ERROR;
        let compare = |number| self.compare(side, &corrected, number);
        let t = self.format.round(corrected.t, relative_error, compare)?;
        Some((t, corrected))
    }

    #[inline(always)]
    fn hit(&mut self, _: Side, t: f64, root: Corrected) -> Option<Found> {
        root.hit(self.line, self.format, t, self.offset_error(&root))
    }
}

impl Corrected {
    /// By how much it is above a number next to it, but for the last place of that difference.
    #[inline(always)]
    fn above(&self, Midpoint { integer, exponent }: Midpoint) -> f64 {
        // The number is odd: an even one, of 53 bits and no larger, and 1. So next to it both differences are exact.
        let one = integer.signum();
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let [even, one] = [integer - one, one].map(|part| scale(part as f64, exponent));
        ((self.t.hi - even) - one) + self.t.lo
    }

    /// From the center to where the line is there.
    #[inline(always)]
    fn offset(&self, line: &Line) -> Triple<Pair> {
        let d = Triple::from(line.direction);
        self.w.zip(d, |w, d| Pair { hi: w.hi, lo: w.lo + d * self.correction })
    }

    /// The hit: p + t d is c + w, and w is known within an error.
    #[inline(always)]
    fn hit(&self, line: &Line, format: Format, t: f64, error: f64) -> Option<Found> {
        let (offset, center, radius) = (self.offset(line), line.center, line.radius);
        let sum = Triple::from(center).zip(offset, |center, offset| {
            let sum = two_sum(center, offset.hi);
            Pair { hi: sum.hi, lo: sum.lo + offset.lo }
        });
        let size = center.x.abs() + center.y.abs() + center.z.abs() + 2.0 * radius;
        let point = Near::within(sum, error + SUM_ERROR * size);
        let offset = Near::within(offset, error + SUM_ERROR * radius);
        points::surely(*line, format, t, Crossing { side: self.side, point, offset })
            .or_else(|| self.hit_from_the_origin(line, format, t, offset))
    }

    /// The same where the point is p + t d, each coordinate by itself.
    #[cold]
    #[inline(never)]
    fn hit_from_the_origin(
        &self,
        line: &Line,
        format: Format,
        t: f64,
        offset: Near,
    ) -> Option<Found> {
        // A smaller root has lost digits.
        if self.t.hi.abs() < LEAST_PAIR {
            return None;
        }
        let relative_error = self.error / self.t.hi.abs() + PAIR_ERROR;
        let point = points::on_the_line(line, self.t, relative_error);
        points::surely(*line, format, t, Crossing { side: self.side, point, offset })
    }
}

/// The hit at a root that is known to a part of itself of at most 2⁻⁹⁴, if its point is certain; `t` is that root rounded.
///
/// So the point is off by 4,096 v |t d|. The product of the root's low part with d is rounded by v |t d|, its sum with the low
/// part of w by 2 v |w|, and w by v |w| as said above, where |w| ≤ |t d| + |o|: in all by at most 4,100 v (|t d| + |o|).
pub(super) fn hit_at(
    line: &Line,
    format: Format,
    side: Side,
    t: f64,
    (root, relative_error): (Pair, f64),
) -> Option<Found> {
    /// Of the way, |o| and r: 2⁻⁹⁰.
    const ERROR: f64 = 65536.0 * V;
    let (o, d) = (line.o(), Triple::from(line.direction));
    let w = offset(o, d, root.hi);
    let o = o.map(|o| o.hi);
    let reach = sqrt(o.dot(o)) + line.radius + root.hi.abs() * sqrt(d.dot(d));
    let error = relative_error * root.hi.abs();
    let root = Corrected { side, t: root, error, w, correction: root.lo };
    root.hit(line, format, t, ERROR * reach)
}
