//! Cameras from the view and projection matrices of a renderer, and back.
//!
//! A view matrix moves the eye to the origin of view space, where x is to the right and y upwards in the image. Its rotation has
//! the rows U, V and W, or -W where z is forwards. A projection matrix scales and moves x and y, and divides them by w, the
//! distance ahead of the eye (perspective) or 1 (orthographic):
//!
//! ```text
//!     x of the image = (a x + b z + c) / w          w = -z, z or 1
//! ```
//!
//! It runs from -1 on the left to 1 on the right. In the plane at distance 1, where w is 1, that is a view rectangle. How a
//! matrix computes the depth does not matter to the rays.

use glam::{DMat4, DVec3, DVec4};

use super::basis::{basis, moved_to_origin, negated_dot};
use super::{Camera, CameraArgument, CameraError, Frame, Projection, ViewRect};
use crate::Vector;
use crate::vector::Matrix;

/// How far the rows of a view matrix may be from orthonormal: a product of two of them from 0, or of one with itself from 1.
///
/// Far above what rounding leaves in `f32`, a few 2⁻²⁴, and a hundred rotations that are multiplied, and below any scale that
/// someone chooses.
const RIGID: f64 = 1e-4;

/// How far an orthographic depth may be from 1/2 in the plane of the eye where the range of depths is meant to have its middle
/// there: what `f32` leaves of it, (near + far) / (far - near), after three roundings.
const MIDDLE: f64 = 1e-6;

/// Which way the camera looks in view space.
#[derive(Clone, Copy, PartialEq)]
enum Forward {
    /// Right-handed view space: z is backwards.
    NegativeZ,
    /// Left-handed view space: z is forwards.
    PositiveZ,
}

impl<V: Vector> Frame<V> {
    /// Creates the frame of a view matrix, the matrix from world space to view space, with x to the right, y upwards and z
    /// backwards: right-handed view space.
    ///
    /// The matrix is a `Mat4`, or for `DVec3` a `DMat4`.
    ///
    /// The eye is the exact point that the matrix moves to the origin, rounded to the precision of `V`. The rows of the rotation
    /// are U, V and W up to rounding: [`Camera::from_matrices`] says how near. For a matrix that mirrors, as that of a planar
    /// reflection does, U × V is -W instead of W.
    ///
    /// For a left-handed view space, where z is forwards, negate the third row first:
    ///
    /// ```
    /// use eyeray::Frame;
    /// use glam::camera::{lh, rh};
    /// use glam::{Mat4, Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let eye = vec3(0.0, 0.0, 5.0);
    /// let frame = Frame::from_view_matrix(&rh::view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y))?;
    /// assert_eq!(frame, Frame::look_at(eye, Vec3::ZERO, Vec3::Y)?);
    ///
    /// let z_is_forwards = lh::view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
    /// let z_is_backwards = Mat4::from_scale(vec3(1.0, 1.0, -1.0)) * z_is_forwards;
    /// let frame = Frame::from_view_matrix(&z_is_backwards)?;
    /// assert_eq!((frame.eye(), frame.basis()), (eye, [Vec3::NEG_X, Vec3::Y, Vec3::Z]));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// If the matrix or the eye is not finite, its last row is not (0, 0, 0, 1), or it scales or shears: a product of two of its
    /// rows is off by more than 10⁻⁴ from 0, or of one with itself from 1.
    #[doc(alias("extrinsics", "world_to_view", "world_to_camera"))]
    pub fn from_view_matrix<M: Matrix<Vector = V>>(view_matrix: &M) -> Result<Self, CameraError> {
        Self::read(view_matrix.to_f64(), Forward::NegativeZ)
    }

    /// Returns the view matrix, the matrix from world space to view space, with x to the right, y upwards and z backwards:
    /// right-handed view space.
    ///
    /// For a renderer whose view space is left-handed, negate the third row: see [`Camera::view_matrix`]. Each element is rounded
    /// once, from an `f64` of the frame's basis. A translation beyond the largest finite value becomes infinite.
    ///
    /// ```
    /// use eyeray::Frame;
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let frame = Frame::look_to(vec3(0.0, 2.0, 5.0), Vec3::NEG_Z, Vec3::Y)?;
    /// let matrix = frame.view_matrix();
    /// assert_eq!(matrix.transform_point3(vec3(1.0, 2.0, 1.0)), vec3(1.0, 0.0, -4.0));
    /// assert_eq!(Frame::from_view_matrix(&matrix)?, frame);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    #[doc(alias("world_to_view", "world_to_camera"))]
    pub fn view_matrix(&self) -> V::Mat4 {
        let rows = [self.u, self.v, self.w].map(|axis| axis.extend(negated_dot(axis, self.eye)));
        let [x, y, z] = rows;
        V::Mat4::from_f64(DMat4::from_cols(x, y, z, DVec4::W).transpose())
    }

