use glam::{DVec3, Vec3};

use super::*;
use crate::Scalar;
use crate::testing::support::oracle::{Coordinates, Truth};
use crate::testing::{Dyadic, ExactChord, Float, Random, Root};

/// A ray and two crossings in `f64`, which holds those of `f32` too.
type Pair = (Ray<DVec3>, [(Sphere<DVec3>, Side); 2]);

const SIDES: [Side; 2] = [Side::Near, Side::Far];

fn chord(ray: &Ray<DVec3>, sphere: &Sphere<DVec3>) -> ExactChord {
    let [c, p, d] = [sphere.center, ray.origin, ray.direction].map(|vector| vector.to_array());
    ExactChord::new([c[0], c[1], c[2], p[0], p[1], p[2], d[0], d[1], d[2], sphere.radius])
}

/// The order by square roots of as many digits as it takes; equal where the product of the roots' difference and its conjugates
/// is zero, and the difference is zero in 4,096 digits.
fn exact_order((ray, crossings): &Pair) -> Ordering {
    let [first, second] = [0, 1].map(|i| chord(ray, &crossings[i].0));
    let difference = &first.h - &second.h;
    let k = &(&(&difference * &difference) - &first.discriminant) - &second.discriminant;
    let product = &first.discriminant * &second.discriminant;
    let may_be_equal = (&k * &k).scaled(-2) == product;
    let mut bits = 256;
    loop {
        let [x, y] = [&first, &second].map(|chord| chord.discriminant.square_root(bits));
        let error = (&x + &y).scaled(1 - bits);
        let x = if crossings[0].1 == Side::Near { -&x } else { x };
        let y = if crossings[1].1 == Side::Near { y } else { -&y };
        let sum = &(&difference + &x) + &y;
        if sum.clone().abs() > error || error.is_zero() {
            return sum.sign();
        }
        if may_be_equal && bits > 4096 {
            return Ordering::Equal;
        }
        bits *= 2;
    }
}

/// The first root, or nearly that.
fn near_first((ray, [(sphere, side), _]): &Pair) -> f64 {
    let roots = sphere.roots_algebraic(ray).unwrap();
    roots[usize::from(*side == Side::Far)].clamp(-f64::MAX, f64::MAX)
}

fn order_of(pair: &Pair) -> Ordering {
    let (ray, [(first, a), (second, b)]) = pair;
    compare_crossings(ray, near_first(pair), (first, *a), (second, *b))
}

/// How the integers alone compare.
fn order_in_integers((ray, [(first, a), (second, b)]): &Pair) -> Ordering {
    CrossingPair::new(ray, (first, *a), (second, *b)).compare_in_integers()
}

/// What `f64` is certain of.
fn plain_order(pair: &Pair) -> Option<Ordering> {
    let (ray, [(first, a), (second, b)]) = pair;
    let t = near_first(pair);
    let [first, second] = [first, second].map(|sphere| Nearby::new(&Line::new(sphere, ray), t));
    first?.compare(*a, &second?, *b)
}

/// Compares a pair in both orders, in all steps, with the exact order, and returns that.
#[track_caller]
fn check(pair: &Pair) -> Ordering {
    let exact = exact_order(pair);
    let (ray, [first, second]) = pair;
    let swapped = (*ray, [*second, *first]);
    assert_eq!(order_of(pair), exact, "{pair:?}");
    assert_eq!(order_of(&swapped), exact.reverse(), "{pair:?}");
    assert_eq!(order_in_integers(pair), exact, "{pair:?}");
    if let Some(plain) = plain_order(pair) {
        assert_eq!(plain, exact, "{pair:?}");
    }
    exact
}

/// Whether the crossings exist.
fn exists((ray, crossings): &Pair) -> bool {
    ray.direction != DVec3::ZERO
        && crossings.iter().all(|(sphere, _)| {
            sphere.radius >= 0.0 && !chord(ray, sphere).discriminant.is_negative()
        })
}

/// The numbers of the pair in single precision.
fn single((ray, crossings): &Pair) -> Pair {
    let vector = |v: DVec3| v.as_vec3().as_dvec3();
    #[expect(clippy::cast_possible_truncation, reason = "that is what this is for")]
    let sphere = |s: &Sphere<DVec3>| Sphere::new(vector(s.center), f64::from(s.radius as f32));
    (
        Ray::new(vector(ray.origin), vector(ray.direction)),
        [(sphere(&crossings[0].0), crossings[0].1), (sphere(&crossings[1].0), crossings[1].1)],
    )
}

