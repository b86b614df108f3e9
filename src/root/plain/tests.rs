use glam::DVec3;

use super::*;
use crate::algebraic::Quadratic;
use crate::arithmetic::number::Triple;
use crate::chord::Derivation;
use crate::geometric::ClosestApproach;
use crate::testing::{Dyadic, ExactChord, Lie, Random, part_of_bound, search, setting};

/// A ray, a sphere and how the plain arithmetic sees them.
struct Case {
    exact: ExactChord,
    chord: Chord<f64>,
    radius_squared: f64,
}

impl Case {
    /// From the coordinates of center, origin and direction, and the radius.
    fn new<D: Derivation>(numbers: [f64; 10]) -> Self {
        let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = numbers;
        let o = DVec3::new(cx, cy, cz) - DVec3::new(px, py, pz);
        let d = Triple { x: dx, y: dy, z: dz };
        let radius_squared = radius * radius;
        let chord = D::chord(Triple::from(o), d, radius_squared);
        Self { exact: ExactChord::new(numbers), chord, radius_squared }
    }

    fn part(computed: f64, exact: &Dyadic, bound: f64, size: &Dyadic) -> f64 {
        part_of_bound(&Dyadic::exactly(computed), exact, &(&Dyadic::exactly(bound) * size))
    }

    /// What part of its bound the error of the discriminant takes.
    fn discriminant(&self) -> f64 {
        let size = &self.exact.a * &self.exact.larger();
        Self::part(self.chord.discriminant, &self.exact.discriminant, DISCRIMINANT_ERROR, &size)
    }

    fn power(&self) -> f64 {
        Self::part(self.chord.power, &self.exact.power, POWER_ERROR, &self.exact.larger())
    }

    /// What part of its bound the error of the nearest root ahead takes, after a look at whether that is the right answer.
    fn nearest(&self) -> Option<f64> {
        let inside = self.exact.power.is_negative();
        match nearest_ahead(&self.chord, self.radius_squared) {
            FirstTry::Doubt => None,
            FirstTry::Miss => {
                assert!(!inside, "there is a root ahead from inside");
                let misses = self.exact.discriminant.is_negative();
                assert!(misses || self.exact.h.is_negative(), "there is a root ahead");
                Some(0.0)
            }
            FirstTry::Root { numerator, denominator, half_chord } => {
                assert_eq!(half_chord < 0.0, inside, "a ray leaves where it starts inside");
                if !inside && self.exact.h.is_negative() {
                    assert!(numerator / denominator < 0.0, "there is no root ahead");
                    return Some(0.0);
                }
                let exact =
                    self.exact.roots().expect("there is no root")[usize::from(inside)].clone();
                assert!(!exact.is_negative(), "the root is behind");
                let size = exact.clone().abs();
                Some(Self::part(numerator / denominator, &exact, RELATIVE_ERROR, &size))
            }
        }
    }

    /// The same of both roots: the larger part.
    fn both(&self) -> Option<f64> {
        match both_roots(&self.chord, self.radius_squared) {
            BothRoots::Doubt => None,
            BothRoots::Miss => {
                assert!(self.exact.discriminant.is_negative(), "the line hits");
                Some(0.0)
            }
            BothRoots::Roots { t, half_chord } => {
                assert!(half_chord > 0.0);
                let exact = self.exact.roots().expect("the line misses");
                let parts = [0, 1].map(|side: usize| {
                    Self::part(t[side], &exact[side], RELATIVE_ERROR, &exact[side].clone().abs())
                });
                Some(parts[0].max(parts[1]))
            }
        }
    }
}

fn search_chords<D: Derivation>(
    what: &str,
    lies: &[Lie],
    part: impl Fn(&Case) -> Option<f64>,
) -> f64 {
    let start = |random: &mut Random| {
        let lie = lies[random.below(lies.len())];
        setting(random, lie)
    };
    search(what, 60, 250, start, |numbers| part(&Case::new::<D>(numbers)))
}

/// From where the bounds of relative errors are largest: as little clear of doubt as may be.
const ALMOST_IN_DOUBT: [Lie; 2] = [
    Lie { power: 1.01 * CLEAR, discriminant: 1.01 * CLEAR },
    Lie { power: -1.01 * CLEAR, discriminant: 1.02 * CLEAR },
];

const ANYWHERE: [Lie; 5] = [
    Lie { power: 1.0, discriminant: -0.01 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: -1e-10, discriminant: 0.5 },
    Lie { power: -0.9, discriminant: 0.95 },
];

#[test]
fn discriminants_keep_their_bound() {
    let part = |case: &Case| Some(case.discriminant());
    assert!(search_chords::<Quadratic>("discriminant, algebraic", &ANYWHERE, part) > 0.25);
    assert!(search_chords::<ClosestApproach>("discriminant, geometric", &ANYWHERE, part) > 0.25);
}

#[test]
fn powers_keep_their_bound() {
    let part = |case: &Case| Some(case.power());
    assert!(search_chords::<Quadratic>("power", &ANYWHERE, part) > 0.25);
}

