//! Coordinates as integers of 64 bits, where exact products have room in 256 bits.

use super::line::Line;
use crate::arithmetic::integer::Shifted;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::product::Product;
use crate::arithmetic::scaled_pair::ScaledPair;
use crate::arithmetic::scaling::integer_and_exponent;

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
}
