//! [`Spheres`] and [`SphereBvh`] against the slice of the same spheres: the same hit, bit for bit, with every set of
//! instructions that the machine has.

use std::ops::Range;
use std::vec::Vec;

use glam::{Vec3, vec3};

use super::lanes::Lanes;
use super::{SphereBvh, Spheres};
use crate::{Hit, Hittable, Ray, Sphere, nearest};

#[allow(
    clippy::duplicate_mod,
    reason = "those of the integration tests, which other unit tests take too"
)]
#[path = "../../tests/support/families.rs"]
mod families;
mod pictures;

use families::{FAMILIES, Family, Rng};

const ALL: Range<f32> = 0.0..f32::INFINITY;

/// A hit as bits: -0.0 is not 0.0 here.
fn bits(found: Option<(usize, Hit)>) -> Option<(usize, [u32; 7], Hit)> {
    found.map(|(index, hit)| {
        let [a, b, c] = hit.point.to_array();
        let [d, e, f] = hit.normal.to_array();
        (index, [hit.t, a, b, c, d, e, f].map(f32::to_bits), hit)
    })
}

/// The same spheres as all three hold them.
struct Scene {
    slice: Vec<Sphere>,
    scan: Spheres,
    /// A hierarchy, however few they are.
    bvh: SphereBvh,
}

impl Scene {
    fn new(slice: Vec<Sphere>) -> Self {
        let scan = Spheres::from(slice.clone());
        Self { bvh: SphereBvh::tree(&scan), scan, slice }
    }

    #[track_caller]
    fn assert_same(&self, ray: &Ray, range: &Range<f32>) {
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
const HOSTILE: [f32; 17] = [
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
    -1e-30,
    1e-22,
    1.2e18, // above 2^60
    1.1e18, // below
    1.0,
];

fn hostile(rng: &mut Rng) -> Vec3 {
    [(); 3].map(|()| choose(rng, &HOSTILE)).into()
}

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
        _ => sphere = Sphere::new(hostile(rng), choose(rng, &HOSTILE)),
    }
    sphere
}

/// The float after a positive one.
fn above(t: f32) -> f32 {
    if t > 0.0 && t < f32::INFINITY { f32::from_bits(t.to_bits() + 1) } else { t }
}

/// Ranges that hold all, that begin or end at a hit, and that are none.
fn ranges(rng: &mut Rng, slice: &[Sphere], ray: &Ray) -> Vec<Range<f32>> {
    let mut ranges = vec![ALL, f32::NEG_INFINITY..f32::MAX];
    let first = nearest(slice, ray, ALL).map(|(_, hit)| hit.t);
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
        for length in (0..=70).chain([255, 256, 257, 272, 273]) {
            let (ray, sphere) = (family.f32)(&mut rng);
            let scene = Scene::new((0..length).map(|_| member(&mut rng, family, sphere)).collect());
            for range in ranges(&mut rng, &scene.slice, &ray) {
                scene.assert_same(&ray, &range);
            }
        }
    }
}

/// Whether the sphere is found among `count` that are not in its way: nothing nearer hides that a filter drops it.
fn assert_found_alone(rng: &mut Rng, count: usize, ray: &Ray, sphere: Sphere) {
    let mut slice: Vec<Sphere> = (0..count)
        .map(|_| match rng.below(3) {
            0 => Sphere::new(Vec3::ZERO, -1.0),
            // Points, which a line hardly ever goes through, so that the hierarchy has more than one box.
            1 => Sphere::new(
                sphere.center + rng.unit_vector().as_vec3() * (sphere.radius * 4.0),
                0.0,
            ),
            _ => Sphere::new(ray.at(-1.0) + rng.unit_vector().as_vec3() * 1e-3, 0.0),
        })
        .collect();
    let index = usize::try_from(rng.below(count as u64)).unwrap_or(0);
    slice[index] = sphere;
    let scene = Scene::new(slice);
    scene.assert_same(ray, &ALL);
    if let Some(hit) = sphere.intersect(ray, ALL) {
        scene.assert_same(ray, &(0.0..above(hit.t)));
        scene.assert_same(ray, &(hit.t..f32::INFINITY));
        let spawned = hit.spawn(choose(rng, &[hit.normal, -hit.normal, ray.direction]));
        scene.assert_same(&spawned, &ALL);
    }
}

#[test]
fn finds_every_sphere_alone_in_every_lane() {
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for _ in 0..200 {
            let (ray, sphere) = (family.f32)(&mut rng);
            assert_found_alone(&mut rng, 70, &ray, sphere);
            assert_found_alone(&mut rng, 4, &ray, sphere);
        }
    }
}

