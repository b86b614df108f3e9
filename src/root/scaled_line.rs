//! Lines of any size, brought near 1, where the pairs and integers of a scene have room.

use glam::DVec3;

use super::answer::{Crossings, Found, Side};
use super::line::Line;
use crate::arithmetic::scaling::{exponent, scale};

#[cfg(test)]
mod tests;

/// 2⁻⁹⁶⁰: a number below that may have lost digits when it was divided by a power of two, and is replaced.
const TINY: f64 = f64::from_bits((1023 - 960) << 52);

/// 2⁻¹⁰⁰⁰, what replaces it; three times as much in the center, so that its difference from the origin is not zero.
const ONE_TINY: f64 = f64::from_bits((1023 - 1000) << 52);

/// A line whose lengths and directions are divided by powers of two.
pub(super) struct Scaled {
    pub(super) line: Line,
    length_exponent: i32,
    direction_exponent: i32,
    /// Whether no number had to be replaced. One that was is so far below the largest of its kind that the difference is next to
    /// nothing beside the error bounds of any step in pairs. No step takes it for exact: integers of a few hundred places have no
    /// room for it, its square underflows, and it is neither 0 nor what it is subtracted from.
    is_exact: bool,
}

impl Scaled {
    /// `None` where a position, or a difference of two, overflows, where all lengths are zero, and where no ray can meet the sphere
    /// at all.
    #[inline(always)]
    pub(super) fn new(line: &Line) -> Option<Self> {
        /// Fourth powers of what lies within 61 places of this neither overflow nor lose anything in a pair. All lines of numbers
        /// in `f32` are so near 1 as they are.
        const NEAR: i32 = 150;
        let o = line.center - line.origin;
        let lengths = o.abs().max_element().max(line.radius);
        if !line.is_valid() || !o.is_finite() || lengths == 0.0 {
            return None;
        }
        let [length, direction] = [lengths, line.direction.abs().max_element()].map(exponent);
        if length.abs() < NEAR && direction.abs() < NEAR {
            let line = *line;
            return Some(Self { line, length_exponent: 0, direction_exponent: 0, is_exact: true });
        }
        let mut is_exact = true;
        let mut divided = |x: f64, exponent: i32, stand_in: f64| {
            let scaled = scale(x, -exponent);
            let is_tiny = x != 0.0 && scaled.abs() < TINY;
            is_exact &= !is_tiny;
            if is_tiny { stand_in.copysign(x) } else { scaled }
        };
        let scaled = Line {
            origin: line.origin.map(|x| divided(x, length, ONE_TINY)),
            direction: line.direction.map(|x| divided(x, direction, ONE_TINY)),
            center: line.center.map(|x| divided(x, length, 3.0 * ONE_TINY)),
            radius: divided(line.radius, length, ONE_TINY),
        };
        let is_finite = scaled.origin.is_finite() && scaled.center.is_finite();
        is_finite.then_some(Self {
            line: scaled,
            length_exponent: length,
            direction_exponent: direction,
            is_exact,
        })
    }

    /// Crossings of this line as those of the caller's.
    #[inline(always)]
    pub(super) fn unscaled<C>(&self, crossings: C) -> Unscaled<'_, C> {
        Unscaled { crossings, scaled: self }
    }
}

/// Crossings in the caller's units. In doubt where a root or a coordinate has fewer digits there, and where a point depends on
/// a number that was replaced.
pub(super) struct Unscaled<'a, C> {
    crossings: C,
    scaled: &'a Scaled,
}

/// A rounded number times a power of two: infinite beyond the largest, `None` below the normal ones.
#[inline(always)]
fn unscaled(x: f64, exponent: i32) -> Option<f64> {
    let unscaled = scale(x, exponent);
    (exponent == 0 || x == 0.0 || unscaled.abs() > f64::MIN_POSITIVE).then_some(unscaled)
}

impl<C: Crossings> Crossings for Unscaled<'_, C> {
    type Root = C::Root;

    #[inline(always)]
    fn root(&mut self, side: Side) -> Option<(f64, C::Root)> {
        let Scaled { length_exponent, direction_exponent, .. } = self.scaled;
        let (t, root) = self.crossings.root(side)?;
        Some((unscaled(t, length_exponent - direction_exponent)?, root))
    }

    #[inline(always)]
    fn hit(&mut self, side: Side, t: f64, root: C::Root) -> Option<Found> {
        if !self.scaled.is_exact {
            return None;
        }
        let Found { point, normal, .. } = self.crossings.hit(side, t, root)?;
        let [x, y, z] = point.to_array().map(|x| unscaled(x, self.scaled.length_exponent));
        Some(Found { t, point: DVec3::new(x?, y?, z?), normal })
    }
}
