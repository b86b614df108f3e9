//! Infinite, NaN, zero and nearly zero input: both cameras, both precisions, each coordinate.

use eyeray::{Camera, CameraError, Frame, Hittable, Ray, Scalar, Sphere, Vector, ViewRect};
use glam::{DVec2, DVec3, Vec2, Vec3, dvec2, dvec3, vec2};

/// The cameras of a frame, for a view of 2 by 2.
fn cameras<V: Vector>(frame: &Frame<V>) -> Result<[Camera<V>; 2], CameraError> {
    let one = V::Scalar::ONE;
    let view = ViewRect { left: -one, right: one, bottom: -one, top: one };
    Ok([frame.orthographic(view)?, frame.perspective(view, one)?])
}

/// Frames along the axes and aslant.
fn frames<V: Vector>() -> Result<Vec<Frame<V>>, CameraError> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mut frames = Vec::new();
    for direction in axes.into_iter().chain([dvec3(0.3, -0.7, 0.2), dvec3(1.0, 0.0, -1.0)]) {
        for up in axes.into_iter().filter(|up| up.cross(direction) != DVec3::ZERO) {
            frames.push(Frame::look_to(V::default(), V::from_f64(direction), V::from_f64(up))?);
        }
    }
    Ok(frames)
}

/// A mouse position that is a NaN picks nothing: `UnityRenderStreaming` issue 929, p5.js issue 3749.
fn check_not_finite<V: Vector>() -> Result<(), CameraError>
where
    Sphere<V>: Hittable<V>,
{
    // A sphere all around, which every finite ray meets.
    let around = Sphere::new(V::default(), V::Scalar::from_f64(100.0));
    let all = || V::Scalar::ZERO..V::Scalar::INFINITY;
    for frame in frames::<V>()? {
        for camera in cameras(&frame)? {
            let meets = |ray: Ray<V>| around.intersect(&ray, all()).is_some();
            assert!(meets(camera.pixel_ray(V::vec2_from_f64(dvec2(320.0, 240.0)), 640, 480)));
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for place in [dvec2(value, 240.0), dvec2(320.0, value), dvec2(value, value)] {
                    let place = V::vec2_from_f64(place);
                    for ray in [camera.pixel_ray(place, 640, 480), camera.ray(place)] {
                        let ends = [ray.origin, ray.direction].map(V::to_f64);
                        assert!(!ends.iter().all(|end| end.is_finite()), "{ray:?} of {place:?}");
                        assert!(!meets(ray));
                    }
                }
            }
        }
    }
    Ok(())
}

#[test]
fn a_pixel_that_is_not_finite_has_no_finite_ray() -> Result<(), CameraError> {
    check_not_finite::<Vec3>()?;
    check_not_finite::<DVec3>()
}

#[test]
fn a_pixel_beyond_the_largest_number_has_a_ray_without_nan() -> Result<(), CameraError> {
    for frame in frames::<DVec3>()? {
        for camera in cameras(&frame)? {
            for place in [dvec2(f64::MAX, 0.5), dvec2(0.5, f64::MIN), dvec2(-1e308, 1e308)] {
                let ray = camera.pixel_ray(place, 1, 1);
                assert!(!(ray.origin.is_nan() || ray.direction.is_nan()), "{ray:?}");
            }
        }
    }
    Ok(())
}

/// Reciprocals of negative zeros broke a hierarchy's traversal: tinybvh pull request 282.
fn check_zeros<V: Vector>() -> Result<(), CameraError> {
    let negative_zero = |x: &f64| *x == 0.0 && x.is_sign_negative();
    for frame in frames::<V>()? {
        let axes = frame.basis().map(V::to_f64);
        assert!(!axes.iter().any(|axis| axis.to_array().iter().any(negative_zero)), "{axes:?}");
        for camera in cameras(&frame)? {
            let places = [-1.0, -0.0, 0.0, 1.0];
            let uvs = places.map(|u| places.map(|v| V::vec2_from_f64(dvec2(u, v)))).concat();
            let rays = uvs.into_iter().map(|uv| camera.ray(uv));
            for ray in rays.chain(camera.rays(3, 3)).chain(camera.rays(2, 2)) {
                let direction = ray.direction.to_f64().to_array();
                assert!(!direction.iter().any(negative_zero), "{direction:?} of {camera:?}");
            }
        }
    }
    Ok(())
}

