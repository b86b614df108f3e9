//! From the image to the view plane: which u is at a column of pixels, and which v at a row.
//!
//! ```text
//!     u = left + (right - left) x / width      v = top + (bottom - top) y / height
//! ```
//!
//! Where a view rectangle reaches to both sides of the axis, the two terms cancel near it, and in plain `f64` what is left
//! has the error of terms that may be far longer than the ray's direction. So the length of a pixel is kept as a sum of
//! two `f64`, the first so short that its products with pixel coordinates are exact.

use crate::arithmetic::pair::two_difference;

/// One side of the image, and the side of the view rectangle that it shows.
///
/// [`at`](Self::at) is off by at most 2 h |u| + 2⁻⁷² (|left| + |right|) + 2⁻⁶⁰ of a pixel, with h = 2⁻⁵³, for
/// |x| < 2²⁴ and sides of fewer than 2²⁴ pixels, underflow aside:
///
/// - `step_high · x_high` has 21 + 32 bits: exact. (Beyond 2²⁴ pixels it is rounded, by h of itself.)
/// - The sum of that and the start is rounded by h of itself, and so is the sum of all.
/// - The rest is small, `step_low` being at most 2⁻²⁰ of a pixel and `x_low` 2⁻⁹: so is what it is rounded by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Where the view begins: u where x is 0.
    start: f64,
    /// A pixel, rounded towards zero to 21 bits.
    step_high: f64,
    /// What is missing of it there.
    step_low: f64,
}

impl Axis {
    /// The axis from `start` to `end`, divided into so many pixels; 0 counts as 1.
    #[inline]
    pub(super) fn new(start: f64, end: f64, pixels: u32) -> Self {
        /// All but the last 32 of a float's 52 bits after the first.
        const LEADING: u64 = u64::MAX << 32;
        let pixels = f64::from(pixels.max(1));
        let per_pixel = 1.0 / pixels;
        let length = two_difference(end, start);
        let step_high = f64::from_bits((length.hi * per_pixel).to_bits() & LEADING);
        // The product of 21 and 32 bits is exact, and near enough to the length that their difference is so too.
        let rest = (length.hi - step_high * pixels) + length.lo;
        Self { start, step_high, step_low: rest * per_pixel }
    }

    /// The u at `x` pixels from the start. Beyond the largest `f64`, that; of a NaN or an infinity, a NaN.
    #[inline]
    pub(super) fn at(&self, x: f64) -> f64 {
        /// Added and subtracted again, it rounds to a multiple of 2⁻⁸: 3 · 2⁴³.
        const ROUNDING: f64 = 26_388_279_066_624.0;
        let high = (x + ROUNDING) - ROUNDING;
        // A NaN where x is infinite.
        let low = x - high;
        let small = self.step_low * high + (self.step_high + self.step_low) * low;
        let u = (self.start + self.step_high * high) + small;
        // Infinity times a zero coordinate of the basis would be a NaN.
        u.clamp(f64::MIN, f64::MAX)
    }

    /// The same as [`at`](Self::at), at the center of one of the pixels: a multiple of 1/2, so that nothing is left for the low
    /// part, and between the ends, so that nothing overflows.
    ///
    /// For an axis that goes upwards. Of one that begins at -0 and goes downwards, a zero might have another sign.
    #[inline]
    pub(super) fn at_center(&self, x: f64) -> f64 {
        (self.start + self.step_high * x) + self.step_low * x
    }
}
