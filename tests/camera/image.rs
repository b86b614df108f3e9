//! The pixels of an image and their rays.

use core::f32::consts::FRAC_PI_2;

use eyeray::{Camera, CameraError, Frame, Ray, ViewRect};
use glam::{DVec3, Vec2, Vec3, dvec2, dvec3, vec2, vec3};

fn camera() -> Result<Camera, CameraError> {
    let view = ViewRect { left: -1.0, right: 3.0, bottom: -0.5, top: 1.5 };
    Camera::perspective(vec3(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y, view, 2.0)
}

#[test]
fn corners_of_the_image_are_those_of_the_view_rectangle() -> Result<(), CameraError> {
    let camera = camera()?;
    for (pixel, uv) in [
        (vec2(0.0, 0.0), vec2(-1.0, 1.5)),
        (vec2(8.0, 0.0), vec2(3.0, 1.5)),
        (vec2(0.0, 4.0), vec2(-1.0, -0.5)),
        (vec2(8.0, 4.0), vec2(3.0, -0.5)),
        // The center of the first pixel, and a point left of the image.
        (vec2(0.5, 0.5), vec2(-0.75, 1.25)),
        (vec2(-2.0, 2.0), vec2(-2.0, 0.5)),
    ] {
        assert_eq!(camera.pixel_ray(pixel, 8, 4), camera.ray(uv), "{pixel}");
    }
    Ok(())
}

#[test]
fn rays_go_row_by_row_through_the_centers() -> Result<(), CameraError> {
    let camera = camera()?;
    let (width, height) = (5u8, 3u8);
    let mut expected = Vec::new();
    for row in 0..height {
        for column in 0..width {
            let pixel = Vec2::new(f32::from(column), f32::from(row)) + 0.5;
            expected.push(camera.pixel_ray(pixel, width.into(), height.into()));
        }
    }
    let rays = camera.rays(width.into(), height.into());
    assert_eq!(rays.len(), expected.len());
    assert_eq!(rays.size_hint(), (15, Some(15)));
    assert_eq!(rays.clone().collect::<Vec<Ray>>(), expected);
    assert_eq!(rays.clone().nth(7), Some(expected[7]));
    assert_eq!(rays.clone().nth_back(2), Some(expected[12]));
    assert_eq!(rays.clone().last(), expected.last().copied());
    assert_eq!((rays.clone().count(), rays.clone().skip(3).count()), (15, 12));
    expected.reverse();
    assert_eq!(rays.rev().collect::<Vec<Ray>>(), expected);
    Ok(())
}

#[test]
fn an_iterator_that_has_ended_stays_so() -> Result<(), CameraError> {
    let mut rays = camera()?.rays(2, 1);
    assert_eq!(rays.len(), 2);
    assert!(rays.next().is_some() && rays.next_back().is_some());
    assert_eq!((rays.len(), rays.next(), rays.next_back(), rays.next()), (0, None, None, None));
    Ok(())
}

#[test]
fn an_image_without_pixels_has_no_rays() -> Result<(), CameraError> {
    let camera = camera()?;
    for (width, height) in [(0, 0), (0, 7), (7, 0)] {
        assert_eq!(camera.rays(width, height).count(), 0);
        // Asked for all the same, its pixels are as large as the image.
        let ray = camera.pixel_ray(vec2(0.5, 0.5), width, height);
        assert_eq!(ray, camera.pixel_ray(vec2(0.5, 0.5), width.max(1), height.max(1)));
    }
    Ok(())
}

#[test]
#[cfg(target_pointer_width = "64")]
fn the_largest_image_is_counted_and_reached_to_its_end() -> Result<(), CameraError> {
    let camera = camera()?;
    let rays = camera.rays(u32::MAX, u32::MAX);
    assert_eq!(rays.len(), 0xffff_fffe_0000_0001);
    let mut last = rays.clone();
    assert_eq!(last.nth(rays.len() - 1), rays.clone().next_back());
    assert_eq!(last.next(), None);
    // In no time.
    assert_eq!(rays.clone().count(), 0xffff_fffe_0000_0001);
    let pixel = Vec2::splat(2_f32.powi(32));
    let last = rays.clone().last().map(|ray| ray.direction);
    assert!(last.is_some_and(|last| {
        (last - camera.pixel_ray(pixel, u32::MAX, u32::MAX).direction).length() < 1e-6
    }));
    assert_eq!(rays.clone().nth(usize::MAX), None);
    Ok(())
}

/// The middle of an image looks straight ahead, and where else a pixel is on an axis, nothing is left of the other: exactly.
#[test]
fn what_is_on_an_axis_is_exactly_there() -> Result<(), CameraError> {
    let frame = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?;
    for pixels in [1, 2, 3, 7, 640, 1001, 1920, 65_537, 1 << 24] {
        let size = f64::from(pixels);
        for scale in [1.0, 0.1, 1e-3, 1.0 / 3.0, 7e20] {
            let camera = frame.perspective(ViewRect::centered(1.6 * scale, 0.9 * scale), 1.0)?;
            let middle = camera.pixel_ray(dvec2(0.5 * size, 0.5 * size), pixels, pixels);
            assert_eq!(middle.direction, DVec3::NEG_Z, "{pixels} {scale}");
            for (x, u) in [(0.0, camera.view().left), (size, camera.view().right)] {
                let edge = camera.pixel_ray(dvec2(x, 0.5 * size), pixels, pixels);
                assert_eq!(edge.direction, dvec3(u, 0.0, -1.0), "{pixels} {scale}");
            }
        }
    }
    // The axis is at so many sevenths of the image.
    for pixels in [7, 49, 1001, 7 * 1_000_003] {
        for part in [1, 2, 3, 4, 5, 6] {
            let (before, after) = (f64::from(part) / 8.0, f64::from(7 - part) / 8.0);
            let view = ViewRect { left: -before, right: after, bottom: -after, top: before };
            let on_axis = f64::from(pixels / 7 * part);
            let camera = frame.perspective(view, 1e-9)?;
            let ray = camera.pixel_ray(dvec2(on_axis, on_axis), pixels, pixels);
            assert_eq!(ray.direction, dvec3(0.0, 0.0, -1e-9), "{part} {pixels}");
        }
    }
    Ok(())
}

/// Each ray, taken from the front, from the back and by its number, has the bits of its pixel's.
fn check_bits(camera: &Camera<DVec3>, width: u32, height: u32) {
    let bits = |ray: Ray<DVec3>| {
        let ([a, b, c], [d, e, f]) = (ray.origin.to_array(), ray.direction.to_array());
        [a, b, c, d, e, f].map(f64::to_bits)
    };
    let mut expected = Vec::new();
    for row in 0..height {
        for column in 0..width {
            let pixel = dvec2(f64::from(column) + 0.5, f64::from(row) + 0.5);
            expected.push(bits(camera.pixel_ray(pixel, width, height)));
        }
    }
    let rays = camera.rays(width, height);
    assert!(rays.clone().map(bits).eq(expected.iter().copied()), "{camera:?}, {width} by {height}");
    assert!(rays.clone().rev().map(bits).eq(expected.iter().rev().copied()));
    for step in [2, 3, 7, 100] {
        assert!(rays.clone().step_by(step).map(bits).eq(expected.iter().copied().step_by(step)));
        // What follows a jump.
        let mut jumped = rays.clone();
        assert_eq!(jumped.nth(step).map(bits), expected.get(step).copied());
        assert!(jumped.map(bits).eq(expected.iter().copied().skip(step + 1)));
    }
}

#[test]
fn rays_have_the_bits_of_their_pixels() -> Result<(), CameraError> {
    let frame = Frame::look_at(dvec3(0.1, 0.2, 0.3), DVec3::ZERO, DVec3::Y)?;
    let axes = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?;
    let largest_but_one = f64::from_bits(f64::MAX.to_bits() - 1);
    for view in [
        ViewRect::centered(1.6, 0.9),
        ViewRect { left: -0.3, right: 1.1, bottom: -0.7, top: 0.1 },
        ViewRect { left: 1e9, right: 1e9 + 0.1, bottom: -1e9, top: -1e9 + 0.1 },
        ViewRect { left: 0.0, right: 1e-310, bottom: -1e-310, top: -0.0 },
        ViewRect { left: -8e307, right: 8e307, bottom: 1.7e308, top: f64::MAX },
        ViewRect { left: largest_but_one, right: f64::MAX, bottom: -f64::MAX, top: 0.0 },
    ] {
        for (width, height) in [(1, 1), (1, 7), (7, 1), (16, 9), (33, 21)] {
            for frame in [frame, axes] {
                check_bits(&frame.perspective(view, 0.7)?, width, height);
                check_bits(&frame.orthographic(view)?, width, height);
            }
        }
    }
    Ok(())
}

#[test]
fn centers_of_pixels_are_exact_where_f32_cannot_count_them() -> Result<(), CameraError> {
    // Columns beyond 2^24 are not all f32, their centers not even beyond 2^23.
    let (width, column) = (1 << 25, (1u32 << 24) + 1);
    let view = ViewRect::centered(4.0, 3.0);
    let single = Camera::orthographic(Vec3::Z, Vec3::ZERO, Vec3::Y, view)?;
    let double =
        Camera::orthographic(DVec3::Z, DVec3::ZERO, DVec3::Y, ViewRect::centered(4.0, 3.0))?;
    let exact = double.pixel_ray(dvec2(f64::from(column) + 0.5, 0.5), width, 1);
    let ray = single.rays(width, 1).nth(column.try_into().expect("25 bits"));
    assert_eq!(ray.map(|ray| ray.origin), Some(exact.origin.as_vec3()));
    Ok(())
}

#[test]
fn a_field_of_view_is_a_view_rectangle_at_distance_one() -> Result<(), CameraError> {
    let camera = Camera::perspective_fov(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2, 2.0)?;
    assert_eq!(camera.distance(), Some(1.0));
    assert_eq!(camera.view(), ViewRect::centered(4.0, 2.0));
    Ok(())
}

#[test]
fn a_camera_tells_what_it_was_made_of() -> Result<(), CameraError> {
    let camera = camera()?;
    assert_eq!(camera.eye(), vec3(1.0, 2.0, 3.0));
    assert_eq!(camera.view(), ViewRect { left: -1.0, right: 3.0, bottom: -0.5, top: 1.5 });
    assert_eq!(camera.distance(), Some(2.0));
    let orthographic = Camera::orthographic(Vec3::Z, Vec3::ZERO, Vec3::Y, camera.view())?;
    assert_eq!(orthographic.distance(), None);
    assert_eq!(orthographic.basis(), [Vec3::X, Vec3::Y, Vec3::Z]);
    Ok(())
}
