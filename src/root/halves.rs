//! The second step of `f64`: a correction of the root, from halves of 26 bits whose products and sums are exact.
//!
//! With w = t d - o, from the center to where the ray is at t, the quadratic is f = w·w - r², and its slope 2 w·d. From a root
//! of the first step, t + τ is better, where τ solves a τ² + 2 (w·d) τ + f = 0: with q = f / 2 (w·d), to third order
//!
//! ```text
//! τ = -q (1 + a q / 2 (w·d))
//! ```
//!
//! Nearly all of f cancels, so it has to be computed in more than 53 bits. [`Halves`] splits a vector into a high part, every
//! coordinate a multiple of the same power of two and of at most 26 bits, and a low part of the rest. A dot product of high
//! parts is then exact in plain `f64`, whichever way it is summed up: each product is an integer multiple of one power of two,
//! and by the inequality of Cauchy and Schwarz no partial sum exceeds 2⁵³ of these. Only products with low parts are rounded, and
//! these are 2⁻²⁶ of the whole. (Rump, Ogita and Oishi, *Accurate Floating-Point Summation*, 2008, extract vectors so.)
//!
//! The sum of o.high and w.high is exact, too. Both are multiples of the same power of two, which is at least 2⁻²⁶ r. And where a
//! root is clear of doubt, |o| < 2¹⁶ r: their sum is far below 2⁵³ of these multiples.
//!
//! **The error**, with m the larger of o·o and r², and t |d| ≤ 2 √m, to first order. The low part of t is at most 2⁻²⁵ of it, and
//! each coordinate of d.low at most 2⁻²⁶ |d|, of o.low 2⁻²⁶ √m and of the rest of t d 2⁻²⁶ r. In vectors, with √3 for each of
//! these,
//!
//! ```text
//!                                  is at most        and rounded by at most u times that
//! t.high d.low                     0.9 · 2⁻²⁴ √m     0.9 · 2⁻⁷⁷ √m
//! t.low d                          1.0 · 2⁻²⁴ √m     1.0 · 2⁻⁷⁷ √m
//! their sum                        1.9 · 2⁻²⁴ √m     1.9 · 2⁻⁷⁷ √m
//! o.low                            0.5 · 2⁻²⁴ √m     0.5 · 2⁻⁷⁷ √m
//! the difference of these two      2.4 · 2⁻²⁴ √m     2.4 · 2⁻⁷⁷ √m
//! with the rest of t d, w.low      2.9 · 2⁻²⁴ √m     2.9 · 2⁻⁷⁷ √m
//! w                                                  9.6 · 2⁻⁷⁷ √m = 1.2 · 2⁻⁷⁴ √m
//! f, as 2 w times that                               1.2 · 2⁻⁷³ r √m
//! f, six roundings of 2 w w.low    2.9 · 2⁻²³ r √m   8.7 · 2⁻⁷⁵ r √m
//! ```
//!
//! So f errs by less than 2⁻⁷¹ r √m, and τ by 2⁻⁷² r √m / s, where s = |w·d| is half the chord. A root is accepted where
//! (s t)² > 2⁻²⁰ r² m, so that this is at most 2⁻⁶² t. In one coordinate, w errs by less than 2⁻⁷⁴ √m.
//!
//! By the bound of the first step with [`CLEAR`], |τ| < 2⁻³²·⁸ t, and s > 2⁻¹⁷ √(a m), so that a t / s < 2¹⁸. So what the plain
//! slope w·d errs by, 4 u r |d| / s < 2⁻³⁴ of itself, is 2⁻⁶⁶ of t; and the term of third order that is left out, τ (a τ / s)² /
//! 2, is below 2⁻⁶³·³ of t.
//!
//! **The far root** of a chord whose near root t₁ is accepted, (h + s) / a, is corrected by the same steps. As t₁² is at most the
//! product of both roots, power / a, t₁ |d| ≤ √m; so s t₁ > [`CLEAR`] m gives s > 2⁻¹⁶ √(a m), which is more than is assumed
//! above, and as s ≤ r |d|, √m < 2¹⁶ r. The far root itself has t |d| ≤ (|h| + s) / |d| ≤ 2 √m, and the bound of the first step.
//! Whether (s t)² > 2⁻²⁰ r² m is tested of each root. So all that is said of f, w and τ holds of the far root, too.
//!
//! **Point and normal** of either root are where w, with d τ, leads. What that is off by is at most the smaller of
//!
//! ```text
//! of t |d|, as above                            2⁻⁶²·⁴ t |d|
//! of r, with √(a m) / s < 2¹⁶ and √m < 2¹⁶ r
//!     f        2⁻⁷² r √m |d| / s                 2⁻⁵⁶ r
//!     slope    |τ d| ≤ 10.5 u (√(a m) / s) √m, of which 4 u r |d| / s       2⁻⁶⁸ r
//!     third order, |τ d| (a τ / s)² / 2, with a τ / s ≤ 10.5 u a m / s²     2⁻⁵³·⁸ r
//! ```
//!
//! and 2⁻⁷⁴ √m < 2⁻⁵⁸ r of w: together less than 2⁻⁵³ r. From inside, √m is r, and all of these are smaller yet.

