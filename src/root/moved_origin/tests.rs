use super::*;
use crate::root::tests::{ExactLine, assert_exact, exact_root, length, line};
use crate::testing::{
    Dyadic, ExactChord, Lie, Random, exactly, part_of_bound, search_settings, setting,
};

/// Where the plain discriminant is certain enough.
const ANYWHERE: [Lie; 6] = [
    Lie { power: 0.999, discriminant: 0.0009 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: -1e-20, discriminant: 0.5 },
    Lie { power: -0.9, discriminant: 0.95 },
    Lie { power: 1.0 - 1e-12, discriminant: 1e-13 },
];

/// Where it is not, down to what pairs can tell.
const ALMOST_IN_DOUBT: [Lie; 8] = [
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: -1e-14, discriminant: 1.1e-14 },
    Lie { power: 0.9, discriminant: 1e-15 },
    Lie { power: 0.5, discriminant: 1e-20 },
    Lie { power: 0.5, discriminant: 1e-29 },
    Lie { power: 1.0 - 1e-15, discriminant: 1e-18 },
    Lie { power: 1.0 - 1e-15, discriminant: 2e-16 },
    Lie { power: 1.0 - 1e-15, discriminant: 1e-30 },
];

fn of(bound: f64, size: &Dyadic) -> Dyadic {
    &Dyadic::exactly(bound) * size
}

