//! The view rectangle.

use crate::Scalar;

/// A view rectangle: the part of the view plane that the image shows.
///
#[doc = include_str!("../diagrams/view_rect.svg")]
///
/// The sides are given in the units of the scene, along the camera's U (to the right) and V (up), from the point of the view
/// plane straight ahead of the eye. The rectangle need not be centered there, nor contain that point: an off-center rectangle is
/// used for shifted views, as in architectural photographs, for stereo, and for rendering an image in tiles.
///
/// In S. Marschner's CS4620 lecture 6 the sides are called l, r, b and t.
///
/// Any value is allowed in the fields. The constructors of cameras return an error unless `left < right` and `bottom < top`.
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
/// A calibrated camera is often given by its focal lengths `fx` and `fy` and its principal point (`cx`, `cy`), all in pixels. Its
/// view rectangle is in the plane at distance 1. In the usual convention, which is that of `OpenCV`, the *center* of the first
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
/// // The principal point is straight ahead.
/// let pixel = camera.project_to_pixel(Vec3::NEG_Z, width, height);
/// assert!(pixel.is_some_and(|pixel| (pixel - vec2(cx + 0.5, cy + 0.5)).length() < 1e-3));
/// # Ok(())
/// # }
/// ```
///
/// In that convention, y is downwards and z forwards; here V is upwards and W backwards.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ViewRect<S = f32> {
    /// The smallest u.
    pub left: S,
    /// The largest u.
    pub right: S,
    /// The smallest v.
    pub bottom: S,
    /// The largest v.
    pub top: S,
}

impl<S: Scalar> ViewRect<S> {
    /// Creates a rectangle of the given width and height, centered on the point straight ahead of the eye.
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
