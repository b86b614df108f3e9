//! [`Pod`] and [`Zeroable`] for [`Ray`] and [`Sphere`], whose bytes are their numbers, one after the other.
#![allow(
    unsafe_code,
    reason = "the traits are unsafe, and cannot be derived for a `repr(C)` type that has a parameter"
)]

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::{Ray, Sphere};

/// Implements both traits for a type of so many bytes with these fields.
///
/// What they ask for is checked here as far as the compiler can, before it is promised:
///
/// - Every pattern of bits is a value: the fields named are all of its fields, and each is itself `Pod`. For the
///   same reason it has no pointers and no interior mutability.
/// - There is no padding: the fields together take as many bytes as the type.
/// - The order of the fields is that of their declaration: the two types are `#[repr(C)]`.
/// - It is `Copy` and `'static`: the trait `Pod` demands that by itself.
macro_rules! plain_bytes {
    ($type:ident<$vector:ty> { $($field:ident: $field_type:ty),+ }, $bytes:literal, $numbers:literal) => {
        const _: () = {
            const fn bytes_of<Field: Pod>() -> usize {
                size_of::<Field>()
            }
            let _: fn($type<$vector>) -> ($($field_type),+) = |$type { $($field),+ }| ($($field),+);
            assert!(size_of::<$type<$vector>>() == $bytes);
            assert!(0 $(+ bytes_of::<$field_type>())+ == $bytes);
        };

        // SAFETY: zero is one of the values of each field.
        unsafe impl Zeroable for $type<$vector> {}
        #[doc = concat!(stringify!($bytes), " bytes and no padding: ", $numbers, ".")]
        // SAFETY: as said at the macro.
        unsafe impl Pod for $type<$vector> {}
    };
}

plain_bytes!(Ray<Vec3> { origin: Vec3, direction: Vec3 }, 24, "six `f32`, the origin's and the direction's coordinates");
plain_bytes!(Ray<DVec3> { origin: DVec3, direction: DVec3 }, 48, "six `f64`, the origin's and the direction's coordinates");
plain_bytes!(Sphere<Vec3> { center: Vec3, radius: f32 }, 16, "four `f32`, the center's coordinates and the radius");
plain_bytes!(Sphere<DVec3> { center: DVec3, radius: f64 }, 32, "four `f64`, the center's coordinates and the radius");