fn unit(random: &mut Random) -> DVec3 {
    loop {
        let vector = DVec3::from([0; 3].map(|_| random.sign() * (random.mantissa() - 1.0)));
        let length = vector.length();
        if length > 0.1 && length < 1.0 {
            return vector / length;
        }
    }
}

/// Two spheres of radii around 1 near the world's origin that a ray from that distance crosses close to the same point.
fn near_one_point(random: &mut Random, distance: f64) -> Pair {
    let direction = unit(random);
    let point = unit(random) * 4.0;
    let ray = Ray::new(point - direction * distance, direction * random.mantissa());
    let crossings = [0; 2].map(|_| {
        let normal = unit(random);
        // At the limb, too.
        let across = normal.cross(direction).normalize();
        let normal = if random.below(4) == 0 { across } else { normal };
        let side = if normal.dot(direction) < 0.0 { Side::Near } else { Side::Far };
        let radius = random.mantissa() * 2_f64.powi(random.integer(-3..=3));
        (Sphere::new(point - normal * radius, radius), side)
    });
    (ray, crossings)
}

/// Compares that many pairs in either precision.
fn compare_near_one_point(pairs: usize) {
    let mut random = Random::new(1);
    let mut compared = [0; 2];
    let mut plain = [0; 2];
    while compared[0] + compared[1] < pairs {
        let distance = 10_f64.powi(random.integer(0..=9));
        let double = near_one_point(&mut random, distance);
        for (precision, pair) in [single(&double), double].iter().enumerate() {
            if exists(pair) {
                check(pair);
                compared[precision] += 1;
                plain[precision] += usize::from(plain_order(pair).is_some());
            }
        }
    }
    println!("{plain:?} of {compared:?}, in f32 and in f64, are decided in plain f64");
    assert!(plain[0] > compared[0] / 2 && plain[1] > compared[1] / 2, "{plain:?} of {compared:?}");
}

#[test]
fn crossings_near_one_point_are_in_order() {
    compare_near_one_point(4_000);
}

#[test]
#[ignore = "by hand: cargo test --release --lib a_million -- --ignored"]
fn a_million_crossings_near_one_point_are_in_order() {
    compare_near_one_point(1_000_000);
}

/// Vectors of integers whose lengths are integers, and these.
const WHOLE: [([i32; 3], i32); 7] = [
    ([1, 2, 2], 3),
    ([2, 3, 6], 7),
    ([1, 4, 8], 9),
    ([4, 4, 7], 9),
    ([2, 6, 9], 11),
    ([6, 6, 7], 11),
    ([0, 0, 1], 1),
];

fn whole(random: &mut Random) -> (DVec3, f64) {
    let (mut vector, length) = WHOLE[random.below(WHOLE.len())];
    vector.rotate_left(random.below(3));
    let by = f64::from(random.integer(1..=5));
    (DVec3::from(vector.map(|x| random.sign() * f64::from(x) * by)), f64::from(length) * by)
}

fn whole_vector(random: &mut Random, most: i32) -> DVec3 {
    DVec3::from([0; 3].map(|_| f64::from(random.integer(-most..=most))))
}

/// Different spheres through the very same point of a ray: touching spheres among them, and lines that touch one or both.
fn through_one_point(random: &mut Random) -> Pair {
    let point = whole_vector(random, 100);
    let direction = loop {
        let direction = whole_vector(random, 6);
        if direction != DVec3::ZERO {
            break direction;
        }
    };
    let ray = Ray::new(point - direction * f64::from(random.integer(-4000..=4000)), direction);
    let crossings = [0; 2].map(|_| {
        let (to_center, radius) = whole(random);
        let side = if to_center.dot(direction) > 0.0 { Side::Near } else { Side::Far };
        (Sphere::new(point + to_center, radius), side)
    });
    (ray, crossings)
}

