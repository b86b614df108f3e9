//! Integers of many digits, for sums of products that are exact.
//!
//! Each operation is compiled once: a call costs little beside it, and copies cost much of a small machine's memory.

use core::cmp::Ordering;

use super::scaled_float::ScaledFloat;
use super::scaled_pair::ScaledPair;
use super::scaling::integer_and_exponent;
use crate::target::{Digit, Double};

#[cfg(test)]
mod tests;

/// The binary places of a digit.
pub(crate) const PLACES: u32 = Digit::BITS;

/// The lower digit of two.
#[expect(clippy::cast_possible_truncation, reason = "the upper digit is dropped")]
const fn lower(double: Double) -> Digit {
    double as Digit
}

/// An integer shifted to the left: `integer` 2^`places`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shifted {
    pub(crate) integer: i64,
    pub(crate) places: u32,
}

impl Shifted {
    /// A finite number that is an integer of units of 2^`unit`.
    #[inline(never)]
    pub(crate) fn new(number: f64, unit: i32) -> Self {
        let (magnitude, exponent) = integer_and_exponent(number);
        let places = exponent - unit;
        // What is shifted out are zeros.
        let magnitude = magnitude.checked_shr((-places).max(0).unsigned_abs()).unwrap_or(0);
        #[expect(clippy::cast_possible_wrap, reason = "53 bits")]
        let integer = magnitude as i64;
        let integer = if number < 0.0 { -integer } else { integer };
        Self { integer, places: places.max(0).unsigned_abs() }
    }

    pub(crate) fn negated(self) -> Self {
        Self { integer: -self.integer, ..self }
    }

    /// The number, rounded.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_wrap,
        reason = "some thousand places"
    )]
    pub(crate) fn to_scaled_float(self) -> ScaledFloat {
        ScaledFloat { value: self.integer as f64, exponent: self.places as i32 }
    }
}

/// An integer, in memory of the caller's.
#[derive(Debug)]
pub(crate) struct Integer<'a> {
    /// The least significant first; what lies beyond `len` does not count.
    digits: &'a mut [Digit],
    /// Without zeros at the top.
    len: usize,
    is_negative: bool,
}

