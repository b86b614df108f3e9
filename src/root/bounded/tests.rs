use super::*;
use crate::root::tests::{ExactLine, difference, length, line, parts_of_tolerance, single};
use crate::testing::{Dyadic, ExactChord, Lie, Random, part_of_bound, search, setting};

/// Near the limb from afar, and origins near the surface: as little clear of doubt as may be.
const ALMOST_IN_DOUBT: [Lie; 6] = [
    Lie { power: 0.5, discriminant: 1e-14 },
    Lie { power: 0.9999, discriminant: 1e-10 },
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: 1e-28, discriminant: 0.5 },
    Lie { power: -1e-28, discriminant: 0.5 },
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
    search(what, 60, 200, start, |numbers| part(&ExactChord::new(numbers), numbers))
}

fn of(bound: f64, size: &Dyadic) -> Dyadic {
    &Dyadic::exactly(bound) * size
}

/// The chord, after a look at whether hit or miss is right.
fn bounded(exact: &ExactChord, numbers: [f64; 10]) -> Option<Bounded> {
    match chord(line(numbers)) {
        Verdict::Doubt => None,
        Verdict::Miss => {
            assert!(exact.discriminant.is_negative(), "the line hits: {numbers:?}");
            None
        }
        Verdict::Hit(bounded) => {
            assert!(!exact.discriminant.is_negative(), "the line misses: {numbers:?}");
            Some(bounded)
        }
    }
}

/// The bound of the discriminant, without what is to spare for its rounding.
fn discriminant_bound(exact: &ExactChord, line: &ExactLine) -> Dyadic {
    let (moment, reach) = (length(&line.moment()), line.reach());
    let size = &(&exact.radius_squared() * &exact.a) + &(&moment * &(&moment + &reach));
    &of(DISCRIMINANT_ERROR, &size) + &of(MOMENT_ERROR_SQUARED, &(&reach * &reach))
}

#[test]
fn the_closest_approach_keeps_its_bound() {
    let h = |exact: &ExactChord, numbers| {
        let found = bounded(exact, numbers)?;
        let bound = of(H_ERROR, &ExactLine::new(numbers).reach());
        Some(part_of_bound(&Dyadic::exactly(found.chord.h), &exact.h, &bound))
    };
    assert!(search_settings("h of the closest approach", &ALMOST_IN_DOUBT, h) > 0.1);

    let moment = |exact: &ExactChord, numbers| {
        let found = bounded(exact, numbers)?;
        let exact = ExactLine::new(numbers);
        let computed = found.moment.to_array().map(Dyadic::exactly);
        let error = length(&difference(&computed, &exact.moment()));
        let bound = of(MOMENT_ERROR, &exact.reach());
        Some(error.divided_by(&bound, 64).approximately())
    };
    assert!(search_settings("moment", &ALMOST_IN_DOUBT, moment) > 0.1);

    let discriminant = |exact: &ExactChord, numbers| {
        let found = bounded(exact, numbers)?;
        let bound = discriminant_bound(exact, &ExactLine::new(numbers));
        let computed = Dyadic::exactly(found.chord.discriminant);
        Some(part_of_bound(&computed, &exact.discriminant, &bound))
    };
    let lies = [ALMOST_IN_DOUBT[0], ALMOST_IN_DOUBT[1], ALMOST_IN_DOUBT[5]];
    assert!(search_settings("discriminant of the case", &lies, discriminant) > 0.1);
    // The center so far away that P² alone counts.
    let lies = [1e-26, 1e-28, 1e-30, 3e-32].map(|radius_squared: f64| (radius_squared, 0.1));
    let start = |random: &mut Random| {
        let mut numbers = setting(random, Lie { power: 0.5, discriminant: 0.5 });
        let (radius_squared, _) = lies[random.below(lies.len())];
        let away = ((numbers[0] - numbers[3]).powi(2)
            + (numbers[1] - numbers[4]).powi(2)
            + (numbers[2] - numbers[5]).powi(2))
        .sqrt();
        numbers[9] = radius_squared.sqrt() * away;
        // Straight at the center, but for rounding.
        for axis in 0..3 {
            numbers[6 + axis] = numbers[axis] - numbers[3 + axis];
        }
        numbers
    };
    let part = |numbers| {
        let exact = ExactChord::new(numbers);
        discriminant(&exact, numbers)
    };
    search("discriminant from afar", 60, 200, start, part);
}

