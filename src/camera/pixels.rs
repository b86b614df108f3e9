//! From the image to the view plane: the u of a column of pixels, and the v of a row.
//!
//! ```text
//!     u = left + (right - left) x / width      v = top + (bottom - top) y / height
//! ```
//!
//! Where a view rectangle reaches to both sides of the axis, the two terms cancel near it, and in plain `f64` what is left
//! has the error of terms that may be far longer than the ray's direction. So the length of a pixel is kept as a sum of
//! three `f64`, the first two so short that their products with pixel coordinates are exact.

use crate::arithmetic::pair::two_difference;

/// One side of the image, and the side of the view rectangle that it shows.
///
/// With h = 2⁻⁵³, [`at`](Self::at) is off by at most 2 h |u| and 2⁻⁶⁰ of a pixel, for |x| < 2²⁴ and sides of up to 2²⁴ pixels,
/// underflow aside. At the center of a pixel, or wherever else x has 8 bits or fewer after the point, it is off by
/// 2 h |u| alone, so that zero is zero:
///
/// - The products of the first two steps with the high part of x have 21 + 32 bits: they are exact. (Beyond 2²⁴ pixels the first
///   is rounded, by h of itself.) The third step is at most 2⁻⁴⁰ of a pixel, and so is exact enough.
/// - The sum of the first product and the start is rounded by h of itself, and so is the sum of all. What is between is 2⁻²⁰ of
///   the first product, and where that and the start cancel to as little, their sum is exact.
/// - The low part of x is at most 2⁻⁹, and its product with a pixel is rounded twice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Where the view begins: u where x is 0.
    start: f64,
    /// A pixel: to 21 bits, 21 more, and the rest.
    steps: [f64; 3],
}

impl Axis {
    /// The axis from `start` to `end`, divided into so many pixels; 0 counts as 1.
    #[inline]
    pub(super) fn new(start: f64, end: f64, pixels: u32) -> Self {
        let pixels = f64::from(pixels.max(1));
        let per_pixel = 1.0 / pixels;
        let length = two_difference(end, start);
        // Products of 21 and 32 bits are exact, and so near to what they are subtracted from that the differences are so too.
        let first = leading_bits(length.hi * per_pixel);
        let rest = (length.hi - first * pixels) + length.lo;
        let second = leading_bits(rest * per_pixel);
        let rest = rest - second * pixels;
        Self { start, steps: [first, second, rest * per_pixel] }
    }

    /// The u at `x` pixels from the start, at most the largest `f64`; NaN if x is NaN or infinite.
    #[inline]
    pub(super) fn at(&self, x: f64) -> f64 {
        /// Added and subtracted again, it rounds to a multiple of 2⁻⁸: 3 · 2⁴³.
        const ROUNDING: f64 = 26_388_279_066_624.0;
        let high = (x + ROUNDING) - ROUNDING;
        // A NaN where x is infinite.
        let low = x - high;
        let [first, second, third] = self.steps;
        let small = second * high + third * high + (first + second + third) * low;
        let leading = self.start + first * high;
        if leading.is_infinite() && x.is_finite() {
            // The other products may have overflowed the other way.
            return f64::MAX.copysign(leading);
        }
        let u = leading + small;
        // Infinity times a zero coordinate of the basis would be a NaN.
        u.clamp(f64::MIN, f64::MAX)
    }

    /// The same as [`at`](Self::at), at the center of one of the pixels: a multiple of 1/2, so that nothing is left for the low
    /// part, and between the ends, so that nothing overflows.
    ///
    /// For an axis along which u grows: on one that begins at -0 and goes down, a zero could have the other sign.
    #[inline]
    pub(super) fn at_center(&self, x: f64) -> f64 {
        let [first, second, third] = self.steps;
        (self.start + first * x) + (second * x + third * x)
    }
}

/// The number rounded towards zero to 21 bits.
#[inline]
fn leading_bits(x: f64) -> f64 {
    /// All but the last 32 of the 52 bits after the first.
    const LEADING: u64 = u64::MAX << 32;
    f64::from_bits(x.to_bits() & LEADING)
}
