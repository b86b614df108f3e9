//! The lecture, formula by formula, with values that can be checked by hand.
//!
//! S. Marschner, CS4620 lecture 6, ray tracing: rays, the eye rays of a camera, and the intersection of a ray with a sphere
//! by the algebraic and by the geometric derivation.

use eyeray::{Camera, CameraError, Hittable, Ray, Sphere, ViewRect};
use glam::{Vec3, vec2, vec3};

const UNIT_SPHERE: Sphere = Sphere::new(Vec3::ZERO, 1.0);
const HALF_LINE: core::ops::Range<f32> = 0.0..f32::INFINITY;

/// r(t) = p + t d.
#[test]
fn a_ray_is_its_origin_plus_t_directions() {
    let ray = Ray::new(vec3(1.0, 2.0, 3.0), vec3(0.0, 3.0, -4.0));
    assert_eq!(ray.at(0.0), vec3(1.0, 2.0, 3.0));
    assert_eq!(ray.at(1.0), vec3(1.0, 5.0, -1.0));
    assert_eq!(ray.at(0.5), vec3(1.0, 3.5, 1.0));
}

/// Replacing d by a d, for a > 0, does not change the half-line: every point is found at t / a.
#[test]
fn a_longer_direction_is_the_same_ray() {
    let ray = Ray::new(vec3(1.0, 2.0, 3.0), vec3(0.0, 3.0, -4.0));
    let longer = Ray::new(ray.origin, ray.direction * 2.0);
    assert_eq!(longer.at(0.75), ray.at(1.5));

    // Towards the sphere from 3 away, in steps of 1 and of 4.
    for (direction, t) in [(1.0, 2.0), (4.0, 0.5)] {
        let ray = Ray::new(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, -direction));
        assert_eq!(UNIT_SPHERE.intersect(&ray, HALF_LINE).map(|hit| hit.t), Some(t));
    }
}

/// The basis: w against the direction of view, u at right angles to up and w, v at right angles to both.
///
/// With an eye at (0, 3, 4) that looks to the origin, w = (0, 3, 4) / 5. With up along y, up × w = (4, 0, 0) / 5, so u is
/// the x axis, and v = w × u = (0, 4, -3) / 5.
#[test]
fn the_camera_basis_follows_from_the_view_and_up() -> Result<(), CameraError> {
    let view = ViewRect::centered(2.0, 2.0);
    let camera = Camera::orthographic(vec3(0.0, 3.0, 4.0), Vec3::ZERO, Vec3::Y, view)?;
    assert_eq!(camera.basis(), [vec3(1.0, 0.0, 0.0), vec3(0.0, 0.8, -0.6), vec3(0.0, 0.6, 0.8)]);
    Ok(())
}

/// Orthographic: s = e + u U + v V, p = s, d = -W.
#[test]
fn orthographic_rays_begin_on_the_view_plane_and_are_parallel() -> Result<(), CameraError> {
    let eye = vec3(5.0, 6.0, 7.0);
    let camera = Camera::orthographic(eye, eye - Vec3::Z, Vec3::Y, ViewRect::centered(4.0, 3.0))?;
    assert_eq!(camera.ray(vec2(0.0, 0.0)), Ray::new(eye, vec3(0.0, 0.0, -1.0)));
    assert_eq!(camera.ray(vec2(1.5, -0.5)), Ray::new(vec3(6.5, 5.5, 7.0), vec3(0.0, 0.0, -1.0)));
    Ok(())
}

/// Perspective: s = e + u U + v V - d W, p = e, d = s - e.
#[test]
fn perspective_rays_begin_at_the_eye_and_go_through_the_view_plane() -> Result<(), CameraError> {
    let eye = vec3(5.0, 6.0, 7.0);
    let camera =
        Camera::perspective(eye, eye - Vec3::Z, Vec3::Y, ViewRect::centered(4.0, 3.0), 2.0)?;
    assert_eq!(camera.ray(vec2(0.0, 0.0)), Ray::new(eye, vec3(0.0, 0.0, -2.0)));

    // The direction is not unit: at t = 1 the ray is at s, in the view plane.
    let ray = camera.ray(vec2(1.5, -0.5));
    assert_eq!(ray, Ray::new(eye, vec3(1.5, -0.5, -2.0)));
    assert_eq!(ray.at(1.0), vec3(6.5, 5.5, 5.0));
    Ok(())
}

