//! Where two tries in `f64` leave a doubt: the geometric derivation in pairs, and where pairs cannot tell either, in integers.
//!
//! With v = u² = 2⁻¹⁰⁶, m the larger of o·o and r², o = c - p exactly a pair, r² too but for what underflows, and by the bounds in
//! [`pair`](crate::arithmetic::pair):
//!
//! ```text
//! a, h, o·o     products 5 v, two additions 4 v each         |error| ≤ 13 v a,  13 v |o| |d|,  13 v o·o
//! power         13 v o·o, difference 4 v (o·o + r²)          |error| ≤ 21 v m
//! discriminant  r² a: 18 v a m;  |o × d|²: 39 v a o·o (as |error of o × d| ≤ 9 √2 v |o| |d|);  difference: 8 v a m
//!                                                            |error| ≤ 65 v a m
//! ```

use core::cmp::Ordering;
use core::ops::Range;

use glam::DVec3;

use crate::arithmetic::exact::{Sum, Wide};
use crate::arithmetic::number::{Number, Triple};
use crate::arithmetic::pair::{
    PRODUCT_ERROR, Pair, QUOTIENT_ERROR, ROOT_ERROR, SUM_ERROR, V, two_difference,
};
use crate::arithmetic::scaling::{exponent, scale};
use crate::chord::{Chord, Derivation};
use crate::float::sqrt;
use crate::geometric::ClosestApproach;
use crate::{Ray, Scalar, Sphere, Vector};

#[cfg(test)]
mod tests;

/// Of a in itself, of h in |o| |d|, of o·o in itself: a product and two additions.
const DOT_ERROR: f64 = PRODUCT_ERROR + 2.0 * SUM_ERROR;
/// Of the power, in m.
const POWER_ERROR: f64 = DOT_ERROR + 2.0 * SUM_ERROR;
/// Of |o × d|², in a o·o: twice 9 √2 v < 13 v for that of o × d, and the product with itself.
const MOMENT_SQUARED_ERROR: f64 = 2.0 * 13.0 * V + DOT_ERROR;
/// Of the discriminant, in a m.
const DISCRIMINANT_ERROR: f64 =
    (DOT_ERROR + PRODUCT_ERROR) + MOMENT_SQUARED_ERROR + 2.0 * SUM_ERROR;
/// Of a root besides what h, the discriminant and the power bring with them, in itself: of a, the square root, the sum and the
/// quotient, and one to spare.
const ROOT_QUOTIENT_ERROR: f64 = DOT_ERROR + ROOT_ERROR + SUM_ERROR + QUOTIENT_ERROR + V;

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
        let near = foot.zip(half_chord, |foot, half_chord| (foot - half_chord).to_f64());
        let far = foot.zip(half_chord, |foot, half_chord| (foot + half_chord).to_f64());
        Self { t, normals: [near.into(), far.into()] }
    }

    /// The first crossing with a finite t > 0 in the range: its root, and the normal there.
    #[inline(always)]
    pub(crate) fn nearest(&self, range: &Range<S>) -> Option<(S, DVec3)> {
        let accepted = |t: &S| *t > S::ZERO && *t < S::INFINITY && range.contains(t);
        let side = self.t.iter().position(accepted)?;
        Some((self.t[side], self.normals[side]))
    }
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

/// Which root.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Near,
    Far,
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

/// What pairs say.
enum InPairs<T> {
    Miss,
    Hit(T),
    Doubt,
}

/// The setting with lengths and directions each divided by a power of two that brings them near 1.
struct Scaled {
    o: Triple<Pair>,
    d: Triple<f64>,
    radius: f64,
    /// The exponent of the power of two that a root is to be multiplied by.
    root_exponent: i32,
}

impl Scaled {
    /// `None` where the difference of the positions is no pair, or all lengths are zero.
    fn new(exact: &Exact) -> Option<Self> {
        /// Fourth powers of what lies within this of 1 neither overflow nor lose anything in a pair.
        const NEAR: i32 = 200;
        let &Exact { o, in_pairs, d, radius } = exact;
        let longest = o.x.hi.abs().max(o.y.hi.abs()).max(o.z.hi.abs()).max(radius);
        if !in_pairs || longest == 0.0 {
            return None;
        }
        let length_exponent = exponent(longest);
        let direction_exponent = exponent(d.x.abs().max(d.y.abs()).max(d.z.abs()));
        if length_exponent.abs() < NEAR && direction_exponent.abs() < NEAR {
            return Some(Self { o, d, radius, root_exponent: 0 });
        }
        // What this rounds, far below the largest of its kind, is below every error bound.
        let shorten = |x: f64| scale(x, -length_exponent);
        Some(Self {
            o: o.map(|pair| Pair { hi: shorten(pair.hi), lo: shorten(pair.lo) }),
            d: d.map(|x| scale(x, -direction_exponent)),
            radius: shorten(radius),
            root_exponent: length_exponent - direction_exponent,
        })
    }

