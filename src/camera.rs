//! The camera: which ray belongs to which point of the image.
//!
//! The lecture's frame: the eye e, and the basis u (to the right), v (up), w (backwards) from `basis.rs`. The image is
//! the view rectangle in the plane of u and v, as S. Marschner's CS4620 lecture 6 has it:
//!
//! ```text
//!     orthographic    s = e + u U + v V           p = s    d = -W
//!     perspective     s = e + u U + v V - d W     p = e    d = s - e
//! ```

use core::iter::FusedIterator;
use core::marker::PhantomData;
use core::ops::Range;

use glam::{DVec2, DVec3};

use crate::arithmetic::scaling::{exponent, scale};
use crate::basis::basis;
use crate::float::tan;
use crate::{CameraError, Ray, Scalar, Vector, ViewRect};

/// A camera: makes the eye ray through each point of an image.
///
/// It stands at the eye e and has three unit vectors at right angles to one another, its [basis](Self::basis): U to the
/// right, V up, and W backwards, against the direction of view. A point (u, v) of the view plane lies u along U and v
/// along V from the point straight ahead of the eye; the image shows the part of that plane in the
/// [view rectangle](ViewRect).
///
/// - **Orthographic**: the eye lies in the view plane. Each ray begins at a point s of that plane, and all are parallel.
/// - **Perspective**: the view plane is ahead of the eye, at a distance, the focal length. Each ray begins at the eye and
///   goes through a point s of that plane. Its direction is not unit, so that `t = 1` is the view plane.
///
/// ```text
/// orthographic    s = e + u U + v V                 origin s,  direction -W
/// perspective     s = e + u U + v V - distance W    origin e,  direction s - e
/// ```
///
#[doc = include_str!("diagrams/orthographic.svg")]
#[doc = include_str!("diagrams/perspective.svg")]
///
/// ```
/// use eyeray::{Camera, ViewRect};
/// use glam::{Vec3, vec2, vec3};
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// // From (0, 0, 5) towards the origin, through a window of 4 by 3 at distance 2.
/// let view = ViewRect::centered(4.0, 3.0);
/// let camera = Camera::perspective(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view, 2.0)?;
///
/// let ray = camera.ray(vec2(1.0, 0.5));
/// assert_eq!(ray.origin, vec3(0.0, 0.0, 5.0));
/// assert_eq!(ray.direction, vec3(1.0, 0.5, -2.0));
///
/// // Twice as far away, the same ray passes the same point of the view plane.
/// assert_eq!(camera.project(ray.at(2.0)), Some(vec2(1.0, 0.5)));
/// # Ok(())
/// # }
/// ```
///
/// # Accuracy
///
/// A camera computes in `f64` and rounds to the precision of `V` at the end; what would be beyond the largest finite value
/// is infinite. Each ray of [`ray`](Self::ray) is the exact one of the given values, up to this:
///
/// - With [`Vec3`](glam::Vec3), wherever in the scene the camera stands and however near to the view its up vector is, the
///   direction is off by less than 1 ulp of its length, and the origin by less than 1 ulp of its largest coordinate plus
///   2⁻⁵⁰ (|e| + |u| + |v|). The second term shows only where the three cancel to 2⁻²⁷ of that.
/// - With [`DVec3`](glam::DVec3) the direction is within 7 ulp of its length.
///
/// `cargo test --test camera accuracy` compares both with exact integers.
///
/// There is nothing in it but sums, products, quotients and square roots, so a camera is the same on every machine, unless
/// the tangent of [`perspective_fov`](Self::perspective_fov) is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera<V: Vector = glam::Vec3> {
    pub(crate) eye: DVec3,
    pub(crate) u: DVec3,
    pub(crate) v: DVec3,
    pub(crate) w: DVec3,
    pub(crate) view: ViewRect<f64>,
    pub(crate) projection: Projection,
    pub(crate) precision: PhantomData<V>,
}

/// How the points of the view plane become rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Projection {
    Orthographic,
    Perspective { distance: f64 },
}

impl<V: Vector> Camera<V> {
    /// The orthographic camera at `eye`, looking to `target`, with `up` upwards in the image.
    ///
    /// Only directions count: from the eye to `target`, and of `up`, which need not be at a right angle to the view.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect { left: -2.0, right: 2.0, bottom: 0.0, top: 3.0 };
    /// let camera = Camera::orthographic(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view)?;
    ///
    /// let ray = camera.ray(vec2(1.0, 0.5));
    /// assert_eq!(ray.origin, vec3(1.0, 0.5, 5.0));
    /// assert_eq!(ray.direction, vec3(0.0, 0.0, -1.0));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, the eye is at the target, `up` is zero or parallel to the view, or the view
    /// rectangle is empty.
    pub fn orthographic(
        eye: V,
        target: V,
        up: V,
        view: ViewRect<V::Scalar>,
    ) -> Result<Self, CameraError> {
        Self::new(eye, target, up, widened(view), Projection::Orthographic)
    }

