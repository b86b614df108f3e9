//! `hits` of both collections against every root of every sphere, sorted by integers of any size.

use std::cmp::Ordering;
use std::ops::Range;
use std::vec::Vec;

use glam::{DVec3, dvec3};

use crate::spheres::lanes::Lanes;
use crate::spheres::tests::families::{FAMILIES, Rng};
use crate::spheres::tests::{
    Scene, Tested, above, all, bits, in_both, member, questions, ranges, ray, scalar, sphere,
};
use crate::testing::{Dyadic, ExactChord};
use crate::{Hit, Hittable, Ray, Scalar, Sphere, Vector, nearest};

in_both! {
    gives_every_crossing_in_every_family_and_length
    gives_every_crossing_in_a_long_run
    leaves_and_enters_touching_spheres_by_index
    touches_twice_and_keeps_duplicates
    gives_nested_spheres_from_outside_in_and_out
    finds_the_nearest_that_is_visible
    leaves_on_the_other_side_at_the_same_t
    gives_every_crossing_wherever_the_spheres_are
}

/// The line of a ray with a sphere, exactly.
fn chord<V: Tested>(ray: &Ray<V>, sphere: &Sphere<V>) -> ExactChord {
    let vectors = [sphere.center, ray.origin, ray.direction].map(Vector::to_f64);
    let mut numbers = [sphere.radius.into(); 10];
    for (number, coordinate) in
        numbers.iter_mut().zip(vectors.into_iter().flat_map(|vector| vector.to_array()))
    {
        *number = coordinate;
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
type Expected<V> = (usize, bool, <V as Vector>::Scalar);

/// The order of two crossings: by the exact roots, which have a denominator in common, then by index and side.
fn compare<V: Tested>(
    ray: &Ray<V>,
    slice: &[Sphere<V>],
    a: &Expected<V>,
    b: &Expected<V>,
) -> Ordering {
    let by_index = (a.0, a.1).cmp(&(b.0, b.1));
    if a.2 != b.2 {
        return a.2.into().total_cmp(&b.2.into());
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
fn crossings<V: Tested>(
    slice: &[Sphere<V>],
    ray: &Ray<V>,
    range: &Range<V::Scalar>,
) -> Vec<Expected<V>> {
    let mut all: Vec<Expected<V>> = (0..)
        .zip(slice)
        .filter_map(|(index, sphere)| Some((index, sphere.roots_algebraic(ray)?)))
        .flat_map(|(index, [near, far])| [(index, false, near), (index, true, far)])
        .filter(|(_, _, t)| all::<V>().contains(t) && *t > V::Scalar::ZERO && range.contains(t))
        .collect();
    all.sort_by(|a, b| compare(ray, slice, a, b));
    all
}

/// The hit of a crossing: by a range of one float where that tells it from the sphere's other one.
fn hit_of<V: Tested>(
    slice: &[Sphere<V>],
    ray: &Ray<V>,
    &(index, is_far, t): &Expected<V>,
) -> Option<(usize, Hit<V>)> {
    let sphere = &slice[index];
    let range = t..above::<V>(t);
    let hit =
        if is_far { sphere.exit(ray, range.clone()) } else { sphere.intersect(ray, range.clone()) };
    if is_far && sphere.roots(ray).is_some_and(|[near, _]| near < t) {
        let told = sphere.intersect(ray, range).map(|hit| (index, hit));
        assert_eq!(bits(hit.map(|hit| (index, hit))), bits(told), "{sphere:?}, {ray:?}");
    }
    Some((index, hit?))
}

#[track_caller]
fn assert_in_order<V: Tested>(scene: &Scene<V>, ray: &Ray<V>, range: &Range<V::Scalar>) -> usize {
    let slice = &scene.slice;
    let expected = crossings(slice, ray, range);
    let hits: Vec<_> = expected.iter().map(|crossing| bits(hit_of(slice, ray, crossing))).collect();
    for lanes in Lanes::available() {
        let context = || format!("{lanes:?}, {} spheres, {ray:?}, {range:?}", slice.len());
        let scan: Vec<_> = scene.scan.hits_in_lanes(lanes, ray, range.clone()).collect();
        let bvh: Vec<_> = scene.bvh.hits_in_lanes(lanes, ray, range.clone()).collect();
        for (name, found) in [("scan", scan), ("hierarchy", bvh)] {
            let places = found.iter().map(|(index, hit)| (*index, V::to_bits(hit.t)));
            let expected = expected.iter().map(|(index, _, t)| (*index, V::to_bits(*t)));
            assert!(places.eq(expected.clone()), "{name}, {}", context());
            for (found, expected) in found.into_iter().zip(&hits) {
                assert_eq!(bits(Some(found)), *expected, "{name}, {}", context());
            }
        }
    }
    let first = scene.bvh.hits(ray, range.clone()).next();
    assert_eq!(bits(first), bits(scene.bvh.nearest(ray, range.clone())), "{ray:?}, {range:?}");
    expected.len()
}

fn gives_every_crossing_in_every_family_and_length<V: Tested>() {
    let mut crossings = 0;
    for (seed, family) in (1..).zip(FAMILIES) {
        let mut rng = Rng::new(seed);
        for length in [0, 1, 4, 5, 17, 65] {
            let (ray, sphere) = V::case(family, &mut rng);
            let scene = Scene::new((0..length).map(|_| member(&mut rng, family, sphere)).collect());
            for range in ranges(&mut rng, &scene.slice, &ray) {
                crossings += assert_in_order(&scene, &ray, &range);
            }
        }
    }
    assert!(crossings > 10_000, "{crossings}");
}

/// `EYERAY_CROSSINGS=10000000 cargo test --release --lib hits::tests -- gives_every_crossing_in_a_long_run --nocapture`
fn gives_every_crossing_in_a_long_run<V: Tested>() {
    let wanted = std::env::var("EYERAY_CROSSINGS");
    let wanted: usize = wanted.map_or(20_000, |number| number.parse().unwrap());
    let most = if wanted < 1_000_000 { 300 } else { 5_000 };
    let mut rng = Rng::new(wanted as u64);
    let mut crossings = 0;
    while crossings < wanted {
        let scene = Scene::<V>::new(questions::scene(&mut rng, most));
        for _ in 0..10 {
            let ray = questions::ray(&mut rng, &scene.slice);
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            crossings += assert_in_order(&scene, &ray, &all::<V>());
            let range = usize::try_from(rng.below(ranges.len() as u64)).unwrap();
            crossings += assert_in_order(&scene, &ray, &ranges[range]);
        }
    }
    println!("{crossings} crossings of each set of instructions");
}

/// Unit spheres in a row that touch: where one is left another is entered.
fn leaves_and_enters_touching_spheres_by_index<V: Tested>() {
    let centers = [2.0, 4.0, 6.0, 8.0];
    let ray = ray::<V>(DVec3::ZERO, DVec3::X);
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [1, 3, 0, 2]] {
        let row = order.map(|place: usize| sphere(DVec3::X * centers[place], 1.0));
        let scene = Scene::new(row.to_vec());
        let hits = scene.bvh.hits(&ray, all::<V>());
        let found: Vec<(f64, usize)> = hits.map(|(index, hit)| (hit.t.into(), index)).collect();
        let mut expected: Vec<_> = (0..4)
            .flat_map(|index| [-1.0, 1.0].map(|step| (centers[order[index]] + step, index)))
            .collect();
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(found, expected);
        assert_in_order(&scene, &ray, &all::<V>());
    }
}

/// A line that touches enters and leaves at once, and what is there twice is crossed twice.
fn touches_twice_and_keeps_duplicates<V: Tested>() {
    let touching = ray::<V>(dvec3(-9.0, 1.0, 0.0), DVec3::X);
    for count in [1, 2, 5, 40, 300] {
        let scene = Scene::new(vec![sphere::<V>(DVec3::ZERO, 1.0); count]);
        let found: Vec<_> = scene.bvh.hits(&touching, all::<V>()).collect();
        assert_eq!(found.len(), 2 * count);
        for (place, (index, hit)) in found.iter().enumerate() {
            let found: (_, f64, _) = (*index, hit.t.into(), hit.normal.to_f64());
            assert_eq!(found, (place / 2, 9.0, DVec3::Y));
        }
        assert_in_order(&scene, &touching, &all::<V>());

        let through = ray::<V>(DVec3::NEG_X * 9.0, DVec3::X);
        let hits = scene.scan.hits(&through, all::<V>());
        let found = hits.map(|(index, hit)| (index, hit.t.into()));
        let expected = [8.0, 10.0].map(|t| (0..count).map(move |index| (index, t)));
        assert!(found.eq(expected.into_iter().flatten()));
        assert_in_order(&scene, &through, &all::<V>());
        // From inside, only where it leaves.
        let inside = ray::<V>(DVec3::ZERO, DVec3::X);
        assert_eq!(assert_in_order(&scene, &inside, &all::<V>()), count);
    }
}

fn gives_nested_spheres_from_outside_in_and_out<V: Tested>() {
    // In any order of indices.
    let radius = |index: u16| f64::from(1 + index * 7 % 1000) / 8.0;
    let spheres = (0..1000).map(|index| sphere(DVec3::ZERO, radius(index)));
    let scene = Scene::<V>::new(spheres.collect());
    for origin in [DVec3::NEG_X * 500.0, DVec3::NEG_X * 60.0, DVec3::ZERO] {
        let ray = ray(origin, DVec3::X);
        assert!(assert_in_order(&scene, &ray, &all::<V>()) >= 1000);
        assert!(assert_in_order(&scene, &ray, &(scalar::<V>(55.0)..V::Scalar::INFINITY)) >= 500);
    }
}

/// The example of the documentation, with many spheres.
fn finds_the_nearest_that_is_visible<V: Tested>() {
    let mut rng = Rng::new(4);
    for _ in 0..40 {
        let slice = questions::scene::<V>(&mut rng, 300);
        let scene = Scene::new(slice);
        let visible: Vec<bool> = scene.slice.iter().map(|_| rng.below(3) == 0).collect();
        let kept: Vec<usize> = (0..visible.len()).filter(|&index| visible[index]).collect();
        let spheres: Vec<Sphere<V>> = kept.iter().map(|&index| scene.slice[index]).collect();
        for _ in 0..10 {
            let ray = questions::ray(&mut rng, &scene.slice);
            let expected =
                nearest(&spheres, &ray, all::<V>()).map(|(index, hit)| (kept[index], hit));
            let scan = scene.scan.hits(&ray, all::<V>()).find(|(index, _)| visible[*index]);
            let bvh = scene.bvh.hits(&ray, all::<V>()).find(|(index, _)| visible[*index]);
            assert_eq!(bits(scan), bits(expected));
            assert_eq!(bits(bvh), bits(expected));
        }
    }
}

/// From so far away that both roots round to the same number.
fn leaves_on_the_other_side_at_the_same_t<V: Tested>() {
    let distance = if V::LIMITS[0] < 1e300 { 1e10 } else { 1e20 };
    let scene = Scene::<V>::new(vec![sphere(DVec3::ZERO, 1.0); 40]);
    let ray = ray::<V>(DVec3::X * distance, DVec3::NEG_X * 2.0);
    for hits in
        [scene.scan.hits(&ray, all::<V>()).collect(), scene.bvh.hits(&ray, all::<V>()).collect()]
    {
        let hits: Vec<(usize, Hit<V>)> = hits;
        assert_eq!(hits.len(), 80);
        for (place, (index, hit)) in hits.iter().enumerate() {
            let side = if place < 40 { DVec3::X } else { DVec3::NEG_X };
            let found: (_, f64, _, _) =
                (*index, hit.t.into(), hit.point.to_f64(), hit.normal.to_f64());
            let t: f64 = scalar::<V>(distance / 2.0).into();
            assert_eq!(found, (place % 40, t, side, side));
        }
    }
    assert_in_order(&scene, &ray, &all::<V>());
}

/// Clusters far from each other, each a region of its own, on one line, and seen from near and from afar.
fn gives_every_crossing_wherever_the_spheres_are<V: Tested>() {
    let mut rng = Rng::new(9);
    let mut crossings = 0;
    for turn in 0..16 {
        let axis = rng.unit_vector();
        let far = 10_f64.powf(rng.uniform(2.0, 7.0));
        let clusters =
            [0.0, 1.0, 1.0 + rng.uniform(1e-3, 1e-1), -3.0].map(|place| axis * far * place);
        let slice: Vec<Sphere<V>> = (0..600)
            .map(|index| {
                let center = clusters[index % 4] + rng.unit_vector() * rng.uniform(0.0, 10.0);
                sphere(center, rng.uniform(1.0, 3.0))
            })
            .collect();
        let scene = Scene::new(slice);
        for _ in 0..4 {
            let target = clusters[turn % 4] + rng.unit_vector() * rng.uniform(0.0, 5.0);
            let from = match rng.below(3) {
                0 => target + rng.unit_vector() * 10.0,
                1 => target - axis * far * rng.uniform(1.0, 30.0),
                _ => target + axis * far * rng.uniform(1.0, 30.0),
            };
            let ray = ray::<V>(from, target - from);
            for range in ranges(&mut rng, &scene.slice, &ray) {
                crossings += assert_in_order(&scene, &ray, &range);
                scene.assert_same(&ray, &range);
            }
        }
    }
    assert!(crossings > 3_000, "{crossings}");
}
