//! The camera: the eye ray of a point of the image, and the point of the image of a point of the scene.
//!
//! The camera frame is the eye e and the basis U (to the right), V (up), W (backwards). The image is the view rectangle in the
//! plane of U and V, as in S. Marschner's CS4620 lecture 6:
//!
//! ```text
//!     orthographic    s = e + u U + v V           p = s    d = -W
//!     perspective     s = e + u U + v V - d W     p = e    d = s - e
//! ```
//!
//! | file | what |
//! |---|---|
//! | `frame` | e, U, V and W, and the cameras created from them |
//! | `basis` | U, V and W from the direction of view and the up vector |
//! | `view_rect` | the view rectangle |
//! | `pixels` | from a pixel to (u, v) |
//! | `image` | the rays of an image's pixels |
//! | `rays` | an iterator over the rays of all pixels |
//! | `tiles` | an iterator over the tiles of an image |
//! | `matrices` | from view and projection matrices, and to view matrices |
//! | `projection` | from a point of the scene to (u, v) |
//! | `error` | the error type |

mod basis;
mod error;
mod frame;
mod image;
mod matrices;
mod pixels;
mod projection;
mod rays;
mod tiles;
mod view_rect;

use glam::{DVec2, DVec3};

pub use error::{CameraArgument, CameraError};
pub use frame::Frame;
pub use rays::Rays;
pub use tiles::{Tile, Tiles};
pub use view_rect::ViewRect;

use crate::{Ray, Scalar, Vector};
use pixels::Axis;