use glam::DVec3;

use super::answer::{Found, Side};
use super::chord::Chord;
use super::format::Format;
use super::line::{Line, Setting};
use super::points::{self, Crossing, Near};
use super::power::to_center;
use crate::arithmetic::half::{Half, Halves, splitter};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, U, fast_two_sum, two_sum};

#[cfg(test)]
mod tests;

/// The part `clear` of the first step: see there.
pub(super) const CLEAR: f64 = 1.0 / 65536.0;

/// The square of the least s t, in r² m.
const CLEAR_OF_RESIDUAL: f64 = 1.0 / 1_048_576.0;

/// Of t, in r √m / s: 2⁻⁷². Proved in `tests/proofs/halves.g`.
const RESIDUAL_ERROR: f64 = U / 524_288.0;

/// Of the slope w·d, in r |d|. Proved in `tests/proofs/halves.g`.
const SLOPE_ERROR: f64 = 4.0 * U;

/// Of w, in √m: 2⁻⁷⁴. Proved in `tests/proofs/halves.g`.
const OFFSET_ERROR: f64 = U / 2_097_152.0;

/// How far off a corrected root may be, as a part of itself: 2⁻⁶², and half of that for all else.
/// Proved in `tests/proofs/halves.g`.
pub(super) const ROOT_ERROR: f64 = U / 512.0 * 1.5;

/// A corrected root, and where the ray is there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corrected {
    /// The root, normalized.
    pub(super) t: Pair,
    /// t d, without the correction.
    step: DVec3,
    step_low: DVec3,
    w: Halves,
    tau: f64,
    correction: DVec3,
    origin: DVec3,
}

impl Corrected {
    #[inline(always)]
    pub(super) fn point(&self) -> DVec3 {
        self.point_in_pairs().map(|coordinate| coordinate.hi + coordinate.lo).into()
    }

    #[inline(always)]
    fn point_in_pairs(&self) -> Triple<Pair> {
        let low = Triple::from(self.step_low + self.correction);
        let step = Triple::from(self.step).zip(low, |hi, lo| Pair { hi, lo });
        Triple::from(self.origin).zip(step, |p, step| {
            let sum = two_sum(p, step.hi);
            Pair { hi: sum.hi, lo: sum.lo + step.lo }
        })
    }

    /// From the center to the point.
    #[inline(always)]
    pub(super) fn offset(&self) -> DVec3 {
        self.w.high + (self.w.low + self.correction)
    }

