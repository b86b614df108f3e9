//! Comparisons of magnitudes on their bits: without multiplications, and without comparing floats, either of which takes many
//! instructions where `f64` is computed in software.
//!
//! As an integer, the bits of a positive number are 2⁵² times its logarithm to the base 2 and a constant, with straight lines
//! between the powers of two (Mitchell, *Computer Multiplication and Division Using Binary Logarithms*, 1962): of (1 + x) 2ᵉ, e +
//! x. That of a product is no less than the sum of those of its factors: with x and y, it is above the sum by x y where that
//! makes less than 2, and else by (1 - x) (1 - y) / 2.

#[cfg(test)]
mod tests;

/// The bits as an integer that has the sign of `x`.
#[inline(always)]
#[expect(clippy::cast_possible_wrap, reason = "a sign for a sign")]
const fn bits(x: f64) -> i64 {
    x.to_bits() as i64
}

/// What is added to the bits by a multiplication by that power of two.
const fn step(power_of_two: f64) -> i64 {
    bits(power_of_two) - bits(1.0)
}

/// Whether `x` is zero or has a minus sign.
#[inline(always)]
pub(crate) fn is_not_positive(x: f64) -> bool {
    bits(x) <= 0
}

/// Whether x > `part` y, for a power of two `part` and a y ≥ 0 such that neither y nor `part` y is subnormal.
///
/// Where y is zero, it says so of a zero, too. Where x or y is NaN, it may say either.
#[inline(always)]
pub(crate) fn exceeds(x: f64, part: f64, y: f64) -> bool {
    bits(x) > bits(y).wrapping_add(step(part))
}

/// Whether it is certain that x y > `part` z, for x and y above zero, and `part` and z as `part` and y in [`exceeds`].
///
/// It is certain where x y > 9/8 `part` z. Where one of them is infinite or NaN, it may say either.
#[inline(always)]
pub(crate) fn product_exceeds([x, y]: [f64; 2], part: f64, z: f64) -> bool {
    bits(x).wrapping_add(bits(y) - bits(1.0)) > bits(z).wrapping_add(step(part))
}

/// Whether a number is zero.
#[inline(always)]
pub(crate) fn is_zero(x: f64) -> bool {
    x.to_bits() << 1 == 0
}
