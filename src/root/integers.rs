//! The geometric derivation in integers: exact, and so never in doubt of a root.
//!
//! Points are computed from numbers rounded to 96 bits, and may be in doubt.
//!
//! Where the digits of the coordinates span no more than 61 binary places, as they do unless by design, a coordinate is an
//! `i64` and 256 bits hold the discriminant ([`Narrow`]). Otherwise a sum of products is collected in an accumulator that holds
//! any ([`Sums`]).

mod narrow;
mod sums;

use core::cmp::Ordering;

use narrow::Narrow;
use sums::Sums;

use super::crossing::{Crossings, Found, Line, Side, Verdict};
use super::format::{Format, Midpoint};
use super::pairs;
use super::points::{self, normalized};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{U, V};
use crate::arithmetic::scaling::{exponent, scale};
use crate::arithmetic::wide::Wide;

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
pub(super) const ROOT_ERROR: f64 = 4096.0 * V;

/// Where a pair loses nothing.
const MIDDLE: i32 = 900;

/// A line and a sphere in integers: every number that they give is exact but for its rounding to at least 96 bits.
pub(super) enum Exact {
    Narrow(Narrow),
    Wide(Sums),
}

impl Exact {
    pub(super) fn new(line: &Line) -> Self {
        Narrow::new(line).map_or_else(|| Self::Wide(Sums::new(line)), Self::Narrow)
    }

    /// Whether the coordinates span so many digits that only accumulators hold their products.
    #[cfg(test)]
    fn is_wide(&self) -> bool {
        matches!(self, Self::Wide(_))
    }

    /// d·d.
    fn a(&self) -> Wide {
        match self {
            Self::Narrow(narrow) => narrow.a(),
            Self::Wide(sums) => sums.a(),
        }
    }

    /// d·o.
    fn h(&self) -> Wide {
        match self {
            Self::Narrow(narrow) => narrow.h(),
            Self::Wide(sums) => sums.h(),
        }
    }

    /// o·o - r².
    fn power(&self) -> Wide {
        match self {
            Self::Narrow(narrow) => narrow.power(),
            Self::Wide(sums) => sums.power(),
        }
    }

    /// r² a - |o × d|².
    fn discriminant(&self) -> Wide {
        match self {
            Self::Narrow(narrow) => narrow.discriminant(),
            Self::Wide(sums) => sums.discriminant(),
        }
    }

    /// o × d.
    fn moment(&self) -> [Wide; 3] {
        match self {
            Self::Narrow(narrow) => narrow.moment(),
            Self::Wide(sums) => sums.moment(),
        }
    }

    /// How the root on that side compares with a number midway between two floats.
    fn compare_root(&self, line: &Line, side: Side, number: Midpoint) -> Ordering {
        let quadratic = match self {
            Self::Narrow(narrow) => {
                narrow.quadratic_at(number).unwrap_or_else(|| Sums::new(line).quadratic_at(number))
            }
            Self::Wide(sums) => sums.quadratic_at(number),
        };
        if quadratic.is_lt() {
            // Within the chord.
            return if side == Side::Near { Ordering::Less } else { Ordering::Greater };
        }
        let ahead = plainly_ahead(line, number).unwrap_or_else(|| match self {
            Self::Narrow(narrow) => {
                narrow.ahead_of(number).unwrap_or_else(|| Sums::new(line).ahead_of(number))
            }
            Self::Wide(sums) => sums.ahead_of(number),
        });
        match (side, quadratic) {
            // Outside the chord, the number lies before both roots or behind both.
            (_, Ordering::Greater) => ahead,
            // At a root: at the near one where the closest approach is still ahead, at the far one where it is past.
            (Side::Near, _) if ahead.is_ge() => Ordering::Equal,
            (Side::Far, _) if ahead.is_le() => Ordering::Equal,
            (Side::Near, _) => Ordering::Less,
            (Side::Far, _) => Ordering::Greater,
        }
    }
}

/// The sign of what is from a number to the closest approach, h - a m, where that is certain in plain `f64`.
fn plainly_ahead(line: &Line, number: Midpoint) -> Option<Ordering> {
    /// Of the products' absolute values: o and m are rounded once, the products twice, and sums three times.
    const ERROR: f64 = 8.0 * U;
    /// Above what underflows.
    const LEAST: f64 = f64::MIN_POSITIVE / U;
    #[expect(clippy::cast_precision_loss, reason = "it is rounded once")]
    let m = scale(number.integer as f64, number.exponent);
    let (o, d) = (line.center - line.origin, line.direction);
    let (h, am) = (d.dot(o), d.dot(d * m));
    let (ahead, size) = (h - am, d.abs().dot(o.abs()) + am.abs());
    let is_certain =
        m.is_normal() && ahead.abs() > ERROR * size && ahead.abs() > LEAST && size.is_finite();
    if is_certain { ahead.partial_cmp(&0.0) } else { None }
}

/// How the root on that side compares with a number midway between two floats.
#[cold]
#[inline(never)]
pub(super) fn compare_root(line: &Line, side: Side, number: Midpoint) -> Ordering {
    Exact::new(line).compare_root(line, side, number)
}

/// The chord, and what it belongs to.
pub(super) struct InIntegers<'a> {
    line: &'a Line,
    format: Format,
    exact: Exact,
    a: Wide,
    h: Wide,
    half_chord: Wide,
}

/// Takes the chord of a valid line. It is never in doubt.
pub(super) fn chord(line: &Line, exact: Exact, format: Format) -> Verdict<InIntegers<'_>> {
    let discriminant = exact.discriminant();
    if discriminant.is_negative() {
        return Verdict::Miss;
    }
    let half_chord = discriminant.sqrt();
    let (a, h) = (exact.a(), exact.h());
    Verdict::Hit(InIntegers { line, format, exact, a, h, half_chord })
}

impl InIntegers<'_> {
    fn estimate(&self, side: Side) -> Wide {
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
    fn hit_from_closest_approach(&self, side: Side, t: f64, root: Wide) -> Option<Found> {
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
        let crossing = points::Crossing::from_root(self.line, root, offset, radius);
        points::surely(*self.line, self.format, t, crossing)
    }
}

impl Crossings for InIntegers<'_> {
    type Root = Wide;

    fn root(&mut self, side: Side) -> Option<(f64, Wide)> {
        let exact = self.estimate(side);
        let compare = |number| self.exact.compare_root(self.line, side, number);
        let t = if exact.is_zero() {
            0.0
        } else if exact.exponent().abs() < MIDDLE {
            self.format.round(exact.scaled(0), ROOT_ERROR, compare)?
        } else {
            self.format.round_at_the_ends(exact.to_f64(), compare)
        };
        Some((t, exact))
    }

    fn hit(&mut self, side: Side, t: f64, root: Wide) -> Option<Found> {
        if self.line.radius == 0.0 {
            return points::at_center(self.line, self.format, t, self.a);
        }
        pairs::hit_at(self.line, self.format, t, root)
            .or_else(|| self.hit_from_closest_approach(side, t, root))
    }
}
