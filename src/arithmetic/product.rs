//! Unsigned integers of 256 bits: products of two of 128.

use super::scaled_pair::ScaledPair;

#[cfg(test)]
mod tests;

/// An integer of 256 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Product {
    high: u128,
    low: u128,
}

impl Product {
    /// `a b`.
    #[inline]
    pub(crate) fn new(a: u128, b: u128) -> Self {
        const LOW: u128 = u64::MAX as u128;
        let (a_high, a_low) = (a >> 64, a & LOW);
        let (b_high, b_low) = (b >> 64, b & LOW);
        let low = a_low * b_low;
        // At most 2¹²⁸ - 2⁶⁵ + 1, and less than 2⁶⁴ more.
        let middle = a_high * b_low + (low >> 64);
        let other_middle = a_low * b_high + (middle & LOW);
        Self {
            high: a_high * b_high + (middle >> 64) + (other_middle >> 64),
            low: (other_middle << 64) | (low & LOW),
        }
    }

    /// The square of an integer.
    #[inline]
    pub(crate) fn square(a: i128) -> Self {
        Self::new(a.unsigned_abs(), a.unsigned_abs())
    }

    /// The sum, which must be below 2²⁵⁶.
    #[inline]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (low, carry) = self.low.overflowing_add(other.low);
        Self { high: self.high + other.high + u128::from(carry), low }
    }

    /// The difference from a number that is no larger.
    #[inline]
    pub(crate) fn minus(self, other: Self) -> Self {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        Self { high: self.high - other.high - u128::from(borrow), low }
    }

    /// The integer times 2^`unit`, rounded to 106 bits.
    pub(crate) fn to_scaled_pair(self, unit: i32) -> ScaledPair {
        let zeros = self.high.leading_zeros();
        if zeros == 128 {
            return ScaledPair::from_integer(self.low, unit);
        }
        // The first 128 bits.
        let leading = self.high << zeros | self.low.checked_shr(128 - zeros).unwrap_or(0);
        #[expect(clippy::cast_possible_wrap, reason = "at most 127")]
        ScaledPair::from_integer(leading, unit + 128 - zeros as i32)
    }
}
