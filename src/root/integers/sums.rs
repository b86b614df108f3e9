//! Sums of products in an accumulator that holds any.

use core::cmp::Ordering;

use crate::arithmetic::exact::{Factor, Sum, Term};
use crate::arithmetic::pair::Pair;
use crate::arithmetic::wide::Wide;
use crate::root::crossing::Line;
use crate::root::format::Midpoint;

/// A line and a sphere of any finite coordinates.
pub(in crate::root) struct Sums {
    /// c - p: each coordinate the exact sum of two numbers.
    o: [[Factor; 2]; 3],
    d: [Factor; 3],
    radius: Factor,
}

/// The sum of a number's terms, squared, `times` 1 or -1.
fn add_square<const N: usize>(sum: &mut Sum, times: i64, terms: [Term; N]) {
    for (index, term) in terms.into_iter().enumerate() {
        sum.add(times, [term, term]);
        for other in terms.into_iter().skip(index + 1) {
            sum.add(2 * times, [term, other]);
        }
    }
}

/// The value of a sum of combined terms.
#[inline(always)]
fn value<const N: usize>(terms: [Term; N]) -> Wide {
    /// How many binary places the second term is smaller, so that the first does not cancel.
    const SMALLER: i32 = 8;
    /// And so many, that it is below the last place of a pair.
    const NEGLIGIBLE: i32 = 108;
    if terms[1].is_zero() {
        return terms[0].to_wide();
    }
    if terms[2].is_zero() {
        let (first, second) = (terms[0].to_wide(), terms[1].to_wide());
        let places = first.exponent() - second.exponent();
        if places > NEGLIGIBLE {
            return first;
        }
        if places > SMALLER {
            return first + second;
        }
    }
    let mut sum = Sum::zero();
    for term in terms {
        sum.add_term(term);
    }
    sum.value()
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
        Self {
            o: o.map(|o| o.map(Factor::from)),
            d: line.direction.to_array().map(Factor::from),
            radius: Factor::from(line.radius),
        }
    }

    /// The terms of d·d.
    fn a_terms(&self) -> [Term; 3] {
        Term::combined(self.d.map(|d| d * d))
    }

    /// d·d.
    pub(super) fn a(&self) -> Wide {
        value(self.a_terms())
    }

    /// The terms of d·o.
    fn h_terms(&self) -> [Term; 6] {
        let [x, y, z] = [0, 1, 2].map(|axis| self.o[axis].map(|o| o * self.d[axis]));
        Term::combined([x[0], y[0], z[0], x[1], y[1], z[1]])
    }

    /// d·o.
    pub(super) fn h(&self) -> Wide {
        value(self.h_terms())
    }

    /// o·o - r².
    pub(super) fn power(&self) -> Wide {
        let mut sum = Sum::zero();
        for o in self.o {
            add_square(&mut sum, 1, o.map(Term::from));
        }
        sum.add_term(-(self.radius * self.radius));
        sum.value()
    }

    /// o × d: each coordinate a sum of terms.
    fn moment_terms(&self) -> [[Term; 4]; 3] {
        let Self { o, d, .. } = *self;
        let coordinate = |j: usize, k: usize| {
            let ([j_hi, j_lo], [k_hi, k_lo]) = (o[j], o[k]);
            Term::combined([j_hi * d[k], -(k_hi * d[j]), j_lo * d[k], -(k_lo * d[j])])
        };
        [coordinate(1, 2), coordinate(2, 0), coordinate(0, 1)]
    }

    /// o × d.
    pub(super) fn moment(&self) -> [Wide; 3] {
        self.moment_terms().map(value)
    }

    /// r² (d·d) - |o × d|².
    pub(super) fn discriminant(&self) -> Wide {
        let mut sum = Sum::zero();
        for term in self.a_terms() {
            sum.add(1, [self.radius * self.radius, term]);
        }
        for coordinate in self.moment_terms() {
            add_square(&mut sum, -1, coordinate);
        }
        sum.value()
    }

    /// The sign of the quadratic at a number, |m d - o|² - r².
    pub(super) fn quadratic_at(&self, number: Midpoint) -> Ordering {
        let m = Factor::new(number.integer, number.exponent);
        let mut sum = Sum::zero();
        sum.add_term(-(self.radius * self.radius));
        for ([hi, lo], d) in self.o.into_iter().zip(self.d) {
            let offset = [m * d, -Term::from(hi), -Term::from(lo)];
            add_square(&mut sum, 1, Term::combined(offset));
        }
        sum.sign()
    }

    /// The sign of what is from a number to the closest approach, h - a m.
    pub(super) fn ahead_of(&self, number: Midpoint) -> Ordering {
        let m = Factor::new(number.integer, number.exponent);
        let mut sum = Sum::zero();
        for term in self.h_terms() {
            sum.add_term(term);
        }
        for term in self.a_terms() {
            sum.add(-1, [term, m.into()]);
        }
        sum.sign()
    }
}
