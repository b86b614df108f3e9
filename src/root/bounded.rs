//! The geometric derivation in plain `f64`, with a bound on the error of the very case.
//!
//! The first step has to be quick, so its bound covers all cases. Here the bound is computed, and the geometric derivation is
//! taken whichever was asked for, because its error does not grow with the square of the distance. What is left in doubt are
//! rays within rounding error of the limb, and origins within rounding error of the surface.
//!
//! With u = 2⁻⁵³, P = |o| |d|, M = |o × d| and each of o = c - p rounded once, to first order and then rounded up:
//!
//! ```text
//! h             as in the first step                       |error| ≤ 4 u P
//! o × d         two products of rounded o, difference      |error| ≤ 2√2 u P + u M
//! M²            2 M |error| + |error|², 3 u for the sum    |error| ≤ u M (6 M + 6 P) + 9 u² P²
//! r² a          products, 2 additions                      |error| ≤ 5 u r² a
//! discriminant  and u for the difference                   |error| ≤ 7 u (r² a + M (M + P)) + 9 u² P²
//! power         compensated: products and sums exact       |error| ≤ u |power| + 16 u² m
//! ```

use super::chord::{Chord, Derivation};
use super::crossing::{Crossings, Estimate, Found, Line, Root, Side, Verdict};
use super::format::Format;
use super::integers;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{
    COMPENSATED_DOT_ERROR, Pair, U, compensated_dot, two_difference, two_product,
};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;
use glam::DVec3;

/// Of h, in P.
const H_ERROR: f64 = 4.0 * U;
/// Of o × d, in P.
const MOMENT_ERROR: f64 = 4.0 * U;
/// Of the discriminant, in r² a + M (M + P); the eighth part for the rounding of this bound.
const DISCRIMINANT_ERROR: f64 = 8.0 * U;
/// Of the discriminant too, in P².
const MOMENT_ERROR_SQUARED: f64 = 10.0 * U * U;
/// Of the power, in m.
const POWER_ERROR: f64 = 2.0 * COMPENSATED_DOT_ERROR;
/// Of a quotient, besides what its terms bring with them: a, 3 u, and the rounding of the power, a sum and itself.
const QUOTIENT_ERROR: f64 = 8.0 * U;

/// The chord, with its errors.
pub(super) struct Bounded<'a> {
    line: &'a Line,
    o: DVec3,
    o_low: DVec3,
    a: f64,
    h: f64,
    distance_squared: f64,
    /// o × d.
    moment: DVec3,
    /// √discriminant.
    half_chord: f64,
    half_chord_error: f64,
    /// P.
    reach: f64,
}

/// Takes the chord of a line whose coordinates are `f32`: then squares of squares neither overflow nor underflow.
///
/// A NaN or an infinity anywhere ends in doubt, and so does a zero direction. With a negative radius, there is no hit.
#[inline(always)]
pub(super) fn chord(line: &Line) -> Verdict<Bounded<'_>> {
    let exact_o = line.o();
    let o = exact_o.map(|o| o.hi);
    let d = Triple::from(line.direction);
    let Chord { a, h, distance_squared, discriminant, .. } =
        ClosestApproach::chord(o, d, line.radius * line.radius.abs());
    let moment = o.cross(d);
    let moment_squared = moment.dot(moment);
    let reach_squared = a * distance_squared;
    let error = DISCRIMINANT_ERROR
        * (a * (line.radius * line.radius) + moment_squared + sqrt(moment_squared * reach_squared))
        + MOMENT_ERROR_SQUARED * reach_squared;
    if discriminant < -error {
        return Verdict::Miss;
    }
    if !(discriminant > error) {
        return Verdict::Doubt;
    }
    // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
    let half_chord = sqrt(discriminant);
    Verdict::Hit(Bounded {
        line,
        o: o.into(),
        o_low: exact_o.map(|o| o.lo).into(),
        a,
        h,
        distance_squared,
        moment: moment.into(),
        half_chord,
        half_chord_error: error / half_chord,
        reach: sqrt(reach_squared),
    })
}

impl Bounded<'_> {
    /// o·o - r², where the origin may be close to the surface, with its relative error.
    #[inline(always)]
    fn power(&self) -> (f64, f64) {
        let o = Triple::from(self.o);
        let radius_squared = two_product(self.line.radius, self.line.radius);
        let distance_squared = compensated_dot(o, o);
        let difference = two_difference(distance_squared.hi, radius_squared.hi);
        let low = (distance_squared.lo - radius_squared.lo) + 2.0 * self.o.dot(self.o_low);
        let power = difference.hi + (difference.lo + low);
        let error = POWER_ERROR * self.distance_squared.max(radius_squared.hi);
        (power, error / power.abs())
    }

    /// The root on that side, unless it might be of either sign.
    #[inline(always)]
    fn estimate(&self, side: Side) -> Option<Estimate> {
        // The root that does not cancel, and the other one from the product of the roots, power / a.
        let sum = if self.h < 0.0 { self.h - self.half_chord } else { self.h + self.half_chord };
        // Doubled for the terms of second order.
        let sum_error =
            2.0 * (H_ERROR * self.reach + self.half_chord_error) / sum.abs() + QUOTIENT_ERROR;
        if (side == Side::Near) == (self.h < 0.0) {
            return Some(Estimate { t: (sum / self.a).into(), relative_error: sum_error });
        }
        let (power, power_error) = self.power();
        (power_error < 0.5)
            .then(|| Estimate {
                t: (power / sum).into(),
                relative_error: sum_error + 2.0 * power_error,
            })
    }
}

impl Crossings for Bounded<'_> {
    #[inline(always)]
    fn root(&self, side: Side) -> Option<Root> {
        let estimate = self.estimate(side)?;
        let t = Format::F32.round(estimate.t, estimate.relative_error, |midpoint| {
            integers::compare_root(self.line, side, midpoint)
        })?;
        Some(Root { t, estimate })
    }

    #[inline(always)]
    fn hit(&self, side: Side, root: Root) -> Option<Found> {
        let tolerance = Format::F32.point_tolerance();
        let &Line { origin, direction, center, radius } = self.line;
        let Root { t, estimate: Estimate { t: Pair { hi: unrounded, .. }, relative_error } } = root;

        // From the foot of the closest approach, at (o × d) × d / a from the center, half a chord to either side.
        let along = if side == Side::Near { -self.half_chord } else { self.half_chord };
        let offset = (self.moment.cross(direction) + direction * along) / self.a;
        // In lengths times |d|: its rounding is below an eighth of the tolerance.
        let offset_error = MOMENT_ERROR * self.reach + self.half_chord_error;
        let travelled = unrounded.abs() * sqrt(self.a);
        let is_close = travelled <= radius;
        let allowed = if is_close {
            tolerance.of_radius * radius
        } else {
            (tolerance.of_radius * radius).min(tolerance.of_distance * travelled)
        };
        let is_certain = offset_error < 0.5 * allowed * sqrt(self.a)
            && (!is_close || relative_error < 0.5 * tolerance.of_distance);
        is_certain.then(|| Found {
            t,
            point: if is_close { origin + direction * unrounded } else { center + offset },
            normal: offset / radius,
        })
    }
}
