//! The camera against exact arithmetic, against glam's matrices, and against what its documentation promises.

mod accuracy;
mod errors;
mod exact;
mod frame;
mod image;
mod limits;
mod matrices;
mod pixels;
mod projection;
