//! The roots, and the coordinates of the points there, as numbers (A + B √D) / C of integers.
//!
//! With a, h and D of the quadratic's [`chord`](super::chord), and o = c - p, these are
//!
//! ```text
//! t           (h ∓ √D) / a
//! p + t d     (p a + h d ∓ d √D) / a
//! t d - o     (h d - o a ∓ d √D) / a
//! ```
//!
//! Such a number minus a float is such a number, too. Where A and B √D nearly cancel, their sum is computed as
//! (A² - B² D) / (A - B √D): the dividend, called the norm, is an exact integer, and in the divisor nothing cancels. So it is
//! certain whether a number is positive, negative or zero, and its size is known within [`ERROR`] of itself. [`Surd::round`]
//! needs no more.
//!
//! The integers have as many digits as it takes, by [`digits`]. Lengths are multiples of one power of two, and directions of
//! another.

use glam::DVec3;

use super::answer::{Answer, Crossings, Found, Question, Side, Verdict};
use super::format::Format;
use super::line::Line;
use super::points;
use super::unit::Unit;
use crate::arithmetic::comparison::is_zero;
use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::pair::U;
use crate::arithmetic::scaled_float::ScaledFloat;
use crate::arithmetic::scaling::{integer_and_exponent, scale};

#[cfg(test)]
mod tests;

/// The digits of an integer for any line in each precision. The place may be as fine as the midpoint next to zero, half of the
/// smallest number, where the unit of A is at most 1.
const F32_DIGITS: usize = digits([277; 2], 150);
const F64_DIGITS: usize = digits([2098; 2], 1075);
/// And for lines whose lengths span up to 600 places and directions 100: all memory is cleared, which takes its time.
const FEW_DIGITS: usize = digits_of([600, 100]);

/// The digits of the largest integer for lines whose lengths and directions have so many binary places, p and q: no sum has more.
///
/// d is below 2ᵠ and o below 2ᵖ⁺¹, in each coordinate. The widest number is that of the normal. Its A, h d - a o, is below
/// 2ᵖ⁺²ᵠ⁺⁵, as is every sum on the way to it. B √D is less, and where a multiple of a place is subtracted, less than twice as
/// much is left. The place may be `finer` by so many binary places than the unit of A. The norm has twice as many places. The
/// digits of two factors are together at most one more than those of their product, and a sum has one digit more than these.
const fn digits([lengths, directions]: [u32; 2], finer: u32) -> usize {
    let rational = (lengths + 2 * directions + 6 + finer).div_ceil(PLACES);
    (2 * rational + 2) as usize
}

/// The same where the unit of A may be any. A number that is not zero is at least 1 / (2 |A| C), where the norm is 1, and so
/// above 2⁻ᵖ⁻⁴ᵠ⁻⁹; a midpoint is 55 places finer at most.
const fn digits_of([lengths, directions]: [u32; 2]) -> usize {
    digits([lengths, directions], lengths + 4 * directions + 64)
}

/// How far off what is left of a number may be, as a part of itself.
///
/// An integer of many digits is rounded by 3 u, and √D by half of that and u, its product with B by u. Where their sum is at
/// least a quarter of A, it errs by 4 times 3 u and 5 times 3.5 u and by u, and the division by C brings 4 u more: 35 u. The
/// norm, over a difference in which nothing cancels, has less.
const ERROR: f64 = 64.0 * U;

/// A number (A + B √D) / C, in units of 2^`unit`.
struct Surd<'a, 'm> {
    /// A, the rational part.
    rational: &'a Integer<'m>,
    /// B, by which √D is multiplied.
    coefficient: Shifted,
    /// D, of which the square root is taken.
    discriminant: &'a Integer<'m>,
    /// C, by which the sum is divided.
    denominator: &'a Integer<'m>,
    unit: i32,
}

/// The memory that [`Surd::less`] needs.
struct Scratch<'m> {
    rational: Integer<'m>,
    square: Integer<'m>,
    norm: Integer<'m>,
}

