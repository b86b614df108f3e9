//! The first step: the roots in plain `f64`, with one bound for all cases.
//!
//! With u = 2⁻⁵³, m the larger of o·o and r², and each of o = c - p rounded once, to first order:
//!
//! ```text
//! a             a product, 2 additions                       |error| ≤  3 u a
//! h             o, a product, 2 additions                    |error| ≤  4 u |o| |d|
//! o·o           o twice, a product, 2 additions              |error| ≤  5 u o·o
//! power         o·o: 5 u m;  r²: u m;  difference: u m       |error| ≤  7 u m
//! discriminant  by the quadratic:
//!               h²: 8 u |h| |o| |d| + u h² ≤ 9 u a m;  a power: 7 u a m and 3 u + u of it ≤ 11 u a m;  difference: u a m
//!                                                            |error| ≤ 21 u a m
//!               by the closest approach:
//!               r² a: 5 u a m;  |o × d|²: 11 u a m, as |error of o × d| ≤ 2√2 u |o| |d| + u |o × d|;  difference: u a m
//!                                                            |error| ≤ 17 u a m
//! ```
//!
//! What is left out are squares of errors, 2⁻⁴⁴ of the bounds, which are far from reached: the roundings of o, of d·d and of o·o
//! enter h² and a power alike, and cancel in the difference.
//!
//! **The roots.** Let s = √discriminant and t the root ahead. It is accepted where
//!
//! ```text
//! s |t| > clear m
//! ```
//!
//! for some part `clear` below 2⁻⁷. Outside, t = power / (h + s) with s ≤ h, so that power ≥ 2 clear m, and
//! s (h + s) > clear m (h + s)² / power ≥ clear a m, because (h + s)(h - s) = a power. Inside and behind the center,
//! t = power / (h - s), so that |power| > clear m, and s (|h| + s) > clear a m likewise. Inside and before the center,
//! t = (h + s) / a, and s (h + s) > clear a m. In each case the root errs, as a part of itself, by what comes from
//!
//! ```text
//! the power         7 u m / |power|                                ≤  7 u / clear
//! the discriminant  21 u a m / 2 s, in a sum of |h| + s            ≤ 10.5 u / clear
//! h                 4 u √(a m), in a sum above √(clear a m)        ≤  4 u / √clear
//! a, and the roundings of s, of the sum and of the quotient        ≤  6 u
//! ```
//!
//! The first two make 17.5 u / clear. [`ROOT_ERROR`] has half of u / clear for the others: with a `clear` of 2⁻¹⁶ that is 32,768
//! u, of which h takes 1,024 and the roundings 6. The largest term of the second order is that of the square root, which errs by
//! δ / 2 s and at most (δ / 2 s) (δ / s²) more where the discriminant errs by δ. Because |h| + s ≤ 2 √(a m), s is above clear √(a
//! m) / 2, so δ / s² < 84 u / clear² < 2⁻¹⁴, and the term takes less than 50 u.
//!
//! **The far root**, where the near one is not in the range asked for: t = (h + s) / a. An accepted root has s (|h| + s) > clear
//! a m, as was said, and so this root errs by what the discriminant, h, a and the roundings bring, which is less than the above.

use super::chord::Chord;
use crate::arithmetic::comparison::{exceeds, is_not_positive, product_exceeds};
use crate::arithmetic::pair::U;
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// Of the discriminant, in a m. Proved in `tests/proofs/plain.g`.
pub(super) const DISCRIMINANT_ERROR: f64 = 21.0 * U;

/// Of the power, in m. Proved in `tests/proofs/plain.g`.
const POWER_ERROR: f64 = 7.0 * U;

/// Below minus this part of a m, the discriminant is certain to be negative.
const SURE_MISS: f64 = DISCRIMINANT_ERROR + U;

/// Beyond this part of m, the sign of the power is certain.
pub(super) const SURE_SIGN: f64 = POWER_ERROR + U;

/// The relative error of an accepted root, times `clear`: 7 u and 10.5 u, and half a u for the rest.
/// Proved in `tests/proofs/plain.g`.
pub(super) const ROOT_ERROR: f64 = POWER_ERROR + DISCRIMINANT_ERROR / 2.0 + U / 2.0;

/// Beyond this part of m, a power from a finer sum is certain enough: see [`nearest_ahead`].
const FINE_POWER: f64 = 1.0 / 1_099_511_627_776.0; // 2^-40

/// The nearest root ahead.
#[derive(Clone, Copy, Debug)]
pub(super) enum Nearest {
    /// There is none.
    Miss,
    /// This one, with a relative error of at most [`ROOT_ERROR`] over `clear`.
    Root {
        t: f64,
        /// √discriminant where the ray enters there, -√discriminant where it leaves.
        half_chord: f64,
    },
    /// The next step has to look.
    Doubt,
}

