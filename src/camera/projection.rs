//! From the scene back to the image: the inverse of the eye rays.
//!
//! With f the vector from the eye to the point, `f = point - e`, the coordinates of the point in the camera's basis are f·U, f·V
//! and, ahead of the eye, the depth -f·W.
//!
//! ```text
//!     orthographic    u = f·U                       v = f·V
//!     perspective     u = f·U / depth · distance    v = f·V / depth · distance
//!
//!     pixel           x = (u - left) / (right - left) · width      y = (top - v) / (top - bottom) · height
//! ```
//!
//! Where u, or a quotient on the way to it, may be beyond the largest or below the smallest `f64` and what comes out is not, the
//! exponents are of any size. The bits are the same otherwise.

use core::ops::{Div, Mul, Sub};

use glam::{DVec2, DVec3};

use super::{Camera, Frame, Projection, ViewRect};
use crate::arithmetic::scaled_float::ScaledFloat;
use crate::arithmetic::scaling::{exponent, scale};
use crate::{Scalar, Vector};

/// The coordinates of a point from the eye, along U, V and -W, in units of 2^`unit`.
struct Seen {
    in_plane: DVec2,
    depth: f64,
    unit: i32,
}

/// 2¹⁰²⁰: vectors with coordinates up to this can be subtracted, and multiplied by unit vectors, without overflow.
const LARGE: f64 = f64::from_bits((1023 + 1020) << 52);
/// The unit of those with a larger one: as long as the sum of three products of such coordinates is finite.
const LARGE_UNIT: i32 = 3;

/// 2⁻⁵¹²: products of smaller vectors and unit vectors might lose digits, because they are subnormal.
const SMALL: f64 = f64::from_bits((1023 - 512) << 52);
/// Their unit, in which the smallest number there is has a coordinate of 2⁻⁴⁷⁴.
const SMALL_UNIT: i32 = -600;

impl<V: Vector> Frame<V> {
    /// The point as seen from the eye. Not finite if the point is not.
    fn see(&self, point: DVec3) -> Seen {
        let scaled = |vector: DVec3, unit: i32| vector * scale(1.0, -unit);
        let eye = self.eye;
        let (from_eye, unit) = if largest(point).max(largest(eye)) > LARGE {
            (scaled(point, LARGE_UNIT) - scaled(eye, LARGE_UNIT), LARGE_UNIT)
        } else if largest(point - eye) < SMALL {
            (scaled(point - eye, SMALL_UNIT), SMALL_UNIT)
        } else {
            (point - eye, 0)
        };
        Seen {
            in_plane: DVec2::new(from_eye.dot(self.u), from_eye.dot(self.v)),
            // Subtracted from 0, which is 0 and not -0 for what lies beside the eye.
            depth: 0.0 - from_eye.dot(self.w),
            unit,
        }
    }
}

impl<V: Vector> Camera<V> {
    /// The point as seen from the eye, if an eye ray reaches it: if it is ahead.
    fn see_ahead(&self, point: V) -> Option<Seen> {
        let point = point.to_f64();
        let seen = self.frame.see(point);
        (point.is_finite() && seen.depth > 0.0).then_some(seen)
    }

    /// The point (u, v) of the view plane whose eye ray reaches the point, rounded to `f64`: infinite where that overflows.
    pub(super) fn project_in_f64(&self, point: V) -> Option<DVec2> {
        let seen = self.see_ahead(point)?;
        Some(if self.is_moderate(&seen) {
            self.in_view_plane(&seen, |x| x).into()
        } else {
            rounded(self.in_view_plane_of_any_exponent(&seen))
        })
    }

    /// The pixel of that point of the view plane, likewise.
    pub(super) fn project_to_pixel_in_f64(
        &self,
        point: V,
        width: u32,
        height: u32,
    ) -> Option<DVec2> {
        let seen = self.see_ahead(point)?;
        let size = [width, height].map(|pixels| f64::from(pixels.max(1)));
        Some(if self.is_moderate(&seen) {
            self.in_image(self.in_view_plane(&seen, |x| x), size, |x| x).into()
        } else {
            rounded(self.in_image(self.in_view_plane_of_any_exponent(&seen), size, float))
        })
    }

    #[cold]
    fn in_view_plane_of_any_exponent(&self, seen: &Seen) -> [ScaledFloat; 2] {
        let unit = match self.projection {
            Projection::Orthographic => seen.unit,
            // In a quotient, the unit is no matter.
            Projection::Perspective { .. } => 0,
        };
        let in_units =
            |along: ScaledFloat| ScaledFloat { exponent: along.exponent + unit, ..along };
        self.in_view_plane(seen, float).map(in_units)
    }

    /// The point of the view plane, in such numbers, and for an orthographic camera in the unit of what is seen.
    #[inline]
    fn in_view_plane<N: Number>(&self, seen: &Seen, number: impl Fn(f64) -> N) -> [N; 2] {
        let in_plane = seen.in_plane.to_array().map(&number);
        match self.projection {
            Projection::Orthographic => in_plane,
            Projection::Perspective { distance } => {
                in_plane.map(|along| along / number(seen.depth) * number(distance))
            }
        }
    }

    /// The pixel of a point of the view plane.
    #[inline]
    fn in_image<N: Number>(
        &self,
        [u, v]: [N; 2],
        [width, height]: [f64; 2],
        number: impl Fn(f64) -> N,
    ) -> [N; 2] {
        // Of the view in f64: rounded to the precision of V, its sides would move by a part of a pixel.
        let view = &self.view;
        [
            (u - number(view.left)) / number(view.width()) * number(width),
            (number(view.top) - v) / number(view.height()) * number(height),
        ]
    }

    /// Whether no result is beyond the range of `f64`, nor any on the way to it.
    ///
    /// Of numbers of 2⁻²⁰⁰ to 2²⁰⁰, the products and quotients of three are 2⁻⁶⁰⁰ to 2⁶⁰⁰. A difference from another is 0 or at
    /// least an ulp, and once more divided and multiplied, it stays within 2⁻⁸⁵³ and 2⁸³³.
    #[inline]
    fn is_moderate(&self, seen: &Seen) -> bool {
        const LEAST: f64 = f64::from_bits((1023 - 200) << 52);
        const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);
        let is_moderate = |x: f64| x == 0.0 || (LEAST..LARGEST).contains(&x.abs());
        let Seen { in_plane, depth, unit } = *seen;
        let ViewRect { left, right: _, bottom: _, top } = self.view;
        let distance = match self.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { distance } => distance,
        };
        let numbers = [
            in_plane.x,
            in_plane.y,
            depth,
            distance,
            left,
            top,
            self.view.width(),
            self.view.height(),
        ];
        unit == 0 && numbers.into_iter().all(is_moderate)
    }

    pub(super) fn depth_of(&self, point: V) -> V::Scalar {
        let Seen { depth, unit, .. } = self.frame.see(point.to_f64());
        V::Scalar::from_f64(scale(depth, unit))
    }
}

/// The largest absolute value of a coordinate.
fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}

/// What a projection does with numbers.
trait Number: Copy + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {}

impl Number for f64 {}
impl Number for ScaledFloat {}

/// A finite number, with a value near 1, from which a few operations do not leave the range.
fn float(value: f64) -> ScaledFloat {
    let exponent = exponent(value);
    ScaledFloat { value: scale(value, -exponent), exponent }
}

fn rounded(pair: [ScaledFloat; 2]) -> DVec2 {
    pair.map(|ScaledFloat { value, exponent }| scale(value, exponent)).into()
}
