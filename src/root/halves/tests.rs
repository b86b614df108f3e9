use super::*;
use crate::algebraic::Quadratic;
use crate::arithmetic::number::Triple;
use crate::root::answer::Found;
use crate::root::chord::Derivation;
use crate::root::format::Format;
use crate::root::plain::{Both, both};
use crate::root::power::power_in_halves;
use crate::root::tests::{ExactLine, difference, length, line, parts_of_tolerance};
use crate::testing::{Dyadic, ExactChord, Float, Lie, exactly, part_of_bound};

/// A line and a sphere, and the roots of the first step.
struct Case {
    numbers: [f64; 10],
    line: Line,
    o: DVec3,
    chord: Chord<f64>,
    radius_squared: f64,
}

impl Case {
    fn new(numbers: [f64; 10]) -> Self {
        let line = line(numbers);
        let o = line.center - line.origin;
        let radius_squared = line.radius * line.radius;
        let chord = Quadratic::chord(Triple::from(o), line.direction.into(), radius_squared);
        Self { numbers, line, o, chord, radius_squared }
    }

    fn correction(&self) -> Correction {
        Correction::new(self.line, self.o, &self.chord, self.radius_squared)
    }

    fn larger(&self) -> f64 {
        self.chord.distance_squared.max(self.radius_squared)
    }

    /// The roots of the first step, and half the chord.
    fn roots(&self) -> Option<([f64; 2], f64)> {
        match both(&self.chord, self.radius_squared, CLEAR, || None) {
            Both::Roots { t, half_chord } => Some((t, half_chord)),
            _ => None,
        }
    }
}

fn search_settings(
    what: &str,
    lies: &[Lie],
    part: impl Fn(&ExactChord, &Case) -> Option<f64>,
) -> f64 {
    let part = |exact: &ExactChord, numbers| part(exact, &Case::new(numbers));
    crate::testing::search_settings(what, 60, 200, lies, part)
}

const LIES: [Lie; 8] = [
    Lie { power: 0.99, discriminant: 1e-4 },
    Lie { power: 0.5, discriminant: 0.5 },
    Lie { power: 1e-4, discriminant: 1e-4 },
    Lie { power: -0.9, discriminant: 0.95 },
    Lie { power: 1e-4, discriminant: 0.9998 },
    Lie { power: -1e-4, discriminant: 0.9999 },
    // As little clear of doubt as may be.
    Lie { power: 3e-3, discriminant: 1e-4 },
    Lie { power: 0.5, discriminant: 1.5e-9 },
];

/// Where s t is as small as it may be, beside r √m.
const LEAST_WAY: [Lie; 4] = [
    Lie { power: 1e-3, discriminant: 0.999 },
    Lie { power: 0.5, discriminant: 1.1e-6 },
    Lie { power: 2.4e-3, discriminant: 2.4e-3 },
    Lie { power: -1e-3, discriminant: 0.002 },
];

#[test]
fn the_constants_are_those_of_the_analysis() {
    assert_eq!(RESIDUAL_ERROR, 2_f64.powi(-72));
    assert_eq!(SLOPE_ERROR, 2_f64.powi(-51));
    assert_eq!(OFFSET_ERROR, 2_f64.powi(-74));
    assert_eq!(ROOT_ERROR, 1.5 * 2_f64.powi(-62));
    assert_eq!(CLEAR_OF_RESIDUAL, 2_f64.powi(-20));
}

#[test]
fn powers_keep_their_bound() {
    let lies = [1e-3, -1e-3, 1e-10, -1e-10, 1e-12, 1e-16, -1e-18, 0.5, -0.5]
        .map(|power| Lie { power, discriminant: 0.5 });
    let part = |exact: &ExactChord, case: &Case| {
        let computed = Dyadic::exactly(power_in_halves(case.line, case.o, case.larger()));
        let rounding = &Dyadic::exactly(U) * &exact.power.clone().abs();
        let error = &(&computed - &exact.power).abs() - &rounding;
        let bound = exact.larger().scaled(-76);
        Some(error.max(Dyadic::ZERO).divided_by(&bound, 64).approximately())
    };
    assert!(search_settings("power from halves", &lies, part) > 0.03);
}

