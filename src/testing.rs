//! What the unit tests share: exact numbers, random ones, and a search for the worst case.

use std::ops::RangeInclusive;

use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

// The oracle and the families of the integration tests.
#[path = "../tests/support/mod.rs"]
pub(crate) mod support;

pub(crate) use support::dyadic::Dyadic;
pub(crate) use support::families;
pub(crate) use support::float::Float;
pub(crate) use support::oracle::Root;

use crate::arithmetic::pair::Pair;

/// The exact value of a pair.
pub(crate) fn exactly(pair: Pair) -> Dyadic {
    &Dyadic::exactly(pair.hi) + &Dyadic::exactly(pair.lo)
}

/// The sum of exact numbers.
pub(crate) fn total(terms: impl IntoIterator<Item = Dyadic>) -> Dyadic {
    terms.into_iter().fold(Dyadic::ZERO, |sum, term| &sum + &term)
}

/// The error of a computed value, divided by its bound.
pub(crate) fn part_of_bound(computed: &Dyadic, exact: &Dyadic, bound: &Dyadic) -> f64 {
    let error = (computed - exact).abs();
    if error.is_zero() {
        return 0.0;
    }
    assert!(!bound.is_zero(), "an error where there may be none");
    error.divided_by(bound, 64).approximately()
}

/// Random numbers, the same on every machine.
pub(crate) struct Random(Pcg32);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// An index below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % u64::try_from(count).unwrap()).unwrap()
    }

    pub(crate) fn integer(&mut self, range: RangeInclusive<i32>) -> i32 {
        let (low, high) = range.into_inner();
        low + i32::try_from(self.below(usize::try_from(high - low).unwrap() + 1)).unwrap()
    }

    /// Between 1 and 2: any bits, or a run of zeros or of ones behind a few.
    pub(crate) fn mantissa(&mut self) -> f64 {
        let (bits, run) = (self.bits() >> 12, (1_u64 << self.below(53)) - 1);
        f64::from_bits(
            1023 << 52
                | match self.below(4) {
                    0 => bits & !run,
                    1 => bits | run,
                    _ => bits,
                },
        )
    }

    /// 1 or -1.
    pub(crate) fn sign(&mut self) -> f64 {
        if self.bits() % 2 == 0 { 1.0 } else { -1.0 }
    }

    /// Of either sign, with an exponent in the range; `exponents` are those of normal numbers.
    pub(crate) fn float(&mut self, exponents: RangeInclusive<i32>) -> f64 {
        let exponent = self.integer(exponents);
        self.sign() * self.mantissa() * 2_f64.powi(exponent)
    }

    /// Any finite number.
    pub(crate) fn any_float(&mut self) -> f64 {
        loop {
            let x = f64::from_bits(self.bits());
            if x.is_finite() {
                return x;
            }
        }
    }

    /// The same with the last bits changed, a few of them or many.
    pub(crate) fn nudge(&mut self, x: f64) -> f64 {
        let bits = self.bits() >> 12 >> self.below(52);
        f64::from_bits(x.to_bits() ^ bits)
    }
}

/// Searches for the largest value of `part`, the error of a case divided by its bound, by hill climbing, and returns it.
///
/// `part` is `None` for numbers that are no case. Panics if a bound is exceeded.
pub(crate) fn search<const N: usize>(
    what: &str,
    climbs: u64,
    steps: usize,
    start: impl Fn(&mut Random) -> [f64; N],
    part: impl Fn([f64; N]) -> Option<f64>,
) -> f64 {
    let part = |case: [f64; N]| {
        let part = part(case).unwrap_or(0.0);
        assert!(part <= 1.0, "{what}: {part} of the bound at {case:?}");
        part
    };
    let mut worst = (0.0, [0.0; N]);
    for climb in 0..climbs {
        let mut random = Random::new(climb);
        let mut case = start(&mut random);
        let mut highest = part(case);
        for _ in 0..steps {
            let mut other = case;
            for _ in 0..=random.below(2) {
                let index = random.below(N);
                other[index] = random.nudge(other[index]);
            }
            let height = part(other);
            if height >= highest {
                (case, highest) = (other, height);
            }
        }
        if highest > worst.0 {
            worst = (highest, case);
        }
    }
    println!("{what}: {:.3} of the bound, at {:?}", worst.0, worst.1);
    worst.0
}

