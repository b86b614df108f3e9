//! [`Spheres`] and [`SphereBvh`] against the slice of the same spheres: the same hit, bit for bit, with every set of
//! instructions that the machine has.

use std::ops::Range;
use std::vec::Vec;

use glam::{DVec3, Vec3, dvec3};

use super::lanes::Lanes;
use super::{SphereBvh, Spheres};
use crate::{Hit, Hittable, Ray, Scalar, Sphere, Vector, nearest};

mod pictures;

pub(super) use crate::testing::families;
use families::{FAMILIES, Family, Rng};

/// What the tests need of a precision.
pub(super) trait Tested: Vector {
    /// One ray and one sphere of a family of random tests.
    fn case(family: &Family, rng: &mut Rng) -> (Ray<Self>, Sphere<Self>);
    /// The number of these bits, as many as it takes.
    fn from_bits(bits: u64) -> Self::Scalar;
    fn to_bits(number: Self::Scalar) -> u64;
    /// The largest number and the smallest one that is not subnormal.
    const LIMITS: [f64; 2];
}

impl Tested for Vec3 {
    fn case(family: &Family, rng: &mut Rng) -> (Ray, Sphere) {
        (family.f32)(rng)
    }

    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    fn from_bits(bits: u64) -> f32 {
        f32::from_bits(bits as u32)
    }

    fn to_bits(number: f32) -> u64 {
        number.to_bits().into()
    }

    const LIMITS: [f64; 2] = [f32::MAX as f64, f32::MIN_POSITIVE as f64];
}

impl Tested for DVec3 {
    fn case(family: &Family, rng: &mut Rng) -> (Ray<DVec3>, Sphere<DVec3>) {
        (family.f64)(rng)
    }

    fn from_bits(bits: u64) -> f64 {
        f64::from_bits(bits)
    }

    fn to_bits(number: f64) -> u64 {
        number.to_bits()
    }

    const LIMITS: [f64; 2] = [f64::MAX, f64::MIN_POSITIVE];
}

