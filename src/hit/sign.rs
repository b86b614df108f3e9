//! The sign of a dot product, exactly.

use glam::DVec3;

use crate::arithmetic::pair::{Pair, U, two_product, two_sum};
use crate::arithmetic::scaling::{self, integer_and_exponent, scale};

#[cfg(test)]
mod tests;

/// Of a dot product in `f64`, in the sum of its products' absolute values: the products and the two sums are rounded, 3 u. The
/// fourth is for the rounding of that sum, and for all of the second order.
const ERROR: f64 = 4.0 * U;

/// More than what underflows in three products.
const LEAST: f64 = f64::MIN_POSITIVE;

/// A number with the sign of a·b: zero if and only if that is zero, NaN where `a` or `b` has a NaN.
///
/// Where `a` or `b` has an infinity, it may be NaN, too.
#[inline(always)]
pub(super) fn of_dot(a: DVec3, b: DVec3) -> f64 {
    let products = a * b;
    let dot = products.element_sum();
    let size = products.abs().element_sum();
    // Neither where the size is infinite nor where one of them is NaN.
    if dot.abs() > ERROR * size + LEAST { dot } else { exactly((a.x, b.x), (a.y, b.y), (a.z, b.z)) }
}

/// By how many places a product is taken to be below the largest one at most: a smaller product is made larger. The sign stays
/// the same. Where the other two products cancel entirely, that product's sign is the sum's, however small it is. Otherwise the
/// other two leave at least 2⁻¹⁰⁷ of the largest, beside which it is next to nothing.
const FARTHEST: i32 = 400;

/// The same where the sum cancels, or where a product is beyond the range or next to its end: of the factors of each product,
/// which come in registers, so that the vectors need not be in memory.
#[cold]
#[inline(never)]
fn exactly(x: (f64, f64), y: (f64, f64), z: (f64, f64)) -> f64 {
    let factors = [x, y, z];
    if !factors.iter().all(|(a, b)| a.is_finite() && b.is_finite()) {
        return x.0 * x.1 + y.0 * y.1 + z.0 * z.1;
    }
    let products = factors.map(ExactProduct::new);
    let Some(largest) = products.iter().flatten().map(|product| product.exponent).max() else {
        return 0.0;
    };
    let mut expansion = [0.0; 6];
    let mut length = 0;
    for ExactProduct { integer, exponent } in products.into_iter().flatten() {
        // From its own exponent to that below the largest.
        let places = -scaling::exponent(integer.hi) - (largest - exponent).min(FARTHEST);
        for part in [integer.lo, integer.hi] {
            // Shewchuk's grow-expansion: the components do not overlap and ascend, so that the last that is not zero has the
            // sign of their sum.
            let mut sum = scale(part, places);
            for component in &mut expansion[..length] {
                let pair = two_sum(sum, *component);
                (sum, *component) = (pair.hi, pair.lo);
            }
            expansion[length] = sum;
            length += 1;
        }
    }
    expansion.into_iter().rev().find(|component| *component != 0.0).unwrap_or(0.0)
}

/// A product that is not zero, in units of a power of two.
struct ExactProduct {
    /// An integer of 106 bits.
    integer: Pair,
    /// The e of 2ᵉ ≤ |x| < 2ᵉ⁺¹, for the product x itself, but for rounding.
    exponent: i32,
}

impl ExactProduct {
    fn new((x, y): (f64, f64)) -> Option<Self> {
        let ((x, x_unit), (y, y_unit)) = (integer(x), integer(y));
        let integer = two_product(x, y);
        let exponent = x_unit + y_unit + scaling::exponent(integer.hi);
        (integer.hi != 0.0).then_some(Self { integer, exponent })
    }
}

/// A finite number as an integer of 53 bits and the exponent of its unit.
fn integer(x: f64) -> (f64, i32) {
    let (magnitude, unit) = integer_and_exponent(x);
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    let integer = (magnitude as f64).copysign(x);
    (integer, unit)
}
