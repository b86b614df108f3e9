use glam::DVec3;

use super::*;
use crate::algebraic::Quadratic;
use crate::arithmetic::number::Triple;
use crate::geometric::ClosestApproach;
use crate::root::chord::Derivation;
use crate::root::tests::line;
use crate::root::{halves, plain_single};
use crate::testing::{Dyadic, ExactChord, Float, Lie, Random, part_of_bound, search, setting};

/// A ray, a sphere and how the plain arithmetic sees them.
struct Case {
    exact: ExactChord,
    chord: Chord<f64>,
    radius_squared: f64,
}

impl Case {
    /// From the coordinates of center, origin and direction, and the radius.
    fn new<D: Derivation>(numbers: [f64; 10]) -> Self {
        let line = line(numbers);
        let radius_squared = line.radius * line.radius;
        let o = Triple::from(line.center - line.origin);
        let chord = D::chord(o, line.direction.into(), radius_squared);
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

    /// The power, off by as much as it may be, to either side.
    fn worst_fine_power(&self, sign: i32) -> f64 {
        let error = &self.exact.larger() * &Dyadic::new(sign, -76);
        let power = &self.exact.power + &error;
        f64::nearest(&power)
    }

    /// What part of its bound the error of the nearest root ahead takes, after a look at whether that is the right answer.
    fn nearest(&self, clear: f64, fine_power: Option<f64>) -> Option<f64> {
        let inside = self.exact.power.is_negative();
        match nearest_ahead(&self.chord, self.radius_squared, clear, || fine_power) {
            Nearest::Doubt => None,
            Nearest::Miss => {
                assert!(!inside, "there is a root ahead from inside");
                let misses = self.exact.discriminant.is_negative();
                assert!(misses || self.exact.h.is_negative(), "there is a root ahead");
                Some(0.0)
            }
            Nearest::Root { t, half_chord } => {
                assert_eq!(half_chord < 0.0, inside, "a ray leaves where it starts inside");
                let exact =
                    self.exact.roots().expect("there is no root")[usize::from(inside)].clone();
                assert!(!exact.is_negative(), "the root is behind");
                Some(Self::part(t, &exact, ROOT_ERROR / clear, &exact))
            }
        }
    }

    /// The same where the power has to be finer than the plain one.
    fn nearest_by_a_fine_power(&self, clear: f64) -> Option<f64> {
        if let Nearest::Root { .. } =
            nearest_ahead(&self.chord, self.radius_squared, clear, || None)
        {
            return None;
        }
        let parts = [-1, 1].map(|sign| self.nearest(clear, Some(self.worst_fine_power(sign))));
        parts.into_iter().flatten().reduce(f64::max)
    }

    /// The same of both roots: the larger part.
    fn both(&self, clear: f64) -> Option<f64> {
        match both(&self.chord, self.radius_squared, clear, || None) {
            Both::Doubt => None,
            Both::Miss => {
                assert!(self.exact.discriminant.is_negative(), "the line hits");
                Some(0.0)
            }
            Both::Roots { t, half_chord } => {
                assert!(half_chord > 0.0);
                let exact = self.exact.roots().expect("the line misses");
                let parts = [0, 1].map(|side: usize| {
                    let size = exact[side].clone().abs();
                    Self::part(t[side], &exact[side], ROOT_ERROR / clear, &size)
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

/// The two parts `clear` that there are, and the largest allowed.
const CLEARS: [f64; 3] = [plain_single::CLEAR, halves::CLEAR, 1.0 / 256.0];

/// From where the bounds of relative errors are largest: as little clear of doubt as may be.
fn almost_in_doubt(clear: f64) -> [Lie; 4] {
    [
        // Where both the power and the discriminant count.
        Lie { power: 2.42 * clear, discriminant: 2.42 * clear },
        Lie { power: -1.01 * clear, discriminant: 1.02 * clear },
        // Where the discriminant alone does, close to the limb.
        Lie { power: 0.5, discriminant: 2.1 * clear * clear },
        Lie { power: 0.9, discriminant: 1.2 * clear * clear },
    ]
}

const ANYWHERE: [Lie; 5] = [
    Lie { power: 1.0, discriminant: -0.01 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: -1e-10, discriminant: 0.5 },
    Lie { power: -0.9, discriminant: 0.95 },
];

#[test]
fn the_constants_are_those_of_the_analysis() {
    assert_eq!(
        [DISCRIMINANT_ERROR, POWER_ERROR, ROOT_ERROR, SURE_MISS, SURE_SIGN],
        [21.0, 7.0, 18.0, 22.0, 8.0].map(|count| count * U)
    );
}

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
    for clear in CLEARS {
        let lies = &almost_in_doubt(clear);
        let part = |case: &Case| case.nearest(clear, None);
        assert!(search_chords::<Quadratic>("nearest root, algebraic", lies, part) > 0.1);
        assert!(search_chords::<ClosestApproach>("nearest root, geometric", lies, part) > 0.1);
    }
}

#[test]
fn both_roots_keep_their_bound() {
    for clear in CLEARS {
        let lies = &almost_in_doubt(clear);
        let part = |case: &Case| case.both(clear);
        assert!(search_chords::<Quadratic>("both roots, algebraic", lies, part) > 0.06);
        assert!(search_chords::<ClosestApproach>("both roots, geometric", lies, part) > 0.06);
    }
}

#[test]
fn roots_by_a_finer_power_keep_their_bound() {
    let clear = plain_single::CLEAR;
    let lies = [
        // As small as the power may be, and a good deal smaller.
        Lie { power: 1.1 * FINE_POWER, discriminant: 0.51 * clear },
        Lie { power: -1.1 * FINE_POWER, discriminant: 0.51 * clear },
        Lie { power: FINE_POWER / 33.0, discriminant: 0.51 * clear },
        Lie { power: -FINE_POWER / 33.0, discriminant: 0.51 * clear },
        Lie { power: 1e-9, discriminant: 0.51 * clear },
        Lie { power: 1e-7, discriminant: 0.5 },
        Lie { power: -1e-7, discriminant: 0.5 },
    ];
    let part = |case: &Case| case.nearest_by_a_fine_power(clear);
    assert!(search_chords::<Quadratic>("root by a finer power", &lies, part) > 0.15);
}

#[test]
fn a_finer_power_is_asked_only_close_to_the_surface() {
    let asked = |lie: Lie| {
        let mut asked = 0;
        let case = Case::new::<Quadratic>(setting(&mut Random::new(1), lie));
        let _ = nearest_ahead(&case.chord, case.radius_squared, plain_single::CLEAR, || {
            asked += 1;
            None
        });
        asked
    };
    for (power, discriminant, count) in [
        (1e-9, 0.5, 1),
        (-1e-9, 0.5, 1),
        (0.5, 0.3, 0),
        (-0.5, 0.7, 0),
        (0.5, 1e-14, 0),
        (-1e-14, 1e-13, 0),
    ] {
        let found = asked(Lie { power, discriminant });
        assert!(found == count || (power < 0.0 && found == 0), "{power} {discriminant}: {found}");
    }
}

#[test]
fn signs_of_powers_are_certain() {
    // From the surface, or as little to one side as can be, the power that looks most like one from the other side.
    let lies = [1e-17, 1e-16].map(|power| Lie { power, discriminant: 0.5 });
    let part = |case: &Case| {
        let certain = SURE_SIGN * case.radius_squared;
        let is_case = !case.exact.power.is_negative();
        Some(if is_case { -case.chord.power / certain } else { f64::NEG_INFINITY })
    };
    assert!(search_chords::<Quadratic>("sign of a power from outside", &lies, part) > 0.2);
    let lies = [-1e-17, -1e-16].map(|power| Lie { power, discriminant: 0.5 });
    let part = |case: &Case| {
        let certain = SURE_SIGN * case.chord.distance_squared;
        let is_outside = !case.exact.power.is_negative() && !case.exact.power.is_zero();
        Some(if is_outside { f64::NEG_INFINITY } else { case.chord.power / certain })
    };
    assert!(search_chords::<Quadratic>("sign of a power from inside", &lies, part) > 0.15);
}

#[test]
fn misses_are_certain() {
    // Lines that touch or nearly so, and the discriminant that looks most like that of a miss.
    let lies = [
        Lie { power: 0.5, discriminant: 1e-17 },
        Lie { power: 0.99, discriminant: 1e-16 },
        Lie { power: 1e-3, discriminant: 1e-16 },
    ];
    let part = |case: &Case| {
        let certain = SURE_MISS * (case.chord.a * case.chord.distance_squared);
        let is_case = !case.exact.discriminant.is_negative();
        Some(if is_case { -case.chord.discriminant / certain } else { f64::NEG_INFINITY })
    };
    assert!(search_chords::<Quadratic>("miss, algebraic", &lies, part) > 0.1);
    assert!(search_chords::<ClosestApproach>("miss, geometric", &lies, part) > 0.05);
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
        let _ = case.nearest(plain_single::CLEAR, None);
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
    for round in 0..3000 {
        let [x, y] =
            [0; 2].map(|_| 2_f64.powi(random.integer(-53..=-1)) * random.mantissa().sqrt() / 2.0);
        let numbers = match random.below(4) {
            0 => setting(&mut random, lie(x, y)),
            1 => setting(&mut random, lie(-x, x.max(y))),
            2 => setting(&mut random, lie(x, -y.min(1.0 - x))),
            _ => setting(&mut random, lie(-x.min(y), y)),
        };
        let clear = CLEARS[round % 3];
        for case in [Case::new::<Quadratic>(numbers), Case::new::<ClosestApproach>(numbers)] {
            assert!(case.nearest(clear, None).unwrap_or(0.0) <= 1.0, "{numbers:?}");
            // What asks for such a power has that `clear`.
            let by_a_fine_power = case.nearest_by_a_fine_power(plain_single::CLEAR);
            assert!(by_a_fine_power.unwrap_or(0.0) <= 1.0, "{numbers:?}");
            assert!(case.both(clear).unwrap_or(0.0) <= 1.0, "{numbers:?}");
        }
    }
}

#[test]
fn odd_arguments_are_no_hits() {
    let case = |o: DVec3, d: DVec3, radius_squared: f64| {
        let chord = Quadratic::chord(Triple::from(o), Triple::from(d), radius_squared);
        let nearest = nearest_ahead(&chord, radius_squared, plain_single::CLEAR, || Some(f64::NAN));
        let both = both(&chord, radius_squared, plain_single::CLEAR, || None);
        // A root that is not finite is none.
        let (is_hit, is_doubt) = match nearest {
            Nearest::Root { t, .. } => (t.is_finite(), !t.is_finite()),
            Nearest::Miss => (false, false),
            Nearest::Doubt => (false, true),
        };
        (is_hit, matches!(both, Both::Roots { .. }), is_doubt, matches!(both, Both::Doubt))
    };
    for (o, d, radius_squared) in [
        (DVec3::NAN, DVec3::X, 1.0),
        (DVec3::Y, DVec3::NAN, 1.0),
        (DVec3::Y, DVec3::X, f64::NAN),
        (DVec3::INFINITY, DVec3::X, 1.0),
        (DVec3::Y, DVec3::INFINITY, 1.0),
        (DVec3::Y, DVec3::X, f64::INFINITY),
        (DVec3::Y, DVec3::ZERO, 1.0),
        (DVec3::ZERO, DVec3::ZERO, 0.0),
    ] {
        let (nearest, both, _, is_doubt) = case(o, d, radius_squared);
        assert!(!nearest && !both && is_doubt, "{o} {d} {radius_squared}");
    }
    // Outside, a zero direction is as good as a miss.
    let (nearest, both, ..) = case(DVec3::Y, DVec3::ZERO, 0.25);
    assert!(!nearest && !both);
    for o in [DVec3::ZERO, DVec3::X, DVec3::new(3.0, 0.1, 0.0)] {
        let (nearest, both, ..) = case(o, DVec3::X, -1.0);
        assert!(!nearest && !both, "{o}");
    }
}

#[test]
fn units_of_length_and_of_the_direction_change_nothing() {
    let lies = [
        Lie { power: 0.5, discriminant: 0.3 },
        Lie { power: 0.5, discriminant: 1e-13 },
        Lie { power: 0.5, discriminant: -1e-13 },
        Lie { power: 0.5, discriminant: 3e-15 },
        Lie { power: 1e-9, discriminant: 0.5 },
        Lie { power: -1e-9, discriminant: 0.5 },
        Lie { power: 1e-14, discriminant: 1e-13 },
        Lie { power: -0.5, discriminant: 0.7 },
    ];
    let mut random = Random::new(7);
    for _ in 0..2000 {
        let lie = lies[random.below(lies.len())];
        let numbers = setting(&mut random, lie);
        let [lengths, directions] = [0; 2].map(|_| random.integer(-60..=60));
        let mut scaled = numbers;
        for (index, number) in scaled.iter_mut().enumerate() {
            *number *= 2_f64.powi(if (6..9).contains(&index) { directions } else { lengths });
        }
        let [here, there] = [numbers, scaled].map(Case::new::<Quadratic>);
        let ask = |case: &Case, power: f64| {
            nearest_ahead(&case.chord, case.radius_squared, plain_single::CLEAR, || Some(power))
        };
        let power = here.worst_fine_power(1);
        let in_units = |t: f64| t * 2_f64.powi(lengths - directions);
        let same = match (ask(&here, power), ask(&there, power * 2_f64.powi(2 * lengths))) {
            (Nearest::Miss, Nearest::Miss) | (Nearest::Doubt, Nearest::Doubt) => true,
            (Nearest::Root { t, .. }, Nearest::Root { t: found, .. }) => in_units(t) == found,
            _ => false,
        };
        assert!(same, "2^{lengths} 2^{directions} {numbers:?}");
        let same = match (
            both(&here.chord, here.radius_squared, plain_single::CLEAR, || None),
            both(&there.chord, there.radius_squared, plain_single::CLEAR, || None),
        ) {
            (Both::Miss, Both::Miss) | (Both::Doubt, Both::Doubt) => true,
            (Both::Roots { t, .. }, Both::Roots { t: found, .. }) => t.map(in_units) == found,
            _ => false,
        };
        assert!(same, "2^{lengths} 2^{directions} {numbers:?}");
    }
}

#[test]
fn clear_cases_are_not_in_doubt() {
    let mut random = Random::new(8);
    for (power, discriminant) in [(0.5, -1e-3), (0.5, -1e-14), (0.9, -1e-10)] {
        for _ in 0..100 {
            let numbers = setting(&mut random, Lie { power, discriminant });
            for case in [Case::new::<Quadratic>(numbers), Case::new::<ClosestApproach>(numbers)] {
                let Case { chord, radius_squared, .. } = case;
                let nearest = nearest_ahead(&chord, radius_squared, plain_single::CLEAR, || None);
                assert!(matches!(nearest, Nearest::Miss), "{numbers:?}");
                let both = both(&chord, radius_squared, plain_single::CLEAR, || None);
                assert!(matches!(both, Both::Miss), "{numbers:?}");
            }
        }
    }
}