#[test]
fn different_spheres_through_one_point_are_level() {
    let mut random = Random::new(2);
    let mut equal = 0;
    for _ in 0..3_000 {
        let pair = through_one_point(&mut random);
        assert_eq!(check(&pair), Ordering::Equal, "{pair:?}");
        // The other crossings of both, and centers moved by next to nothing.
        let (ray, [first, second]) = pair;
        for sides in SIDES.map(|first| SIDES.map(|second| [first, second])).concat() {
            check(&(ray, [(first.0, sides[0]), (second.0, sides[1])]));
        }
        let mut moved = second;
        moved.0.center.x *= 1.0 + f64::EPSILON * random.sign();
        let moved = (ray, [first, moved]);
        if exists(&moved) {
            equal += u32::from(check(&moved).is_eq());
        }
    }
    assert!(equal < 1_500, "{equal}");
}

#[test]
fn spheres_through_one_circle_are_level_where_a_line_meets_it() {
    // Center, at a height above the circle, and radius: the circle has radius 12.
    const HEIGHTS: [(f64, f64); 6] =
        [(0.0, 12.0), (5.0, 13.0), (-9.0, 15.0), (16.0, 20.0), (-35.0, 37.0), (5.0, 13.0)];
    let mut random = Random::new(3);
    let mut roots = 0;
    while roots < 1_000 {
        let origin = whole_vector(&mut random, 4000) * DVec3::new(1.0, 1.0, 0.0);
        let target = whole_vector(&mut random, 11) * DVec3::new(1.0, 1.0, 0.0);
        let ray = Ray::new(origin, target - origin);
        let [first, second] = [0; 2].map(|_| {
            let (height, radius) = HEIGHTS[random.below(HEIGHTS.len())];
            Sphere::new(DVec3::Z * height, radius)
        });
        for side in SIDES {
            let pair = (ray, [(first, side), (second, side)]);
            if exists(&pair) {
                assert_eq!(check(&pair), Ordering::Equal, "{pair:?}");
                roots += 1;
            }
        }
    }
}

#[test]
fn the_two_crossings_of_one_sphere_are_level_only_where_the_line_touches() {
    let sphere = Sphere::new(DVec3::ZERO, 5.0);
    for (height, expected) in [(3.0, Ordering::Less), (5.0, Ordering::Equal)] {
        let ray = Ray::new(DVec3::new(-1e9, height, 0.0), DVec3::X);
        let pair = (ray, [(sphere, Side::Near), (sphere, Side::Far)]);
        assert_eq!(check(&pair), expected);
    }
}

#[test]
fn numbers_of_any_size_are_in_order() {
    let mut random = Random::new(4);
    let mut compared = 0;
    for case in 0..400 {
        let mut number = || match case % 4 {
            // Where only the widest integers hold all.
            0 => random.any_float(),
            1 => random.float(-150..=127),
            2 => random.float(-1070..=-1000),
            _ => random.float(-40..=40),
        };
        let mut vector = || DVec3::new(number(), number(), number());
        let (origin, direction) = (vector(), vector());
        let centers = [vector(), vector()];
        let radii = [number().abs(), number().abs()];
        let spheres = [0, 1].map(|i| {
            // Of an origin within, both crossings exist.
            let reach = (centers[i] * 0.25 - origin * 0.25).abs().max_element() * 8.0;
            Sphere::new(centers[i], if case % 3 == 0 { radii[i] } else { reach.min(f64::MAX) })
        });
        for sides in SIDES.map(|first| SIDES.map(|second| [first, second])).concat() {
            let pair =
                (Ray::new(origin, direction), [(spheres[0], sides[0]), (spheres[1], sides[1])]);
            if exists(&pair) {
                check(&pair);
                compared += 1;
            }
        }
    }
    assert!(compared > 800, "{compared}");
}

/// The largest and the smallest numbers together, so that the integers are as long as they can be.
#[test]
fn the_longest_integers_have_room() {
    let (large, small) = (f64::MAX, f64::from_bits(1));
    let ray = Ray::new(DVec3::new(-large, small, large), DVec3::new(large, small, -large));
    let sphere = |radius| Sphere::new(DVec3::new(large, small, -large), radius);
    for sides in SIDES.map(|first| SIDES.map(|second| [first, second])).concat() {
        check(&(ray, [(sphere(large), sides[0]), (sphere(large / 2.0 + small), sides[1])]));
    }
    let single = |x: f32| f64::from(x);
    let (large, small) = (single(f32::MAX), single(f32::from_bits(1)));
    let ray = Ray::new(DVec3::new(-large, small, large), DVec3::new(large, small, -large));
    let sphere = |radius| Sphere::new(DVec3::new(large, small, -large), radius);
    for sides in SIDES.map(|first| SIDES.map(|second| [first, second])).concat() {
        check(&(ray, [(sphere(large), sides[0]), (sphere(single(f32::MAX / 2.0)), sides[1])]));
    }
}

