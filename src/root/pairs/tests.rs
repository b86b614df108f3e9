use super::*;
use crate::arithmetic::pair::U;
use crate::arithmetic::scaling::scale;
use crate::root::tests::{ExactLine, difference, length, line, parts_of_tolerance, single};
use crate::testing::{Dyadic, ExactChord, Lie, Random, exactly, part_of_bound, search, setting};

const ANYWHERE: [Lie; 5] = [
    Lie { power: 0.999, discriminant: 0.0009 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: -1e-20, discriminant: 0.5 },
    Lie { power: -0.9, discriminant: 0.95 },
];

/// As little clear of doubt as may be.
const ALMOST_IN_DOUBT: [Lie; 5] = [
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: -1e-14, discriminant: 1.1e-14 },
    Lie { power: 0.9, discriminant: 1e-14 },
    Lie { power: 1e-14, discriminant: 0.5 },
    Lie { power: 1.0 - 1e-12, discriminant: 1e-13 },
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
    search(what, 60, 250, start, |numbers| part(&ExactChord::new(numbers), numbers))
}

fn of(bound: f64, size: &Dyadic) -> Dyadic {
    &Dyadic::exactly(bound) * size
}

/// What the chord says, after a look at whether hit or miss is right.
fn in_pairs<T>(
    exact: &ExactChord,
    numbers: [f64; 10],
    format: Format,
    then: impl FnOnce(InPairs<'_>) -> Option<T>,
) -> Option<T> {
    match chord(&line(numbers), format) {
        Verdict::Doubt => None,
        Verdict::Miss => {
            assert!(exact.discriminant.is_negative(), "the line hits: {numbers:?}");
            None
        }
        Verdict::Hit(chord) => {
            assert!(!exact.discriminant.is_negative(), "the line misses: {numbers:?}");
            then(chord)
        }
    }
}

#[test]
fn the_constants_are_those_of_the_analysis() {
    assert_eq!(
        [H_ERROR, MOMENT_ERROR, DISCRIMINANT_ERROR, ROOT_QUOTIENT_ERROR],
        [16.0, 12.0, 40.0, 20.0].map(|count| count * V)
    );
    assert_eq!(MOMENT_ERROR_SQUARED, 160.0 * V * V);
}

#[test]
fn chords_in_pairs_keep_their_bounds() {
    let dots = |exact: &ExactChord, numbers| {
        in_pairs(exact, numbers, Format::F64, |InPairs { a, h, .. }| {
            let reach = ExactLine::new(numbers).reach();
            let a = part_of_bound(&exactly(a), &exact.a, &of(COMPENSATED_DOT_ERROR, &exact.a));
            Some(part_of_bound(&exactly(h), &exact.h, &of(H_ERROR, &reach)).max(a))
        })
    };
    assert!(search_settings("dot products in pairs", &ANYWHERE, dots) > 0.1);

    let h = |exact: &ExactChord, numbers| {
        in_pairs(exact, numbers, Format::F64, |InPairs { h, .. }| {
            let reach = ExactLine::new(numbers).reach();
            Some(part_of_bound(&exactly(h), &exact.h, &of(H_ERROR, &reach)))
        })
    };
    assert!(search_settings("h in pairs", &ANYWHERE, h) > 0.05);

    let moments = |_: &ExactChord, numbers| {
        let scaled = Scaled::new(&line(numbers)).expect("numbers near 1 fit");
        let Triple { x, y, z } = moment(scaled.o, scaled.d);
        let exact = ExactLine::new(numbers);
        let error = length(&difference(&[x, y, z].map(exactly), &exact.moment()));
        Some(error.divided_by(&of(MOMENT_ERROR, &exact.reach()), 64).approximately())
    };
    assert!(search_settings("moment in pairs", &ANYWHERE, moments) > 0.03);
}

/// The bound of the discriminant, without what is to spare for its rounding.
fn discriminant_bound(exact: &ExactChord, numbers: [f64; 10]) -> Dyadic {
    let line = ExactLine::new(numbers);
    let (moment, reach) = (length(&line.moment()), line.reach());
    let size = &(&exact.radius_squared() * &exact.a) + &(&moment * &(&moment + &reach));
    &of(DISCRIMINANT_ERROR, &size) + &of(MOMENT_ERROR_SQUARED, &(&reach * &reach))
}

#[test]
fn discriminants_in_pairs_keep_their_bound() {
    // The square root of the discriminant, within the bound of that and its own rounding.
    let part = |exact: &ExactChord, numbers| {
        in_pairs(exact, numbers, Format::F64, |InPairs { half_chord, .. }| {
            let square = &exactly(half_chord) * &exactly(half_chord);
            let bound = &discriminant_bound(exact, numbers)
                + &of(2.0 * ROOT_ERROR + V, &exact.discriminant);
            Some(part_of_bound(&square, &exact.discriminant, &bound))
        })
    };
    let lies = [
        Lie { power: 0.9, discriminant: 1e-10 },
        Lie { power: 0.5, discriminant: 1e-10 },
        Lie { power: 0.99, discriminant: 1e-6 },
        Lie { power: 0.9999, discriminant: 1e-8 },
        Lie { power: -0.1, discriminant: 0.11 },
    ];
    assert!(search_settings("discriminant in pairs", &lies, part) > 0.03);
}

#[test]
fn half_chords_in_pairs_keep_their_bound() {
    let part = |exact: &ExactChord, numbers| {
        in_pairs(exact, numbers, Format::F64, |InPairs { half_chord, half_chord_error, .. }| {
            let expected = exact.discriminant.square_root(300);
            Some(part_of_bound(&exactly(half_chord), &expected, &Dyadic::exactly(half_chord_error)))
        })
    };
    assert!(search_settings("half the chord in pairs", &ALMOST_IN_DOUBT, part) > 0.03);
}

/// The larger part that one of the roots takes of its bound.
fn roots(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    in_pairs(exact, numbers, Format::F64, |chord| {
        let expected = exact.roots().expect("this hits");
        let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
            let Estimate { t, relative_error, .. } = chord.estimate(side)?;
            let bound = of(relative_error, &expected[index].clone().abs());
            Some(part_of_bound(&exactly(t), &expected[index], &bound))
        });
        parts.into_iter().flatten().reduce(f64::max)
    })
}