    fn chord(&self) -> (Chord<Pair>, Pair) {
        let radius = Pair::from(self.radius);
        let radius_squared = radius * radius;
        (ClosestApproach::chord(self.o, self.d.map(Pair::from), radius_squared), radius_squared)
    }

    fn estimate(&self) -> InPairs<Estimate> {
        let (Chord { a, h, distance_squared, power, discriminant }, radius_squared) = self.chord();

        let larger = distance_squared.hi.max(radius_squared.hi);
        let discriminant_error = DISCRIMINANT_ERROR * (a.hi * larger);
        if discriminant.hi < -discriminant_error {
            return InPairs::Miss;
        }
        let power_error = POWER_ERROR * larger;
        if discriminant.hi <= discriminant_error || power.hi.abs() <= power_error {
            return InPairs::Doubt;
        }

        // √D - √D' = (D - D') / (√D + √D'), at most the error of D over √D'.
        let half_chord = discriminant.sqrt();
        let sum = h.abs() + half_chord;
        let sum_error =
            DOT_ERROR * sqrt(a.hi * distance_squared.hi) + discriminant_error / half_chord.hi;

        // The root that does not cancel, and the other one from the product of the roots, power / a.
        // The errors of quotients are doubled for their terms of second order.
        let sum_relative_error = 2.0 * (sum_error / sum.hi) + ROOT_QUOTIENT_ERROR;
        let power_relative_error = 2.0 * (power_error / power.hi.abs());
        let x = (with_sign_of(h, sum / a), sum_relative_error);
        let y = (with_sign_of(h, power / sum), sum_relative_error + power_relative_error);
        InPairs::Hit(Estimate { a, half_chord, sum_error, roots: [x, y] })
    }

    fn crossings<S: Target>(&self) -> InPairs<Crossings<S>> {
        let Estimate { a, half_chord, sum_error, roots } = match self.estimate() {
            InPairs::Miss => return InPairs::Miss,
            InPairs::Hit(estimate) => estimate,
            InPairs::Doubt => return InPairs::Doubt,
        };
        if sum_error > S::NORMAL_ERROR * (self.radius * sqrt(a.hi)) {
            return InPairs::Doubt;
        }
        let [Some(x), Some(y)] = roots
            .map(|(t, relative_error)| S::settle(scale(t.hi, self.root_exponent), relative_error))
        else {
            return InPairs::Doubt;
        };
        let t = if y < x { [y, x] } else { [x, y] };
        let d = self.d.map(Pair::from);
        let radius = Pair::from(self.radius);
        InPairs::Hit(Crossings::new(t, d, self.o.cross(d), a, half_chord, radius))
    }
}

/// The chord in pairs, where its signs are certain.
struct Estimate {
    a: Pair,
    /// √discriminant.
    half_chord: Pair,
    /// How far off |h| and half the chord may be together.
    sum_error: f64,
    /// Each with its relative error, in no order.
    roots: [(Pair, f64); 2],
}

/// `magnitude` with the sign of `h`.
fn with_sign_of(h: Pair, magnitude: Pair) -> Pair {
    if h.hi < 0.0 { -magnitude } else { magnitude }
}

/// The setting, exactly.
struct Exact {
    /// c - p: each coordinate the exact sum of two numbers.
    o: Triple<Pair>,
    /// Whether those sums are pairs.
    in_pairs: bool,
    d: Triple<f64>,
    radius: f64,
}

impl Exact {
    fn new(line: &Line) -> Self {
        let difference = line.o();
        let is_pair = |pair: Pair| pair.hi.is_finite() && pair.lo.is_finite();
        let in_pairs = is_pair(difference.x) && is_pair(difference.y) && is_pair(difference.z);
        // Where a difference overflows, or a step on the way to it, its two terms are an exact sum still.
        let o = if in_pairs {
            difference
        } else {
            Triple::from(line.center).zip(line.origin.into(), |c, p| Pair { hi: c, lo: -p })
        };
        Self { o, in_pairs, d: Triple::from(line.direction), radius: line.radius }
    }

    fn crossings<S: Target>(&self) -> Option<Crossings<S>> {
        let discriminant = self.discriminant();
        if discriminant.is_negative() {
            return None;
        }
        let half_chord = discriminant.sqrt();
        let a = self.a();
        let h = self.h();
        let roots = if half_chord.is_zero() {
            [h / a, h / a]
        } else {
            let power = self.power();
            if h.is_negative() {
                let sum = h + -half_chord;
                [sum / a, power / sum]
            } else {
                let sum = h + half_chord;
                [power / sum, sum / a]
            }
        };
        let settle =
            |root: Wide, side| S::settle_exactly(root.to_f64(), |m| self.compare_root(side, m));
        let t = [settle(roots[0], Side::Near), settle(roots[1], Side::Far)];
        // Of two roots that differ by less than an f64 can tell, each may have been rounded to the side of the other.
        let t = if t[1] < t[0] { [t[1], t[0]] } else { t };
        Some(self.crossings_at(t, half_chord))
    }

