//! [`Serialize`] and [`Deserialize`] for [`Camera`]; the plain data types derive them where they are declared.

use core::fmt::{Display, Formatter};
use core::marker::PhantomData;

use glam::DVec3;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{Camera, CameraError, Vector, ViewRect};

/// A camera as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Camera")]
struct Written<V, S> {
    eye: V,
    /// U, V and W.
    basis: [DVec3; 3],
    view: ViewRect<f64>,
    projection: Projection<S>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Projection<S> {
    Orthographic,
    Perspective { distance: S },
}

/// A camera is written with the names of its accessors, and read again bit for bit:
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
/// An orthographic projection is just `"orthographic"`. The basis and the view are in `f64` in both precisions, as the camera
/// keeps them: its target and its up vector would not give back every bit of the basis that was once computed from them.
impl<V: Vector + Serialize> Serialize for Camera<V>
where
    V::Scalar: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let projection = match self.distance() {
            None => Projection::Orthographic,
            Some(distance) => Projection::Perspective { distance },
        };
        let basis = [self.u, self.v, self.w];
        Written { eye: self.eye(), basis, view: self.view, projection }.serialize(serializer)
    }
}

/// What no constructor could have made is an error that says why, as [`CameraError`] does. The basis need not be exact: the
/// three vectors may be as far from unit and from right angles as the rounding of their coordinates leaves them.
impl<'de, V: Vector + Deserialize<'de>> Deserialize<'de> for Camera<V>
where
    V::Scalar: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Written::<V, V::Scalar>::deserialize(deserializer)?.read().map_err(D::Error::custom)
    }
}

impl<V: Vector> Written<V, V::Scalar> {
    /// The camera, if its constructors could have made it.
    fn read(self) -> Result<Camera<V>, ReadError> {
        let Self { eye, basis: [u, v, w], view, projection } = self;
        let eye = eye.to_f64();
        if !eye.is_finite() {
            return Err(ReadError::Camera(CameraError::NotFinite("eye")));
        }
        if !is_basis([u, v, w]) {
            return Err(ReadError::Basis);
        }
        // The rest is for the constructors to check.
        let Camera { view, projection, .. } = match projection {
            Projection::Orthographic => Camera::orthographic(DVec3::ZERO, -w, v, view),
            Projection::Perspective { distance } => {
                Camera::perspective(DVec3::ZERO, -w, v, view, distance.into())
            }
        }
        .map_err(ReadError::Camera)?;
        Ok(Camera { eye, u, v, w, view, projection, precision: PhantomData })
    }
}

/// Whether these are unit vectors at right angles to one another, u × v = w, up to the rounding of their coordinates.
fn is_basis([u, v, w]: [DVec3; 3]) -> bool {
    /// Each of the vectors is off by at most 2⁻⁵³, from the rounding of its coordinates: together 3 · 2⁻⁵³. The rounding of
    /// the cross product adds at most 2 · 2⁻⁵³ a coordinate, and that of the difference next to nothing: less than 6 · 2⁻⁵³ in all.
    const TOLERANCE: f64 = 3.0 * f64::EPSILON;
    // False if there is a NaN.
    let equal = |a: DVec3, b: DVec3| (a - b).abs().cmple(DVec3::splat(TOLERANCE)).all();
    // Three zero vectors satisfy the equations as well.
    equal(u.cross(v), w) && equal(v.cross(w), u) && equal(w.cross(u), v) && u != DVec3::ZERO
}

/// Why what was read is no camera.
enum ReadError {
    Camera(CameraError),
    Basis,
}

impl Display for ReadError {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Camera(error) => error.fmt(f),
            Self::Basis => f.write_str(
                "the camera's basis is not three unit vectors at right angles, right-handed",
            ),
        }
    }
}
