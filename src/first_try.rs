//! The first try: the roots from a chord computed in plain `f64`, wherever that is beyond doubt.
//!
//! With u = 2⁻⁵³, m the larger of o·o and r², and each of o = c - p rounded once:
//!
//! ```text
//! a             2 additions, 3 products                      |error| ≤  3 u a
//! h             o, product, 2 additions                      |error| ≤  4 u |o| |d|
//! o·o           o twice, product, 2 additions                |error| ≤  5 u o·o
//! power         and r² and a subtraction                     |error| ≤  7 u m
//! discriminant  h²: 9 u a o·o;  a power: 11 u a m;  difference: u a m
//!               or r² a: 5 u a m;  |o × d|²: 11 u a o·o (as |error of o × d| ≤ 2√2 u |o| |d| + u |o × d|)
//!                                                            |error| ≤ 21 u a m
//! ```

use crate::chord::Chord;
use crate::float::sqrt;

/// A discriminant or a power is clear of doubt beyond this part of what it was subtracted from, a m or m: its relative error
/// is then at most 21 u / CLEAR or 7 u / CLEAR.
///
/// Smaller, and more rays would be decided here, but each root would be less sure; at 2⁻¹⁴ the two kinds of doubt are about
/// equally rare.
pub(crate) const CLEAR: f64 = 1.0 / 16384.0;

/// The relative error of a root of the first try: half the discriminant's, 10.5 u / CLEAR, for its square root, the power's,
/// 7 u / CLEAR, and half a u / CLEAR for the rest, which is below 8 u |o| |d| / √discriminant ≤ 8 u / √CLEAR.
pub(crate) const RELATIVE_ERROR: f64 = 18.0 * (f64::EPSILON / 2.0) / CLEAR;

/// Beyond this part of m, the sign of a power is certain: 8 u > 7 u.
const SIGN_CERTAIN: f64 = 8.0 * (f64::EPSILON / 2.0);

/// What the first try says of the nearest root ahead.
pub(crate) enum FirstTry {
    /// There is none.
    Miss,
    /// This one, or very nearly: `numerator / denominator`, with a relative error of at most [`RELATIVE_ERROR`].
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
    if power > CLEAR * distance_squared {
        // Outside. Both roots lie on one side, the side of the closest approach, whose sign is certain because
        // h² = discriminant + a power is far above its error.
        let clear = CLEAR * (a * distance_squared);
        if discriminant > clear {
            if h < 0.0 {
                return FirstTry::Miss;
            }
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
