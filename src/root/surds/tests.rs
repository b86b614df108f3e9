use super::*;
use crate::root::tests::{assert_exact, careful_steps, exact_root, exact_surd, line};
use crate::testing::{Dyadic, ExactChord, Random};

use crate::testing::families::{FAMILIES, Rng};

const ALL: Question = Question::Nearest(0.0..f64::INFINITY);
const SIDES: [Side; 2] = [Side::Near, Side::Far];

fn ask(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    answer(line, format, question)
}

fn bits(answer: Option<Answer>) -> Option<Vec<u64>> {
    let numbers = match answer? {
        Answer::Nearest(Found { t, point, normal }) => {
            [&[t], &point.to_array()[..], &normal.to_array()].concat()
        }
        Answer::Roots(roots) => roots.to_vec(),
    };
    Some(numbers.into_iter().map(f64::to_bits).collect())
}

/// The coordinates of center, origin and direction, and the radius.
fn numbers(line: &Line) -> [f64; 10] {
    let [cx, cy, cz] = line.center.to_array();
    let [px, py, pz] = line.origin.to_array();
    let [dx, dy, dz] = line.direction.to_array();
    [cx, cy, cz, px, py, pz, dx, dy, dz, line.radius]
}

/// Cases of every family in both precisions.
fn cases(seed: u64, count: u32, mut check: impl FnMut(&str, &Line, Format)) {
    for family in FAMILIES {
        let mut rng = Rng::new(seed);
        for _ in 0..count {
            let (ray, sphere) = (family.f32)(&mut rng);
            check(family.name, &Line::new(&sphere, &ray), Format::F32);
            let (ray, sphere) = (family.f64)(&mut rng);
            check(family.name, &Line::new(&sphere, &ray), Format::F64);
        }
    }
}

/// That of both roots and of the hits there, each is exact.
fn check(line: &Line, format: Format) -> bool {
    let numbers = numbers(line);
    let roots = ask(line, format, &Question::Both);
    if !line.is_valid() || ExactChord::new(numbers).discriminant.is_negative() {
        assert!(roots.is_none(), "{line:?}");
        assert!(ask(line, format, &ALL).is_none(), "{line:?}");
        return false;
    }
    let roots = roots.and_then(Answer::roots).expect("this hits");
    for (index, side) in SIDES.into_iter().enumerate() {
        let t = roots[index];
        assert_eq!(t, exact_root(format, numbers, side), "{format:?} {side:?} {line:?}");
        if t > 0.0 && t < f64::INFINITY {
            let only_this = Question::Nearest(t..f64::from_bits(t.to_bits() + 1));
            let found = ask(line, format, &only_this).and_then(Answer::nearest);
            let found = found.expect("this is in the range");
            // Both roots may be rounded to the same number: then it is the near one.
            let side = if roots[0] == roots[1] { Side::Near } else { side };
            assert_exact(format, numbers, side, &found);
        }
    }
    true
}

#[test]
fn answers_are_the_exact_ones_rounded() {
    let mut hits = 0;
    cases(11, 25, |_, line, format| hits += u32::from(check(line, format)));
    assert!(hits > 1000, "{hits} hits");
}

/// The smallest and the largest numbers, and some between: with these, every number is as wide as it gets.
fn line_of_ends(random: &mut Random, format: Format) -> Line {
    let ends = match format {
        Format::F32 => [f32::from_bits(1).into(), f32::MAX.into(), f32::MIN_POSITIVE.into()],
        Format::F64 => [f64::from_bits(1), f64::MAX, f64::MIN_POSITIVE],
    };
    let numbers = [0; 10].map(|_| {
        let size = [0.0, 1.0, ends[0], ends[0], ends[1], ends[1], ends[2]][random.below(7)];
        if random.below(2) == 0 { size } else { -size }
    });
    let mut line = line(numbers);
    line.radius = line.radius.abs();
    line
}

#[test]
fn answers_at_the_ends_of_the_range_are_the_exact_ones_rounded() {
    let mut random = Random::new(3);
    let mut hits = 0;
    for round in 0..1500 {
        let format = if round % 2 == 0 { Format::F32 } else { Format::F64 };
        hits += u32::from(check(&line_of_ends(&mut random, format), format));
    }
    assert!(hits > 200, "{hits} hits");
}

