//! The functions of floating point that `core` lacks, from the standard library or from the libm crate.

/// The square root, correctly rounded: the same bits whichever library gives it.
#[inline(always)]
pub(crate) fn sqrt(value: f64) -> f64 {
    #[cfg(feature = "std")]
    return value.sqrt();
    #[cfg(not(feature = "std"))]
    return libm::sqrt(value);
}

/// The square root of an `f32`, correctly rounded, which the compiler can take of a vector.
#[cfg(feature = "alloc")]
#[inline(always)]
pub(crate) fn sqrt_f32(value: f32) -> f32 {
    #[cfg(feature = "std")]
    return value.sqrt();
    #[cfg(not(feature = "std"))]
    return libm::sqrtf(value);
}

/// The tangent. Platforms differ in its last bit, the libm crate does not: where that is enabled, it is the one used.
#[inline(always)]
pub(crate) fn tan(value: f64) -> f64 {
    #[cfg(feature = "libm")]
    return libm::tan(value);
    #[cfg(not(feature = "libm"))]
    return value.tan();
}
