use super::*;
use crate::root::tests::{ExactLine, line, lines_of_every_kind};
use crate::testing::{Dyadic, ExactChord, Random};

/// Spheres of half an ulp beside an axis, and lines in any direction whose coordinates are integers of a few bits.
fn random_numbers(random: &mut Random) -> [f64; 10] {
    let mut numbers = match random.below(3) {
        0 => [0.0; 10].map(|_: f64| f64::from(random.integer(-20..=20))),
        1 => [0.0; 10].map(|_: f64| random.float(-8..=0)),
        _ => {
            let beside = [0.0, random.float(-100..=-53)][random.below(2)];
            [random.float(0..=0), beside, 0.0, 0.0, 0.0, 0.0, random.sign(), 0.0, 0.0, 0.0]
        }
    };
    numbers[9] = f64::from(random.integer(1..=40)) * 2_f64.powi(-random.integer(2..=53));
    numbers
}

#[test]
fn coordinates_are_compared_exactly_with_midpoints_at_and_beside_them() {
    let mut random = Random::new(1);
    let (mut equal, mut told) = (0, 0);
    for _ in 0..6000 {
        let numbers = random_numbers(&mut random);
        let exact = ExactChord::new(numbers);
        let (Some(roots), ExactLine { d, p, o }) = (exact.roots(), ExactLine::new(numbers)) else {
            continue;
        };
        let radius = Dyadic::exactly(numbers[9]);
        for (side, root) in [Side::Near, Side::Far].into_iter().zip(&roots) {
            for axis in (0..3).filter(|axis| !d[*axis].is_zero()) {
                let coordinate = &p[axis] + &(root * &d[axis]);
                let (leading, exponent) = coordinate.leading([20, 54][random.below(2)]);
                let leading = i64::try_from(leading).unwrap();
                let leading = if coordinate.is_negative() { -leading } else { leading };
                for integer in [-1, 0, 1].map(|beside| leading + beside) {
                    let exponent: i32 = exponent.try_into().unwrap();
                    let midpoint = Midpoint { integer, exponent };
                    let found = compare_coordinate(&line(numbers), side, axis, midpoint);
                    let Some(found) = found else { continue };
                    told += 1;
                    let number = Dyadic::new(integer, exponent.into());
                    // To 300 bits, a root that is not this one differs from it.
                    let n = &number - &p[axis];
                    let w = [0, 1, 2].map(|k: usize| &(&n * &d[k]) - &(&d[axis] * &o[k]));
                    let [x, y, z] = w.map(|w| &w * &w);
                    let size = &d[axis] * &radius;
                    let is_at_a_root = (&(&x + &y) + &z) == &size * &size;
                    let other = &p[axis] + &(&roots[usize::from(side == Side::Near)] * &d[axis]);
                    let gap = |x: &Dyadic| (x - &number).abs();
                    let is_here = gap(&coordinate) <= gap(&other);
                    let expected = if is_at_a_root && is_here {
                        Ordering::Equal
                    } else {
                        coordinate.cmp(&number)
                    };
                    assert_eq!(found, expected, "{side:?} {axis} {integer} {exponent} {numbers:?}");
                    equal += u32::from(expected.is_eq());
                }
            }
        }
    }
    assert!(equal > 100 && told > 10_000, "{equal} are equal of {told}");
}

#[test]
fn what_has_no_room_is_not_told() {
    let midpoint = Midpoint { integer: (5 << 50) + 1, exponent: -52 };
    let at = |radius: f64| line([3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius]);
    let compare = |radius: f64| compare_coordinate(&at(radius), Side::Near, 0, midpoint);
    // Of 512 places, 509 are those of lengths above the last of the radius, 1 of the direction, and 2 of sums.
    assert_eq!(compare(2_f64.powi(-404)), Some(Ordering::Greater));
    assert_eq!(compare(2_f64.powi(-507)), Some(Ordering::Greater));
    assert_eq!(compare(2_f64.powi(-508)), None);
    assert_eq!(compare(2_f64.powi(-1000)), None);
}