/// Runs the tests in both precisions.
macro_rules! in_both {
    ($($test:ident)+) => {
        mod in_f32 {
            $(#[test] fn $test() { super::$test::<glam::Vec3>(); })+
        }
        mod in_f64 {
            $(#[test] fn $test() { super::$test::<glam::DVec3>(); })+
        }
    };
}

pub(super) use in_both;

in_both! {
    equals_the_slice_in_every_family_and_length
    finds_every_sphere_alone_in_every_lane
    finds_every_sphere_alone_at_every_scale
    finds_every_sphere_alone_of_any_exponents
    finds_large_spheres_from_afar
    finds_every_sphere_wherever_it_is
    of_equal_distances_the_lowest_index
    of_equal_distances_the_lowest_index_of_large_and_small
    equals_the_slice_in_a_long_run
    a_hierarchy_keeps_what_it_is_given
    a_hierarchy_that_is_updated_equals_the_slice
}

/// A number of cases, or a twentieth where nothing is optimized: those find out whether anything overflows.
const fn cases(number: usize) -> usize {
    if cfg!(debug_assertions) { number / 20 } else { number }
}

pub(super) fn all<V: Vector>() -> Range<V::Scalar> {
    V::Scalar::ZERO..V::Scalar::INFINITY
}

pub(super) fn scalar<V: Vector>(number: f64) -> V::Scalar {
    V::Scalar::from_f64(number)
}

pub(super) fn sphere<V: Vector>(center: DVec3, radius: f64) -> Sphere<V> {
    Sphere::new(V::from_f64(center), scalar::<V>(radius))
}

pub(super) fn ray<V: Vector>(origin: DVec3, direction: DVec3) -> Ray<V> {
    Ray::new(V::from_f64(origin), V::from_f64(direction))
}

/// A hit as bits: -0.0 is not 0.0 here.
pub(super) fn bits<V: Tested>(found: Option<(usize, Hit<V>)>) -> Option<(usize, [u64; 7], Hit<V>)> {
    found.map(|(index, hit)| {
        let [a, b, c] = hit.point.to_f64().to_array().map(f64::to_bits);
        let [d, e, f] = hit.normal.to_f64().to_array().map(f64::to_bits);
        (index, [V::to_bits(hit.t), a, b, c, d, e, f], hit)
    })
}

/// The same spheres as all three hold them.
pub(super) struct Scene<V: Vector> {
    pub(super) slice: Vec<Sphere<V>>,
    pub(super) scan: Spheres<V>,
    /// A hierarchy, however few they are.
    pub(super) bvh: SphereBvh<V>,
}

impl<V: Tested> Scene<V> {
    pub(super) fn new(slice: Vec<Sphere<V>>) -> Self {
        let scan = Spheres::from(slice.clone());
        Self { bvh: SphereBvh::tree(&scan), scan, slice }
    }

    #[track_caller]
    pub(super) fn assert_same(&self, ray: &Ray<V>, range: &Range<V::Scalar>) {
        let Self { slice, scan, bvh } = self;
        let expected = bits(nearest(slice, ray, range.clone()));
        for lanes in Lanes::available() {
            let context = || format!("{lanes:?}, {} spheres, {ray:?}, {range:?}", slice.len());
            let found = scan.nearest_in_lanes(lanes, ray, range.clone());
            assert_eq!(bits(found), expected, "scan, {}", context());
            let found = bvh.nearest_in_lanes(lanes, ray, range.clone());
            assert_eq!(bits(found), expected, "hierarchy, {}", context());
            let occluded = scan.occludes_in_lanes(lanes, ray, range.clone());
            assert_eq!(occluded, expected.is_some(), "scan, {}", context());
            let occluded = bvh.occludes_in_lanes(lanes, ray, range.clone());
            assert_eq!(occluded, expected.is_some(), "hierarchy, {}", context());
        }
    }
}

/// One of the values.
fn choose<T: Copy>(rng: &mut Rng, values: &[T]) -> T {
    values[usize::try_from(rng.below(values.len() as u64)).unwrap_or(0)]
}

/// Numbers that a scene should not have.
fn hostile_number<V: Tested>(rng: &mut Rng) -> V::Scalar {
    let [largest, least] = V::LIMITS;
    scalar::<V>(choose(
        rng,
        &[
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            0.0,
            -0.0,
            -1.0,
            1e38,
            -1e38,
            largest,
            V::from_bits(1).into(),
            least,
            1e-30,
            -1e-30,
            1e-22,
            1.2e18, // above 2^60
            1.1e18, // below
            1.0,
        ],
    ))
}

fn hostile<V: Tested>(rng: &mut Rng) -> V {
    V::from_f64([(); 3].map(|()| hostile_number::<V>(rng).into()).into())
}

/// A member of a scene for a ray of a case of that family.
pub(super) fn member<V: Tested>(rng: &mut Rng, family: &Family, of_case: Sphere<V>) -> Sphere<V> {
    let mut sphere = of_case;
    match rng.below(10) {
        // The very sphere: equal distances.
        0 | 1 => {}
        // Nearly: the same with one number a few units in the last place off.
        2..=4 => {
            let [x, y, z] = sphere.center.to_f64().to_array().map(scalar::<V>);
            let mut numbers = [x, y, z, sphere.radius];
            let place = choose(rng, &[0, 1, 2, 3]);
            let step = choose(rng, &[1, 2, 3, u64::MAX, u64::MAX - 1]);
            numbers[place] = V::from_bits(V::to_bits(numbers[place]).wrapping_add(step));
            let [x, y, z, radius] = numbers;
            sphere = Sphere::new(V::from_f64([x, y, z].map(Into::into).into()), radius);
        }
        // Others of the family.
        5 | 6 => (_, sphere) = V::case(family, rng),
        7 => {
            let family = choose(rng, FAMILIES);
            (_, sphere) = V::case(&family, rng);
        }
        8 => sphere.radius = hostile_number::<V>(rng),
        _ => sphere = Sphere::new(hostile(rng), hostile_number::<V>(rng)),
    }
    sphere
}

/// The float after a positive one.
pub(super) fn above<V: Tested>(t: V::Scalar) -> V::Scalar {
    if t > V::Scalar::ZERO && t < V::Scalar::INFINITY { V::from_bits(V::to_bits(t) + 1) } else { t }
}

/// Ranges that hold all, that begin or end at a hit, and that are none.
pub(super) fn ranges<V: Tested>(
    rng: &mut Rng,
    slice: &[Sphere<V>],
    ray: &Ray<V>,
) -> Vec<Range<V::Scalar>> {
    let mut ranges = vec![all::<V>(), -V::Scalar::INFINITY..scalar::<V>(V::LIMITS[0])];
    let first = nearest(slice, ray, all::<V>()).map(|(_, hit)| hit.t);
    let other = (!slice.is_empty())
        .then(|| choose(rng, slice))
        .and_then(|sphere| sphere.roots_algebraic(ray))
        .map(|roots| roots[1]);
    for t in first.into_iter().chain(other) {
        let above = above::<V>(t);
        ranges.extend([
            t..V::Scalar::INFINITY,
            above..V::Scalar::INFINITY,
            V::Scalar::ZERO..t,
            V::Scalar::ZERO..above,
            t..above,
            above..t,
        ]);
    }
    let mut number = || match rng.below(3) {
        0 => first.or(other).unwrap_or_default(),
        1 => other.or(first).unwrap_or_default(),
        _ => hostile_number::<V>(rng),
    };
    ranges.push(number()..number());
    ranges
}

fn equals_the_slice_in_every_family_and_length<V: Tested>() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        let step = if cfg!(debug_assertions) { 17 } else { 1 };
        for length in (0..=70).step_by(step).chain([255, 256, 257, 272, 273]) {
            let (ray, sphere) = V::case(family, &mut rng);
            let scene = Scene::new((0..length).map(|_| member(&mut rng, family, sphere)).collect());
            for range in ranges(&mut rng, &scene.slice, &ray) {
                scene.assert_same(&ray, &range);
            }
        }
    }
}