    /// The six terms of o with their places: the coordinates are the sums of each two.
    fn o_terms(&self) -> [[f64; 2]; 3] {
        [self.o.x, self.o.y, self.o.z].map(|pair| [pair.hi, pair.lo])
    }

    fn d_terms(&self) -> [f64; 3] {
        [self.d.x, self.d.y, self.d.z]
    }

    /// d·d.
    fn a(&self) -> Wide {
        let mut sum = Sum::zero();
        for d in self.d_terms() {
            sum.add(1, [d, d, 1.0, 1.0]);
        }
        sum.value()
    }

    /// d·o.
    fn h(&self) -> Wide {
        let mut sum = Sum::zero();
        for (o, d) in self.o_terms().into_iter().zip(self.d_terms()) {
            for o in o {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
        }
        sum.value()
    }

    /// o·o - r².
    fn power(&self) -> Wide {
        let mut sum = Sum::zero();
        for [hi, lo] in self.o_terms() {
            sum.add(1, [hi, hi, 1.0, 1.0]);
            sum.add(2, [hi, lo, 1.0, 1.0]);
            sum.add(1, [lo, lo, 1.0, 1.0]);
        }
        sum.add(-1, [self.radius, self.radius, 1.0, 1.0]);
        sum.value()
    }

    /// o × d: each coordinate the sum of four products.
    fn moment_terms(&self) -> [[[f64; 2]; 4]; 3] {
        let (o, d) = (self.o_terms(), self.d_terms());
        [(1, 2), (2, 0), (0, 1)]
            .map(|(i, j)| [[o[i][0], d[j]], [o[i][1], d[j]], [-o[j][0], d[i]], [-o[j][1], d[i]]])
    }

    /// r² (d·d) - |o × d|².
    fn discriminant(&self) -> Wide {
        let mut sum = Sum::zero();
        for d in self.d_terms() {
            sum.add(1, [self.radius, self.radius, d, d]);
        }
        for coordinate in self.moment_terms() {
            for (i, [o, d]) in coordinate.into_iter().enumerate() {
                sum.add(-1, [o, d, o, d]);
                for [other_o, other_d] in coordinate.into_iter().skip(i + 1) {
                    sum.add(-2, [o, d, other_o, other_d]);
                }
            }
        }
        sum.value()
    }

    /// How the near or the far root compares with `m`: by the sign of the quadratic at m, and the side of the closest
    /// approach that m lies on.
    fn compare_root(&self, side: Side, m: f64) -> Ordering {
        // |m d - o|² - r².
        let mut quadratic = Sum::zero();
        quadratic.add(-1, [self.radius, self.radius, 1.0, 1.0]);
        // h - a m.
        let mut ahead = Sum::zero();
        for ([hi, lo], d) in self.o_terms().into_iter().zip(self.d_terms()) {
            quadratic.add(1, [m, d, m, d]);
            for o in [hi, lo] {
                quadratic.add(-2, [m, d, o, 1.0]);
                ahead.add(1, [o, d, 1.0, 1.0]);
            }
            quadratic.add(1, [hi, hi, 1.0, 1.0]);
            quadratic.add(2, [hi, lo, 1.0, 1.0]);
            quadratic.add(1, [lo, lo, 1.0, 1.0]);
            ahead.add(-1, [d, d, m, 1.0]);
        }
        match (side, quadratic.sign(), ahead.sign()) {
            // Outside the chord, m lies before both roots or behind both.
            (_, Ordering::Greater, ahead) => ahead,
            // At a root: at the near one where the closest approach is still ahead, at the far one where it is past.
            (Side::Near, Ordering::Equal, Ordering::Greater | Ordering::Equal)
            | (Side::Far, Ordering::Equal, Ordering::Less | Ordering::Equal) => Ordering::Equal,
            // Within the chord.
            (Side::Near, ..) => Ordering::Less,
            (Side::Far, ..) => Ordering::Greater,
        }
    }

    /// The crossings at those roots.
    fn crossings_at<S: Target>(&self, t: [S; 2], half_chord: Wide) -> Crossings<S> {
        let direction_exponent = exponent(self.d.x.abs().max(self.d.y.abs()).max(self.d.z.abs()));
        let d = self.d.map(|d| scale(d, -direction_exponent));
        if self.radius == 0.0 {
            // There is no normal: back along the ray.
            return Crossings { t, normals: [-DVec3::from(d).normalize(); 2] };
        }
        // In units of the radius and of the direction's length, which bound half the chord and the moment.
        let radius_exponent = exponent(self.radius);
        let unit = -(radius_exponent + direction_exponent);
        let [x, y, z] = self.moment_terms().map(|coordinate| {
            let mut sum = Sum::zero();
            for [o, d] in coordinate {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
            sum.value().scaled(unit)
        });
        let d = d.map(Pair::from);
        let radius = Pair::from(scale(self.radius, -radius_exponent));
        Crossings::new(t, d, Triple { x, y, z }, d.dot(d), half_chord.scaled(unit), radius)
    }
}