    fn read(matrix: DMat4, forward: Forward) -> Result<Self, CameraError> {
        if !matrix.is_finite() {
            return Err(CameraError::NotFinite(CameraArgument::ViewMatrix));
        }
        if matrix.row(3) != DVec4::W {
            return Err(CameraError::ViewMatrixProjects);
        }
        let rows = [0, 1, 2].map(|row| matrix.row(row).truncate());
        let [x, y, z] = rows;
        let is_off = |product: f64, wanted: f64| (product - wanted).abs() > RIGID;
        if rows.iter().any(|row| is_off(row.length_squared(), 1.0)) {
            return Err(CameraError::ViewMatrixScales);
        }
        // Of rows of length 1, no product overflows.
        if is_off(x.dot(y), 0.0) || is_off(y.dot(z), 0.0) || is_off(z.dot(x), 0.0) {
            return Err(CameraError::ViewMatrixShears);
        }
        let direction = match forward {
            Forward::NegativeZ => -z,
            Forward::PositiveZ => z,
        };
        let [u, v, w] = basis(DVec3::ZERO, direction, y).ok_or(CameraError::ViewMatrixShears)?;
        // U is to the right, on whichever side of V and W that is. Subtracted from 0, which gives no -0.
        let u = if u.dot(x) < 0.0 { DVec3::ZERO - u } else { u };
        let eye = V::from_f64(moved_to_origin(rows, matrix.w_axis.truncate())).to_f64();
        if !eye.is_finite() {
            return Err(CameraError::NotFinite(CameraArgument::ViewMatrix));
        }
        Ok(Self::from_parts(eye, [u, v, w]))
    }
}

