//! The geometric derivation in plain `f64`, with a bound on the error of the very case.
//!
//! The first step has to be quick, so its bound covers all cases. Where it leaves a doubt, the bound is computed, and the
//! geometric derivation is taken whichever was asked for, because its error does not grow with the square of the distance.
//!
//! With u = 2⁻⁵³, P = |o| |d|, M = |o × d| as computed and each of o = c - p rounded once, to first order and then rounded up:
//!
//! ```text
//! o × d         two products of rounded o, difference      |error| ≤ 2√2 u P + u M
//! M²            2 M |error| + |error|², 3 u for the sum    |error| ≤ u M (6 M + 6 P) + 9 u² P²
//! r² a          products, 2 additions                      |error| ≤ 5 u r² a
//! discriminant  and u for the difference                   |error| ≤ 7 u (r² a + M (M + P)) + 9 u² P²
//! ```

use super::chord::{Chord, Derivation};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::U;
use crate::float::sqrt;
use crate::geometric::ClosestApproach;

#[cfg(test)]
mod tests;

/// Of the discriminant, in r² a + M (M + P); the eighth part for the rounding of this bound.
/// Proved in `tests/proofs/bounded.g`.
const DISCRIMINANT_ERROR: f64 = 8.0 * U;
/// Of the discriminant too, in P². Proved in `tests/proofs/bounded.g`.
const MOMENT_ERROR_SQUARED: f64 = 10.0 * U * U;

/// The chord by the closest approach, with the error of its discriminant.
pub(crate) struct Bounded {
    pub(crate) chord: Chord<f64>,
    /// Of the discriminant.
    pub(crate) error: f64,
    /// |d|.
    pub(crate) length: f64,
    /// |o|.
    pub(crate) distance: f64,
}

impl Bounded {
    #[inline(always)]
    pub(crate) fn new(o: Triple<f64>, d: Triple<f64>, radius_squared: f64) -> Self {
        let chord = ClosestApproach::chord(o, d, radius_squared);
        let moment = o.cross(d);
        let moment_squared = moment.dot(moment);
        let (length, distance) = (sqrt(chord.a), sqrt(chord.distance_squared));
        let reach = length * distance;
        let size = chord.a * radius_squared.abs() + moment_squared + sqrt(moment_squared) * reach;
        let error = DISCRIMINANT_ERROR * size + MOMENT_ERROR_SQUARED * (reach * reach);
        Self { chord, error, length, distance }
    }

    /// P.
    #[inline(always)]
    pub(crate) fn reach(&self) -> f64 {
        self.length * self.distance
    }
}
