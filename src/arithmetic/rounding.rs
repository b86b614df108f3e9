//! Rounding: to the nearest `f32` where that is certain, and downwards.

#[cfg(test)]
mod tests;

/// One more than the largest value of the 29 bits of an `f64` that an `f32` has no room for.
const EXCESS: u32 = 1 << 29;
/// What lies halfway between two neighboring normal `f32`, within those bits.
const HALFWAY: u32 = EXCESS / 2;

/// Whether `t`, known to `MARGIN` units in its last place, is sure to round to the `f32` that the exact value rounds to.
/// Says nothing of a `t` below the normal `f32`.
#[inline(always)]
pub(crate) fn rounds_safely<const MARGIN: u32>(t: f64) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "only the lowest 29 bits are looked at")]
    let excess = t.to_bits() as u32 % EXCESS;
    excess.wrapping_sub(HALFWAY - MARGIN) > 2 * MARGIN
}

/// The next number below one that is not NaN nor negative infinity.
macro_rules! next_below {
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

/// A type of numbers, of which each has neighbors, and that an exact sum can be rounded down to.
pub trait RoundDown: Sized {
    /// An ulp of 1.
    const UNIT_ULP: f64;
    /// The smallest number above 0.
    const LEAST_POSITIVE: f64;

    /// The next number above one that is positive and finite.
    fn next_above(self) -> Self;

    /// The next number below one that is neither NaN nor negative infinity.
    fn next_below(self) -> Self;

    /// The largest number of this type that is no larger than `hi + lo`, where `hi` is that sum rounded; of one that
    /// overflows an `f64`, an infinity.
    fn round_down(hi: f64, lo: f64) -> Self;
}

impl RoundDown for f32 {
    const UNIT_ULP: f64 = f32::EPSILON as f64;
    const LEAST_POSITIVE: f64 = f32::from_bits(1) as f64;

    #[inline(always)]
    fn next_above(self) -> Self {
        Self::from_bits(self.to_bits().wrapping_add(1))
    }

    fn next_below(self) -> Self {
        next_below!(self)
    }

    #[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
    fn round_down(hi: f64, lo: f64) -> Self {
        let nearest = hi as f32;
        let excess = f64::from(nearest) - hi;
        if excess > 0.0 || (excess == 0.0 && lo < 0.0) { nearest.next_below() } else { nearest }
    }
}

impl RoundDown for f64 {
    const UNIT_ULP: f64 = f64::EPSILON;
    const LEAST_POSITIVE: f64 = f64::from_bits(1);

    #[inline(always)]
    fn next_above(self) -> Self {
        Self::from_bits(self.to_bits().wrapping_add(1))
    }

    fn next_below(self) -> Self {
        next_below!(self)
    }

    fn round_down(hi: f64, lo: f64) -> Self {
        if lo < 0.0 { hi.next_below() } else { hi }
    }
}
