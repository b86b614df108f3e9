//! Rounding for sure, what is known within an error.
//!
//! Ziv, *Fast Evaluation of Elementary Mathematical Functions with Correctly Rounded Last Bit* (1991): where both ends of an
//! interval that holds the exact value round to the same number, that is the exact value correctly rounded. Where they round
//! to neighbors, the exact value has to be compared with the one number midway between them.

use core::cmp::Ordering;

use super::format::{Format, Midpoint};
use crate::arithmetic::pair::Pair;
use crate::arithmetic::rounding::RoundDown;

#[cfg(test)]
mod tests;

impl Format {
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
}
