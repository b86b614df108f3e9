//! Coordinates as integers of 64 bits.

use core::cmp::Ordering;

use super::Chord;
use crate::arithmetic::product::{Product, sign_of_sum};
use crate::arithmetic::scaling::integer_and_exponent;
use crate::arithmetic::wide::Wide;
use crate::root::crossing::Line;
use crate::root::format::Midpoint;

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
fn integers<const N: usize>(numbers: [f64; N]) -> Option<([i64; N], i32)> {
    // Without the zeros at its end, a number has a unit of its own.
    let parts = numbers.map(|number| {
        let (integer, exponent) = integer_and_exponent(number);
        let zeros = integer.trailing_zeros() % 64;
        (integer >> zeros, exponent + signed(zeros))
    });
    let unit = parts.iter().filter(|part| part.0 != 0).map(|part| part.1).min().unwrap_or(0);
    let mut integers = [0; N];
    for ((integer, number), (magnitude, exponent)) in integers.iter_mut().zip(numbers).zip(parts) {
        if magnitude != 0 {
            let places = signed(u64::BITS - magnitude.leading_zeros());
            let shift = exponent - unit;
            if places + shift > BITS {
                return None;
            }
            let magnitude = i64::try_from(magnitude << shift).ok()?;
            *integer = if number < 0.0 { -magnitude } else { magnitude };
        }
    }
    Some((integers, unit))
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

fn wide(integer: i128, unit: i32) -> Wide {
    let magnitude = Wide::from_integer(integer.unsigned_abs(), unit);
    if integer < 0 { -magnitude } else { magnitude }
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

    pub(super) fn chord(&self) -> Chord {
        let Self { o, d, radius, length_exponent, direction_exponent } = *self;
        let a = dot(d, d);
        let radius_squared = product(radius, radius);
        let moment =
            [(1, 2), (2, 0), (0, 1)].map(|(j, k)| product(o[j], d[k]) - product(o[k], d[j]));
        let a_radius_squared = Product::new(a.unsigned_abs(), radius_squared.unsigned_abs());
        let [x, y, z] = moment.map(Product::square);
        let moment_squared = x.plus(y).plus(z);

        let unit = length_exponent + direction_exponent;
        let discriminant = if a_radius_squared < moment_squared {
            -moment_squared.minus(a_radius_squared).to_wide(2 * unit)
        } else {
            a_radius_squared.minus(moment_squared).to_wide(2 * unit)
        };
        Chord {
            a: wide(a, 2 * direction_exponent),
            h: wide(dot(o, d), unit),
            power: wide(dot(o, o) - radius_squared, 2 * length_exponent),
            discriminant,
            moment: moment.map(|coordinate| wide(coordinate, unit)),
        }
    }

    /// The signs of the quadratic at a number, |m d - o|² - r², and of what is from there to the closest approach, h - a m.
    /// `None` where an integer has no room for m d - o.
    pub(super) fn signs_at(&self, number: Midpoint) -> Option<(Ordering, Ordering)> {
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
        let radius = shifted(self.radius.into(), right)?;

        let [x, y, z] = w.map(Product::square);
        let quadratic = x.plus(y).plus(z).cmp(&Product::square(radius));
        // -d·(m d - o).
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let negative = (self.d[axis] < 0) == (w[axis] < 0);
            (negative, Product::new(self.d[axis].unsigned_abs().into(), w[axis].unsigned_abs()))
        });
        Some((quadratic, sign_of_sum([x, y, z])))
    }
}
