//! The camera frame: the position and the orientation of a camera.

use core::fmt::{Debug, Formatter};
use core::marker::PhantomData;

use glam::DVec3;

use super::basis::basis;
use super::{Camera, Projection};
use crate::float::tan;
use crate::{CameraArgument, CameraError, Vector, ViewRect};

/// A camera frame: the position of a camera, the eye e, and its orientation, an orthonormal basis.
///
/// U points to the right of the image, V up, and W backwards, against the direction of view. U × V is W, except in the frame of a
/// view matrix that is left-handed or mirrors, where it is -W. A [`Camera`] is a frame with a view
/// rectangle and a projection. Frames create cameras, and [`Camera::frame`] returns the frame without losing a digit.
///
/// ```
/// use eyeray::{Frame, ViewRect};
/// use glam::{Vec3, vec3};
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// let frame = Frame::look_to(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z, Vec3::Y)?;
/// assert_eq!(frame.basis(), [Vec3::X, Vec3::Y, Vec3::Z]);
/// let camera = frame.perspective(ViewRect::centered(4.0, 3.0), 2.0)?;
///
/// // Another view rectangle for the same camera, here the left half of the image.
/// let half = ViewRect { left: -2.0, right: 0.0, bottom: -1.5, top: 1.5 };
/// let tile = camera.frame().perspective(half, 2.0)?;
/// assert_eq!(tile.rays(320, 480).next(), camera.rays(640, 480).next());
/// # Ok(())
/// # }
/// ```
///
/// # Which way is up
///
/// Only the direction of `up` counts. It need not be at a right angle to the view: V is the part of it that is. It must not be
/// parallel to the view. For a camera that looks straight down, pass the horizontal direction that points to the top of the image
/// instead of the vertical, such as the north of a map.
///
/// ```
/// use eyeray::Frame;
/// use glam::{Vec3, vec3};
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// // Y is the vertical, and -Z is north.
/// let frame = Frame::look_to(vec3(0.0, 100.0, 0.0), Vec3::NEG_Y, Vec3::NEG_Z)?;
/// assert_eq!(frame.basis(), [Vec3::X, Vec3::NEG_Z, Vec3::Y]);
/// # Ok(())
/// # }
/// ```
///
/// A camera that can turn all the way over, on a gimbal or in an orbit, needs an up vector of its own, which is rotated along
/// with the direction of view.
#[derive(Clone, Copy, PartialEq)]
pub struct Frame<V: Vector = glam::Vec3> {
    pub(crate) eye: DVec3,
    pub(crate) u: DVec3,
    pub(crate) v: DVec3,
    pub(crate) w: DVec3,
    precision: PhantomData<V>,
}

impl<V: Vector> Frame<V> {
    /// Creates the frame of a camera at `eye` that looks at `target`, with `up` upwards in the image.
    ///
    /// Only the direction from the eye to `target` counts. If this direction is known, use [`look_to`](Self::look_to): the sum of
    /// the eye and the direction would be rounded.
    ///
    /// ```
    /// use eyeray::Frame;
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let frame = Frame::look_at(vec3(0.0, 3.0, 4.0), Vec3::ZERO, Vec3::Y)?;
    /// assert_eq!(frame.basis(), [Vec3::X, vec3(0.0, 0.8, -0.6), vec3(0.0, 0.6, 0.8)]);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, the eye is at the target, or `up` is zero or parallel to the view.
    #[doc(alias("lookat", "look_at_rh", "view_matrix"))]
    pub fn look_at(eye: V, target: V, up: V) -> Result<Self, CameraError> {
        let eye = finite(eye, CameraArgument::Eye)?;
        let target = finite(target, CameraArgument::Target)?;
        if eye == target {
            return Err(CameraError::EyeAtTarget);
        }
        Self::new(eye, eye, target, up)
    }

