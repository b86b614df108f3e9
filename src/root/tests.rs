use super::integers::*;
use super::pairs::*;
use super::*;
use crate::arithmetic::pair::V;
use crate::arithmetic::scaling::scale;
use crate::chord::Chord;
use crate::testing::{
    Dyadic, ExactChord, Lie, Random, exactly, nearest, part_of_bound, search, setting,
};

fn line(numbers: [f64; 10]) -> Line {
    let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = numbers;
    Line {
        center: DVec3::new(cx, cy, cz),
        origin: DVec3::new(px, py, pz),
        direction: DVec3::new(dx, dy, dz),
        radius,
    }
}

fn in_pairs(numbers: [f64; 10]) -> Scaled {
    Scaled::new(&Exact::new(&line(numbers))).expect("numbers near 1 fit")
}

/// What part of its bound an error takes, the bound being a part of `size`.
fn part(computed: Pair, exact: &Dyadic, bound: f64, size: &Dyadic) -> f64 {
    part_of_bound(&exactly(computed), exact, &(&Dyadic::exactly(bound) * size))
}

const ANYWHERE: [Lie; 5] = [
    Lie { power: 0.999, discriminant: -0.01 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: -1e-20, discriminant: 0.5 },
    Lie { power: -0.9, discriminant: 0.95 },
];

/// As little clear of doubt as may be.
const ALMOST_IN_DOUBT: [Lie; 4] = [
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: -1e-14, discriminant: 1.1e-14 },
    Lie { power: 0.9, discriminant: 1e-14 },
    Lie { power: 1e-14, discriminant: 0.5 },
];

fn search_settings(
    what: &str,
    lies: &[Lie],
    part: impl Fn(&ExactChord, [f64; 10]) -> Option<f64>,
) -> f64 {
    let start = |random: &mut Random| {
        let lie = lies[random.below(lies.len())];
        setting(random, lie)
    };
    search(what, 100, 400, start, |numbers| part(&ExactChord::new(numbers), numbers))
}

#[test]
fn the_constants_are_those_of_the_analysis() {
    assert_eq!(
        [DOT_ERROR, POWER_ERROR, MOMENT_SQUARED_ERROR, DISCRIMINANT_ERROR, ROOT_QUOTIENT_ERROR],
        [13.0, 21.0, 39.0, 65.0, 32.0].map(|count| count * V)
    );
}

#[test]
fn chords_in_pairs_keep_their_bounds() {
    let dots = |exact: &ExactChord, numbers| {
        let (Chord { a, h, distance_squared, .. }, radius_squared) = in_pairs(numbers).chord();
        assert_eq!(exactly(radius_squared), exact.radius_squared(), "r² is exactly a pair");
        let reach = (&exact.a * &exact.distance_squared).square_root(80);
        let parts = [
            part(a, &exact.a, DOT_ERROR, &exact.a),
            part(h, &exact.h, DOT_ERROR, &reach),
            part(distance_squared, &exact.distance_squared, DOT_ERROR, &exact.distance_squared),
        ];
        parts.into_iter().reduce(f64::max)
    };
    assert!(search_settings("dot products in pairs", &ANYWHERE, dots) > 0.125);

    let power = |exact: &ExactChord, numbers| {
        let (chord, _) = in_pairs(numbers).chord();
        Some(part(chord.power, &exact.power, POWER_ERROR, &exact.larger()))
    };
    assert!(search_settings("power in pairs", &ANYWHERE, power) > 0.125);

    let discriminant = |exact: &ExactChord, numbers| {
        let (chord, _) = in_pairs(numbers).chord();
        let size = &exact.a * &exact.larger();
        Some(part(chord.discriminant, &exact.discriminant, DISCRIMINANT_ERROR, &size))
    };
    assert!(search_settings("discriminant in pairs", &ANYWHERE, discriminant) > 0.0625);
}

/// The larger part that one of the roots takes of its bound, after a look at whether hit or miss is right.
fn roots(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    let estimate = match in_pairs(numbers).estimate() {
        InPairs::Doubt => return None,
        InPairs::Miss => {
            assert!(exact.discriminant.is_negative(), "the line hits: {numbers:?}");
            return Some(0.0);
        }
        InPairs::Hit(estimate) => estimate,
    };
    let exact_roots = exact.roots().expect("the line misses");
    let mut computed = estimate.roots;
    if computed[1].0.hi < computed[0].0.hi {
        computed.swap(0, 1);
    }
    let parts = [0, 1].map(|side: usize| {
        let (t, relative_error) = computed[side];
        part(t, &exact_roots[side], relative_error, &exact_roots[side].clone().abs())
    });
    Some(parts[0].max(parts[1]))
}

#[test]
fn roots_in_pairs_keep_their_bound() {
    let worst = search_settings("roots in pairs", &ALMOST_IN_DOUBT, roots);
    assert!(worst > 0.0625);
}

