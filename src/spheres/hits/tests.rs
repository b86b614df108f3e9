//! `hits` of both collections against every root of every sphere, sorted by integers of any size.

use std::cmp::Ordering;
use std::ops::Range;
use std::vec::Vec;

use glam::{Vec3, vec3};

use crate::spheres::lanes::Lanes;
use crate::spheres::tests::families::{FAMILIES, Rng};
use crate::spheres::tests::{ALL, Scene, above, bits, member, questions, ranges};
use crate::testing::{Dyadic, ExactChord};
use crate::{Hit, Hittable, Ray, Sphere, nearest};

/// The line of a ray with a sphere, exactly.
fn chord(ray: &Ray, sphere: &Sphere) -> ExactChord {
    let vectors = [sphere.center, ray.origin, ray.direction].map(|vector| vector.to_array());
    let mut numbers = [sphere.radius.into(); 10];
    for (number, coordinate) in numbers.iter_mut().zip(vectors.into_iter().flatten()) {
        *number = coordinate.into();
    }
    ExactChord::new(numbers)
}

/// The sign of x + y for numbers of these signs and squares.
fn sign_of_sum([x, y]: [(Ordering, &Dyadic); 2]) -> Ordering {
    match (x.0, y.0) {
        (Ordering::Equal, sign) | (sign, Ordering::Equal) => sign,
        (sign, other) if sign == other => sign,
        (sign, other) => match x.1.cmp(y.1) {
            Ordering::Greater => sign,
            Ordering::Equal => Ordering::Equal,
            Ordering::Less => other,
        },
    }
}

/// A crossing by brute force: of which sphere, whether it is the far root, and t.
type Expected = (usize, bool, f32);

/// The order of two crossings: by the exact roots, which have a denominator in common, then by index and side.
fn compare(ray: &Ray, slice: &[Sphere], a: &Expected, b: &Expected) -> Ordering {
    let by_index = (a.0, a.1).cmp(&(b.0, b.1));
    if a.2 != b.2 {
        return a.2.total_cmp(&b.2);
    }
    if slice[a.0] == slice[b.0] && a.1 == b.1 {
        return by_index;
    }
    let [first, second] = [a, b].map(|crossing| chord(ray, &slice[crossing.0]));
    // The sign of h + x, with x = ±√D of the first and h with that of the second.
    let h = &first.h - &second.h;
    let sign = |is_far, square: &Dyadic, towards: Ordering| match square.is_zero() {
        true => Ordering::Equal,
        false if is_far => towards,
        false => towards.reverse(),
    };
    let x = sign(a.1, &first.discriminant, Ordering::Greater);
    let y = sign(b.1, &second.discriminant, Ordering::Less);
    let h_squared = &h * &h;
    let left = sign_of_sum([(h.sign(), &h_squared), (x, &first.discriminant)]);
    // Of opposite signs to the second's root: (h + x)² against D₂, which is h² + D₁ - D₂ against -2 h x.
    let by_root = match (left, y) {
        (Ordering::Equal, sign) | (sign, Ordering::Equal) => sign,
        (sign, other) if sign == other => sign,
        (sign, other) => {
            let k = &(&h_squared + &first.discriminant) - &second.discriminant;
            let k_squared = &k * &k;
            let product_squared = &(&h_squared * &first.discriminant) * &Dyadic::new(4, 0);
            let product = match (h.sign(), x) {
                (Ordering::Equal, _) | (_, Ordering::Equal) => Ordering::Equal,
                (h, x) if h == x => Ordering::Greater,
                _ => Ordering::Less,
            };
            match sign_of_sum([(k.sign(), &k_squared), (product, &product_squared)]) {
                Ordering::Greater => sign,
                Ordering::Equal => Ordering::Equal,
                Ordering::Less => other,
            }
        }
    };
    by_root.then(by_index)
}

