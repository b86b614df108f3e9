//! Exact arithmetic: sums of products of up to four `f64` as integers of fixed length, and numbers of any exponent.
//!
//! A float is an integer times a power of two, so a sum of products of floats is one too, and its sign can be told for
//! sure. Every product of four finite `f64` fits in 264 digits of 32 bits (Kulisch's long accumulator), which is why there
//! is neither overflow nor underflow here, and no allocation.

use core::cmp::Ordering;
use core::ops::Range;

use super::scaling::integer_and_exponent;
pub(crate) use super::wide::Wide;

#[cfg(test)]
mod tests;

/// Bits a digit.
const DIGIT: i32 = 32;
/// The exponent of the lowest digit: below 2⁻⁴²⁹⁶ = (2⁻¹⁰⁷⁴)⁴, and a whole number of digits.
const LEAST: i32 = -135 * DIGIT;
/// Up to 2⁴⁰⁹⁶ = (2¹⁰²⁴)⁴, and two more digits for the sum of many.
const DIGITS: usize = 135 + 128 + 2;

/// A sum of products, exact.
pub(crate) struct Sum {
    /// Least significant first, each with a sign of its own and room for 2³⁰ additions before a carry is due.
    digits: [i64; DIGITS],
    /// Those that may be other than zero.
    used: Range<usize>,
}

/// The four digits of an integer, least significant first.
#[expect(clippy::cast_possible_truncation, reason = "each digit is the low half of what is left")]
fn digits_of(integer: u128) -> [u64; 4] {
    [0, 32, 64, 96].map(|place| u64::from((integer >> place) as u32))
}

impl Sum {
    pub(crate) const fn zero() -> Self {
        Self { digits: [0; DIGITS], used: Range { start: DIGITS, end: 0 } }
    }

    /// Adds `times` the product of four finite numbers. |`times`| is 1 or 2.
    pub(crate) fn add(&mut self, times: i64, factors: [f64; 4]) {
        self.add_scaled(times, 0, factors);
    }

    /// Adds `times` the product of four finite numbers, times 2^`power`: as a whole, in the range of products of four numbers.
    pub(crate) fn add_scaled(&mut self, times: i64, power: i32, factors: [f64; 4]) {
        if factors.contains(&0.0) {
            return;
        }
        let mut negative = times < 0;
        let mut unit = power;
        let mut integers = [0_u128; 4];
        for (integer, factor) in integers.iter_mut().zip(factors) {
            let (mantissa, exponent) = integer_and_exponent(factor);
            *integer = u128::from(mantissa);
            unit += exponent;
            negative ^= factor.is_sign_negative();
        }
        let place = (unit - LEAST).unsigned_abs();
        let (digit, shift) = ((place / 32) as usize, place % 32);
        let left = digits_of(integers[0] * integers[1]);
        let right = digits_of(integers[2] * integers[3]);
        // The product has at most 212 bits, eight digits with the last one unfinished, and the shift moves that to nine.
        let mut product = [0_u64; 9];
        for (i, a) in left.into_iter().enumerate() {
            let mut carry = 0;
            for (j, b) in right.into_iter().enumerate() {
                let sum = a * b + product[i + j] + carry;
                product[i + j] = sum & 0xffff_ffff;
                carry = sum >> 32;
            }
            product[i + 4] = carry;
        }
        // Nine digits of the product, and two more for what the sum of many carries.
        self.used = self.used.start.min(digit)..self.used.end.max((digit + 11).min(DIGITS));
        let mut spill = 0;
        for (target, part) in self.digits[digit..].iter_mut().zip(product) {
            let shifted = (part << shift) | spill;
            spill = shifted >> 32;
            #[expect(
                clippy::cast_possible_truncation,
                reason = "the low half; the high half is carried on"
            )]
            let part = i64::from(shifted as u32) * times.abs();
            *target += if negative { -part } else { part };
        }
    }

    /// Carries, so that every digit is in 0..2³², and gives the carry out of the last of those used: negative if the sum is.
    fn carry(&mut self) -> i64 {
        let mut carry = 0;
        for digit in self.digits.get_mut(self.used.clone()).into_iter().flatten() {
            let sum = *digit + carry;
            *digit = sum & 0xffff_ffff;
            carry = sum >> 32;
        }
        carry
    }

    /// The digits used.
    fn used(&self) -> &[i64] {
        self.digits.get(self.used.clone()).unwrap_or(&[])
    }

    /// The value, rounded to a pair with a relative error below 2⁻⁹⁶, and its exponent.
    pub(crate) fn value(mut self) -> Wide {
        let negative = self.carry() < 0;
        if negative {
            for digit in self.digits.get_mut(self.used.clone()).into_iter().flatten() {
                *digit = -*digit;
            }
            // The digits hold the number modulo 2³²ⁿ, and so does their negative.
            self.carry();
        }
        let Some(top) = self.used().iter().rposition(|digit| *digit != 0) else {
            return Wide::ZERO;
        };
        let top = self.used.start + top;
        // Four digits: at least 97 bits.
        let leading = (0..4).fold(0, |leading, below| {
            let digit = top.checked_sub(below).map_or(0, |index| self.digits[index]);
            (leading << DIGIT) | u128::from(digit.unsigned_abs())
        });
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "there are 265 digits"
        )]
        let unit = LEAST + DIGIT * (top as i32 - 3);
        let value = Wide::from_integer(leading, unit);
        if negative { -value } else { value }
    }

    /// The sign: how the sum compares with 0.
    pub(crate) fn sign(mut self) -> Ordering {
        match self.carry() {
            carry if carry < 0 => Ordering::Less,
            carry if carry > 0 => Ordering::Greater,
            _ if self.used().iter().any(|digit| *digit != 0) => Ordering::Greater,
            _ => Ordering::Equal,
        }
    }
}
