use std::cell::Cell;

use super::*;
use crate::root::tests::PointTolerance;
use crate::testing::{Dyadic, Float, Random, exactly};

/// An `f32` guess for [`nearest`].
fn nearest_f32(exact: &Dyadic) -> f64 {
    f32::nearest(exact).into()
}

/// The number of the format nearest to `exact`, ties to even.
fn expected(format: Format, exact: &Dyadic) -> f64 {
    match format {
        Format::F32 => nearest_f32(exact),
        Format::F64 => f64::nearest(exact),
    }
}

fn midway(number: Midpoint) -> Dyadic {
    assert!(number.integer % 2 != 0 && number.integer.unsigned_abs() < 1 << 54, "{number:?}");
    Dyadic::new(number.integer, number.exponent.into())
}

/// Midway between neighbors of the format: of any exponent, also beyond the largest number and below the smallest one.
fn midpoint(format: Format, random: &mut Random) -> Dyadic {
    let (digits, least, top) = match format {
        Format::F32 => (24, -149, 104),
        Format::F64 => (53, -1074, 971),
    };
    let first = 1_i64 << (digits - 1);
    let any = i64::try_from(random.bits() >> (65 - digits)).unwrap();
    let (integer, unit) = match random.below(8) {
        // Among the subnormal numbers, and their ends.
        0 => (any >> random.below(24), least),
        1 => ([0, 1, first - 1][random.below(3)], least),
        // The last of a power of two, and the first.
        2 => (2 * first - 1, random.integer(least..=top)),
        3 => (first, random.integer(least..=top)),
        // Between the largest number and infinity.
        4 => (2 * first - 1, top),
        _ => (first + any, random.integer(least..=top)),
    };
    let sign = if random.below(2) == 0 { 1 } else { -1 };
    Dyadic::new(sign * (2 * integer + 1), i64::from(unit) - 1)
}

/// A pair near an exact number, to at least 100 bits.
fn pair(exact: &Dyadic) -> Pair {
    let hi = f64::nearest(exact);
    let rest = exact - &Dyadic::exactly(hi);
    Pair { hi, lo: if rest.is_zero() { 0.0 } else { f64::nearest(&rest) } }
}

/// Rounds, and looks at whether the answer is right and at whether the question was needed.
fn check(format: Format, t: Pair, relative_error: f64, exact: &Dyadic) -> Option<f64> {
    let asked = Cell::new(false);
    let rounded = format.round(t, relative_error, |number| {
        asked.set(true);
        Some(exact.cmp(&midway(number)))
    });
    if let Some(rounded) = rounded {
        assert_eq!(rounded, expected(format, exact), "{format:?} {t:?} {relative_error:e}");
    }
    let size = Dyadic::exactly(t.hi).abs();
    let slack = size.clone().scaled(-50);
    let error = &(&Dyadic::exactly(relative_error) * &size) + &slack;
    let ends = [&exactly(t) - &error, &exactly(t) + &error].map(|end| expected(format, &end));
    // Where the ends round to the same, some units of an f64 farther out, there is nothing to ask.
    assert!(ends[0] != ends[1] || (rounded.is_some() && !asked.get()), "{format:?} {t:?}");
    rounded
}

#[test]
fn points_are_within_a_part_of_the_distance_and_of_the_radius() {
    let tolerances = [Format::F32, Format::F64].map(|format| {
        let PointTolerance { of_distance, of_radius } = format.point_tolerance();
        [of_distance, of_radius]
    });
    let power = |e| 2_f64.powi(e);
    assert_eq!(tolerances, [[power(-30), power(-24)], [power(-60), power(-53)]]);
}

