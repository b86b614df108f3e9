//! What a hit tells of itself, whatever is in it.

use eyeray::{Hit, Hittable, Ray, Scalar, Sphere, Vector};
use glam::{DVec3, Vec3};

/// Where rays start that leave a hit with that bound on its error: always at its clearance, and 0 where that is not known.
fn starts_at_its_clearance<V: Vector>(error: f64, point: DVec3, expected: Option<f64>) {
    let scalar = V::Scalar::from_f64;
    let hit = Hit::new(scalar(1.0), V::from_f64(point), V::from_f64(DVec3::X), scalar(error));
    let clearance: f64 = hit.clearance().into();
    if let Some(expected) = expected {
        assert_eq!(clearance, expected, "{error}, {point}");
    }
    for direction in [DVec3::X, DVec3::NEG_X] {
        let start = hit.spawn(V::from_f64(direction)).origin.to_f64();
        let moved = V::from_f64(DVec3::X * direction.x) * hit.clearance();
        assert_eq!(start, (V::from_f64(point) + moved).to_f64(), "{error}, {point}");
    }
}

#[test]
fn rays_start_at_the_clearance_whatever_the_bound_on_the_error() {
    for error in [f64::NAN, f64::INFINITY] {
        for point in [DVec3::ZERO, DVec3::ONE, DVec3::splat(1e30)] {
            starts_at_its_clearance::<Vec3>(error, point, Some(0.0));
            starts_at_its_clearance::<DVec3>(error, point, Some(0.0));
        }
    }
    starts_at_its_clearance::<Vec3>(0.5, DVec3::ZERO, Some(0.5));
    starts_at_its_clearance::<DVec3>(0.5, DVec3::ZERO, Some(0.5));
    starts_at_its_clearance::<Vec3>(0.0, DVec3::ONE, Some(4.0 * f64::from(f32::EPSILON)));
    starts_at_its_clearance::<DVec3>(0.0, DVec3::ONE, Some(4.0 * f64::EPSILON));
    starts_at_its_clearance::<Vec3>(0.0, DVec3::INFINITY, Some(0.0));
    starts_at_its_clearance::<DVec3>(0.0, DVec3::INFINITY, Some(0.0));
}

#[test]
fn debugging_shows_the_public_fields() {
    let sphere = Sphere::new(Vec3::ZERO, 1.0);
    let ray = Ray::new(Vec3::Z * 3.0, Vec3::NEG_Z);
    let hit = sphere.intersect(&ray, 0.0..f32::INFINITY).expect("a hit ahead");
    let normal = "Vec3(0.0, 0.0, 1.0)";
    assert_eq!(
        format!("{hit:?}"),
        format!("Hit {{ t: 2.0, point: {normal}, normal: {normal}, .. }}")
    );
}
