//! The first try: the roots from a chord computed in plain `f64`, wherever that is beyond doubt.
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
//! What is left out are squares of errors, 2⁻⁴⁸ of the bounds, which are far from reached: the roundings of o, of d·d and of o·o
//! enter h² and a power alike, and cancel in the difference.

#[cfg(test)]
mod tests;

use crate::arithmetic::pair::U;
use crate::chord::Chord;
use crate::float::sqrt;

/// Of the discriminant, in a m.
const DISCRIMINANT_ERROR: f64 = 21.0 * U;

/// Of the power, in m.
const POWER_ERROR: f64 = 7.0 * U;

/// A discriminant or a power is clear of doubt beyond this part of what it was subtracted from, a m or m: its relative error
/// is then at most [`DISCRIMINANT_ERROR`] or [`POWER_ERROR`] over this.
///
/// Smaller, and more rays would be decided here, but each root would be less sure; at 2⁻¹⁴ the two kinds of doubt are about
/// equally rare.
pub(crate) const CLEAR: f64 = 1.0 / 16384.0;

/// The relative error of a root of the first try: half the discriminant's, for its square root, the power's, and the rest.
///
/// The rest is h, 4 u √(a m) in a sum that is at least √discriminant ≥ √(CLEAR a m), and a, 3 u, and the roundings of a root, a
/// sum and a quotient: together 4 u / √CLEAR + 6 u, far below u / (2 CLEAR).
pub(crate) const RELATIVE_ERROR: f64 = (DISCRIMINANT_ERROR / 2.0 + POWER_ERROR + U / 2.0) / CLEAR;

/// Beyond this part of m, the sign of a power is certain.
const SIGN_CERTAIN: f64 = POWER_ERROR + U;

/// What the first try says of the nearest root ahead.
pub(crate) enum FirstTry {
    /// There is none.
    Miss,
    /// This one, or very nearly: `numerator / denominator`, with a relative error of at most [`RELATIVE_ERROR`]. Where that is
    /// negative, its sign is certain, and there is none ahead.
    Root {
        numerator: f64,
        denominator: f64,
        /// √discriminant where the ray enters there, -√discriminant where it leaves.
        half_chord: f64,
    },
    /// Look closer.
    Doubt,
}

/// The nearest root ahead, t > 0, from a chord in plain `f64`.
///
/// A NaN or an infinity anywhere ends in doubt: none of the comparisons holds then. So does a zero direction. A negative
/// radius, given as a negative square, is a miss or ends in doubt.
#[inline(always)]
pub(crate) fn nearest_ahead(chord: &Chord<f64>, radius_squared: f64) -> FirstTry {
    let Chord { a, h, distance_squared, power, discriminant } = *chord;
    let clear_power = CLEAR * distance_squared;
    if power > clear_power {
        // Outside. Both roots lie on one side, the side of the closest approach, whose sign is certain because
        // h² = discriminant + a power is far above its error.
        let clear = a * clear_power;
        if discriminant > clear {
            // The nearer root, (h - √discriminant) / a, without its cancellation: the product of the roots is power / a.
            let half_chord = sqrt(discriminant);
            return FirstTry::Root { numerator: power, denominator: h + half_chord, half_chord };
        }
        if discriminant < -clear {
            return FirstTry::Miss;
        }
    } else if power < -SIGN_CERTAIN * radius_squared && discriminant > CLEAR * (a * radius_squared)
    {
        // Inside. One root lies ahead, (h + √discriminant) / a, and it cancels where the center is behind.
        let half_chord = sqrt(discriminant);
        if h > 0.0 {
            return FirstTry::Root {
                numerator: h + half_chord,
                denominator: a,
                half_chord: -half_chord,
            };
        }
        if power < -CLEAR * radius_squared {
            return FirstTry::Root {
                numerator: power,
                denominator: h - half_chord,
                half_chord: -half_chord,
            };
        }
    } else if power > SIGN_CERTAIN * distance_squared && h < 0.0 {
        // Just outside, as a ray that has left this sphere is, and on the way from it: both roots lie behind. If h is above zero
        // in truth, then by less than its error, h² < 16 u² a o·o, far below a power > u a o·o, and the line misses.
        return FirstTry::Miss;
    }
    FirstTry::Doubt
}

/// What the first try says of both roots.
pub(crate) enum BothRoots {
    /// The line misses.
    Miss,
    /// These, ascending, or very nearly.
    Roots {
        /// Relative error at most [`RELATIVE_ERROR`].
        t: [f64; 2],
        /// √discriminant.
        half_chord: f64,
    },
    /// Look closer.
    Doubt,
}

/// Both roots, from a chord in plain `f64`. What [`nearest_ahead`] says of odd arguments holds here too.
#[inline(always)]
pub(crate) fn both_roots(chord: &Chord<f64>, radius_squared: f64) -> BothRoots {
    let Chord { a, h, distance_squared, power, discriminant } = *chord;
    let larger = CLEAR * (distance_squared + radius_squared);
    let clear = a * larger;
    if discriminant > clear && power.abs() > larger {
        let half_chord = sqrt(discriminant);
        // The root that does not cancel, and the other one from the product of the roots.
        let sum = h.abs() + half_chord;
        let (x, y) = (sum / a, power / sum);
        return BothRoots::Roots { t: if h > 0.0 { [y, x] } else { [-x, -y] }, half_chord };
    }
    if discriminant < -clear { BothRoots::Miss } else { BothRoots::Doubt }
}