    /// Creates the frame of a camera at `eye` that looks along `direction`, with `up` upwards in the image.
    ///
    /// The direction need not be a unit vector. It is never added to the eye, so it keeps all its digits, however far the camera
    /// is from the world's origin.
    ///
    /// ```
    /// use eyeray::Frame;
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let (eye, forward) = (vec3(1e8, 0.0, 0.0), vec3(0.6, 0.0, -0.8));
    /// let frame = Frame::look_to(eye, forward, Vec3::Y)?;
    /// assert_eq!(frame.basis(), [vec3(0.8, 0.0, 0.6), Vec3::Y, vec3(-0.6, 0.0, 0.8)]);
    ///
    /// // The `f32` after 1e8 is 1e8 + 8: a target computed by addition would be along -Z.
    /// assert_eq!(eye + forward, vec3(1e8, 0.0, -0.8));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, the direction is zero, or `up` is zero or parallel to the direction.
    #[doc(alias("look_to_rh", "forward", "view_matrix"))]
    pub fn look_to(eye: V, direction: V, up: V) -> Result<Self, CameraError> {
        let eye = finite(eye, CameraArgument::Eye)?;
        let direction = finite(direction, CameraArgument::Direction)?;
        if direction == DVec3::ZERO {
            return Err(CameraError::ZeroDirection);
        }
        Self::new(eye, DVec3::ZERO, direction, up)
    }

    /// The frame at `eye`, looking in the direction from `from` to `to`, which are not the same.
    fn new(eye: DVec3, from: DVec3, to: DVec3, up: V) -> Result<Self, CameraError> {
        let up = finite(up, CameraArgument::Up)?;
        if up == DVec3::ZERO {
            return Err(CameraError::ZeroUp);
        }
        let basis = basis(from, to, up).ok_or(CameraError::UpAlongView)?;
        Ok(Self::from_parts(eye, basis))
    }

    pub(crate) const fn from_parts(eye: DVec3, [u, v, w]: [DVec3; 3]) -> Self {
        Self { eye, u, v, w, precision: PhantomData }
    }

    /// The same frame in another precision, to which its numbers are rounded when they are returned.
    pub(crate) const fn cast<W: Vector>(self) -> Frame<W> {
        Frame::from_parts(self.eye, [self.u, self.v, self.w])
    }

    /// Returns the eye, the position of the camera.
    #[must_use]
    pub fn eye(&self) -> V {
        V::from_f64(self.eye)
    }

    /// Returns the orthonormal basis: U (to the right), V (up) and W (backwards).
    ///
    /// The frame keeps it in `f64`; this rounds each coordinate to the precision of `V`.
    #[must_use]
    #[doc(alias("right", "up", "forward", "axes"))]
    pub fn basis(&self) -> [V; 3] {
        [self.u, self.v, self.w].map(V::from_f64)
    }

    /// Creates an orthographic camera with this frame. The eye is in its view plane.
    ///
    /// ```
    /// use eyeray::{Frame, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let frame = Frame::look_to(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z, Vec3::Y)?;
    /// let camera = frame.orthographic(ViewRect::centered(4.0, 3.0))?;
    /// assert_eq!(camera.ray(vec2(1.0, 0.5)).origin, vec3(1.0, 0.5, 5.0));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If the view rectangle is not finite or is empty.
    #[doc(alias = "parallel")]
    pub fn orthographic(&self, view: ViewRect<V::Scalar>) -> Result<Camera<V>, CameraError> {
        self.camera(view.map(Into::into), Projection::Orthographic)
    }

