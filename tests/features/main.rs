//! Each optional feature, where it is enabled: `cargo test --all-features --test features`.

#[cfg(feature = "approx-05")]
mod approx;
#[cfg(feature = "bytemuck")]
mod bytemuck;
#[cfg(feature = "serde")]
mod serde;
