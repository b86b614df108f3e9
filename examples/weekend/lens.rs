//! The camera's thin lens: what is at one distance is sharp, and the rest blurs.

use eyeray::{Camera, CameraError, Frame, Ray, ViewRect};
use glam::{Vec2, Vec3, vec3};

use crate::random::Random;

/// A camera whose eye rays start anywhere on a disk around its eye.
pub(crate) struct Lens {
    camera: Camera,
    /// The axes of the disk, to the right and up, each as long as its radius.
    u: Vec3,
    v: Vec3,
    pub(crate) width: u16,
    pub(crate) height: u16,
}

impl Lens {
    pub(crate) fn new(width: u16, height: u16) -> Result<Self, CameraError> {
        const FOV_Y: f32 = 20.0;
        /// The angle under which the lens is seen from the point in focus.
        const DEFOCUS: f32 = 0.6;
        const FOCUS_DISTANCE: f32 = 10.0;

        let frame = Frame::look_at(vec3(13.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y)?;
        // With the view plane at the distance in focus, every eye ray passes its point of that plane at t = 1.
        let view_height = 2.0 * FOCUS_DISTANCE * (FOV_Y.to_radians() / 2.0).tan();
        let view_width = view_height * f32::from(width) / f32::from(height);
        let view = ViewRect::centered(view_width, view_height);
        let camera = frame.perspective(view, FOCUS_DISTANCE)?;

        let radius = FOCUS_DISTANCE * (DEFOCUS.to_radians() / 2.0).tan();
        let [u, v, _] = frame.basis();
        Ok(Self { camera, u: radius * u, v: radius * v, width, height })
    }

    /// Returns the eye ray through a point of the image and a random point of the lens.
    pub(crate) fn ray(&self, pixel: Vec2, random: &mut Random) -> Ray {
        let Ray { origin, direction } =
            self.camera.pixel_ray(pixel, self.width.into(), self.height.into());
        let [x, y] = random.in_unit_disk();
        let offset = x * self.u + y * self.v;
        Ray::new(origin + offset, direction - offset)
    }
}
