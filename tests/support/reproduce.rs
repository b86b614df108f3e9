//! A failing case as source text, to the bit.

use eyeray::{Ray, Sphere};

use super::float::Float;
use super::oracle::Coordinates;

/// The ray and the sphere, first to be read and then to be compiled.
pub fn source<V: Coordinates>(ray: &Ray<V>, sphere: &Sphere<V>) -> String {
    let vector = |v: V| {
        let [x, y, z] = v.coordinates().map(Float::source);
        format!("V::new({x}, {y}, {z})")
    };
    let (origin, direction, center) =
        (vector(ray.origin), vector(ray.direction), vector(sphere.center));
    format!(
        "{ray:?}\n{sphere:?}\nRay::new({origin}, {direction})\nSphere::new({center}, {})",
        sphere.radius.source()
    )
}
