//! `nearest`, `intersect` and `occludes` of a slice against a loop over its spheres: the same hit, bit for bit.
//!
//! The loop asks each sphere's own `intersect` for the whole slice, without the test that a slice asks first.

use std::ops::Range;

use eyeray::{Algebraic, Geometric, Hit, Hittable, Ray, Scalar, Sphere, Vector, nearest};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

mod support;

use support::families::{Case, FAMILIES, Rng};
use support::oracle::{Coordinates, Truth};

/// A precision whose hits can be compared.
trait Compared: Coordinates {
    fn case(family: usize, rng: &mut Rng) -> Case<Self>;
    /// All numbers of a hit: -0.0 is not 0.0 here.
    fn bits(hit: &Hit<Self>) -> [u64; 8];
    /// The float after a positive one.
    fn above(t: Self::Scalar) -> Self::Scalar;
    /// 2 to that power.
    fn power_of_two(exponent: i32) -> Self::Scalar;
}

macro_rules! compared {
    ($vector:ty, $float:ident) => {
        impl Compared for $vector {
            fn case(family: usize, rng: &mut Rng) -> Case<Self> {
                (FAMILIES[family].$float)(rng)
            }

            fn bits(hit: &Hit<Self>) -> [u64; 8] {
                let [a, b, c] = hit.point.to_array();
                let [d, e, f] = hit.normal.to_array();
                // The clearance shows in where a ray starts that leaves.
                let spawned = hit.spawn(hit.normal).origin;
                [hit.t, a, b, c, d, e, f, spawned.x].map(|number| number.to_bits().into())
            }

            fn above(t: $float) -> $float {
                if t > 0.0 && t.is_finite() { $float::from_bits(t.to_bits() + 1) } else { t }
            }

            fn power_of_two(exponent: i32) -> $float {
                $float::powi(2.0, exponent)
            }
        }
    };
}

compared!(Vec3, f32);
compared!(DVec3, f64);

/// The nearest by the spheres' own `intersect`: of equal t by the exact roots, and of these by the lowest index.
fn by_loop<V: Compared, H: Hittable<V>>(
    spheres: &[Sphere<V>],
    objects: &[H],
    ray: &Ray<V>,
    range: &Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let mut found: Option<(usize, Hit<V>)> = None;
    for (index, object) in objects.iter().enumerate() {
        if let Some(hit) = object.intersect(ray, range.clone()) {
            let is_in_front = |first: usize| {
                let roots = [index, first].map(|index| {
                    let [near, far] = Truth::new(ray, &spheres[index]).expect("it is hit").roots;
                    if near.nearest::<V::Scalar>() == hit.t { near } else { far }
                });
                spheres[index] != spheres[first] && roots[0].order(&roots[1]).is_lt()
            };
            if found.is_none_or(|(first, nearest)| {
                hit.t < nearest.t || (hit.t == nearest.t && is_in_front(first))
            }) {
                found = Some((index, hit));
            }
        }
    }
    found
}

#[track_caller]
fn assert_same_as_loop<V: Compared, H: Hittable<V>>(
    spheres: &[Sphere<V>],
    objects: &[H],
    ray: &Ray<V>,
    range: &Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let expected = by_loop(spheres, objects, ray, range);
    let bits = |found: Option<(usize, Hit<V>)>| found.map(|(index, hit)| (index, V::bits(&hit)));
    let found = nearest(objects, ray, range.clone());
    assert_eq!(bits(found), bits(expected), "{} objects, {ray:?}, {range:?}", objects.len());
    let occluded = objects.occludes(ray, range.clone());
    assert_eq!(occluded, expected.is_some(), "{} objects, {ray:?}, {range:?}", objects.len());
    for object in objects {
        let is_hit = object.intersect(ray, range.clone()).is_some();
        assert!(object.may_hit(ray, range.clone()) || !is_hit, "{ray:?}, {range:?}");
    }
    expected
}

/// The same of the spheres in either derivation, and behind references.
fn assert_same_in_all<V: Compared>(
    spheres: &[Sphere<V>],
    ray: &Ray<V>,
    range: &Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let algebraic: Vec<_> = spheres.iter().copied().map(Algebraic).collect();
    let geometric: Vec<_> = spheres.iter().copied().map(Geometric).collect();
    let objects: Vec<&dyn Hittable<V>> = spheres.iter().map(|sphere| sphere as _).collect();
    assert_same_as_loop(spheres, &algebraic, ray, range);
    assert_same_as_loop(spheres, &geometric, ray, range);
    assert_same_as_loop(spheres, &objects, ray, range);
    assert_same_as_loop(spheres, spheres, ray, range)
}

