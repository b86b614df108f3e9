//! Exact arithmetic: sums of products of up to four `f64` as integers of fixed length.
//!
//! A float is an integer times a power of two, so a sum of products of floats is one too, and its sign can be told for
//! sure. Every product of four finite `f64` fits in 132 digits of 64 bits (Kulisch's long accumulator), which is why there
//! is neither overflow nor underflow here, and no allocation.

use core::cmp::Ordering;
use core::ops::{Mul, Neg, Range};

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

/// A sum of products, exact.
pub(crate) struct Sum {
    /// Least significant first. A digit is any integer until the carries are settled, and a sum of 2⁶³ products fits.
    digits: [i128; DIGITS],
    /// Those that may be other than zero.
    used: Range<usize>,
}

/// A factor: a float, or an integer times a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor {
    /// At most 54 bits.
    integer: i64,
    exponent: i32,
}

impl Factor {
    pub(crate) const ONE: Self = Self { integer: 1, exponent: 0 };

    /// `integer` 2^`exponent`, of at most 54 bits.
    pub(crate) const fn new(integer: i64, exponent: i32) -> Self {
        Self { integer, exponent }
    }
}

impl From<f64> for Factor {
    #[inline(always)]
    fn from(x: f64) -> Self {
        let (magnitude, exponent) = integer_and_exponent(x);
        // Without the zeros at its end, so that more terms fit in one.
        let zeros = magnitude.trailing_zeros() & 63;
        #[expect(clippy::cast_possible_wrap, reason = "53 bits")]
        let (integer, zeros) = ((magnitude >> zeros) as i64, zeros as i32);
        Self { integer: if x < 0.0 { -integer } else { integer }, exponent: exponent + zeros }
    }
}

/// A product of two factors, or a sum of some that fits: `integer` 2^`exponent`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    /// At most [`Term::BITS`] bits.
    integer: i128,
    exponent: i32,
}

impl Mul for Factor {
    type Output = Term;

    #[cfg_attr(not(target_os = "none"), inline(always))]
    #[cfg_attr(target_os = "none", inline(never))]
    fn mul(self, other: Self) -> Term {
        let integer = i128::from(self.integer) * i128::from(other.integer);
        Term { integer, exponent: self.exponent + other.exponent }
    }
}

impl From<Factor> for Term {
    #[inline(always)]
    fn from(factor: Factor) -> Self {
        factor * Factor::ONE
    }
}

impl Neg for Term {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { integer: -self.integer, ..self }
    }
}

impl Term {
    const BITS: u32 = 124;
    const ZERO: Self = Self { integer: 0, exponent: 0 };

    pub(crate) const fn new(integer: i128, exponent: i32) -> Self {
        Self { integer, exponent }
    }

    /// The value, rounded to 106 bits.
    pub(crate) fn to_wide(self) -> Wide {
        let magnitude = Wide::from_integer(self.integer.unsigned_abs(), self.exponent);
        if self.integer < 0 { -magnitude } else { magnitude }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.integer == 0
    }

    /// The sum, if it has the bits of a term.
    #[cfg_attr(not(target_os = "none"), inline(always))]
    #[cfg_attr(target_os = "none", inline(never))]
    fn plus(self, other: Self) -> Option<Self> {
        let (high, low) =
            if self.exponent < other.exponent { (other, self) } else { (self, other) };
        let places = (high.exponent - low.exponent).unsigned_abs();
        let fits = |term: Self, places: u32| {
            u128::BITS - term.integer.unsigned_abs().leading_zeros() + places < Self::BITS
        };
        (fits(high, places) && fits(low, 0))
            .then(|| Self { integer: (high.integer << places) + low.integer, ..low })
    }

    /// Terms of the same sum, each added to the one before where that fits; the others are zero.
    #[inline(always)]
    pub(crate) fn combined<const N: usize>(terms: [Self; N]) -> [Self; N] {
        let mut sums = [Self::ZERO; N];
        let mut last = 0;
        for term in terms {
            if term.is_zero() {
                continue;
            }
            if sums[last].is_zero() {
                sums[last] = term;
            } else if let Some(sum) = sums[last].plus(term) {
                sums[last] = sum;
            } else {
                last += 1;
                sums[last] = term;
            }
        }
        sums
    }
}

impl Sum {
    pub(crate) const fn zero() -> Self {
        Self { digits: [0; DIGITS], used: Range { start: DIGITS, end: 0 } }
    }

    /// Adds `times` the product of two terms, which is to be in the range of products of four numbers. |`times`| is 1 or 2.
    #[inline]
    pub(crate) fn add(&mut self, times: i64, [a, b]: [Term; 2]) {
        if a.is_zero() || b.is_zero() {
            return;
        }
        let unit = a.exponent + b.exponent + i32::from(times.unsigned_abs() == 2);
        let place = (unit - LEAST).unsigned_abs();
        let (digit, shift) = ((place / 64) as usize, place % 64);
        // The product has at most 248 bits, and the shift moves that to five digits.
        let product = Product::new(a.integer.unsigned_abs(), b.integer.unsigned_abs());
        let parts = product.shifted(shift);
        let negative = (times < 0) ^ (a.integer < 0) ^ (b.integer < 0);
        for (digit, part) in self.digits.iter_mut().skip(digit).zip(parts) {
            let part = i128::from(part);
            *digit += if negative { -part } else { part };
        }
        self.used = self.used.start.min(digit)..self.used.end.max(digit + parts.len());
    }

    /// Adds a term, which is to be in the range of products of two numbers.
    pub(crate) fn add_term(&mut self, term: Term) {
        self.add(1, [term, Factor::ONE.into()]);
    }

    /// Carries, so that every digit is one of 64 bits, but for the last one, which has the sign of the sum.
    fn settle(&mut self) {
        // Room for what is carried from the last.
        let Range { start, end } = self.used;
        self.used = start..(end + 1).clamp(start, DIGITS);
        let Some((last, digits)) = self.digits[self.used.clone()].split_last_mut() else { return };
        let mut carry = 0;
        for digit in digits {
            carry += *digit;
            *digit = carry & i128::from(u64::MAX);
            carry >>= DIGIT;
        }
        *last += carry;
    }

    /// The sign: how the sum compares with 0.
    pub(crate) fn sign(&mut self) -> Ordering {
        self.settle();
        let used = &self.digits[self.used.clone()];
        match used.last() {
            Some(last) if *last < 0 => Ordering::Less,
            _ if used.iter().all(|digit| *digit == 0) => Ordering::Equal,
            _ => Ordering::Greater,
        }
    }

    /// The value, rounded to a pair with a relative error below 2⁻⁹⁶, and its exponent.
    pub(crate) fn value(&mut self) -> Wide {
        let sign = self.sign();
        let Some(lowest) = self.used.clone().find(|place| self.digits[*place] != 0) else {
            return Wide::ZERO;
        };
        // The digits of the magnitude: of a negative number's, the complement above the lowest one.
        let digit = |place: usize| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "64 bits")]
            let digit = self.digits[place] as u64;
            match (sign, place.cmp(&lowest)) {
                (Ordering::Less, Ordering::Greater) => !digit,
                (Ordering::Less, _) => digit.wrapping_neg(),
                _ => digit,
            }
        };
        let top = self.used.clone().rev().find(|place| digit(*place) != 0).unwrap_or(lowest);
        // Three digits, of which at least 129 bits count: 128 of them.
        let below = |places: usize| top.checked_sub(places).map_or(0, digit);
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
        if sign.is_lt() { -value } else { value }
    }
}