impl Surd<'_, '_> {
    /// The number less `integer` 2^`exponent`, within [`ERROR`] of itself.
    #[inline(never)]
    fn less(&self, integer: i64, exponent: i32, scratch: &mut Scratch) -> ScaledFloat {
        let Scratch { rational, square, norm } = scratch;
        // In the finer of the two units.
        let finer = (self.unit - exponent).max(0);
        let coarser = (exponent - self.unit).max(0);
        rational.clear();
        rational.add_times(self.rational, Shifted { integer: 1, places: finer.unsigned_abs() });
        if integer != 0 {
            let subtrahend = Shifted { integer: -integer, places: coarser.unsigned_abs() };
            rational.add_times(self.denominator, subtrahend);
        }
        let places = self.coefficient.places + finer.unsigned_abs();
        let coefficient = Shifted { places, ..self.coefficient };

        let x = rational.to_scaled_float();
        let y = coefficient.to_scaled_float() * self.discriminant.to_scaled_float().sqrt();
        let mut sum = x + y;
        if sum.is_less_than(x.times(0.25)) {
            square.clear();
            square.add_times(self.discriminant, coefficient);
            norm.clear();
            norm.add(rational, rational);
            norm.add_times(square, coefficient.negated());
            sum = norm.to_scaled_float() / (x - y);
        }
        let ScaledFloat { value, exponent } = sum / self.denominator.to_scaled_float();
        ScaledFloat { value, exponent: exponent + self.unit - finer }
    }

    /// The number, rounded.
    ///
    /// It is divided into a multiple of the last place and what is left, until that tells which multiple is the nearest. Where
    /// what is left is next to a midpoint, how the number compares with that tells.
    #[inline(never)]
    fn round(&self, format: Format, scratch: &mut Scratch) -> f64 {
        /// Of fewer last places the error is far below half of one.
        const FEW: i64 = 1 << 32;
        let mut rest = self.less(0, self.unit, scratch);
        if is_zero(rest.value) {
            return 0.0;
        }
        let sign = rest.value;
        // As if the number were as small as it may be: with a last place too fine it has a digit too many, and that shows.
        let least = rest.times(1.0 - 2.0 * ERROR);
        let mut place =
            (least.leading_exponent() + 1 - format.digits()).max(format.least_exponent());
        let mut multiple: i64 = 0;
        loop {
            let (magnitude, exponent) = integer_and_exponent(rest.value);
            let away = if rest.value.is_sign_negative() { -1 } else { 1 };
            let (whole, mut is_above_half) = divided(magnitude, place - rest.exponent - exponent);
            multiple += away * whole;
            if is_above_half.is_none() && whole < FEW {
                let left = self.less(2 * multiple + away, place - 1, scratch).value;
                let is_odd = multiple % 2 != 0;
                let is_above = left.is_sign_negative() == (away < 0);
                is_above_half = Some(if is_zero(left) { is_odd } else { is_above });
            }
            if let Some(is_above_half) = is_above_half {
                multiple += if is_above_half { away } else { 0 };
                let has_digit_too_many = multiple.unsigned_abs() > 1 << format.digits();
                if !has_digit_too_many {
                    break;
                }
                multiple /= 2;
                place += 1;
            }
            rest = self.less(multiple, place, scratch);
        }
        #[expect(clippy::cast_precision_loss, reason = "at most 53 bits")]
        let multiple = multiple as f64;
        format.nearest(scale(multiple.copysign(sign), place))
    }
}

/// An integer over 2^`below`, rounded down, and whether the rest is more than half, if that is certain where the integer is
/// within [`ERROR`] of itself.
fn divided(integer: u64, below: i32) -> (i64, Option<bool>) {
    /// 2⁻⁴⁷ of it, as [`ERROR`] is.
    const ERROR_PLACES: u32 = 47;
    #[expect(clippy::cast_possible_wrap, reason = "at most 55 bits")]
    match below {
        // Of 53 bits and one or two more, all places are uncertain.
        ..=0 => ((integer << -below) as i64, None),
        1..=62 => {
            let half = 1 << (below - 1);
            let left = integer % (2 * half);
            let is_certain = left.abs_diff(half) > integer >> ERROR_PLACES;
            ((integer >> below) as i64, is_certain.then_some(left > half))
        }
        _ => (0, Some(false)),
    }
}

/// The chord of a line in integers, and what it belongs to.
struct InSurds<'m> {
    line: &'m Line,
    format: Format,
    /// The exponents of the units of lengths and of directions.
    length_unit: i32,
    direction_unit: i32,
    a: Integer<'m>,
    h: Integer<'m>,
    discriminant: Integer<'m>,
    rational: Integer<'m>,
    scratch: Scratch<'m>,
}