/// Finds the nearest root ahead, t > 0, of a chord in plain `f64`.
///
/// `fine_power` gives the power with an error of at most 2⁻⁷⁶ m and half its own last place, or `None`. It is asked close to the
/// surface, where the power is too small beside m and nothing else is: s (|h| + s) > clear a m bounds what the discriminant and h
/// bring to the root's error, as above. A fine power of more than 2⁻⁴⁰ m errs by at most 2⁻³⁶ of itself. That is less than the
/// 7 u / clear of the plain power, where `clear` is at most 2⁻¹⁵.
///
/// A NaN or an infinity anywhere ends in a root that is infinite or NaN, in a miss or in doubt, and so does a zero direction. A
/// negative radius, given as a negative square, is a miss or ends in doubt.
#[inline(always)]
pub(super) fn nearest_ahead(
    chord: &Chord<f64>,
    radius_squared: f64,
    clear: f64,
    fine_power: impl FnOnce() -> Option<f64>,
) -> Nearest {
    let Chord { a, h, distance_squared, power, discriminant } = *chord;
    let is_fine = |power: f64, larger: f64| power.abs() > FINE_POWER * larger;
    if exceeds(power, SURE_SIGN, distance_squared) {
        // Outside: both roots lie on the side of the closest approach. If h is above zero in truth, then by less than its error,
        // h² < 16 u² a o·o, far below a power > u a o·o, and the line misses.
        let is_negative = || discriminant < -SURE_MISS * (a * distance_squared);
        if is_not_positive(h) || (is_not_positive(discriminant) && is_negative()) {
            return Nearest::Miss;
        }
        // The nearer root, (h - s) / a, without its cancellation: the product of the roots is power / a.
        let half_chord = sqrt(discriminant);
        let sum = h + half_chord;
        let t = power / sum;
        if product_exceeds([half_chord, t], clear, distance_squared) {
            return Nearest::Root { t, half_chord };
        }
        if half_chord * sum > clear * (a * distance_squared) {
            if let Some(power) = fine_power() {
                if is_fine(power, distance_squared) {
                    return Nearest::Root { t: power / sum, half_chord };
                }
            }
        }
    } else if exceeds(-power, SURE_SIGN, radius_squared) {
        // Inside: one root lies ahead, (h + s) / a, and it cancels where the center is behind.
        let half_chord = sqrt(discriminant);
        let sum = h.abs() + half_chord;
        let t = if is_not_positive(h) { -power / sum } else { sum / a };
        if product_exceeds([half_chord, t], clear, radius_squared) {
            return Nearest::Root { t, half_chord: -half_chord };
        }
        // Before the center, the sum is clear of doubt or the half-chord is not.
        if is_not_positive(h) && half_chord * sum > clear * (a * radius_squared) {
            if let Some(power) = fine_power() {
                if is_fine(power, radius_squared) {
                    return Nearest::Root { t: -power / sum, half_chord: -half_chord };
                }
            }
        }
    }
    Nearest::Doubt
}

/// The far root, from half the chord of a near one that is accepted, with the same bound on its error.
#[inline(always)]
pub(super) fn far_root(&Chord { a, h, .. }: &Chord<f64>, half_chord: f64) -> f64 {
    (h + half_chord) / a
}

/// Both roots.
#[derive(Clone, Copy, Debug)]
pub(super) enum Both {
    /// The line misses.
    Miss,
    /// These, ascending, with a relative error of at most [`ROOT_ERROR`] over `clear`.
    Roots {
        t: [f64; 2],
        /// √discriminant.
        half_chord: f64,
    },
    /// The next step has to look.
    Doubt,
}

impl Both {
    /// The root that does not cancel, and the smaller one from the product of the roots.
    #[inline(always)]
    pub(super) fn from_half_chord(chord: &Chord<f64>, half_chord: f64) -> Self {
        let Chord { a, h, power, .. } = *chord;
        let sum = h.abs() + half_chord;
        let (x, y) = (sum / a, power / sum);
        Self::Roots { t: if h > 0.0 { [y, x] } else { [-x, -y] }, half_chord }
    }
}

/// Finds both roots of a chord in plain `f64`. What [`nearest_ahead`] says of a finer power holds here too. A NaN or an infinity
/// anywhere, a zero direction and a negative radius end in a miss or in doubt.
#[inline(always)]
pub(super) fn both(
    chord: &Chord<f64>,
    radius_squared: f64,
    clear: f64,
    fine_power: impl FnOnce() -> Option<f64>,
) -> Both {
    let Chord { a, h, distance_squared, power, discriminant } = *chord;
    let larger = if power > 0.0 { distance_squared } else { radius_squared };
    if discriminant < -SURE_MISS * (a * larger) {
        return Both::Miss;
    }
    let half_chord = sqrt(discriminant);
    let sum = h.abs() + half_chord;
    if half_chord * (power / sum).abs() > clear * larger {
        return Both::from_half_chord(chord, half_chord);
    }
    if half_chord * sum > clear * (a * larger) {
        if let Some(power) = fine_power() {
            if power.abs() > FINE_POWER * larger {
                return Both::from_half_chord(&Chord { power, ..*chord }, half_chord);
            }
        }
    }
    Both::Doubt
}