/// Whether the sphere is found among `count` that are not in its way: nothing nearer hides that a filter drops it.
fn assert_found_alone<V: Tested>(rng: &mut Rng, count: usize, ray: &Ray<V>, sphere: Sphere<V>) {
    let around = sphere.radius.into() * 4.0;
    let behind = (ray.origin - ray.direction).to_f64();
    let mut slice: Vec<Sphere<V>> = (0..count)
        .map(|_| match rng.below(3) {
            0 => Sphere::new(V::ZERO, -V::Scalar::ONE),
            // Points, which a line hardly ever goes through, so that the hierarchy has more than one box.
            1 => self::sphere(sphere.center.to_f64() + rng.unit_vector() * around, 0.0),
            _ => self::sphere(behind + rng.unit_vector() * 1e-3, 0.0),
        })
        .collect();
    let index = usize::try_from(rng.below(count as u64)).unwrap_or(0);
    slice[index] = sphere;
    assert_found(rng, &Scene::new(slice), ray, sphere);
}

/// Asks for a sphere of a scene in some ranges, and from where it is hit.
fn assert_found<V: Tested>(rng: &mut Rng, scene: &Scene<V>, ray: &Ray<V>, sphere: Sphere<V>) {
    scene.assert_same(ray, &all::<V>());
    if let Some(hit) = sphere.intersect(ray, all::<V>()) {
        scene.assert_same(ray, &(V::Scalar::ZERO..above::<V>(hit.t)));
        scene.assert_same(ray, &(hit.t..V::Scalar::INFINITY));
        let spawned = hit.spawn(choose(rng, &[hit.normal, -hit.normal, ray.direction]));
        scene.assert_same(&spawned, &all::<V>());
    }
}

fn finds_every_sphere_alone_in_every_lane<V: Tested>() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for _ in 0..cases(200) {
            let (ray, sphere) = V::case(family, &mut rng);
            assert_found_alone(&mut rng, 70, &ray, sphere);
            assert_found_alone(&mut rng, 4, &ray, sphere);
        }
    }
}

fn finds_every_sphere_alone_at_every_scale<V: Tested>() {
    // Far beyond what the filters compute with: lengths up to 2^60, directions from 2^-30 to 2^60.
    let power_of_two = |exponent: i16| scalar::<V>(f64::from(exponent).exp2());
    let mut rng = Rng::new(1);
    for family in FAMILIES.iter().filter(|family| ["easy", "grazing"].contains(&family.name)) {
        let steps = if cfg!(debug_assertions) { [15, 8] } else { [3, 2] };
        for scale in (-90..=90).step_by(steps[0]).map(power_of_two) {
            for stretch in (-80..=62).step_by(steps[1]).map(power_of_two) {
                let (ray, sphere) = V::case(family, &mut rng);
                let ray = Ray::new(ray.origin * scale, ray.direction * stretch);
                let sphere = Sphere::new(sphere.center * scale, sphere.radius * scale);
                assert_found_alone(&mut rng, 35, &ray, sphere);
                assert_found_alone(&mut rng, 4, &ray, sphere);
            }
        }
    }
}