#[test]
fn both_precisions_compare_alike() {
    let ray = Ray::new(Vec3::NEG_X * 1e7, Vec3::X);
    let [first, second] = [0.25, 0.5].map(|y| Sphere::new(Vec3::Y * y, 1.0));
    let order = compare_crossings(&ray, 1e7, (&first, Side::Near), (&second, Side::Near));
    assert_eq!(order, Ordering::Less);
    let [first, second] = [first, second].map(Sphere::<DVec3>::from);
    let order = compare_crossings(&ray.into(), 1e7, (&first, Side::Near), (&second, Side::Near));
    assert_eq!(order, Ordering::Less);
}

/// The bound on roots from close by, as the largest error of random ones in parts of it.
#[test]
fn roots_from_close_by_are_within_their_bound() {
    let mut random = Random::new(5);
    let mut worst = 0.0;
    for _ in 0..4_000 {
        let distance = 10_f64.powi(random.integer(0..=9));
        let pair = near_one_point(&mut random, distance);
        if !exists(&pair) {
            continue;
        }
        let (ray, [(sphere, side), _]) = &pair;
        let t = near_first(&pair);
        let Some(nearby) = Nearby::new(&Line::new(sphere, ray), t) else { continue };
        let ExactChord { a, h, discriminant, .. } = chord(ray, sphere);
        let half = discriminant.square_root(400);
        let root = if *side == Side::Near { &h - &half } else { &h + &half };
        let exact = &root - &(&a * &Dyadic::exactly(t));
        let off = (&Dyadic::exactly(nearby.root(*side)) - &exact).abs().approximately();
        assert!(off <= nearby.error, "{off} for {}: {pair:?}", nearby.error);
        worst = f64::max(off / nearby.error, worst);
    }
    println!("{worst:.3} of the bound");
    assert!(worst > 0.02, "{worst}: the bound is far too wide");
}

/// The first crossing of a sphere whose exact root rounds to `t`.
fn crossing_at<V: Coordinates>(truth: Option<&Truth<V>>, t: V::Scalar) -> Option<(Side, &Root)> {
    let mut roots = SIDES.into_iter().zip(&truth?.roots);
    roots.find(|(_, root)| root.nearest::<V::Scalar>().identical(t))
}

/// Compares hits of two spheres at each of their roots with the exact order: that of t, of equal ones that of the exact roots,
/// and of equal ones, or where one sphere has no root at all, that of the indices. Returns how many hits at one t are in the
/// order of their exact roots.
#[track_caller]
fn check_hits<V: Coordinates>(ray: &Ray<V>, spheres: [Sphere<V>; 2]) -> usize {
    let truths = spheres.map(|sphere| Truth::new(ray, &sphere));
    let roots = truths.iter().flatten().flat_map(|truth| &truth.roots);
    let times =
        roots.map(Root::nearest::<V::Scalar>).filter(|t| *t > V::Scalar::ZERO && t.is_finite());
    let mut told_apart = 0;
    for t in times {
        let case = || format!("{t} {ray:?} {spheres:?}");
        let crossings = truths.each_ref().map(|truth| crossing_at(truth.as_ref(), t));
        for ((sphere, truth), crossing) in spheres.iter().zip(&truths).zip(&crossings) {
            let side = crossing.map(|(side, _)| side);
            if side.is_some() || truth.is_none() {
                assert_eq!(Known::new(ray, sphere, t).side_at(ray, t), side, "{}", case());
            }
        }
        let order = match (crossings, &truths) {
            ([Some((_, first)), Some((_, second))], _) => first.order(second),
            (_, [None, _] | [_, None]) => Ordering::Equal,
            _ => continue,
        };
        told_apart += usize::from(order.is_ne());
        for [first, second] in [[0, 1], [1, 0]] {
            let expected = order.then(first.cmp(&second)).is_lt();
            let is_first = |spheres| is_nearer(ray, (first, t), (second, t), || spheres);
            assert_eq!(is_first(spheres.map(Some)), expected, "{}", case());
            // Where one is no sphere, the lower index is first.
            for spheres in [[None, None], [Some(spheres[0]), None], [None, Some(spheres[1])]] {
                assert_eq!(is_first(spheres), first < second, "{}", case());
            }
            // Another t tells by itself, and the spheres are not asked for.
            let next = next_above::<V>(t);
            assert_eq!(next.ordinal(), t.ordinal() + 1);
            let unasked = || -> [Option<Sphere<V>>; 2] { panic!("{}", case()) };
            assert!(is_nearer(ray, (first, t), (second, next), unasked), "{}", case());
            assert!(!is_nearer(ray, (first, next), (second, t), unasked), "{}", case());
        }
    }
    told_apart
}

