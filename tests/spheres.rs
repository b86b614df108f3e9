//! `Spheres` and `SphereBvh` as collections, and against the slice of the same spheres. The unit tests of the crate do the latter
//! with every set of instructions and on harder scenes.

use std::ops::Range;

use eyeray::{Hit, Hittable, Ray, Sphere, SphereBvh, Spheres, nearest};
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

/// The hierarchy handles spheres that no ray can hit, and more large spheres than it keeps apart.
#[test]
fn hostile_scenes_are_sorted_too() {
    let ray = Ray::new(Vec3::NEG_X * 9.0, Vec3::X);
    for sphere in [
        Sphere::new(Vec3::NAN, 1.0),
        Sphere::new(Vec3::ZERO, -1.0),
        Sphere::new(Vec3::ZERO, f32::MAX),
        Sphere::new(Vec3::MAX, f32::MAX),
        Sphere::new(Vec3::ZERO, 1.0),
    ] {
        let slice = vec![sphere; 1000];
        let spheres = Spheres::from(slice.clone());
        assert_same_as_slice(&slice, &spheres, &ray, &(0.0..f32::INFINITY));
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