#[test]
fn finds_every_sphere_alone_at_every_scale() {
    // Far beyond what the filters compute with: lengths up to 2^60, directions from 2^-30 to 2^60.
    let power_of_two = |exponent: i16| f32::from(exponent).exp2();
    let mut rng = Rng::new(1);
    for family in FAMILIES.iter().filter(|family| ["easy", "grazing"].contains(&family.name)) {
        for scale in (-90..=90).step_by(3).map(power_of_two) {
            for stretch in (-80..=62).step_by(2).map(power_of_two) {
                let (ray, sphere) = (family.f32)(&mut rng);
                let ray = Ray::new(ray.origin * scale, ray.direction * stretch);
                let sphere = Sphere::new(sphere.center * scale, sphere.radius * scale);
                assert_found_alone(&mut rng, 35, &ray, sphere);
                assert_found_alone(&mut rng, 4, &ray, sphere);
            }
        }
    }
}

#[test]
fn finds_large_spheres_from_afar() {
    // The square of the distance overflows from 2^64 on, where the spheres are still of a size that the filters compute with.
    let mut rng = Rng::new(1);
    let mut hits = 0;
    for distance in 50..=82_i16 {
        for _ in 0..50 {
            let direction = rng.unit_vector().as_vec3() * 1e-5;
            let sphere = Sphere::new(rng.unit_vector().as_vec3() * 59_f32.exp2(), 59_f32.exp2());
            let origin = sphere.center - direction * f32::from(distance).exp2() * 1e5;
            let ray = Ray::new(origin, direction);
            hits += u32::from(sphere.occludes(&ray, ALL));
            assert_found_alone(&mut rng, 70, &ray, sphere);
            assert_found_alone(&mut rng, 4, &ray, sphere);
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
            let scene = Scene::new(
                (0..length)
                    .map(|i| if i < first { Sphere::new(Vec3::X * 9.0, 1.0) } else { sphere })
                    .collect(),
            );
            scene.assert_same(&ray, &ALL);
            let found = scene.bvh.nearest(&ray, ALL);
            assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((first, 2.0)));
        }
    }
}

#[test]
fn of_equal_distances_the_lowest_index_of_large_and_small() {
    // All touch the plane x = 2 at the same point. The large ones are kept apart.
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    for turn in 0..200 {
        let scene = Scene::new(
            (0..200_u8)
                .map(|i| {
                    let radius = if (turn + usize::from(i)) % 13 == 0 { 4096.0 } else { 1.0 };
                    Sphere::new(Vec3::X * (2.0 + radius), radius)
                })
                .collect(),
        );
        scene.assert_same(&ray, &ALL);
        assert_eq!(scene.bvh.nearest(&ray, ALL).map(|(index, _)| index), Some(0));
    }
}

/// What a long run asks: scenes of many kinds, and rays that are hard for their boxes and filters.
mod questions {
    use super::*;

