//! Numbers of any exponent: a pair times a power of two.

use core::ops::{Div, Neg};

use super::pair::{Pair, two_sum};
use super::scaling::scale;

#[cfg(test)]
mod tests;

/// The first 106 of the 128 bits of an integer with its highest bit set, as a number in 1..2.
fn leading_pair(integer: u128) -> Pair {
    const HALF: u128 = (1 << 53) - 1;
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    let part = |bits: u128| (bits & HALF) as u64 as f64;
    two_sum(scale(part(integer >> 75), -52), scale(part(integer >> 22), -105))
}

/// A number of any exponent: `value` 2^`exponent`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScaledPair {
    value: Pair,
    exponent: i32,
}

impl ScaledPair {
    pub(crate) const ZERO: Self = Self { value: Pair { hi: 0.0, lo: 0.0 }, exponent: 0 };

    /// `magnitude` 2^`unit`, rounded to 106 bits.
    pub(crate) fn from_integer(magnitude: u128, unit: i32) -> Self {
        if magnitude == 0 {
            return Self::ZERO;
        }
        let zeros = magnitude.leading_zeros();
        #[expect(clippy::cast_possible_wrap, reason = "at most 127")]
        let exponent = unit + 127 - zeros as i32;
        Self { value: leading_pair(magnitude << zeros), exponent }
    }

    /// The same of an integer with a sign.
    pub(crate) fn from_signed(integer: i128, unit: i32) -> Self {
        let magnitude = Self::from_integer(integer.unsigned_abs(), unit);
        if integer < 0 { -magnitude } else { magnitude }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.value.hi == 0.0
    }

    /// The e of 2ᵉ ≤ |x| < 2ᵉ⁺¹, for a value x that is not zero.
    pub(crate) fn exponent(self) -> i32 {
        self.exponent
    }

    /// The number times 2ᵉ, as a pair: with e its own exponent negated, in the middle of the range.
    pub(crate) fn scaled(self, e: i32) -> Pair {
        let e = self.exponent.saturating_add(e);
        Pair { hi: scale(self.value.hi, e), lo: scale(self.value.lo, e) }
    }

    /// The number rounded to an `f64`, gradually below the normal ones.
    pub(crate) fn to_f64(self) -> f64 {
        scale(self.value.hi, self.exponent)
    }
}

impl Neg for ScaledPair {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Div for ScaledPair {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self { value: self.value / other.value, exponent: self.exponent - other.exponent }
    }
}