/// What the chord says, after a look at whether hit or miss is right.
fn in_pairs<T>(
    exact: &ExactChord,
    numbers: [f64; 10],
    then: impl FnOnce(InPairs<'_>) -> Option<T>,
) -> Option<T> {
    match chord(&line(numbers), Format::F64) {
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
fn offsets_are_as_fine_as_themselves() {
    let part = |exact: &ExactChord, numbers: [f64; 10]| {
        let line = line(numbers);
        let exact_line = ExactLine::new(numbers);
        // At the closest approach and at a root, but for rounding.
        let root = exact.roots().map(|[near, _]| near.approximately());
        let approach = exact.h.divided_by(&exact.a, 60).approximately();
        let parts = [root, Some(approach)].into_iter().flatten().map(|t| {
            let Triple { x, y, z } = offset(line.o(), line.direction.into(), t);
            let expected = exact_line.offset(&Dyadic::exactly(t));
            let error = length(&[0, 1, 2].map(|axis| &exactly([x, y, z][axis]) - &expected[axis]));
            let reach = length(&exact_line.o);
            // The root may be twice as far away.
            let bound = &of(V, &length(&expected)) + &of(12.0 * U * V, &reach);
            error.divided_by(&bound, 64).approximately()
        });
        parts.reduce(f64::max)
    };
    assert!(search_settings("offset in pairs", 60, 250, &ANYWHERE, part) > 0.1);
    assert!(search_settings("offset in pairs, from afar", 60, 250, &ALMOST_IN_DOUBT, part) > 0.1);
}

/// The part of its bound that the error of the discriminant from the closest approach takes.
fn part_of_moved(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    in_pairs(exact, numbers, |InPairs { half_chord, start, .. }| {
        if start == 0.0 {
            return None;
        }
        let line = ExactLine::new(numbers);
        let larger = Dyadic::exactly(numbers[9]);
        let reach = line.reach();
        let size = &of(MOVED_ERROR, &(&exact.radius_squared() * &exact.a))
            + &of(MOVED_REACH_ERROR, &(&reach * &(&larger * &length(&line.d))));
        // And the rounding of both, and of the square root.
        let bound = &(&size + &of(MOVED_ALONG_ERROR, &(&reach * &reach)))
            + &of(16.0 * U, &exact.discriminant);
        let square = &Dyadic::exactly(half_chord) * &Dyadic::exactly(half_chord);
        Some(part_of_bound(&square, &exact.discriminant, &bound))
    })
}

#[test]
fn discriminants_from_the_closest_approach_keep_their_bound() {
    assert!(
        search_settings(
            "discriminant of the moved origin",
            60,
            250,
            &ALMOST_IN_DOUBT,
            part_of_moved
        ) > 0.1
    );
}

/// Next to a tangent from afar, with the direction (3, 4, 0) and the normal (-4, 3, 0): a radius that is longer by a few ulps
/// than the line is off the center.
fn next_to_a_tangent_from_afar(random: &mut Random) -> [f64; 10] {
    let whole = |random: &mut Random, places: i32| (random.mantissa() * 2_f64.powi(places)).round();
    // The origin is off the line through the center, which may be so far away that the difference takes a pair.
    let places = random.integer(20..=45);
    let (long, along, off) = (whole(random, 20), whole(random, places), whole(random, 10));
    let along = along * 2_f64.powi(random.integer(0..=60));
    let ulps = f64::from(random.integer(1..=100)) * f64::EPSILON;
    let radius = 5.0 * off.abs() * (1.0 + ulps);
    [3.0 * along, 4.0 * along, 0.0, 4.0 * off, -3.0 * off, 0.0, 3.0 * long, 4.0 * long, 0.0, radius]
}

#[test]
fn discriminants_next_to_tangents_from_afar_keep_their_bound() {
    let mut random = Random::new(11);
    let (mut decided, count) = (0, 1000);
    for _ in 0..count {
        let numbers = next_to_a_tangent_from_afar(&mut random);
        let exact = ExactChord::new(numbers);
        let part = part_of_moved(&exact, numbers);
        assert!(part.unwrap_or(0.0) <= 1.0, "{part:?} {numbers:?}");
        decided += u32::from(part.is_some());
        for part in [roots(&exact, numbers), offsets(&exact, numbers)].into_iter().flatten() {
            assert!(part <= 1.0, "{numbers:?}");
        }
    }
    assert!(decided > count / 3, "{decided} of {count}");
}

/// The larger part that one of the roots takes of its bound.
fn roots(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    in_pairs(exact, numbers, |chord| {
        let expected = exact.roots().expect("this hits");
        let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
            let Corrected { t, error, .. } = chord.corrected(side)?;
            let bound = &Dyadic::exactly(error) + &of(PAIR_ERROR, &expected[index].clone().abs());
            Some(part_of_bound(&exactly(t), &expected[index], &bound))
        });
        parts.into_iter().flatten().reduce(f64::max)
    })
}

#[test]
fn roots_in_pairs_keep_their_bound() {
    assert!(search_settings("roots in pairs", 60, 250, &ALMOST_IN_DOUBT, roots) > 0.03);
    assert!(search_settings("roots in pairs, anywhere", 60, 250, &ANYWHERE, roots) > 0.03);
}

/// The part that the error of the offset at a root takes of its bound, after a look at whether the hit is right.
fn offsets(exact: &ExactChord, numbers: [f64; 10]) -> Option<f64> {
    in_pairs(exact, numbers, |mut chord| {
        let expected = exact.roots().expect("this hits");
        let exact_line = ExactLine::new(numbers);
        let parts = [(Side::Near, 0), (Side::Far, 1)].map(|(side, index): (Side, usize)| {
            let (t, root) = chord.root(side)?;
            let bound = Dyadic::exactly(chord.offset_error(&root));
            let offset = root.offset(chord.line);
            let exact_offset = exact_line.offset(&expected[index]);
            if let Some(found) = chord.hit(side, t, root) {
                assert_exact(Format::F64, numbers, side, &found);
            }
            let parts = [(offset.x, 0), (offset.y, 1), (offset.z, 2)].map(
                |(offset, axis): (Pair, usize)| {
                    part_of_bound(&exactly(offset), &exact_offset[axis], &bound)
                },
            );
            parts.into_iter().reduce(f64::max)
        });
        parts.into_iter().flatten().reduce(f64::max)
    })
}

#[test]
fn offsets_at_roots_keep_their_bound() {
    assert!(search_settings("offset at a root, from pairs", 60, 250, &ANYWHERE, offsets) > 0.01);
    assert!(
        search_settings("offset at a root, in doubt", 60, 250, &ALMOST_IN_DOUBT, offsets) > 0.01
    );
}

#[test]
fn what_pairs_are_certain_of_is_right() {
    let mut random = Random::new(1);
    let (mut doubts, count) = (0, 3000);
    for _ in 0..count {
        let [x, y] = [0; 2].map(|_| 2_f64.powi(random.integer(-112..=-10)));
        let lie = match random.below(4) {
            0 => Lie { power: x, discriminant: y },
            1 => Lie { power: -x, discriminant: x.max(y) },
            2 => Lie { power: 1.0 - x, discriminant: x * y.max(1e-6) },
            _ => Lie { power: 0.5, discriminant: -y },
        };
        let numbers = setting(&mut random, lie);
        let exact = ExactChord::new(numbers);
        for part in [roots(&exact, numbers), offsets(&exact, numbers)] {
            match part {
                Some(part) => assert!(part <= 1.0, "{numbers:?}"),
                None if exact.discriminant.is_negative() => {}
                None => doubts += 1,
            }
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
fn tangents_are_in_doubt() {
    let doubt = |numbers| matches!(chord(&line(numbers), Format::F64), Verdict::Doubt);
    assert!(doubt([5.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0]));
    assert!(!doubt([5.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.5]));
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
fn both_roots_may_lie_on_one_side_of_the_midpoint() {
    // Along an axis, M d is next to a coordinate of 24 bits, so that another brings the center next to M d, and no `f64` tells
    // the roots from M, though all three are far apart beside the radius.
    let mut random = Random::new(8);
    let mut cases = 0;
    while cases < 200 {
        let direction = f64::from(random.mantissa() as f32);
        let midpoint = f64::from(random.mantissa() as f32) + f64::from(f32::EPSILON) / 2.0;
        let center = f64::from((midpoint * direction) as f32);
        let rest = center - midpoint * direction;
        if rest.abs() > 2_f64.powi(-33) {
            continue;
        }
        let origin = f64::from((rest * (1.0 + f64::from(random.integer(-9..=9)) * 1e-7)) as f32);
        for radius in [2_f64.powi(-60), 2_f64.powi(-68)] {
            let numbers = [center, 0.0, 0.0, origin, 0.0, 0.0, direction, 0.0, 0.0, radius];
            let line = line(numbers);
            let Verdict::Hit(mut found) = chord(&line, Format::F32) else { continue };
            for side in [Side::Near, Side::Far] {
                let Some((t, _)) = found.root(side) else { continue };
                assert_eq!(t, exact_root(Format::F32, numbers, side), "{side:?} {numbers:?}");
                cases += 1;
            }
        }
    }
}
