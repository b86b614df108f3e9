//! Sums of products in an accumulator that holds any.

use core::cmp::Ordering;

use crate::arithmetic::exact::{Factor, Sum};
use crate::arithmetic::pair::Pair;
use crate::arithmetic::wide::Wide;
use crate::root::crossing::Line;
use crate::root::format::Midpoint;

/// A line and a sphere of any finite coordinates.
pub(in crate::root) struct Sums {
    /// c - p: each coordinate the exact sum of two numbers.
    o: [[f64; 2]; 3],
    d: [f64; 3],
    radius: f64,
}

impl Sums {
    pub(super) fn new(line: &Line) -> Self {
        let difference = line.o();
        let pairs = [difference.x, difference.y, difference.z];
        let terms = line.center.to_array().into_iter().zip(line.origin.to_array());
        let mut o = [[0.0; 2]; 3];
        for ((o, Pair { hi, lo }), (c, p)) in o.iter_mut().zip(pairs).zip(terms) {
            // Where a difference overflows, or a step on the way to it, its two terms are an exact sum still.
            *o = if hi.is_finite() && lo.is_finite() { [hi, lo] } else { [c, -p] };
        }
        Self { o, d: line.direction.to_array(), radius: line.radius }
    }

    /// d·d.
    pub(super) fn a(&self) -> Wide {
        let mut sum = Sum::zero();
        for d in self.d {
            sum.add(1, [d, d, 1.0, 1.0]);
        }
        sum.value()
    }

    /// d·o.
    pub(super) fn h(&self) -> Wide {
        let mut sum = Sum::zero();
        for (o, d) in self.o.into_iter().zip(self.d) {
            for o in o {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
        }
        sum.value()
    }

    /// o·o - r².
    pub(super) fn power(&self) -> Wide {
        let mut sum = Sum::zero();
        for [hi, lo] in self.o {
            sum.add(1, [hi, hi, 1.0, 1.0]);
            sum.add(2, [hi, lo, 1.0, 1.0]);
            sum.add(1, [lo, lo, 1.0, 1.0]);
        }
        sum.add(-1, [self.radius, self.radius, 1.0, 1.0]);
        sum.value()
    }

    /// o × d: each coordinate the sum of four products.
    fn moment_terms(&self) -> [[[f64; 2]; 4]; 3] {
        let Self { o, d, .. } = *self;
        [(1, 2), (2, 0), (0, 1)]
            .map(|(j, k)| [[o[j][0], d[k]], [o[j][1], d[k]], [-o[k][0], d[j]], [-o[k][1], d[j]]])
    }

    /// o × d.
    pub(super) fn moment(&self) -> [Wide; 3] {
        self.moment_terms().map(|coordinate| {
            let mut sum = Sum::zero();
            for [o, d] in coordinate {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
            sum.value()
        })
    }

    /// r² (d·d) - |o × d|².
    pub(super) fn discriminant(&self) -> Wide {
        let mut sum = Sum::zero();
        for d in self.d {
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

    /// The sign of the quadratic at a number, |m d - o|² - r².
    pub(super) fn quadratic_at(&self, number: Midpoint) -> Ordering {
        const ONE: Factor = Factor::ONE;
        let m = Factor::new(number.integer, number.exponent);
        let mut sum = Sum::zero();
        sum.add(-1, [self.radius, self.radius, 1.0, 1.0]);
        for (o, d) in self.o.into_iter().zip(self.d) {
            let [hi, lo] = o.map(Factor::from);
            let d = Factor::from(d);
            sum.add_factors(1, [m, d, m, d]);
            sum.add_factors(-2, [m, d, hi, ONE]);
            sum.add_factors(-2, [m, d, lo, ONE]);
            sum.add_factors(1, [hi, hi, ONE, ONE]);
            sum.add_factors(2, [hi, lo, ONE, ONE]);
            sum.add_factors(1, [lo, lo, ONE, ONE]);
        }
        sum.sign()
    }

    /// The sign of what is from a number to the closest approach, h - a m.
    pub(super) fn ahead_of(&self, number: Midpoint) -> Ordering {
        let m = Factor::new(number.integer, number.exponent);
        let mut sum = Sum::zero();
        for (o, d) in self.o.into_iter().zip(self.d) {
            for o in o {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
            let d = Factor::from(d);
            sum.add_factors(-1, [d, d, m, Factor::ONE]);
        }
        sum.sign()
    }
}
