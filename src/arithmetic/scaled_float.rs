//! Floats of any exponent: an `f64` times a power of two.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::comparison::is_zero;
use super::scaling::{exponent, scale};
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// `value` 2^`exponent`. Every operation rounds once, as those of `f64`.
///
/// The value is zero, or so far from the ends of the range that no operation of a few leaves it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScaledFloat {
    pub(crate) value: f64,
    pub(crate) exponent: i32,
}

impl ScaledFloat {
    /// The square root of a number that is not negative, and whose exponent is even.
    pub(crate) fn sqrt(self) -> Self {
        Self { value: sqrt(self.value), exponent: self.exponent / 2 }
    }

    /// The number times an `f64`.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, ..self }
    }

    /// Whether its magnitude is less than that of the other.
    pub(crate) fn is_less_than(self, other: Self) -> bool {
        let abs = |x: Self| Self { value: x.value.abs(), ..x };
        (abs(self) - abs(other)).value < 0.0
    }

    /// The e of 2ᵉ ≤ |x| < 2ᵉ⁺¹, for a number x that is not zero.
    pub(crate) fn leading_exponent(self) -> i32 {
        exponent(self.value) + self.exponent
    }
}

impl Neg for ScaledFloat {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Add for ScaledFloat {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let is_larger = self.exponent >= other.exponent;
        let (larger, smaller) = if is_larger { (self, other) } else { (other, self) };
        if is_zero(larger.value) {
            return smaller;
        }
        // Where that is below the normal numbers, it is next to nothing beside the larger.
        let below = scale(smaller.value, smaller.exponent - larger.exponent);
        Self { value: larger.value + below, ..larger }
    }
}

impl Sub for ScaledFloat {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for ScaledFloat {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, exponent: self.exponent + other.exponent }
    }
}

impl Div for ScaledFloat {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self { value: self.value / other.value, exponent: self.exponent - other.exponent }
    }
}