/// An orthographic or perspective camera: creates eye rays from pixels, and projects points of the scene to pixels.
///
/// Eye rays are used for rendering, and for picking: [`pixel_ray`](Self::pixel_ray) of the position of the mouse is the ray to
/// intersect with the scene. Projections are used for labels and markers: see [`project_to_pixel`](Self::project_to_pixel).
///
/// A camera has a [`Frame`]: the eye e and an orthonormal [basis](Self::basis), with U to the right, V up, and W backwards,
/// against the direction of view. A point (u, v) of the view plane is u along U and v along V from the point straight ahead of
/// the eye. The image shows the part of this plane inside the [view rectangle](ViewRect).
///
/// - **Orthographic**: the eye is in the view plane. Each ray starts at a point s of this plane, and all rays are parallel.
///   Objects behind the view plane are not visible. Moving the eye back, against the direction of view, makes them visible, and
///   changes nothing else in the image.
/// - **Perspective**: the view plane is ahead of the eye, at a distance, the focal length. Each ray starts at the eye and
///   goes through a point s of this plane. Its direction is not a unit vector: `t = 1` is the view plane.
///
/// ```text
/// orthographic    s = e + u U + v V                 origin s,  direction -W
/// perspective     s = e + u U + v V - distance W    origin e,  direction s - e
/// ```
///
#[doc = include_str!("../diagrams/orthographic.svg")]
#[doc = include_str!("../diagrams/perspective.svg")]
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
/// // Every point along the ray is projected to the same (u, v).
/// assert_eq!(camera.project(ray.at(2.0)), Some(vec2(1.0, 0.5)));
/// # Ok(())
/// # }
/// ```
///
/// The first three constructors take a target to look at. For a direction of view, or for several cameras with the same frame,
/// start with a [`Frame`]. [`from_matrices`](Self::from_matrices) takes the view and the projection matrix of a renderer.
///
/// # Depth of field
///
/// With the view plane at the focus distance, a thin lens takes a few lines, because each ray passes its point of the view plane
/// at `t = 1`, wherever on the lens it starts:
///
/// ```
/// use eyeray::{Camera, Ray};
/// use glam::{Vec2, Vec3};
///
/// /// Returns the ray of a pixel that starts at the point `lens` of the lens, along U and V.
/// fn lens_ray(camera: &Camera, pixel: Vec2, width: u32, height: u32, lens: Vec2) -> Ray {
///     let Ray { origin, direction } = camera.pixel_ray(pixel, width, height);
///     let [u, v, _] = camera.basis();
///     let offset = lens.x * u + lens.y * v;
///     Ray::new(origin + offset, direction - offset)
/// }
/// # let view = eyeray::ViewRect::centered(4.0, 3.0);
/// # let camera = Camera::perspective(Vec3::Z, Vec3::ZERO, Vec3::Y, view, 8.0);
/// # let camera = camera.expect("a camera");
/// # let (pixel, lens) = (Vec2::new(160.0, 40.0), Vec2::new(0.25, -0.5));
/// # let ray = lens_ray(&camera, pixel, 640, 480, lens);
/// # assert_eq!(ray.at(1.0), camera.pixel_ray(pixel, 640, 480).at(1.0));
/// # assert_eq!(ray.origin, Vec3::new(0.25, -0.5, 1.0));
/// ```
///
/// # Normalized device coordinates
///
/// Normalized device coordinates, with x to the right and y upwards, each from -1 to 1, are pixels of an image of 2 by 2:
///
/// ```
/// # use eyeray::{Camera, CameraError, ViewRect};
/// # use glam::{Vec3, vec2};
/// # fn main() -> Result<(), CameraError> {
/// # let view = ViewRect::centered(4.0, 3.0);
/// # let camera = Camera::perspective(Vec3::Z, Vec3::ZERO, Vec3::Y, view, 1.0)?;
/// let ndc = vec2(-1.0, 1.0);
/// let ray = camera.pixel_ray(vec2(1.0 + ndc.x, 1.0 - ndc.y), 2, 2);
/// assert_eq!(ray, camera.ray(vec2(-2.0, 1.5)));
/// # Ok(())
/// # }
/// ```
///
/// # Logical pixels
///
/// The position of a mouse is often given in logical pixels, and the size of the window, too, which then need not be a whole
/// number. The position divided by the size is a pixel of an image of 1 by 1:
///
/// ```
/// # use eyeray::{Camera, CameraError, ViewRect};
/// # use glam::{Vec3, vec2};
/// # fn main() -> Result<(), CameraError> {
/// # let view = ViewRect::centered(4.0, 3.0);
/// # let camera = Camera::perspective(Vec3::Z, Vec3::ZERO, Vec3::Y, view, 1.0)?;
/// let (cursor, size) = (vec2(266.75, 600.25), vec2(1067.0, 800.333_3));
/// let ray = camera.pixel_ray(cursor / size, 1, 1);
/// # assert!((ray.direction - camera.ray(vec2(-1.0, -0.75)).direction).length() < 1e-6);
/// # Ok(())
/// # }
/// ```
///
/// # Which precision
///
/// `f32` is precise enough within some thousand times the size of the scene's smallest detail from the world's origin. There is
/// no `f32` between 10⁷ and 10⁷ + 1: for an orthographic camera there, with pixels of a millimeter, the rays of a thousand pixels
/// start at the same point. Use [`DVec3`](glam::DVec3) for such cameras, or move the world's origin to the camera.
/// `Camera::<DVec3>::from` converts a camera to `f64`, exactly.
///
/// # Accuracy
///
/// A camera computes in `f64` and rounds to the precision of `V` at the end. A coordinate beyond the largest finite value
/// becomes infinite. Each ray of [`ray`](Self::ray) and of [`pixel_ray`](Self::pixel_ray) is the exact one for the given
/// values, up to these bounds:
///
/// - With [`Vec3`](glam::Vec3), wherever in the scene the camera stands and however near to the view its up vector is, the
///   direction is off by less than 1 ulp of its length, and the origin by less than 1 ulp of its largest coordinate plus
///   2⁻⁵⁰ (|e| + |u| + |v|). The second term shows only where the three cancel to 2⁻²⁷ of that.
/// - With [`DVec3`](glam::DVec3) the direction is within 7 ulp of its length, and the origin within
///   6 · 2⁻⁵³ (|e| + |u| + |v|).
///
/// A sum or a product that leaves the range of `f64` on the way is outside of these bounds: with `DVec3`, a pixel narrower than
/// 2⁻⁹⁰⁰, or a coordinate beyond 2¹⁰²⁰.
///
/// For `pixel_ray` this holds in images of up to 2²⁴ pixels a side and as far around them, where the direction, or
/// |e| + |u| + |v|, is at least an eighth of a pixel long. At the center of a pixel it holds however short they are, so that the
/// middle of a centered view is exactly straight ahead.
///
/// A projected point is rounded once, from an `f64` with at most the following error, where h = 2⁻⁵³ and f is the vector from the
/// eye to the point:
///
/// - [`depth`](Self::depth), and u and v of an orthographic camera, by 5 h |f|;
/// - u and v of a perspective camera by 6 h L (1 + L / distance), with L the length of the direction of the ray that reaches the
///   point: small unless the point is far from the middle of the view;
/// - [`project_to_pixel`](Self::project_to_pixel) by the error of u or v, in pixels, and by 4 h of itself.
///
/// `cargo test --test camera accuracy` compares all of them with exact integer arithmetic.
///
/// A camera uses only sums, products, quotients and square roots, so it is the same on every machine. The exception is the
/// tangent of [`perspective_fov`](Self::perspective_fov), which is the same on every machine with the feature `libm`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera<V: Vector = glam::Vec3> {
    pub(crate) frame: Frame<V>,
    pub(crate) view: ViewRect<f64>,
    pub(crate) projection: Projection,
}

