//! The bytes of a ray and of a sphere are its numbers, in the order of its fields.

use bytemuck::{Zeroable, bytes_of, cast_slice, cast_slice_mut};
use eyeray::{Ray, Sphere};
use glam::{DVec3, Vec3, dvec3, vec3};

#[test]
fn numbers_as_rays_and_spheres() {
    let numbers = [1.0_f32, -2.0, 3.0, 4.0, -0.0, f32::INFINITY, 7.0, f32::MIN_POSITIVE];
    assert_eq!(
        cast_slice::<f32, Sphere>(&numbers),
        [
            Sphere::new(vec3(1.0, -2.0, 3.0), 4.0),
            Sphere::new(vec3(-0.0, f32::INFINITY, 7.0), f32::MIN_POSITIVE)
        ]
    );
    assert_eq!(
        cast_slice::<f32, Ray>(&numbers[..6]),
        [Ray::new(vec3(1.0, -2.0, 3.0), vec3(4.0, -0.0, f32::INFINITY))]
    );

    let numbers = [1.0_f64, -2.0, 3.0, 4.0, -0.0, f64::INFINITY, 7.0, f64::MIN_POSITIVE];
    assert_eq!(
        cast_slice::<f64, Sphere<DVec3>>(&numbers),
        [
            Sphere::new(dvec3(1.0, -2.0, 3.0), 4.0),
            Sphere::new(dvec3(-0.0, f64::INFINITY, 7.0), f64::MIN_POSITIVE)
        ]
    );
    assert_eq!(
        cast_slice::<f64, Ray<DVec3>>(&numbers[..6]),
        [Ray::new(dvec3(1.0, -2.0, 3.0), dvec3(4.0, -0.0, f64::INFINITY))]
    );
}

#[test]
fn rays_and_spheres_as_bytes() {
    let sphere = Sphere::new(vec3(1.0, 2.0, 3.0), 4.0);
    let numbers = [1.0_f32, 2.0, 3.0, 4.0].map(f32::to_ne_bytes);
    assert_eq!(bytes_of(&sphere), numbers.as_flattened());

    let ray = Ray::new(dvec3(1.0, 2.0, 3.0), dvec3(4.0, 5.0, 6.0));
    let numbers = [1.0_f64, 2.0, 3.0, 4.0, 5.0, 6.0].map(f64::to_ne_bytes);
    assert_eq!(bytes_of(&ray), numbers.as_flattened());
}

#[test]
fn written_through_the_bytes() {
    let mut spheres = [Sphere::new(Vec3::ZERO, 1.0); 2];
    cast_slice_mut::<Sphere, f32>(&mut spheres)[7] = 2.5;
    assert_eq!(spheres[1].radius, 2.5);
}

#[test]
fn zero_is_the_default() {
    assert_eq!(Ray::<Vec3>::zeroed(), Ray::default());
    assert_eq!(Ray::<DVec3>::zeroed(), Ray::default());
    assert_eq!(Sphere::<Vec3>::zeroed(), Sphere::default());
    assert_eq!(Sphere::<DVec3>::zeroed(), Sphere::default());
}
