//! Why there is no camera.

use core::error::Error;
use core::fmt::{Display, Formatter, Result};

/// Why a constructor of [`Camera`](crate::Camera) made none: which argument is at fault, and how.
///
/// Where several are at fault, it tells of one.
///
/// ```
/// use eyeray::{Camera, CameraError, ViewRect};
/// use glam::Vec3;
///
/// let view = ViewRect::centered(4.0, 3.0);
/// let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Y, Vec3::Y, view, 1.0);
/// assert_eq!(camera, Err(CameraError::UpAlongView));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CameraError {
    /// A NaN or an infinity in the argument of this name.
    ///
    /// `"view"` also stands for a width or a height that overflows `f64`, and `"aspect"` for an aspect so large that
    /// the width of the view does.
    NotFinite(&'static str),
    /// The eye and the target are one point, so there is no direction to look in.
    EyeAtTarget,
    /// The up vector is zero.
    ZeroUp,
    /// The up vector points exactly along the direction of view, or exactly against it.
    UpAlongView,
    /// The view rectangle has no area: its right is not greater than its left, or its top not than its bottom.
    EmptyView,
    /// The distance from the eye to the view plane is zero or negative.
    DistanceNotPositive,
    /// The field of view is not between 0 and π, both excluded.
    FovOutOfRange,
    /// The aspect, width over height, is zero or negative.
    AspectNotPositive,
}

impl Display for CameraError {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::NotFinite(argument) => return write!(f, "the camera's {argument} is not finite"),
            Self::EyeAtTarget => "the camera's eye and target are the same point",
            Self::ZeroUp => "the camera's up vector is zero",
            Self::UpAlongView => "the camera's up vector is parallel to the direction of view",
            Self::EmptyView => "the camera's view rectangle is empty",
            Self::DistanceNotPositive => "the camera's distance to the view plane is not positive",
            Self::FovOutOfRange => "the camera's field of view is not between 0 and π",
            Self::AspectNotPositive => "the camera's aspect is not positive",
        })
    }
}

impl Error for CameraError {}
