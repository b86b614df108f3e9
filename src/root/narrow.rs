//! Coordinates as integers of 64 bits, where exact products have room in 256 bits, and how a root compares with a number there.

use core::cmp::Ordering;

use super::answer::Side;
use super::format::Midpoint;
use super::line::Line;
use crate::arithmetic::integer::Shifted;
use crate::arithmetic::pair::{Pair, U};
use crate::arithmetic::product::{Product, sign_of_sum};
use crate::arithmetic::scaled_pair::ScaledPair;
use crate::arithmetic::scaling::{integer_and_exponent, scale};

/// The bits of a length or of a coordinate of the direction: 2⁶¹ and less, so that o, the sum of two, is at most 2⁶², a sum of
/// three products at most 3 2¹²⁴, and the discriminant at most 2²⁵².
const BITS: i32 = 61;

/// A line and a sphere whose lengths are integers in units of one power of two, and whose directions in units of another.
pub(super) struct Narrow {
    o: [i64; 3],
    d: [i64; 3],
    radius: i64,
    length_exponent: i32,
    direction_exponent: i32,
}

/// The unit and the integers of numbers that span at most [`BITS`] places.
#[inline(always)]
fn integers<const N: usize>(numbers: [f64; N]) -> Option<([i64; N], i32)> {
    let mut unit = i32::MAX;
    let mut top = i32::MIN;
    for number in numbers {
        // Without the zeros at its end, a number has a unit of its own.
        let (integer, exponent) = integer_and_exponent(number);
        if integer != 0 {
            unit = unit.min(exponent + signed(integer.trailing_zeros()));
            top = top.max(exponent + signed(u64::BITS - integer.leading_zeros()));
        }
    }
    if unit == i32::MAX {
        return Some(([0; N], 0));
    }
    if top - unit > BITS {
        return None;
    }
    Some((numbers.map(|number| integer_in(number, unit)), unit))
}

/// A number that is an integer of at most 61 bits in that unit.
#[inline(always)]
fn integer_in(number: f64, unit: i32) -> i64 {
    let Shifted { integer, places } = Shifted::new(number, unit);
    integer << places
}

#[expect(clippy::cast_possible_wrap, reason = "at most 64")]
fn signed(places: u32) -> i32 {
    places as i32
}

fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

fn dot(a: [i64; 3], b: [i64; 3]) -> i128 {
    product(a[0], b[0]) + product(a[1], b[1]) + product(a[2], b[2])
}

/// `integer` 2^`unit`, rounded to 106 bits.
fn pair(integer: i128, unit: i32) -> Pair {
    ScaledPair::from_signed(integer, unit).scaled(0)
}

impl Narrow {
    pub(super) fn new(line: &Line) -> Option<Self> {
        let (d, direction_exponent) = integers(line.direction.to_array())?;
        let [cx, cy, cz] = line.center.to_array();
        let [px, py, pz] = line.origin.to_array();
        let ([cx, cy, cz, px, py, pz, radius], length_exponent) =
            integers([cx, cy, cz, px, py, pz, line.radius])?;
        let o = [cx - px, cy - py, cz - pz];
        Some(Self { o, d, radius, length_exponent, direction_exponent })
    }

    /// d·d.
    pub(super) fn a(&self) -> Pair {
        pair(dot(self.d, self.d), 2 * self.direction_exponent)
    }

    /// d·o.
    pub(super) fn h(&self) -> Pair {
        pair(dot(self.o, self.d), self.length_exponent + self.direction_exponent)
    }

    /// o·o - r².
    pub(super) fn power(&self) -> Pair {
        let power = dot(self.o, self.o) - product(self.radius, self.radius);
        pair(power, 2 * self.length_exponent)
    }

    /// r² (d·d) - |o × d|².
    pub(super) fn discriminant(&self) -> Pair {
        let Self { o, d, .. } = self;
        let a = dot(self.d, self.d);
        let radius_squared = product(self.radius, self.radius);
        let a_radius_squared = Product::new(a.unsigned_abs(), radius_squared.unsigned_abs());
        let [x, y, z] = [(1, 2), (2, 0), (0, 1)]
            .map(|(j, k)| Product::square(product(o[j], d[k]) - product(o[k], d[j])));
        let moment_squared = x.plus(y).plus(z);
        let unit = 2 * (self.length_exponent + self.direction_exponent);
        let pair = |difference: Product| difference.to_scaled_pair(unit).scaled(0);
        if a_radius_squared < moment_squared {
            -pair(moment_squared.minus(a_radius_squared))
        } else {
            pair(a_radius_squared.minus(moment_squared))
        }
    }

