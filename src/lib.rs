//! Eye rays and spheres.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "eyeray takes square roots: enable its feature `std` (the default), or `libm` where there is no standard library"
);

#[cfg(feature = "alloc")]
extern crate alloc;

mod algebraic;
mod arithmetic;
mod basis;
mod camera;
mod camera_error;
mod chord;
mod double;
mod first_try;
mod float;
mod geometric;
mod hit;
mod hittable;
mod precision;
mod ray;
mod refine;
mod second_try;
mod single;
mod sphere;
mod vector;
mod view_rect;

pub use algebraic::Algebraic;
pub use camera::{Camera, Rays};
pub use camera_error::CameraError;
pub use geometric::Geometric;
pub use hit::Hit;
pub use hittable::{Hittable, nearest};
pub use ray::Ray;
pub use sphere::Sphere;
pub use vector::{Scalar, Vector};
pub use view_rect::ViewRect;
