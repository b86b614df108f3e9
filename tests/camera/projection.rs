//! `project`, where it is not simply the inverse of `ray`: the points that no eye ray reaches, and the limits of f64.

use eyeray::{Camera, CameraError, ViewRect};
use glam::{DVec3, Vec2, Vec3, dvec2, dvec3, vec2, vec3};

const VIEW: ViewRect = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const DVIEW: ViewRect<f64> = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const EYE: Vec3 = Vec3::new(1.0, 2.0, 3.0);

fn perspective() -> Result<Camera, CameraError> {
    Camera::perspective(EYE, EYE - Vec3::Z, Vec3::Y, VIEW, 2.0)
}

fn orthographic() -> Result<Camera, CameraError> {
    Camera::orthographic(EYE, EYE - Vec3::Z, Vec3::Y, VIEW)
}

#[test]
fn perspective_reaches_what_is_before_the_eye() -> Result<(), CameraError> {
    let camera = perspective()?;
    assert_eq!(camera.project(EYE + vec3(1.0, -2.0, -4.0)), Some(vec2(0.5, -1.0)));
    // Between the eye and the view plane as well.
    assert_eq!(camera.project(EYE + vec3(0.5, 0.25, -0.5)), Some(vec2(2.0, 1.0)));
    for unreached in [Vec3::ZERO, Vec3::X, vec3(1.0, -2.0, 0.0), Vec3::Z, vec3(1.0, 1.0, 1e-6)] {
        assert_eq!(camera.project(EYE + unreached), None, "{unreached}");
    }
    Ok(())
}

#[test]
fn orthographic_reaches_what_is_before_the_view_plane() -> Result<(), CameraError> {
    let camera = orthographic()?;
    assert_eq!(camera.project(EYE + vec3(1.0, -2.0, -4.0)), Some(vec2(1.0, -2.0)));
    // On the plane t is 0, and a ray is t > 0.
    for unreached in [Vec3::ZERO, Vec3::X, vec3(1.0, -2.0, 0.0), Vec3::Z, vec3(1.0, 1.0, 1e-6)] {
        assert_eq!(camera.project(EYE + unreached), None, "{unreached}");
    }
    Ok(())
}

#[test]
fn no_ray_reaches_what_is_not_finite() -> Result<(), CameraError> {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for point in [vec3(value, 0.0, 0.0), vec3(0.0, value, 0.0), vec3(0.0, 0.0, value)] {
            assert_eq!(perspective()?.project(point), None);
            assert_eq!(orthographic()?.project(point), None);
        }
    }
    Ok(())
}

#[test]
fn no_ray_reaches_what_needs_an_infinite_u() -> Result<(), CameraError> {
    // u would be 2e38 · 2 / 1e-3.
    assert_eq!(perspective()?.project(vec3(2e38, 0.0, 2.999)), None);
    let camera =
        Camera::orthographic(vec3(-3e38, 0.0, 0.0), vec3(-3e38, 0.0, -1.0), Vec3::Y, VIEW)?;
    assert_eq!(camera.project(vec3(3e38, 0.0, -1.0)), None);
    assert_eq!(camera.project(vec3(0.0, 0.0, -1.0)), Some(Vec2::new(3e38, 0.0)));
    Ok(())
}

#[test]
fn the_largest_and_the_smallest_points_are_projected() -> Result<(), CameraError> {
    let camera = Camera::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, DVIEW, 1.0)?;
    for size in [f64::MAX, 1e300, 1e-300, 4e-320] {
        let point = dvec3(0.25, -0.5, -1.0) * size;
        assert_eq!(camera.project(point), Some(dvec2(0.25, -0.5)), "{size}");
    }

    // The difference of point and eye overflows, what it is projected to does not.
    let eye = dvec3(0.0, 0.0, f64::MAX);
    let point = dvec3(f64::MAX, -f64::MAX, -f64::MAX);
    let camera = Camera::perspective(eye, DVec3::ZERO, DVec3::Y, DVIEW, 1.0)?;
    assert_eq!(camera.project(point), Some(dvec2(0.5, -0.5)));
    let camera = Camera::orthographic(eye, DVec3::ZERO, DVec3::Y, DVIEW)?;
    assert_eq!(camera.project(point), Some(dvec2(f64::MAX, -f64::MAX)));
    assert_eq!(camera.project(dvec3(1.0, 2.0, -f64::MAX)), Some(dvec2(1.0, 2.0)));
    Ok(())
}