/// All crossings, in order.
fn crossings(slice: &[Sphere], ray: &Ray, range: &Range<f32>) -> Vec<Expected> {
    let mut all: Vec<Expected> = (0..)
        .zip(slice)
        .filter_map(|(index, sphere)| Some((index, sphere.roots_algebraic(ray)?)))
        .flat_map(|(index, [near, far])| [(index, false, near), (index, true, far)])
        .filter(|(_, _, t)| *t > 0.0 && t.is_finite() && range.contains(t))
        .collect();
    all.sort_by(|a, b| compare(ray, slice, a, b));
    all
}

/// The hit of a crossing, if a range of one float tells it from the sphere's other one.
fn hit_of(slice: &[Sphere], ray: &Ray, &(index, is_far, t): &Expected) -> Option<(usize, Hit)> {
    let sphere = &slice[index];
    let is_told = !is_far || sphere.roots_algebraic(ray).is_some_and(|[near, _]| near < t);
    is_told.then_some((index, sphere.intersect(ray, t..above(t))?))
}

#[track_caller]
fn assert_in_order(scene: &Scene, ray: &Ray, range: &Range<f32>) -> usize {
    let slice = &scene.slice;
    let expected = crossings(slice, ray, range);
    let hits: Vec<_> = expected.iter().map(|crossing| hit_of(slice, ray, crossing)).collect();
    for lanes in Lanes::available() {
        let context = || format!("{lanes:?}, {} spheres, {ray:?}, {range:?}", slice.len());
        let scan: Vec<_> = scene.scan.hits_in_lanes(lanes, ray, range.clone()).collect();
        let bvh: Vec<_> = scene.bvh.hits_in_lanes(lanes, ray, range.clone()).collect();
        for (name, found) in [("scan", scan), ("hierarchy", bvh)] {
            let places = found.iter().map(|(index, hit)| (*index, hit.t.to_bits()));
            let expected = expected.iter().map(|(index, _, t)| (*index, t.to_bits()));
            assert!(places.eq(expected.clone()), "{name}, {}", context());
            for (found, expected) in found.into_iter().zip(&hits).filter(|(_, hit)| hit.is_some()) {
                assert_eq!(bits(Some(found)), bits(*expected), "{name}, {}", context());
            }
        }
    }
    let first = scene.bvh.hits(ray, range.clone()).next();
    assert_eq!(bits(first), bits(scene.bvh.nearest(ray, range.clone())), "{ray:?}, {range:?}");
    expected.len()
}

#[test]
fn gives_every_crossing_in_every_family_and_length() {
    let mut crossings = 0;
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for length in [0, 1, 4, 5, 17, 65] {
            let (ray, sphere) = (family.f32)(&mut rng);
            let scene = Scene::new((0..length).map(|_| member(&mut rng, family, sphere)).collect());
            for range in ranges(&mut rng, &scene.slice, &ray) {
                crossings += assert_in_order(&scene, &ray, &range);
            }
        }
    }
    assert!(crossings > 10_000, "{crossings}");
}

/// `EYERAY_CROSSINGS=10000000 cargo test --release --lib hits::tests::gives_every_crossing_in_a_long_run -- --nocapture`
#[test]
fn gives_every_crossing_in_a_long_run() {
    let wanted = std::env::var("EYERAY_CROSSINGS");
    let wanted: usize = wanted.map_or(20_000, |number| number.parse().unwrap());
    let most = if wanted < 1_000_000 { 300 } else { 5_000 };
    let mut rng = Rng::new(wanted as u64);
    let mut crossings = 0;
    while crossings < wanted {
        let scene = Scene::new(questions::scene(&mut rng, most));
        for _ in 0..10 {
            let ray = questions::ray(&mut rng, &scene.slice);
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            crossings += assert_in_order(&scene, &ray, &ALL);
            let range = usize::try_from(rng.below(ranges.len() as u64)).unwrap();
            crossings += assert_in_order(&scene, &ray, &ranges[range]);
        }
    }
    println!("{crossings} crossings of each set of instructions");
}