/// The numbers of a pair in either precision.
fn check_hits_in_both((ray, crossings): &Pair) -> [usize; 2] {
    let spheres = [crossings[0].0, crossings[1].0];
    let (single_ray, single_crossings) = single(&(*ray, *crossings));
    let single_ray = Ray::new(single_ray.origin.as_vec3(), single_ray.direction.as_vec3());
    let single_spheres = single_crossings
        .map(|(sphere, _)| Sphere::new(sphere.center.as_vec3(), f32::from_f64(sphere.radius)));
    [check_hits(&single_ray, single_spheres), check_hits(ray, spheres)]
}

/// Spheres of up to a few ulps around a point on the x axis, whose coordinate is a power of two or any: a root below a power of
/// two rounds to it only from half as far.
fn as_small_as_an_ulp(random: &mut Random) -> Pair {
    let exponent = random.integer(-20..=20);
    let point = 2_f64.powi(exponent) * [1.0, random.mantissa()][random.below(2)];
    let digits = [23, 52][random.below(2)];
    let ulp = 2_f64.powi(exponent - digits);
    let point = (point / ulp).floor() * ulp;
    let ray = Ray::new(DVec3::NEG_X * point, DVec3::X);
    let crossings = [0; 2].map(|_| {
        let eighths =
            |random: &mut Random, most: i32| f64::from(random.integer(-most..=most)) / 8.0;
        let across = eighths(random, 4) * ulp * 2_f64.powi(random.integer(-20..=0));
        let along = eighths(random, 12) * ulp;
        let radius = eighths(random, 8).abs() * ulp + across.abs();
        (Sphere::new(DVec3::new(along, across, 0.0), radius), Side::Near)
    });
    (ray, crossings)
}

#[test]
fn of_hits_at_one_t_the_first_by_exact_roots_is_nearer() {
    let mut random = Random::new(6);
    let mut told_apart = [0; 2];
    let mut check = |pair: &Pair| {
        for (all, these) in told_apart.iter_mut().zip(check_hits_in_both(pair)) {
            *all += these;
        }
    };
    for case in 0..1_200 {
        let pair = match case % 4 {
            0 | 1 => as_small_as_an_ulp(&mut random),
            2 => through_one_point(&mut random),
            _ => {
                let distance = 10_f64.powi(random.integer(6..=16));
                near_one_point(&mut random, distance)
            }
        };
        check(&pair);
    }
    println!("{told_apart:?} ties, in f32 and in f64, are told apart");
    assert!(told_apart.iter().all(|count| *count > 200), "{told_apart:?}");
}

/// The float after the largest one is infinite, and tells no ulp.
#[test]
fn hits_at_the_largest_t_are_in_order() {
    let mut random = Random::new(7);
    let mut told_apart = 0;
    for _ in 0..200 {
        // Of f32, a distance of 2⁶⁴ and less than that by some ulps.
        let direction = Vec3::X * 2_f32.powi(-64);
        let ray = Ray::new(Vec3::NEG_X * 2_f32.powi(64), direction);
        let spheres = [0; 2].map(|_| {
            let ulps = |random: &mut Random| {
                f32::from_f64(f64::from(random.integer(-8..=8))) * 2_f32.powi(38)
            };
            let center = Vec3::new(ulps(&mut random), ulps(&mut random), 0.0);
            Sphere::new(center, ulps(&mut random).abs() + center.y.abs())
        });
        told_apart += check_hits(&ray, spheres);
    }
    assert!(told_apart > 20, "{told_apart}");
}
