use glam::DVec3;

use super::*;
use crate::testing::{Dyadic, ExactChord, Lie, Random, part_of_bound, search, setting};

fn o_and_d(numbers: [f64; 10]) -> (Triple<Pair>, Triple<f64>) {
    let [cx, cy, cz, px, py, pz, dx, dy, dz, _] = numbers;
    let [c, p] = [DVec3::new(cx, cy, cz), DVec3::new(px, py, pz)].map(Triple::from);
    (c.zip(p, two_difference), Triple { x: dx, y: dy, z: dz })
}

/// Near the limb from afar, and origins near the surface: as little clear of doubt as may be.
const ALMOST_IN_DOUBT: [Lie; 5] = [
    Lie { power: 0.5, discriminant: 1e-14 },
    Lie { power: 0.9999, discriminant: 1e-10 },
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: 1e-28, discriminant: 0.5 },
    Lie { power: -1e-28, discriminant: 0.5 },
];

/// What part of its bound the larger error of both roots takes, and that of half the chord, after a look at whether hit or
/// miss is right.
fn parts(exact: &ExactChord, numbers: [f64; 10]) -> Option<[f64; 2]> {
    let (o, d) = o_and_d(numbers);
    let estimate = match second_try(o, d, numbers[9]) {
        SecondTry::Doubt => return None,
        SecondTry::Miss => {
            assert!(exact.discriminant.is_negative(), "the line hits: {numbers:?}");
            return Some([0.0; 2]);
        }
        SecondTry::Hit(estimate) => estimate,
    };
    let expected = exact.roots().expect("the line misses");
    let roots = [0, 1].map(|side: usize| {
        let Root { numerator, denominator, relative_error } = estimate.roots[side];
        let computed = Dyadic::exactly(numerator / denominator);
        let bound = &Dyadic::exactly(relative_error) * &expected[side].clone().abs();
        part_of_bound(&computed, &expected[side], &bound)
    });
    let half_chord = part_of_bound(
        &Dyadic::exactly(estimate.half_chord),
        &exact.discriminant.square_root(200),
        // The root itself is rounded too.
        &Dyadic::exactly(estimate.error + U * estimate.half_chord),
    );
    Some([roots[0].max(roots[1]), half_chord])
}

fn search_settings(what: &str, part: impl Fn(&ExactChord, [f64; 10]) -> Option<f64>) -> f64 {
    let start = |random: &mut Random| {
        let lie = ALMOST_IN_DOUBT[random.below(ALMOST_IN_DOUBT.len())];
        setting(random, lie)
    };
    search(what, 60, 200, start, |numbers| part(&ExactChord::new(numbers), numbers))
}

#[test]
fn roots_keep_their_bound() {
    let roots = |exact: &ExactChord, numbers| parts(exact, numbers).map(|[roots, _]| roots);
    assert!(search_settings("roots of the second try", roots) > 0.1);
}

#[test]
fn half_chords_keep_their_bound() {
    let half_chord = |exact: &ExactChord, numbers| parts(exact, numbers).map(|[_, half]| half);
    assert!(search_settings("half the chord of the second try", half_chord) > 0.1);
}

#[test]
fn what_is_certain_is_right() {
    let mut random = Random::new(1);
    let (mut doubts, count) = (0, 2000);
    for _ in 0..count {
        let [x, y] = [0; 2].map(|_| 2_f64.powi(random.integer(-106..=-2)));
        let lie = match random.below(4) {
            0 => Lie { power: x, discriminant: y },
            1 => Lie { power: -x, discriminant: x.max(y) },
            2 => Lie { power: 1.0 - x, discriminant: x * y },
            _ => Lie { power: 0.5, discriminant: -y },
        };
        let numbers = setting(&mut random, lie);
        match parts(&ExactChord::new(numbers), numbers) {
            Some(parts) => assert!(parts[0] <= 1.0 && parts[1] <= 1.0, "{numbers:?}"),
            None => doubts += 1,
        }
    }
    assert!(doubts < count * 3 / 4, "{doubts} of {count} in doubt");
}
