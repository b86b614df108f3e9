//! Every step against the last one, over all exponents of each input.
//!
//! A product of floats is exact only where it does not underflow, and an analysis of rounding says nothing of that. So origins
//! lie on a surface, or next to nothing off it, lines touch a sphere or nearly so, roots are midway between two floats or nearly
//! so, and what "next to nothing" is may be any number.
//!
//! ```sh
//! CASES=10000000 cargo test --release --lib any_exponent -- --nocapture
//! ```

use core::fmt::Debug;
use core::ops::RangeInclusive;
use std::env;

use glam::{DVec3, Vec3};

use super::answer::Found;
use super::tests::{careful_steps, exact_root, line};
use super::*;
use crate::algebraic::Quadratic;
use crate::arithmetic::rounding::RoundDown;
use crate::arithmetic::scaling::scale;
use crate::geometric::ClosestApproach;
use crate::sealed::Internal;
use crate::testing::Random;
use crate::vector::Scalar;
use crate::{Ray, Sphere};

/// Rows of integers at right angles and of one length.
const FRAMES: [([[i32; 3]; 3], i32); 4] = [
    ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 1),
    ([[1, 2, 2], [2, 1, -2], [2, -2, 1]], 3),
    ([[3, 4, 0], [-4, 3, 0], [0, 0, 5]], 5),
    ([[2, 3, 6], [3, -6, 2], [6, 2, -3]], 7),
];

/// A number of a format, not zero unless it underflows, with an exponent in the range: each as often as each other.
fn any(random: &mut Random, format: Format, exponents: RangeInclusive<i32>) -> f64 {
    let mantissa = [1.0, random.mantissa(), random.mantissa()][random.below(3)];
    let number = format.nearest(random.sign() * mantissa);
    format.nearest(scale(number, random.integer(exponents)))
}

/// A few bits, or as many as a format has.
fn few(random: &mut Random, format: Format) -> f64 {
    match random.below(3) {
        0 => 1.0,
        1 => f64::from(random.integer(1..=20)),
        _ => format.nearest(random.mantissa()),
    }
}

/// The coordinates of center, origin and direction, and the radius.
fn numbers(random: &mut Random, format: Format) -> [f64; 10] {
    // Of the numbers that are not subnormal and do not overflow when some are added, and of all.
    let (least, most) = match format {
        Format::F32 => (-126, 120),
        Format::F64 => (-1022, 1016),
    };
    let lowest = least + 1 - format.digits();
    if random.below(10) == 0 {
        let mut numbers = [0.0; 10].map(|_: f64| {
            if random.below(4) == 0 { 0.0 } else { any(random, format, lowest..=most + 7) }
        });
        numbers[9] = numbers[9].abs();
        return numbers;
    }
    let (rows, length) = FRAMES[random.below(4)];
    let turn = random.below(3);
    let rows = [0, 1, 2].map(|row| DVec3::from(rows[(row + turn) % 3].map(f64::from)));
    let rows = rows.map(|row| row * random.sign());
    let length = f64::from(length);
    let origin = match random.below(6) {
        0 => rows[2] * few(random, format),
        1 => DVec3::from([0; 3].map(|_| f64::from(random.integer(-30..=30)))),
        _ => DVec3::ZERO,
    };
    let long = few(random, format);
    let mut direction = rows[0];
    let (o, radius) = match random.below(8) {
        // From the surface.
        0..=4 => {
            direction = match random.below(4) {
                0 => rows[0],
                1 => rows[0] + rows[1 + random.below(2)],
                2 => rows[1],
                _ => DVec3::from([0; 3].map(|_| any(random, format, -8..=0))),
            };
            (rows[0] * long, length * long)
        }
        // A tangent, from where it touches or from elsewhere.
        5 => {
            let along = if random.below(2) == 0 { 0.0 } else { few(random, format) };
            (rows[1] * long + rows[0] * along, length * long)
        }
        // Through the center, with a radius of any size.
        6 => (rows[0] * long, scale(few(random, format), random.integer(-120..=2))),
        // A root midway between two floats.
        _ => {
            let last = 1 - format.digits() - random.integer(0..=2);
            (rows[0], scale(length * f64::from(random.integer(1..=5)), last))
        }
    };
    // Half of them where floats are tried at all.
    let [unit, directions] = [(); 2].map(|()| match random.below(4) {
        0 | 1 => random.integer(least..=most),
        2 => random.integer(-250..=0).max(least),
        _ => random.integer(0..=250).min(most),
    });
    let scaled = |v: DVec3, unit: i32| v.map(|x| format.nearest(scale(x, unit))).to_array();
    let vectors = [scaled(origin + o, unit), scaled(origin, unit), scaled(direction, directions)];
    let mut numbers = [format.nearest(scale(radius, unit)); 10];
    for (number, coordinate) in numbers.iter_mut().zip(vectors.into_iter().flatten()) {
        *number = coordinate;
    }
    // Some moved by next to nothing, or by any number.
    for _ in 0..[0, 1, 1, 1, 2, 3][random.below(6)] {
        let index = random.below(10);
        let number = &mut numbers[index];
        let unit = if (6..9).contains(&index) { directions } else { unit };
        *number = match random.below(8) {
            0 => next(format, *number),
            1 => -next(format, -*number),
            2 => 0.0,
            3 => format.nearest(*number + *number * any(random, format, -60..=0)),
            4 => any(random, format, lowest..=most + 7),
            5 if *number == 0.0 => any(random, format, lowest..=lowest + 250),
            _ if *number == 0.0 => any(random, format, lowest..=unit),
            _ => continue,
        };
    }
    numbers[9] = numbers[9].abs();
    numbers
}

