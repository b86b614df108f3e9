//! Eye rays, cameras and ray-sphere intersection, on glam's vectors.
//!
//! Whether a ray hits a sphere is decided exactly, and the distance is correctly rounded: it is the `f32` or `f64` nearest to the
//! exact root, for all finite inputs and on every machine. [`Sphere`] states the contract in full.
//!
//! ```
//! use eyeray::{Camera, Hittable, Sphere};
//! use glam::{Vec3, vec2, vec3};
//!
//! # fn main() -> Result<(), eyeray::CameraError> {
//! // At (0, 0, 5), looking at the origin.
//! let (eye, target, up) = (vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y);
//! let (vertical_field_of_view, aspect_ratio) = (f32::to_radians(90.0), 2.0);
//! let camera = Camera::perspective_fov(eye, target, up, vertical_field_of_view, aspect_ratio)?;
//!
//! // The eye ray through the middle of an image of 640 by 320 pixels.
//! let ray = camera.pixel_ray(vec2(320.0, 160.0), 640, 320);
//!
//! // The nearest hit. Distances count in lengths of the ray's direction.
//! let sphere = Sphere::new(Vec3::ZERO, 1.0);
//! let hit = sphere.intersect(&ray, 0.0..f32::INFINITY);
//! assert_eq!(hit.map(|hit| (hit.t, hit.normal)), Some((4.0, Vec3::Z)));
//! # Ok(())
//! # }
//! ```
//!
#![doc = include_str!("diagrams/render.html")]
//!
//! The picture is made by `cargo run --release --example render`.
//!
//! # What is here
//!
//! - [`Ray`]: an origin and a direction.
//! - [`Camera`]: an orthographic or perspective camera. It creates the eye ray of a pixel ([`pixel_ray`](Camera::pixel_ray)), for
//!   rendering or for picking with the mouse, or of all pixels ([`rays`](Camera::rays)), and finds the pixel of a point
//!   ([`project_to_pixel`](Camera::project_to_pixel)), for labels.
//! - [`Frame`] and [`ViewRect`]: the position and orientation of a camera, and the part of its view plane that the image shows.
//! - [`Sphere`]: a center and a radius. Its roots can be found by the quadratic formula ([`Algebraic`]) or by the closest
//!   approach ([`Geometric`]); both give the same bits.
//! - [`Hittable`]: the trait of everything that a ray can hit, with the nearest hit ([`intersect`](Hittable::intersect)) and
//!   occlusion ([`occludes`](Hittable::occludes)), for shadow rays and lines of sight.
//! - [`Hit`]: the distance, the point and the normal. [`spawn`](Hit::spawn) creates the reflected, refracted and shadow rays,
//!   which do not hit the surface that they leave.
//! - [`nearest`]: which of many objects a ray hits first, and where. For spheres, [`Spheres`] and [`SphereBvh`] return the same
//!   bits in less time. [`Nearest`] is the trait of all that can be asked this.
//!
//! | scene | use |
//! |:--|:--|
//! | one sphere, shapes of your own | [`Sphere`], [`Hittable`], and [`nearest`] on a slice |
//! | up to some hundred spheres, or few rays between changes | [`Spheres`] |
//! | more spheres | [`SphereBvh`], whose `update` moves them |
//!
//! All are for both precisions.
//!
//! # Precision
//!
//! The types are generic over glam's vectors: [`Vec3`](glam::Vec3), the default, or [`DVec3`](glam::DVec3). See [`Vector`].
//! `From` converts rays, spheres, hits, frames and cameras to `f64`, exactly. `to_f32` rounds rays, spheres and view rectangles
//! to `f32`.
//!
//! `f32` is enough for most pictures, because distances and points are correctly rounded. `f64` is for scenes whose coordinates
//! need more than 24 bits, such as meters on a planet, and for narrow fields of view: where a pixel is narrower than the last
//! digit of an `f32` direction, 2⁻²⁴ radians or a hundredth of an arc second, the rays of neighboring pixels are the same.
//!
//! Any version of glam from 0.33.11 to the last 0.34 will do. `eyeray::glam` is the one that this crate was compiled with; the
//! README says how to have only one version in a program.
//!
//! # Source
//!
//! The formulas are those of S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*, generalized to any center, radius and length
//! of direction. Where the documentation of an item says "the lecture", it means this one. Materials, triangles, colors and other
//! acceleration structures are out of scope.
//!
//! # Features
//!
//! - `std` (default): square roots from the hardware, and `alloc`.
//! - `libm`: square roots from the [libm](https://docs.rs/libm) crate, for `no_std`. One of `std` and `libm` is needed. See
//!   [Small machines](#small-machines).
//! - `alloc`: [`Spheres`] and [`SphereBvh`], and [`Hittable`] for `Vec`, `Box`, `Rc` and `Arc`. Implied by `std`.
//! - `serde`: `Serialize` and `Deserialize` for all data types. A [`Camera`] is validated when it is deserialized. Formats that
//!   read each `f64` bit for bit give the same camera back: `serde_json` needs its feature `float_roundtrip` for that. JSON has
//!   no NaN and no infinity: `serde_json` writes `null`, which it does not read again as a number.
//! - `bytemuck`: `Pod` and `Zeroable` for [`Ray`] and [`Sphere`], to upload them to a GPU or read them from a file as bytes.
//! - `approx-05`: `AbsDiffEq`, `RelativeEq` and `UlpsEq` of approx 0.5, for tests with a tolerance.
//!
//! # Small machines
//!
//! On a Cortex-M4F, whose hardware has no `f64`, an easy hit takes 35 times the instructions of the textbook's formula, one from
//! 1,000 radii away 50 times, and a miss through [`nearest`] 2.5 times. Beyond the formula, `intersect` of a [`Sphere`] takes
//! 17 kB of code there in `f32` and 18 kB in both precisions, optimized for size, and in WebAssembly 12 kB in `f32` and 46 kB
//! in both (`tests/targets/run costs`, in the repository).
// Without `alloc` these two do not exist, and the links above lead to the documentation with all features.
#![cfg_attr(not(feature = "alloc"), doc = "")]
#![cfg_attr(
    not(feature = "alloc"),
    doc = "[`Spheres`]: https://docs.rs/eyeray/latest/eyeray/struct.Spheres.html"
)]
#![cfg_attr(
    not(feature = "alloc"),
    doc = "[`SphereBvh`]: https://docs.rs/eyeray/latest/eyeray/struct.SphereBvh.html"
)]
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
mod nearest;
mod order;
mod ray;
mod rejection;
mod root;
mod sealed;
mod sphere;
#[cfg(feature = "alloc")]
mod spheres;
mod target;
#[cfg(test)]
mod testing;
mod vector;

/// The version of glam that this crate is compiled with.
pub use glam;

pub use algebraic::Algebraic;
pub use camera::{Camera, CameraArgument, CameraError, Frame, Rays, Tile, Tiles, ViewRect};
pub use geometric::Geometric;
pub use hit::Hit;
pub use hittable::{Hittable, nearest};
pub use nearest::Nearest;
pub use ray::Ray;
pub use sphere::Sphere;
#[cfg(feature = "alloc")]
pub use spheres::{SphereBvh, SphereBvhIter, Spheres};
pub use vector::{Scalar, Vector};

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
