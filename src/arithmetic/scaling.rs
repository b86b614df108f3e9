//! Powers of two: exact factors that bring numbers into the middle of the range, and back.

#[cfg(test)]
mod tests;

/// The exponent e of a finite nonzero `x`: 2ᵉ ≤ |x| < 2ᵉ⁺¹ (for a subnormal number, −1023). Of zero, −1023 too.
#[inline]
pub(crate) fn exponent(x: f64) -> i32 {
    let biased = (x.to_bits() >> 52) as i32 & 0x7ff;
    biased - 1023
}

/// A finite `f64` as an integer below 2⁵³ and the exponent of its unit.
#[inline]
pub(crate) fn integer_and_exponent(x: f64) -> (u64, i32) {
    const FRACTION: u64 = (1 << 52) - 1;
    let fraction = x.to_bits() & FRACTION;
    match exponent(x) {
        -1023 => (fraction, -1074),
        e => (fraction | (FRACTION + 1), e - 52),
    }
}

/// 2ᵉ for −1022 ≤ e ≤ 1023.
#[inline]
fn power_of_two(e: i32) -> f64 {
    f64::from_bits(u64::from((e + 1023).unsigned_abs()) << 52)
}

/// `x` 2ᵉ, rounded once: infinite beyond the largest finite number, subnormal or zero below the smallest normal one.
#[inline]
pub(crate) fn scale(x: f64, e: i32) -> f64 {
    if (-1022..=1023).contains(&e) { x * power_of_two(e) } else { scale_far(x, e) }
}

/// The same where 2ᵉ is no normal number.
#[cold]
#[inline(never)]
fn scale_far(mut x: f64, mut e: i32) -> f64 {
    // A step down leaves 53 bits to go, so that what it rounds among the subnormal numbers ends as zero anyway.
    const UP: i32 = 1023;
    const DOWN: i32 = -1022 + 53;
    for _ in 0..2 {
        if e > UP {
            x *= power_of_two(UP);
            e -= UP;
        } else if e < -1022 {
            x *= power_of_two(DOWN);
            e -= DOWN;
        }
    }
    x * power_of_two(e.clamp(-1022, UP))
}
