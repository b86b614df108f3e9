//! The sphere that is returned is the one in front, also from so far away that distances round to the same number.

use eyeray::{
    Algebraic, Geometric, Hit, Hittable, Ray, Scalar, Sphere, SphereBvh, Spheres, Vector, nearest,
};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

mod support;

use support::families::Rng;
use support::oracle::Coordinates;
use support::order::first_of;

fn all<S: Scalar>() -> std::ops::Range<S> {
    S::ZERO..S::INFINITY
}

/// A sphere with something else, as scenes have it, that tells which sphere it is.
struct Painted<V: Vector>(Sphere<V>);

impl<V: Vector> Hittable<V> for Painted<V> {
    fn intersect(&self, ray: &Ray<V>, range: std::ops::Range<V::Scalar>) -> Option<Hit<V>> {
        self.0.intersect(ray, range)
    }

    fn as_sphere(&self) -> Option<Sphere<V>> {
        self.0.as_sphere()
    }
}

/// The same, but for that: a shape that knows nothing of this crate's order.
struct Shape<V: Vector>(Sphere<V>);

impl<V: Vector> Hittable<V> for Shape<V> {
    fn intersect(&self, ray: &Ray<V>, range: std::ops::Range<V::Scalar>) -> Option<Hit<V>> {
        self.0.intersect(ray, range)
    }
}

/// Compares what slices of all kinds return with the exact answer. Returns how many spheres tied.
#[track_caller]
fn check<V: Coordinates>(ray: &Ray<V>, spheres: &[Sphere<V>]) -> usize {
    let (expected, ties) = first_of(ray, spheres).unzip();
    let index = |found: Option<(usize, Hit<V>)>| found.map(|(index, _)| index);
    let message = || format!("{ray:?}, {spheres:?}");
    assert_eq!(index(nearest(spheres, ray, all())), expected, "{}", message());
    let algebraic: Vec<_> = spheres.iter().copied().map(Algebraic).collect();
    assert_eq!(index(nearest(&algebraic, ray, all())), expected, "{}", message());
    let geometric: Vec<_> = spheres.iter().copied().map(Geometric).collect();
    assert_eq!(index(nearest(&geometric, ray, all())), expected, "{}", message());
    let boxed: Vec<Box<dyn Hittable<V>>> =
        spheres.iter().map(|&sphere| Box::new(Painted(sphere)) as _).collect();
    assert_eq!(index(nearest(&boxed, ray, all())), expected, "{}", message());
    // The same from the other end, where no two are equal.
    let reversed: Vec<_> = spheres.iter().rev().copied().collect();
    let last = first_of(ray, &reversed).map(|(index, _)| index);
    assert_eq!(index(nearest(&reversed, ray, all())), last, "{}", message());
    ties.unwrap_or(0)
}

/// The same of the collections.
#[track_caller]
fn check_collections(ray: &Ray, spheres: &[Sphere]) {
    let expected = first_of(ray, spheres).map(|(index, _)| index);
    let scan = Spheres::from(spheres.to_vec());
    let hierarchy: SphereBvh = spheres.iter().copied().collect();
    let found = scan.nearest(ray, all());
    assert_eq!(found.map(|(index, _)| index), expected, "{ray:?}, {spheres:?}");
    assert_eq!(hierarchy.nearest(ray, all()), found, "{ray:?}, {spheres:?}");
}

fn scene(rng: &mut Rng, count: u32, is_chain: bool) -> Vec<Sphere<DVec3>> {
    (0..count)
        .map(|i| {
            let along = if is_chain { DVec3::X * 0.7 * f64::from(i) } else { DVec3::ZERO };
            let extent = if is_chain { 0.5 } else { 4.0 };
            Sphere::new(
                along + rng.unit_vector() * extent * rng.uniform(0.0, 1.0),
                rng.uniform(1.2, 1.9),
            )
        })
        .collect()
}

