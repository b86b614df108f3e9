//! On which side of a number midway between two floats a coordinate of the point is, exactly.
//!
//! In a coordinate, the line is at m where t = n / e, with n = m - p and e the direction there. So w = n d - e o is e times what
//! is from the center to there, and |w|² - (e r)² has the sign of the quadratic. In integers, all of that is exact.

use core::cmp::Ordering;

use super::answer::Side;
use super::format::Midpoint;
use super::line::Line;
use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::scaling::integer_and_exponent;

#[cfg(test)]
mod tests;

/// The most binary places of w. Scenes have fewer; for more, all rounding is left to the last step.
const MOST: i32 = 512;

/// Of the longest sum: a square of w has twice the digits of w, and its sum one more.
const DIGITS: usize = (2 * MOST.unsigned_abs() / PLACES + 1) as usize;

/// The exponents of the last place of some numbers and of what is above all of them.
fn span(numbers: &[f64]) -> (i32, i32) {
    let numbers = numbers.iter().map(|number| integer_and_exponent(*number));
    let exponents = numbers.filter(|(integer, _)| *integer != 0).map(|(_, exponent)| exponent);
    exponents.fold((i32::MAX, i32::MIN), |(unit, top), exponent| {
        (unit.min(exponent), top.max(exponent + 53))
    })
}

/// How the coordinate of a crossing compares with a number midway between two floats, where the direction has such a coordinate.
/// `None` where only integers of more digits tell.
///
/// With L places of lengths and q of directions, n and o are below 2ᴸ⁺¹, d and e below 2ᵠ, and w below 2ᴸ⁺ᵠ⁺². The digits of a
/// factor of w together are at most one more than those of w, and those of d times w no more than those of its square.
#[cold]
#[inline(never)]
pub(super) fn compare(line: &Line, side: Side, axis: usize, number: Midpoint) -> Option<Ordering> {
    let Line { origin: p, direction: d, center: c, radius } = *line;
    let (unit, top) = span(&[p.x, p.y, p.z, c.x, c.y, c.z, radius]);
    let (unit, top) = (unit.min(number.exponent), top.max(number.exponent + 54));
    let (direction_unit, direction_top) = span(&d.to_array());
    if (top - unit) + (direction_top - direction_unit) + 2 > MOST {
        return None;
    }
    let mut memory = [[0; DIGITS]; 5];
    let [n, o, w, quadratic, ahead] = &mut memory.each_mut().map(|digits| Integer::new(digits));
    let length = |x: f64| Shifted::new(x, unit);
    let e = Shifted::new(d[axis], direction_unit);
    n.add_number(Shifted {
        integer: number.integer,
        places: (number.exponent - unit).unsigned_abs(),
    });
    n.add_number(length(-p[axis]));
    for axis in 0..3 {
        let d = Shifted::new(d[axis], direction_unit);
        o.clear();
        o.add_number(length(c[axis]));
        o.add_number(length(-p[axis]));
        w.clear();
        w.add_times(n, d);
        w.add_times(o, e.negated());
        quadratic.add(w, w);
        ahead.add_times(w, d.negated());
    }
    o.clear();
    o.add_number(length(radius));
    w.clear();
    w.add_times(o, e);
    quadratic.subtract(w, w);
    // From a number to the closest approach it is -d·w / a e, and the root is to it as the coordinate is where e is positive.
    let by_e = |order: Ordering| if e.integer < 0 { order.reverse() } else { order };
    Some(by_e(side.compared(quadratic.sign(), by_e(ahead.sign()))))
}