#[test]
fn no_direction_has_a_negative_zero() -> Result<(), CameraError> {
    check_zeros::<Vec3>()?;
    check_zeros::<DVec3>()
}

#[test]
fn the_plainest_rays_have_plain_zeros() -> Result<(), CameraError> {
    let frame = Frame::look_to(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)?;
    for camera in cameras(&frame)? {
        let direction = camera.ray(Vec2::ZERO).direction;
        let bits = direction.to_array().map(f32::to_bits);
        assert_eq!(bits, [0.0, 0.0, -1.0].map(f32::to_bits));
    }
    Ok(())
}

/// Ahead of the eye by less than an ulp of any coordinate: in the smallest numbers there are.
#[test]
fn the_smallest_points_ahead_are_seen() -> Result<(), CameraError> {
    let direction = dvec3(0.4, 0.916_515_138_991_168, 0.0);
    let frame = Frame::look_to(DVec3::ZERO, direction, DVec3::Z)?;
    let least = f64::from_bits(1);
    for camera in cameras(&frame)? {
        for point in [DVec3::X * least, DVec3::Y * least, dvec3(least, least, 0.0)] {
            assert!(camera.project(point).is_some(), "{point:?}");
            assert!(camera.project_to_pixel(point, 640, 480).is_some(), "{point:?}");
            assert_eq!(camera.project(-point), None);
        }
        // 0.4 of the smallest number is none, and 0.9 of it is the smallest number.
        assert_eq!(camera.depth(DVec3::X * least), 0.0);
        assert_eq!(camera.depth(DVec3::Y * least), least);
    }
    Ok(())
}

#[test]
fn the_smallest_differences_from_an_eye_that_is_not_at_the_origin_are_seen()
-> Result<(), CameraError> {
    let steps = |count| DVec3::Z * f64::from_bits(count);
    for camera in cameras(&Frame::look_to(steps(7), DVec3::NEG_Z, DVec3::Y)?)? {
        assert_eq!(camera.depth(steps(3)), f64::from_bits(4));
        assert_eq!(camera.depth(-steps(3)), f64::from_bits(10));
        assert_eq!(camera.depth(steps(8)), -f64::from_bits(1));
        assert_eq!(camera.project(steps(7)), None);
        assert_eq!(camera.project(steps(6)), Some(DVec2::ZERO));
    }
    Ok(())
}

#[test]
fn a_point_opposite_the_eye_is_seen() -> Result<(), CameraError> {
    for size in [1e-320, 1e-160, 1.0, 1e160, 1e300, f64::MAX / 2.0] {
        let eye = dvec3(0.0, 0.0, size);
        for camera in cameras(&Frame::look_to(eye, DVec3::NEG_Z, DVec3::Y)?)? {
            assert_eq!(camera.depth(-eye), 2.0 * size);
            assert_eq!(camera.project(-eye), Some(DVec2::ZERO));
        }
    }
    Ok(())
}

