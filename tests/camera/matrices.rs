//! The camera and glam's view and projection matrices see the same pixel at the same point.
//!
//! glam's are made of f64, so that what is measured is this crate's rounding. In f32 the rounding of an orthographic ray
//! shows most, with 2,000 pixels to half a unit: half an ulp of an origin below 16, in two coordinates, is 0.003 pixels,
//! and half an ulp of a direction is as much again 20 units away.

use approx::assert_abs_diff_eq;
use eyeray::{Camera, Ray, ViewRect};
use glam::dcamera::rh::{proj::opengl, view::look_at_mat4};
use glam::{DMat4, DVec2, DVec3, Vec3, dvec2};
use proptest::prelude::*;

const NEAR: f64 = 0.1;
const FAR: f64 = 1000.0;

/// Where a camera stands, its view rectangle and its distance, all f32, and an image.
#[derive(Debug)]
struct Scene {
    eye: Vec3,
    target: Vec3,
    up: Vec3,
    view: ViewRect,
    distance: f32,
    width: u32,
    height: u32,
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from)
}

fn scene() -> impl Strategy<Value = Scene> {
    let edge = || (-2.0f32..1.0, 0.5f32..2.0).prop_map(|(least, size)| (least, least + size));
    (vector(10.0), vector(10.0), vector(1.0), edge(), edge(), 0.5f32..4.0, 1u32..2000, 1u32..2000)
        .prop_map(|(eye, target, up, (left, right), (bottom, top), distance, width, height)| {
            let view = ViewRect { left, right, bottom, top };
            Scene { eye, target, up: up.normalize_or_zero(), view, distance, width, height }
        })
        .prop_filter("glam's basis needs a direction and an up well apart from it", |scene| {
            (scene.eye - scene.target).normalize_or_zero().cross(scene.up).length() > 0.01
        })
}

impl Scene {
    fn view_matrix(&self) -> DMat4 {
        look_at_mat4(self.eye.as_dvec3(), self.target.as_dvec3(), self.up.as_dvec3().normalize())
    }

    fn frustum(&self) -> DMat4 {
        let [left, right, bottom, top] = self.edges();
        // glam's rectangle is in the near plane.
        let scale = NEAR / f64::from(self.distance);
        opengl::frustum(left * scale, right * scale, bottom * scale, top * scale, NEAR, FAR)
    }

    fn orthographic(&self) -> DMat4 {
        let [left, right, bottom, top] = self.edges();
        opengl::orthographic(left, right, bottom, top, NEAR, FAR)
    }

    fn edges(&self) -> [f64; 4] {
        [self.view.left, self.view.right, self.view.bottom, self.view.top].map(f64::from)
    }

    fn double_view(&self) -> ViewRect<f64> {
        let [left, right, bottom, top] = self.edges();
        ViewRect { left, right, bottom, top }
    }

    /// The pixel at which `matrix` shows `point`.
    fn pixel(&self, matrix: &DMat4, point: DVec3) -> DVec2 {
        let shown = matrix.project_point3(point);
        let size = dvec2(f64::from(self.width), f64::from(self.height));
        (dvec2(shown.x, -shown.y) + 1.0) / 2.0 * size
    }

    /// That the ray shows where it comes nearest to `point` at the same pixel as the point itself.
    fn check(&self, matrix: &DMat4, point: DVec3, ray: &Ray<DVec3>) {
        let t = (point - ray.origin).dot(ray.direction) / ray.direction.length_squared();
        assert!(t > 0.0, "the point is behind the ray");
        let (expected, pixel) = (self.pixel(matrix, point), self.pixel(matrix, ray.at(t)));
        assert_abs_diff_eq!(expected.x, pixel.x, epsilon = 0.01);
        assert_abs_diff_eq!(expected.y, pixel.y, epsilon = 0.01);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_point_lies_on_the_ray_of_the_pixel_that_shows_it(
        scene in scene(), x in 0.0..1.0f64, y in 0.0..1.0f64, depth in 0.2..20.0f64,
    ) {
        let Scene { eye, target, up, view, distance, width, height } = scene;
        let doubles = (eye.as_dvec3(), target.as_dvec3(), up.as_dvec3());
        let cameras = [
            (scene.frustum(), Camera::perspective(eye, target, up, view, distance),
                Camera::perspective(doubles.0, doubles.1, doubles.2, scene.double_view(), f64::from(distance))),
            (scene.orthographic(), Camera::orthographic(eye, target, up, view),
                Camera::orthographic(doubles.0, doubles.1, doubles.2, scene.double_view())),
        ];
        for (projection, single, double) in cameras {
            let (Ok(single), Ok(double)) = (single, double) else { panic!("no camera") };
            let matrix = projection * scene.view_matrix();
            // A point of the scene that the image shows: from the corner of its cube to depth.
            let near_to_far = projection.project_point3(DVec3::NEG_Z * depth).z;
            let point = matrix.inverse().project_point3(DVec3::new(2.0 * x - 1.0, 2.0 * y - 1.0, near_to_far));
            let pixel = scene.pixel(&matrix, point);
            scene.check(&matrix, point, &double.pixel_ray(pixel, width, height));

            // f32 rounds the pixel as well: the point is then that of the rounded one.
            let rounded = pixel.as_vec2();
            let ray = single.pixel_ray(rounded, width, height).into();
            prop_assert!((rounded.as_dvec2() - pixel).abs().max_element() <= 0.0001);
            scene.check(&matrix, point, &ray);
        }
    }

    #[test]
    fn a_field_of_view_is_that_of_glam(
        scene in scene(), fov_y in 0.1f32..2.5, aspect in 0.3f32..3.0, x in -1.0..1.0f64, y in -1.0..1.0f64,
    ) {
        let camera = Camera::perspective_fov(scene.eye, scene.target, scene.up, fov_y, aspect);
        let Ok(camera) = camera else { panic!("no camera") };
        let projection = opengl::perspective(f64::from(fov_y), f64::from(aspect), NEAR, FAR);
        let matrix = projection * scene.view_matrix();
        let point = matrix.inverse().project_point3(DVec3::new(x, y, 0.9));
        let pixel = scene.pixel(&matrix, point).as_vec2();
        scene.check(&matrix, point, &camera.pixel_ray(pixel, scene.width, scene.height).into());
    }
}
