//! One sphere met in each precision asked for, by eyeray or by the formula: programs of which this is all have the size of the
//! routines.

use core::hint::black_box;

use eyeray::{Hittable, Ray, Scalar, Sphere, Vector};

/// Meets one sphere in each precision asked for.
pub fn meet_a_sphere() {
    if cfg!(feature = "f32") {
        meet(libm::sqrtf, glam::Vec3::ZERO);
    }
    if cfg!(feature = "f64") {
        meet(libm::sqrt, glam::DVec3::ZERO);
    }
}

fn meet<V: Vector>(square_root: fn(V::Scalar) -> V::Scalar, zero: V) {
    let (ray, sphere) = black_box((Ray::new(zero, zero), Sphere::new(zero, V::Scalar::ONE)));
    if cfg!(feature = "formula") {
        black_box(by_formula(&ray, &sphere, square_root));
    } else {
        black_box(sphere.intersect(&ray, V::Scalar::ZERO..V::Scalar::INFINITY));
    }
}

/// The lecture's formula, S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*: the first root ahead.
fn by_formula<V: Vector>(
    ray: &Ray<V>,
    sphere: &Sphere<V>,
    square_root: fn(V::Scalar) -> V::Scalar,
) -> Option<V::Scalar> {
    let o = sphere.center - ray.origin;
    let a = ray.direction.dot(ray.direction);
    let h = ray.direction.dot(o);
    let c = o.dot(o) - sphere.radius * sphere.radius;
    let discriminant = h * h - a * c;
    if discriminant < V::Scalar::ZERO {
        return None;
    }
    let root = square_root(discriminant);
    [(h - root) / a, (h + root) / a].into_iter().find(|&t| t > V::Scalar::ZERO)
}