#[test]
fn half_chords_in_pairs_keep_their_bound() {
    let half_chord = |exact: &ExactChord, numbers| {
        let InPairs::Hit(Estimate { half_chord, sum_error, .. }) = in_pairs(numbers).estimate()
        else {
            return None;
        };
        let exact = exact.discriminant.square_root(300);
        Some(part(half_chord, &exact, sum_error, &Dyadic::new(1, 0)))
    };
    assert!(search_settings("half the chord in pairs", &ALMOST_IN_DOUBT, half_chord) > 0.04);
}

/// How far off the normals are, coordinate by coordinate, in units of their rounding, below 1, and the error that was let pass.
fn normals(exact: &ExactChord, numbers: [f64; 10], normals: [DVec3; 2], let_pass: f64) -> f64 {
    let bound = Dyadic::exactly(f64::EPSILON / 4.0 + let_pass);
    let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = numbers.map(Dyadic::exactly);
    let mut worst = 0.0_f64;
    for (t, normal) in exact.roots().expect("this hits").iter().zip(normals) {
        for ((c, p, d), found) in
            [(&cx, &px, &dx), (&cy, &py, &dy), (&cz, &pz, &dz)].into_iter().zip(normal.to_array())
        {
            let expected = (&(t * d) - &(c - p)).divided_by(&radius, 200);
            worst = worst.max(part_of_bound(&Dyadic::exactly(found), &expected, &bound));
        }
    }
    worst
}

#[test]
fn normals_keep_their_bound() {
    // Small and far away, up to where pairs are no longer good enough.
    let lies = [42, 44, 46, 49, 50, 51].map(|places| {
        let radius_squared = 2_f64.powi(-places);
        Lie { power: 1.0 - radius_squared, discriminant: radius_squared / 8.0 }
    });
    let in_pairs = |exact: &ExactChord, numbers: [f64; 10]| match in_pairs(numbers).crossings() {
        InPairs::Hit(Crossings::<f64> { normals: found, .. }) => {
            Some(normals(exact, numbers, found, f64::NORMAL_ERROR))
        }
        _ => None,
    };
    assert!(search_settings("normals from pairs", &lies, in_pairs) > 0.5);

    let exactly = |exact: &ExactChord, numbers: [f64; 10]| {
        let found = Exact::new(&line(numbers)).crossings::<f64>()?.normals;
        Some(normals(exact, numbers, found, f64::EPSILON * f64::EPSILON))
    };
    assert!(search_settings("exact normals", &lies[..1], exactly) > 0.5);
}

#[test]
fn what_pairs_are_certain_of_is_right() {
    let mut random = Random::new(1);
    let (mut doubts, count) = (0, 2000);
    for _ in 0..count {
        let [x, y] = [0; 2].map(|_| 2_f64.powi(random.integer(-106..=-30)));
        let lie = match random.below(3) {
            0 => Lie { power: x, discriminant: y },
            1 => Lie { power: -x, discriminant: x.max(y) },
            _ => Lie { power: 0.5, discriminant: -y },
        };
        let numbers = setting(&mut random, lie);
        match roots(&ExactChord::new(numbers), numbers) {
            Some(part) => assert!(part <= 1.0, "{numbers:?}"),
            None => doubts += 1,
        }
    }
    assert!(doubts < count / 2, "{doubts} of {count} in doubt");
}

#[test]
fn pairs_are_not_certain_of_tangents() {
    // Tangents with the direction (3, 4, 0) and the normal (-4, 3, 0), moved by what pairs can hardly see.
    let mut random = Random::new(5);
    let (mut doubts, count) = (0, 2000);
    for _ in 0..count {
        let long = (random.mantissa() * 2_f64.powi(49)).round();
        let radius = (random.mantissa() * 2_f64.powi(47)).round();
        let along = f64::from(random.integer(-1000..=1000)) * 2_f64.powi(37);
        let aside = random.float(-60..=-40);
        let center = [3.0 * along - 4.0 * radius, 4.0 * along + 3.0 * radius];
        let direction = [3.0 * long, 4.0 * long];
        let numbers = [
            center[0],
            center[1],
            0.0,
            0.0,
            aside,
            0.0,
            direction[0],
            direction[1],
            0.0,
            5.0 * radius,
        ];
        match roots(&ExactChord::new(numbers), numbers) {
            Some(part) => assert!(part <= 1.0, "{numbers:?}"),
            None => doubts += 1,
        }
    }
    assert!((count / 5..count * 4 / 5).contains(&doubts), "{doubts} of {count} in doubt");
}

#[test]
fn lines_of_any_size_are_brought_near_1() {
    let mut random = Random::new(2);
    for _ in 0..1000 {
        let numbers = setting(&mut random, ANYWHERE[2]);
        let (lengths, directions) = (random.integer(-900..=900), random.integer(-900..=900));
        let mut scaled = numbers;
        for (index, number) in scaled.iter_mut().enumerate() {
            *number = scale(*number, if (6..9).contains(&index) { directions } else { lengths });
        }
        let (InPairs::Hit(here), InPairs::Hit(there)) =
            (in_pairs(numbers).estimate(), in_pairs(scaled).estimate())
        else {
            panic!("both hit: {numbers:?}");
        };
        let there_exponent = in_pairs(scaled).root_exponent;
        for (here, there) in here.roots.into_iter().zip(there.roots) {
            let there = exactly(there.0).scaled(i64::from(there_exponent + directions - lengths));
            assert_eq!(exactly(here.0), there, "2^{lengths} and 2^{directions} of {numbers:?}");
        }
    }
}

