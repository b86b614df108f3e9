//! The camera against exact arithmetic, against glam's matrices, and against what its documentation promises.

mod accuracy;
mod errors;
mod exact;
mod image;
mod matrices;
mod pixels;
mod projection;
