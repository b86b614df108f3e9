//! `Spheres` against the slice of the same spheres: the same hit, bit for bit, in every family, length and set of lanes.

#[path = "support/families.rs"]
mod families;

use std::ops::Range;

use eyeray::{Hit, Hittable, Lanes, Ray, Sphere, Spheres, nearest};
use families::{FAMILIES, Family, Rng};
use glam::{Vec3, vec3};
use proptest::prelude::*;

/// A hit as bits: -0.0 is not 0.0 here.
fn bits(found: Option<(usize, Hit)>) -> Option<(usize, [u32; 7], Hit)> {
    found.map(|(index, hit)| {
        let [a, b, c] = hit.point.to_array();
        let [d, e, f] = hit.normal.to_array();
        (index, [hit.t, a, b, c, d, e, f].map(f32::to_bits), hit)
    })
}

#[track_caller]
fn assert_same_as_slice(slice: &[Sphere], spheres: &Spheres, ray: &Ray, range: &Range<f32>) {
    let expected = bits(nearest(slice, ray, range.clone()));
    let context = || format!("{} spheres, {ray:?}, {range:?}", slice.len());
    assert_eq!(bits(spheres.nearest(ray, range.clone())), expected, "{}", context());
    assert_eq!(spheres.intersect(ray, range.clone()), expected.map(|(_, _, hit)| hit));
    assert_eq!(spheres.occludes(ray, range.clone()), expected.is_some(), "{}", context());
    for lanes in Lanes::available() {
        let found = spheres.nearest_in_lanes(lanes, ray, range.clone());
        assert_eq!(bits(found), expected, "{lanes:?}, {}", context());
        let occluded = spheres.occludes_in_lanes(lanes, ray, range.clone());
        assert_eq!(occluded, expected.is_some(), "{lanes:?}, {}", context());
    }
}

/// One of the values.
fn choose<T: Copy>(rng: &mut Rng, values: &[T]) -> T {
    values[usize::try_from(rng.below(values.len() as u64)).unwrap_or(0)]
}

/// Numbers that a scene should not have.
const HOSTILE: [f32; 16] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e38,
    -1e38,
    f32::MAX,
    f32::from_bits(1),
    f32::MIN_POSITIVE,
    1e-30,
    1e-22,
    1.2e18, // above 2^60
    1.1e18, // below
    1.0,
];

/// A member of a scene for a ray of a case of that family.
fn member(rng: &mut Rng, family: &Family, of_case: Sphere) -> Sphere {
    let mut sphere = of_case;
    match rng.below(10) {
        // The very sphere: equal distances.
        0 | 1 => {}
        // Nearly: the same with one number a few units in the last place off.
        2..=4 => {
            let mut numbers = [sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius];
            let place = choose(rng, &[0, 1, 2, 3]);
            let step = choose(rng, &[1_u32, 2, 3, u32::MAX, u32::MAX - 1]);
            numbers[place] = f32::from_bits(numbers[place].to_bits().wrapping_add(step));
            sphere = Sphere::new(vec3(numbers[0], numbers[1], numbers[2]), numbers[3]);
        }
        // Others of the family.
        5 | 6 => (_, sphere) = (family.f32)(rng),
        7 => {
            let family = choose(rng, FAMILIES);
            (_, sphere) = (family.f32)(rng);
        }
        8 => sphere.radius = choose(rng, &HOSTILE),
        _ => {
            let [x, y, z, radius] = [(); 4].map(|()| choose(rng, &HOSTILE));
            sphere = Sphere::new(vec3(x, y, z), radius);
        }
    }
    sphere
}

/// The float after a positive one.
fn above(t: f32) -> f32 {
    if t > 0.0 && t < f32::INFINITY { f32::from_bits(t.to_bits() + 1) } else { t }
}

/// Ranges that hold all, that begin or end at a hit, and that are none.
fn ranges(rng: &mut Rng, slice: &[Sphere], ray: &Ray) -> Vec<Range<f32>> {
    let mut ranges = vec![0.0..f32::INFINITY, f32::NEG_INFINITY..f32::MAX];
    let first = nearest(slice, ray, 0.0..f32::INFINITY).map(|(_, hit)| hit.t);
    let other = (!slice.is_empty())
        .then(|| choose(rng, slice))
        .and_then(|sphere| sphere.roots_algebraic(ray))
        .map(|roots| roots[1]);
    for t in first.into_iter().chain(other) {
        ranges.extend([
            t..f32::INFINITY,
            above(t)..f32::INFINITY,
            0.0..t,
            0.0..above(t),
            t..above(t),
            above(t)..t,
        ]);
    }
    let numbers: Vec<f32> = first.into_iter().chain(other).chain(HOSTILE).collect();
    ranges.push(choose(rng, &numbers)..choose(rng, &numbers));
    ranges
}

#[test]
fn equals_the_slice_in_every_family_and_length() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for length in 0..=70 {
            let (ray, sphere) = (family.f32)(&mut rng);
            let slice: Vec<Sphere> =
                (0..length).map(|_| member(&mut rng, family, sphere)).collect();
            let spheres: Spheres = slice.iter().copied().collect();
            for range in ranges(&mut rng, &slice, &ray) {
                assert_same_as_slice(&slice, &spheres, &ray, &range);
            }
        }
    }
}