/// Computes a, h and the discriminant of a line in these units of lengths and of directions, with memory for o, d and the power.
#[inline(never)]
pub(crate) fn compute_chord(
    line: &Line,
    [length, direction]: [Unit; 2],
    [a, h, discriminant]: [&mut Integer; 3],
    [o, d, power]: [&mut Integer; 3],
) {
    for number in [&mut *a, h, discriminant] {
        number.clear();
    }
    power.clear();
    for axis in 0..3 {
        let coordinate = Shifted::new(line.direction[axis], direction.exponent);
        d.clear();
        d.add_number(coordinate);
        o.clear();
        o.add_number(Shifted::new(line.center[axis], length.exponent));
        o.add_number(Shifted::new(-line.origin[axis], length.exponent));
        a.add_times(d, coordinate);
        h.add_times(o, coordinate);
        power.add(o, o);
    }
    let radius = Shifted::new(line.radius, length.exponent);
    o.clear();
    o.add_number(radius);
    power.add_times(o, radius.negated());
    discriminant.add(h, h);
    discriminant.subtract(a, power);
}

impl Crossings for InSurds<'_> {
    type Root = ();

    fn root(&mut self, side: Side) -> Option<(f64, ())> {
        let surd = Surd {
            rational: &self.h,
            coefficient: Shifted { integer: if side == Side::Near { -1 } else { 1 }, places: 0 },
            discriminant: &self.discriminant,
            denominator: &self.a,
            unit: self.length_unit - self.direction_unit,
        };
        Some((surd.round(self.format, &mut self.scratch), ()))
    }

    fn hit(&mut self, side: Side, t: f64, (): ()) -> Option<Found> {
        let Self {
            line,
            format,
            length_unit,
            direction_unit,
            a,
            h,
            discriminant,
            rational,
            scratch,
            ..
        } = self;
        let &Line { origin, direction, center, radius } = *line;
        let has_radius = radius > 0.0;
        let (radius, exponent) = points::normalized(radius);
        let [mut point, mut normal] = [DVec3::ZERO; 2];
        for axis in 0..3 {
            let d = Shifted::new(direction[axis], *direction_unit);
            let coefficient = if side == Side::Near { d.negated() } else { d };
            rational.clear();
            rational.add_times(h, d);
            rational.add_times(a, Shifted::new(origin[axis], *length_unit));
            let unit = *length_unit;
            let surd = Surd { rational, coefficient, discriminant, denominator: a, unit };
            point[axis] = surd.round(*format, scratch) + 0.0;
            let surd = if has_radius {
                rational.add_times(a, Shifted::new(-center[axis], unit));
                let unit = unit - exponent;
                Surd { rational, coefficient, discriminant, denominator: a, unit }
            } else {
                // There is no outward normal, but one back along the ray, -d √a / a.
                rational.clear();
                Surd {
                    rational,
                    coefficient: d.negated(),
                    discriminant: a,
                    denominator: a,
                    unit: 0,
                }
            };
            let rounded = surd.round(*format, scratch) + 0.0;
            normal[axis] =
                if has_radius { points::normal(*format, rounded, radius) } else { rounded };
        }
        Some(Found { t, point, normal })
    }
}

/// Answers a question for any line.
#[cold]
#[inline(never)]
pub(super) fn answer(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    if !line.is_valid() {
        return None;
    }
    let units = Unit::of_line(line)?;
    let few = digits_of(units.map(|unit| unit.places)) <= FEW_DIGITS;
    match format {
        Format::F32 => answer_within::<F32_DIGITS>(line, units, format, question),
        Format::F64 if few => answer_within::<FEW_DIGITS>(line, units, format, question),
        Format::F64 => answer_within::<F64_DIGITS>(line, units, format, question),
    }
}

/// The same with integers of so many digits.
#[inline(never)]
fn answer_within<const N: usize>(
    line: &Line,
    units: [Unit; 2],
    format: Format,
    question: &Question,
) -> Option<Answer> {
    let mut memory = [[0; N]; 7];
    let [a, h, discriminant, rational, x, y, z] =
        memory.each_mut().map(|digits| Integer::new(digits));
    let scratch = Scratch { rational: x, square: y, norm: z };
    let [length_unit, direction_unit] = units.map(|unit| unit.exponent);
    InSurds { line, format, length_unit, direction_unit, a, h, discriminant, rational, scratch }
        .answer(units, question)
}

impl InSurds<'_> {
    #[inline(never)]
    fn answer(&mut self, units: [Unit; 2], question: &Question) -> Option<Answer> {
        let Self { line, a, h, discriminant, .. } = self;
        let Scratch { rational: o, square: d, norm: power } = &mut self.scratch;
        compute_chord(line, units, [a, h, discriminant], [o, d, power]);
        if discriminant.is_negative() {
            return None;
        }
        match question.ask(self) {
            Verdict::Hit(answer) => Some(answer),
            Verdict::Miss | Verdict::Doubt => None,
        }
    }
}
