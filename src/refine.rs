//! Where two tries in `f64` leave a doubt: the geometric derivation in pairs, and where pairs cannot tell either, in integers.

mod integers;
mod pairs;
#[cfg(test)]
mod tests;

use core::cmp::Ordering;
use core::ops::Range;

use glam::DVec3;
use integers::Exact;
use pairs::{InPairs, Scaled};

use crate::arithmetic::number::{Number, Triple};
use crate::arithmetic::pair::{Pair, two_difference};
use crate::{Ray, Scalar, Sphere, Vector};

/// A line and a sphere as the caller gave them.
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
}

impl Line {
    #[inline(always)]
    pub(crate) fn new<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>) -> Self {
        Self {
            origin: ray.origin.to_f64(),
            direction: ray.direction.to_f64(),
            center: sphere.center.to_f64(),
            radius: sphere.radius.into(),
        }
    }

    /// c - p, exactly, unless it overflows on the way.
    #[inline(always)]
    pub(crate) fn o(&self) -> Triple<Pair> {
        Triple::from(self.center).zip(Triple::from(self.origin), two_difference)
    }
}

/// Where a line crosses a sphere.
pub(crate) struct Crossings<S> {
    /// The roots, ascending.
    pub(crate) t: [S; 2],
    /// The outward unit normals there.
    pub(crate) normals: [DVec3; 2],
}

impl<S: Scalar> Crossings<S> {
    /// The geometric derivation's last step: from the foot of the closest approach, which is at `-d × (o × d) / a` from the
    /// center, half a chord to either side.
    #[inline(always)]
    pub(crate) fn new<N: Number>(
        t: [S; 2],
        d: Triple<N>,
        moment: Triple<N>,
        a: N,
        half_chord: N,
        radius: N,
    ) -> Self {
        let radii = N::ONE / (a * radius);
        let half_chord = d.map(|d| d * (half_chord * radii));
        let foot = moment.cross(d).map(|foot| foot * radii);
        let near = foot.zip(half_chord, |foot, half_chord| foot - half_chord);
        let far = foot.zip(half_chord, |foot, half_chord| foot + half_chord);
        Self { t, normals: [near, far].map(|normal| normal.map(without_dust).into()) }
    }

    /// The first crossing with a finite t > 0 in the range: its root, and the normal there.
    #[inline(always)]
    pub(crate) fn nearest(&self, range: &Range<S>) -> Option<(S, DVec3)> {
        let accepted = |t: &S| *t > S::ZERO && *t < S::INFINITY && range.contains(t);
        let side = self.t.iter().position(accepted)?;
        Some((self.t[side], self.normals[side]))
    }
}

/// A coordinate of a unit vector, zero where it is so small that the low part of a product underflowed on the way: what is left
/// of such a part depends on whether the machine has a fused multiply-add.
#[inline(always)]
fn without_dust<N: Number>(coordinate: N) -> f64 {
    const DUST: f64 = f64::from_bits((1023 - 800) << 52); // 2^-800
    let coordinate = coordinate.to_f64();
    // A zero of the same sign.
    if coordinate.abs() < DUST { coordinate * 0.0 } else { coordinate }
}

/// A precision that roots are rounded to.
pub(crate) trait Target: Scalar {
    /// How far off the normal may be.
    const NORMAL_ERROR: f64;

    /// The value within `relative_error` of `t` as the contract has it, or `None` where that is not yet certain.
    fn settle(t: f64, relative_error: f64) -> Option<Self>;

    /// The same for a `t` that is as good as an `f64` can be, with `compare` to say how the exact value compares with a number.
    fn settle_exactly(t: f64, compare: impl FnOnce(f64) -> Ordering) -> Self;
}

/// Whether only integers can tell.
#[cfg(test)]
pub(crate) fn needs_integers<S: Target>(line: &Line) -> bool {
    let scaled = Scaled::new(&Exact::new(line));
    matches!(scaled.map(|scaled| scaled.crossings::<S>()), Some(InPairs::Doubt) | None)
}

/// Both crossings along the whole line, if there are any.
#[inline(never)]
pub(crate) fn crossings<S: Target>(line: &Line) -> Option<Crossings<S>> {
    let Line { origin, direction, center, radius } = *line;
    let finite =
        origin.is_finite() && direction.is_finite() && center.is_finite() && radius.is_finite();
    if !finite || direction == DVec3::ZERO || radius < 0.0 {
        return None;
    }
    let exact = Exact::new(line);
    match Scaled::new(&exact).map(|scaled| scaled.crossings::<S>()) {
        Some(InPairs::Miss) => None,
        Some(InPairs::Hit(crossings)) => Some(crossings),
        Some(InPairs::Doubt) | None => exact.crossings::<S>(),
    }
}