    /// The perspective camera at `eye`, looking to `target`, with `up` upwards in the image, through a view rectangle at
    /// `distance` from the eye: the focal length.
    ///
    /// Only directions count: from the eye to `target`, which need not be in the view plane, and of `up`, which need not be
    /// at a right angle to the view.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// // The right half of a picture: the view rectangle begins straight ahead.
    /// let view = ViewRect { left: 0.0, right: 2.0, bottom: -1.5, top: 1.5 };
    /// let camera = Camera::perspective(Vec3::ZERO, Vec3::X, Vec3::Z, view, 4.0)?;
    /// assert_eq!(camera.basis(), [Vec3::NEG_Y, Vec3::Z, Vec3::NEG_X]);
    /// assert_eq!(camera.ray(vec2(2.0, 1.5)).direction, vec3(4.0, -2.0, 1.5));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, the eye is at the target, `up` is zero or parallel to the view, the view rectangle
    /// is empty, or the distance is not positive.
    pub fn perspective(
        eye: V,
        target: V,
        up: V,
        view: ViewRect<V::Scalar>,
        distance: V::Scalar,
    ) -> Result<Self, CameraError> {
        let distance: f64 = distance.into();
        if !distance.is_finite() {
            return Err(CameraError::NotFinite("distance"));
        }
        if distance <= 0.0 {
            return Err(CameraError::DistanceNotPositive);
        }
        Self::new(eye, target, up, widened(view), Projection::Perspective { distance })
    }

    /// The perspective camera whose image spans the angle `fov_y`, in radians, from bottom to top, and is `aspect` times
    /// as wide as high.
    ///
    /// Its view rectangle is centered, at distance 1: its top is `tan(fov_y / 2)`, its right `aspect` times that.
    ///
    /// The tangent is the standard library's, whose last bit may differ between platforms, or with this crate's
    /// feature `libm` that of the libm crate, the same on every machine.
    ///
    /// ```
    /// use core::f32::consts::FRAC_PI_2;
    /// use eyeray::Camera;
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let camera = Camera::perspective_fov(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2, 1.5)?;
    /// let corner = camera.pixel_ray(vec2(0.0, 0.0), 300, 200);
    /// assert!((corner.direction - Vec3::new(-1.5, 1.0, -1.0)).length() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If an argument is not finite, the eye is at the target, `up` is zero or parallel to the view, `fov_y` is not
    /// between 0 and π, both excluded, or `aspect` is not positive. Also if the view rectangle of such an angle and
    /// aspect would be too wide for `f64`, or so narrow that its width is zero.
    pub fn perspective_fov(
        eye: V,
        target: V,
        up: V,
        fov_y: V::Scalar,
        aspect: V::Scalar,
    ) -> Result<Self, CameraError> {
        let (fov_y, aspect): (f64, f64) = (fov_y.into(), aspect.into());
        if !fov_y.is_finite() {
            return Err(CameraError::NotFinite("fov_y"));
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
            return Err(CameraError::NotFinite("aspect"));
        }
        let view = ViewRect { left: -right, right, bottom: -top, top };
        Self::new(eye, target, up, view, Projection::Perspective { distance: 1.0 })
    }

    fn new(
        eye: V,
        target: V,
        up: V,
        view: ViewRect<f64>,
        projection: Projection,
    ) -> Result<Self, CameraError> {
        let (eye, target, up) = (eye.to_f64(), target.to_f64(), up.to_f64());
        for (name, vector) in [("eye", eye), ("target", target), ("up", up)] {
            if !vector.is_finite() {
                return Err(CameraError::NotFinite(name));
            }
        }
        // An infinite or NaN edge makes the width or the height so as well.
        if !(view.width().is_finite() && view.height().is_finite()) {
            return Err(CameraError::NotFinite("view"));
        }
        if view.left >= view.right || view.bottom >= view.top {
            return Err(CameraError::EmptyView);
        }
        let [u, v, w] = basis(eye, target, up)?;
        Ok(Self { eye, u, v, w, view, projection, precision: PhantomData })
    }

    /// The eye ray through the point (u, v) of the view plane, which need not be inside the view rectangle.
    ///
    /// A u or v that is a NaN or infinite gives a ray that is not finite, which meets nothing.
    ///
    /// ```
    /// use eyeray::{Camera, Hittable, Sphere, ViewRect};
    /// use glam::{Vec2, Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// let camera = Camera::perspective(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view, 2.0)?;
    /// let sphere = Sphere::new(Vec3::ZERO, 1.0);
    /// let hit = sphere.intersect(&camera.ray(Vec2::ZERO), 0.0..f32::INFINITY);
    /// assert_eq!(hit.map(|hit| hit.t), Some(2.0));
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn ray(&self, uv: V::Vec2) -> Ray<V> {
        self.ray_through(V::vec2_to_f64(uv))
    }