#[test]
fn rounding_within_an_error_is_that_of_the_exact_value() {
    for format in [Format::F32, Format::F64] {
        let mut random = Random::new(1);
        let (mut decided, mut asked, count) = (0, 0, 20_000);
        for _ in 0..count {
            let middle = midpoint(format, &mut random);
            // In the middle of the range a pair loses nothing.
            let places = middle.magnitude();
            if places.abs() > 890 {
                continue;
            }
            let accuracy = match format {
                Format::F32 => random.integer(22..=100),
                Format::F64 => random.integer(52..=100),
            };
            let relative_error = 2_f64.powi(-accuracy) * random.mantissa();
            // Beside the midpoint by anything, or by a part of the error.
            let aside = -i64::from(random.integer(20..=110));
            let aside = middle.clone().scaled(aside);
            let aside = &aside * &Dyadic::new(random.integer(-1..=1), 0);
            let exact = &middle + &aside;
            let off = &exact * &Dyadic::exactly(relative_error * 0.99);
            let off = &off * &Dyadic::exactly(f64::from(random.integer(-8..=8)) / 8.0);
            let t = pair(&(&exact + &off));
            let rounded = check(format, t, relative_error, &exact);
            decided += u32::from(rounded.is_some());
            let exact_pair = pair(&exact);
            if check(format, exact_pair, 2_f64.powi(-96), &exact).is_some() {
                asked += 1;
            }
        }
        assert!(decided > count / 2 && asked > count / 2, "{format:?}: {decided} and {asked}");
    }
}

#[test]
fn ties_go_to_even() {
    for format in [Format::F32, Format::F64] {
        let mut random = Random::new(2);
        for _ in 0..5000 {
            let middle = midpoint(format, &mut random);
            if middle.magnitude().abs() > 890 {
                continue;
            }
            let asked = Cell::new(0);
            let rounded = format.round(pair(&middle), 2_f64.powi(-90), |number| {
                asked.set(asked.get() + 1);
                assert_eq!(midway(number), middle);
                Some(Ordering::Equal)
            });
            assert_eq!(rounded, Some(expected(format, &middle)));
            assert_eq!(asked.get(), 1);
            assert_eq!(format.round(pair(&middle), 2_f64.powi(-90), |_| None), None);
        }
    }
}

#[test]
fn what_may_be_several_numbers_is_not_rounded() {
    for (format, ulp) in [(Format::F32, f64::from(f32::EPSILON)), (Format::F64, f64::EPSILON)] {
        let ask = |t: f64, relative_error| {
            format.round(Pair::from(t), relative_error, |_| Some(Ordering::Less))
        };
        // To either side of 1.5, half an ulp is a third of it.
        assert_eq!(ask(1.5, ulp * 0.3), Some(1.5), "{format:?}");
        assert_eq!(ask(1.5, ulp * 0.4), None, "{format:?}");
        assert_eq!(ask(-1.5, ulp * 0.3), Some(-1.5), "{format:?}");
        assert_eq!(ask(-1.5, ulp * 0.4), None, "{format:?}");
        for odd in [0.25, 1.0, f64::INFINITY, f64::NAN] {
            assert_eq!(ask(1.5, odd), None, "{format:?}");
        }
        // Not even a zero is: only exact numbers are zero.
        for relative_error in [0.0, 0.2, 0.25, f64::NAN] {
            assert_eq!(ask(0.0, relative_error), None, "{format:?}");
        }
        // Nothing around zero has a sign for sure; a hundredth of the smallest number is zero anyway.
        assert_eq!(ask(f64::INFINITY, 1e-20), None);
    }
    let tiny = 1e-60;
    assert_eq!(Format::F32.round(tiny.into(), 0.1, |_| Some(Ordering::Less)), Some(0.0));
    assert_eq!(Format::F32.round((-tiny).into(), 0.1, |_| Some(Ordering::Less)), Some(0.0));
    assert_eq!(Format::F32.round(1e60.into(), 0.1, |_| Some(Ordering::Less)), Some(f64::INFINITY));
    assert_eq!(
        Format::F32.round((-1e60).into(), 0.1, |_| Some(Ordering::Less)),
        Some(f64::NEG_INFINITY)
    );
}

#[test]
fn from_zero_to_the_smallest_number_there_is_a_midpoint() {
    let half = 2_f64.powi(-150);
    for (sign, ordering, rounded) in [
        (1.0, Ordering::Less, 0.0),
        (1.0, Ordering::Equal, 0.0),
        (1.0, Ordering::Greater, 2.0 * half),
        (-1.0, Ordering::Less, -2.0 * half),
        (-1.0, Ordering::Equal, 0.0),
        (-1.0, Ordering::Greater, 0.0),
    ] {
        let found = Format::F32.round((sign * half).into(), 1e-20, |number| {
            assert_eq!(midway(number), Dyadic::exactly(sign * half));
            Some(ordering)
        });
        assert_eq!(found, Some(rounded), "{sign} {ordering:?}");
    }
}
