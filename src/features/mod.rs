//! What other crates' traits have to say about the types of this one, each behind a feature.

#[cfg(feature = "approx-05")]
mod approx;
#[cfg(feature = "bytemuck")]
mod bytemuck;
#[cfg(feature = "serde")]
mod serde;
