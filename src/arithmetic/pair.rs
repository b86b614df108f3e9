//! Pairs: a number as the unevaluated sum of two `f64`, twice the precision.
//!
//! Dekker, *A Floating-Point Technique for Extending the Available Precision* (1971); for the error bounds, Joldes, Muller
//! and Popescu, *Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic* (2017).
//! Throughout, u = 2⁻⁵³ is the rounding error of an `f64` operation.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::number::{Number, Triple};
use crate::float::sqrt;

#[cfg(test)]
mod tests;

/// u = 2⁻⁵³, the rounding error of an `f64` operation.
pub(crate) const U: f64 = f64::EPSILON / 2.0;

/// 2⁻⁹⁰⁰: far enough above the subnormal numbers for a product to be a pair, and for a pair to be whole.
pub(crate) const LEAST_PAIR: f64 = f64::from_bits((1023 - 900) << 52);

/// v = u² = 2⁻¹⁰⁶.
pub(crate) const V: f64 = U * U;
/// Of a sum or a difference of pairs, in |a| + |b|.
///
/// To first order: the sum of the low parts, each at most u of its number, is rounded by v (|a| + |b|), and with the low part
/// of the sum of the high parts, at most u |a + b| more, by 2 v (|a| + |b|). That makes 3; the fourth is to spare.
#[cfg(test)]
pub(crate) const SUM_ERROR: f64 = 4.0 * V;
/// Of a product of pairs, in |a b|: Joldes, Muller and Popescu's algorithm 10, for which they prove 5.
#[cfg(test)]
pub(crate) const PRODUCT_ERROR: f64 = 5.0 * V;
/// Of a quotient of pairs, in |a / b|.
///
/// To first order, and where it is largest, with the high parts and the quotient just above 1: the remainder of the high parts
/// is exact and at most u; the product of the quotient and the low part of b is rounded by v, its difference from the low part
/// of a by 2 v, and the sum of both, at most 3 u, by 2 v; the division of that by 2 v, and by the high part of b instead of all
/// of b, 3 v.
#[cfg(test)]
pub(crate) const QUOTIENT_ERROR: f64 = 10.0 * V;
/// Of the square root of a pair, in itself.
///
/// To first order, and where it is largest, with a number just above 1: the remainder, at most 3 u, is rounded by 2 v, which
/// counts half; its quotient, 3/2 u, by v; and Newton's step leaves half the square of that, 9/8 v. That makes 25/8.
#[cfg(test)]
pub(crate) const ROOT_ERROR: f64 = 4.0 * V;
/// Of a compensated dot product, in the sum of the |aᵢ bᵢ|.
///
/// To first order: the errors of products are at most u of them, those of the two sums u of the whole each, and the four
/// additions of these are rounded by at most 1, 2, 2 and 3 v of the whole, in the order in which they are carried out here.
#[cfg(test)]
pub(crate) const COMPENSATED_DOT_ERROR: f64 = 8.0 * V;

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

/// `a + b`, exactly, where |a| ≥ |b|, or a is a multiple of the last place of b (Dekker's fast two-sum).
///
/// For the second, let g be that place and |a| < |b| < 2⁵³ g. Then a + b is a multiple of g below 2⁵⁴ g, which rounding moves by
/// at most g. So `hi` - a is a multiple of g of at most 2⁵³ g, and exact, and so is what is left of b.
#[inline(always)]
pub(crate) fn fast_two_sum(a: f64, b: f64) -> Pair {
    let hi = a + b;
    Pair { hi, lo: b - (hi - a) }
}

/// `a b`, exactly, unless the error underflows, below 2⁻¹⁰⁷⁴, or a factor is 2⁹⁹⁶ or more.
///
/// Where the machine has a fused multiply-add, it gives the error at once; the bits are the same either way, unless it
/// underflows.
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
/// `COMPENSATED_DOT_ERROR`.
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
    /// The product with a number, very nearly.
    ///
    /// Where the low part may have underflowed, it is left out: what is left of it depends on whether the machine has a fused
    /// multiply-add.
    #[inline(always)]
    pub(crate) fn times(self, factor: f64) -> Self {
        let product = two_product(self.hi, factor);
        let low = if product.hi.abs() < LEAST_PAIR { 0.0 } else { product.lo };
        Self { hi: product.hi, lo: low + self.lo * factor }
    }

    /// The square root of a positive pair: relative error at most `ROOT_ERROR`.
    ///
    /// One step of Newton's from the square root of `hi`.
    pub(crate) fn sqrt(self) -> Self {
        let root = sqrt(self.hi);
        let square = two_product(root, root);
        let remainder = (self.hi - square.hi) - square.lo + self.lo;
        fast_two_sum(root, remainder / (2.0 * root))
    }
}

impl Number for Pair {
    const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    fn to_f64(self) -> f64 {
        self.hi
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

    /// Error at most `SUM_ERROR`.
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // Where this is smaller than the low parts, one number is within twice the other, and the sum a multiple of its last
        // place.
        let sum = two_sum(self.hi, other.hi);
        fast_two_sum(sum.hi, sum.lo + (self.lo + other.lo))
    }
}

impl Sub for Pair {
    type Output = Self;

    /// Error at most `SUM_ERROR`.
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Pair {
    type Output = Self;

    /// Relative error at most `PRODUCT_ERROR`.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        fast_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Pair {
    type Output = Self;

    /// Relative error at most `QUOTIENT_ERROR`.
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let product = two_product(quotient, other.hi);
        let remainder = ((self.hi - product.hi) - product.lo) + (self.lo - quotient * other.lo);
        fast_two_sum(quotient, remainder / other.hi)
    }
}