/// The next number of a format that is larger.
#[expect(clippy::cast_possible_truncation, reason = "it is one of the format")]
fn next(format: Format, number: f64) -> f64 {
    match format {
        Format::F32 => (-(-number as f32).next_below()).into(),
        Format::F64 => -(-number).next_below(),
    }
}

fn last_step(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    in_any_integers(line, format, question)
}

/// The numbers of an answer, in which zero has no sign.
fn listed(answer: Option<Answer>) -> Option<[f64; 7]> {
    let [mut numbers, zero] = [[0.0; 7]; 2];
    match answer? {
        Answer::Nearest(Found { t, point, normal }) => {
            numbers[0] = t;
            numbers[1..4].copy_from_slice(&point.to_array());
            numbers[4..].copy_from_slice(&normal.to_array());
        }
        Answer::Roots(roots) => numbers[..2].copy_from_slice(&roots),
    }
    Some(core::array::from_fn(|i| numbers[i] + zero[i]))
}

/// What is wrong with the answers to a question of the steps before the last.
fn wrong_step(line: &Line, format: Format, question: &Question) -> Option<&'static str> {
    let expected = listed(last_step(line, format, question));
    let [in_pairs, in_integers] = careful_steps(line, format, question);
    let is_wrong = |verdict| match verdict {
        Verdict::Miss => expected.is_some(),
        Verdict::Hit(answer) => listed(Some(answer)) != expected,
        Verdict::Doubt => false,
    };
    if is_wrong(in_pairs) {
        return Some("pairs");
    }
    is_wrong(in_integers).then_some("integers")
}

/// Whether a point is as near to the exact one, which is given rounded, as it is to be.
fn is_near(format: Format, line: &Line, found: &Found, exact: &Found) -> bool {
    let tolerance = format.point_tolerance();
    let length = line.direction.abs().max_element();
    // A sum that does not overflow, and is no less than the length.
    let of_distance = tolerance.of_distance * (found.t * (1.74 * length));
    let allowed = of_distance.min(tolerance.of_radius * line.radius);
    let point = [0, 1, 2].iter().all(|axis| {
        let (found, exact) = (found.point[*axis], exact.point[*axis]);
        let ulp = next(format, exact.abs()) - exact.abs();
        found == exact || (found - exact).abs() <= allowed + 1.5 * ulp
    });
    let ulp = if format == Format::F32 { f64::from(f32::EPSILON) } else { f64::EPSILON };
    point && (found.normal - exact.normal).abs().max_element() <= 2.5 * ulp
}

