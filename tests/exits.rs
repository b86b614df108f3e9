//! Where a ray leaves a sphere, against exact arithmetic.

use eyeray::{Ray, Scalar, Sphere, Vector, nearest};
use glam::{DVec3, Vec3};

mod support;

use support::families::{FAMILIES, Rng};
use support::float::Float;
use support::oracle::{Coordinates, Truth};

/// Compares an exit with the exact one. Returns whether there is one, and whether it has the `t` of the entry.
#[track_caller]
fn check<V>(ray: &Ray<V>, sphere: &Sphere<V>) -> (bool, bool)
where
    V: Coordinates + Vector<Scalar: Float>,
{
    let all = V::Scalar::ZERO..V::Scalar::INFINITY;
    let exit = sphere.exit(ray, all.clone());
    let Some(truth) = Truth::new(ray, sphere) else {
        assert!(exit.is_none(), "{ray:?}, {sphere:?}");
        return (false, false);
    };
    let [near, far] = [0, 1].map(|root: usize| truth.roots[root].nearest::<V::Scalar>());
    let Some(exit) = exit else {
        assert!(far <= V::Scalar::ZERO || far == V::Scalar::INFINITY, "{ray:?}, {sphere:?}");
        return (false, false);
    };
    assert!(exit.t == far && exit.t > V::Scalar::ZERO, "{ray:?}, {sphere:?}: {exit:?}");
    let errors = [truth.point_error(1, exit.point), truth.normal_error(1, exit.normal) / 2.0];
    assert!(errors[0] <= 1.0 && errors[1] <= 1.0, "{ray:?}, {sphere:?}: {exit:?}, {errors:?}");
    assert!(sphere.exit(ray, V::Scalar::ZERO..far).is_none(), "{ray:?}, {sphere:?}");
    (true, near == far)
}

#[test]
fn leaves_every_family_where_the_exact_ray_does() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for _ in 0..300 {
            let (ray, sphere) = (family.f32)(&mut rng);
            check(&ray, &sphere);
            let (ray, sphere) = (family.f64)(&mut rng);
            check(&ray, &sphere);
        }
    }
}

/// From so far away that both roots round to the same number, or nearly.
fn leaves_on_the_other_side<V>(digits: i32)
where
    V: Coordinates + Vector<Scalar: Float>,
{
    let mut rng = Rng::new(7);
    let (mut exits, mut same) = (0, 0);
    for _ in 0..3000 {
        let center = rng.unit_vector() * rng.uniform(0.0, 10.0);
        let radius = 10_f64.powf(rng.uniform(-3.0, 1.0));
        let target = center + rng.unit_vector() * radius * rng.uniform(0.0, 1.0);
        let distance = f64::from(digits).exp2() * rng.uniform(0.1, 9.0) * radius;
        // Along an axis, so that the ray as given still passes through.
        let mut axis = DVec3::ZERO;
        axis[usize::try_from(rng.below(3)).unwrap()] = rng.sign();
        let ray = Ray::new(
            V::from_f64(target + axis * distance),
            V::from_f64(-axis * rng.uniform(0.5, 3.0)),
        );
        let sphere = Sphere::new(V::from_f64(center), V::Scalar::from_f64(radius));
        let (leaves, has_same) = check(&ray, &sphere);
        exits += u32::from(leaves);
        same += u32::from(has_same);
    }
    assert!(exits > 1000 && same > 300, "{exits} exits, {same} at the t of the entry");
}

#[test]
fn leaves_on_the_other_side_at_the_same_t() {
    leaves_on_the_other_side::<Vec3>(24);
    leaves_on_the_other_side::<DVec3>(53);
}

/// Both exits round to the largest number, above which there is no next one to tell its ulp.
#[test]
fn compares_exits_at_the_largest_number() {
    let radius = f32::MAX;
    let around = Sphere::new(Vec3::ZERO, radius);
    // It is left a little earlier, and entered much later.
    let beside = Sphere::new(Vec3::new(1.0, -radius / 2.0, 0.0), radius / 2.0);
    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Y);
    for spheres in [[around, beside], [beside, around]] {
        let found = nearest(&spheres, &ray, 1.0..f32::INFINITY);
        let found = found.map(|(index, hit)| (spheres[index], hit.t));
        assert_eq!(found, Some((beside, radius)));
    }
}
