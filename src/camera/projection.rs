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
//! The second part is computed with exponents of any size, because u, or a quotient on the way to it, may be beyond the largest or
//! below the smallest `f64` where what comes out is not.

use glam::{DVec2, DVec3};

use super::{Camera, Frame, Projection};
use crate::arithmetic::float::Float;
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
    /// The point (u, v) of the view plane whose eye ray reaches the point.
    fn project_to_view_plane(&self, point: V) -> Option<[Float; 2]> {
        let point = point.to_f64();
        if !point.is_finite() {
            return None;
        }
        let Seen { in_plane, depth, unit } = self.frame.see(point);
        // No ray reaches what is not ahead of the eye.
        (depth > 0.0).then(|| match self.projection {
            Projection::Orthographic => in_plane.to_array().map(|along| float(along, unit)),
            Projection::Perspective { distance } => {
                let (depth, distance) = (float(depth, 0), float(distance, 0));
                in_plane.to_array().map(|along| float(along, 0) / depth * distance)
            }
        })
    }

    /// The same, rounded to `f64`: infinite where that overflows.
    pub(super) fn project_in_f64(&self, point: V) -> Option<DVec2> {
        self.project_to_view_plane(point).map(rounded)
    }

    /// The pixel of that point of the view plane, likewise.
    pub(super) fn project_to_pixel_in_f64(
        &self,
        point: V,
        width: u32,
        height: u32,
    ) -> Option<DVec2> {
        let [u, v] = self.project_to_view_plane(point)?;
        // Of the view in f64: rounded to the precision of V, its sides would move by a part of a pixel.
        let [left, top] = [self.view.left, self.view.top].map(|side| float(side, 0));
        let pixels = |along: Float, side: f64, pixels: u32| {
            along / float(side, 0) * float(f64::from(pixels.max(1)), 0)
        };
        let x = pixels(u - left, self.view.width(), width);
        let y = pixels(top - v, self.view.height(), height);
        Some(rounded([x, y]))
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

/// A finite number of units of 2^`unit`, with a value near 1, from which a few operations do not leave the range.
fn float(value: f64, unit: i32) -> Float {
    let exponent = exponent(value);
    Float { value: scale(value, -exponent), exponent: exponent + unit }
}

fn rounded(pair: [Float; 2]) -> DVec2 {
    pair.map(|Float { value, exponent }| scale(value, exponent)).into()
}
