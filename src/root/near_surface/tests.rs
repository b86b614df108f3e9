use super::*;
use crate::algebraic::Quadratic;
use crate::float::sqrt;
use crate::root::answer::Side;
use crate::root::chord::Derivation;
use crate::root::format::Format;
use crate::root::power::accurate_power;
use crate::root::tests::{assert_exact, line};
use crate::testing::families::{FAMILIES, Rng};
use crate::testing::{
    Dyadic, ExactChord, Float, Lie, Random, exactly, part_of_bound, search_settings, setting,
};

fn chord(line: &Line) -> (Chord<f64>, f64, f64) {
    let radius_squared = line.radius * line.radius;
    let o = Triple::from(line.center - line.origin);
    let chord = Quadratic::chord(o, line.direction.into(), radius_squared);
    (chord, sqrt(chord.discriminant), chord.distance_squared.max(radius_squared))
}

const SMALL: [Lie; 10] = [
    // As little of a chord as may be, and as much of a power.
    Lie { power: 4.6e-7, discriminant: 7.8e-6 },
    Lie { power: -5.1e-7, discriminant: 8.6e-6 },
    Lie { power: 0.03, discriminant: 0.5 },
    Lie { power: -0.03, discriminant: 0.6 },
    Lie { power: 1e-9, discriminant: 0.5 },
    Lie { power: -1e-9, discriminant: 1e-5 },
    Lie { power: 1e-14, discriminant: 1e-5 },
    Lie { power: -1e-14, discriminant: 0.5 },
    Lie { power: 1e-16, discriminant: 0.9 },
    Lie { power: -1e-16, discriminant: 1e-4 },
];

/// The small root of a line that starts close to the surface, its exact value, and the line.
fn small(exact: &ExactChord, numbers: [f64; 10]) -> Option<((Pair, f64), Dyadic)> {
    let line = line(numbers);
    let (chord, half_chord, larger) = chord(&line);
    if !is_close(&chord, half_chord, larger) {
        return None;
    }
    let power = accurate_power(line.o(), line.radius);
    if power.1 > 0.25 * power.0.hi.abs() {
        return None;
    }
    let root = small_root(line.o(), line.direction.into(), &chord, half_chord, power);
    let [near, far] = exact.roots().expect("a chord");
    let small = if near.clone().abs() < far.clone().abs() { near } else { far };
    Some((root, small))
}

#[test]
fn small_roots_keep_their_bound() {
    let part = |exact: &ExactChord, numbers| {
        let ((t, relative_error), expected) = small(exact, numbers)?;
        let bound = &Dyadic::exactly(relative_error) * &expected.clone().abs();
        Some(part_of_bound(&exactly(t), &expected, &bound))
    };
    assert!(search_settings("small root", 80, 250, &SMALL, part) > 0.002);

    // By what is left where the power is that good, the bound of the rest is looked at alone.
    let part = |exact: &ExactChord, numbers| {
        let ((t, _), expected) = small(exact, numbers)?;
        let (_, power_error) = accurate_power(line(numbers).o(), line(numbers).radius);
        let power_error = Dyadic::exactly(power_error).divided_by(&exact.power, 100).abs();
        let bound = &(&Dyadic::exactly(ROOT_ERROR) + &power_error) * &expected.clone().abs();
        Some(part_of_bound(&exactly(t), &expected, &bound))
    };
    assert!(search_settings("small root, least chord", 80, 250, &SMALL[..2], part) > 0.0);
}

#[test]
fn what_is_close_has_a_chord_and_a_small_root() {
    // Within a thousandth of a |power| = h² / 17 and of 2 s² = 2^-16 a m.
    let close = |lie: Lie| {
        let line = line(setting(&mut Random::new(3), lie));
        let (chord, half_chord, larger) = chord(&line);
        is_close(&chord, half_chord, larger)
    };
    let least = CLEAR / 2.0;
    assert!(close(Lie { power: 1e-9, discriminant: 1.01 * least }));
    assert!(!close(Lie { power: 1e-9, discriminant: 0.99 * least }));
    // h² = (discriminant + power) a m.
    let part = |part: f64| Lie { power: 0.5 * part / (1.0 - part), discriminant: 0.5 };
    assert!(close(part(0.99 / 17.0)) && !close(part(1.01 / 17.0)));
    let part = |part: f64| Lie { power: -0.5 * part / (1.0 + part), discriminant: 0.5 };
    assert!(close(part(0.99 / 17.0)) && !close(part(1.01 / 17.0)));
    let nan = Chord { a: f64::NAN, h: 1.0, distance_squared: 1.0, power: 0.0, discriminant: 1.0 };
    assert!(!is_close(&nan, 1.0, 1.0));
}

#[test]
fn hits_are_rounded_correctly_or_not_certain() {
    let mut random = Random::new(5);
    let (mut certain, mut doubts) = (0, 0);
    for _ in 0..4000 {
        let lie = SMALL[random.below(SMALL.len())];
        let numbers = setting(&mut random, lie);
        let exact = ExactChord::new(numbers);
        let Some((root, expected)) = small(&exact, numbers) else { continue };
        let line = line(numbers);
        // Of the two roots, that on the side of the origin.
        let side = if exact.h.is_negative() { Side::Far } else { Side::Near };
        let t = f64::nearest(&expected);
        match hit(line, Format::F64, line.o(), side, root, t) {
            Some(found) => assert_exact(Format::F64, numbers, side, &found),
            None => doubts += 1,
        }
        certain += 1;
    }
    assert!(certain > 2000 && doubts < certain / 10, "{doubts} doubts of {certain}");
}

#[test]
fn hits_from_exactly_on_the_surface_are_rounded_correctly() {
    let family = FAMILIES.iter().find(|family| family.name == "on the surface, exactly");
    let family = family.expect("there is one");
    let mut rng = Rng::new(3);
    let (mut hits, mut misses, count) = (0, 0, 2000);
    for _ in 0..count {
        let (ray, sphere) = (family.f32)(&mut rng);
        let line = Line::new(&sphere, &ray);
        match from_the_surface(line, Format::F32, &(0.0..f64::INFINITY)) {
            Some(Some(found)) => {
                let [c, p, d] = [line.center, line.origin, line.direction].map(|v| v.to_array());
                let numbers = [&c[..], &p, &d, &[line.radius]].concat();
                let numbers = numbers.try_into().expect("ten numbers");
                assert_exact(Format::F32, numbers, Side::Far, &found);
                hits += 1;
            }
            Some(None) => misses += 1,
            None => {}
        }
    }
    assert!(hits > count * 2 / 5 && misses > count * 2 / 5, "{hits} hits, {misses} misses");
}