/// The focal length d: with twice of it, the same view rectangle shows half as much of the scene.
#[test]
fn a_longer_focal_length_magnifies() -> Result<(), CameraError> {
    let view = ViewRect::centered(2.0, 2.0);
    let point = vec3(3.0, 6.0, -12.0);
    for (distance, uv) in [(1.0, vec2(0.25, 0.5)), (2.0, vec2(0.5, 1.0)), (4.0, vec2(1.0, 2.0))] {
        let camera = Camera::perspective(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view, distance)?;
        assert_eq!(camera.project(point), Some(uv));
    }
    Ok(())
}

/// `u = l + (r - l) (i + 0.5) / n_x` and `v = b + (t - b) (j + 0.5) / n_y`, where j counts rows from the bottom: the same
/// as `v = t - (t - b) (j' + 0.5) / n_y` with rows counted from the top.
#[test]
fn pixel_centers_divide_the_view_rectangle() -> Result<(), CameraError> {
    let view = ViewRect { left: -1.0, right: 3.0, bottom: 0.0, top: 2.0 };
    let camera = Camera::orthographic(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, view)?;
    let mut rays = camera.rays(4, 2);
    for v in [1.5, 0.5] {
        for u in [-0.5, 0.5, 1.5, 2.5] {
            assert_eq!(rays.next(), Some(camera.ray(vec2(u, v))));
        }
    }
    assert_eq!(rays.next(), None);
    Ok(())
}

/// Generating rays and projecting points are inverse processes.
#[test]
fn projection_undoes_ray_generation() -> Result<(), CameraError> {
    let view = ViewRect::centered(2.0, 2.0);
    let eye = vec3(1.0, 0.0, 8.0);
    let uv = vec2(0.5, -0.75);
    let orthographic = Camera::orthographic(eye, vec3(1.0, 0.0, 0.0), Vec3::Y, view)?;
    let perspective = Camera::perspective(eye, vec3(1.0, 0.0, 0.0), Vec3::Y, view, 2.0)?;
    for camera in [orthographic, perspective] {
        for t in [0.5, 1.0, 16.0] {
            assert_eq!(camera.project(camera.ray(uv).at(t)), Some(uv));
        }
    }
    Ok(())
}

/// Algebraic: |p + t d|² = 1 is the quadratic (d·d) t² + 2 (p·d) t + p·p - 1 = 0, whatever the length of d.
///
/// From p = (0, 0, 3) along d = (0, 0, -2): 4 t² - 12 t + 8 = 0, whose roots are 1 and 2.
#[test]
fn the_quadratic_has_the_two_roots() {
    let ray = Ray::new(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, -2.0));
    assert_eq!(UNIT_SPHERE.roots_algebraic(&ray), Some([1.0, 2.0]));

    // Any center and radius: p less the center, and the radius squared for 1. 25 t² - 250 t + 400 = 0.
    let sphere = Sphere::new(vec3(1.0, 2.0, 3.0), 15.0);
    let ray = Ray::new(vec3(-14.0, 2.0, -17.0), vec3(3.0, 0.0, 4.0));
    assert_eq!(sphere.roots_algebraic(&ray), Some([2.0, 8.0]));
}

/// The discriminant decides: negative is a miss, zero touches the sphere once, positive is two roots.
#[test]
fn the_discriminant_tells_hit_from_miss() {
    for (height, roots) in [(0.0, Some([2.0, 4.0])), (1.0, Some([3.0, 3.0])), (1.25, None)] {
        let ray = Ray::new(vec3(0.0, height, 3.0), vec3(0.0, 0.0, -1.0));
        assert_eq!(UNIT_SPHERE.roots_algebraic(&ray), roots);
        assert_eq!(UNIT_SPHERE.roots_geometric(&ray), roots);
    }
}

