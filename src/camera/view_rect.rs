//! The part of the view plane that the image shows.

use crate::Scalar;

/// The view rectangle: the part of the view plane that the image shows, in the lecture's terms l, r, b and t.
///
#[doc = include_str!("../diagrams/view_rect.svg")]
///
/// The four count in the units of the scene along the camera's u (to the right) and v (up), from the point of the view
/// plane straight ahead of the eye. The rectangle need not be centered there, nor even contain that point: a
/// rectangle beside it is how an architectural photograph is shifted, and how one image is rendered in tiles.
///
/// Any value is allowed in the fields. A camera asks that `left < right` and `bottom < top`.
///
/// ```
/// use eyeray::ViewRect;
///
/// let view = ViewRect { left: -1.0, right: 3.0, bottom: -1.0, top: 1.0 };
/// assert_eq!((view.width(), view.height()), (4.0, 2.0));
/// ```
///
/// # From a camera matrix
///
/// A calibrated camera is often given by its focal lengths `fx` and `fy` and its principal point (`cx`, `cy`), all in pixels.
/// Its view rectangle is in the plane at distance 1. In the usual convention, which is that of `OpenCV`, the *center* of the first
/// pixel is (0, 0), half a pixel from the corner of the image, where this crate's pixel coordinates begin:
///
/// ```
/// use eyeray::{Camera, Frame, ViewRect};
/// use glam::{Vec3, vec2};
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// let (fx, fy, cx, cy) = (800.0, 810.0, 325.5, 236.5);
/// let (width, height) = (640, 480);
/// let view = ViewRect {
///     left: -(cx + 0.5) / fx,
///     right: (width as f32 - 0.5 - cx) / fx,
///     bottom: -(height as f32 - 0.5 - cy) / fy,
///     top: (cy + 0.5) / fy,
/// };
/// let camera = Frame::look_to(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)?.perspective(view, 1.0)?;
///
/// // The principal point is straight ahead, and a pixel of the matrix is half a pixel further here.
/// let pixel = camera.project_to_pixel(Vec3::NEG_Z, width, height);
/// assert!(pixel.is_some_and(|pixel| (pixel - vec2(cx + 0.5, cy + 0.5)).length() < 1e-3));
/// # Ok(())
/// # }
/// ```
///
/// There y is downwards and z forwards; here v is upwards and w backwards.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ViewRect<S = f32> {
    /// The smallest u: the lecture's l.
    pub left: S,
    /// The largest u: the lecture's r.
    pub right: S,
    /// The smallest v: the lecture's b.
    pub bottom: S,
    /// The largest v: the lecture's t.
    pub top: S,
}

impl<S: Scalar> ViewRect<S> {
    /// Creates the rectangle of that width and height whose middle is straight ahead of the eye.
    ///
    /// ```
    /// use eyeray::ViewRect;
    ///
    /// let view = ViewRect { left: -2.0, right: 2.0, bottom: -1.5, top: 1.5 };
    /// assert_eq!(ViewRect::centered(4.0, 3.0), view);
    /// ```
    #[inline]
    #[must_use]
    pub fn centered(width: S, height: S) -> Self {
        let two = S::ONE + S::ONE;
        let (right, top) = (width / two, height / two);
        Self { left: -right, right, bottom: -top, top }
    }

    /// Returns the width, `right - left`.
    #[inline]
    #[must_use]
    pub fn width(&self) -> S {
        self.right - self.left
    }

    /// Returns the height, `top - bottom`.
    #[inline]
    #[must_use]
    pub fn height(&self) -> S {
        self.top - self.bottom
    }
}

impl<S> ViewRect<S> {
    /// The rectangle whose sides are those of this one, each converted.
    pub(crate) fn map<T>(self, convert: impl Fn(S) -> T) -> ViewRect<T> {
        ViewRect {
            left: convert(self.left),
            right: convert(self.right),
            bottom: convert(self.bottom),
            top: convert(self.top),
        }
    }
}
