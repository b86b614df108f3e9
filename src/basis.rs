//! The camera basis: three unit vectors at right angles, from where the camera is, what it looks at, and what is up.
//!
//! ```text
//!     w = -(target - eye) / |target - eye|      against the direction of view
//!     u = up × w / |up × w|                     to the right
//!     v = w × u                                 up, as far as a right angle to w allows
//! ```
//!
//! With an eye far from the origin and near its target, or an up nearly along the view, `target - eye` and `up × w`
//! cancel, and what is left of them could be all rounding. So both are computed exactly, which also tells for sure whether
//! there is anything left, and the basis in pairs, of which only the result is rounded to f64.

use glam::DVec3;

use crate::CameraError;
use crate::arithmetic::exact::{Sum, Wide};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::Pair;

/// The basis u, v, w of a camera whose `eye`, `target` and `up` are finite.
pub(crate) fn basis(eye: DVec3, target: DVec3, up: DVec3) -> Result<[DVec3; 3], CameraError> {
    let back = [0, 1, 2].map(|i| sum([[1.0, eye[i]], [-1.0, target[i]]]));
    let w = unit(back).ok_or(CameraError::EyeAtTarget)?;
    if up == DVec3::ZERO {
        return Err(CameraError::ZeroUp);
    }
    // up × (eye - target), multiplied out.
    let right = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        sum([[up[i], eye[j]], [-up[i], target[j]], [-up[j], eye[i]], [up[j], target[i]]])
    });
    let u = unit(right).ok_or(CameraError::UpAlongView)?;
    let v = w.cross(u);
    Ok([u, v, w].map(|axis| axis.map(|coordinate| coordinate.hi).into()))
}

/// The sum of the products.
fn sum<const N: usize>(products: [[f64; 2]; N]) -> Wide {
    let mut sum = Sum::zero();
    for [a, b] in products {
        sum.add(1, [a, b, 1.0, 1.0]);
    }
    sum.value()
}

/// The unit vector along `vector`, unless that is zero.
fn unit(vector: [Wide; 3]) -> Option<Triple<Pair>> {
    let exponent =
        vector.into_iter().filter(|coordinate| !coordinate.is_zero()).map(Wide::exponent).max()?;
    // With the largest coordinate between 1 and 2, the length neither overflows nor underflows.
    let [x, y, z] = vector.map(|coordinate| coordinate.scaled(-exponent));
    let vector = Triple { x, y, z };
    let length = vector.dot(vector).sqrt();
    Some(vector.map(|coordinate| coordinate / length))
}
