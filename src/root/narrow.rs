//! Coordinates as integers of 64 bits, where exact products have room in 256 bits.

use super::line::Line;
use super::unit::Unit;
use crate::arithmetic::integer::Shifted;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::product::Product;
use crate::arithmetic::scaled_pair::ScaledPair;

/// The bits of a length or of a coordinate of the direction: 2⁶¹ and less, so that o, the sum of two, is at most 2⁶², a sum of
/// three products at most 3 2¹²⁴, and the discriminant at most 2²⁵².
const BITS: u32 = 61;

/// A line and a sphere whose lengths are integers in units of one power of two, and whose directions in units of another.
pub(super) struct Narrow {
    o: [i64; 3],
    d: [i64; 3],
    radius: i64,
    length_exponent: i32,
    direction_exponent: i32,
}

/// A number that is an integer of at most 61 bits in that unit.
#[inline(always)]
fn integer_in(number: f64, unit: i32) -> i64 {
    let Shifted { integer, places } = Shifted::new(number, unit);
    integer << places
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
    /// `None` where the coordinates span too many places.
    pub(super) fn new(line: &Line) -> Option<Self> {
        let [lengths, directions] = Unit::of_line(line)?;
        if lengths.places > BITS || directions.places > BITS {
            return None;
        }
        let length = |x: f64| integer_in(x, lengths.exponent);
        let direction = |x: f64| integer_in(x, directions.exponent);
        let Line { origin, direction: d, center, radius } = line;
        Some(Self {
            o: [0, 1, 2].map(|axis| length(center[axis]) - length(origin[axis])),
            d: d.to_array().map(direction),
            radius: length(*radius),
            length_exponent: lengths.exponent,
            direction_exponent: directions.exponent,
        })
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
