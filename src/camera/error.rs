//! The error type of cameras and their frames.

use core::error::Error;
use core::fmt::{Display, Formatter, Result};

/// The error type of the constructors of [`Frame`](crate::Frame) and [`Camera`](crate::Camera): which argument is invalid, and
/// why.
///
/// If several arguments are invalid, the error is about one of them.
///
/// ```
/// use eyeray::{CameraArgument, CameraError, Frame};
/// use glam::Vec3;
///
/// let frame = Frame::look_to(Vec3::ZERO, Vec3::NEG_Y, Vec3::Y);
/// assert_eq!(frame, Err(CameraError::UpAlongView));
///
/// let frame = Frame::look_to(Vec3::ZERO, Vec3::NAN, Vec3::Y);
/// assert_eq!(frame, Err(CameraError::NotFinite(CameraArgument::Direction)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum CameraError {
    /// The argument, or one of its coordinates, is NaN or infinite.
    ///
    /// Also returned for a [`View`](CameraArgument::View) whose width or height overflows `f64`, and for an
    /// [`Aspect`](CameraArgument::Aspect) so large that the width of the view overflows.
    NotFinite(CameraArgument),
    /// The eye and the target are the same point, so there is no direction of view.
    EyeAtTarget,
    /// The direction of view is zero.
    ZeroDirection,
    /// The up vector is zero.
    ZeroUp,
    /// The up vector is parallel to the direction of view: exactly along it or exactly against it.
    UpAlongView,
    /// The view rectangle is empty: `left < right` or `bottom < top` does not hold.
    EmptyView,
    /// The distance from the eye to the view plane is zero or negative.
    DistanceNotPositive,
    /// The vertical field of view is not between 0 and π, both excluded.
    FovOutOfRange,
    /// The aspect ratio, width over height, is zero or negative.
    AspectNotPositive,
    /// The last row of the view matrix is not (0, 0, 0, 1), as it is of a rotation and a translation. The matrix may be
    /// transposed, or multiplied by a projection.
    ViewMatrixProjects,
    /// The view matrix scales: of the vectors in its first three rows and columns, a row is not of length 1.
    ViewMatrixScales,
    /// The view matrix shears: of the vectors in its first three rows and columns, two rows are not at a right angle.
    ViewMatrixShears,
    /// The last row of the projection matrix is neither (0, 0, -1, 0) nor (0, 0, 1, 0), as it is of a perspective projection, nor
    /// (0, 0, 0, 1), as it is of an orthographic one. The matrix may be transposed, or multiplied by a view.
    ProjectionMatrixUnknown,
    /// The projection matrix rotates or shears the image, or moves the eye: its x or y is not a scale and an offset of the x or y
    /// of view space.
    ProjectionMatrixSkews,
    /// The projection matrix mirrors the image, left to right.
    ProjectionMatrixMirrors,
    /// The projection matrix is flat: it maps every point to the same x, or to the same y.
    ProjectionMatrixFlat,
}

/// An argument of the constructors of [`Frame`](crate::Frame) and [`Camera`](crate::Camera), in a [`CameraError`].
///
/// ```
/// use eyeray::CameraArgument;
///
/// assert_eq!(CameraArgument::FovY.to_string(), "fov_y");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum CameraArgument {
    /// `eye`: the position of the camera.
    Eye,
    /// `target`: the point that the camera looks at.
    Target,
    /// `direction`: the direction of view.
    Direction,
    /// `up`: the direction that is upwards in the image.
    Up,
    /// `view`: the view rectangle.
    View,
    /// `distance`: the distance from the eye to the view plane, the focal length.
    Distance,
    /// `fov_y`: the vertical field of view.
    FovY,
    /// `aspect`: the aspect ratio, width over height.
    Aspect,
    /// `view_matrix`: the matrix from world space to view space.
    ViewMatrix,
    /// `projection_matrix`: the matrix from view space to clip space.
    ProjectionMatrix,
}

impl Display for CameraError {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::NotFinite(argument) => return write!(f, "the camera's {argument} is not finite"),
            Self::EyeAtTarget => "the camera's eye and target are the same point",
            Self::ZeroDirection => "the camera's direction of view is zero",
            Self::ZeroUp => "the camera's up vector is zero",
            Self::UpAlongView => "the camera's up vector is parallel to the direction of view",
            Self::EmptyView => "the camera's view rectangle is empty",
            Self::DistanceNotPositive => "the camera's distance to the view plane is not positive",
            Self::FovOutOfRange => "the camera's field of view is not between 0 and π",
            Self::AspectNotPositive => "the camera's aspect is not positive",
            Self::ViewMatrixProjects => "the last row of the camera's view matrix is not (0, 0, 0, 1)",
            Self::ViewMatrixScales => "the camera's view matrix scales: a row is not of length 1",
            Self::ViewMatrixShears => "the camera's view matrix shears: two rows are not at a right angle",
            Self::ProjectionMatrixUnknown => {
                "the last row of the camera's projection matrix is neither (0, 0, -1, 0), (0, 0, 1, 0) nor (0, 0, 0, 1)"
            }
            Self::ProjectionMatrixSkews => {
                "the camera's projection matrix rotates or shears the image, or moves the eye"
            }
            Self::ProjectionMatrixMirrors => "the camera's projection matrix mirrors the image",
            Self::ProjectionMatrixFlat => "the camera's projection matrix is flat",
        })
    }
}

/// Writes the name of the argument, as in the signatures.
impl Display for CameraArgument {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::Eye => "eye",
            Self::Target => "target",
            Self::Direction => "direction",
            Self::Up => "up",
            Self::View => "view",
            Self::Distance => "distance",
            Self::FovY => "fov_y",
            Self::Aspect => "aspect",
            Self::ViewMatrix => "view_matrix",
            Self::ProjectionMatrix => "projection_matrix",
        })
    }
}

impl Error for CameraError {}
