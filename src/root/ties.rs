//! On which side of a number midway between two floats a root or a coordinate of its point is, exactly.
//!
//! In a coordinate, the line is at m where t = n / e, with n = m - p and e the direction there; it is at t = m where n is m and e
//! is 1. So w = n d - e o is e times what is from the center to there, and |w|² - (e r)² has the sign of the quadratic. In
//! integers, all of that is exact. For a root, floats whose dropped parts are summed tell it first.

use core::cmp::Ordering;

use super::answer::Side;
use super::format::Midpoint;
use super::line::Line;
use super::power;
use super::unit::Unit;
use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{LEAST_PAIR, U, two_difference, two_product, two_sum};
use crate::arithmetic::scaling::scale;

#[cfg(test)]
mod tests;

/// How the root on that side compares with a number midway between two floats. `None` where only integers of more digits tell.
///
/// `ahead` is the sign of what is from the number to the closest approach, where the caller knows that.
#[cold]
#[inline(never)]
pub(super) fn compare_root(
    line: &Line,
    side: Side,
    number: Midpoint,
    ahead: Option<Ordering>,
) -> Option<Ordering> {
    let plainly = quadratic_at(line, number).and_then(|quadratic| {
        // Within the chord, it does not count.
        let ahead = if quadratic.is_lt() { Some(quadratic) } else { ahead };
        Some(side.compared(quadratic, ahead.or_else(|| ahead_of(line, number))?))
    });
    plainly.or_else(|| compare_in_integers(line, side, None, number))
}

/// How the coordinate of a crossing compares with a number midway between two floats, where the direction has such a coordinate.
/// `None` where only integers of more digits tell.
pub(super) fn compare_coordinate(
    line: &Line,
    side: Side,
    axis: usize,
    number: Midpoint,
) -> Option<Ordering> {
    compare_in_integers(line, side, Some(axis), number)
}

/// The sign of the quadratic at a number, if floats are certain of it.
#[inline(always)]
fn quadratic_at(line: &Line, number: Midpoint) -> Option<Ordering> {
    // The number is odd: an even one, of 53 bits, and 1.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    let even = scale((number.integer - 1) as f64, number.exponent);
    let one = scale(1.0, number.exponent);
    let exact = line.o().zip(line.direction.into(), |o, d| {
        let step = two_product(even, d);
        let last = one * d;
        let high = two_difference(step.hi, o.hi);
        let low = two_difference(step.lo, o.lo);
        let lower = two_sum(low.hi, last);
        let lowest = two_sum(lower.hi, high.lo);
        let is_whole = d == 0.0 || last.abs() > LEAST_PAIR;
        let dropped = low.lo.abs() + lower.lo.abs() + lowest.lo.abs();
        (two_sum(high.hi, lowest.hi), if is_whole { dropped } else { f64::INFINITY })
    });
    let dropped = exact.x.1 + exact.y.1 + exact.z.1;
    let w = Triple { x: exact.x.0, y: exact.y.0, z: exact.z.0 };
    let (power, error) = power::closest_power(w, line.radius);
    // 0 only where all is exact: what is dropped counts, and its products may underflow.
    let size = w.x.hi.abs() + w.y.hi.abs() + w.z.hi.abs();
    let of_dropped = 3.0 * (size + dropped) * dropped + f64::MIN_POSITIVE;
    let error = if dropped == 0.0 { error } else { error + of_dropped };
    if power.hi.abs() > error || error == 0.0 { power.hi.partial_cmp(&0.0) } else { None }
}

/// The sign of what is from a number to the closest approach, h - a m, if plain floats are certain of it.
fn ahead_of(line: &Line, number: Midpoint) -> Option<Ordering> {
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

/// The most binary places of w. Scenes have fewer; for more, all rounding is left to the last step.
const MOST: i32 = 512;

/// Of the longest sum: a square of w has twice the digits of w, and its sum one more.
const DIGITS: usize = (2 * MOST.unsigned_abs() / PLACES + 1) as usize;

/// How the coordinate of a crossing on that axis compares with a number, or, without an axis, its root.
///
/// With L places of lengths and q of directions, n and o are below 2ᴸ⁺¹, d and e below 2ᵠ, and w below 2ᴸ⁺ᵠ⁺². For a root, L
/// places hold n d as well as o, and e is 1. The digits of a factor of w together are at most one more than those of w, and those
/// of d times w no more than those of its square.
#[cold]
#[inline(never)]
fn compare_in_integers(
    line: &Line,
    side: Side,
    axis: Option<usize>,
    number: Midpoint,
) -> Option<Ordering> {
    let Line { origin: p, direction: d, center: c, radius } = *line;
    let [lengths, directions] = Unit::of_line(line)?;
    let direction_unit = directions.exponent;
    // In a root, a unit of lengths less that of directions.
    let (less, more) = if axis.is_some() { (0, 0) } else { (direction_unit, directions.top()) };
    let unit = lengths.exponent.min(number.exponent + less);
    let top = lengths.top().max(number.exponent + 54 + more);
    if (top - unit) + (directions.top() - direction_unit) + 2 > MOST {
        return None;
    }
    let mut memory = [[0; DIGITS]; 5];
    let [n, o, w, quadratic, ahead] = &mut memory.each_mut().map(|digits| Integer::new(digits));
    let length = |x: f64| Shifted::new(x, unit);
    let places = (number.exponent - (unit - less)).unsigned_abs();
    n.add_number(Shifted { integer: number.integer, places });
    let e = match axis {
        Some(axis) => {
            n.add_number(length(-p[axis]));
            Shifted::new(d[axis], direction_unit)
        }
        None => Shifted { integer: 1, places: 0 },
    };
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
