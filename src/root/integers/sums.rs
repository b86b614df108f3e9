//! Sums of products in an accumulator that holds any.

use core::cmp::Ordering;

use super::Chord;
use crate::arithmetic::exact::Sum;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::wide::Wide;
use crate::root::crossing::Line;
use crate::root::format::Midpoint;

/// A line and a sphere of any finite coordinates.
pub(super) struct Sums {
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

    pub(super) fn chord(&self) -> Chord {
        Chord {
            a: self.a(),
            h: self.h(),
            power: self.power(),
            discriminant: self.discriminant(),
            moment: self.moment_terms().map(|coordinate| {
                let mut sum = Sum::zero();
                for [o, d] in coordinate {
                    sum.add(1, [o, d, 1.0, 1.0]);
                }
                sum.value()
            }),
        }
    }

    /// d·d.
    fn a(&self) -> Wide {
        let mut sum = Sum::zero();
        for d in self.d {
            sum.add(1, [d, d, 1.0, 1.0]);
        }
        sum.value()
    }

    /// d·o.
    fn h(&self) -> Wide {
        let mut sum = Sum::zero();
        for (o, d) in self.o.into_iter().zip(self.d) {
            for o in o {
                sum.add(1, [o, d, 1.0, 1.0]);
            }
        }
        sum.value()
    }

    /// o·o - r².
    fn power(&self) -> Wide {
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

    /// r² (d·d) - |o × d|².
    fn discriminant(&self) -> Wide {
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

    /// The signs of the quadratic at a number, |m d - o|² - r², and of what is from there to the closest approach, h - a m.
    pub(super) fn signs_at(&self, number: Midpoint) -> (Ordering, Ordering) {
        let Midpoint { integer, exponent } = number;
        // An odd integer of 54 bits: two floats.
        #[expect(clippy::cast_precision_loss, reason = "an even number of 54 bits is exact")]
        let terms = [(integer - integer.signum()) as f64, integer.signum() as f64];
        let mut quadratic = Sum::zero();
        quadratic.add(-1, [self.radius, self.radius, 1.0, 1.0]);
        let mut ahead = Sum::zero();
        for (o, d) in self.o.into_iter().zip(self.d) {
            quadratic.add_scaled(1, 2 * exponent, [terms[0], d, terms[0], d]);
            quadratic.add_scaled(2, 2 * exponent, [terms[0], d, terms[1], d]);
            quadratic.add_scaled(1, 2 * exponent, [terms[1], d, terms[1], d]);
            for o in o {
                ahead.add(1, [o, d, 1.0, 1.0]);
                for m in terms {
                    quadratic.add_scaled(-2, exponent, [m, d, o, 1.0]);
                }
            }
            for m in terms {
                ahead.add_scaled(-1, exponent, [d, d, m, 1.0]);
            }
            let [hi, lo] = o;
            quadratic.add(1, [hi, hi, 1.0, 1.0]);
            quadratic.add(2, [hi, lo, 1.0, 1.0]);
            quadratic.add(1, [lo, lo, 1.0, 1.0]);
        }
        (quadratic.sign(), ahead.sign())
    }
}