/// Exponents over the whole range of the precision, of each number by itself.
fn finds_every_sphere_alone_of_any_exponents<V: Tested>() {
    let [largest, least] = V::LIMITS.map(f64::log2);
    let mut rng = Rng::new(2);
    let mut hits = 0;
    for case in 0..cases(3000) {
        // A third within what the filters compute with, a third around its limits.
        let (low, high) = [(least, largest), (-70.0, 70.0), (-30.0, 50.0)][case % 3];
        let mut power = || rng.uniform(low, high).exp2();
        let [size, distance, length] = [power(), power(), power()];
        let center = rng.unit_vector() * rng.uniform(low, high).exp2();
        let target = center + rng.unit_vector() * size * rng.uniform(0.0, 1.000_001);
        let away = rng.unit_vector();
        let ray = ray::<V>(target - away * distance, away * length);
        let sphere = sphere::<V>(center, size);
        hits += usize::from(sphere.occludes(&ray, all::<V>()));
        assert_found_alone(&mut rng, 40, &ray, sphere);
        assert_found_alone(&mut rng, 3, &ray, sphere);
    }
    assert!(hits > cases(500), "{hits}");
}

fn finds_large_spheres_from_afar<V: Tested>() {
    // The square of the distance overflows from 2^64 on, where the spheres are still of a size that the filters compute with.
    let mut rng = Rng::new(1);
    let mut hits = 0;
    for distance in 50..=82_i16 {
        for _ in 0..cases(60) {
            let direction = rng.unit_vector() * 1e-5;
            let center = rng.unit_vector() * 59_f64.exp2();
            let origin = center - direction * f64::from(distance).exp2() * 1e5;
            let ray = ray::<V>(origin, direction);
            let sphere = sphere(center, 59_f64.exp2());
            hits += usize::from(sphere.occludes(&ray, all::<V>()));
            assert_found_alone(&mut rng, 70, &ray, sphere);
            assert_found_alone(&mut rng, 4, &ray, sphere);
        }
    }
    assert!(hits > cases(1000), "{hits}");
}

/// Compares the collections with a slice where spheres are far from the world's origin, with strays and distant clusters, for
/// rays from near, from afar and from between.
fn finds_every_sphere_wherever_it_is<V: Tested>() {
    let mut rng = Rng::new(5);
    let (mut asked, mut hits) = (0, 0);
    for turn in 0..cases(600) {
        let far = |rng: &mut Rng| 10_f64.powf(rng.uniform(0.0, 8.0));
        let world = rng.unit_vector() * if turn % 3 == 0 { 0.0 } else { far(&mut rng) };
        let scale = 10_f64.powf(rng.uniform(-4.0, 4.0));
        let clusters: Vec<(DVec3, f64)> = (0..choose(&mut rng, &[1, 1, 2, 3, 9]))
            .map(|_| (world + rng.unit_vector() * scale * far(&mut rng), scale * far(&mut rng)))
            .collect();
        let clusters = [vec![(world, scale)], clusters].concat();
        let in_cluster = |rng: &mut Rng| {
            let (center, extent) = choose(rng, &clusters);
            let radius = extent * choose(rng, &[0.0, 0.001, 0.02, 0.1]);
            (center + rng.unit_vector() * extent * rng.uniform(0.0, 1.0), radius)
        };
        let count = choose(&mut rng, &[20, 70, 300]);
        let mut slice: Vec<Sphere<V>> = (0..count)
            .map(|_| {
                let (center, radius) = in_cluster(&mut rng);
                sphere(center, radius)
            })
            .collect();
        for _ in 0..choose(&mut rng, &[0, 1, 5, 30]) {
            let stray = world + rng.unit_vector() * scale * far(&mut rng);
            slice.push(sphere(stray, scale * rng.uniform(0.0, 1.0)));
        }
        let scene = Scene::new(slice);
        for _ in 0..8 {
            let target = choose(&mut rng, &scene.slice);
            let center = target.center.to_f64();
            let limb = rng.unit_vector() * target.radius.into() * rng.uniform(0.5, 1.0);
            let from = match rng.below(4) {
                0 => in_cluster(&mut rng).0,
                1 => center + rng.unit_vector() * scale * far(&mut rng),
                2 => center + rng.unit_vector() * scale * far(&mut rng).powi(2),
                _ => center + rng.unit_vector() * target.radius.into() * 1.5,
            };
            let length = choose(&mut rng, &[1.0, 1.0, 1e-6, 1e9]);
            let ray = ray::<V>(from, (center + limb - from) * length);
            asked += 1;
            hits += u32::from(target.occludes(&ray, all::<V>()));
            assert_found(&mut rng, &scene, &ray, target);
        }
    }
    assert!(hits > asked / 4, "{hits} of {asked}");
}