#[test]
fn roots_in_pairs_keep_their_bound() {
    assert!(search_settings("roots in pairs", &ALMOST_IN_DOUBT, roots) > 0.05);
    assert!(search_settings("roots in pairs, anywhere", &ANYWHERE, roots) > 0.03);
}

/// The part of the tolerance that the error of a point or of a normal takes.
fn points(exact: &ExactChord, numbers: [f64; 10], format: Format) -> Option<f64> {
    in_pairs(exact, numbers, format, |chord| {
        let expected = exact.roots().expect("this hits");
        let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
            let estimate = chord.estimate(side)?;
            let found = chord.hit(side, Root { t: estimate.t.hi, estimate })?;
            let tolerance = format.point_tolerance();
            let [point, normal] = parts_of_tolerance(numbers, &expected[index], &found, tolerance);
            Some(point.max(normal))
        });
        parts.into_iter().flatten().reduce(f64::max)
    })
}

#[test]
fn points_in_pairs_keep_their_tolerance() {
    // Radii down to what pairs are certain of.
    let mut lies = [10, 30, 42, 44, 46, 49, 50, 51].map(|places| {
        let radius_squared = 2_f64.powi(-places);
        Lie { power: 1.0 - radius_squared, discriminant: radius_squared / 8.0 }
    });
    lies[0] = Lie { power: 1e-12, discriminant: 0.5 };
    let part = |exact: &ExactChord, numbers| points(exact, numbers, Format::F64);
    assert!(search_settings("point from pairs", &lies, part) > 0.1);
    assert!(search_settings("point from pairs, almost in doubt", &ALMOST_IN_DOUBT, part) > 0.1);
    let part = |exact: &ExactChord, numbers| points(exact, numbers, Format::F32);
    assert!(search_settings("point from pairs in f32", &lies, part) > 0.1);
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
        let exact = ExactChord::new(numbers);
        match roots(&exact, numbers) {
            Some(part) => assert!(part <= 1.0, "{numbers:?}"),
            None if exact.discriminant.is_negative() => {}
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
        let exact = ExactChord::new(numbers);
        if let Some(part) = roots(&exact, numbers) {
            assert!(part <= 1.0, "{numbers:?}");
        }
        doubts += u32::from(matches!(chord(&line(numbers), Format::F64), Verdict::Doubt));
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
        let [here, there] = [numbers, scaled].map(line);
        let (Verdict::Hit(here), Verdict::Hit(there)) =
            (chord(&here, Format::F64), chord(&there, Format::F64))
        else {
            panic!("both hit: {numbers:?}");
        };
        let e = there.scaled.length_exponent - there.scaled.direction_exponent;
        for side in [Side::Near, Side::Far] {
            let [here, found] =
                [here.estimate(side), there.estimate(side)].map(|root| root.expect("clear").t);
            let expected = exactly(here).scaled(i64::from(lengths - directions));
            assert_eq!(exactly(found).scaled(e.into()), expected, "2^{lengths} 2^{directions}");
            // In the units of the caller, if that is exact.
            match there.scaled.unscaled_root(found) {
                Some(root) => assert_eq!(exactly(root), expected, "2^{lengths} 2^{directions}"),
                None => assert!(e != 0 && expected.magnitude().abs() > 890, "{expected:?}"),
            }
            if e != 0 && !(-900..=1024).contains(&expected.magnitude()) {
                assert_eq!(there.scaled.unscaled_root(found), None, "{expected:?}");
            }
        }
    }
}

#[test]
fn no_pair_is_no_chord() {
    let doubt = |numbers| matches!(chord(&line(numbers), Format::F64), Verdict::Doubt);
    // A difference that overflows, and all lengths zero.
    let far = f64::MAX;
    assert!(doubt([far, 0.0, 0.0, -far, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    assert!(doubt([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
    // A tangent.
    assert!(doubt([5.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0]));
    assert!(!doubt([5.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.5]));
}

#[test]
fn points_in_units_of_f32_too() {
    let mut random = Random::new(9);
    for _ in 0..300 {
        let lie = ANYWHERE[random.below(ANYWHERE.len())];
        let numbers = single(setting(&mut random, lie));
        let exact = ExactChord::new(numbers);
        if let Some(part) = points(&exact, numbers, Format::F32) {
            assert!(part <= 1.0, "{numbers:?}");
        }
    }
}

#[test]
fn dust_is_swept_to_a_zero_of_its_sign() {
    let dust = 2_f64.powi(-801);
    for hi in [dust, -dust] {
        let swept = without_dust(Pair { hi, lo: hi * U });
        assert_eq!([swept.hi, swept.lo].map(f64::to_bits), [hi * 0.0, 0.0].map(f64::to_bits));
        let kept = Pair { hi: 2.0 * hi, lo: hi * U };
        assert_eq!(without_dust(kept), kept);
    }
}