/// Whether the sphere is found among `N` of which the others are never hit: nothing nearer hides that the filter drops it.
fn assert_found_alone<const N: usize>(rng: &mut Rng, ray: &Ray, sphere: Sphere) {
    let mut slice = [Sphere::new(Vec3::ZERO, -1.0); N];
    slice[usize::try_from(rng.below(N as u64)).unwrap_or(0)] = sphere;
    let spheres: Spheres = slice.into_iter().collect();
    assert_same_as_slice(&slice, &spheres, ray, &(0.0..f32::INFINITY));
    if let Some(hit) = sphere.intersect(ray, 0.0..f32::INFINITY) {
        assert_same_as_slice(&slice, &spheres, ray, &(0.0..above(hit.t)));
        assert_same_as_slice(&slice, &spheres, ray, &(hit.t..f32::INFINITY));
        let spawned = hit.spawn(choose(rng, &[hit.normal, -hit.normal, ray.direction]));
        assert_same_as_slice(&slice, &spheres, &spawned, &(0.0..f32::INFINITY));
    }
}

#[test]
fn finds_every_sphere_alone_in_every_lane() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for _ in 0..700 {
            let (ray, sphere) = (family.f32)(&mut rng);
            assert_found_alone::<70>(&mut rng, &ray, sphere);
            assert_found_alone::<4>(&mut rng, &ray, sphere);
        }
    }
}

#[test]
fn finds_every_sphere_alone_at_every_scale() {
    // Far beyond what the filter computes with: lengths up to 2^60, directions from 2^-30 to 2^60.
    let power_of_two = |exponent: i16| f32::from(exponent).exp2();
    let mut rng = Rng::new(1);
    for family in FAMILIES.iter().filter(|family| ["easy", "grazing"].contains(&family.name)) {
        for scale in (-90..=90).map(power_of_two) {
            for stretch in (-80..=62).step_by(2).map(power_of_two) {
                let (ray, sphere) = (family.f32)(&mut rng);
                let ray = Ray::new(ray.origin * scale, ray.direction * stretch);
                let sphere = Sphere::new(sphere.center * scale, sphere.radius * scale);
                assert_found_alone::<70>(&mut rng, &ray, sphere);
                assert_found_alone::<4>(&mut rng, &ray, sphere);
            }
        }
    }
}

#[test]
fn finds_large_spheres_from_afar() {
    // The square of the distance overflows from 2^64 on, where the spheres are still of a size that the filter computes with.
    let mut rng = Rng::new(1);
    let mut hits = 0;
    for distance in 50..=82_i16 {
        for _ in 0..50 {
            let direction = rng.unit_vector().as_vec3() * 1e-5;
            let sphere = Sphere::new(rng.unit_vector().as_vec3() * 59_f32.exp2(), 59_f32.exp2());
            let origin = sphere.center - direction * f32::from(distance).exp2() * 1e5;
            let ray = Ray::new(origin, direction);
            hits += u32::from(sphere.occludes(&ray, 0.0..f32::INFINITY));
            assert_found_alone::<70>(&mut rng, &ray, sphere);
            assert_found_alone::<4>(&mut rng, &ray, sphere);
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn of_equal_distances_the_lowest_index() {
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let sphere = Sphere::new(Vec3::X * 3.0, 1.0);
    for length in 1..=70 {
        for first in 0..length {
            let slice: Vec<Sphere> = (0..length)
                .map(|i| if i < first { Sphere::new(Vec3::X * 9.0, 1.0) } else { sphere })
                .collect();
            let spheres: Spheres = slice.iter().copied().collect();
            let found = spheres.nearest(&ray, 0.0..f32::INFINITY);
            assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((first, 2.0)));
        }
    }
}

#[test]
fn keeps_what_it_is_given() {
    let mut spheres = Spheres::with_capacity(3);
    assert!(spheres.is_empty() && spheres.get(0).is_none());
    let mut slice = Vec::new();
    for &number in HOSTILE.iter().cycle().take(70) {
        let sphere = Sphere::new(vec3(number, 1.0, -number), number);
        slice.push(sphere);
        spheres.push(sphere);
        assert_eq!(spheres.len(), slice.len());
    }
    let bits = |sphere: Sphere| {
        let Sphere { center, radius } = sphere;
        [center.x, center.y, center.z, radius].map(f32::to_bits)
    };
    assert!(spheres.iter().map(bits).eq(slice.iter().copied().map(bits)));
    assert_eq!(spheres.get(69).map(bits), slice.get(69).copied().map(bits));
    assert!(spheres.get(70).is_none());

    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let mut more = spheres.clone();
    more.extend(slice.iter().copied());
    slice.extend_from_within(..);
    assert_same_as_slice(&slice, &more, &ray, &(0.0..f32::INFINITY));

    more.clear();
    assert!(more.is_empty() && more.nearest(&ray, 0.0..f32::INFINITY).is_none());
    more.push(Sphere::new(Vec3::X, 0.5));
    assert_same_as_slice(&[Sphere::new(Vec3::X, 0.5)], &more, &ray, &(0.0..f32::INFINITY));
    assert_eq!(Spheres::default().len(), 0);
}

/// Any f32: any bits, one that a scene has, or one that it should not have.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        (-10.0_f32..10.0),
        (-3_i8..3).prop_map(f32::from),
        prop::sample::select(HOSTILE.as_slice()),
    ]
}

fn vector() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from_array)
}

proptest! {
    #[test]
    fn equals_the_slice_on_random_numbers(
        slice in prop::collection::vec((vector(), number()), 0..=70),
        (origin, direction) in (vector(), vector()),
        (start, end) in (number(), number()),
    ) {
        let slice: Vec<Sphere> =
            slice.into_iter().map(|(center, radius)| Sphere::new(center, radius)).collect();
        let spheres: Spheres = slice.iter().copied().collect();
        let ray = Ray::new(origin, direction);
        for range in [0.0..f32::INFINITY, start..end, start..f32::INFINITY, 0.0..end] {
            assert_same_as_slice(&slice, &spheres, &ray, &range);
        }
    }
}
