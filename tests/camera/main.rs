//! The camera against exact arithmetic, against glam's matrices, and against what its documentation promises.

mod accuracy;
mod accuracy_of_pixels;
mod errors;
mod exact;
mod frame;
mod image;
mod limits;
mod matrices;
mod projection;
