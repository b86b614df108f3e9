use core::cmp::Ordering;

use super::*;
use crate::arithmetic::scaling::scale;
use crate::root::format::Midpoint;
use crate::root::narrow::compare_root;
use crate::root::scaled_line::Scaled;
use crate::root::tests::{assert_exact, line, single};
use crate::testing::{Dyadic, ExactChord, Float, Lie, Random, exactly, part_of_bound, setting};

fn numbers_of(Line { origin, direction, center, radius }: &Line) -> [f64; 10] {
    let [[cx, cy, cz], [px, py, pz], [dx, dy, dz]] =
        [center, origin, direction].map(|vector| vector.to_array());
    [cx, cy, cz, px, py, pz, dx, dy, dz, *radius]
}

/// Lines of every kind: integers, floats of a few exponents, of many, and exact tangents.
fn random_numbers(random: &mut Random) -> [f64; 10] {
    let mut numbers = match random.below(8) {
        0 => [0.0; 10].map(|_: f64| f64::from(random.integer(-20..=20))),
        1 => {
            let lie = Lie { power: 2_f64.powi(-random.integer(1..=50)), discriminant: 0.25 };
            single(setting(random, lie))
        }
        2 => {
            let lie = Lie { power: 2_f64.powi(-random.integer(1..=50)), discriminant: 0.25 };
            setting(random, lie)
        }
        3 => [0.0; 10].map(|_: f64| random.float(-300..=300)),
        // All of 53 bits at both ends of 61 places.
        4 => [0.0; 10].map(|_: f64| random.float(-8..=0)),
        // Half the chord is 4 where the line is 3 off a center of radius 5, or 0: roots of a few bits, and of 54.
        5 | 6 => {
            let size = f64::from(random.integer(1..=1000));
            let aside = [3.0, 5.0][random.below(2)] * size;
            let shift = 2_f64.powi(random.integer(0..=49));
            [shift, aside, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 5.0 * size]
        }
        _ => {
            // A tangent with the direction (3, 4, 0) and the normal (-4, 3, 0).
            let long = f64::from(random.integer(1..=1000));
            let radius = f64::from(random.integer(1..=1000));
            let along = f64::from(random.integer(-1000..=1000));
            let center = [3.0 * along - 4.0 * radius, 4.0 * along + 3.0 * radius];
            [center[0], center[1], 7.0, 0.0, 0.0, 7.0, 3.0 * long, 4.0 * long, 0.0, 5.0 * radius]
        }
    };
    numbers[9] = numbers[9].abs();
    if numbers[6..9].iter().all(|d| *d == 0.0) {
        numbers[7] = 1.0;
    }
    // In any units, brought near 1.
    let (lengths, directions) = (random.integer(-300..=300), random.integer(-300..=300));
    for (index, number) in numbers.iter_mut().enumerate() {
        *number = scale(*number, if (6..9).contains(&index) { directions } else { lengths });
    }
    Scaled::new(&line(numbers)).map_or(numbers, |scaled| numbers_of(&scaled.line))
}

#[test]
fn chords_in_integers_are_exact_to_96_bits() {
    let mut random = Random::new(1);
    let (mut narrow, count) = (0, 4000);
    for _ in 0..count {
        let numbers = random_numbers(&mut random);
        let exact = ExactChord::new(numbers);
        let Some(found) = Narrow::new(&line(numbers)) else { continue };
        narrow += 1;
        for (found, expected) in [
            (found.a(), &exact.a),
            (found.h(), &exact.h),
            (found.power(), &exact.power),
            (found.discriminant(), &exact.discriminant),
        ] {
            assert_eq!((found.hi == 0.0), expected.is_zero(), "{numbers:?}");
            assert_eq!((found.hi < 0.0), expected.is_negative(), "{numbers:?}");
            let bound = expected.clone().abs().scaled(-96);
            assert!(part_of_bound(&exactly(found), expected, &bound) <= 1.0, "{numbers:?}");
        }
    }
    assert!((count / 4..count).contains(&narrow), "{narrow} of {count} are narrow");
}

/// How the root on that side compares with a number.
fn compared(exact: &ExactChord, side: Side, number: &Dyadic) -> Ordering {
    let slope = &(&exact.a * number) - &(&exact.h + &exact.h);
    let quadratic = &(&slope * number) + &exact.power;
    let ahead = exact.h.cmp(&(&exact.a * number));
    if quadratic.is_zero() {
        // At one of the roots: at which, the closest approach tells, and at both where it is there.
        return match (side, ahead) {
            (Side::Near, Ordering::Less) => Ordering::Less,
            (Side::Far, Ordering::Greater) => Ordering::Greater,
            _ => Ordering::Equal,
        };
    }
    let [near, far] = exact.roots().expect("a chord");
    // To 300 bits and more, roots differ from what they are compared with.
    if side == Side::Near { near.cmp(number) } else { far.cmp(number) }
}