/// The kind of projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Projection {
    Orthographic,
    Perspective { distance: f64 },
}

impl<V: Vector> Camera<V> {
    /// Creates an orthographic camera at `eye` that looks at `target`, with `up` upwards in the image.
    ///
    /// Short for [`Frame::look_at`] and [`Frame::orthographic`]. Only the direction from the eye to `target` counts, and only the
    /// direction of `up`, which need not be at a right angle to the view.
    /// [`Frame`] says what to pass as `up` when looking straight down.
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
    #[doc(alias("look_at", "parallel"))]
    pub fn orthographic(
        eye: V,
        target: V,
        up: V,
        view: ViewRect<V::Scalar>,
    ) -> Result<Self, CameraError> {
        Frame::look_at(eye, target, up)?.orthographic(view)
    }

    /// Creates a perspective camera at `eye` that looks at `target`, with `up` upwards in the image, through a view rectangle at
    /// `distance`, the focal length.
    ///
    /// Short for [`Frame::look_at`] and [`Frame::perspective`]. Only the direction from the eye to `target` counts, which need
    /// not be in the view plane, and only the direction of `up`, which need not be at a right angle to the view. [`Frame`] says
    /// what to pass as `up` when looking straight down.
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
    #[doc(alias = "look_at")]
    pub fn perspective(
        eye: V,
        target: V,
        up: V,
        view: ViewRect<V::Scalar>,
        distance: V::Scalar,
    ) -> Result<Self, CameraError> {
        Frame::look_at(eye, target, up)?.perspective(view, distance)
    }

    /// Creates a perspective camera at `eye` that looks at `target`, with `up` upwards in the image, with the vertical field of
    /// view `fov_y`, in radians, and the aspect ratio `aspect`, width over height.
    ///
    /// Short for [`Frame::look_at`] and [`Frame::perspective_fov`], where the view rectangle and the tangent are described.
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
    /// aspect ratio would be too wide for `f64`, or so narrow that its width is zero.
    #[doc(alias("look_at", "field_of_view", "vfov"))]
    pub fn perspective_fov(
        eye: V,
        target: V,
        up: V,
        fov_y: V::Scalar,
        aspect: V::Scalar,
    ) -> Result<Self, CameraError> {
        Frame::look_at(eye, target, up)?.perspective_fov(fov_y, aspect)
    }

    /// Returns the eye ray through the point (u, v) of the view plane, which need not be inside the view rectangle.
    ///
    /// If u or v is NaN or infinite, the ray is not finite, and hits nothing. No coordinate of a direction is -0, except where a
    /// negative one underflows.
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
    #[must_use]
    #[doc(alias("generate_ray", "eye_ray", "primary_ray", "camera_ray"))]
    pub fn ray(&self, uv: V::Vec2) -> Ray<V> {
        let DVec2 { x: u, y: v } = V::vec2_to_f64(uv);
        self.ray_in_row(self.common(), self.row(v), u)
    }

    /// The part that the eye rays of one v share: v V, and in perspective all of s - e but u U.
    #[inline]
    fn row(&self, v: f64) -> DVec3 {
        let in_plane = v * self.frame.v;
        match self.projection {
            Projection::Orthographic => in_plane,
            // Subtracted from 0, which gives 0 and not -0, so that no sum with it is -0.
            Projection::Perspective { distance } => {
                (DVec3::ZERO - distance * self.frame.w) + in_plane
            }
        }
    }

    /// The part that all eye rays share: their direction -W, or in perspective their origin.
    #[inline]
    fn common(&self) -> V {
        V::from_f64(match self.projection {
            Projection::Orthographic => DVec3::ZERO - self.frame.w,
            Projection::Perspective { .. } => self.frame.eye,
        })
    }

    /// The eye ray of that row through u.
    #[inline]
    fn ray_in_row(&self, common: V, row: DVec3, u: f64) -> Ray<V> {
        let s = row + u * self.frame.u;
        match self.projection {
            Projection::Orthographic => Ray::new(V::from_f64(self.frame.eye + s), common),
            // s - e, without the eye: to add and subtract it would cost the digits that it has before s.
            Projection::Perspective { .. } => Ray::new(common, V::from_f64(s)),
        }
    }