impl<V: Vector> Camera<V> {
    /// Creates the camera of a renderer that has a view matrix and a projection matrix, for picking or for rendering the same
    /// image.
    ///
    /// The matrices are two `Mat4`, or for `DVec3` two `DMat4`.
    ///
    /// The rays come from the numbers of the two matrices directly. They are more accurate than those of
    /// `(projection_matrix * view_matrix).inverse()`, above all far from the world's origin and where the far plane is at
    /// infinity.
    ///
    /// ```
    /// use eyeray::Camera;
    /// use glam::camera::rh::{proj::directx, view::look_to_mat4};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view_matrix = look_to_mat4(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z, Vec3::Y);
    /// let projection_matrix = directx::perspective_infinite_reverse(f32::to_radians(90.0), 2.0, 0.1);
    /// let camera = Camera::from_matrices(&view_matrix, &projection_matrix)?;
    ///
    /// // The mouse is in the middle of a window of 640 by 320.
    /// let ray = camera.pixel_ray(vec2(320.0, 160.0), 640, 320);
    /// assert_eq!((ray.origin, ray.direction), (vec3(0.0, 0.0, 5.0), Vec3::NEG_Z));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Conventions
    ///
    /// Matrices multiply column vectors, as glam's do. View space has x to the right and y upwards. What else the conventions of
    /// renderers differ in is read from the projection matrix:
    ///
    /// - **Perspective or orthographic**: a perspective projection may be finite, infinite, reversed or off-center. Its camera
    ///   has its view rectangle at distance 1.
    /// - **Right- or left-handed view space**: z is backwards or forwards. A perspective projection tells which by its last row.
    ///   An orthographic one looks to the side where the depth is 1/2, which is true for depths from 0 to 1 and from -1 to 1,
    ///   reversed or not, if what is near is not behind the eye. If depths from 0 to 1 reach as far behind the eye as ahead, view
    ///   space is taken to be right-handed.
    /// - **y upwards or downwards in clip space** (Vulkan): downwards if the scale of y is negative. The image is the same, and
    ///   so is the camera: what is upwards in view space is at the top. [`pixel_ray`](Self::pixel_ray) counts from the top left
    ///   corner in each convention.
    /// - **Depths from -1 to 1, or from 0 to 1**: rays do not depend on it.
    ///
    /// The basis of a left-handed view space is left-handed: U × V is -W.
    ///
    /// # Accuracy
    ///
    /// The eye is the exact point that the view matrix moves to the origin, rounded to the precision of `V`. Each side of the
    /// view rectangle is the exact one within 2⁻⁵² of itself, in both precisions.
    ///
    /// The rows of a rotation are orthonormal up to rounding only, those of the camera's basis as nearly as `f64` allows. With ε
    /// the most by which a product of two rows is off from 0, or of a row with itself from 1, the direction of an eye ray is
    /// within 2 ε of its length from the direction in which the two matrices unproject the pixel, beside the errors that
    /// [`Camera`] states and that of the view rectangle. The origin of an orthographic ray is within 2 ε of the length of (u, v),
    /// likewise. glam's `look_to_mat4` has an ε below 32 ulp of 1 where up is at least 6° from the direction of view.
    ///
    /// A camera that is made from the matrices of another one has its eye within 4 u |e| of the other's, and its basis within 5
    /// u, where u is half an ulp of 1: 2⁻²⁴ in `f32`, 2⁻⁵³ in `f64`.
    ///
    /// `cargo test --test camera unprojection` compares with exact arithmetic, also 10⁷ from the world's origin.
    ///
    /// # Errors
    ///
    /// If a matrix, the eye or the view rectangle is not finite, if the view matrix is not rigid, as [`Frame::from_view_matrix`]
    /// says, or if the projection matrix is none of the above: its last row is that of none, it is flat, it mirrors the image
    /// from left to right, or its x or y is not a scale and an offset.
    #[doc(alias("view_projection", "unproject", "inverse_projection", "intrinsics"))]
    pub fn from_matrices<M: Matrix<Vector = V>>(
        view_matrix: &M,
        projection_matrix: &M,
    ) -> Result<Self, CameraError> {
        let matrix = projection_matrix.to_f64();
        let not_finite = CameraError::NotFinite(CameraArgument::ProjectionMatrix);
        if !matrix.is_finite() {
            return Err(not_finite);
        }
        let (forward, projection) = kind(&matrix).ok_or(CameraError::ProjectionMatrixUnknown)?;
        let frame = Frame::read(view_matrix.to_f64(), forward)?;
        let [left, right] = ends(matrix.row(0), 0, forward, projection)?;
        let [bottom, top] = ends(matrix.row(1), 1, forward, projection)?;
        // Where y is downwards in clip space, the bottom is at 1.
        let view = ViewRect { left, right, bottom: bottom.min(top), top: bottom.max(top) };
        frame.camera(view, projection).map_err(|error| match error {
            CameraError::NotFinite(_) => not_finite,
            _ => CameraError::ProjectionMatrixFlat,
        })
    }
    /// Returns the view matrix, the matrix from world space to view space, with x to the right, y upwards and z backwards:
    /// right-handed view space.
    ///
    /// Each element is rounded once, from an `f64` of the camera's frame.
    ///
    /// # The projection matrix
    ///
    /// It depends on what the renderer calls a depth. glam has a function for each convention, and the view rectangle is moved to
    /// the near plane for it:
    ///
    /// ```
    /// use eyeray::{Camera, ViewRect};
    /// use glam::camera::rh::proj::{directx, opengl, vulkan};
    /// use glam::{Vec3, vec2, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let view = ViewRect { left: -1.0, right: 3.0, bottom: -1.5, top: 1.5 };
    /// let camera = Camera::perspective(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view, 2.0)?;
    /// let (near, far) = (0.1, 100.0);
    ///
    /// // An orthographic camera has no distance, and its view rectangle is at any depth.
    /// let scale = camera.distance().map_or(1.0, |distance| near / distance);
    /// let ViewRect { left, right, bottom, top } = camera.view();
    /// let [l, r, b, t] = [left, right, bottom, top].map(|side| side * scale);
    ///
    /// // OpenGL: depths from -1 to 1.
    /// let gl = opengl::frustum(l, r, b, t, near, far);
    /// // Direct3D, Metal and WebGPU: from 0 to 1. Reversed, from 1 to 0, with near and far exchanged.
    /// let d3d = directx::frustum(l, r, b, t, near, far);
    /// // Vulkan: the same, with y downwards in clip space.
    /// let vk = vulkan::frustum(l, r, b, t, near, far);
    /// // Infinite and reversed, for Direct3D, Metal and WebGPU.
    /// let mut infinite = d3d;
    /// infinite.z_axis.z = 0.0;
    /// infinite.w_axis.z = near;
    /// // For an orthographic camera: `opengl::orthographic(l, r, b, t, near, far)`, and so on.
    ///
    /// for projection_matrix in [gl, d3d, vk, infinite] {
    ///     let again = Camera::from_matrices(&camera.view_matrix(), &projection_matrix)?;
    ///     let [expected, ray] = [camera, again].map(|camera| camera.pixel_ray(vec2(9.0, 7.0), 40, 30));
    ///     // The view rectangle of a matrix is at distance 1, and that of this camera at 2.
    ///     assert!((expected.direction - 2.0 * ray.direction).length() < 1e-6);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// For a left-handed view space, where z is forwards, take the functions of `glam::camera::lh`, and negate the third row of
    /// the view matrix:
    ///
    /// ```
    /// # use eyeray::{Camera, ViewRect};
    /// # use glam::camera::lh::proj::directx;
    /// # use glam::{Mat4, Vec3, vec3};
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// # let view = ViewRect::centered(4.0, 2.0);
    /// # let camera = Camera::perspective(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view, 1.0)?;
    /// # let (near, far) = (0.125, 100.0);
    /// # let [l, r, b, t] = [-0.25, 0.25, -0.125, 0.125];
    /// let view_matrix = Mat4::from_scale(vec3(1.0, 1.0, -1.0)) * camera.view_matrix();
    /// let projection_matrix = directx::frustum(l, r, b, t, near, far);
    /// assert_eq!(Camera::from_matrices(&view_matrix, &projection_matrix)?, camera);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    #[doc(alias("world_to_view", "world_to_camera", "projection_matrix"))]
    pub fn view_matrix(&self) -> V::Mat4 {
        self.frame.view_matrix()
    }
}

