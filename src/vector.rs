//! The two vector types that everything here is generic over.

use core::fmt::{Debug, Display};
use core::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::arithmetic::rounding::RoundDown;
use crate::rejection::{Bounds, Rejection};
use crate::root::precision::Precision;

/// A glam vector of three dimensions: [`Vec3`] or [`DVec3`].
///
/// It lets a function be written once for both precisions. It is sealed: the contract of this crate is proved for these
/// two types and no other.
///
/// ```
/// use eyeray::{Ray, Vector};
///
/// /// Where the ray is after one length of its direction.
/// fn tip<V: Vector>(ray: &Ray<V>) -> V {
///     ray.origin + ray.direction
/// }
///
/// let ray = Ray::new(glam::dvec3(1.0, 2.0, 3.0), glam::DVec3::X);
/// assert_eq!(tip(&ray), glam::dvec3(2.0, 2.0, 3.0));
/// ```
pub trait Vector:
    Precision
    + Rejection
    + Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<Self::Scalar, Output = Self>
{
    /// The type of a coordinate, and of the distance `t`: `f32` or `f64`.
    type Scalar: Scalar;

    /// The vector of two dimensions with the same coordinates, for the view plane and for pixels.
    type Vec2: Copy + Debug + Default + PartialEq + Send + Sync + 'static;

    /// The same vector in `f64`: exact.
    fn to_f64(self) -> DVec3;

    /// The nearest vector of this precision, coordinate by coordinate: beyond the largest finite value, infinite.
    fn from_f64(vector: DVec3) -> Self;

    /// The same pair in `f64`: exact.
    fn vec2_to_f64(vector: Self::Vec2) -> DVec2;

    /// The nearest pair of this precision, coordinate by coordinate.
    fn vec2_from_f64(vector: DVec2) -> Self::Vec2;

    /// The dot product, as glam computes it.
    #[must_use]
    fn dot(self, other: Self) -> Self::Scalar;
}

/// A coordinate of a [`Vector`]: `f32` or `f64`. Sealed, as [`Vector`] is.
pub trait Scalar:
    RoundDown
    + Bounds
    + Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Into<f64>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// +∞: `Scalar::ZERO..Scalar::INFINITY` is the whole half-line.
    const INFINITY: Self;

    /// The nearest value of this precision: beyond the largest finite one, infinite.
    fn from_f64(value: f64) -> Self;
}

impl Scalar for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const INFINITY: Self = f32::INFINITY;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
    fn from_f64(value: f64) -> Self {
        value as f32
    }
}

impl Scalar for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const INFINITY: Self = f64::INFINITY;

    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }
}

impl Vector for Vec3 {
    type Scalar = f32;
    type Vec2 = Vec2;

    #[inline]
    fn to_f64(self) -> DVec3 {
        self.as_dvec3()
    }

    #[inline]
    fn from_f64(vector: DVec3) -> Self {
        vector.as_vec3()
    }

    #[inline]
    fn vec2_to_f64(vector: Vec2) -> DVec2 {
        vector.as_dvec2()
    }

    #[inline]
    fn vec2_from_f64(vector: DVec2) -> Vec2 {
        vector.as_vec2()
    }

    #[inline]
    fn dot(self, other: Self) -> f32 {
        Vec3::dot(self, other)
    }
}

impl Vector for DVec3 {
    type Scalar = f64;
    type Vec2 = DVec2;

    #[inline]
    fn to_f64(self) -> DVec3 {
        self
    }

    #[inline]
    fn from_f64(vector: DVec3) -> Self {
        vector
    }

    #[inline]
    fn vec2_to_f64(vector: DVec2) -> DVec2 {
        vector
    }

    #[inline]
    fn vec2_from_f64(vector: DVec2) -> DVec2 {
        vector
    }

    #[inline]
    fn dot(self, other: Self) -> f64 {
        DVec3::dot(self, other)
    }
}
