//! The format that roots and points are rounded to, and the numbers midway between two of its numbers.

use core::array;

use crate::arithmetic::pair::U;
use crate::arithmetic::scaling::integer_and_exponent;
use crate::target::{HAS_F64, IS_DOWNLOADED};

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
    pub(crate) fn midpoint(self, [low, high]: [f64; 2]) -> Midpoint {
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
