//! The second try: the geometric derivation in plain `f64`, with a bound on the error of this very case.
//!
//! The first try has to be quick, so it asks for a margin that covers the worst case. Here the margin is computed, and the
//! geometric derivation is taken whichever was asked for, because its error does not grow with the square of the distance.
//! What is left in doubt are rays within rounding error of the limb, origins within rounding error of the surface, and roots
//! within rounding error of the midpoint of two floats.
//!
//! With u = 2⁻⁵³, p = |o| |d| and each of o = c - p rounded once, to first order and then rounded up:
//!
//! ```text
//! h             as in the first try                           |error| ≤ 4 u p
//! o × d         two products of rounded o, difference         |error| ≤ 2√2 u p + u |o × d|
//! |o × d|²      2 |o × d| |error| + |error|², 3 u for the sum |error| ≤ u |o × d| (6 |o × d| + 6 p) + 9 u² p²
//! r² a          products, 2 additions                         |error| ≤ 5 u r² a
//! discriminant  and u for the difference                      |error| ≤ 7 u (r² a + |o × d| (|o × d| + p)) + 9 u² p²
//! power         compensated: products and sums exact          |error| ≤ u |power| + 16 u² m
//! ```

use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    COMPENSATED_DOT_ERROR, Pair, U, compensated_dot, two_difference, two_product,
};
use crate::chord::{Chord, Derivation};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;

#[cfg(test)]
mod tests;

/// Of h, in |o| |d|.
const H_ERROR: f64 = 4.0 * U;
/// Of o × d, in |o| |d|.
const MOMENT_ERROR: f64 = 4.0 * U;
/// Of the discriminant, in r² a + |o × d| (|o × d| + |o| |d|); the eighth part for the rounding of this bound.
const DISCRIMINANT_ERROR: f64 = 8.0 * U;
/// Of the discriminant too, in o·o a.
const MOMENT_ERROR_SQUARED: f64 = 10.0 * U * U;
/// Of the power, in m.
const POWER_ERROR: f64 = 2.0 * COMPENSATED_DOT_ERROR;
/// Of a quotient, besides what its terms bring with them: a, 3 u, and the rounding of the power, a sum and itself.
const QUOTIENT_ERROR: f64 = 8.0 * U;

/// What the second try says.
pub(crate) enum SecondTry {
    /// The line misses.
    Miss,
    /// It hits.
    Hit(Estimate),
    /// Look closer.
    Doubt,
}

/// The chord, with its errors.
pub(crate) struct Estimate {
    pub(crate) a: f64,
    /// o × d.
    pub(crate) moment: Triple<f64>,
    /// √discriminant.
    pub(crate) half_chord: f64,
    /// How far off the moment and half the chord may be together.
    pub(crate) error: f64,
    /// Ascending.
    pub(crate) roots: [Root; 2],
}

/// A root, as a quotient, with its relative error.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    pub(crate) numerator: f64,
    pub(crate) denominator: f64,
    pub(crate) relative_error: f64,
}

/// The second try, where squares neither overflow nor underflow.
///
/// A NaN or an infinity anywhere ends in doubt, and so does a zero direction. With a negative radius, there is no hit.
#[inline(always)]
pub(crate) fn second_try(o: Triple<Pair>, d: Triple<f64>, radius: f64) -> SecondTry {
    let o_low = o.map(|o| o.lo);
    let o = o.map(|o| o.hi);
    let radius_squared = two_product(radius, radius.abs());
    let Chord { a, h, distance_squared, discriminant, .. } =
        ClosestApproach::chord(o, d, radius_squared.hi);

    let moment = o.cross(d);
    let moment_squared = moment.dot(moment);
    let reach_squared = a * distance_squared;
    let discriminant_error = DISCRIMINANT_ERROR
        * (a * radius_squared.hi.abs() + moment_squared + sqrt(moment_squared * reach_squared))
        + MOMENT_ERROR_SQUARED * reach_squared;
    if discriminant < -discriminant_error {
        return SecondTry::Miss;
    }

    // o·o - r², where the origin may be close to the surface.
    let distance_squared = compensated_dot(o, o);
    let difference = two_difference(distance_squared.hi, radius_squared.hi);
    let power = difference.hi
        + (difference.lo + ((distance_squared.lo - radius_squared.lo) + 2.0 * o.dot(o_low)));
    let power_error = POWER_ERROR * distance_squared.hi.max(radius_squared.hi);
    if !(discriminant > discriminant_error && power.abs() > 2.0 * power_error) {
        return SecondTry::Doubt;
    }

    // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
    let half_chord = sqrt(discriminant);
    let half_chord_error = discriminant_error / half_chord;
    let reach = sqrt(reach_squared);
    let sum = h.abs() + half_chord;
    // Doubled for the terms of second order.
    let sum_relative_error = 2.0 * (H_ERROR * reach + half_chord_error) / sum + QUOTIENT_ERROR;
    let power_relative_error = 2.0 * power_error / power.abs();

    // The root that does not cancel, and the other one from the product of the roots, power / a.
    let signed_sum = if h < 0.0 { -sum } else { sum };
    let x = Root { numerator: signed_sum, denominator: a, relative_error: sum_relative_error };
    let y = Root {
        numerator: power,
        denominator: signed_sum,
        relative_error: sum_relative_error + power_relative_error,
    };
    SecondTry::Hit(Estimate {
        a,
        moment,
        half_chord,
        error: half_chord_error + MOMENT_ERROR * reach,
        roots: if h < 0.0 { [x, y] } else { [y, x] },
    })
}