    fn float(rng: &mut Rng, low: f64, high: f64) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "any number will do")]
        let number = rng.uniform(low, high) as f32;
        number
    }

    fn integer(rng: &mut Rng, low: i64, high: i64) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "small integers")]
        let number = rng.integer(low, high) as f32;
        number
    }

    fn integers(rng: &mut Rng, low: i64, high: i64) -> Vec3 {
        [(); 3].map(|()| integer(rng, low, high)).into()
    }

    fn any_bits(rng: &mut Rng) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
        let bits = rng.bits() as u32;
        f32::from_bits(bits)
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
    pub(super) fn scene(rng: &mut Rng, most: u64) -> Vec<Sphere> {
        let length = length(rng, most);
        let mut slice: Vec<Sphere> = match rng.below(6) {
            // Repeated and concentric, on a lattice.
            0 | 1 => (0..length)
                .map(|_| {
                    let radius = choose(rng, &[0.5, 1.0, 1.0, 1.5, 0.0, 2.0]);
                    Sphere::new(integers(rng, -4, 4), radius)
                })
                .collect(),
            2 => {
                let radius = choose(rng, &[0.001, 0.1, 1.0, 10.0]);
                let scale = choose(rng, &[1.0, 1.0, 1e-9, 1e6, 1e15]);
                (0..length)
                    .map(|_| {
                        let center = rng.unit_vector().as_vec3() * float(rng, 0.0, 30.0);
                        Sphere::new(center * scale, radius * float(rng, 0.5, 1.5) * scale)
                    })
                    .collect()
            }
            // Radii over many orders of magnitude, some large.
            3 => (0..length)
                .map(|_| {
                    let most = if rng.below(9) == 0 { 5.0 } else { 0.5 };
                    let radius = 10_f32.powf(float(rng, -6.0, most));
                    Sphere::new(
                        rng.unit_vector().as_vec3() * (radius + float(rng, 0.0, 30.0)),
                        radius,
                    )
                })
                .collect(),
            4 => {
                let family = choose(rng, FAMILIES);
                let (_, sphere) = (family.f32)(rng);
                (0..length).map(|_| member(rng, &family, sphere)).collect()
            }
            // On one line or in one plane.
            _ => (0..length)
                .map(|_| {
                    let flat = choose(rng, &[Vec3::X, vec3(1.0, 0.0, 1.0)]);
                    Sphere::new(integers(rng, -40, 40) * flat, choose(rng, &[0.25, 0.5, 1.0]))
                })
                .collect(),
        };
        if rng.below(4) == 0 && !slice.is_empty() {
            for _ in 0..rng.below(20) {
                let place = usize::try_from(rng.below(slice.len() as u64)).unwrap_or(0);
                slice[place] = match rng.below(3) {
                    0 => Sphere::new(hostile(rng), choose(rng, &HOSTILE)),
                    1 => Sphere::new(slice[place].center, choose(rng, &HOSTILE)),
                    _ => Sphere::new([(); 3].map(|()| any_bits(rng)).into(), any_bits(rng)),
                };
            }
        }
        slice
    }

    /// A ray for that scene.
    pub(super) fn ray(rng: &mut Rng, slice: &[Sphere]) -> Ray {
        let target = if slice.is_empty() { Sphere::default() } else { choose(rng, slice) };
        let Sphere { center, radius } = target;
        let unit = rng.unit_vector().as_vec3();
        // A corner of its box, which is where boxes have their faces.
        let corner = center + radius * Vec3::from([(); 3].map(|()| choose(rng, &[-1.0, 0.0, 1.0])));
        let mut origin = match rng.below(8) {
            0 => integers(rng, -6, 6),
            1 => center,
            2 => center + unit * radius,
            3 => corner,
            4 => center + unit * (radius * float(rng, 0.0, 2.0)),
            5 => center + unit * radius * 10_f32.powf(float(rng, 0.0, 6.0)),
            6 => corner + choose(rng, &[Vec3::X, Vec3::Y, Vec3::Z]) * integer(rng, -50, 50),
            _ => unit * float(rng, 0.0, 100.0),
        };
        let mut direction = match rng.below(7) {
            0 => choose(rng, &[Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z]),
            1 => integers(rng, -2, 2),
            2 => center - origin,
            3 => center + radius * unit - origin,
            4 => corner - origin,
            // Nearly parallel to an axis or a plane.
            5 => {
                let mut direction = choose(rng, &[unit, Vec3::X, Vec3::NEG_Y, Vec3::Z]);
                for _ in 0..=rng.below(2) {
                    let axis = choose(rng, &[0, 1, 2]);
                    direction[axis] =
                        choose(rng, &[0.0, -0.0, 1e-30, -1e-30, 1e-8, -1e-7, 1e-6, 1e-40]);
                }
                direction
            }
            _ => rng.unit_vector().as_vec3(),
        };
        match rng.below(24) {
            0 => direction *= 10_f32.powf(float(rng, -12.0, 20.0)),
            1 => origin = hostile(rng),
            2 => direction = hostile(rng),
            3 => {
                // At infinity's edge, toward the scene.
                origin = unit * 10_f32.powf(float(rng, 15.0, 38.0));
                direction = center - origin;
            }
            4 => direction *= choose(rng, &[1e-9, 1e-10, 1e18, 1e20]),
            5 => origin = [(); 3].map(|()| any_bits(rng)).into(),
            6 => direction = [(); 3].map(|()| any_bits(rng)).into(),
            _ => {}
        }
        Ray::new(origin, direction)
    }
}

/// `EYERAY_QUESTIONS=10000000 cargo test --release --lib spheres::tests::equals_the_slice_in_a_long_run -- --nocapture`
#[test]
#[expect(clippy::cast_possible_truncation, reason = "it is below the number of ranges")]
fn equals_the_slice_in_a_long_run() {
    let wanted = std::env::var("EYERAY_QUESTIONS");
    let wanted: u64 = wanted.map_or(6_000, |number| number.parse().unwrap());
    let most = if wanted < 100_000 { 300 } else { u64::MAX };
    let mut rng = Rng::new(wanted);
    let (mut asked, mut hits) = (0, 0);
    while asked < wanted {
        let scene = Scene::new(questions::scene(&mut rng, most));
        for _ in 0..20 {
            let ray = questions::ray(&mut rng, &scene.slice);
            hits += u64::from(nearest(&scene.slice, &ray, ALL).is_some());
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            scene.assert_same(&ray, &ALL);
            scene.assert_same(&ray, &ranges[rng.below(ranges.len() as u64) as usize]);
            asked += 2;
        }
    }
    println!("{asked} questions of each set of instructions, {hits} hits in the whole range");
    assert!(hits > wanted / 10, "{hits}");
}

#[test]
fn a_hierarchy_keeps_what_it_is_given() {
    let mut rng = Rng::new(3);
    let bits = |sphere: Sphere| {
        let Sphere { center, radius } = sphere;
        [center.x, center.y, center.z, radius].map(f32::to_bits)
    };
    for _ in 0..100 {
        let slice = questions::scene(&mut rng, 5000);
        let scene = Scene::new(slice);
        for bvh in [&scene.bvh, &scene.slice.iter().copied().collect()] {
            assert_eq!(bvh.len(), scene.slice.len());
            assert!(bvh.iter().map(bits).eq(scene.slice.iter().copied().map(bits)));
            assert!(bvh.iter().rev().map(bits).eq(scene.slice.iter().rev().copied().map(bits)));
            assert!(bvh.get(scene.slice.len()).is_none());
        }
    }
}