    /// Creates a perspective camera with this frame and a view rectangle at `distance` from the eye, the focal length.
    ///
    /// ```
    /// use eyeray::{Frame, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let frame = Frame::look_to(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z, Vec3::Y)?;
    /// let camera = frame.perspective(ViewRect::centered(4.0, 3.0), 2.0)?;
    /// assert_eq!(camera.ray(vec2(1.0, 0.5)).direction, vec3(1.0, 0.5, -2.0));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If the view rectangle is not finite or is empty, or the distance is not finite or not positive.
    pub fn perspective(
        &self,
        view: ViewRect<V::Scalar>,
        distance: V::Scalar,
    ) -> Result<Camera<V>, CameraError> {
        let distance: f64 = distance.into();
        if !distance.is_finite() {
            return Err(CameraError::NotFinite(CameraArgument::Distance));
        }
        if distance <= 0.0 {
            return Err(CameraError::DistanceNotPositive);
        }
        self.camera(view.map(Into::into), Projection::Perspective { distance })
    }

    /// Creates a perspective camera with this frame, the vertical field of view `fov_y`, in radians, and the aspect ratio
    /// `aspect`, width over height.
    ///
    /// The view rectangle is centered, at distance 1: its top is `tan(fov_y / 2)`, its right `aspect` times that.
    ///
    /// The tangent is the standard library's, whose last bit may differ between platforms, or with this crate's
    /// feature `libm` that of the libm crate, the same on every machine.
    ///
    /// ```
    /// use core::f32::consts::FRAC_PI_2;
    /// use eyeray::Frame;
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let frame = Frame::look_to(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)?;
    /// let camera = frame.perspective_fov(FRAC_PI_2, 1.5)?;
    /// let corner = camera.pixel_ray(vec2(0.0, 0.0), 300, 200);
    /// assert!((corner.direction - Vec3::new(-1.5, 1.0, -1.0)).length() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, `fov_y` is not between 0 and π, both excluded, or `aspect` is not positive. Also if the
    /// view rectangle of such an angle and aspect ratio would be too wide for `f64`, or so narrow that its width is zero.
    #[doc(alias("field_of_view", "vfov"))]
    pub fn perspective_fov(
        &self,
        fov_y: V::Scalar,
        aspect: V::Scalar,
    ) -> Result<Camera<V>, CameraError> {
        let (fov_y, aspect): (f64, f64) = (fov_y.into(), aspect.into());
        if !fov_y.is_finite() {
            return Err(CameraError::NotFinite(CameraArgument::FovY));
        }
        if fov_y <= 0.0 || fov_y >= core::f64::consts::PI {
            return Err(CameraError::FovOutOfRange);
        }
        if aspect <= 0.0 {
            return Err(CameraError::AspectNotPositive);
        }
        let top = tan(fov_y / 2.0);
        let right = aspect * top;
        // Twice it is the width of the view.
        if !(2.0 * right).is_finite() {
            return Err(CameraError::NotFinite(CameraArgument::Aspect));
        }
        let view = ViewRect { left: -right, right, bottom: -top, top };
        self.camera(view, Projection::Perspective { distance: 1.0 })
    }

    /// The camera with this frame, or an error if the view rectangle is invalid.
    pub(crate) fn camera(
        &self,
        view: ViewRect<f64>,
        projection: Projection,
    ) -> Result<Camera<V>, CameraError> {
        // If a side is infinite or NaN, the width or the height is so too.
        if !(view.width().is_finite() && view.height().is_finite()) {
            return Err(CameraError::NotFinite(CameraArgument::View));
        }
        if view.left >= view.right || view.bottom >= view.top {
            return Err(CameraError::EmptyView);
        }
        Ok(Camera { frame: *self, view, projection })
    }
}

/// The vector in f64, if it is finite.
fn finite<V: Vector>(vector: V, argument: CameraArgument) -> Result<DVec3, CameraError> {
    let vector = vector.to_f64();
    vector.is_finite().then_some(vector).ok_or(CameraError::NotFinite(argument))
}

/// Formats the eye and the basis, in `f64`.
impl<V: Vector> Debug for Frame<V> {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let Self { eye, u, v, w, precision: _ } = self;
        f.debug_struct("Frame").field("eye", eye).field("u", u).field("v", v).field("w", w).finish()
    }
}
