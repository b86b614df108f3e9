//! [`Serialize`] and [`Deserialize`] for [`Frame`] and [`Camera`]; the plain data types derive them where they are declared.

use core::fmt::{Display, Formatter};

use glam::DVec3;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::camera::Projection;
use crate::{Camera, CameraArgument, CameraError, Frame, Scalar, Vector, ViewRect};

/// The serialized form of a frame.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Frame")]
struct WrittenFrame<V> {
    eye: V,
    /// U, V and W.
    basis: [DVec3; 3],
}

/// The serialized form of a camera.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Camera")]
struct WrittenCamera<V, S> {
    eye: V,
    /// U, V and W.
    basis: [DVec3; 3],
    view: ViewRect<f64>,
    projection: WrittenProjection<S>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Projection", rename_all = "lowercase")]
enum WrittenProjection<S> {
    Orthographic,
    Perspective { distance: S },
}

/// Serializes a frame with the names of its accessors:
///
/// ```json
/// {
///     "eye": [0.0, 0.0, 5.0],
///     "basis": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
/// }
/// ```
///
/// The basis is in `f64` in both precisions, as the frame keeps it. A format that reads each `f64` bit for bit gives the same
/// frame back, as [`Camera`] says.
impl<V: Vector + Serialize> Serialize for Frame<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        WrittenFrame { eye: self.eye(), basis: [self.u, self.v, self.w] }.serialize(serializer)
    }
}

/// Deserializes and validates a frame: the error for an invalid one says why, as [`CameraError`] does. The basis need not be
/// exact: each coordinate may be off by 2 ulp, as left by a fast parser of decimal numbers.
impl<'de, V: Vector + Deserialize<'de>> Deserialize<'de> for Frame<V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        WrittenFrame::<V>::deserialize(deserializer)?.read().map_err(D::Error::custom)
    }
}

/// Serializes a camera with the names of its accessors:
///
/// ```json
/// {
///     "eye": [0.0, 0.0, 5.0],
///     "basis": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
///     "view": { "left": -2.0, "right": 2.0, "bottom": -1.5, "top": 1.5 },
///     "projection": { "perspective": { "distance": 2.0 } }
/// }
/// ```
///
/// An orthographic projection is `"orthographic"`. The basis and the view are in `f64` in both precisions, as the camera
/// keeps them.
///
/// # Bit for bit
///
/// A format that reads each `f64` bit for bit gives the same camera back. Binary formats do, and most text formats. `serde_json`
/// needs its feature `float_roundtrip`: without it, an `f64` may be read an ulp off, and so are most cameras, also those of
/// [`Vec3`](glam::Vec3). Such a camera is still accepted. Its rays are as accurate in `f32`; in `f64` they are off by another ulp
/// or two.
impl<V: Vector + Serialize> Serialize for Camera<V>
where
    V::Scalar: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { frame, view, projection } = *self;
        let projection = match projection {
            Projection::Orthographic => WrittenProjection::Orthographic,
            Projection::Perspective { distance } => {
                WrittenProjection::Perspective { distance: V::Scalar::from_f64(distance) }
            }
        };
        let basis = [frame.u, frame.v, frame.w];
        WrittenCamera { eye: frame.eye(), basis, view, projection }.serialize(serializer)
    }
}

/// Deserializes and validates a camera: the error for an invalid one says why, as for a [`Frame`].
impl<'de, V: Vector + Deserialize<'de>> Deserialize<'de> for Camera<V>
where
    V::Scalar: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        WrittenCamera::<V, V::Scalar>::deserialize(deserializer)?.read().map_err(D::Error::custom)
    }
}

impl<V: Vector> WrittenFrame<V> {
    /// The frame, if it is valid.
    fn read(self) -> Result<Frame<V>, ReadError> {
        let Self { eye, basis } = self;
        let eye = eye.to_f64();
        if !eye.is_finite() {
            return Err(ReadError::Camera(CameraError::NotFinite(CameraArgument::Eye)));
        }
        if !is_basis(basis) {
            return Err(ReadError::Basis);
        }
        Ok(Frame::from_parts(eye, basis))
    }
}

impl<V: Vector> WrittenCamera<V, V::Scalar> {
    /// The camera, if it is valid.
    fn read(self) -> Result<Camera<V>, ReadError> {
        let Self { eye, basis, view, projection } = self;
        let frame: Frame<DVec3> = WrittenFrame { eye, basis }.read()?.cast();
        match projection {
            WrittenProjection::Orthographic => frame.orthographic(view),
            WrittenProjection::Perspective { distance } => frame.perspective(view, distance.into()),
        }
        .map(Camera::cast)
        .map_err(ReadError::Camera)
    }
}

/// Whether these are orthonormal vectors with u × v = w or, from a left-handed view matrix, -w, up to the rounding of their
/// coordinates by a writer and a reader.
fn is_basis([u, v, w]: [DVec3; 3]) -> bool {
    /// With h = 2⁻⁵³, each of the vectors is off by at most h from the rounding of its coordinates, and by 4 h where a reader of
    /// decimal numbers rounds four times (the digits, a power of ten, their quotient, the decimal itself): together 15 h. The
    /// rounding of the cross product adds at most 2 h a coordinate, and that of the difference next to nothing: 18 h are enough.
    const TOLERANCE: f64 = 9.0 * f64::EPSILON;
    // False if there is a NaN.
    let equal = |a: DVec3, b: DVec3| (a - b).abs().cmple(DVec3::splat(TOLERANCE)).all();
    let u = if u.cross(v).dot(w) < 0.0 { -u } else { u };
    // Three zero vectors satisfy the equations as well.
    equal(u.cross(v), w) && equal(v.cross(w), u) && equal(w.cross(u), v) && u != DVec3::ZERO
}

/// Why a frame or a camera is invalid.
enum ReadError {
    Camera(CameraError),
    Basis,
}

impl Display for ReadError {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Camera(error) => error.fmt(f),
            Self::Basis => {
                f.write_str("the camera's basis is not three unit vectors at right angles")
            }
        }
    }
}