    /// m d - o at a number, and the radius in its unit. `None` where an integer has no room for these.
    fn offset_at(&self, number: Midpoint) -> Option<([i128; 3], i128)> {
        /// So that the sum of two is below 2¹²⁵, and that of three of their squares below 2²⁵².
        const BITS: u32 = 124;
        let shift = number.exponent + self.direction_exponent - self.length_exponent;
        // By how much m d and o are to be shifted.
        let (left, right) = (shift.max(0).unsigned_abs(), (-shift).max(0).unsigned_abs());
        let shifted = |integer: i128, places: u32| {
            let bits = u128::BITS - integer.unsigned_abs().leading_zeros();
            (integer == 0 || bits.checked_add(places)? <= BITS).then(|| integer << (places % 128))
        };
        let mut w = [0; 3];
        for ((w, d), o) in w.iter_mut().zip(self.d).zip(self.o) {
            let md = shifted(i128::from(number.integer) * i128::from(d), left)?;
            *w = md - shifted(o.into(), right)?;
        }
        Some((w, shifted(self.radius.into(), right)?))
    }

    /// The sign of the quadratic at a number, |m d - o|² - r². `None` where an integer has no room for it.
    pub(super) fn quadratic_at(&self, number: Midpoint) -> Option<Ordering> {
        let (w, radius) = self.offset_at(number)?;
        let [x, y, z] = w.map(Product::square);
        Some(x.plus(y).plus(z).cmp(&Product::square(radius)))
    }

    /// The sign of what is from a number to the closest approach, h - a m. `None` where an integer has no room for it.
    pub(super) fn ahead_of(&self, number: Midpoint) -> Option<Ordering> {
        let (w, _) = self.offset_at(number)?;
        // -d·(m d - o).
        let terms = [0, 1, 2].map(|axis| {
            let negative = (self.d[axis] < 0) == (w[axis] < 0);
            (negative, Product::new(self.d[axis].unsigned_abs().into(), w[axis].unsigned_abs()))
        });
        Some(sign_of_sum(terms))
    }

    /// How the root on that side compares with a number midway between two floats. `None` where 256 bits have no room for that.
    pub(super) fn compare_root(
        &self,
        line: &Line,
        side: Side,
        number: Midpoint,
    ) -> Option<Ordering> {
        let quadratic = self.quadratic_at(number)?;
        if quadratic.is_lt() {
            return Some(side.compared(quadratic, Ordering::Equal));
        }
        let ahead = plainly_ahead(line, number).or_else(|| self.ahead_of(number))?;
        Some(side.compared(quadratic, ahead))
    }
}

/// The sign of what is from a number to the closest approach, h - a m, where that is certain in plain `f64`.
fn plainly_ahead(line: &Line, number: Midpoint) -> Option<Ordering> {
    /// Of the products' absolute values: o and m are rounded once, the products twice, and sums three times.
    const ERROR: f64 = 8.0 * U;
    /// Above what underflows.
    const LEAST: f64 = f64::MIN_POSITIVE / U;
    #[expect(clippy::cast_precision_loss, reason = "it is rounded once")]
    let m = scale(number.integer as f64, number.exponent);
    let (o, d) = (line.center - line.origin, line.direction);
    let (h, am) = (d.dot(o), d.dot(d * m));
    let (ahead, size) = (h - am, d.abs().dot(o.abs()) + am.abs());
    let is_certain =
        m.is_normal() && ahead.abs() > ERROR * size && ahead.abs() > LEAST && size.is_finite();
    if is_certain { ahead.partial_cmp(&0.0) } else { None }
}

/// How the root on that side compares with a number midway between two floats. `None` where only integers of many digits tell.
#[cold]
#[inline(never)]
pub(super) fn compare_root(line: &Line, side: Side, number: Midpoint) -> Option<Ordering> {
    Narrow::new(line)?.compare_root(line, side, number)
}
