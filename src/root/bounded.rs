//! `f32`: the geometric derivation in plain `f64`, with a bound on the error of the very case.
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
//! power         compensated: products and sums exact       |error| ≤ u |power| + 36 u² m
//! ```

use glam::DVec3;

use super::chord::{Chord, Derivation};
use super::crossing::{Crossings, Found, Line, Side, Verdict};
use super::format::Format;
use super::integers;
use super::surface::{POWER_ERROR, power_in_pairs};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, U};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;

#[cfg(test)]
mod tests;

/// Of h, in P.
const H_ERROR: f64 = 4.0 * U;
/// Of o × d, in P.
const MOMENT_ERROR: f64 = 4.0 * U;
/// Of the discriminant, in r² a + M (M + P); the eighth part for the rounding of this bound.
const DISCRIMINANT_ERROR: f64 = 8.0 * U;
/// Of the discriminant too, in P².
const MOMENT_ERROR_SQUARED: f64 = 10.0 * U * U;
/// Of a quotient, besides what its terms bring with them: a, 3 u, and the rounding of the power, a sum and itself.
const QUOTIENT_ERROR: f64 = 8.0 * U;

/// The chord by the closest approach, with the error of its discriminant.
pub(super) struct Plain {
    pub(super) chord: Chord<f64>,
    /// o × d.
    moment: Triple<f64>,
    /// Of the discriminant.
    pub(super) error: f64,
    /// P².
    pub(super) reach_squared: f64,
}

impl Plain {
    #[inline(always)]
    pub(super) fn new(o: Triple<f64>, d: Triple<f64>, radius_squared: f64) -> Self {
        let chord = ClosestApproach::chord(o, d, radius_squared);
        let moment = o.cross(d);
        let moment_squared = moment.dot(moment);
        let reach_squared = chord.a * chord.distance_squared;
        let size = chord.a * radius_squared.abs()
            + moment_squared
            + sqrt(moment_squared) * sqrt(reach_squared);
        let error = DISCRIMINANT_ERROR * size + MOMENT_ERROR_SQUARED * reach_squared;
        Self { chord, moment, error, reach_squared }
    }
}

/// The chord of a line, with its errors.
pub(super) struct Bounded {
    line: Line,
    o: Triple<Pair>,
    chord: Chord<f64>,
    /// o × d.
    moment: DVec3,
    /// √discriminant.
    half_chord: f64,
    half_chord_error: f64,
    /// P.
    reach: f64,
}

/// Takes the chord of a line in `f32`, of which no square of a square overflows or underflows.
///
/// A NaN or an infinity anywhere ends in doubt, and so does a zero direction. With a negative radius, there is no hit.
#[inline(always)]
pub(super) fn chord(line: Line) -> Verdict<Bounded> {
    let o = line.o();
    let radius_squared = line.radius * line.radius.abs();
    let Plain { chord, moment, error, reach_squared } =
        Plain::new(o.map(|o| o.hi), Triple::from(line.direction), radius_squared);
    let discriminant = chord.discriminant;
    if discriminant < -error {
        return Verdict::Miss;
    }
    if discriminant > error {
        // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
        let half_chord = sqrt(discriminant);
        return Verdict::Hit(Bounded {
            line,
            o,
            chord,
            moment: moment.into(),
            half_chord,
            half_chord_error: error / half_chord,
            reach: sqrt(reach_squared),
        });
    }
    Verdict::Doubt
}

/// A root, with its relative error.
pub(super) struct Estimate {
    t: f64,
    relative_error: f64,
}

impl Bounded {
    /// o·o - r², where the origin may be close to the surface, with its relative error.
    #[inline(always)]
    fn power(&self) -> (f64, f64) {
        let (power, larger) = power_in_pairs(self.o, self.line.radius);
        (power.hi, POWER_ERROR * larger / power.hi.abs())
    }

    /// The root on that side, unless it might be of either sign.
    #[inline(always)]
    fn estimate(&self, side: Side) -> Option<Estimate> {
        let Self { chord: Chord { a, h, .. }, half_chord, .. } = *self;
        let [sum, other] = match side {
            Side::Near => [h - half_chord, h + half_chord],
            Side::Far => [h + half_chord, h - half_chord],
        };
        // Doubled for the terms of second order.
        let error = 2.0 * (H_ERROR * self.reach + self.half_chord_error);
        if sum.abs() > 0.5 * h.abs() {
            let relative_error = error / sum.abs() + QUOTIENT_ERROR;
            return Some(Estimate { t: sum / a, relative_error });
        }
        // That sum cancels; the product of the roots is power / a.
        let (power, power_error) = self.power();
        let relative_error = error / other.abs() + 2.0 * power_error + QUOTIENT_ERROR;
        (power_error < 0.5).then(|| Estimate { t: power / other, relative_error })
    }
}

impl Crossings for Bounded {
    type Root = Estimate;

    #[inline(always)]
    fn root(&self, side: Side) -> Option<(f64, Estimate)> {
        let estimate = self.estimate(side)?;
        let Estimate { t, relative_error } = estimate;
        let t = Format::F32.round(t.into(), relative_error, |midpoint| {
            integers::compare_root(&{ self.line }, side, midpoint)
        })?;
        Some((t, estimate))
    }

    #[inline(always)]
    fn hit(&self, side: Side, t: f64, root: Estimate) -> Option<Found> {
        let Line { origin, direction, center, radius } = self.line;
        let Estimate { t: unrounded, relative_error } = root;
        let length = sqrt(self.chord.a);
        let travelled = unrounded.abs() * length;
        let tolerance = Format::F32.point_tolerance();

        // From the foot of the closest approach, at (o × d) × d / a from the center, half a chord to either side.
        let along = if side == Side::Near { -self.half_chord } else { self.half_chord };
        let offset = (self.moment.cross(direction) + direction * along) / self.chord.a;
        // In lengths times |d|: its rounding is below an eighth of the tolerance.
        let offset_error = MOMENT_ERROR * self.reach + self.half_chord_error;
        let is_close = travelled <= radius;
        let allowed = if is_close {
            tolerance.of_radius * radius
        } else {
            (tolerance.of_radius * radius).min(tolerance.of_distance * travelled)
        };
        let is_certain = offset_error < 0.5 * allowed * length
            && (!is_close || relative_error < 0.5 * tolerance.of_distance);
        is_certain.then(|| Found {
            t,
            point: if is_close { origin + direction * unrounded } else { center + offset },
            normal: offset / radius,
        })
    }
}
