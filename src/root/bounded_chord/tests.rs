use super::*;
use crate::root::tests::{ExactLine, length, line};
use crate::testing::{Dyadic, ExactChord, Lie, Random, part_of_bound, search, setting};

/// Near the limb, close by and from afar.
const NEAR_THE_LIMB: [Lie; 3] = [
    Lie { power: 0.5, discriminant: 1e-14 },
    Lie { power: 0.9999, discriminant: 1e-10 },
    Lie { power: 1.0 - 1e-12, discriminant: 1e-13 },
];

fn bounded(numbers: [f64; 10]) -> Bounded {
    let line = line(numbers);
    let o = line.o().map(|o| o.hi);
    Bounded::new(o, line.direction.into(), line.radius * line.radius.abs())
}

fn of(bound: f64, size: &Dyadic) -> Dyadic {
    &Dyadic::exactly(bound) * size
}

/// The part of its bound that the error of the discriminant takes.
fn part_of_discriminant(numbers: [f64; 10]) -> f64 {
    let Bounded { chord, error, .. } = bounded(numbers);
    let exact = ExactChord::new(numbers).discriminant;
    part_of_bound(&Dyadic::exactly(chord.discriminant), &exact, &Dyadic::exactly(error))
}

#[test]
fn bounds_are_those_of_the_analysis() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let lie = NEAR_THE_LIMB[random.below(NEAR_THE_LIMB.len())];
        let numbers = setting(&mut random, lie);
        let (exact, line) = (ExactChord::new(numbers), ExactLine::new(numbers));
        let (moment, reach) = (length(&line.moment()), line.reach());
        let size = &(&exact.radius_squared() * &exact.a) + &(&moment * &(&moment + &reach));
        let bound = &of(DISCRIMINANT_ERROR, &size) + &of(MOMENT_ERROR_SQUARED, &(&reach * &reach));
        let found = bounded(numbers);
        for (found, expected) in [(found.error, bound), (found.reach(), reach)] {
            let part = part_of_bound(&Dyadic::exactly(found), &expected, &of(1e-6, &expected));
            assert!(part <= 1.0, "{numbers:?}");
        }
    }
}

#[test]
fn discriminants_keep_the_bound_of_the_case() {
    let start = |random: &mut Random| {
        let lie = NEAR_THE_LIMB[random.below(NEAR_THE_LIMB.len())];
        setting(random, lie)
    };
    let part = |numbers| Some(part_of_discriminant(numbers));
    assert!(search("discriminant of the case", 60, 200, start, part) > 0.1);
    // The center so far away that P² alone counts.
    let start = |random: &mut Random| {
        let mut numbers = setting(random, Lie { power: 0.5, discriminant: 0.5 });
        let radius_squared: f64 = [1e-26, 1e-28, 1e-30, 3e-32][random.below(4)];
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
    search("discriminant from afar", 60, 200, start, part);
}

#[test]
fn odd_arguments_are_not_certain() {
    let good = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    let is_hit = |numbers| {
        let Bounded { chord, error, .. } = bounded(numbers);
        chord.discriminant > error
    };
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

#[test]
fn lines_of_any_size_keep_their_bound() {
    // P⁴ would overflow.
    let numbers = setting(&mut Random::new(1), NEAR_THE_LIMB[0]);
    let far = numbers.map(|x| x * 2_f64.powi(199));
    let (here, there) = (bounded(numbers), bounded(far));
    assert_eq!(there.error, here.error * 2_f64.powi(4 * 199));
    assert_eq!(there.reach(), here.reach() * 2_f64.powi(2 * 199));
}