#[test]
fn half_chords_keep_their_bound() {
    let part = |exact: &ExactChord, numbers| {
        let Bounded { half_chord, half_chord_error, .. } = bounded(exact, numbers)?;
        // The root itself is rounded too.
        let bound = Dyadic::exactly(half_chord_error + U * half_chord);
        let expected = exact.discriminant.square_root(200);
        Some(part_of_bound(&Dyadic::exactly(half_chord), &expected, &bound))
    };
    assert!(search_settings("half the chord", &ALMOST_IN_DOUBT, part) > 0.1);
}

#[test]
fn powers_keep_their_bound() {
    let part = |exact: &ExactChord, numbers| {
        let found = bounded(exact, numbers)?;
        let (power, relative_error) = found.power();
        assert!(relative_error >= POWER_ERROR);
        let rounding = of(U, &exact.power.clone().abs());
        let bound = &of(POWER_ERROR, &exact.larger()) + &rounding;
        Some(part_of_bound(&Dyadic::exactly(power), &exact.power, &bound))
    };
    let lies = [1e-10, -1e-10, 1e-16, -1e-16, 0.1].map(|power| Lie { power, discriminant: 0.5 });
    assert!(search_settings("compensated power", &lies, part) > 0.03);
}

/// The larger part that a root takes of its bound.
fn roots(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    let found = bounded(exact, numbers)?;
    let expected = exact.roots().expect("this hits");
    let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
        let Estimate { t, relative_error } = found.estimate(side)?;
        // Beyond that, rounding makes nothing of it.
        if relative_error >= 0.25 {
            return None;
        }
        let bound = of(relative_error, &expected[index].clone().abs());
        Some(part_of_bound(&Dyadic::exactly(t), &expected[index], &bound))
    });
    parts.into_iter().flatten().reduce(f64::max)
}

#[test]
fn roots_keep_their_bound() {
    assert!(search_settings("root of the case", &ALMOST_IN_DOUBT, roots) > 0.1);
}

/// The part of the tolerance that the error of a point or of a normal takes.
fn points(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    let found = bounded(exact, numbers)?;
    let expected = exact.roots().expect("this hits");
    let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
        let estimate = found.estimate(side)?;
        let hit = found.hit(side, estimate.t, estimate)?;
        let tolerance = Format::F32.point_tolerance();
        let [point, normal] = parts_of_tolerance(numbers, &expected[index], &hit, tolerance);
        Some(point.max(normal))
    });
    parts.into_iter().flatten().reduce(f64::max)
}

#[test]
fn points_keep_their_tolerance() {
    // As certain as the tolerance of f32 asks for, with all else in f64.
    let lies = [
        Lie { power: 0.5, discriminant: 1e-8 },
        Lie { power: 0.9999, discriminant: 1e-7 },
        Lie { power: 1.0 - 1e-12, discriminant: 1e-13 },
        Lie { power: 1.0 - 1e-14, discriminant: 5e-15 },
        Lie { power: 0.5, discriminant: 1e-14 },
        Lie { power: 1e-10, discriminant: 0.5 },
        Lie { power: -1e-4, discriminant: 0.5 },
    ];
    assert!(search_settings("point of the case", &lies, points) > 0.1);
}

#[test]
fn what_is_certain_is_right() {
    let mut random = Random::new(1);
    let (mut doubts, count) = (0, 2000);
    for round in 0..count {
        let [x, y] = [0; 2].map(|_| 2_f64.powi(random.integer(-106..=-2)));
        let lie = match random.below(4) {
            0 => Lie { power: x, discriminant: y },
            1 => Lie { power: -x, discriminant: x.max(y) },
            2 => Lie { power: 1.0 - x, discriminant: x * y },
            _ => Lie { power: 0.5, discriminant: -y },
        };
        let numbers = setting(&mut random, lie);
        let numbers = if round % 2 == 0 { numbers } else { single(numbers) };
        let exact = ExactChord::new(numbers);
        match roots(&exact, numbers) {
            Some(part) => assert!(part <= 1.0, "{numbers:?}"),
            None => doubts += 1,
        }
        let part = points(&exact, numbers).unwrap_or(0.0);
        assert!(part <= 1.0, "{numbers:?}");
    }
    assert!(doubts < count * 3 / 4, "{doubts} of {count} in doubt");
}

#[test]
fn odd_arguments_are_no_hits() {
    let good = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    let is_hit = |numbers| matches!(chord(line(numbers)), Verdict::Hit(_));
    assert!(is_hit(good));
    for index in 0..10 {
        for odd in [f64::NAN, f64::INFINITY] {
            let mut numbers = good;
            numbers[index] = odd;
            assert!(!is_hit(numbers), "{numbers:?}");
        }
    }
    for (index, number) in [(6, 0.0), (9, -2.0)] {
        let mut numbers = good;
        numbers[index] = number;
        assert!(!is_hit(numbers), "{numbers:?}");
    }
}