#[test]
fn corrected_roots_keep_their_bound() {
    let part = |exact: &ExactChord, case: &Case| {
        let (roots, half_chord) = case.roots()?;
        let expected = exact.roots().expect("this hits");
        let correction = case.correction();
        let size = case.radius_squared * case.larger();
        let parts = [0, 1].map(|side: usize| {
            let way = half_chord * roots[side];
            let corrected = correction.correct(roots[side]);
            let expected = &expected[side];
            if let Some(sure) = correction.correct_surely(roots[side], half_chord, size) {
                let correct = f64::nearest(expected);
                assert_eq!(sure.t.hi, correct, "{:?}", case.numbers);
            }
            if way * way <= CLEAR_OF_RESIDUAL * size {
                assert!(correction.correct_surely(roots[side], half_chord, size).is_none());
                return 0.0;
            }
            let bound = &Dyadic::exactly(ROOT_ERROR) * &expected.clone().abs();
            part_of_bound(&exactly(corrected.t), expected, &bound)
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("corrected root", &LIES, part) > 0.014);
    assert!(search_settings("corrected root, the least way", &LEAST_WAY, part) > 0.02);
}

#[test]
fn residuals_keep_their_bound() {
    // From the number nearest to a root, what is left after the correction is what the residual errs by, and the slope.
    let part = |exact: &ExactChord, case: &Case| {
        let expected = exact.roots()?;
        let half_chord = exact.discriminant.square_root(200);
        let radius = Dyadic::exactly(case.line.radius);
        let residual = &(&Dyadic::exactly(RESIDUAL_ERROR) * &radius)
            * &exact.larger().square_root(100).divided_by(&half_chord, 100);
        let slope = &(&Dyadic::exactly(SLOPE_ERROR) * &radius)
            * &exact.a.square_root(100).divided_by(&half_chord, 100);
        let parts = [0, 1].map(|side: usize| {
            let t = expected[side].approximately();
            let corrected = case.correction().correct(t);
            let step = (&Dyadic::exactly(t) - &expected[side]).abs();
            let bound = &residual + &(&slope * &step);
            part_of_bound(&exactly(corrected.t), &expected[side], &bound)
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("residual", &LIES, part) > 0.06);
}

#[test]
fn slopes_keep_their_bound() {
    let part = |exact: &ExactChord, case: &Case| {
        let (roots, _) = case.roots()?;
        let size = &exact.radius_squared().square_root(100) * &exact.a.square_root(100);
        let bound = &Dyadic::exactly(SLOPE_ERROR) * &size;
        let parts = roots.map(|t| {
            let Halves { high, low } = case.correction().correct(t).w;
            let computed = (high + low).dot(case.line.direction);
            let slope = &(&exact.a * &Dyadic::exactly(t)) - &exact.h;
            part_of_bound(&Dyadic::exactly(computed), &slope, &bound)
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("slope", &LIES, part) > 0.2);
}

#[test]
fn offsets_keep_their_bound() {
    let part = |exact: &ExactChord, case: &Case| {
        let (roots, _) = case.roots()?;
        let bound = &Dyadic::exactly(OFFSET_ERROR) * &exact.larger().square_root(100);
        let exact = ExactLine::new(case.numbers);
        let parts = roots.map(|t| {
            let Halves { high, low } = case.correction().correct(t).w;
            let w = [0, 1, 2]
                .map(|axis: usize| &Dyadic::exactly(high[axis]) + &Dyadic::exactly(low[axis]));
            let error = length(&difference(&w, &exact.offset(&Dyadic::exactly(t))));
            error.divided_by(&bound, 64).approximately()
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("offset", &LIES, part) > 0.06);
}

#[test]
fn points_keep_their_tolerance() {
    let part = |exact: &ExactChord, case: &Case| {
        let (roots, half_chord) = case.roots()?;
        let expected = exact.roots().expect("this hits");
        let size = case.radius_squared * case.larger();
        let parts = [0, 1].map(|side: usize| {
            let correction = case.correction();
            let Some(sure) = correction.correct_surely(roots[side], half_chord, size) else {
                return 0.0;
            };
            let (point, normal) = (sure.point(), sure.offset() / case.line.radius);
            let found = Found { t: sure.t.hi, point, normal };
            let tolerance = Format::F64.point_tolerance();
            let [point, normal] =
                parts_of_tolerance(case.numbers, &expected[side], &found, tolerance);
            point.max(normal)
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("point of a corrected root", &LIES, part) > 0.5);
    search_settings("point of a corrected root, the least way", &LEAST_WAY, part);
}
