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
use super::{points, ties};
use crate::arithmetic::pair::{Pair, V};

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

/// The chord, and what it belongs to.
pub(super) struct InIntegers<'a> {
    line: &'a Line,
    format: Format,
    exact: Narrow,
    a: Pair,
    h: Pair,
    /// √discriminant.
    half_chord: Pair,
}

/// Takes the chord of a line that is near 1, as [`Scaled`](super::scaled_line::Scaled) brings it there. It is in doubt where the
/// coordinates span too many places.
pub(super) fn chord(line: &Line, format: Format) -> Verdict<InIntegers<'_>> {
    let Some(exact) = Narrow::new(line) else { return Verdict::Doubt };
    let discriminant = exact.discriminant();
    if discriminant.hi < 0.0 {
        return Verdict::Miss;
    }
    let half_chord = if discriminant.hi == 0.0 { discriminant } else { discriminant.sqrt() };
    let (a, h) = (exact.a(), exact.h());
    Verdict::Hit(InIntegers { line, format, exact, a, h, half_chord })
}

impl InIntegers<'_> {
    fn estimate(&self, side: Side) -> Pair {
        let Self { a, h, half_chord, .. } = *self;
        // Next to a tangent, nothing cancels.
        if half_chord.hi <= 0.25 * h.hi.abs() {
            let along = if side == Side::Near { -half_chord } else { half_chord };
            return (h + along) / a;
        }
        // The root that does not cancel, and the other one from the product of the roots, power / a.
        let is_behind = h.hi < 0.0;
        let sum = if is_behind { h + -half_chord } else { h + half_chord };
        if (side == Side::Near) == is_behind { sum / a } else { self.exact.power() / sum }
    }
}

impl Crossings for InIntegers<'_> {
    type Root = Pair;

    fn root(&mut self, side: Side) -> Option<(f64, Pair)> {
        let exact = self.estimate(side);
        let compare = |number| ties::compare_root(self.line, side, number, None);
        let is_zero = exact.hi == 0.0;
        let t = if is_zero { 0.0 } else { self.format.round(exact, ROOT_ERROR, compare)? };
        Some((t, exact))
    }

    fn hit(&mut self, side: Side, t: f64, root: Pair) -> Option<Found> {
        if self.line.radius == 0.0 {
            return points::at_center(self.line, self.format, t, self.a);
        }
        moved_origin::hit_at(self.line, self.format, side, t, (root, ROOT_ERROR))
    }
}
