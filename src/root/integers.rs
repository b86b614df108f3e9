//! The geometric derivation in integers of 64 bits and products of 256: exact, where the digits of the coordinates span no more
//! than 61 binary places, as they do unless by design ([`Narrow`]).
//!
//! A root is in doubt only where a number that it is compared with has no room beside the coordinates. Points are computed from
//! numbers rounded to 96 bits, and may be in doubt.

use super::answer::{Crossings, Found, Side, Verdict};
use super::format::Format;
use super::line::Line;
use super::moved_origin;
use super::narrow::Narrow;
use super::points::{self, normalized};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::V;
use crate::arithmetic::scaled_pair::ScaledPair;
use crate::arithmetic::scaling::{exponent, scale};

#[cfg(test)]
mod tests;

/// Of a root, in itself, with a, h, the power and the discriminant known within 2⁻⁹⁶ of themselves, e = 1,024 v:
///
/// ```text
/// s, a root                     e / 2 + 4 v
/// h / a                         2 e, a quotient 10 v                                          2 e + 10 v
/// (|h| + s) / a, power over it  2 e, a sum 4 v, a quotient 10 v                               2 e + 14 v
/// (h ∓ s) / a, s ≤ |h| / 4      e |h| + (e / 2 + 4 v) s and 4 v (|h| + s), over |h| - s:
///                               3/2 e + 9 v; a e, a quotient 10 v                           5/2 e + 19 v
/// ```
///
/// That is 2,579 v at most.
const ROOT_ERROR: f64 = 4096.0 * V;

/// Where a pair loses nothing.
const MIDDLE: i32 = 900;

/// The chord, and what it belongs to.
pub(super) struct InIntegers<'a> {
    line: &'a Line,
    format: Format,
    exact: Narrow,
    a: ScaledPair,
    h: ScaledPair,
    half_chord: ScaledPair,
}

/// Takes the chord of a line. It is in doubt where the coordinates span too many places, and where one is no number.
pub(super) fn chord(line: &Line, format: Format) -> Verdict<InIntegers<'_>> {
    if !line.is_valid() {
        return Verdict::Doubt;
    }
    let Some(exact) = Narrow::new(line) else { return Verdict::Doubt };
    let discriminant = exact.discriminant();
    if discriminant.is_negative() {
        return Verdict::Miss;
    }
    let half_chord = discriminant.sqrt();
    let (a, h) = (exact.a(), exact.h());
    Verdict::Hit(InIntegers { line, format, exact, a, h, half_chord })
}

impl InIntegers<'_> {
    fn estimate(&self, side: Side) -> ScaledPair {
        let Self { a, h, half_chord, .. } = *self;
        if half_chord.is_zero() {
            return h / a;
        }
        // Next to a tangent, nothing cancels.
        if half_chord.exponent() < h.exponent() - 2 {
            let along = if side == Side::Near { -half_chord } else { half_chord };
            return (h + along) / a;
        }
        // The root that does not cancel, and the other one from the product of the roots, power / a.
        let sum = if h.is_negative() { h + -half_chord } else { h + half_chord };
        if (side == Side::Near) == h.is_negative() { sum / a } else { self.exact.power() / sum }
    }
}

impl InIntegers<'_> {
    /// The hit from the foot of the closest approach, where neither the distance nor the length of the chord counts.
    #[cold]
    #[inline(never)]
    fn hit_from_closest_approach(&self, side: Side, t: f64, root: ScaledPair) -> Option<Found> {
        let Line { direction, radius, .. } = *self.line;
        let (radius, length_exponent) = normalized(radius);
        let direction_exponent = exponent(direction.abs().max_element());
        // In units of the radius and of the direction's length, which bound half the chord and the moment.
        let unit = -(length_exponent + direction_exponent);
        let [x, y, z] = self.exact.moment().map(|coordinate| coordinate.scaled(unit));
        let half_chord = self.half_chord.scaled(unit);
        let d = Triple::from(direction).map(|d| scale(d, -direction_exponent));
        let offset = points::from_closest_approach(
            Triple { x, y, z },
            d,
            if side == Side::Near { -half_chord } else { half_chord },
            self.a.scaled(-2 * direction_exponent),
        );
        let root_exponent = root.exponent();
        let root = (root.scaled(-root_exponent), root_exponent, ROOT_ERROR);
        let crossing = points::Crossing::from_root(self.line, side, root, offset, radius);
        points::surely(*self.line, self.format, t, crossing)
    }
}

impl Crossings for InIntegers<'_> {
    type Root = ScaledPair;

    fn root(&mut self, side: Side) -> Option<(f64, ScaledPair)> {
        let exact = self.estimate(side);
        let compare = |number| self.exact.compare_root(self.line, side, number);
        let t = if exact.is_zero() {
            0.0
        } else if exact.exponent().abs() < MIDDLE {
            self.format.round(exact.scaled(0), ROOT_ERROR, compare)?
        } else {
            return None;
        };
        Some((t, exact))
    }

    fn hit(&mut self, side: Side, t: f64, root: ScaledPair) -> Option<Found> {
        if self.line.radius == 0.0 {
            return points::at_center(self.line, self.format, t, self.a);
        }
        moved_origin::hit_at(self.line, self.format, side, t, (root, ROOT_ERROR))
            .or_else(|| self.hit_from_closest_approach(side, t, root))
    }
}
