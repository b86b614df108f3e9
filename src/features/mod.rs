//! Implementations of other crates' traits, each behind a feature.

#[cfg(feature = "approx-05")]
mod approx;
#[cfg(feature = "bytemuck")]
mod bytemuck;
#[cfg(feature = "serde")]
mod serde;
