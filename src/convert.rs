//! Conversions between the two precisions: exact to `f64`, by [`From`], and rounded to `f32`, by `to_f32`.

use glam::{DVec3, Vec3};

use crate::{Camera, Frame, Hit, Ray, Scalar, Sphere, ViewRect};

/// Converts a ray to `f64`, exactly.
impl From<Ray<Vec3>> for Ray<DVec3> {
    #[inline]
    fn from(Ray { origin, direction }: Ray<Vec3>) -> Self {
        Self { origin: origin.into(), direction: direction.into() }
    }
}

/// Converts a sphere to `f64`, exactly.
impl From<Sphere<Vec3>> for Sphere<DVec3> {
    #[inline]
    fn from(Sphere { center, radius }: Sphere<Vec3>) -> Self {
        Self { center: center.into(), radius: radius.into() }
    }
}

/// Converts a hit to `f64`, exactly. Its spawned rays keep the distance from the surface that an `f32` point needs.
///
/// There is no conversion to `f32`: the error of a point rounded to `f32` is larger than the clearance of an `f64` hit.
impl From<Hit<Vec3>> for Hit<DVec3> {
    #[inline]
    fn from(hit: Hit<Vec3>) -> Self {
        let Hit { t, point, normal, .. } = hit;
        // The point stays rounded to f32.
        Self::new(t.into(), point.into(), normal.into(), hit.clearance().into())
    }
}

/// Converts a view rectangle to `f64`, exactly.
impl From<ViewRect<f32>> for ViewRect<f64> {
    #[inline]
    fn from(view: ViewRect<f32>) -> Self {
        view.map(f64::from)
    }
}

/// Converts a frame to `f64`, exactly, because a frame keeps its basis in `f64` in both precisions.
impl From<Frame<Vec3>> for Frame<DVec3> {
    #[inline]
    fn from(frame: Frame<Vec3>) -> Self {
        frame.cast()
    }
}

/// Converts a camera to `f64`, exactly, because a camera keeps all its numbers in `f64` in both precisions.
///
/// Rounded to `f32`, the rays of the result are the rays of the original.
///
/// ```
/// use eyeray::Camera;
/// use glam::{DVec3, Vec3, vec2};
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// let camera = Camera::perspective_fov(Vec3::ONE, Vec3::ZERO, Vec3::Y, 0.9, 1.6)?;
/// let wide = Camera::<DVec3>::from(camera);
/// let uv = vec2(0.3, -0.2);
/// assert_eq!(wide.ray(uv.as_dvec2()).to_f32(), camera.ray(uv));
/// # Ok(())
/// # }
/// ```
impl From<Camera<Vec3>> for Camera<DVec3> {
    #[inline]
    fn from(camera: Camera<Vec3>) -> Self {
        camera.cast()
    }
}

impl Ray<DVec3> {
    /// Rounds the ray to `f32`: each coordinate to the nearest, ties to even.
    ///
    /// A coordinate beyond the largest `f32` becomes infinite, and one below half the smallest becomes zero. A ray that is not
    /// finite, or whose direction becomes zero, hits nothing.
    ///
    /// The rounded ray is another ray. One that [`Hit::spawn`] created starts closer to the surface that it leaves than two
    /// neighboring `f32` are apart: rounded, about half of such rays start on the other side and hit that surface. So do not ask
    /// a collection in `f32` with rays from hits in `f64`. `Spheres` and `SphereBvh` are there in `f64`, too.
    ///
    /// ```
    /// use eyeray::Ray;
    /// use glam::{DVec3, Vec3, dvec3, vec3};
    ///
    /// let ray = Ray::new(dvec3(0.1, 1e300, -1e-300), DVec3::NEG_Z);
    /// assert_eq!(ray.to_f32(), Ray::new(vec3(0.1, f32::INFINITY, 0.0), Vec3::NEG_Z));
    ///
    /// // The way back is exact.
    /// assert_eq!(Ray::<DVec3>::from(ray.to_f32()).to_f32(), ray.to_f32());
    /// ```
    #[inline]
    #[must_use]
    pub fn to_f32(self) -> Ray<Vec3> {
        Ray { origin: self.origin.as_vec3(), direction: self.direction.as_vec3() }
    }
}

impl Sphere<DVec3> {
    /// Rounds the sphere to `f32`: each coordinate of the center and the radius to the nearest, ties to even.
    ///
    /// A number beyond the largest `f32` becomes infinite, and no ray hits the sphere; a radius below half the smallest becomes
    /// zero. In general, neither of the two spheres contains the other.
    ///
    /// ```
    /// use eyeray::Sphere;
    /// use glam::{DVec3, Vec3};
    ///
    /// assert_eq!(Sphere::new(DVec3::X, 0.1).to_f32(), Sphere::new(Vec3::X, 0.1));
    /// assert_eq!(Sphere::new(DVec3::X, 1e300).to_f32().radius, f32::INFINITY);
    /// ```
    #[inline]
    #[must_use]
    pub fn to_f32(self) -> Sphere<Vec3> {
        Sphere { center: self.center.as_vec3(), radius: f32::from_f64(self.radius) }
    }
}

impl ViewRect<f64> {
    /// Rounds the rectangle to `f32`: each side to the nearest, ties to even.
    ///
    /// A side beyond the largest `f32` becomes infinite, and two sides that round to the same `f32` become equal: a camera
    /// accepts neither.
    ///
    /// ```
    /// use eyeray::ViewRect;
    ///
    /// assert_eq!(ViewRect::centered(0.2, 1e300).to_f32(), ViewRect::centered(0.2, f32::INFINITY));
    /// ```
    #[inline]
    #[must_use]
    pub fn to_f32(self) -> ViewRect<f32> {
        self.map(f32::from_f64)
    }
}