#[test]
fn answers_in_few_digits_are_the_exact_ones_rounded() {
    // Lengths of 600 places and directions of 100, in any units, at the ends of these and next to the surface.
    let mut random = Random::new(5);
    let mut hits = 0;
    for _ in 0..1500 {
        let [lengths, directions] = [random.integer(-1074..=423), random.integer(-1074..=923)];
        let mut numbers =
            [0; 10].map(|_| [0.0, 1.0, 1.0, 2.0, 3.0][random.below(5)] * random.sign());
        for (index, number) in numbers.iter_mut().enumerate() {
            let (unit, span) =
                if (6..9).contains(&index) { (directions, 98) } else { (lengths, 598) };
            let place = [0, span, span, span, random.integer(0..=span)][random.below(5)];
            *number = scale(*number, unit + place);
        }
        let mut line = line(numbers);
        line.radius = line.radius.abs();
        let places = Unit::of_line(&line).map(|units| units.map(|unit| unit.places));
        assert!(digits_of(places.expect("finite numbers")) <= FEW_DIGITS, "{line:?}");
        hits += u32::from(check(&line, Format::F64));
    }
    assert!(hits > 200, "{hits} hits");
}

#[test]
fn memory_that_is_too_small_gives_no_answer() {
    // A sixth less is not enough for all, and where it is, the answer is the same.
    let mut random = Random::new(4);
    let (mut counts, mut panics) = ([0; 2], [0; 2]);
    for round in 0..3000 {
        let (format, index) = if round % 2 == 0 { (Format::F32, 0) } else { (Format::F64, 1) };
        let line = line_of_ends(&mut random, format);
        if !line.is_valid() {
            continue;
        }
        let units = Unit::of_line(&line).expect("finite numbers");
        let in_less = || match format {
            Format::F32 => answer_within::<{ F32_DIGITS / 6 * 5 }>(&line, units, format, &ALL),
            Format::F64 => answer_within::<{ F64_DIGITS / 6 * 5 }>(&line, units, format, &ALL),
        };
        match std::panic::catch_unwind(in_less) {
            Ok(found) => {
                assert_eq!(bits(found), bits(ask(&line, format, &ALL)), "{line:?}");
                counts[index] += 1;
            }
            Err(_) => panics[index] += 1,
        }
    }
    assert!(counts.iter().chain(&panics).all(|count| *count > 5), "{counts:?} {panics:?}");
}

#[test]
fn every_careful_step_answers_as_this_one() {
    let mut counts = [0; 2];
    cases(7, 300, |name, line, format| {
        for question in [ALL, Question::Both] {
            let expected = bits(ask(line, format, &question));
            for (count, verdict) in counts.iter_mut().zip(careful_steps(line, format, &question)) {
                let found = match verdict {
                    Verdict::Miss => None,
                    Verdict::Hit(answer) => Some(answer),
                    Verdict::Doubt => continue,
                };
                assert_eq!(bits(found), expected, "{name} {format:?} {question:?} {line:?}");
                *count += 1;
            }
        }
    });
    assert!(counts.iter().all(|count| *count > 20_000), "{counts:?}");
}

#[test]
fn what_is_no_ray_or_no_sphere_is_not_hit() {
    let good = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    assert!(check(&line(good), Format::F32));
    for index in 0..10 {
        for odd in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut numbers = good;
            numbers[index] = odd;
            for question in [ALL, Question::Both] {
                assert!(ask(&line(numbers), Format::F64, &question).is_none(), "{numbers:?}");
            }
        }
    }
    for (index, number) in [(9, -2.0), (6, 0.0), (6, -0.0)] {
        let mut numbers = good;
        numbers[index] = number;
        assert!(ask(&line(numbers), Format::F64, &Question::Both).is_none(), "{numbers:?}");
    }
    // Nothing but zeros, where a radius of zero is hit.
    let mut numbers = [0.0; 10];
    numbers[7] = 1.0;
    let roots = ask(&line(numbers), Format::F64, &Question::Both).and_then(Answer::roots);
    assert_eq!(roots, Some([0.0; 2]));
}

#[test]
fn quotients_are_uncertain_next_to_midpoints() {
    // 2^-47 of the integer to either side.
    let half = 1 << 51;
    for (integer, below, whole, is_above_half) in [
        (12, 2, 3, Some(false)),
        (13, 2, 3, Some(false)),
        (14, 2, 3, None),
        (15, 2, 3, Some(true)),
        (3, 0, 3, None),
        (3, -2, 12, None),
        (3 * half, 52, 1, None),
        (3 * half + 48, 52, 1, None),
        (3 * half - 47, 52, 1, None),
        (3 * half + 49, 52, 1, Some(true)),
        (3 * half - 48, 52, 1, Some(false)),
        (u64::MAX >> 11, 53, 0, Some(true)),
        (u64::MAX >> 11, 54, 0, None),
        (u64::MAX >> 11, 62, 0, Some(false)),
        (u64::MAX >> 11, 63, 0, Some(false)),
        (u64::MAX >> 11, i32::MAX, 0, Some(false)),
    ] {
        assert_eq!(divided(integer, below), (whole, is_above_half), "{integer} over 2^{below}");
    }
}