/// The same number as an odd integer, as that of a midpoint is.
fn odd(Midpoint { integer, exponent }: Midpoint) -> Midpoint {
    let zeros = integer.trailing_zeros() % i64::BITS;
    Midpoint { integer: integer >> zeros, exponent: exponent + i32::try_from(zeros).unwrap() }
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
    let (mut equal, mut told, mut certain) = (0, 0, 0);
    for _ in 0..3000 {
        let numbers = lines_of_every_kind(&mut random);
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
            for midpoint in midpoints.into_iter().map(odd) {
                let number = Dyadic::new(midpoint.integer, midpoint.exponent.into());
                let expected = compared(&exact, side, &number);
                // By floats first, and by integers alone.
                let found = [
                    compare_root(&line, side, midpoint, None),
                    compare_in_integers(&line, side, None, midpoint),
                ];
                for found in found.into_iter().flatten() {
                    assert_eq!(found, expected, "{side:?} {midpoint:?} {numbers:?}");
                    equal += u32::from(expected.is_eq());
                    told += 1;
                }
                let ahead = exact.h.cmp(&(&exact.a * &number));
                if let Some(found) = ahead_of(&line, midpoint) {
                    assert_eq!(found, ahead, "{midpoint:?} {numbers:?}");
                    certain += 1;
                }
                if let Some(quadratic) = quadratic_at(&line, midpoint) {
                    let slope = &(&exact.a * &number) - &(&exact.h + &exact.h);
                    let exact = (&(&slope * &number) + &exact.power).sign();
                    assert_eq!(quadratic, exact, "{midpoint:?} {numbers:?}");
                    certain += 1;
                }
            }
        }
    }
    assert!(equal > 100, "{equal} are equal");
    assert!(told > 10_000 && certain > 1000, "{told} are told, {certain} are certain");
}

#[test]
fn roots_are_compared_exactly_with_numbers_on_and_beside_them() {
    // Roots 3 and 7 along x, and a tangent at 5.
    let compare = |radius: f64, height: f64, side, m: f64| {
        let numbers = [5.0, height, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius];
        let (integer, exponent) = crate::arithmetic::scaling::integer_and_exponent(m);
        let integer = i64::try_from(integer).unwrap();
        let integer = if m < 0.0 { -integer } else { integer };
        compare_root(&line(numbers), side, odd(Midpoint { integer, exponent }), None)
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
fn the_side_of_a_number_is_that_of_its_exact_offset() {
    let mut random = Random::new(7);
    let (mut certain, count) = (0, 4000);
    for round in 0..count {
        let mut numbers = lines_of_every_kind(&mut random);
        if round % 2 == 0 {
            // A sphere of half an ulp of the distance, whose center is a number and whose root is midway, or close to it.
            let beside = 2_f64.powi(-random.integer(1..=60)) * U;
            numbers = [1.5, beside, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, U];
        }
        let exact = ExactChord::new(numbers);
        let Some([near, far]) = exact.roots() else { continue };
        {
            for root in [near, far] {
                let t = root.approximately();
                let (integer, exponent) = crate::arithmetic::scaling::integer_and_exponent(t);
                for above in [-1, 1] {
                    let integer = 2 * i64::try_from(integer).expect("53 bits") + above;
                    let integer = if t < 0.0 { -integer } else { integer };
                    let midpoint = Midpoint { integer, exponent: exponent - 1 };
                    #[expect(clippy::cast_precision_loss, reason = "two numbers of 53 bits")]
                    let number = &Dyadic::exactly(scale((integer - 1) as f64, exponent - 1))
                        + &Dyadic::exactly(scale(1.0, exponent - 1));
                    let offset = ExactLine::new(numbers).offset(&number);
                    let square = length_squared(&offset);
                    let expected = (&square - &exact.radius_squared()).sign();
                    if let Some(quadratic) = quadratic_at(&line(numbers), midpoint) {
                        assert_eq!(quadratic, expected, "{midpoint:?} {numbers:?}");
                        certain += 1;
                    }
                }
            }
        }
    }
    assert!(certain > 3 * count, "{certain} certain");
}

fn length_squared(vector: &[Dyadic; 3]) -> Dyadic {
    let [x, y, z] = [0, 1, 2].map(|axis: usize| &vector[axis] * &vector[axis]);
    &(&x + &y) + &z
}
