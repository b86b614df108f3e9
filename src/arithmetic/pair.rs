//! Pairs: a number as the unevaluated sum of two `f64`, twice the precision.
//!
//! Dekker, *A Floating-Point Technique for Extending the Available Precision* (1971); for the error bounds, Joldes, Muller
//! and Popescu, *Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic* (2017).
//! Throughout, u = 2⁻⁵³ is the rounding error of an `f64` operation.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Triple;
use crate::float::sqrt;

/// The sum `hi + lo`, where `hi` is the sum rounded to an `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub hi: f64,
    pub lo: f64,
}

/// `a + b`, exactly (Knuth's two-sum).
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> Pair {
    let hi = a + b;
    let b_part = hi - a;
    let a_part = hi - b_part;
    Pair { hi, lo: (a - a_part) + (b - b_part) }
}

/// `a - b`, exactly.
#[inline(always)]
pub(crate) fn two_difference(a: f64, b: f64) -> Pair {
    two_sum(a, -b)
}

/// `a + b`, exactly, where |a| ≥ |b| or a = 0 (Dekker's fast two-sum).
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> Pair {
    let hi = a + b;
    Pair { hi, lo: b - (hi - a) }
}

/// `a b`, exactly, unless the error underflows.
///
/// Where the machine has a fused multiply-add, it gives the error at once; the bits are the same either way.
#[inline(always)]
pub(crate) fn two_product(a: f64, b: f64) -> Pair {
    let hi = a * b;
    #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
    let lo = a.mul_add(b, -hi);
    #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
    let lo = {
        let (a_high, a_low) = split(a);
        let (b_high, b_low) = split(b);
        ((a_high * b_high - hi) + a_high * b_low + a_low * b_high) + a_low * b_low
    };
    Pair { hi, lo }
}

/// `a` as the sum of two numbers of 26 bits, so that products of such parts are exact (Veltkamp's split).
#[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    /// 2²⁷ + 1.
    const SPLITTER: f64 = 134_217_729.0;
    let spread = SPLITTER * a;
    let high = spread - (spread - a);
    (high, a - high)
}

/// `a·b`, as `hi`, the dot product that plain arithmetic gives, and `lo`, very nearly its error: their sum is off by at most
/// 8 u² |a|·|b|.
///
/// Ogita, Rump and Oishi, *Accurate Sum and Dot Product* (2005).
#[inline(always)]
pub(crate) fn compensated_dot(a: Triple<f64>, b: Triple<f64>) -> Pair {
    let Triple { x, y, z } = a.zip(b, two_product);
    let xy = two_sum(x.hi, y.hi);
    let xyz = two_sum(xy.hi, z.hi);
    Pair { hi: xyz.hi, lo: (x.lo + y.lo) + (z.lo + (xy.lo + xyz.lo)) }
}

impl Pair {
    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// The square root of a positive pair: relative error at most 4 u².
    ///
    /// One step of Newton's from the square root of `hi`.
    pub(crate) fn sqrt(self) -> Self {
        let root = sqrt(self.hi);
        let square = two_product(root, root);
        let remainder = (self.hi - square.hi) - square.lo + self.lo;
        fast_two_sum(root, remainder / (2.0 * root))
    }
}

impl From<f64> for Pair {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Neg for Pair {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for Pair {
    type Output = Self;

    /// Error at most 4 u² (|a| + |b|).
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let sum = two_sum(self.hi, other.hi);
        fast_two_sum(sum.hi, sum.lo + (self.lo + other.lo))
    }
}

impl Sub for Pair {
    type Output = Self;

    /// Error at most 4 u² (|a| + |b|).
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Pair {
    type Output = Self;

    /// Relative error at most 5 u².
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        fast_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Pair {
    type Output = Self;

    /// Relative error at most 10 u².
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let product = two_product(quotient, other.hi);
        let remainder = ((self.hi - product.hi) - product.lo) + (self.lo - quotient * other.lo);
        fast_two_sum(quotient, remainder / other.hi)
    }
}