    #[inline]
    fn ray_through(&self, uv: DVec2) -> Ray<V> {
        let in_plane = uv.x * self.u + uv.y * self.v;
        let (origin, direction) = match self.projection {
            Projection::Orthographic => (self.eye + in_plane, -self.w),
            // s - e, without the eye: to add and subtract it would cost the digits that it has before s.
            Projection::Perspective { distance } => (self.eye, in_plane - distance * self.w),
        };
        Ray::new(V::from_f64(origin), V::from_f64(direction))
    }

    /// The eye ray through a point of an image of `width` by `height` pixels that shows the view rectangle.
    ///
    /// The point (x, y) counts in pixels, rightwards and downwards from the top left corner of the image, so the center of
    /// the first pixel is (0.5, 0.5) and the bottom right corner is (`width`, `height`). In the view plane it is
    /// `u = left + (right - left) x / width` and `v = top - (top - bottom) y / height`.
    ///
    /// The point may be anywhere inside a pixel, as antialiasing wants it, and outside the image as well. A `width` or
    /// `height` of 0 counts as 1. A NaN or an infinity gives a ray that is not finite, which meets nothing.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view, 1.0)?;
    /// // The top left corner of the image is that of the view rectangle.
    /// assert_eq!(camera.pixel_ray(vec2(0.0, 0.0), 640, 480), camera.ray(vec2(-2.0, 1.5)));
    /// assert_eq!(camera.pixel_ray(vec2(320.0, 240.0), 640, 480), camera.ray(vec2(0.0, 0.0)));
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn pixel_ray(&self, pixel: V::Vec2, width: u32, height: u32) -> Ray<V> {
        self.ray_through_pixel(V::vec2_to_f64(pixel), width, height)
    }

    #[inline]
    fn ray_through_pixel(&self, pixel: DVec2, width: u32, height: u32) -> Ray<V> {
        let view = &self.view;
        let u = view.left + view.width() * (pixel.x / f64::from(width.max(1)));
        let v = view.top - view.height() * (pixel.y / f64::from(height.max(1)));
        // An overflow stops at the largest value: infinity times a zero coordinate of the basis would be a NaN.
        self.ray_through(DVec2::new(u, v).clamp(DVec2::MIN, DVec2::MAX))
    }

    /// The rays through the centers of all pixels of an image, row by row from the top, each row from the left.
    ///
    /// The ray of the pixel in column i and row j is that of [`pixel_ray`](Self::pixel_ray) at (i + 0.5, j + 0.5).
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(3.0, 2.0);
    /// let camera = Camera::orthographic(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view)?;
    /// let origins: Vec<Vec3> = camera.rays(3, 2).map(|ray| ray.origin).collect();
    /// assert_eq!(origins.len(), 6);
    /// assert_eq!(origins[0], Vec3::new(-1.0, 0.5, 0.0));
    /// assert_eq!(origins[5], Vec3::new(1.0, -0.5, 0.0));
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn rays(&self, width: u32, height: u32) -> Rays<V> {
        Rays { camera: *self, width, height, pixels: 0..u64::from(width) * u64::from(height) }
    }

    /// The point (u, v) of the view plane whose eye ray reaches `point`: the inverse of [`ray`](Self::ray).
    ///
    /// `None` where no eye ray reaches the point:
    ///
    /// - in perspective at the eye, and beside or behind it;
    /// - orthographically behind the view plane, and on it, for a ray begins there but reaches only what has `t > 0`;
    /// - if the point is not finite, or u or v would not be.
    ///
    /// Which side of the eye a point is on is decided in `f64`: if it is nearer to the plane through the eye, at right
    /// angles to the view, than 2⁻⁵⁰ of its distance from the eye, rounding may say either.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view, 2.0)?;
    /// assert_eq!(camera.project(vec3(3.0, -1.5, -6.0)), Some(vec2(1.0, -0.5)));
    /// assert_eq!(camera.project(vec3(3.0, -1.5, 6.0)), None);
    /// # Ok(())
    /// # }
    /// ```
    pub fn project(&self, point: V) -> Option<V::Vec2> {
        let point = point.to_f64();
        if !point.is_finite() {
            return None;
        }
        // Shrunk if their difference, or a dot product of it, could overflow.
        let shrink = if largest(point - self.eye) < HUGE { 1.0 } else { SHRINK };
        let from_eye = point * shrink - self.eye * shrink;
        let uv = match self.projection {
            Projection::Orthographic => {
                let reached = -from_eye.dot(self.w) > 0.0;
                reached.then(|| self.in_plane(from_eye) / shrink)?
            }
            Projection::Perspective { distance } => {
                // Only its direction counts: where it is tiny, its products with the basis would lose digits.
                let exponent = exponent(largest(from_eye));
                let from_eye = DVec3::from_array(
                    from_eye.to_array().map(|coordinate| scale(coordinate, -exponent)),
                );
                let depth = -from_eye.dot(self.w);
                (depth > 0.0).then(|| self.in_plane(from_eye) / depth * distance)?
            }
        };
        let uv = V::vec2_from_f64(uv);
        V::vec2_to_f64(uv).is_finite().then_some(uv)
    }