/// Numbers that a scene should not have.
const HOSTILE: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e38,
    1e300,
    f64::MAX,
    1e-45,
    1e-300,
    1e-323,
    1e-22,
    1.8e19,  // beside 2^64
    1.3e154, // beside 2^512
    1.0,
];

fn choose<T: Copy>(rng: &mut Rng, values: &[T]) -> T {
    values[usize::try_from(rng.below(values.len() as u64)).unwrap_or(0)]
}

fn hostile<V: Vector>(rng: &mut Rng) -> V::Scalar {
    V::Scalar::from_f64(choose(rng, &HOSTILE))
}

/// A member of a scene for a ray of a case of that family: the very sphere, one of the same center, or another.
fn member<V: Compared>(rng: &mut Rng, family: usize, of_case: Sphere<V>) -> Sphere<V> {
    let scaled = |by: f64| Sphere::new(of_case.center, of_case.radius * V::Scalar::from_f64(by));
    match rng.below(8) {
        0 | 1 => of_case,
        2 => scaled(1.0 + 1e-6),
        3 => scaled(1.0 - 1e-9),
        4 => V::case(family, rng).1,
        5 => Sphere::new(of_case.center, hostile::<V>(rng)),
        6 => {
            let center = V::from_f64(DVec3::from([(); 3].map(|()| choose(rng, &HOSTILE))));
            Sphere::new(center, hostile::<V>(rng))
        }
        _ => V::case(usize::try_from(rng.below(FAMILIES.len() as u64)).unwrap_or(0), rng).1,
    }
}

/// In ranges that hold all, and that begin or end at a root of one of them.
fn assert_same_in_ranges<V: Compared>(rng: &mut Rng, spheres: &[Sphere<V>], ray: &Ray<V>) -> bool {
    let (zero, infinity) = (V::Scalar::ZERO, V::Scalar::INFINITY);
    let first = assert_same_in_all(spheres, ray, &(zero..infinity)).map(|(_, hit)| hit.t);
    assert_same_in_all(spheres, ray, &(-infinity..infinity));
    let other = (!spheres.is_empty())
        .then(|| choose(rng, spheres))
        .and_then(|sphere| sphere.roots_algebraic(ray))
        .map(|roots| roots[1]);
    for t in first.into_iter().chain(other) {
        for range in [t..infinity, V::above(t)..infinity, zero..t, zero..V::above(t)] {
            assert_same_in_all(spheres, ray, &range);
        }
    }
    assert_same_in_all(spheres, ray, &(hostile::<V>(rng)..hostile::<V>(rng)));
    first.is_some()
}

fn equals_the_loop_in_every_family<V: Compared>() {
    let mut hits = 0;
    for family in 0..FAMILIES.len() {
        let mut rng = Rng::new(family as u64);
        for length in (0..12).chain([46]) {
            let (ray, sphere) = V::case(family, &mut rng);
            let spheres: Vec<_> = (0..length).map(|_| member(&mut rng, family, sphere)).collect();
            hits += u32::from(assert_same_in_ranges(&mut rng, &spheres, &ray));
        }
    }
    assert!(hits > 200, "{hits}");
}

#[test]
fn equals_the_loop_in_every_family_f32() {
    equals_the_loop_in_every_family::<Vec3>();
}

#[test]
fn equals_the_loop_in_every_family_f64() {
    equals_the_loop_in_every_family::<DVec3>();
}

/// A sphere alone among points: nothing nearer hides that it is rejected.
fn finds_every_sphere_alone<V: Compared>(rng: &mut Rng, ray: &Ray<V>, sphere: Sphere<V>) -> bool {
    let infinity = V::Scalar::INFINITY;
    let nothing = Sphere::new(sphere.center, -V::Scalar::ONE);
    let mut spheres = [nothing; 7];
    spheres[usize::try_from(rng.below(7)).unwrap_or(0)] = sphere;
    let found = assert_same_as_loop(&spheres, &spheres, ray, &(V::Scalar::ZERO..infinity));
    if let Some((_, hit)) = found {
        assert_same_as_loop(&spheres, &spheres, ray, &(V::Scalar::ZERO..V::above(hit.t)));
        assert_same_as_loop(&spheres, &spheres, ray, &(hit.t..infinity));
        for direction in [hit.normal, -hit.normal, ray.direction] {
            assert_same_as_loop(
                &spheres,
                &spheres,
                &hit.spawn(direction),
                &(V::Scalar::ZERO..infinity),
            );
        }
    }
    found.is_some()
}

