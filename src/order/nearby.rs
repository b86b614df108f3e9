//! Crossings from a point of the line close to them, in plain `f64`.

use core::cmp::Ordering;

use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::U;
use crate::float::sqrt;
use crate::root::Side;
use crate::root::bounded_chord::Bounded;
use crate::root::chord::Chord;
use crate::root::line::{Line, is_safe};
use crate::root::moved_origin::offset;

/// Where a line crosses a sphere, from a point of the line close by.
///
/// With o from that point to the center, its coordinates rounded once, h errs by 4 u |o| |d|: by o, a product and two sums. Half
/// the chord s is a root of a discriminant within `error`, as [`Bounded`] has it, so that it errs by at most `error` / s, and is
/// rounded by u. The sum of the two adds u of either.
#[derive(Clone, Copy)]
pub(super) struct Nearby {
    /// How far the two roots are from that point, times a: h ∓ s.
    roots: [f64; 2],
    /// How far off these may be.
    pub(super) error: f64,
    a: f64,
}

/// Which of two roots lie within half an ulp.
pub(super) enum Within {
    Neither,
    One(Side),
    Doubt,
}

impl Nearby {
    /// From the point at `t`; `None` where the bounds do not hold.
    #[inline(always)]
    pub(super) fn new(line: &Line, t: f64) -> Option<Self> {
        /// Of |o| |d| and of s: 5 u and 2 u, and what this bound is rounded by.
        const ERROR: f64 = 8.0 * U;
        /// The offset errs by u of itself and 4 u v (|t d| + |c - p|). Of more than 2⁻⁷⁹ |t d|, that is next to nothing beside u.
        const SHORTEST_SQUARED: f64 = U * U * U; // 2^-159
        if !(line.radius >= 0.0 && line.radius < f64::INFINITY) {
            return None;
        }
        let d = Triple::from(line.direction);
        let o = offset(line.o(), d, t).map(|w| -w.hi);
        let radius_squared = line.radius * line.radius;
        let bounded = Bounded::new(o, d, radius_squared);
        let Chord { a, h, distance_squared, discriminant, .. } = bounded.chord;
        // So that what underflows is far below all that counts, and nothing overflows.
        let is_certain = is_safe(a)
            && is_safe(radius_squared)
            && is_safe(distance_squared)
            && distance_squared > SHORTEST_SQUARED * (t * t * a);
        if !is_certain || discriminant <= bounded.error {
            return None;
        }
        let half_chord = sqrt(discriminant);
        let error = ERROR * (bounded.reach() + half_chord) + bounded.error / half_chord;
        Some(Self { roots: [h - half_chord, h + half_chord], error, a })
    }

    pub(super) fn root(&self, side: Side) -> f64 {
        let [near, far] = self.roots;
        if side == Side::Near { near } else { far }
    }

    /// Which of the roots rounds to that point, where the next float is an ulp away, and the one before as far, or half as far
    /// from a power of two.
    #[inline(always)]
    pub(super) fn side_within(&self, ulp: f64, is_power_of_two: bool) -> Within {
        let half_ulp = 0.5 * ulp * self.a;
        let [near, far] = self.roots.map(f64::abs);
        let may_be = |root: f64| root <= half_ulp + self.error;
        match (may_be(near), may_be(far)) {
            (false, false) => Within::Neither,
            (true, false) => Within::One(Side::Near),
            (false, true) => Within::One(Side::Far),
            (true, true) => {
                let certain = if is_power_of_two { 0.5 * half_ulp } else { half_ulp };
                let is_near = near + self.error < certain;
                if is_near { Within::One(Side::Near) } else { Within::Doubt }
            }
        }
    }

    /// How two crossings compare, from the same point, if that is certain.
    #[inline(always)]
    pub(super) fn compare(&self, side: Side, other: &Self, other_side: Side) -> Option<Ordering> {
        let difference = self.root(side) - other.root(other_side);
        if difference.abs() > self.error + other.error {
            difference.partial_cmp(&0.0)
        } else {
            None
        }
    }
}

/// Whether a float above 0 is, or may be, a power of two.
pub(super) fn is_power_of_two(t: f64) -> bool {
    t.to_bits().trailing_zeros() >= f64::MANTISSA_DIGITS - 1
}