#[test]
fn roots_at_the_midpoint_of_neighbors_and_beside_it_are_rounded() {
    // Roots 1.5 - r and 1.5 + r along an axis, a little beside which the chord is a little shorter.
    for (format, radius) in [(Format::F32, f32::EPSILON / 2.0), (Format::F32, f32::EPSILON * 1.5)]
        .map(|(format, radius)| (format, f64::from(radius)))
        .into_iter()
        .chain([(Format::F64, f64::EPSILON / 2.0), (Format::F64, f64::EPSILON * 1.5)])
    {
        for beside in [0.0, 0.5, 1e-5, 1e-10, 1e-25].map(|part| part * radius) {
            for center in [1.5, 1.0, 2.0, 1.5 + 2.0 * radius] {
                let numbers = [center, beside, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius];
                assert!(check(&line(numbers), format), "{numbers:?}");
            }
        }
    }
}

#[test]
fn numbers_next_to_powers_of_two_and_to_midpoints_are_rounded() {
    let mut random = Random::new(9);
    let mut integers = [[0; F32_DIGITS]; 6];
    for round in 0..20_000 {
        let format = if round % 2 == 0 { Format::F32 } else { Format::F64 };
        let sign = if random.below(2) == 0 { 1 } else { -1 };
        // A number of a few eighths of the last place beside a power of two, or beside a midpoint, ...
        let most = 1 << random.below(10);
        let spread = i64::try_from(random.below(most)).unwrap();
        let midpoint = (i64::try_from(random.bits() >> 11).unwrap() | 1) * 4;
        let beside = [1 << (format.digits() + 3), midpoint][random.below(2)];
        let eighths = beside + if random.below(2) == 0 { spread } else { -spread };
        // ... and a little more, over a denominator: of nothing, or as a sum in which three fourths or less cancel.
        let denominator = i64::try_from(random.below(8)).unwrap() | 1;
        let coefficient = i64::try_from(random.bits() >> 32 | 1 << 31).unwrap();
        let times = i64::try_from(random.below(4)).unwrap();
        let square = (eighths * denominator * times / coefficient).unsigned_abs().pow(2);
        let coefficient =
            if random.below(4) == 0 { coefficient * sign } else { -coefficient * sign };
        let product = u128::from(coefficient.unsigned_abs()).pow(2) * u128::from(square);
        let root = i64::try_from(product.isqrt()).unwrap();
        let root = if coefficient < 0 { -root } else { root };
        let square = i64::try_from(square).unwrap();
        let unit = random.integer(-1200..=1000);

        let [a, c, d, x, y, z] = &mut integers;
        let [mut a, mut c, mut d, x, y, z] = [a, c, d, x, y, z].map(|digits| Integer::new(digits));
        let mut scratch = Scratch { rational: x, square: y, norm: z };
        let factor = |integer: i64| Shifted { integer, places: 0 };
        c.add_number(factor(denominator));
        a.add_times(&c, factor(sign * eighths));
        a.add_number(factor(-root));
        d.add_number(factor(square));
        let surd = Surd {
            rational: &a,
            coefficient: factor(coefficient),
            discriminant: &d,
            denominator: &c,
            unit,
        };
        let product = &Dyadic::new(denominator, 0) * &Dyadic::new(sign * eighths, 0);
        let exact = [
            &(&product - &Dyadic::new(root, 0)),
            &Dyadic::new(coefficient, 0),
            &Dyadic::new(square, 0),
            &Dyadic::new(denominator, (-unit).into()),
        ];
        let found = surd.round(format, &mut scratch);
        assert_eq!(found, exact_surd(format, exact), "{format:?} {exact:?}");
    }
}

#[test]
fn a_root_below_the_range_of_pairs_is_not_taken_for_exact() {
    // In units of the radius, t d is 1e-312.
    let numbers = [
        0.0,
        2.594_842_503_366_670_5e-77,
        1.799_725_258_584_542_4e79,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        1.446_127_524_354_203_4e30,
        1.799_725_258_584_542_4e79,
    ];
    let line = line(numbers);
    assert!(check(&line, Format::F64));
    let [_, found] = careful_steps(&line, Format::F64, &ALL);
    if let Verdict::Hit(found) = found {
        assert_eq!(bits(Some(found)), bits(ask(&line, Format::F64, &ALL)));
    }
}

/// Lengths of 922 places and directions of one make the longest integers that the few digits are for, where a digit has 64
/// places; and here two factors have a digit more than their product.
#[test]
fn factors_with_a_digit_more_than_their_product_have_room() {
    let [small, distance, along] = [-1074, -153, -1009].map(|places| scale(1.0, places));
    let line = Line {
        center: DVec3::new(0.0, small, -distance),
        origin: DVec3::ZERO,
        direction: DVec3::new(-along, 0.0, -along),
        radius: distance,
    };
    let places = Unit::of_line(&line).expect("finite numbers").map(|unit| unit.places);
    assert_eq!(places, [922, 1]);
    assert_eq!(digits_of(places) == FEW_DIGITS, PLACES == 64);
    assert!(check(&line, Format::F64));
}