fn of_equal_distances_the_lowest_index<V: Tested>() {
    let ray = ray::<V>(DVec3::ZERO, DVec3::X);
    for length in (1..=70).step_by(if cfg!(debug_assertions) { 23 } else { 1 }) {
        for first in 0..length {
            let scene = Scene::new(
                (0..length)
                    .map(|i| sphere(DVec3::X * if i < first { 9.0 } else { 3.0 }, 1.0))
                    .collect(),
            );
            scene.assert_same(&ray, &all::<V>());
            let found = scene.bvh.nearest(&ray, all::<V>());
            assert_eq!(found.map(|(index, hit)| (index, hit.t.into())), Some((first, 2.0)));
        }
    }
}

fn of_equal_distances_the_lowest_index_of_large_and_small<V: Tested>() {
    // All touch the plane x = 2 at the same point. The large ones are kept apart.
    let ray = ray::<V>(DVec3::ZERO, DVec3::X);
    for turn in 0..cases(200) {
        let scene = Scene::new(
            (0..200_u8)
                .map(|i| {
                    let radius = if (turn + usize::from(i)) % 13 == 0 { 4096.0 } else { 1.0 };
                    sphere(DVec3::X * (2.0 + radius), radius)
                })
                .collect(),
        );
        scene.assert_same(&ray, &all::<V>());
        assert_eq!(scene.bvh.nearest(&ray, all::<V>()).map(|(index, _)| index), Some(0));
    }
}

/// What a long run asks: scenes of many kinds, and rays that are hard for their boxes and filters.
pub(super) mod questions {
    use super::*;

