//! The camera against exact arithmetic, against glam's matrices, and against what its documentation promises.

mod accuracy;
mod accuracy_of_pixels;
mod conventions;
#[path = "../support/dyadic.rs"]
#[allow(
    dead_code,
    unreachable_pub,
    reason = "shared by several tests, each of which takes what it needs"
)]
mod dyadic;
mod errors;
mod exact;
mod frame;
mod from_matrices;
mod image;
mod limits;
mod matrices;
mod projection;
mod tiles;
mod unprojection;
