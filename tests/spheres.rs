//! `Spheres` and `SphereBvh` as collections, and against the slice of the same spheres. The unit tests of the crate do the latter
//! with every set of instructions and on harder scenes.

use std::fmt::Debug;
use std::ops::Range;

use eyeray::{Hit, Hittable, Nearest, Ray, Scalar, Sphere, SphereBvh, Spheres, Vector, nearest};
use glam::{DVec3, Vec3, dvec3, vec3};
use proptest::prelude::*;

/// A hit as bits: -0.0 is not 0.0 here.
fn bits<V: Vector>(found: Option<(usize, Hit<V>)>) -> Option<(usize, [u64; 7], Hit<V>)> {
    found.map(|(index, hit)| {
        let [a, b, c] = hit.point.to_f64().to_array();
        let [d, e, f] = hit.normal.to_f64().to_array();
        (index, [hit.t.into(), a, b, c, d, e, f].map(f64::to_bits), hit)
    })
}

#[track_caller]
fn assert_same_as_slice<V: Vector>(
    slice: &[Sphere<V>],
    spheres: &Spheres<V>,
    ray: &Ray<V>,
    range: &Range<V::Scalar>,
) {
    let expected = bits(nearest(slice, ray, range.clone()));
    let bvh = SphereBvh::from(spheres.clone());
    let context = || format!("{} spheres, {ray:?}, {range:?}", slice.len());
    assert_eq!(bits(spheres.nearest(ray, range.clone())), expected, "{}", context());
    assert_eq!(spheres.intersect(ray, range.clone()), expected.map(|(_, _, hit)| hit));
    assert_eq!(spheres.occludes(ray, range.clone()), expected.is_some(), "{}", context());
    assert_eq!(bits(bvh.nearest(ray, range.clone())), expected, "{}", context());
    assert_eq!(bvh.intersect(ray, range.clone()), expected.map(|(_, _, hit)| hit));
    assert_eq!(bvh.occludes(ray, range.clone()), expected.is_some(), "{}", context());
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
    assert_eq!(Spheres::<Vec3>::default().len(), 0);
}

/// A sphere of every length of a row.
fn row(count: u8) -> Vec<Sphere> {
    (0..count).map(|i| Sphere::new(Vec3::X * (3.0 * f32::from(i)), 1.0)).collect()
}

#[test]
fn changes_one_by_one() {
    let along = Ray::new(Vec3::NEG_X * 9.0, Vec3::X);
    let across = |i: u8| Ray::new(vec3(3.0 * f32::from(i), 0.0, 9.0), Vec3::NEG_Z);
    for count in 0..40 {
        let mut slice = row(count);
        let mut spheres = Spheres::from(slice.clone());
        spheres.reserve(100);
        let point = Sphere::new(Vec3::ZERO, 0.0);
        assert_eq!(spheres.set(usize::from(count), point), None);
        assert_eq!(spheres.swap_remove(usize::from(count)), None);
        assert_eq!(spheres.as_slice(), slice);
        while let Some(last) = slice.len().checked_sub(1) {
            let place = last * 7 % slice.len();
            let moved = Sphere::new(slice[place].center + Vec3::Y * 0.5, 1.5);
            assert_eq!(spheres.set(place, moved), Some(slice[place]));
            slice[place] = moved;
            for ray in [along, across(0), across(count / 2), across(count - 1)] {
                assert_same_as_slice(&slice, &spheres, &ray, &(0.0..f32::INFINITY));
            }
            assert_eq!(spheres.swap_remove(place), Some(slice.swap_remove(place)));
            for ray in [along, across(0), across(count / 2), across(count - 1)] {
                assert_same_as_slice(&slice, &spheres, &ray, &(0.0..f32::INFINITY));
            }
        }
        assert!(spheres.is_empty());
    }
}

#[test]
fn is_a_collection() {
    let slice = row(40);
    let spheres = Spheres::from(slice.clone());
    assert!((&spheres).into_iter().eq(slice.iter().copied()));
    assert_eq!(spheres, slice.iter().copied().collect());
    assert_ne!(spheres, Spheres::from(row(39)));
    assert_eq!(format!("{spheres:?}"), format!("{slice:?}"));
    for count in [0, 1, 40, 200] {
        let bvh: SphereBvh = row(count).into_iter().collect();
        assert_eq!((bvh.len(), bvh.is_empty()), (count.into(), count == 0));
        assert_eq!(format!("{bvh:?}"), format!("{:?}", row(count)));
        assert_eq!(format!("{:#?}", bvh.clone()), format!("{:#?}", row(count)));
    }
    assert!(SphereBvh::<Vec3>::default().is_empty());
}