#[test]
fn exact_roots_are_the_nearest() {
    let mut random = Random::new(3);
    for _ in 0..100 {
        let lie = Lie { power: 2_f64.powi(-random.integer(1..=50)), discriminant: 0.25 };
        let numbers = setting(&mut random, lie);
        let exact = Exact::new(&line(numbers));
        let expected = ExactChord::new(numbers).roots().expect("this hits");
        let found: Crossings<f64> = exact.crossings().expect("this hits");
        for ((side, found), expected) in
            [Side::Near, Side::Far].into_iter().zip(found.t).zip(&expected)
        {
            assert_eq!(found, nearest(expected, found));
            for m in [0.0, found, -found, 2.0 * found, found * 0.75] {
                assert_eq!(exact.compare_root(side, m), expected.cmp(&Dyadic::exactly(m)), "{m}");
            }
        }
    }
}

#[test]
fn roots_are_compared_exactly_with_numbers_on_and_beside_them() {
    // Roots 3 and 7 along x, and a tangent at 5.
    let compare = |radius: f64, height: f64, side, m| {
        let numbers = [5.0, height, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius];
        Exact::new(&line(numbers)).compare_root(side, m)
    };
    let tiny = 1e-300;
    for (side, root) in [(Side::Near, 3.0), (Side::Far, 7.0)] {
        assert_eq!(compare(2.0, 0.0, side, root), Ordering::Equal);
        for m in [-1.0, 2.9, 3.1, 5.0, 6.9, 7.1] {
            assert_eq!(compare(2.0, 0.0, side, m), root.partial_cmp(&m).unwrap(), "{root} and {m}");
        }
        // A little beside the axis, the chord is a little shorter.
        let inwards = if root < 5.0 { Ordering::Greater } else { Ordering::Less };
        assert_eq!(compare(2.0, tiny, side, root), inwards);
        assert_eq!(compare(2.0, 2.0, side, 5.0), Ordering::Equal);
        assert_eq!(compare(2.0, 2.0, side, 5.0 + f64::EPSILON * 4.0), Ordering::Less);
    }
}

#[test]
fn roots_that_only_exact_numbers_tell_apart_ascend() {
    // The closest approach is at the midpoint of two f64, and the radius next to nothing.
    for (x, y, z, approach, radius) in [
        (870_401.0, 53_969.0, 223_028.0, 1.964_105_606_079_101_6, 1e-28),
        (816_139.0, 85_539.0, 459_903.0, 1.934_988_975_524_902_3, 1e-30),
        (816_139.0, 85_539.0, 459_903.0, 1.934_988_975_524_902_3, 1e-100),
    ] {
        let direction = DVec3::new(x, y, z);
        let origin = direction * (-f64::EPSILON / 2.0);
        let line = Line { center: direction * approach, origin, direction, radius };
        let Crossings { t, .. } = crossings::<f64>(&line).expect("this goes through the center");
        assert!(t[0] <= t[1], "{direction} times {approach} has {t:?}");
    }
}

#[test]
fn roots_ascend() {
    let mut random = Random::new(6);
    for _ in 0..200 {
        let lie = ANYWHERE[1 + random.below(4)];
        let numbers = setting(&mut random, lie);
        let expected = ExactChord::new(numbers).roots().expect("this hits");
        let found = crossings::<f64>(&line(numbers)).expect("this hits").t;
        for (found, expected) in found.into_iter().zip(&expected) {
            let error = (&Dyadic::exactly(found) - expected).abs();
            assert!(error <= &Dyadic::exactly(f64::EPSILON) * &expected.clone().abs());
        }
    }
}

#[test]
fn a_root_next_to_the_midpoint_of_two_f32_is_no_tie() {
    for (beside, near, far) in [
        (0.0, 16_777_214.0, 16_777_216.0),
        (1e-30, 16_777_215.0, 16_777_215.0),
        (1e-9, 16_777_215.0, 16_777_215.0),
    ] {
        let line = Line {
            center: DVec3::new(beside, 0.0, 16_777_215.0),
            origin: DVec3::ZERO,
            direction: DVec3::Z,
            radius: 0.5,
        };
        assert_eq!(crossings::<f32>(&line).map(|crossings| crossings.t), Some([near, far]));
    }
}

#[test]
fn what_is_no_ray_or_no_sphere_is_not_hit() {
    let good = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    assert!(crossings::<f64>(&line(good)).is_some());
    for index in 0..10 {
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut numbers = good;
            numbers[index] = odd;
            assert!(crossings::<f64>(&line(numbers)).is_none(), "{numbers:?}");
        }
    }
    let mut numbers = good;
    numbers[9] = -2.0;
    assert!(crossings::<f64>(&line(numbers)).is_none());
    let mut numbers = good;
    numbers[6] = 0.0;
    assert!(crossings::<f64>(&line(numbers)).is_none());
}