    /// Returns the eye ray through a point of an image of `width` by `height` pixels that shows the view rectangle.
    ///
    /// The point (x, y) is given in pixels, rightwards and downwards from the top left corner of the image: the center of the
    /// first pixel is (0.5, 0.5), and the bottom right corner is (`width`, `height`). In the view plane it is
    /// `u = left + (right - left) x / width` and `v = top - (top - bottom) y / height`.
    ///
    /// The point may be anywhere inside a pixel, for antialiasing, or outside the image. A `width` or `height` of 0 counts as 1.
    /// If x or y is NaN or infinite, the ray is not finite, and hits nothing.
    ///
    /// For picking, pass the position of the mouse, and intersect the ray with the scene.
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
    #[must_use]
    #[doc(alias(
        "unproject",
        "viewport_to_world",
        "screen_to_world",
        "screen_point_to_ray",
        "picking"
    ))]
    pub fn pixel_ray(&self, pixel: V::Vec2, width: u32, height: u32) -> Ray<V> {
        let DVec2 { x, y } = V::vec2_to_f64(pixel);
        let [columns, rows] = self.axes(width, height);
        self.ray_in_row(self.common(), self.row(rows.at(y)), columns.at(x))
    }

    /// The axes of an image along the sides of the view rectangle: rightwards and downwards.
    #[inline]
    fn axes(&self, width: u32, height: u32) -> [Axis; 2] {
        let ViewRect { left, right, bottom, top } = self.view;
        [Axis::new(left, right, width), Axis::new(top, bottom, height)]
    }

    /// Returns an iterator over the rays through the centers of all pixels of an image, row by row from the top, each row from
    /// the left.
    ///
    /// The ray of the pixel in column i and row j is the same as [`pixel_ray`](Self::pixel_ray) at (i + 0.5, j + 0.5), and takes
    /// less time.
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
        Rays::new(self, width, height)
    }

    /// Returns an iterator over the tiles of an image of `width` by `height` pixels: squares of `side` by `side` pixels, row by
    /// row from the top, each row from the left.
    ///
    /// Tiles are used to ask a collection of spheres for the hits of many rays at once, which takes less time where the rays lie
    /// together, and to share an image among threads. At the right and at the bottom edge of the image, tiles have the pixels
    /// that are left. A `side` of 0 counts as 1.
    ///
    /// A side of 8 gives 64 rays a tile. In larger tiles, too, every 64 rays lie together: see [`Tile::pixels`].
    ///
    /// ```
    /// use eyeray::{Camera, Hittable, Ray, Sphere};
    /// use glam::Vec3;
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let (width, height) = (20, 12);
    /// let camera = Camera::perspective_fov(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y, 0.9, 5.0 / 3.0)?;
    /// let sphere = Sphere::new(Vec3::ZERO, 1.0);
    ///
    /// let mut depths = vec![f32::INFINITY; 20 * 12];
    /// let mut rays = [Ray::default(); 64];
    /// for tile in camera.tiles(width, height, 8) {
    ///     let count = tile.rays().len();
    ///     for (place, ray) in rays.iter_mut().zip(tile.rays()) {
    ///         *place = ray;
    ///     }
    ///     for ((x, y), ray) in tile.pixels().zip(&rays[..count]) {
    ///         if let Some(hit) = sphere.intersect(ray, 0.0..f32::INFINITY) {
    ///             depths[(y * width + x) as usize] = hit.t;
    ///         }
    ///     }
    /// }
    /// assert!(depths[6 * 20 + 10] < 3.0);
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn tiles(&self, width: u32, height: u32, side: u32) -> Tiles<V> {
        Tiles::new(self, width, height, side)
    }

    /// Returns the point (u, v) of the view plane whose eye ray reaches `point`: the inverse of [`ray`](Self::ray).
    ///
    /// Returns `None` if no eye ray reaches the point:
    ///
    /// - for a perspective camera, if the point is the eye, or beside or behind it;
    /// - for an orthographic camera, if it is behind the view plane or in it, where rays start but have `t = 0`;
    /// - if the point is not finite, or u or v would not be.
    ///
    /// Whether a point is ahead of the eye is decided in `f64`. If its distance from the plane through the eye, at right angles
    /// to the view, is less than 2⁻⁵⁰ of its distance from the eye, rounding may decide either way.
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
    #[must_use]
    pub fn project(&self, point: V) -> Option<V::Vec2> {
        finite::<V>(self.project_in_f64(point)?)
    }

    /// Projects a point of the scene to an image of `width` by `height` pixels: the inverse of [`pixel_ray`](Self::pixel_ray).
    ///
    /// As there, x and y are in pixels from the top left corner. The point is inside the image if and only if 0 ≤ x < `width` and
    /// 0 ≤ y < `height`. Whether something hides it can be found with a shadow ray, or by intersecting the `pixel_ray` there.
    ///
    /// Returns `None` in the cases of [`project`](Self::project), with x and y instead of u and v. A `width` or `height` of 0
    /// counts as 1.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view, 2.0)?;
    ///
    /// // Where to draw the label of an object.
    /// let pixel = camera.project_to_pixel(vec3(3.0, -1.5, -6.0), 640, 480);
    /// assert_eq!(pixel, Some(vec2(480.0, 320.0)));
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    #[doc(alias("world_to_screen", "world_to_viewport", "world_to_pixel"))]
    pub fn project_to_pixel(&self, point: V, width: u32, height: u32) -> Option<V::Vec2> {
        finite::<V>(self.project_to_pixel_in_f64(point, width, height)?)
    }

    /// Returns the depth of a point: its distance ahead of the eye along -W, in the units of the scene.
    ///
    /// The depth is positive ahead of the eye, zero beside it, and negative behind it. It is not finite if the point is not.
    ///
    /// The eye ray of the point reaches it at `t = depth / distance` for a perspective camera, and at `t = depth` for an
    /// orthographic one.
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect::centered(4.0, 3.0);
    /// let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view, 2.0)?;
    /// assert_eq!(camera.depth(vec3(3.0, -1.5, -6.0)), 6.0);
    /// assert_eq!(camera.depth(vec3(3.0, -1.5, 6.0)), -6.0);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    #[doc(alias("view_depth", "linear_depth", "z_depth"))]
    pub fn depth(&self, point: V) -> V::Scalar {
        self.depth_of(point)
    }

    /// The same camera in another precision, to which its numbers are rounded when they are returned.
    pub(crate) const fn cast<W: Vector>(self) -> Camera<W> {
        Camera { frame: self.frame.cast(), view: self.view, projection: self.projection }
    }

    /// Returns the frame, the eye and the basis, with all the digits that the camera has.
    ///
    /// A camera created from it with the same arguments is the same camera, bit for bit. Use it for the same camera with another
    /// view: after a window was resized, for a tile of the image, or to zoom.
    ///
    /// ```
    /// use eyeray::Camera;
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let camera = Camera::perspective_fov(vec3(1.0, 2.0, 4.0), Vec3::ZERO, Vec3::Y, 0.9, 1.6)?;
    /// assert_eq!(camera.frame().perspective_fov(0.9, 1.6)?, camera);
    /// let resized = camera.frame().perspective_fov(0.9, 1.25)?;
    /// assert_eq!(resized.basis(), camera.basis());
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    #[must_use]
    pub const fn frame(&self) -> Frame<V> {
        self.frame
    }

    /// Returns the orthonormal basis: U (to the right), V (up) and W (backwards).
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
    #[must_use]
    pub fn basis(&self) -> [V; 3] {
        self.frame.basis()
    }

    /// Returns the eye, the position of the camera.
    #[must_use]
    #[doc(alias("position", "origin"))]
    pub fn eye(&self) -> V {
        self.frame.eye()
    }

    /// Returns the view rectangle. It is rounded to the precision of `V` if it was computed from a field of view.
    #[must_use]
    pub fn view(&self) -> ViewRect<V::Scalar> {
        self.view.map(V::Scalar::from_f64)
    }

    /// Returns the distance from the eye to the view plane, the focal length, or `None` for an orthographic camera.
    #[must_use]
    #[doc(alias = "focal_length")]
    pub fn distance(&self) -> Option<V::Scalar> {
        match self.projection {
            Projection::Orthographic => None,
            Projection::Perspective { distance } => Some(V::Scalar::from_f64(distance)),
        }
    }
}

/// The pair in the precision of `V`, if it is finite there.
fn finite<V: Vector>(pair: DVec2) -> Option<V::Vec2> {
    let pair = V::vec2_from_f64(pair);
    V::vec2_to_f64(pair).is_finite().then_some(pair)
}