/// Code that takes any of the collections, and a reference to one that is not known.
#[test]
fn are_asked_in_one_way() {
    fn ask(collection: &(impl Nearest<DVec3> + ?Sized)) -> Option<(usize, f64)> {
        let along = Ray::new(dvec3(100.0, 0.0, 0.0), DVec3::NEG_X);
        collection.nearest(&along, 0.0..f64::INFINITY).map(|(index, hit)| (index, hit.t))
    }
    let spheres = [3.0, 6.0, 5.0].map(|x| Sphere::new(DVec3::X * x, 0.5));
    let (scan, bvh) = (Spheres::from(spheres), SphereBvh::from(spheres));
    let all: [&dyn Nearest<DVec3>; 5] =
        [&spheres, &spheres.as_slice(), &spheres.to_vec(), &scan, &bvh];
    for collection in all {
        assert_eq!(ask(collection), Some((1, 93.5)));
    }
    assert_eq!(ask(spheres.as_slice()), Some((1, 93.5)));
}

/// The ways to make a collection and to take it apart.
fn is_made_and_taken_apart<V: Vector>(spheres: [Sphere<V>; 3]) {
    let slice = spheres.as_slice();
    let expected = Spheres::from(slice.to_vec());
    assert_eq!(Spheres::from(spheres), expected);
    assert_eq!(Spheres::from(slice), expected);
    assert_eq!(slice.iter().collect::<Spheres<V>>(), expected);
    assert_eq!(slice.iter().copied().collect::<Spheres<V>>(), expected);
    let mut extended = Spheres::new();
    extended.extend(&slice[..1]);
    extended.extend(slice[1..].iter().copied());
    assert_eq!(extended, expected);
    assert!(expected.clone().into_iter().eq(spheres));
    assert_eq!((&expected).into_iter().collect::<Spheres<V>>(), expected);

    let bvh = SphereBvh::from(expected);
    assert_eq!(SphereBvh::from(spheres), bvh);
    assert_eq!(SphereBvh::from(slice), bvh);
    assert_eq!(SphereBvh::from(slice.to_vec()), bvh);
    assert_eq!(slice.iter().collect::<SphereBvh<V>>(), bvh);
    assert_ne!(SphereBvh::from(&slice[..2]), bvh);
    assert_ne!(SphereBvh::from([slice[1], slice[0], slice[2]]), bvh);
    // As a scan, and as a tree.
    for count in [3, 500] {
        let many: Vec<Sphere<V>> = slice.iter().copied().cycle().take(count).collect();
        let bvh = SphereBvh::new(&many);
        assert!((&bvh).into_iter().eq(many.iter().copied()));
        assert!((&bvh).into_iter().rev().eq(many.iter().rev().copied()));
        let mut iter = (&bvh).into_iter();
        assert_eq!(iter.nth(1), Some(many[1]));
        assert_eq!(iter.next_back(), many.last().copied());
        assert_eq!((iter.len(), iter.clone().count()), (count - 3, count - 3));
        assert_eq!(iter.nth(count), None);
        let mut changed = many.clone();
        changed[count - 1].radius = V::Scalar::ZERO;
        assert_ne!(SphereBvh::new(&changed), bvh);
        assert_eq!(bvh.into_iter().collect::<Vec<_>>(), many);
    }
}

/// The box is the least that holds the boxes of all, in whatever collection.
fn bounds_are_those_of_all<V: Vector>(count: u32) {
    let numbers = |index: u32| {
        let angle = f64::from(index);
        dvec3(angle.sin() * 7.1, (angle * 1.3).cos() * 1e5, angle * 0.01)
    };
    let slice: Vec<Sphere<V>> = (0..count)
        .map(|index| Sphere::new(V::from_f64(numbers(index)), V::Scalar::from_f64(0.1)))
        .collect();
    let corners = |(low, high): (V, V)| [low.to_f64(), high.to_f64()];
    let expected =
        slice.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], sphere| {
            let [sphere_low, sphere_high] = corners(sphere.bounds());
            [low.min(sphere_low), high.max(sphere_high)]
        });
    assert_eq!(corners(Spheres::from(slice.as_slice()).bounds()), expected);
    assert_eq!(corners(SphereBvh::new(&slice).bounds()), expected);

    // What no ray can hit does not count.
    let radius = V::Scalar::ONE;
    let mut more = slice;
    for center in [DVec3::NAN, DVec3::INFINITY] {
        more.push(Sphere::new(V::from_f64(center), radius));
    }
    more.push(Sphere::new(V::from_f64(DVec3::splat(1e9)), -radius));
    assert_eq!(corners(Spheres::from(more.as_slice()).bounds()), expected);
    assert_eq!(corners(SphereBvh::new(&more).bounds()), expected);
}

#[test]
fn bounds_are_those_of_all_spheres() {
    for count in [0, 1, 2, 40, 1000] {
        bounds_are_those_of_all::<Vec3>(count);
        bounds_are_those_of_all::<DVec3>(count);
    }
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    assert_eq!((Spheres::new().bounds(), SphereBvh::default().bounds()), (none, none));
}

#[test]
fn are_made_and_taken_apart() {
    is_made_and_taken_apart([1.0, 2.0, 3.0].map(|radius| Sphere::new(Vec3::X, radius)));
    is_made_and_taken_apart([1.0, 2.0, 3.0].map(|radius| Sphere::new(DVec3::X, radius)));
}

