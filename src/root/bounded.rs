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
//! power         compensated: products and sums exact       |error| ≤ u |power| + 36 u² m
//! ```

use super::chord::{Chord, Derivation};
use super::crossing::{Crossings, Estimate, Found, Line, Root, Side, Verdict};
use super::format::Format;
use super::halves::{self, Corrected, Correction};
use super::in_f64::is_safe;
use super::integers;
use super::surface::{POWER_ERROR, power_in_pairs};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, U};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;
use glam::DVec3;

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

/// The chord, with its errors.
pub(super) struct Bounded {
    line: Line,
    format: Format,
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

/// Takes the chord of a line of which no square of a square overflows or underflows.
///
/// A NaN or an infinity anywhere ends in doubt, and so does a zero direction. With a negative radius, there is no hit.
#[inline(always)]
pub(super) fn chord(line: Line, format: Format) -> Verdict<Bounded> {
    let o = line.o();
    let o_high = o.map(|o| o.hi);
    let d = Triple::from(line.direction);
    let radius_squared = line.radius * line.radius.abs();
    let chord = ClosestApproach::chord(o_high, d, radius_squared);
    let Chord { a, distance_squared, discriminant, .. } = chord;
    if format == Format::F64 && !(is_safe(a) && is_safe(distance_squared.max(radius_squared))) {
        return Verdict::Doubt;
    }
    let moment = o_high.cross(d);
    let moment_squared = moment.dot(moment);
    let reach_squared = a * distance_squared;
    let error = DISCRIMINANT_ERROR
        * (a * radius_squared.abs() + moment_squared + sqrt(moment_squared * reach_squared))
        + MOMENT_ERROR_SQUARED * reach_squared;
    if discriminant < -error {
        return Verdict::Miss;
    }
    if discriminant > error {
        // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
        let half_chord = sqrt(discriminant);
        return Verdict::Hit(Bounded {
            line,
            format,
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

impl Bounded {
    /// o·o - r², where the origin may be close to the surface, with its relative error.
    #[inline(always)]
    fn power(&self) -> (f64, f64) {
        let (power, larger) = power_in_pairs(self.o, self.line.radius);
        (power.hi, POWER_ERROR * larger / power.hi.abs())
    }

    /// The root on that side, unless it might be of either sign.
    #[inline(always)]
    fn estimate(&self, side: Side) -> Option<(f64, f64)> {
        let Self { chord: Chord { a, h, .. }, half_chord, .. } = *self;
        let [sum, other] = match side {
            Side::Near => [h - half_chord, h + half_chord],
            Side::Far => [h + half_chord, h - half_chord],
        };
        // Doubled for the terms of second order.
        let error = 2.0 * (H_ERROR * self.reach + self.half_chord_error);
        if sum.abs() > 0.5 * h.abs() {
            return Some((sum / a, error / sum.abs() + QUOTIENT_ERROR));
        }
        // That sum cancels; the product of the roots is power / a.
        let (power, power_error) = self.power();
        // Too close to the surface for the correction.
        if self.format == Format::F64 && power_error > 1e-22 {
            return None;
        }
        let relative_error = error / other.abs() + 2.0 * power_error + QUOTIENT_ERROR;
        (power_error < 0.5).then(|| (power / other, relative_error))
    }

    /// The correction of a root, with how far off it is, as a part of the root.
    #[inline(always)]
    fn corrected(&self, t: f64, relative_error: f64) -> (Corrected, f64) {
        let Self { line, chord, half_chord, .. } = *self;
        let radius_squared = line.radius * line.radius;
        let o = self.o.map(|o| o.hi).into();
        let corrected = Correction::new(line, o, &chord, radius_squared).correct(t);
        let larger = chord.distance_squared.max(radius_squared);
        let slope_error = halves::SLOPE_ERROR * sqrt(radius_squared * chord.a) / half_chord;
        let bend = relative_error * (chord.a * t.abs()) / half_chord;
        let error = halves::RESIDUAL_ERROR * sqrt(radius_squared * larger) / (half_chord * t.abs())
            + relative_error * (slope_error + bend * bend);
        (corrected, error)
    }
}

impl Crossings for Bounded {
    #[inline(always)]
    fn root(&self, side: Side) -> Option<Root> {
        let (t, relative_error) = self.estimate(side)?;
        let estimate = if self.format == Format::F32 {
            Estimate { t: t.into(), relative_error, exponent: 0 }
        } else if self.chord.distance_squared
            > halves::FARTHEST * (self.line.radius * self.line.radius)
        {
            return None;
        } else {
            let (corrected, relative_error) = self.corrected(t, relative_error);
            Estimate { t: corrected.t, relative_error, exponent: 0 }
        };
        let t = self.format.round(estimate.t, estimate.relative_error, |midpoint| {
            let line = self.line;
            integers::compare_root(&line, side, midpoint)
        })?;
        Some(Root { t, estimate })
    }

    #[inline(always)]
    fn hit(&self, side: Side, root: Root) -> Option<Found> {
        let Line { origin, direction, center, radius } = self.line;
        let Root { t, estimate: Estimate { t: Pair { hi: unrounded, .. }, relative_error, .. } } =
            root;
        let length = sqrt(self.chord.a);
        let travelled = unrounded.abs() * length;
        let tolerance = self.format.point_tolerance();
        if self.format == Format::F64 {
            // The rounding of the offset is below a quarter of the tolerance.
            let (t_plain, plain_error) = self.estimate(side)?;
            let (corrected, _) = self.corrected(t_plain, plain_error);
            let offset_error =
                relative_error * travelled + halves::OFFSET_ERROR * (self.reach / length + radius);
            let is_certain = offset_error < 0.5 * tolerance.of_radius * radius
                && relative_error < 0.5 * tolerance.of_distance;
            return is_certain.then(|| Found {
                t,
                point: corrected.point(),
                normal: corrected.offset() / radius,
            });
        }

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
