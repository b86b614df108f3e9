//! The two vector types over which the crate is generic.

use core::fmt::{Debug, Display};
use core::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DMat4, DVec2, DVec3, Mat4, Vec2, Vec3};

use crate::sealed::{Sealed, SealedScalar};

/// A glam vector of three dimensions: [`Vec3`](glam::Vec3) or [`DVec3`](glam::DVec3).
///
/// Use it to write a function for both precisions. The trait is sealed, because the contract of this crate is proved for these
/// two types only.
///
/// ```
/// use eyeray::{Ray, Vector};
///
/// /// Returns the point at t = 1.
/// fn tip<V: Vector>(ray: &Ray<V>) -> V {
///     ray.origin + ray.direction
/// }
///
/// let ray = Ray::new(glam::dvec3(1.0, 2.0, 3.0), glam::DVec3::X);
/// assert_eq!(tip(&ray), glam::dvec3(2.0, 2.0, 3.0));
/// ```
pub trait Vector:
    Sealed
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
    /// The type of a coordinate and of a distance: `f32` or `f64`.
    type Scalar: Scalar;

    /// The vector of two dimensions of the same precision, for points of the view plane and for pixels.
    type Vec2: Copy + Debug + Default + PartialEq + Send + Sync + 'static;

    /// The matrix of the same precision, for view and projection matrices: [`Mat4`](glam::Mat4) or [`DMat4`](glam::DMat4).
    type Mat4: Matrix<Vector = Self>;

    /// The zero vector.
    const ZERO: Self;

    /// Converts the vector to `f64`, exactly.
    fn to_f64(self) -> DVec3;

    /// Rounds each coordinate to the nearest value of this precision: beyond the largest finite one, infinity.
    fn from_f64(vector: DVec3) -> Self;

    /// Converts the vector of two dimensions to `f64`, exactly.
    fn vec2_to_f64(vector: Self::Vec2) -> DVec2;

    /// Rounds each of two coordinates to the nearest value of this precision.
    fn vec2_from_f64(vector: DVec2) -> Self::Vec2;

    /// Computes the dot product, as glam does.
    #[must_use]
    fn dot(self, other: Self) -> Self::Scalar;
}

/// The type of a coordinate of a [`Vector`]: `f32` or `f64`.
///
/// The trait is sealed, as [`Vector`] is.
pub trait Scalar:
    SealedScalar
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
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Infinity. `V::Scalar::ZERO..V::Scalar::INFINITY` is the range of a whole ray.
    const INFINITY: Self;

    /// Rounds to the nearest value of this precision: beyond the largest finite one, infinity.
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
    type Mat4 = Mat4;

    const ZERO: Self = Self::ZERO;

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
    type Mat4 = DMat4;

    const ZERO: Self = Self::ZERO;

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

/// A matrix of four by four, of the precision of a vector. The vector follows from the matrix, so that a call need not name it.
pub trait Matrix: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// The vector of the same precision.
    type Vector: Vector<Mat4 = Self>;

    /// Converts the matrix to `f64`, exactly.
    fn to_f64(self) -> DMat4;

    /// Rounds each element to the nearest value of this precision: beyond the largest finite one, infinity.
    fn from_f64(matrix: DMat4) -> Self;
}

impl Matrix for Mat4 {
    type Vector = Vec3;

    #[inline]
    fn to_f64(self) -> DMat4 {
        self.as_dmat4()
    }

    #[inline]
    fn from_f64(matrix: DMat4) -> Self {
        matrix.as_mat4()
    }
}

impl Matrix for DMat4 {
    type Vector = DVec3;

    #[inline]
    fn to_f64(self) -> DMat4 {
        self
    }

    #[inline]
    fn from_f64(matrix: DMat4) -> Self {
        matrix
    }
}
