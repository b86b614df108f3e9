//! The geometric derivation in integers: exact, and so never in doubt.

use core::cmp::Ordering;

use glam::DVec3;

use super::{Crossings, Line, Target};
use crate::arithmetic::exact::{Sum, Wide};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::scaling::{exponent, scale};

/// Which root.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Near,
    Far,
}

/// The setting, exactly.
pub(super) struct Exact {
    /// c - p: each coordinate the exact sum of two numbers.
    pub(super) o: Triple<Pair>,
    /// Whether those sums are pairs.
    pub(super) in_pairs: bool,
    pub(super) d: Triple<f64>,
    pub(super) radius: f64,
}

impl Exact {
    pub(super) fn new(line: &Line) -> Self {
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

    pub(super) fn crossings<S: Target>(&self) -> Option<Crossings<S>> {
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
    pub(super) fn compare_root(&self, side: Side, m: f64) -> Ordering {
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
