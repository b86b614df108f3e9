//! Numbers of 53 bits as sums of a part of 26 bits and the rest, so that products and sums of first parts are exact.

use glam::DVec3;

#[cfg(test)]
mod tests;

/// A vector as the sum of two, exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halves {
    pub(crate) high: DVec3,
    pub(crate) low: DVec3,
}

impl Halves {
    #[inline(always)]
    pub(crate) fn new(vector: DVec3, splitter: f64) -> Self {
        let high = (vector + splitter) - splitter;
        Self { high, low: vector - high }
    }
}

/// A number as the sum of two, exactly.
#[derive(Clone, Copy)]
pub(crate) struct Half {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl Half {
    #[inline(always)]
    pub(crate) fn new(number: f64, splitter: f64) -> Self {
        let high = (number + splitter) - splitter;
        Self { high, low: number - high }
    }
}

/// The number that, added to what has that square and subtracted again, leaves 26 bits of it: 3/2 2²⁶ times a power of two that
/// is no less than the root of the square.
#[inline(always)]
pub(crate) fn splitter(square: f64) -> f64 {
    // The exponent of the power of two is half of that of the square, rounded up.
    const ROUND_UP: u64 = 1077 << 52;
    const HALF: u64 = 1 << 51;
    f64::from_bits((square.to_bits() + ROUND_UP) >> 53 << 52 | HALF)
}
