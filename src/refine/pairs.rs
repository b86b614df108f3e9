//! The geometric derivation in pairs.
//!
//! With v = u² = 2⁻¹⁰⁶, m the larger of o·o and r², o = c - p exactly a pair, r² too but for what underflows, and by the bounds in
//! [`pair`](crate::arithmetic::pair):
//!
//! ```text
//! a, h, o·o     products 5 v, two additions 4 v each         |error| ≤ 13 v a,  13 v |o| |d|,  13 v o·o
//! power         13 v o·o, difference 4 v (o·o + r²)          |error| ≤ 21 v m
//! discriminant  r² a: 18 v a m;  |o × d|²: 39 v a o·o (as |error of o × d| ≤ 9 √2 v |o| |d|);  difference: 8 v a m
//!                                                            |error| ≤ 65 v a m
//! ```

use super::integers::Exact;
use super::{Crossings, Target};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{PRODUCT_ERROR, Pair, QUOTIENT_ERROR, ROOT_ERROR, SUM_ERROR, V};
use crate::arithmetic::scaling::{exponent, scale};
use crate::chord::{Chord, Derivation};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;

/// Of a in itself, of h in |o| |d|, of o·o in itself: a product and two additions.
pub(super) const DOT_ERROR: f64 = PRODUCT_ERROR + 2.0 * SUM_ERROR;
/// Of the power, in m.
pub(super) const POWER_ERROR: f64 = DOT_ERROR + 2.0 * SUM_ERROR;
/// Of |o × d|², in a o·o: twice 9 √2 v < 13 v for that of o × d, and the product with itself.
pub(super) const MOMENT_SQUARED_ERROR: f64 = 2.0 * 13.0 * V + DOT_ERROR;
/// Of the discriminant, in a m.
pub(super) const DISCRIMINANT_ERROR: f64 =
    (DOT_ERROR + PRODUCT_ERROR) + MOMENT_SQUARED_ERROR + 2.0 * SUM_ERROR;
/// Of a root besides what h, the discriminant and the power bring with them, in itself: of a, the square root, the sum and the
/// quotient, and one to spare.
pub(super) const ROOT_QUOTIENT_ERROR: f64 = DOT_ERROR + ROOT_ERROR + SUM_ERROR + QUOTIENT_ERROR + V;

/// What pairs say.
pub(super) enum InPairs<T> {
    Miss,
    Hit(T),
    Doubt,
}

/// The setting with lengths and directions each divided by a power of two that brings them near 1.
pub(super) struct Scaled {
    o: Triple<Pair>,
    d: Triple<f64>,
    radius: f64,
    /// The exponent of the power of two that a root is to be multiplied by.
    pub(super) root_exponent: i32,
}

impl Scaled {
    /// `None` where the difference of the positions is no pair, or all lengths are zero.
    pub(super) fn new(exact: &Exact) -> Option<Self> {
        /// Fourth powers of what lies within this of 1 neither overflow nor lose anything in a pair.
        const NEAR: i32 = 200;
        let &Exact { o, in_pairs, d, radius } = exact;
        let longest = o.x.hi.abs().max(o.y.hi.abs()).max(o.z.hi.abs()).max(radius);
        if !in_pairs || longest == 0.0 {
            return None;
        }
        let length_exponent = exponent(longest);
        let direction_exponent = exponent(d.x.abs().max(d.y.abs()).max(d.z.abs()));
        if length_exponent.abs() < NEAR && direction_exponent.abs() < NEAR {
            return Some(Self { o, d, radius, root_exponent: 0 });
        }
        // What this rounds, far below the largest of its kind, is below every error bound.
        let shorten = |x: f64| scale(x, -length_exponent);
        Some(Self {
            o: o.map(|pair| Pair { hi: shorten(pair.hi), lo: shorten(pair.lo) }),
            d: d.map(|x| scale(x, -direction_exponent)),
            radius: shorten(radius),
            root_exponent: length_exponent - direction_exponent,
        })
    }

    pub(super) fn chord(&self) -> (Chord<Pair>, Pair) {
        let radius = Pair::from(self.radius);
        let radius_squared = radius * radius;
        (ClosestApproach::chord(self.o, self.d.map(Pair::from), radius_squared), radius_squared)
    }

    pub(super) fn estimate(&self) -> InPairs<Estimate> {
        let (Chord { a, h, distance_squared, power, discriminant }, radius_squared) = self.chord();

        let larger = distance_squared.hi.max(radius_squared.hi);
        let discriminant_error = DISCRIMINANT_ERROR * (a.hi * larger);
        if discriminant.hi < -discriminant_error {
            return InPairs::Miss;
        }
        let power_error = POWER_ERROR * larger;
        if discriminant.hi <= discriminant_error || power.hi.abs() <= power_error {
            return InPairs::Doubt;
        }

        // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
        let half_chord = discriminant.sqrt();
        let sum = h.abs() + half_chord;
        let sum_error =
            DOT_ERROR * sqrt(a.hi * distance_squared.hi) + discriminant_error / half_chord.hi;

        // The root that does not cancel, and the other one from the product of the roots, power / a.
        // The errors of quotients are doubled for their terms of second order.
        let sum_relative_error = 2.0 * (sum_error / sum.hi) + ROOT_QUOTIENT_ERROR;
        let power_relative_error = 2.0 * (power_error / power.hi.abs());
        let x = (with_sign_of(h, sum / a), sum_relative_error);
        let y = (with_sign_of(h, power / sum), sum_relative_error + power_relative_error);
        InPairs::Hit(Estimate { a, half_chord, sum_error, roots: [x, y] })
    }

    pub(super) fn crossings<S: Target>(&self) -> InPairs<Crossings<S>> {
        let Estimate { a, half_chord, sum_error, roots } = match self.estimate() {
            InPairs::Miss => return InPairs::Miss,
            InPairs::Hit(estimate) => estimate,
            InPairs::Doubt => return InPairs::Doubt,
        };
        if sum_error > S::NORMAL_ERROR * (self.radius * sqrt(a.hi)) {
            return InPairs::Doubt;
        }
        let [Some(x), Some(y)] = roots
            .map(|(t, relative_error)| S::settle(scale(t.hi, self.root_exponent), relative_error))
        else {
            return InPairs::Doubt;
        };
        let t = if y < x { [y, x] } else { [x, y] };
        let d = self.d.map(Pair::from);
        let radius = Pair::from(self.radius);
        InPairs::Hit(Crossings::new(t, d, self.o.cross(d), a, half_chord, radius))
    }
}

/// The chord in pairs, where its signs are certain.
pub(super) struct Estimate {
    pub(super) a: Pair,
    /// √discriminant.
    pub(super) half_chord: Pair,
    /// How far off |h| and half the chord may be together.
    pub(super) sum_error: f64,
    /// Each with its relative error, in no order.
    pub(super) roots: [(Pair, f64); 2],
}

/// `magnitude` with the sign of `h`.
fn with_sign_of(h: Pair, magnitude: Pair) -> Pair {
    if h.hi < 0.0 { -magnitude } else { magnitude }
}