#[test]
fn a_point_in_the_plane_of_the_eye_is_not_seen() -> Result<(), CameraError> {
    // In this plane the depth is 0 exactly, at this side of it positive, however little.
    for (direction, in_plane) in [
        (DVec3::NEG_Z, dvec3(3.0, -2.0, 0.0)),
        (DVec3::X, dvec3(0.0, 1.0, 5.0)),
        (DVec3::NEG_Y, dvec3(-7.0, 0.0, 1e300)),
        (DVec3::NEG_Z, DVec3::ZERO),
    ] {
        let up = if direction.y == 0.0 { DVec3::Y } else { DVec3::X };
        for camera in cameras(&Frame::look_to(DVec3::ZERO, direction, up)?)? {
            assert_eq!(camera.depth(in_plane).to_bits(), 0.0f64.to_bits());
            assert_eq!(camera.project(in_plane), None);
            assert_eq!(camera.project_to_pixel(in_plane, 640, 480), None);
            assert_eq!(camera.project(in_plane - direction * 1e-3), None);
        }
    }
    let camera = cameras(&Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?)?[0];
    assert_eq!(camera.project(dvec3(3.0, -2.0, -5e-324)), Some(dvec2(3.0, -2.0)));
    Ok(())
}

#[test]
fn depth_reaches_as_far_as_floats_do() -> Result<(), CameraError> {
    let eye = dvec3(0.0, 0.0, f64::MAX);
    for camera in cameras(&Frame::look_to(eye, DVec3::NEG_Z, DVec3::Y)?)? {
        assert_eq!(camera.depth(DVec3::ZERO), f64::MAX);
        assert_eq!(camera.depth(dvec3(1.0, 2.0, f64::MAX / 2.0)), f64::MAX / 2.0);
        assert_eq!(camera.depth(-eye), f64::INFINITY);
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for point in [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * value) {
                assert!(!camera.depth(point).is_finite(), "{point}");
                assert_eq!(camera.project_to_pixel(point, 640, 480), None);
            }
            let point = dvec3(value, 1.0, 1.0);
            assert!(!camera.depth(point).is_finite(), "{point}");
        }
    }
    Ok(())
}

#[test]
fn a_pixel_may_be_finite_where_u_is_not() -> Result<(), CameraError> {
    // u is 2e38 · 2, and the view 1e38 wide.
    let view = ViewRect::centered(1e38, 1.0);
    let camera = Frame::look_to(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)?.perspective(view, 2.0)?;
    let point = Vec3::new(2e38, 0.0, -1.0);
    assert_eq!(camera.project(point), None);
    let pixel = camera.project_to_pixel(point, 10, 10);
    assert!(pixel.is_some_and(|pixel| (pixel - vec2(45.0, 5.0)).length() < 1e-4), "{pixel:?}");
    // And the other way.
    let camera = camera.frame().perspective(ViewRect::centered(1e-38, 1.0), 2.0)?;
    let point = Vec3::new(2.0, 0.0, -1.0);
    assert_eq!(camera.project(point), Some(vec2(4.0, 0.0)));
    assert_eq!(camera.project_to_pixel(point, 10, 10), None);
    Ok(())
}

#[test]
fn an_image_without_pixels_counts_as_one_pixel() -> Result<(), CameraError> {
    let camera = cameras(&Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?)?[1];
    let point = dvec3(0.5, 0.5, -1.0);
    for (width, height) in [(0, 0), (0, 1), (1, 0)] {
        let pixel: Option<DVec2> = camera.project_to_pixel(point, width, height);
        assert_eq!(pixel, Some(dvec2(0.75, 0.25)));
    }
    Ok(())
}

#[test]
fn pixels_far_outside_the_widest_view_have_rays() {
    // The products with the parts of a pixel overflow, and to either side.
    let view = ViewRect { left: 0.0, right: f64::MAX, bottom: 0.0, top: f64::MAX };
    let camera = Camera::orthographic(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, view).expect("a camera");
    for width in 1..=2000 {
        for x in [1e20, 1e29, f64::MAX].into_iter().flat_map(|x| [x, -x]) {
            let Ray { origin, .. } = camera.pixel_ray(DVec2::new(x, 0.0), width, 1);
            assert!(!origin.is_nan(), "{x} of {width}");
            assert_eq!(origin.x, f64::MAX.copysign(x), "{x} of {width}");
        }
    }
}