    fn integer(rng: &mut Rng, low: i64, high: i64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "small integers")]
        let number = rng.integer(low, high) as f64;
        number
    }

    fn integers(rng: &mut Rng, low: i64, high: i64) -> DVec3 {
        [(); 3].map(|()| integer(rng, low, high)).into()
    }

    fn any_bits<V: Tested>(rng: &mut Rng) -> f64 {
        V::from_bits(rng.bits()).into()
    }

    fn any_vector<V: Tested>(rng: &mut Rng) -> DVec3 {
        [(); 3].map(|()| any_bits::<V>(rng)).into()
    }

    fn length(rng: &mut Rng, most: u64) -> usize {
        let length = match rng.below(32) {
            0 => choose(rng, &[255, 256, 257, 271, 272, 273]),
            1 => choose(rng, &[4095, 4096, 4097, 4112, 4113]),
            2..=9 => rng.below(600),
            10..=19 => rng.below(150),
            _ => rng.below(71),
        };
        length.min(most).try_into().unwrap_or(0)
    }

    /// Spheres of one kind, `most` at most.
    pub(in crate::spheres) fn scene<V: Tested>(rng: &mut Rng, most: u64) -> Vec<Sphere<V>> {
        let length = length(rng, most);
        let mut slice: Vec<Sphere<V>> = match rng.below(7) {
            // Repeated and concentric, on a lattice.
            0 | 1 => (0..length)
                .map(|_| {
                    let radius = choose(rng, &[0.5, 1.0, 1.0, 1.5, 0.0, 2.0]);
                    sphere(integers(rng, -4, 4), radius)
                })
                .collect(),
            2 => {
                let radius = choose(rng, &[0.001, 0.1, 1.0, 10.0]);
                let scale = choose(rng, &[1.0, 1.0, 1e-9, 1e6, 1e15]);
                (0..length)
                    .map(|_| {
                        let center = rng.unit_vector() * rng.uniform(0.0, 30.0);
                        sphere(center * scale, radius * rng.uniform(0.5, 1.5) * scale)
                    })
                    .collect()
            }
            // Radii over many orders of magnitude, some large.
            3 => (0..length)
                .map(|_| {
                    let most = if rng.below(9) == 0 { 5.0 } else { 0.5 };
                    let radius = 10_f64.powf(rng.uniform(-6.0, most));
                    sphere(rng.unit_vector() * (radius + rng.uniform(0.0, 30.0)), radius)
                })
                .collect(),
            4 => {
                let family = choose(rng, FAMILIES);
                let (_, sphere) = V::case(&family, rng);
                (0..length).map(|_| member(rng, &family, sphere)).collect()
            }
            // On one line or in one plane.
            5 => (0..length)
                .map(|_| {
                    let flat = choose(rng, &[DVec3::X, dvec3(1.0, 0.0, 1.0)]);
                    sphere(integers(rng, -40, 40) * flat, choose(rng, &[0.25, 0.5, 1.0]))
                })
                .collect(),
            // Clusters far from each other, and clusters of these.
            _ => {
                let far = [(); 3].map(|()| 10_f64.powf(rng.uniform(0.0, 7.0)));
                (0..length)
                    .map(|_| {
                        let inner = integers(rng, -2, 2) * far[0] + integers(rng, -1, 1) * far[1];
                        let stray = if rng.below(50) == 0 { far[2] } else { 0.0 };
                        let center = inner + rng.unit_vector() * (1.0 + stray);
                        sphere(center, choose(rng, &[0.01, 0.1, 0.3]))
                    })
                    .collect()
            }
        };
        if rng.below(4) == 0 && !slice.is_empty() {
            for _ in 0..rng.below(20) {
                let place = usize::try_from(rng.below(slice.len() as u64)).unwrap_or(0);
                slice[place] = match rng.below(3) {
                    0 => Sphere::new(hostile(rng), hostile_number::<V>(rng)),
                    1 => Sphere::new(slice[place].center, hostile_number::<V>(rng)),
                    _ => sphere(any_vector::<V>(rng), any_bits::<V>(rng)),
                };
            }
        }
        slice
    }

    /// A ray for that scene.
    pub(in crate::spheres) fn ray<V: Tested>(rng: &mut Rng, slice: &[Sphere<V>]) -> Ray<V> {
        let target = if slice.is_empty() { Sphere::default() } else { choose(rng, slice) };
        let (center, radius): (_, f64) = (target.center.to_f64(), target.radius.into());
        let unit = rng.unit_vector();
        // A corner of its box, which is where boxes have their faces.
        let corner =
            center + radius * DVec3::from([(); 3].map(|()| choose(rng, &[-1.0, 0.0, 1.0])));
        let mut origin = match rng.below(8) {
            0 => integers(rng, -6, 6),
            1 => center,
            2 => center + unit * radius,
            3 => corner,
            4 => center + unit * (radius * rng.uniform(0.0, 2.0)),
            5 => center + unit * radius * 10_f64.powf(rng.uniform(0.0, 6.0)),
            6 => corner + choose(rng, &[DVec3::X, DVec3::Y, DVec3::Z]) * integer(rng, -50, 50),
            _ => unit * rng.uniform(0.0, 100.0),
        };
        let mut direction = match rng.below(7) {
            0 => choose(rng, &[DVec3::X, DVec3::Y, DVec3::Z]) * choose(rng, &[1.0, -1.0]),
            1 => integers(rng, -2, 2),
            2 => center - origin,
            3 => center + radius * unit - origin,
            4 => corner - origin,
            // Nearly parallel to an axis or a plane.
            5 => {
                let mut direction = choose(rng, &[unit, DVec3::X, DVec3::NEG_Y, DVec3::Z]);
                for _ in 0..=rng.below(2) {
                    let axis = choose(rng, &[0, 1, 2]);
                    direction[axis] =
                        choose(rng, &[0.0, -0.0, 1e-30, -1e-30, 1e-8, -1e-7, 1e-6, 1e-40]);
                }
                direction
            }
            _ => rng.unit_vector(),
        };
        match rng.below(24) {
            0 => direction *= 10_f64.powf(rng.uniform(-12.0, 20.0)),
            1 => origin = hostile::<V>(rng).to_f64(),
            2 => direction = hostile::<V>(rng).to_f64(),
            3 => {
                // At infinity's edge, toward the scene.
                let largest = V::LIMITS[0].log10();
                origin = unit * 10_f64.powf(rng.uniform(15.0, largest));
                direction = center - origin;
            }
            4 => direction *= choose(rng, &[1e-9, 1e-10, 1e18, 1e20]),
            5 => origin = any_vector::<V>(rng),
            6 => direction = any_vector::<V>(rng),
            _ => {}
        }
        super::ray(origin, direction)
    }
}

