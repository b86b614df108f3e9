//! The frame: a direction of view in all its digits, and cameras that are made from one frame.

use eyeray::{Camera, CameraError, Frame, Ray, ViewRect};
use glam::{DVec2, DVec3, Vec2, Vec3, dvec3, vec2, vec3};
use proptest::prelude::*;

use crate::exact;

const VIEW: ViewRect = ViewRect { left: -1.0, right: 3.0, bottom: -0.5, top: 1.5 };

/// A direction of view is lost in `eye + forward`: cgmath issue 433, libgdx pull request 7255.
#[test]
fn a_direction_of_view_is_not_lost_far_from_the_origin() -> Result<(), CameraError> {
    let forward = vec3(0.48, -0.6, 0.64);
    let near = Frame::look_to(Vec3::ZERO, forward, Vec3::Y)?;
    for size in [1e4, 1e6, 1e7, 1e30, f32::MAX] {
        let eye = vec3(size, -size, size);
        let frame = Frame::look_to(eye, forward, Vec3::Y)?;
        assert_eq!((frame.eye(), frame.basis()), (eye, near.basis()));
        let rays = [near, frame].map(|frame| frame.perspective(VIEW, 2.0));
        let [near, far] = rays.map(|camera| camera.map(|camera| camera.ray(vec2(0.3, 0.7))));
        assert_eq!(near?.direction, far?.direction);
    }
    // Where the sum would be the eye again, a target is an error.
    let eye = Vec3::splat(1e9);
    assert_eq!(Frame::look_at(eye, eye + forward, Vec3::Y), Err(CameraError::EyeAtTarget));
    Ok(())
}

#[test]
fn only_the_direction_of_a_direction_counts() -> Result<(), CameraError> {
    let direction = dvec3(1.0, -2.0, 0.5);
    let frame = Frame::look_to(DVec3::ZERO, direction, DVec3::Y)?;
    for exponent in [-1000, -3, 5, 1000] {
        let longer = direction * 2f64.powi(exponent);
        assert_eq!(Frame::look_to(DVec3::ZERO, longer, DVec3::Y)?, frame);
    }
    assert_eq!(Frame::look_at(-direction, DVec3::ZERO, DVec3::Y)?.basis(), frame.basis());
    Ok(())
}

#[test]
fn the_constructors_are_short_for_a_frame() -> Result<(), CameraError> {
    let (eye, target, up) = (vec3(1.0, 2.0, 4.0), vec3(0.1, 0.0, -3.0), vec3(0.1, 1.0, 0.0));
    let frame = Frame::look_at(eye, target, up)?;
    assert_eq!(frame.orthographic(VIEW), Camera::orthographic(eye, target, up, VIEW));
    assert_eq!(frame.perspective(VIEW, 0.7), Camera::perspective(eye, target, up, VIEW, 0.7));
    assert_eq!(frame.perspective_fov(0.9, 1.6), Camera::perspective_fov(eye, target, up, 0.9, 1.6));
    Ok(())
}

#[test]
fn debug_shows_the_numbers_and_no_marker() -> Result<(), CameraError> {
    let frame = Frame::look_to(Vec3::Z, Vec3::NEG_Z, Vec3::Y)?;
    let shown = "Frame { eye: DVec3(0.0, 0.0, 1.0), u: DVec3(1.0, 0.0, 0.0), v: DVec3(0.0, 1.0, 0.0), \
                 w: DVec3(0.0, 0.0, 1.0) }";
    assert_eq!(format!("{frame:?}"), shown);
    assert_eq!(
        format!("{:?}", frame.perspective(ViewRect::centered(4.0, 2.0), 3.0)?),
        format!(
            "Camera {{ frame: {shown}, view: ViewRect {{ left: -2.0, right: 2.0, bottom: -1.0, top: 1.0 }}, \
             projection: Perspective {{ distance: 3.0 }} }}"
        )
    );
    Ok(())
}

