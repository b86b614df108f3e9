//! What the target is: all switches between a machine with an operating system and a small one.

/// Whether the hardware computes `f64`, as it does wherever there is an operating system, more often than not.
pub(crate) const HAS_F64: bool = cfg!(not(target_os = "none"));

/// Whether code is downloaded before it runs, so that it should be short.
pub(crate) const IS_DOWNLOADED: bool = cfg!(target_family = "wasm");

/// Whether there are vectors of four numbers, so that four spheres take about as long as one.
pub(crate) const HAS_VECTORS: bool =
    cfg!(any(target_feature = "sse2", target_feature = "neon", target_feature = "simd128"));

/// A digit of a long integer, and what holds a product of two digits and two digits more.
#[cfg(target_pointer_width = "64")]
mod width {
    pub(crate) type Digit = u64;
    pub(crate) type Double = u128;
}
#[cfg(not(target_pointer_width = "64"))]
mod width {
    pub(crate) type Digit = u32;
    pub(crate) type Double = u64;
}
pub(crate) use width::{Digit, Double};

/// The result of `f`, where `is_small` by a call of one copy of its code.
#[inline(always)]
pub(crate) fn once_if<T>(is_small: bool, f: impl FnOnce() -> T) -> T {
    if is_small { called(f) } else { f() }
}

#[inline(never)]
fn called<T>(f: impl FnOnce() -> T) -> T {
    f()
}
