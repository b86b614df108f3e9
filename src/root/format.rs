//! The format that a root is rounded to, and rounding to it for sure.
//!
//! Ziv, *Fast Evaluation of Elementary Mathematical Functions with Correctly Rounded Last Bit* (1991): where both ends of an
//! interval that holds the exact value round to the same number, that is the exact value correctly rounded. Where they round
//! to neighbors, the exact value has to be compared with the one number midway between them.

use core::array;
use core::cmp::Ordering;

use crate::arithmetic::pair::{Pair, U};
use crate::arithmetic::rounding::RoundDown;
use crate::arithmetic::scaling::integer_and_exponent;
use crate::target::{HAS_F64, IS_DOWNLOADED};

#[cfg(test)]
mod tests;

/// A format of floating-point numbers, all of which are `f64` too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Format {
    F32,
    F64,
}

impl Format {
    /// Whether the steps between the first ones and the last are left out. The last step returns the same bits as these, so the
    /// results do not change: there is less code, and rare cases take longer.
    ///
    /// They are left out where `f64` is software, because there they are slower than integers, and for `f32` in WebAssembly,
    /// because code is downloaded there.
    pub(crate) const fn has_few_steps(self) -> bool {
        match self {
            Self::F32 => !HAS_F64 || IS_DOWNLOADED,
            Self::F64 => !HAS_F64,
        }
    }

    /// Rounds the exact value that `t` is known to be within `relative_error` of.
    ///
    /// `compare` says how the exact value compares with a number midway between two neighbors, and is asked only if the answer
    /// depends on it. `None` where it does not know, and where more than two neighbors are possible.
    #[inline]
    pub(crate) fn round(
        self,
        t: Pair,
        relative_error: f64,
        compare: impl FnOnce(Midpoint) -> Option<Ordering>,
    ) -> Option<f64> {
        // Nor where it is NaN.
        if relative_error.is_nan() || relative_error >= 0.25 {
            return None;
        }
        // The least is for what may underflow.
        let error = t.hi.abs() * relative_error + f64::MIN_POSITIVE;
        let [[low], [high]] = self.ends([t.hi], [t.lo], [error]);
        // In bits, because an interval around zero has two.
        if low.to_bits() == high.to_bits() {
            return Some(low);
        }
        self.nearer([low, high], compare)
    }

    /// Which of two neighbors an exact value between them is rounded to. `None` where they are not neighbors, and where `compare`
    /// does not know how the value compares with the number midway.
    #[inline]
    pub(crate) fn nearer(
        self,
        [low, high]: [f64; 2],
        compare: impl FnOnce(Midpoint) -> Option<Ordering>,
    ) -> Option<f64> {
        let (below, low_bits) = match self {
            Self::F32 => {
                #[expect(clippy::cast_possible_truncation, reason = "they are rounded already")]
                let [low, high] = [low as f32, high as f32];
                (f64::from(high.next_below()), u64::from(low.to_bits()))
            }
            Self::F64 => (high.next_below(), low.to_bits()),
        };
        if below != low {
            return None;
        }
        let low_is_even = low_bits % 2 == 0;
        Some(match compare(self.midpoint([low, high]))? {
            Ordering::Less => low,
            Ordering::Equal if low_is_even => low,
            _ => high,
        })
    }

    /// Rounds to the nearest number.
    #[inline]
    pub(crate) fn nearest(self, x: f64) -> f64 {
        #[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
        match self {
            Self::F32 => f64::from(x as f32),
            Self::F64 => x,
        }
    }

    /// Of each sum `hi + lo`, the ends of the interval around it that is known within `error`, rounded.
    #[inline(always)]
    pub(crate) fn ends<const N: usize>(
        self,
        hi: [f64; N],
        lo: [f64; N],
        error: [f64; N],
    ) -> [[f64; N]; 2] {
        match self {
            Self::F32 => {
                let sum: [f64; N] = array::from_fn(|i| hi[i] + lo[i]);
                // Half an ulp of an f64 for the sum, half for each end, and as much to spare.
                let error: [f64; N] = array::from_fn(|i| error[i] + sum[i].abs() * (4.0 * U));
                [
                    array::from_fn(|i| self.nearest(sum[i] - error[i])),
                    array::from_fn(|i| self.nearest(sum[i] + error[i])),
                ]
            }
            // Each end is rounded once to a number of the format; before that, by far less than the error.
            Self::F64 => [
                array::from_fn(|i| hi[i] + (lo[i] - error[i])),
                array::from_fn(|i| hi[i] + (lo[i] + error[i])),
            ],
        }
    }

    /// The least exponent of an ulp.
    pub(crate) const fn least_exponent(self) -> i32 {
        match self {
            Self::F32 => -149,
            Self::F64 => -1074,
        }
    }

    /// The bits of a mantissa.
    pub(crate) const fn digits(self) -> i32 {
        match self {
            Self::F32 => 24,
            Self::F64 => 53,
        }
    }

    /// The number midway between two neighbors. Infinity stands for the power of two that would come next.
    fn midpoint(self, [low, high]: [f64; 2]) -> Midpoint {
        let negative = high <= 0.0;
        // The one nearer to zero, as an integer times an ulp of the self.
        let (mantissa, exponent) = integer_and_exponent(if negative { high } else { low });
        let spare = 53 - self.digits();
        let ulp = (exponent + spare).max(self.least_exponent());
        let magnitude = mantissa.checked_shr((ulp - exponent).unsigned_abs()).unwrap_or(0);
        #[expect(clippy::cast_possible_wrap, reason = "54 bits")]
        let integer = (2 * magnitude + 1) as i64;
        Midpoint { integer: if negative { -integer } else { integer }, exponent: ulp - 1 }
    }
}

/// The number midway between two neighbors of a format: `integer` 2^`exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Midpoint {
    /// Odd, and of at most 54 bits.
    pub(crate) integer: i64,
    pub(crate) exponent: i32,
}
