//! The part of the view plane that the image shows.

use crate::Scalar;

/// The view rectangle: the part of the view plane that the image shows, in the lecture's terms l, r, b and t.
///
#[doc = include_str!("diagrams/view_rect.svg")]
///
/// The four count in the units of the scene along the camera's u (to the right) and v (up), from the point of the view
/// plane straight ahead of the eye. The rectangle need not be centered there, nor even contain that point: a
/// rectangle beside it is how an architectural photograph is shifted, and how one image is rendered in parts.
///
/// Any value is allowed in the fields. A camera asks that `left < right` and `bottom < top`.
///
/// ```
/// use eyeray::ViewRect;
///
/// let view = ViewRect { left: -1.0, right: 3.0, bottom: -1.0, top: 1.0 };
/// assert_eq!((view.width(), view.height()), (4.0, 2.0));
/// ```
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
    /// The rectangle of that width and height whose middle is straight ahead of the eye.
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

    /// `right - left`.
    #[inline]
    pub fn width(&self) -> S {
        self.right - self.left
    }

    /// `top - bottom`.
    #[inline]
    pub fn height(&self) -> S {
        self.top - self.bottom
    }
}