impl<'a> Integer<'a> {
    /// Zero, with room for a sum of products that together with the sum before has a digit less than the memory.
    pub(crate) fn new(digits: &'a mut [Digit]) -> Self {
        Self { digits, len: 0, is_negative: false }
    }

    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.len == 0
    }

    pub(crate) fn is_negative(&self) -> bool {
        self.is_negative && self.len > 0
    }

    /// How the number compares with 0.
    pub(crate) fn sign(&self) -> Ordering {
        if self.is_zero() {
            Ordering::Equal
        } else if self.is_negative {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }

    /// Adds a product.
    pub(crate) fn add(&mut self, a: &Integer, b: &Integer) {
        self.add_digits(a, b.digits(), 0, b.is_negative);
    }

    /// Subtracts a product.
    pub(crate) fn subtract(&mut self, a: &Integer, b: &Integer) {
        self.add_digits(a, b.digits(), 0, !b.is_negative);
    }

    /// Adds a product.
    #[inline(never)]
    pub(crate) fn add_times(&mut self, a: &Integer, Shifted { integer, places }: Shifted) {
        let magnitude = Double::from(integer.unsigned_abs());
        let shift = places % PLACES;
        let first = Double::from(lower(magnitude)) << shift;
        let second = ((magnitude >> PLACES) << shift) + (first >> PLACES);
        let digits = [lower(first), lower(second), lower(second >> PLACES)];
        self.add_digits(a, trimmed(&digits), (places / PLACES) as usize, integer < 0);
    }

    /// Adds a number.
    #[inline(never)]
    pub(crate) fn add_number(&mut self, number: Shifted) {
        let one = Integer { digits: &mut [1], len: 1, is_negative: false };
        self.add_times(&one, number);
    }

    /// The number, within 3 u of itself: rounded three times.
    pub(crate) fn to_scaled_float(&self) -> ScaledFloat {
        /// So many digits have more bits than an `f64`, even where the first has only one.
        const LEADING: usize = if PLACES == 64 { 2 } else { 3 };
        #[expect(clippy::cast_precision_loss, reason = "it is exact")]
        const BASE: f64 = (1_u64 << (PLACES - 1)) as f64 * 2.0;
        let below = self.len.saturating_sub(LEADING);
        #[allow(clippy::cast_precision_loss, clippy::cast_lossless, reason = "it is rounded")]
        let mut leading = self.digits()[below..].iter().rev().map(|digit| *digit as f64);
        let first = leading.next().unwrap_or(0.0);
        let value = leading.fold(first, |value, digit| value * BASE + digit);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "some thousand"
        )]
        let exponent = (below * PLACES as usize) as i32;
        ScaledFloat { value: if self.is_negative { -value } else { value }, exponent }
    }

    /// The number times 2^`unit`, rounded to 106 bits.
    pub(crate) fn to_scaled_pair(&self, unit: i32) -> ScaledPair {
        let zeros = self.digits().last().map_or(0, |digit| digit.leading_zeros());
        // The leading 128 bits, of as many digits and one.
        let (mut leading, mut place) = (0, 128 + zeros);
        for digit in self.digits().iter().rev().take((128 / PLACES + 1) as usize) {
            let digit = u128::from(*digit);
            leading |= match place.checked_sub(PLACES) {
                Some(places) => digit << places,
                None => digit >> (PLACES - place),
            };
            place = place.saturating_sub(PLACES);
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "some thousand"
        )]
        let places = (self.len * PLACES as usize) as i32 - 128 - zeros as i32;
        let magnitude = ScaledPair::from_integer(leading, unit + places);
        if self.is_negative { -magnitude } else { magnitude }
    }

    fn digits(&self) -> &[Digit] {
        &self.digits[..self.len]
    }

    /// Adds `a` times `b`, above so many digits that are zeros.
    #[inline(never)]
    fn add_digits(&mut self, a: &Integer, b: &[Digit], zeros: usize, b_is_negative: bool) {
        let is_negative = a.is_negative != b_is_negative;
        let is_difference = is_negative != self.is_negative;
        // A digit more than both have, so that its first bit is the sign.
        let width = self.len.max(a.len + b.len() + zeros) + 1;
        // Rather no answer than a wrong one: whoever gives the memory has to know that it is enough.
        let sum = &mut self.digits[..width];
        for digit in &mut sum[self.len..] {
            *digit = 0;
        }
        if is_difference {
            // What is to be subtracted from the product.
            negate(sum);
        }
        for (place, x) in a.digits().iter().enumerate() {
            // Floats far apart leave many zeros.
            if *x == 0 {
                continue;
            }
            let mut carry = 0;
            for (place, sum) in sum[zeros + place..].iter_mut().enumerate() {
                let y = match b.get(place) {
                    Some(y) => *y,
                    None if carry == 0 => break,
                    None => 0,
                };
                let double =
                    Double::from(*x) * Double::from(y) + Double::from(*sum) + Double::from(carry);
                *sum = lower(double);
                carry = lower(double >> PLACES);
            }
        }
        // Larger than the product, or not.
        let is_larger = is_difference && sum.last().is_some_and(|last| last >> (PLACES - 1) != 0);
        if is_larger {
            negate(sum);
        } else {
            self.is_negative = is_negative;
        }
        self.len = trimmed(sum).len();
    }
}

/// Negates a number in two's complement.
fn negate(digits: &mut [Digit]) {
    let mut carry = true;
    for digit in digits {
        (*digit, carry) = (!*digit).overflowing_add(carry.into());
    }
}

/// The digits without zeros at the top.
fn trimmed(mut digits: &[Digit]) -> &[Digit] {
    while let [rest @ .., 0] = digits {
        digits = rest;
    }
    digits
}