#[test]
fn roots_are_compared_exactly_with_midpoints_at_and_beside_them() {
    let mut random = Random::new(2);
    let (mut equal, mut narrow) = (0, 0);
    for _ in 0..3000 {
        let numbers = random_numbers(&mut random);
        let exact = ExactChord::new(numbers);
        let Some(roots) = exact.roots() else { continue };
        let line = line(numbers);
        for (side, root) in [Side::Near, Side::Far].into_iter().zip(&roots) {
            let mut midpoints = vec![Midpoint { integer: 1, exponent: random.integer(-30..=30) }];
            if !root.is_zero() {
                // The root to 54 bits, and its neighbors; or to a few bits.
                let (leading, exponent) = root.leading(54);
                let leading = i64::try_from(leading).unwrap();
                let sign = if root.is_negative() { -1 } else { 1 };
                for beside in [-1, 0, 1] {
                    let integer = sign * (leading + beside);
                    midpoints.push(Midpoint { integer, exponent: exponent.try_into().unwrap() });
                }
                let (few, exponent) = root.leading(20);
                let integer = i64::try_from(few).unwrap();
                midpoints.push(Midpoint { integer, exponent: exponent.try_into().unwrap() });
                let integer = -integer;
                midpoints.push(Midpoint { integer, exponent: exponent.try_into().unwrap() });
            }
            for midpoint in midpoints {
                let number = Dyadic::new(midpoint.integer, midpoint.exponent.into());
                let expected = compared(&exact, side, &number);
                let Some(found) = compare_root(&line, side, midpoint) else { continue };
                assert_eq!(found, expected, "{side:?} {midpoint:?} {numbers:?}");
                equal += u32::from(expected.is_eq());
                narrow += 1;
            }
        }
    }
    assert!(equal > 100, "{equal} are equal");
    assert!(narrow > 1000, "{narrow} are narrow");
}

#[test]
fn narrow_numbers_answer_wherever_they_have_room() {
    // Where they have none, they say so.
    let mut random = Random::new(3);
    let (mut answers, mut aheads, mut none) = (0, 0, 0);
    for _ in 0..3000 {
        let numbers = random_numbers(&mut random);
        let line = line(numbers);
        let Some(narrow) = Narrow::new(&line) else { continue };
        let exact = ExactChord::new(numbers);
        let digits = random.below(54);
        let integer = i64::try_from(random.bits() >> 10 >> digits).unwrap();
        let unit = exact.h.divided_by(&exact.a, 60);
        let magnitude = if unit.is_zero() { 0 } else { unit.magnitude() };
        let exponent = i32::try_from(magnitude).unwrap() + random.integer(-130..=70);
        let midpoint =
            Midpoint { integer: if digits % 2 == 0 { integer } else { -integer }, exponent };
        let m = Dyadic::new(midpoint.integer, midpoint.exponent.into());
        let am = &exact.a * &m;
        if let Some(quadratic) = narrow.quadratic_at(midpoint) {
            let slope = &am - &(&exact.h + &exact.h);
            let expected = (&(&slope * &m) + &exact.power).sign();
            assert_eq!(quadratic, expected, "{midpoint:?} {numbers:?}");
            answers += 1;
        } else {
            none += 1;
        }
        if let Some(ahead) = narrow.ahead_of(midpoint) {
            assert_eq!(ahead, exact.h.cmp(&am), "{midpoint:?} {numbers:?}");
            aheads += 1;
        }
    }
    assert!(answers > 300 && none > 300, "{answers} answers, {none} times none");
    assert_eq!(aheads, answers);
}

#[test]
fn what_spans_61_places_is_narrow() {
    let numbers = |center: f64, origin: f64, radius: f64, x: f64, y: f64| {
        [center, 0.0, 0.0, origin, 0.0, 0.0, x, y, 0.0, radius]
    };
    let is_narrow = |numbers| Narrow::new(&line(numbers)).is_some();
    let two = |places: i32| 2_f64.powi(places);
    // 2^60 has 61 places, of which 2^0 is the last.
    assert!(is_narrow(numbers(two(60), 1.0, 1.0, 1.0, 0.0)));
    assert!(!is_narrow(numbers(two(61), 1.0, 1.0, 1.0, 0.0)));
    assert!(is_narrow(numbers(1.0, 1.0, 1.0, two(60), 1.0)));
    assert!(!is_narrow(numbers(1.0, 1.0, 1.0, two(61), 1.0)));
    assert!(is_narrow(numbers(0.0, two(0), two(60), two(-500), two(-440))));
    assert!(!is_narrow(numbers(0.0, two(-1), two(60), 1.0, 0.0)));
    assert!(is_narrow(numbers(0.0, 0.0, 0.0, f64::from_bits(1), 0.0)));
    // Zeros have no place.
    let all_zero = Narrow::new(&line([0.0; 10])).expect("zeros are narrow");
    assert!(all_zero.a().hi == 0.0 && all_zero.power().hi == 0.0);
    // The largest of 61 bits keep their values, and the widest differences.
    let most = two(60) * (2.0 - 2.0 * f64::EPSILON);
    let numbers = [most, -most, most, -most, most, -most, most, -most, 256.0, most];
    let exact = ExactChord::new(numbers);
    let narrow = Narrow::new(&line(numbers)).expect("61 places");
    for (found, expected) in [
        (narrow.a(), &exact.a),
        (narrow.h(), &exact.h),
        (narrow.power(), &exact.power),
        (narrow.discriminant(), &exact.discriminant),
    ] {
        let bound = expected.clone().abs().scaled(-96);
        assert!(part_of_bound(&exactly(found), expected, &bound) <= 1.0);
    }
}