/// The chord of a line in a sphere, exactly.
pub(crate) struct ExactChord {
    pub(crate) a: Dyadic,
    pub(crate) h: Dyadic,
    pub(crate) distance_squared: Dyadic,
    pub(crate) power: Dyadic,
    pub(crate) discriminant: Dyadic,
}

impl ExactChord {
    /// From the coordinates of center, origin and direction, and the radius.
    pub(crate) fn new(numbers: [f64; 10]) -> Self {
        let numbers = numbers.map(Dyadic::exactly);
        let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = &numbers;
        let o = [cx - px, cy - py, cz - pz];
        let d = [dx, dy, dz];
        let a = total(d.map(|d| d * d));
        let h = total([0, 1, 2].map(|axis| d[axis] * &o[axis]));
        let distance_squared = total([0, 1, 2].map(|axis| &o[axis] * &o[axis]));
        let power = &distance_squared - &(radius * radius);
        let discriminant = &(&h * &h) - &(&a * &power);
        Self { a, h, distance_squared, power, discriminant }
    }

    pub(crate) fn radius_squared(&self) -> Dyadic {
        &self.distance_squared - &self.power
    }

    /// m, the larger of o·o and r².
    pub(crate) fn larger(&self) -> Dyadic {
        self.distance_squared.clone().max(self.radius_squared())
    }

    /// Both roots to some 300 bits, ascending.
    pub(crate) fn roots(&self) -> Option<[Dyadic; 2]> {
        if self.discriminant.is_negative() {
            return None;
        }
        let half_chord = self.discriminant.square_root(600);
        let root = |numerator: Dyadic| numerator.divided_by(&self.a, 600);
        Some([root(&self.h - &half_chord), root(&self.h + &half_chord)])
    }
}

/// The position of a ray relative to a sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lie {
    /// The power, in m: positive outside.
    pub(crate) power: f64,
    /// The discriminant, in a m: from outside, at most 1 less the power; from inside, at least as much as the power.
    pub(crate) discriminant: f64,
}

/// The coordinates of center, origin and direction, and the radius: all with many digits, and nearly in that position.
pub(crate) fn setting(random: &mut Random, lie: Lie) -> [f64; 10] {
    let unit = |random: &mut Random| DVec3::from([0; 3].map(|_| random.float(-2..=0))).normalize();
    let along = unit(random);
    let across = along.cross(unit(random)).normalize();
    let larger = random.mantissa();
    let (distance_squared, radius_squared) =
        if lie.power > 0.0 { (1.0, 1.0 - lie.power) } else { (1.0 + lie.power, 1.0) };
    let cos_squared = ((lie.discriminant + lie.power) / distance_squared).clamp(0.0, 1.0);
    let side = if lie.power > 0.0 { 1.0 } else { random.sign() };
    let direction = along * (side * cos_squared.sqrt()) + across * (1.0 - cos_squared).sqrt();
    let origin = DVec3::from([0; 3].map(|_| random.float(-4..=0)));
    let center = origin + along * (distance_squared.sqrt() * larger);
    let direction = direction * random.mantissa();
    let radius = radius_squared.sqrt() * larger;
    let [center, origin, direction] = [center, origin, direction].map(|v| v.to_array());
    let mut numbers = [radius; 10];
    for (number, coordinate) in
        numbers.iter_mut().zip([center, origin, direction].into_iter().flatten())
    {
        *number = coordinate;
    }
    numbers
}

/// Searches, as [`search`] does, from settings with these lies: of the exact chord and the numbers of each.
pub(crate) fn search_settings(
    what: &str,
    climbs: u64,
    steps: usize,
    lies: &[Lie],
    part: impl Fn(&ExactChord, [f64; 10]) -> Option<f64>,
) -> f64 {
    let start = |random: &mut Random| {
        let lie = lies[random.below(lies.len())];
        setting(random, lie)
    };
    search(what, climbs, steps, start, |numbers| part(&ExactChord::new(numbers), numbers))
}
