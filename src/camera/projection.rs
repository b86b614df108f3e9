//! From the scene back to the image: the inverse of the eye rays.
//!
//! With f the vector from the eye to the point, `f = point - e`, the coordinates of the point in the camera's basis are f·U, f·V
//! and, ahead of the eye, the depth -f·W.
//!
//! ```text
//!     orthographic    u = f·U                       v = f·V
//!     perspective     u = f·U / depth · distance    v = f·V / depth · distance
//! ```

use glam::{DVec2, DVec3};

use super::{Camera, Frame, Projection};
use crate::{Scalar, Vector};

/// The coordinates of a point from the eye, along U, V and -W, each times `scale`, a power of two.
struct Seen {
    in_plane: DVec2,
    depth: f64,
    scale: f64,
}

/// Vectors with coordinates up to this can be subtracted, and multiplied by unit vectors, without overflow.
const LARGE: f64 = f64::MAX * DOWN;
const DOWN: f64 = 0.125;

/// 2⁻⁵¹²: products of smaller vectors and unit vectors might lose digits, because they are subnormal.
const SMALL: f64 = f64::from_bits(0x1ff0_0000_0000_0000);
/// 2⁶⁰⁰.
const UP: f64 = f64::from_bits(0x6570_0000_0000_0000);

impl<V: Vector> Frame<V> {
    /// The point as seen from the eye. Not finite if the point is not.
    fn see(&self, point: DVec3) -> Seen {
        let eye = self.eye;
        let (from_eye, scale) = if largest(point).max(largest(eye)) > LARGE {
            (point * DOWN - eye * DOWN, DOWN)
        } else if largest(point - eye) < SMALL {
            ((point - eye) * UP, UP)
        } else {
            (point - eye, 1.0)
        };
        Seen {
            in_plane: DVec2::new(from_eye.dot(self.u), from_eye.dot(self.v)),
            // Subtracted from 0, which is 0 and not -0 for what lies beside the eye.
            depth: 0.0 - from_eye.dot(self.w),
            scale,
        }
    }
}

impl<V: Vector> Camera<V> {
    /// The point (u, v) of the view plane whose eye ray reaches the point.
    pub(super) fn project_in_f64(&self, point: V) -> Option<DVec2> {
        let point = point.to_f64();
        if !point.is_finite() {
            return None;
        }
        let Seen { in_plane, depth, scale } = self.frame.see(point);
        // No ray reaches what is not ahead of the eye.
        (depth > 0.0).then(|| match self.projection {
            Projection::Orthographic => in_plane / scale,
            Projection::Perspective { distance } => in_plane / depth * distance,
        })
    }

    pub(super) fn depth_of(&self, point: V) -> V::Scalar {
        let Seen { depth, scale, .. } = self.frame.see(point.to_f64());
        V::Scalar::from_f64(depth / scale)
    }
}

/// The largest absolute value of a coordinate.
fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}
