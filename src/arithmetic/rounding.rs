//! Rounding: to the nearest `f32` for sure, and downwards.
//!
//! Ziv, *Fast Evaluation of Elementary Mathematical Functions with Correctly Rounded Last Bit* (1991): if both ends of an
//! interval that holds the exact value round to the same `f32`, that is the exact value correctly rounded.

use core::cmp::Ordering;

#[cfg(test)]
mod tests;

/// One more than the largest value of the 29 bits of an `f64` that an `f32` has no room for.
const EXCESS: u32 = 1 << 29;
/// What lies halfway between two neighboring normal `f32`, within those bits.
const HALFWAY: u32 = EXCESS / 2;

/// 2¹²⁸.
const POWER_PAST_MAX: f64 = 2.0 * f64::from_bits((1023 + 127) << 52);

/// Whether `t`, known to `MARGIN` units in its last place, is sure to round to the `f32` that the exact value rounds to.
/// Says nothing of a `t` below the normal `f32`.
#[inline(always)]
pub(crate) fn rounds_safely<const MARGIN: u32>(t: f64) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "only the lowest 29 bits are looked at")]
    let excess = t.to_bits() as u32 % EXCESS;
    excess.wrapping_sub(HALFWAY - MARGIN) > 2 * MARGIN
}

/// The ends of the interval of that relative error around `t`, each rounded.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
#[inline(always)]
fn rounded_ends(t: f64, relative_error: f64) -> [f32; 2] {
    let error = t.abs() * relative_error;
    [(t - error) as f32, (t + error) as f32]
}

/// The exact value that `t` is known to be within `relative_error` of, besides the rounding of `t` itself, rounded to `f32`;
/// or `None` where that cannot be told.
pub(crate) fn round_to_f32(t: f64, relative_error: f64) -> Option<f32> {
    // With half an ulp for t, and half for each end.
    let [low, high] = rounded_ends(t, relative_error + f64::EPSILON);
    // In bits, because an interval around zero has two.
    (low.to_bits() == high.to_bits()).then_some(low)
}

/// The exact value that `t` is known to be nearly equal to, rounded to `f32`: `compare` says how the exact value compares with
/// a number.
pub(crate) fn round_to_f32_exactly(t: f64, compare: impl FnOnce(f64) -> Ordering) -> f32 {
    let [low, high] = rounded_ends(t, 2.0 * f64::EPSILON);
    if low == high {
        return low;
    }
    // Beyond the largest number stands, for rounding, the power of two that would come next.
    let stand_in = |end: f32| {
        if end.is_finite() { f64::from(end) } else { f64::from(end.signum()) * POWER_PAST_MAX }
    };
    let midpoint = f64::midpoint(stand_in(low), stand_in(high));
    let low_is_even = low.to_bits() % 2 == 0;
    match compare(midpoint) {
        Ordering::Less => low,
        Ordering::Equal if low_is_even => low,
        _ => high,
    }
}

/// The next number below a finite one.
macro_rules! next_down {
    ($x:expr) => {
        if $x > 0.0 {
            Self::from_bits($x.to_bits() - 1)
        } else if $x < 0.0 {
            Self::from_bits($x.to_bits() + 1)
        } else {
            -Self::from_bits(1)
        }
    };
}

/// A type of numbers that an exact sum can be rounded down to.
pub trait RoundDown: Sized {
    /// The largest number of this type that is no larger than `hi + lo`, where `hi` is that sum rounded; of one that
    /// overflows an `f64`, an infinity.
    fn round_down(hi: f64, lo: f64) -> Self;
}

impl RoundDown for f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
    fn round_down(hi: f64, lo: f64) -> Self {
        let nearest = hi as f32;
        let excess = f64::from(nearest) - hi;
        if excess > 0.0 || (excess == 0.0 && lo < 0.0) { next_down!(nearest) } else { nearest }
    }
}

impl RoundDown for f64 {
    fn round_down(hi: f64, lo: f64) -> Self {
        if lo < 0.0 { next_down!(hi) } else { hi }
    }
}
