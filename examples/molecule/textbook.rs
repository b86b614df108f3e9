//! The textbook's formula, in `f32`, for comparison.

use eyeray::{Hit, Ray, Sphere};

use crate::crystal::Atom;

/// Returns the nearest hit and the index of its atom.
pub(crate) fn nearest(atoms: &[Atom], ray: &Ray) -> Option<(usize, Hit)> {
    let hits =
        atoms.iter().enumerate().filter_map(|(i, atom)| Some((i, intersect(&atom.sphere, ray)?)));
    hits.min_by(|(_, a), (_, b)| a.t.total_cmp(&b.t))
}

/// Solves a t² + b t + c = 0, with a = d·d, b = 2 d·(p - center) and c = |p - center|² - r².
fn intersect(sphere: &Sphere, ray: &Ray) -> Option<Hit> {
    let from_center = ray.origin - sphere.center;
    let a = ray.direction.length_squared();
    let b = 2.0 * ray.direction.dot(from_center);
    let c = from_center.length_squared() - sphere.radius * sphere.radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let t = [-b - root, -b + root].map(|numerator| numerator / (2.0 * a));
    let t = t.into_iter().find(|&t| t > 0.0)?;
    let point = ray.at(t);
    let normal = ((point - sphere.center) / sphere.radius).normalize_or_zero();
    Some(Hit::new(t, point, normal, 0.0))
}