/// From scales whose squares underflow to those whose squares overflow, and likewise directions.
fn finds_every_sphere_at_every_scale<V: Compared>(scales: i32, step: usize) {
    let mut rng = Rng::new(1);
    let mut hits = 0;
    for name in ["easy", "far", "huge", "grazing", "near tangent", "inside"] {
        let family = FAMILIES.iter().position(|family| family.name == name).unwrap();
        for scale in (-scales..scales).step_by(step) {
            for stretch in (-scales..scales).step_by(step) {
                let (ray, sphere) = V::case(family, &mut rng);
                let by = V::power_of_two(scale);
                let ray = Ray::new(ray.origin * by, ray.direction * V::power_of_two(stretch));
                let sphere = Sphere::new(sphere.center * by, sphere.radius * by);
                hits += u32::from(finds_every_sphere_alone(&mut rng, &ray, sphere));
            }
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn finds_every_sphere_at_every_scale_f32() {
    finds_every_sphere_at_every_scale::<Vec3>(125, 5);
}

#[test]
fn finds_every_sphere_at_every_scale_f64() {
    finds_every_sphere_at_every_scale::<DVec3>(1010, 43);
}

/// The square of the distance overflows where that of the radius does not, or neither of two terms does, but their sum.
fn finds_large_spheres_from_afar<V: Compared>(exponent: i32) {
    let mut rng = Rng::new(1);
    let mut hits = 0;
    for distance in -8..8 {
        for _ in 0..200 {
            let direction = V::from_f64(rng.unit_vector());
            let center = V::from_f64(rng.unit_vector()) * V::power_of_two(exponent - 3);
            let radius = V::power_of_two(exponent) * V::Scalar::from_f64(rng.uniform(0.3, 1.5));
            let sideways = V::from_f64(rng.unit_vector()) * radius;
            let origin = center + sideways - direction * V::power_of_two(exponent + distance);
            let ray = Ray::new(origin, direction);
            hits +=
                u32::from(finds_every_sphere_alone(&mut rng, &ray, Sphere::new(center, radius)));
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn finds_large_spheres_from_afar_f32() {
    finds_large_spheres_from_afar::<Vec3>(63);
}

#[test]
fn finds_large_spheres_from_afar_f64() {
    finds_large_spheres_from_afar::<DVec3>(511);
}

#[test]
fn of_equal_distances_the_lowest_index() {
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let sphere = Sphere::new(Vec3::X * 3.0, 1.0);
    for length in 1..=12 {
        for first in 0..length {
            let far = Sphere::new(Vec3::X * 9.0, 1.0);
            let spheres: Vec<_> =
                (0..length).map(|i| if i < first { far } else { sphere }).collect();
            let found = assert_same_in_all(&spheres, &ray, &(0.0..f32::INFINITY));
            assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((first, 2.0)));
        }
    }
}

#[test]
fn rejects_what_is_behind_beside_and_beyond() {
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let at = |x, y| Sphere::new(Vec3::new(x, y, 0.0), 1.0);
    assert!(at(3.0, 0.0).may_hit(&ray, 0.0..f32::INFINITY));
    assert!(!at(3.0, 1.1).may_hit(&ray, 0.0..f32::INFINITY));
    assert!(!at(-3.0, 0.0).may_hit(&ray, 0.0..f32::INFINITY));
    assert!(!at(3.0, 0.0).may_hit(&ray, 0.0..1.9));
    assert!(at(3.0, 0.0).may_hit(&ray, 0.0..2.1));
}

/// Any f32: any bits, or one that a scene has.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        (-10.0_f32..10.0),
        (-3_i8..3).prop_map(f32::from),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from_array)
}

proptest! {
    #[test]
    fn equals_the_loop_on_random_numbers(
        spheres in prop::collection::vec((vector(), number()), 0..=20),
        (origin, direction) in (vector(), vector()),
        (start, end) in (number(), number()),
    ) {
        let spheres: Vec<_> =
            spheres.into_iter().map(|(center, radius)| Sphere::new(center, radius)).collect();
        let double: Vec<Sphere<DVec3>> = spheres.iter().copied().map(Sphere::from).collect();
        let ray = Ray::new(origin, direction);
        for range in [0.0..f32::INFINITY, start..end, start..f32::INFINITY, 0.0..end] {
            assert_same_in_all(&spheres, &ray, &range);
            assert_same_in_all(&double, &ray.into(), &(range.start.into()..range.end.into()));
        }
    }
}