/// What is wrong with the answers for a line and a sphere.
fn wrong<V: Internal>(numbers: [f64; 10], format: Format, with_oracle: bool) -> Option<String>
where
    V::Scalar: Debug,
{
    let line = line(numbers);
    let sphere = Sphere::new(V::from_f64(line.center), V::Scalar::from_f64(line.radius));
    let ray = Ray::new(V::from_f64(line.origin), V::from_f64(line.direction));
    let roots = last_step(&line, format, &Question::Both).and_then(Answer::roots);
    if with_oracle && line.is_valid() {
        let exact = crate::testing::ExactChord::new(numbers).discriminant;
        if exact.is_negative() != roots.is_none() {
            return Some("the last step, hit or miss".into());
        }
        for (side, root) in [Side::Near, Side::Far].into_iter().zip(roots.into_iter().flatten()) {
            if exact_root(format, numbers, side) != root {
                return Some("the last step, a root".into());
            }
        }
    }
    let listed_roots =
        |roots: Option<[V::Scalar; 2]>| roots.map(|roots| roots.map(Into::<f64>::into));
    for (found, what) in [
        (listed_roots(V::roots::<Quadratic>(&sphere, &ray)), "roots by the quadratic"),
        (listed_roots(V::roots::<ClosestApproach>(&sphere, &ray)), "roots by the closest approach"),
        (
            listed_roots(V::roots::<Quadratic>(&sphere, &Ray::new(ray.origin, -ray.direction)))
                .map(|[near, far]| [-far, -near]),
            "roots the other way",
        ),
    ] {
        if found != roots {
            return Some(format!("{what}: {found:?}, not {roots:?}"));
        }
    }
    if let Some(step) = wrong_step(&line, format, &Question::Both) {
        return Some(format!("both roots by {step}"));
    }
    let mut ranges = vec![0.0..f64::INFINITY];
    if let Some([near, far]) = roots {
        ranges.extend([
            near..far,
            near..f64::INFINITY,
            next(format, near)..f64::INFINITY,
            0.0..far,
        ]);
    }
    for range in ranges {
        let question = Question::Nearest(range.clone());
        let exact = last_step(&line, format, &question).and_then(Answer::nearest);
        // The first root that the range accepts.
        let is_accepted = |t: &f64| *t > 0.0 && *t < f64::INFINITY && range.contains(t);
        let accepted = roots.into_iter().flatten().find(is_accepted);
        let ends = V::Scalar::from_f64(range.start)..V::Scalar::from_f64(range.end);
        for (found, what) in [
            (V::intersect::<Quadratic>(&sphere, &ray, ends.clone()), "quadratic"),
            (V::intersect::<ClosestApproach>(&sphere, &ray, ends), "closest approach"),
        ] {
            let found = found.map(|hit| Found {
                t: hit.t.into(),
                point: hit.point.to_f64(),
                normal: hit.normal.to_f64(),
            });
            if found.map(|found| found.t) != accepted {
                return Some(format!(
                    "{what} in {range:?}: {found:?}, not {accepted:?} of {roots:?}"
                ));
            }
            if let (Some(found), Some(exact)) = (found, exact) {
                if exact.t != found.t || !is_near(format, &line, &found, &exact) {
                    return Some(format!("{what} in {range:?}: {found:?}, not {exact:?}"));
                }
            }
        }
        if let Some(step) = wrong_step(&line, format, &question) {
            return Some(format!("{question:?} by {step}"));
        }
    }
    None
}

#[test]
fn every_step_answers_as_the_last_over_all_exponents() {
    let count: u64 = env::var("CASES").map_or(1_500, |count| count.parse().expect("a number"));
    let first: u64 = env::var("FIRST").map_or(0, |first| first.parse().expect("a number"));
    let (mut hits, mut failed) = (0, 0_u64);
    for seed in first..first + count {
        let mut random = Random::new(seed);
        for format in [Format::F32, Format::F64, Format::F64, Format::F64] {
            let numbers = numbers(&mut random, format);
            let with_oracle = seed % 100 == 0;
            let wrong = match format {
                Format::F32 => wrong::<Vec3>(numbers, format, with_oracle),
                Format::F64 => wrong::<DVec3>(numbers, format, with_oracle),
            };
            hits += u64::from(in_any_integers(&line(numbers), format, &Question::Both).is_some());
            if let Some(wrong) = wrong {
                failed += 1;
                if failed <= 20 {
                    println!("{seed} {format:?} {numbers:?}\n    {wrong}");
                }
            }
        }
    }
    println!("{hits} of {} lines hit", 4 * count);
    assert!(hits > count, "{hits} hits");
    assert_eq!(failed, 0, "of {}", 4 * count);
}

#[test]
fn what_is_lost_beside_a_large_coordinate_is_not_taken_for_zero() {
    // Midway between two floats, but for what a coordinate far below the others adds.
    for (center, origin, direction, radius) in [
        (
            [-4.878_797_525_546_4e-175, 7.008_359_852_462_586_5e183, -4.249_103_942_534_137e183],
            [-5e-324, 7.008_359_852_462_586_5e183, 0.0],
            [-0.0, -0.0, -1.192_092_895_507_812_5e-7],
            7.076_179_546_540_39e167,
        ),
        (
            [1.774_508_604_237_321_5e131, 0.0, -1.657_809_2e-316],
            [0.0, 0.0, -5e-324],
            [2.242_077_542_919_707_3e-44, 0.0, 0.0],
            2.955_150_464_729_586e115,
        ),
        (
            [-2.754_508_019_813_277_6e-281, 0.0, 9.134_385_233_318_143e46],
            [-7.531_857_866_676_93e-283, 0.0, 0.0],
            [0.0, 0.0, 2.350_988_701_644_575e-38],
            3.042_361_440_547_750_6e31,
        ),
    ] {
        let numbers = [&center[..], &origin, &direction, &[radius]].concat();
        let numbers = numbers.try_into().expect("ten numbers");
        assert_eq!(wrong::<DVec3>(numbers, Format::F64, true), None, "{numbers:?}");
    }
}
