//! The pixels of an image and their rays.

use core::f32::consts::FRAC_PI_2;

use eyeray::{Camera, CameraError, Ray, ViewRect};
use glam::{DVec3, Vec2, Vec3, dvec2, vec2, vec3};

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
    assert_eq!(rays.clone().collect::<Vec<Ray>>(), expected);
    assert_eq!(rays.clone().nth(7), Some(expected[7]));
    assert_eq!(rays.clone().nth_back(2), Some(expected[12]));
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