    /// How far `vector` goes along U and V.
    fn in_plane(&self, vector: DVec3) -> DVec2 {
        DVec2::new(vector.dot(self.u), vector.dot(self.v))
    }

    /// The unit vectors U (to the right), V (up) and W (backwards), at right angles to one another.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// // Up need not be at a right angle to the view.
    /// let (eye, up) = (vec3(7.0, 0.0, 0.0), vec3(3.0, 0.0, 1.0));
    /// let camera = Camera::orthographic(eye, Vec3::ZERO, up, view)?;
    /// assert_eq!(camera.basis(), [Vec3::Y, Vec3::Z, Vec3::X]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn basis(&self) -> [V; 3] {
        [self.u, self.v, self.w].map(V::from_f64)
    }

    /// The eye: where the camera stands.
    pub fn eye(&self) -> V {
        V::from_f64(self.eye)
    }

    /// The view rectangle.
    pub fn view(&self) -> ViewRect<V::Scalar> {
        let ViewRect { left, right, bottom, top } = self.view;
        let [left, right, bottom, top] = [left, right, bottom, top].map(V::Scalar::from_f64);
        ViewRect { left, right, bottom, top }
    }

    /// The distance from the eye to the view plane, or `None` for an orthographic camera.
    pub fn distance(&self) -> Option<V::Scalar> {
        match self.projection {
            Projection::Orthographic => None,
            Projection::Perspective { distance } => Some(V::Scalar::from_f64(distance)),
        }
    }
}

/// 2^1000: what is below can be multiplied by unit vectors and summed up without overflow.
const HUGE: f64 = f64::from_bits(0x7e70_0000_0000_0000);

/// 2^-64: brings any point below [`HUGE`].
const SHRINK: f64 = f64::from_bits(0x3bf0_0000_0000_0000);

/// The largest coordinate, sign apart.
fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}

/// The same rectangle in f64.
fn widened<S: Scalar>(view: ViewRect<S>) -> ViewRect<f64> {
    let ViewRect { left, right, bottom, top } = view;
    ViewRect { left: left.into(), right: right.into(), bottom: bottom.into(), top: top.into() }
}

/// The rays of an image, row by row: see [`Camera::rays`].
///
/// Its length is exact, except where `usize` cannot hold it, on targets of less than 64 bits: there `len` is
/// `usize::MAX`. `nth` takes no longer than `next`.
#[derive(Clone, Debug)]
pub struct Rays<V: Vector = glam::Vec3> {
    camera: Camera<V>,
    width: u32,
    height: u32,
    /// What is left of the pixels, counted row by row.
    pixels: Range<u64>,
}

impl<V: Vector> Rays<V> {
    #[inline]
    fn ray(&self, index: u64) -> Ray<V> {
        let width = u64::from(self.width);
        // Both are below 2^32: exact.
        #[expect(clippy::cast_precision_loss, reason = "columns and rows are below 2^32")]
        let corner = DVec2::new((index % width) as f64, (index / width) as f64);
        self.camera.ray_through_pixel(corner + 0.5, self.width, self.height)
    }
}

impl<V: Vector> Iterator for Rays<V> {
    type Item = Ray<V>;

    #[inline]
    fn next(&mut self) -> Option<Ray<V>> {
        self.pixels.next().map(|index| self.ray(index))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Ray<V>> {
        self.pixels.nth(n).map(|index| self.ray(index))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.pixels.size_hint()
    }
}

impl<V: Vector> DoubleEndedIterator for Rays<V> {
    #[inline]
    fn next_back(&mut self) -> Option<Ray<V>> {
        self.pixels.next_back().map(|index| self.ray(index))
    }

    #[inline]
    fn nth_back(&mut self, n: usize) -> Option<Ray<V>> {
        self.pixels.nth_back(n).map(|index| self.ray(index))
    }
}

impl<V: Vector> ExactSizeIterator for Rays<V> {
    #[inline]
    fn len(&self) -> usize {
        self.pixels.size_hint().0
    }
}

impl<V: Vector> FusedIterator for Rays<V> {}
