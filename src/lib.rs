//! The first step of every ray tracer: make the eye ray, meet the sphere.
//!
//! The distance to a sphere that this library returns is the exact root, rounded once to the nearest `f32` (in `f64`, within
//! 1 ulp of it). Whether a ray hits or misses is never wrong. Both are promised for all finite inputs, on every machine, at
//! little more than the price of the textbook's formula; [`Sphere`] states the contract in full.
//!
//! ```
//! use eyeray::{Camera, Hittable, Sphere};
//! use glam::{Vec3, vec2, vec3};
//!
//! # fn main() -> Result<(), eyeray::CameraError> {
//! // A camera at z = 5 that looks at the world's origin, 90 degrees high, twice as wide.
//! let (eye, target) = (vec3(0.0, 0.0, 5.0), Vec3::ZERO);
//! let camera = Camera::perspective_fov(eye, target, Vec3::Y, f32::to_radians(90.0), 2.0)?;
//!
//! // The eye ray through the middle of an image of 640 by 320 pixels.
//! let ray = camera.pixel_ray(vec2(320.0, 160.0), 640, 320);
//!
//! // Any t > 0 along it, in lengths of its direction.
//! let sphere = Sphere::new(Vec3::ZERO, 1.0);
//! let hit = sphere.intersect(&ray, 0.0..f32::INFINITY);
//! assert_eq!(hit.map(|hit| (hit.t, hit.normal)), Some((4.0, Vec3::Z)));
//! # Ok(())
//! # }
//! ```
//!
//! # What is here
//!
//! - A [`Frame`] says where a camera stands and which way it is turned. A [`Camera`], orthographic or perspective, makes [`Ray`]s
//!   from pixels or from points of its [`ViewRect`], and projects points of the scene back to them.
//! - [`Sphere`] is met by either of two derivations, [`Algebraic`] and [`Geometric`], which agree bit for bit in `f32`.
//! - [`Hittable`] is what a ray can meet; a [`Hit`] has the distance, the point and the normal, and
//!   [spawns](Hit::spawn) rays that leave the surface for good.
//! - [`nearest`] says which of many objects is met first. `Spheres` does so for few or changing spheres sooner, and `SphereBvh`
//!   for up to millions.
//!
//! All of it is for glam's vectors, [`Vec3`](glam::Vec3) by default and [`DVec3`](glam::DVec3) for twice the precision: see
//! [`Vector`]. `From` takes rays, spheres, hits and cameras to `f64` exactly, and `to_f32` rounds the plain data back. It is any
//! glam from 0.33.11 to the last 0.34, and exported again as [`glam`]: the README tells how to have one glam in the tree.
//!
//! The formulas are those of S. Marschner's CS4620 lecture 6, *Ray Tracing Basics*, generalized to any center, radius and
//! length of direction. There are no materials, no triangles, no colors and no acceleration structures but that of spheres here.
//!
//! # Features
//!
//! - `std`, the default: square roots from the hardware, and `alloc`.
//! - `libm`: for `no_std`, square roots from the [libm](https://docs.rs/libm) crate. One of `std` and `libm` is needed.
//!   On a Cortex-M4F, optimized for size, [`Sphere`]'s `intersect` takes 47 kB of code in `f32` and 60 kB in both precisions beyond
//!   the textbook's formula, with the `f64` arithmetic that its hardware lacks. A hit takes some 45 times the formula's
//!   instructions there, 70 times from 1,000 radii away; a miss through [`nearest`] 2.3 times (`tests/targets/run`).
//! - `alloc`: `Spheres` and `SphereBvh`, and [`Hittable`] for `Vec`, `Box`, `Rc` and `Arc`. Implied by `std`.
//! - `serde`: `Serialize` and `Deserialize` for all data types. A [`Camera`] is checked again when it is deserialized; bit for bit it
//!   is read by a format that reads each `f64` so: of `serde_json`, that takes the feature `float_roundtrip`.
//! - `bytemuck`: `Pod` and `Zeroable` for [`Ray`] and [`Sphere`], to hand them to a GPU as bytes.
//! - `approx-05`: `AbsDiffEq`, `RelativeEq` and `UlpsEq` of approx 0.5, named as glam names its own.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(not(any(test, feature = "std")), no_std)]
#![cfg_attr(
    not(any(feature = "bytemuck", all(feature = "std", target_arch = "x86_64"))),
    forbid(unsafe_code)
)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "eyeray takes square roots: enable its feature `std` (the default), or `libm` where there is no standard library"
);

#[cfg(feature = "alloc")]
extern crate alloc;
// The families of cases, which the unit tests share with the other tests, call the crate by its name.
#[cfg(test)]
extern crate self as eyeray;

mod algebraic;
mod arithmetic;
mod camera;
mod convert;
mod features;
mod float;
mod geometric;
mod hit;
mod hittable;
mod ray;
mod rejection;
mod root;
mod sphere;
#[cfg(feature = "alloc")]
mod spheres;
#[cfg(test)]
mod testing;
mod vector;

/// The glam whose vectors this crate is compiled with.
pub use glam;

pub use algebraic::Algebraic;
pub use camera::{Camera, CameraArgument, CameraError, Frame, Rays, ViewRect};
pub use geometric::Geometric;
pub use hit::Hit;
pub use hittable::{Hittable, nearest};
pub use ray::Ray;
pub use sphere::Sphere;
#[cfg(feature = "alloc")]
pub use spheres::{SphereBvh, Spheres};
pub use vector::{Scalar, Vector};

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
