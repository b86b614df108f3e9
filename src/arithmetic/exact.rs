//! Exact arithmetic: sums of products of up to four `f64` as integers of fixed length.
//!
//! A float is an integer times a power of two, so a sum of products of floats is one too, and its sign can be told for
//! sure. Every product of four finite `f64` fits in 132 digits of 64 bits (Kulisch's long accumulator), which is why there
//! is neither overflow nor underflow here, and no allocation.

use core::cmp::Ordering;
use core::ops::Range;

use super::product::Product;
use super::scaling::integer_and_exponent;
pub(crate) use super::wide::Wide;

#[cfg(test)]
mod tests;

/// Bits a digit.
const DIGIT: i32 = 64;
/// The exponent of the lowest digit: below 2⁻⁴²⁹⁶ = (2⁻¹⁰⁷⁴)⁴, and a whole number of digits.
const LEAST: i32 = -68 * DIGIT;
/// Up to 2⁴⁰⁹⁶ = (2¹⁰²⁴)⁴, and two more digits for the sum of many.
const DIGITS: usize = 68 + 64 + 2;

/// A sum of products, exact: of the positive ones, less that of the negative ones.
pub(crate) struct Sum {
    /// Least significant first.
    positive: [u64; DIGITS],
    negative: [u64; DIGITS],
    /// Those that may be other than zero.
    used: Range<usize>,
}

/// A factor: a float, or an integer times a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor {
    negative: bool,
    /// At most 54 bits.
    integer: u64,
    exponent: i32,
}

impl Factor {
    pub(crate) const ONE: Self = Self { negative: false, integer: 1, exponent: 0 };

    /// `integer` 2^`exponent`, of at most 54 bits.
    pub(crate) const fn new(integer: i64, exponent: i32) -> Self {
        Self { negative: integer < 0, integer: integer.unsigned_abs(), exponent }
    }
}

impl From<f64> for Factor {
    #[inline]
    fn from(x: f64) -> Self {
        let (integer, exponent) = integer_and_exponent(x);
        Self { negative: x.is_sign_negative(), integer, exponent }
    }
}

impl Sum {
    pub(crate) const fn zero() -> Self {
        let zero = [0; DIGITS];
        Self { positive: zero, negative: zero, used: Range { start: DIGITS, end: 0 } }
    }

    /// Adds `times` the product of four finite numbers. |`times`| is 1 or 2.
    pub(crate) fn add(&mut self, times: i64, factors: [f64; 4]) {
        self.add_factors(times, factors.map(Factor::from));
    }

    /// Adds `times` the product of four factors, which is to be in the range of products of four numbers. |`times`| is 1 or 2.
    #[inline]
    pub(crate) fn add_factors(&mut self, times: i64, factors: [Factor; 4]) {
        let [a, b, c, d] = factors;
        let product = Product::new(
            u128::from(a.integer) * u128::from(b.integer),
            u128::from(c.integer) * u128::from(d.integer),
        );
        if product == Product::ZERO {
            return;
        }
        let negative = (times < 0) ^ a.negative ^ b.negative ^ c.negative ^ d.negative;
        let unit = a.exponent
            + b.exponent
            + c.exponent
            + d.exponent
            + i32::from(times.unsigned_abs() == 2);
        let place = (unit - LEAST).unsigned_abs();
        let (digit, shift) = ((place / 64) as usize, place % 64);
        // The product has at most 216 bits, and the shift moves that to five digits.
        let parts = product.shifted(shift);
        let target = if negative { &mut self.negative } else { &mut self.positive };
        let mut carry = false;
        let mut end = digit;
        for (index, target) in target.iter_mut().enumerate().skip(digit) {
            let part = parts.get(index - digit).copied().unwrap_or(0);
            if index - digit >= parts.len() && !carry {
                break;
            }
            let (sum, first) = target.overflowing_add(part);
            let (sum, second) = sum.overflowing_add(carry.into());
            (*target, carry) = (sum, first || second);
            end = index + 1;
        }
        self.used = self.used.start.min(digit)..self.used.end.max(end);
    }

    /// The sign: how the sum compares with 0.
    pub(crate) fn sign(&self) -> Ordering {
        // Digits of the same place, the highest first, until two differ.
        let used = self.used.clone();
        let digits = |digits: &[u64; DIGITS], index: usize| digits.get(index).copied();
        used.rev()
            .map(|index| digits(&self.positive, index).cmp(&digits(&self.negative, index)))
            .find(|ordering| ordering.is_ne())
            .unwrap_or(Ordering::Equal)
    }

    /// The value, rounded to a pair with a relative error below 2⁻⁹⁶, and its exponent.
    pub(crate) fn value(&self) -> Wide {
        let (larger, smaller) = match self.sign() {
            Ordering::Equal => return Wide::ZERO,
            Ordering::Greater => (&self.positive, &self.negative),
            Ordering::Less => (&self.negative, &self.positive),
        };
        let mut difference = [0; DIGITS];
        let mut borrow = false;
        let mut top = 0;
        for index in self.used.clone() {
            let (digit, first) = larger[index].overflowing_sub(smaller[index]);
            let (digit, second) = digit.overflowing_sub(borrow.into());
            difference[index] = digit;
            borrow = first || second;
            if digit != 0 {
                top = index;
            }
        }
        // Three digits, of which at least 129 bits count: 128 of them.
        let below = |places: usize| top.checked_sub(places).map_or(0, |index| difference[index]);
        let zeros = below(0).leading_zeros();
        let leading = u128::from(below(0)) << 64 | u128::from(below(1));
        let leading = leading << zeros
            | u128::from(below(2)) >> (64 - zeros).min(63) >> u32::from(zeros == 0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "there are 134 digits"
        )]
        let unit = LEAST + DIGIT * (top as i32 - 1) - zeros as i32;
        let value = Wide::from_integer(leading, unit);
        if self.sign().is_lt() { -value } else { value }
    }
}
