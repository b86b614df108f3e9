use super::*;
use crate::root::tests::{ExactLine, line};
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
                    let found = compare(&line(numbers), side, axis, Midpoint { integer, exponent });
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
    let compare = |radius: f64| compare(&at(radius), Side::Near, 0, midpoint);
    // Of 512 places, 455 are those of lengths above the last of the radius, 53 of the direction, and 2 of sums.
    assert_eq!(compare(2_f64.powi(-400)), Some(Ordering::Greater));
    assert_eq!(compare(2_f64.powi(-403)), Some(Ordering::Greater));
    assert_eq!(compare(2_f64.powi(-404)), None);
    assert_eq!(compare(2_f64.powi(-1000)), None);
}
