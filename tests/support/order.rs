//! Which of many spheres is in front, by exact arithmetic.

use eyeray::{Ray, Scalar, Sphere, Vector};

use super::float::Float;
use super::oracle::{Coordinates, Root, Truth};

/// The first crossing of a sphere with a finite t > 0, and that rounded.
fn first_crossing<V: Coordinates>(ray: &Ray<V>, sphere: &Sphere<V>) -> Option<(Root, V::Scalar)> {
    let roots = Truth::new(ray, sphere)?.roots.into_iter();
    roots
        .map(|root| {
            let t = root.nearest::<V::Scalar>();
            (root, t)
        })
        .find(|(_, t)| *t > V::Scalar::ZERO && *t < V::Scalar::INFINITY)
}

/// The sphere whose exact root is least among those whose root, rounded, is finite and above 0; of equal ones the lowest index.
/// And how many others have a root that rounds to the same number.
pub fn first_of<V>(ray: &Ray<V>, spheres: &[Sphere<V>]) -> Option<(usize, usize)>
where
    V: Coordinates + Vector<Scalar: Float>,
{
    let mut first: Option<(usize, Root, V::Scalar)> = None;
    let mut ties = 0;
    for (index, sphere) in spheres.iter().enumerate() {
        let Some((root, t)) = first_crossing(ray, sphere) else { continue };
        let is_first = match &first {
            None => true,
            Some((_, _, first_t)) if t != *first_t => t < *first_t,
            Some((_, first_root, _)) => {
                ties += 1;
                root.order(first_root).is_lt()
            }
        };
        if is_first {
            first = Some((index, root, t));
        }
    }
    first.map(|(index, ..)| (index, ties))
}