/// The view rectangle of a camera matrix: the ray of a pixel is ((x - cx) / fx, (y - cy) / fy, 1), with y downwards and z
/// forwards, where the center of the first pixel is (0, 0).
#[test]
fn a_camera_matrix_has_a_view_rectangle() -> Result<(), CameraError> {
    let (fx, fy, cx, cy) = (1234.5, 1241.25, 972.25, 541.75);
    let (width, height) = (1920, 1080);
    let view = ViewRect {
        left: -(cx + 0.5) / fx,
        right: (f64::from(width) - 0.5 - cx) / fx,
        bottom: -(f64::from(height) - 0.5 - cy) / fy,
        top: (cy + 0.5) / fy,
    };
    let frame = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?;
    let camera = frame.perspective(view, 1.0)?;
    for (x, y) in [(0.0, 0.0), (1919.0, 1079.0), (cx, cy), (100.0, 900.0)] {
        let direction = camera.pixel_ray(DVec2::new(x + 0.5, y + 0.5), width, height).direction;
        let expected = dvec3((x - cx) / fx, -(y - cy) / fy, -1.0);
        assert!((direction - expected).length() < 1e-15, "{direction} is not {expected}");
    }
    Ok(())
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from)
}

fn side() -> impl Strategy<Value = (f32, f32)> {
    (-2.0f32..1.0, 0.01f32..2.0).prop_map(|(start, length)| (start, start + length))
}

fn bits(ray: Ray<DVec3>) -> [u64; 6] {
    let ([a, b, c], [d, e, f]) = (ray.origin.to_array(), ray.direction.to_array());
    [a, b, c, d, e, f].map(f64::to_bits)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_frame_that_looks_along_a_direction_is_rounded_once(
        eye in vector(1e7), direction in vector(1.0), up in vector(1.0),
    ) {
        let frame = Frame::look_to(eye, direction, up);
        prop_assert!(frame.is_ok());
        let Ok(frame) = frame else { unreachable!() };
        let exact = exact::Camera::look_to(eye.as_dvec3(), direction.as_dvec3(), up.as_dvec3());
        for (computed, exact) in frame.basis().into_iter().zip(exact.basis()) {
            prop_assert!(exact.error(computed.as_dvec3()) <= 0.87 * f64::from(f32::EPSILON) / 2.0);
        }
        let frame = Frame::look_to(eye.as_dvec3(), direction.as_dvec3(), up.as_dvec3());
        prop_assert!(frame.is_ok());
        let Ok(frame) = frame else { unreachable!() };
        for (computed, exact) in frame.basis().into_iter().zip(exact.basis()) {
            prop_assert!(exact.error(computed) <= 0.87 * f64::EPSILON / 2.0);
        }
    }

    /// In both precisions, and after a way through the other.
    #[test]
    fn a_camera_made_anew_from_its_frame_is_the_same(
        eye in vector(1e7), target in vector(10.0), up in vector(1.0), u in side(), v in side(),
        distance in 0.1f32..10.0, fov_y in 0.01f32..3.1, uv in [-2.0f32..2.0, -2.0f32..2.0],
    ) {
        let view = ViewRect { left: u.0, right: u.1, bottom: v.0, top: v.1 };
        let cameras = [
            Camera::orthographic(eye, target, up, view),
            Camera::perspective(eye, target, up, view, distance),
            Camera::perspective_fov(eye, target, up, fov_y, distance),
        ];
        let [Ok(orthographic), Ok(perspective), Ok(fov)] = cameras else { panic!("no camera") };
        let frame = fov.frame();
        prop_assert_eq!(frame.orthographic(view), Ok(orthographic));
        prop_assert_eq!(frame.perspective(view, distance), Ok(perspective));
        prop_assert_eq!(frame.perspective_fov(fov_y, distance), Ok(fov));

        let uv = Vec2::from(uv);
        for camera in [orthographic, perspective, fov] {
            let wide = Camera::<DVec3>::from(camera);
            prop_assert_eq!(wide.frame(), Frame::<DVec3>::from(camera.frame()));
            prop_assert_eq!(wide.ray(uv.as_dvec2()).to_f32(), camera.ray(uv));
            prop_assert_eq!(wide.distance(), camera.distance().map(f64::from));
            prop_assert_eq!(wide.view().to_f32(), camera.view());

            let anew = match wide.distance() {
                None => wide.frame().orthographic(wide.view()),
                Some(distance) => wide.frame().perspective(wide.view(), distance),
            };
            let Ok(anew) = anew else { panic!("no camera") };
            prop_assert_eq!(anew, wide);
            for (a, b) in anew.rays(5, 3).zip(wide.rays(5, 3)) {
                prop_assert_eq!(bits(a), bits(b));
            }
        }
    }
}
