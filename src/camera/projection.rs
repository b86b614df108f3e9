//! From the scene back to the image: the inverse of the eye rays.
//!
//! Of a point, what counts is where it is seen from the eye: `f = point - e`. Its coordinates in the camera's basis are
//! f·U, f·V and, ahead of the eye, the depth -f·W.
//!
//! ```text
//!     orthographic    u = f·U                       v = f·V
//!     perspective     u = f·U / depth · distance    v = f·V / depth · distance
//! ```

use glam::{DVec2, DVec3};

use super::{Camera, Frame, Projection};
use crate::arithmetic::scaling::{exponent, scale};
use crate::{Scalar, Vector};

/// A point as the camera sees it: how far it lies along U, V and -W from the eye, each divided by 2^`exponent`.
struct Seen {
    in_plane: DVec2,
    depth: f64,
    exponent: i32,
}

impl<V: Vector> Frame<V> {
    /// Where the point is from the eye. Of a point that is not finite, nothing that is.
    fn see(&self, point: DVec3) -> Seen {
        /// 2⁻¹: so that the difference does not overflow.
        const HALF: f64 = 0.5;
        /// What is below can be subtracted without overflow.
        const LARGE: f64 = f64::MAX / 4.0;
        let large = largest(point).max(largest(self.eye)) > LARGE;
        let (from_eye, halved) = if large {
            (point * HALF - self.eye * HALF, 1)
        } else {
            (point - self.eye, 0)
        };
        // With the largest coordinate between 1 and 2, no product with the basis loses digits, and no sum overflows.
        let exponent = exponent(largest(from_eye));
        let from_eye = from_eye.map(|coordinate| scale(coordinate, -exponent));
        Seen {
            in_plane: DVec2::new(from_eye.dot(self.u), from_eye.dot(self.v)),
            // Subtracted from 0, which is 0 and not -0 for what lies beside the eye.
            depth: 0.0 - from_eye.dot(self.w),
            exponent: exponent + halved,
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
        let Seen { in_plane, depth, exponent } = self.frame.see(point);
        // No ray reaches what is not ahead of the eye.
        (depth > 0.0).then(|| match self.projection {
            Projection::Orthographic => in_plane.map(|coordinate| scale(coordinate, exponent)),
            Projection::Perspective { distance } => in_plane / depth * distance,
        })
    }

    pub(super) fn depth_of(&self, point: V) -> V::Scalar {
        let Seen { depth, exponent, .. } = self.frame.see(point.to_f64());
        V::Scalar::from_f64(scale(depth, exponent))
    }
}

/// The largest coordinate, sign apart.
fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}