/// The hierarchy handles spheres that no ray can hit, and more large spheres than it keeps apart.
fn hostile_scenes_are_sorted_too<V: Vector>(largest: V::Scalar) {
    let ray = Ray::new(V::from_f64(DVec3::NEG_X * 9.0), V::from_f64(DVec3::X));
    let largest_vector = V::from_f64(DVec3::splat(largest.into()));
    for sphere in [
        Sphere::new(V::from_f64(DVec3::NAN), V::Scalar::ONE),
        Sphere::new(V::ZERO, -V::Scalar::ONE),
        Sphere::new(V::ZERO, largest),
        Sphere::new(largest_vector, largest),
        Sphere::new(V::ZERO, V::Scalar::ONE),
    ] {
        let slice = vec![sphere; 1000];
        let spheres = Spheres::from(slice.clone());
        assert_same_as_slice(&slice, &spheres, &ray, &(V::Scalar::ZERO..V::Scalar::INFINITY));
    }
}

#[test]
fn hostile_scenes_are_sorted_too_in_both_precisions() {
    hostile_scenes_are_sorted_too::<Vec3>(f32::MAX);
    hostile_scenes_are_sorted_too::<DVec3>(f64::MAX);
}

/// A scene that changes until it is elsewhere, sphere by sphere.
#[test]
fn changes_until_it_is_elsewhere() {
    let mut slice: Vec<Sphere<DVec3>> = (0..100_u8)
        .map(|i| Sphere::new(dvec3(f64::from(i % 10), f64::from(i / 10), 0.0), 0.25))
        .collect();
    let mut spheres = Spheres::from(slice.as_slice());
    let away = dvec3(1e11, 5e10, -3e10);
    for turn in 0..3 {
        for index in 0..slice.len() {
            slice[index].center += away;
            assert!(spheres.set(index, slice[index]).is_some());
            let target = slice[index * 7 % slice.len()].center;
            let ray = Ray::new(target + DVec3::Z * 10.0_f64.powi(turn + 1), DVec3::NEG_Z);
            assert_same_as_slice(&slice, &spheres, &ray, &(0.0..f64::INFINITY));
        }
    }
}

#[cfg(feature = "serde")]
#[test]
fn are_written_as_a_list_of_spheres() -> Result<(), serde_json::Error> {
    for count in [0, 3, 40, 200] {
        let slice = row(count);
        let written = serde_json::to_string(&slice)?;
        let spheres = Spheres::from(slice.clone());
        assert_eq!(serde_json::to_string(&spheres)?, written);
        assert_eq!(serde_json::from_str::<Spheres>(&written)?, spheres);
        let bvh = SphereBvh::from(spheres);
        assert_eq!(serde_json::to_string(&bvh)?, written);
        let read: SphereBvh = serde_json::from_str(&written)?;
        assert!(read.iter().eq(slice));
    }
    Ok(())
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

/// Any f64 likewise.
fn double() -> impl Strategy<Value = f64> {
    prop_oneof![any::<u64>().prop_map(f64::from_bits), number().prop_map(f64::from)]
}

fn vector<V: Vector>(number: impl Strategy<Value = V::Scalar> + Clone) -> impl Strategy<Value = V> {
    [number.clone(), number.clone(), number]
        .prop_map(|numbers| V::from_f64(numbers.map(Into::into).into()))
}

/// Up to 70 spheres, a ray, and both ends of a range.
type Question<V, S> = (Vec<(V, S)>, (V, V), (S, S));

fn question<V: Vector, N: Strategy<Value = V::Scalar> + Clone + 'static>(
    number: fn() -> N,
) -> impl Strategy<Value = Question<V, V::Scalar>>
where
    V::Scalar: Debug,
{
    let vector = || vector::<V>(number());
    (
        prop::collection::vec((vector(), number()), 0..=70),
        (vector(), vector()),
        (number(), number()),
    )
}

fn equals_the_slice<V: Vector>((slice, ray, (start, end)): Question<V, V::Scalar>) {
    let slice: Vec<Sphere<V>> =
        slice.into_iter().map(|(center, radius)| Sphere::new(center, radius)).collect();
    let spheres: Spheres<V> = slice.iter().collect();
    let ray = Ray::new(ray.0, ray.1);
    let (zero, infinity) = (V::Scalar::ZERO, V::Scalar::INFINITY);
    for range in [zero..infinity, start..end, start..infinity, zero..end] {
        assert_same_as_slice(&slice, &spheres, &ray, &range);
    }
}

proptest! {
    #[test]
    fn equals_the_slice_on_random_numbers(question in question::<Vec3, _>(|| number().boxed())) {
        equals_the_slice(question);
    }

    #[test]
    fn equals_the_slice_on_random_doubles(question in question::<DVec3, _>(|| double().boxed())) {
        equals_the_slice(question);
    }
}