    /// The hit at a far root that is rounded to `t`, if it is certain how it is rounded: with |d|, √m and half the chord s.
    ///
    /// By the error of the case, which is far less than [`ROOT_ERROR`] where the chord is long.
    #[inline(always)]
    pub(super) fn hit(
        &self,
        line: Line,
        format: Format,
        t: f64,
        [length, size, half_chord]: [f64; 3],
    ) -> Option<Found> {
        let per_half_chord = half_chord.recip();
        let tau = self.tau.abs();
        let bend = length * length * tau * per_half_chord;
        let of_slope = SLOPE_ERROR * (line.radius * length * per_half_chord) + bend * bend;
        let of_root = RESIDUAL_ERROR * (line.radius * size * per_half_chord) + tau * of_slope;
        // Twice as much, for what is left out.
        let error = 2.0 * (length * of_root + OFFSET_ERROR * size);
        let low = Triple::from(self.w.low + self.correction);
        let offset = Triple::from(self.w.high).zip(low, |hi, lo| Pair { hi, lo });
        let [point, offset] =
            [self.point_in_pairs(), offset].map(|value| Near::within(value, error));
        let crossing = Crossing { side: Side::Far, point, offset };
        points::surely(line, format, t, crossing)
    }
}

/// What the correction of either root needs.
pub(super) struct Correction {
    o: Halves,
    d: Halves,
    direction: DVec3,
    origin: DVec3,
    radius: Half,
    a: f64,
    radius_splitter: f64,
}

impl Setting {
    /// What the correction of either root needs.
    #[inline(always)]
    pub(super) fn correction(&self, chord: &Chord<f64>) -> Correction {
        Correction::new(self.line, self.o, chord, self.radius_squared)
    }
}

impl Correction {
    /// With o rounded.
    #[inline(always)]
    fn new(line: Line, o: DVec3, chord: &Chord<f64>, radius_squared: f64) -> Self {
        let Chord { a, distance_squared, .. } = *chord;
        let larger =
            if distance_squared > radius_squared { distance_squared } else { radius_squared };
        let radius_splitter = splitter(radius_squared);
        Self {
            o: to_center(line, o, splitter(larger)),
            d: Halves::new(line.direction, splitter(a)),
            direction: line.direction,
            origin: line.origin,
            radius: Half::new(line.radius, radius_splitter),
            a,
            radius_splitter,
        }
    }

    /// Corrects a root.
    #[inline(always)]
    pub(super) fn correct(&self, t: f64) -> Corrected {
        /// The highest 26 bits.
        const HIGH: u64 = !0 << 27;
        let high = f64::from_bits(t.to_bits() & HIGH);
        let low = t - high;

        // w = t d - o.
        let step = self.d.high * high;
        let step_low = self.d.low * high + self.direction * low;
        let w_high = ((step - self.o.high) + self.radius_splitter) - self.radius_splitter;
        let w_low = (step - (w_high + self.o.high)) + (step_low - self.o.low);
        let w = w_high + w_low;

        // f = w·w - r²: the sum of high parts is exact.
        let Half { high: r_high, low: r_low } = self.radius;
        let f_high = w_high.dot(w_high) - r_high * r_high;
        let f_low = w_low.dot(w + w_high) - r_low * (r_low + 2.0 * r_high);
        let f = f_high + f_low;

        let inverse_slope = (2.0 * w.dot(self.direction)).recip();
        let q = f * inverse_slope;
        let tau = -(q + q * (self.a * q * inverse_slope));

        Corrected {
            t: fast_two_sum(t, tau),
            step,
            step_low,
            w: Halves { high: w_high, low: w_low },
            tau,
            correction: self.direction * tau,
            origin: self.origin,
        }
    }

    /// Corrects a root of the first step; `None` where its rounding, or the point, is not certain.
    #[inline(always)]
    pub(super) fn correct_surely(
        &self,
        t: f64,
        half_chord: f64,
        residual_size: f64,
    ) -> Option<Corrected> {
        let corrected = self.correct(t);
        let Pair { hi, lo } = corrected.t;
        let error = t.abs() * ROOT_ERROR;
        let way = half_chord * t;
        let is_certain = hi + (lo + error) == hi
            && hi + (lo - error) == hi
            && way * way > CLEAR_OF_RESIDUAL * residual_size;
        is_certain.then_some(corrected)
    }
}
