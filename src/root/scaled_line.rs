//! Lines of any size, brought near 1.

use glam::DVec3;

use super::line::Line;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::scaling::{exponent, scale, scale_subnormal};

/// Lengths and directions, each divided by a power of two that brings them near 1.
pub(super) struct Scaled {
    pub(super) o: Triple<Pair>,
    pub(super) d: Triple<f64>,
    pub(super) radius: f64,
    pub(super) length_exponent: i32,
    pub(super) direction_exponent: i32,
}

impl Scaled {
    /// `None` where the difference of the positions is no pair, or all lengths are zero. A NaN in the direction or the radius may
    /// stay.
    #[inline(always)]
    pub(super) fn new(line: &Line) -> Option<Self> {
        /// Fourth powers of what lies within this of 1 neither overflow nor lose anything in a pair.
        const NEAR: i32 = 200;
        let o = line.o();
        let is_pair = |pair: Pair| pair.hi.is_finite() && pair.lo.is_finite();
        let longest = o.x.hi.abs().max(o.y.hi.abs()).max(o.z.hi.abs()).max(line.radius);
        if !(is_pair(o.x) && is_pair(o.y) && is_pair(o.z)) || longest == 0.0 {
            return None;
        }
        let Line { direction, radius, .. } = *line;
        let d = Triple::from(direction);
        let length_exponent = exponent(longest);
        let direction_exponent = exponent(direction.abs().max_element());
        if length_exponent.abs() < NEAR && direction_exponent.abs() < NEAR {
            return Some(Self { o, d, radius, length_exponent: 0, direction_exponent: 0 });
        }
        if !line.is_valid() {
            return None;
        }
        // What this rounds, far below the largest of its kind, is below every error bound.
        let shorten = |x: f64| scale_subnormal(x, -length_exponent);
        Some(Self {
            o: o.map(|pair| Pair { hi: shorten(pair.hi), lo: shorten(pair.lo) }),
            d: d.map(|x| scale_subnormal(x, -direction_exponent)),
            radius: shorten(radius),
            length_exponent,
            direction_exponent,
        })
    }

    /// A position in these units; what is far below the longest of them may be rounded.
    #[inline(always)]
    pub(super) fn position(&self, position: DVec3) -> Triple<f64> {
        let position = Triple::from(position);
        if !self.is_scaled() {
            return position;
        }
        position.map(|coordinate| scale(coordinate, -self.length_exponent))
    }

    /// That of the power of two which takes a root to the caller's units.
    #[inline(always)]
    pub(super) fn exponent(&self) -> i32 {
        self.length_exponent - self.direction_exponent
    }

    /// A rounded root in the caller's units, infinite beyond the largest number; `None` below the smallest normal one, where a
    /// root has fewer digits.
    #[inline(always)]
    pub(super) fn unscaled_root(&self, t: f64) -> Option<f64> {
        if !self.is_scaled() {
            return Some(t);
        }
        let unscaled = scale(t, self.exponent());
        (unscaled.abs() > f64::MIN_POSITIVE).then_some(unscaled)
    }

    /// Whether the units are not the caller's.
    #[inline(always)]
    pub(super) fn is_scaled(&self) -> bool {
        (self.length_exponent, self.direction_exponent) != (0, 0)
    }
}