/// `EYERAY_QUESTIONS=10000000 cargo test --release --lib spheres::tests -- equals_the_slice_in_a_long_run --nocapture`
#[expect(clippy::cast_possible_truncation, reason = "it is below the number of ranges")]
fn equals_the_slice_in_a_long_run<V: Tested>() {
    let wanted = std::env::var("EYERAY_QUESTIONS");
    let wanted: u64 = wanted.map_or(cases(6_000) as u64, |number| number.parse().unwrap());
    let most = if wanted < 100_000 { 300 } else { u64::MAX };
    let mut rng = Rng::new(wanted);
    let (mut asked, mut hits) = (0, 0);
    while asked < wanted {
        let scene = Scene::<V>::new(questions::scene(&mut rng, most));
        for _ in 0..20 {
            let ray = questions::ray(&mut rng, &scene.slice);
            hits += u64::from(nearest(&scene.slice, &ray, all::<V>()).is_some());
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            scene.assert_same(&ray, &all::<V>());
            scene.assert_same(&ray, &ranges[rng.below(ranges.len() as u64) as usize]);
            asked += 2;
        }
    }
    println!("{asked} questions of each set of instructions, {hits} hits in the whole range");
    assert!(hits > wanted / 10, "{hits}");
}

fn a_hierarchy_keeps_what_it_is_given<V: Tested>() {
    let mut rng = Rng::new(3);
    let bits = |sphere: Sphere<V>| {
        let [x, y, z] = sphere.center.to_f64().to_array();
        [x, y, z, sphere.radius.into()].map(f64::to_bits)
    };
    for _ in 0..cases(100) {
        let slice = questions::scene::<V>(&mut rng, 5000);
        let scene = Scene::new(slice);
        for bvh in [&scene.bvh, &scene.slice.iter().collect()] {
            assert_eq!(bvh.len(), scene.slice.len());
            assert!(bvh.iter().map(bits).eq(scene.slice.iter().copied().map(bits)));
            assert!(bvh.iter().rev().map(bits).eq(scene.slice.iter().rev().copied().map(bits)));
            assert!(bvh.get(scene.slice.len()).is_none());
        }
    }
}

/// Spheres that move a little or far, that become others, and that become more or fewer.
fn a_hierarchy_that_is_updated_equals_the_slice<V: Tested>() {
    let mut rng = Rng::new(4);
    let mut hits = 0;
    for _ in 0..cases(200) {
        let mut scene = Scene::<V>::new(questions::scene(&mut rng, 600));
        for _ in 0..4 {
            let kind = rng.below(8);
            let step = choose(&mut rng, &[0.0, 1e-3, 0.1, 0.1, 10.0]);
            for sphere in &mut scene.slice {
                let shift = rng.unit_vector() * sphere.radius.into() * step;
                let moved = sphere.center.to_f64() + shift;
                sphere.center = V::from_f64(moved);
            }
            match kind {
                0 => scene.slice.reverse(),
                1 => scene.slice.truncate(scene.slice.len() / 2),
                2 => scene.slice.extend(questions::scene::<V>(&mut rng, 50)),
                3 if !scene.slice.is_empty() => {
                    let place = usize::try_from(rng.below(scene.slice.len() as u64)).unwrap_or(0);
                    scene.slice[place] =
                        Sphere::new(hostile(&mut rng), hostile_number::<V>(&mut rng));
                }
                _ => {}
            }
            scene.bvh.update(&scene.slice);
            scene.scan = Spheres::from(scene.slice.as_slice());
            assert!(scene.bvh.len() == scene.slice.len());
            for _ in 0..10 {
                let ray = questions::ray(&mut rng, &scene.slice);
                hits += usize::from(nearest(&scene.slice, &ray, all::<V>()).is_some());
                scene.assert_same(&ray, &all::<V>());
            }
        }
    }
    assert!(hits > cases(1000), "{hits}");
}
