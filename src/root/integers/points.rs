//! Where the crossings are: points and normals in pairs, from numbers that are exact but for their rounding.

use super::Estimate;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, fast_two_sum, two_difference, two_product, two_sum};
use crate::arithmetic::scaling::scale;
use crate::float::sqrt;
use crate::root::crossing::{Found, Line, Side};
use crate::root::pairs::without_dust;

/// o × d.
#[inline(always)]
pub(super) fn moment(o: Triple<Pair>, d: Triple<f64>) -> Triple<Pair> {
    let coordinate = |oj: Pair, dk: f64, ok: Pair, dj: f64| {
        let (x, y) = (two_product(oj.hi, dk), two_product(ok.hi, dj));
        let difference = two_difference(x.hi, y.hi);
        let low = (x.lo - y.lo) + (oj.lo * dk - ok.lo * dj);
        fast_two_sum(difference.hi, difference.lo + low)
    };
    Triple {
        x: coordinate(o.y, d.z, o.z, d.y),
        y: coordinate(o.z, d.x, o.x, d.z),
        z: coordinate(o.x, d.y, o.y, d.x),
    }
}

/// What the points of the crossings follow from, in scaled units.
pub(super) struct Crossing {
    pub(super) d: Triple<f64>,
    pub(super) radius: f64,
    pub(super) length_exponent: i32,
    pub(super) a: Pair,
    /// o × d.
    pub(super) moment: Triple<Pair>,
    /// √discriminant.
    pub(super) half_chord: Pair,
}

impl Crossing {
    /// The hit at a root.
    #[inline(always)]
    pub(super) fn hit(&self, line: &Line, side: Side, t: f64, root: &Estimate) -> Found {
        let Self { d, radius, length_exponent, .. } = *self;
        let travelled = scale(root.t.hi.abs() * sqrt(self.a.hi), root.exponent);
        let is_close = travelled <= line.radius;

        // From the foot of the closest approach, at (o × d) × d / a from the center, half a chord to either side.
        let along = if side == Side::Near { -self.half_chord } else { self.half_chord };
        let foot = moment(self.moment, d);
        let offset = foot.zip(d, |foot, d| without_dust((foot + along.times(d)) / self.a));
        let (start, exponent, step) = if is_close {
            (line.origin, root.exponent, d.map(|d| without_dust(root.t.times(d))))
        } else {
            (line.center, length_exponent, offset)
        };
        let point = Triple::from(start).zip(step, |start, step| {
            let sum = two_sum(start, scale(step.hi, exponent));
            // Not where it overflows.
            let low = sum.lo + scale(step.lo, exponent);
            if sum.hi.is_finite() { sum.hi + low } else { sum.hi }
        });
        let normal = offset.map(|offset| offset.hi / radius);
        Found { t, point: point.into(), normal: normal.into() }
    }
}