/// Geometric, for a unit direction: the closest approach to the center is at `t_m = -p·d`, its distance is `l_m` with
/// `l_m² = p·p - (p·d)²`, and the roots are `Δt = √(1 - l_m²)` before and after it.
///
/// From p = (0, 0.6, 2) along -z: `t_m = 2`, `l_m² = 4.36 - 4 = 0.36`, `Δt = 0.8`. Binary floats have no 0.6, so here the
/// whole scene is five times as large, and `1 - l_m²` becomes `25 - l_m²`.
#[test]
fn the_roots_lie_a_half_chord_from_the_closest_approach() {
    let sphere = Sphere::new(Vec3::ZERO, 5.0);
    let ray = Ray::new(vec3(0.0, 3.0, 10.0), vec3(0.0, 0.0, -1.0));
    let closest_approach = -ray.origin.dot(ray.direction);
    let distance_squared = ray.origin.dot(ray.origin) - closest_approach * closest_approach;
    let half_chord = (25.0 - distance_squared).sqrt();
    assert_eq!((closest_approach, distance_squared, half_chord), (10.0, 9.0, 4.0));
    let roots = [closest_approach - half_chord, closest_approach + half_chord];
    assert_eq!(roots, [6.0, 14.0]);
    assert_eq!(sphere.roots_geometric(&ray), Some(roots));
}

/// The two derivations are of the same roots.
#[test]
fn both_derivations_agree() {
    let rays = [
        Ray::new(vec3(0.0, 0.5, 3.0), vec3(0.0, 0.0, -1.0)),
        Ray::new(vec3(0.25, -0.5, 0.125), vec3(3.0, 1.0, -2.0)),
        Ray::new(vec3(1.0, 2.0, 3.0), vec3(-1.0, -2.0, -3.5)),
        Ray::new(vec3(0.0, 1.0, 0.0), vec3(1.0, 0.0, 0.0)),
        Ray::new(vec3(0.0, 2.0, 0.0), vec3(1.0, 0.0, 0.0)),
    ];
    for ray in rays {
        assert_eq!(UNIT_SPHERE.roots_algebraic(&ray), UNIT_SPHERE.roots_geometric(&ray));
    }
}

/// The normal at a point of the sphere is (point - center) / radius.
#[test]
fn the_normal_points_from_the_center() {
    let sphere = Sphere::new(vec3(1.0, 1.0, 1.0), 5.0);
    let ray = Ray::new(vec3(4.0, 1.0, 11.0), vec3(0.0, 0.0, -3.0));
    let hit = sphere.intersect(&ray, HALF_LINE);
    assert_eq!(hit.map(|hit| (hit.t, hit.point)), Some((2.0, vec3(4.0, 1.0, 5.0))));
    assert_eq!(hit.map(|hit| hit.normal), Some(vec3(0.6, 0.0, 0.8)));
    assert_eq!(hit.map(|hit| hit.front_face(&ray)), Some(true));
}

/// A ray is a half-line, t > 0: what lies behind its origin is not hit, and from inside the far root counts.
#[test]
fn only_what_is_ahead_is_hit() {
    let hit =
        |z| UNIT_SPHERE.intersect(&Ray::new(vec3(0.0, 0.0, z), vec3(0.0, 0.0, -1.0)), HALF_LINE);
    assert_eq!(hit(3.0).map(|hit| hit.t), Some(2.0));
    assert_eq!(hit(0.0).map(|hit| (hit.t, hit.normal)), Some((1.0, Vec3::NEG_Z)));
    assert_eq!(hit(-3.0), None);
    // From the surface: inwards the other side, outwards nothing, because t = 0 is not on the half-line.
    assert_eq!(hit(1.0).map(|hit| hit.t), Some(2.0));
    assert_eq!(hit(-1.0), None);
}

/// Both together: the eye ray of a pixel, and its hit with the sphere.
#[test]
fn an_eye_ray_meets_the_sphere() -> Result<(), CameraError> {
    let view = ViewRect::centered(6.0, 6.0);
    let camera = Camera::perspective(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, view, 4.0)?;
    // The middle of the image sees the sphere's nearest point, t = 1 being the view plane at 4.
    let hit = UNIT_SPHERE.intersect(&camera.pixel_ray(vec2(32.0, 32.0), 64, 64), HALF_LINE);
    assert_eq!(hit.map(|hit| (hit.t, hit.point)), Some((1.0, Vec3::Z)));
    // The corner looks past it.
    assert_eq!(UNIT_SPHERE.intersect(&camera.pixel_ray(vec2(0.5, 0.5), 64, 64), HALF_LINE), None);
    Ok(())
}