#[test]
fn nearest_roots_keep_their_bound() {
    let lies = &ALMOST_IN_DOUBT;
    assert!(search_chords::<Quadratic>("nearest root, algebraic", lies, Case::nearest) > 0.125);
    assert!(
        search_chords::<ClosestApproach>("nearest root, geometric", lies, Case::nearest) > 0.125
    );
}

#[test]
fn both_roots_keep_their_bound() {
    let lies = &ALMOST_IN_DOUBT
        .map(|lie| Lie { power: 2.0 * lie.power, discriminant: 2.0 * lie.discriminant });
    assert!(search_chords::<Quadratic>("both roots, algebraic", lies, Case::both) > 0.06);
    assert!(search_chords::<ClosestApproach>("both roots, geometric", lies, Case::both) > 0.06);
}

#[test]
fn signs_of_powers_are_certain() {
    // From the surface, or as little outside as can be, the power that looks most like one from inside.
    let lies = [1e-17, 1e-16].map(|power| Lie { power, discriminant: 0.5 });
    let part = |case: &Case| {
        let certain = SIGN_CERTAIN * case.radius_squared;
        (!case.exact.power.is_negative()).then_some(-case.chord.power / certain)
    };
    assert!(search_chords::<Quadratic>("sign of a power", &lies, part) > 0.2);
}

#[test]
fn a_wrong_sign_of_the_closest_approach_does_no_harm() {
    // At right angles to the center as nearly as can be, what looks most like a center behind and is not.
    const H_ERROR: f64 = 4.0 * U;
    let start = |random: &mut Random| {
        let mut numbers = setting(random, Lie { power: 1e-15, discriminant: -1e-15 });
        let [cx, cy, cz, px, py, pz, dx, dy, ..] = numbers;
        numbers[8] = -((cx - px) * dx + (cy - py) * dy) / (cz - pz);
        numbers
    };
    let part = |numbers| {
        let case = Case::new::<Quadratic>(numbers);
        let _ = case.nearest();
        let Chord { a, h, distance_squared, .. } = case.chord;
        (!case.exact.h.is_negative()).then_some(-h / (H_ERROR * (a * distance_squared).sqrt()))
    };
    assert!(search("sign of the closest approach", 300, 100, start, part) > 0.05);
}

#[test]
fn what_is_certain_is_right() {
    // Signs of the power and of the discriminant, down to their errors.
    let lie = |power: f64, discriminant: f64| Lie { power, discriminant };
    let mut random = Random::new(1);
    for _ in 0..3000 {
        let [x, y] =
            [0; 2].map(|_| 2_f64.powi(random.integer(-53..=-1)) * random.mantissa().sqrt() / 2.0);
        let numbers = match random.below(4) {
            0 => setting(&mut random, lie(x, y)),
            1 => setting(&mut random, lie(-x, x.max(y))),
            2 => setting(&mut random, lie(x, -y.min(1.0 - x))),
            _ => setting(&mut random, lie(-x.min(y), y)),
        };
        for case in [Case::new::<Quadratic>(numbers), Case::new::<ClosestApproach>(numbers)] {
            assert!(case.nearest().unwrap_or(0.0) <= 1.0, "{numbers:?}");
            assert!(case.both().unwrap_or(0.0) <= 1.0, "{numbers:?}");
        }
    }
}

#[test]
fn odd_arguments_are_no_hits() {
    let case = |o: DVec3, d: DVec3, radius_squared: f64| {
        let chord = Quadratic::chord(Triple::from(o), Triple::from(d), radius_squared);
        let nearest = nearest_ahead(&chord, radius_squared);
        let both = both_roots(&chord, radius_squared);
        (
            matches!(nearest, FirstTry::Root { .. }),
            matches!(both, BothRoots::Roots { .. }),
            matches!(nearest, FirstTry::Doubt),
            matches!(both, BothRoots::Doubt),
        )
    };
    for (o, d, radius_squared) in [
        (DVec3::NAN, DVec3::X, 1.0),
        (DVec3::Y, DVec3::NAN, 1.0),
        (DVec3::Y, DVec3::X, f64::NAN),
        (DVec3::INFINITY, DVec3::X, 1.0),
        (DVec3::Y, DVec3::INFINITY, 1.0),
        (DVec3::Y, DVec3::X, f64::INFINITY),
        (DVec3::Y, DVec3::ZERO, 1.0),
        (DVec3::Y, DVec3::ZERO, 0.25),
        (DVec3::ZERO, DVec3::ZERO, 0.0),
    ] {
        assert_eq!(
            case(o, d, radius_squared),
            (false, false, true, true),
            "{o} {d} {radius_squared}"
        );
    }
    for o in [DVec3::ZERO, DVec3::X, DVec3::new(3.0, 0.1, 0.0)] {
        let (nearest, both, ..) = case(o, DVec3::X, -1.0);
        assert!(!nearest && !both, "{o}");
    }
}