/// Chains and clouds of atoms from 1e2 to 1e8 radii away, and in `f64` up to 1e16 too, from one eye and by parallel rays.
#[test]
fn the_atom_in_front_is_hit_from_any_distance() {
    let mut rng = Rng::new(1);
    let mut ties = [0; 2];
    for exponent in 2..=8 {
        for is_chain in [true, false] {
            for count in [5, 40] {
                let spheres = scene(&mut rng, count, is_chain);
                let single: Vec<Sphere> = spheres
                    .iter()
                    .map(|s| Sphere::new(s.center.as_vec3(), f32::from_f64(s.radius)))
                    .collect();
                for is_parallel in [true, false] {
                    let view = if is_chain { DVec3::X } else { rng.unit_vector() };
                    let eye = view * -10_f64.powi(exponent);
                    // From where distances tie in `f64`, too.
                    let farther = eye * 1e8;
                    for _ in 0..6 {
                        let aside = rng.unit_vector() * rng.uniform(0.0, 1.5);
                        let (origin, direction) = if is_parallel {
                            (eye + aside, view)
                        } else {
                            (eye, view * 10_f64.powi(exponent) + aside)
                        };
                        check(&Ray::new(origin, direction), &spheres);
                        let far_ray = if is_parallel {
                            Ray::new(farther + aside, direction)
                        } else {
                            Ray::new(farther, aside - farther)
                        };
                        ties[0] += check(&far_ray, &spheres);
                        let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
                        ties[1] += check(&ray, &single);
                        check_collections(&ray, &single);
                    }
                }
            }
        }
    }
    assert!(ties[0] > 20 && ties[1] > 200, "{ties:?}");
}

/// Containers tell which sphere they hold, and of shapes that tell nothing, the first of those at the same distance is returned.
#[test]
fn spheres_are_compared_through_pointers_and_shapes_are_not() {
    let ray = Ray::new(Vec3::X * -1e7, Vec3::X);
    let spheres = [0.2, 0.1].map(|x| Sphere::new(Vec3::X * x, 1.0));
    let hits = spheres.map(|sphere| sphere.intersect(&ray, all()).map(|hit| hit.t));
    assert_eq!(hits[0], hits[1]);
    let index = |found: Option<(usize, Hit)>| found.map(|(index, _)| index);
    assert_eq!(index(nearest(&spheres.each_ref(), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(Box::new), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(std::rc::Rc::new), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(std::sync::Arc::new), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(Algebraic), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(Geometric), &ray, all())), Some(1));
    assert_eq!(index(nearest(&spheres.map(Shape), &ray, all())), Some(0));
    // A slice is hit where the sphere in front is.
    let point = |scene: &dyn Hittable| scene.intersect(&ray, all()).map(|hit| hit.point);
    assert_eq!(point(&spheres), point(&spheres[1]));
}

/// From inside, where the far crossings are compared, and of equal ones the lowest index.
#[test]
fn the_first_wall_is_hit_from_inside() {
    let mut rng = Rng::new(2);
    for _ in 0..200 {
        let inside = rng.unit_vector().as_vec3() * 0.3;
        let large = 2_f32.powi(24);
        let spheres: Vec<Sphere> = (0..9)
            .map(|_| Sphere::new(rng.unit_vector().as_vec3(), large))
            .flat_map(|sphere| [sphere, sphere])
            .collect();
        let ray = Ray::new(inside, rng.unit_vector().as_vec3());
        check(&ray, &spheres);
        check_collections(&ray, &spheres);
    }
}

proptest! {
    /// Of any two spheres that a far eye sees in the same direction, the one that is returned is in front.
    #[test]
    fn of_two_spheres_the_one_in_front_is_returned(
        distance in 1e5_f32..1e8,
        (y, z) in (-0.5_f32..0.5, -0.5_f32..0.5),
        centers in [[-1.0_f32..1.0, -0.2..0.2, -0.2..0.2], [-1.0..1.0, -0.2..0.2, -0.2..0.2]],
        radii in [0.8_f32..1.5, 0.8..1.5],
    ) {
        let spheres = [0, 1].map(|i| Sphere::new(Vec3::from(centers[i]), radii[i]));
        let ray = Ray::new(Vec3::new(-distance, y, z), Vec3::X);
        check(&ray, &spheres);
        check_collections(&ray, &spheres);
    }
}