/// Unit spheres in a row that touch: where one is left another is entered.
#[test]
fn leaves_and_enters_touching_spheres_by_index() {
    let centers = [2.0, 4.0, 6.0, 8.0];
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [1, 3, 0, 2]] {
        let row = order.map(|place: usize| Sphere::new(Vec3::X * centers[place], 1.0));
        let scene = Scene::new(row.to_vec());
        let found: Vec<_> = scene.bvh.hits(&ray, ALL).map(|(index, hit)| (hit.t, index)).collect();
        let mut expected: Vec<_> = (0..4)
            .flat_map(|index| [-1.0, 1.0].map(|step| (row[index].center.x + step, index)))
            .collect();
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(found, expected);
        assert_in_order(&scene, &ray, &ALL);
    }
}

/// A line that touches enters and leaves at once, and what is there twice is crossed twice.
#[test]
fn touches_twice_and_keeps_duplicates() {
    let ray = Ray::new(vec3(-9.0, 1.0, 0.0), Vec3::X);
    for count in [1, 2, 5, 40, 300] {
        let scene = Scene::new(vec![Sphere::new(Vec3::ZERO, 1.0); count]);
        let found: Vec<_> = scene.bvh.hits(&ray, ALL).collect();
        assert_eq!(found.len(), 2 * count);
        for (place, (index, hit)) in found.iter().enumerate() {
            assert_eq!((*index, hit.t, hit.normal), (place / 2, 9.0, Vec3::Y));
        }
        assert_in_order(&scene, &ray, &ALL);

        let through = Ray::new(Vec3::NEG_X * 9.0, Vec3::X);
        let found = scene.scan.hits(&through, ALL).map(|(index, hit)| (index, hit.t));
        let expected = [8.0, 10.0].map(|t| (0..count).map(move |index| (index, t)));
        assert!(found.eq(expected.into_iter().flatten()));
        assert_in_order(&scene, &through, &ALL);
        // From inside, only where it leaves.
        assert_eq!(assert_in_order(&scene, &Ray::new(Vec3::ZERO, Vec3::X), &ALL), count);
    }
}

#[test]
fn gives_nested_spheres_from_outside_in_and_out() {
    // In any order of indices.
    let radius = |index: u16| f32::from(1 + index * 7 % 1000) / 8.0;
    let scene = Scene::new((0..1000).map(|index| Sphere::new(Vec3::ZERO, radius(index))).collect());
    for origin in [Vec3::NEG_X * 500.0, Vec3::NEG_X * 60.0, Vec3::ZERO] {
        let ray = Ray::new(origin, Vec3::X);
        assert!(assert_in_order(&scene, &ray, &ALL) >= 1000);
        assert!(assert_in_order(&scene, &ray, &(55.0..f32::INFINITY)) >= 500);
    }
}

/// The example of the documentation, with many spheres.
#[test]
fn finds_the_nearest_that_is_visible() {
    let mut rng = Rng::new(4);
    for _ in 0..40 {
        let slice = questions::scene(&mut rng, 300);
        let scene = Scene::new(slice);
        let visible: Vec<bool> = scene.slice.iter().map(|_| rng.below(3) == 0).collect();
        let kept: Vec<usize> = (0..visible.len()).filter(|&index| visible[index]).collect();
        let spheres: Vec<Sphere> = kept.iter().map(|&index| scene.slice[index]).collect();
        for _ in 0..10 {
            let ray = questions::ray(&mut rng, &scene.slice);
            let expected = nearest(&spheres, &ray, ALL).map(|(index, hit)| (kept[index], hit));
            let scan = scene.scan.hits(&ray, ALL).find(|(index, _)| visible[*index]);
            let bvh = scene.bvh.hits(&ray, ALL).find(|(index, _)| visible[*index]);
            assert_eq!(bits(scan), bits(expected));
            assert_eq!(bits(bvh), bits(expected));
        }
    }
}