/// Which way a projection looks, and how.
fn kind(matrix: &DMat4) -> Option<(Forward, Projection)> {
    let perspective = Projection::Perspective { distance: 1.0 };
    match matrix.row(3).to_array() {
        [0.0, 0.0, -1.0, 0.0] => Some((Forward::NegativeZ, perspective)),
        [0.0, 0.0, 1.0, 0.0] => Some((Forward::PositiveZ, perspective)),
        [0.0, 0.0, 0.0, 1.0] => Some((forward_of_orthographic(matrix), Projection::Orthographic)),
        _ => None,
    }
}

/// Which way an orthographic projection looks: to where the depth is 1/2.
///
/// Of depths from 0 to 1, that is the middle, and of those from -1 to 1, a quarter of the way from one end. Both are ahead of the
/// eye where all that is visible is so, reversed or not.
fn forward_of_orthographic(matrix: &DMat4) -> Forward {
    let (slope, missing) = (matrix.z_axis.z, 0.5 - matrix.w_axis.z);
    let is_forwards = (missing > MIDDLE && slope > 0.0) || (missing < -MIDDLE && slope < 0.0);
    if is_forwards { Forward::PositiveZ } else { Forward::NegativeZ }
}

/// The u or v of the view rectangle where the image has -1 and 1, by the row of x (`axis` 0) or y (`axis` 1).
///
/// Each is off by at most 2⁻⁵² of itself: a sum and a quotient are rounded.
fn ends(
    row: DVec4,
    axis: usize,
    forward: Forward,
    projection: Projection,
) -> Result<[f64; 2], CameraError> {
    let (scale, other_axis) = (row[axis], row[1 - axis]);
    let (offset, none) = match (projection, forward) {
        (Projection::Orthographic, _) => (row.w, row.z),
        // Of z = -1 or 1, which is at distance 1.
        (_, Forward::NegativeZ) => (-row.z, row.w),
        (_, Forward::PositiveZ) => (row.z, row.w),
    };
    if other_axis != 0.0 || none != 0.0 {
        return Err(CameraError::ProjectionMatrixSkews);
    }
    if scale == 0.0 {
        return Err(CameraError::ProjectionMatrixFlat);
    }
    if axis == 0 && scale < 0.0 {
        return Err(CameraError::ProjectionMatrixMirrors);
    }
    Ok([(-1.0 - offset) / scale, (1.0 - offset) / scale])
}