#[test]
fn roots_are_compared_exactly_with_numbers_on_and_beside_them() {
    // Roots 3 and 7 along x, and a tangent at 5.
    let compare = |radius: f64, height: f64, side, m: f64| {
        let numbers = [5.0, height, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius];
        let (integer, exponent) = crate::arithmetic::scaling::integer_and_exponent(m);
        let integer = i64::try_from(integer).unwrap();
        let integer = if m < 0.0 { -integer } else { integer };
        compare_root(&line(numbers), side, Midpoint { integer, exponent })
    };
    let tiny = 2_f64.powi(-52);
    for (side, root) in [(Side::Near, 3.0), (Side::Far, 7.0)] {
        assert_eq!(compare(2.0, 0.0, side, root), Some(Ordering::Equal));
        for m in [-1.0, 2.9, 3.1, 5.0, 6.9, 7.1] {
            assert_eq!(compare(2.0, 0.0, side, m), root.partial_cmp(&m), "{root} and {m}");
        }
        // A little beside the axis, the chord is a little shorter.
        let inwards = if root < 5.0 { Ordering::Greater } else { Ordering::Less };
        assert_eq!(compare(2.0, tiny, side, root), Some(inwards));
        assert_eq!(compare(2.0, 2.0, side, 5.0), Some(Ordering::Equal));
        assert_eq!(compare(2.0, 2.0, side, 5.0 + f64::EPSILON * 4.0), Some(Ordering::Less));
    }
    assert_eq!(compare(2.0, 0.0, Side::Near, 7.0), Some(Ordering::Less));
    assert_eq!(compare(2.0, 0.0, Side::Far, 3.0), Some(Ordering::Greater));
    // No room for either.
    assert_eq!(compare(2.0, 1e-300, Side::Far, 3.0), None);
    assert_eq!(compare(2.0, 0.0, Side::Far, 1e-300), None);
}

#[test]
fn roots_in_integers_are_the_nearest() {
    let mut random = Random::new(4);
    let (mut roots, mut hits) = (0, 0);
    for _ in 0..1600 {
        let numbers = random_numbers(&mut random);
        let exact = ExactChord::new(numbers);
        let line = line(numbers);
        let mut found = match chord(&line, Format::F64) {
            Verdict::Hit(found) => found,
            Verdict::Miss => {
                assert!(exact.discriminant.is_negative(), "{numbers:?}");
                continue;
            }
            Verdict::Doubt => continue,
        };
        let exact_roots = exact.roots().expect("this hits");
        for (side, expected) in [Side::Near, Side::Far].into_iter().zip(&exact_roots) {
            let estimate = exactly(found.estimate(side));
            if exact.discriminant.is_zero() || !expected.is_zero() {
                let bound = &Dyadic::exactly(ROOT_ERROR) * &expected.clone().abs();
                let part = part_of_bound(&estimate, expected, &bound);
                assert!(part <= 1.0, "{part} {numbers:?}");
            }
            let Some((t, root)) = found.root(side) else { continue };
            roots += 1;
            assert_eq!(t, f64::nearest(expected), "{side:?} {numbers:?}");
            if numbers[9] == 0.0 {
                continue;
            }
            if let Some(hit) = found.hit(side, t, root) {
                assert_exact(Format::F64, numbers, side, &hit);
                hits += 1;
            }
        }
    }
    assert!(roots > 1000 && hits > 800, "{roots} roots, {hits} hits");
}

#[test]
fn roots_in_integers_are_the_nearest_f32_too() {
    let mut count = 0;
    let mut check = |numbers: [f64; 10]| {
        let Some(roots) = ExactChord::new(numbers).roots() else { return };
        let line = line(numbers);
        let mut found = match chord(&line, Format::F32) {
            Verdict::Hit(found) => found,
            Verdict::Miss => panic!("this hits: {numbers:?}"),
            Verdict::Doubt => return,
        };
        for (side, expected) in [Side::Near, Side::Far].into_iter().zip(&roots) {
            let Some((root, _)) = found.root(side) else { continue };
            let nearest = f32::nearest(expected);
            assert_eq!(root, f64::from(nearest), "{side:?} {numbers:?}");
            count += 1;
        }
    };
    // Midpoints of two f32, and what no f64 tells from them.
    for beside in [0.0, 1e-10, 1e-30] {
        for radius in [0.5, 1.5, 2.5] {
            for center in [16_777_215.0, 16_777_218.0, 33_554_431.0] {
                check([beside, 0.0, center, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, radius]);
            }
        }
    }
    let mut random = Random::new(5);
    for _ in 0..1000 {
        check(random_numbers(&mut random));
    }
    assert!(count > 500, "{count} roots");
}
