use super::*;
use crate::testing::{Dyadic, Random, exactly, part_of_bound, search, total};

/// 2⁻¹⁰⁵, what a sum may be off by relative to itself: it is cut off after 106 bits. Its users rely on 2⁻⁹⁶.
fn value_error() -> Dyadic {
    Dyadic::new(1, -105)
}

fn number(wide: Wide) -> Dyadic {
    exactly(wide.scaled(-wide.exponent())).scaled(wide.exponent().into())
}

/// A sum of products, and the same by the oracle.
/// Adds `times` the product of four factors.
fn add(sum: &mut Sum, times: i64, [a, b, c, d]: [Factor; 4]) {
    sum.add(times, [a * b, c * d]);
}

#[derive(Default)]
struct Both {
    terms: Vec<(i64, [f64; 4])>,
}

impl Both {
    fn sum(&self) -> Sum {
        let mut sum = Sum::zero();
        for (times, factors) in &self.terms {
            add(&mut sum, *times, factors.map(Factor::from));
        }
        sum
    }

    fn exact(&self) -> Dyadic {
        total(self.terms.iter().map(|(times, factors)| {
            factors.iter().fold(Dyadic::new(*times, 0), |product, factor| {
                &product * &Dyadic::exactly(*factor)
            })
        }))
    }

    fn check(&self) {
        let exact = self.exact();
        let value = self.sum().value();
        assert_eq!(self.sum().sign(), exact.sign(), "{:?}", self.terms);
        assert_eq!(value.is_zero(), exact.is_zero(), "{:?}", self.terms);
        assert_eq!(value.is_negative(), exact.is_negative(), "{:?}", self.terms);
        let bound = &value_error() * &exact.clone().abs();
        assert!(part_of_bound(&number(value), &exact, &bound) <= 1.0, "{:?}", self.terms);
        if !exact.is_zero() {
            assert_eq!(i64::from(value.exponent()), exact.magnitude(), "{:?}", self.terms);
        }
    }
}

fn random_times(random: &mut Random) -> i64 {
    [1, -1, 2, -2][random.below(4)]
}

#[test]
fn sums_over_the_whole_range_are_exact() {
    let mut random = Random::new(1);
    for _ in 0..300 {
        let mut both = Both::default();
        for _ in 0..=random.below(12) {
            let factors = [0; 4].map(|_| random.any_float());
            both.terms.push((random_times(&mut random), factors));
        }
        both.check();
    }
}

#[test]
fn sums_of_few_exponents_are_exact() {
    let mut random = Random::new(2);
    for _ in 0..1000 {
        let exponents = -random.integer(0..=70)..=0;
        let mut both = Both::default();
        for _ in 0..=random.below(30) {
            let factors = [0; 4].map(|_| random.float(exponents.clone()));
            both.terms.push((random_times(&mut random), factors));
        }
        both.check();
    }
}

#[test]
fn what_cancels_leaves_the_rest() {
    let mut random = Random::new(3);
    for _ in 0..300 {
        let mut both = Both::default();
        for _ in 0..=random.below(6) {
            let [a, b, c, d] = [0; 4].map(|_| random.any_float());
            both.terms.push((1, [a, b, c, d]));
            both.terms.push((-1, [d, c, -a, -b]));
        }
        both.check();
        let rest = [0; 4].map(|_| random.any_float());
        both.terms.insert(random.below(both.terms.len()), (random_times(&mut random), rest));
        both.check();
    }
}

#[test]
fn the_ends_of_the_range_fit() {
    let (large, small) = (f64::MAX, f64::from_bits(1));
    for factor in [large, -large, small, -small] {
        for times in [1, -1, 2, -2] {
            let mut both = Both::default();
            for terms in 1..=40 {
                both.terms.push((times, [factor, large, large, large]));
                both.terms.push((times, [factor, small, small, small]));
                if terms % 13 == 1 {
                    both.check();
                }
            }
        }
    }
    // Numbers from the whole range, and a subnormal one among them.
    let least = Both { terms: vec![(1, [small; 4]), (-1, [small, small, small, 0.0])] };
    least.check();
    assert_eq!(least.sum().value().exponent(), -4296);
    Both::default().check();
}

#[test]
fn many_terms_carry() {
    let mut up = Both::default();
    for _ in 0..3000 {
        up.terms.push((2, [f64::MAX, f64::MAX, 1.0 - f64::EPSILON / 2.0, -1.0]));
    }
    up.check();
    up.terms.push((1, [f64::MAX, f64::MAX, 6000.0, 1.0]));
    up.check();
}

#[test]
fn sums_of_many_are_longer_than_their_terms() {
    // The longest product, shifted as far as it can be within a digit.
    let ones = 2.0 - f64::EPSILON;
    let factors = [ones * 2_f64.powi(15), ones, ones, ones];
    for times in [2, -2] {
        let mut sum = Sum::zero();
        for _ in 0..20_000 {
            add(&mut sum, times, factors.map(Factor::from));
        }
        let exact = Both { terms: vec![(20_000 * times, factors)] }.exact();
        let value = sum.value();
        assert_eq!(i64::from(value.exponent()), exact.magnitude());
        let bound = &value_error() * &exact.clone().abs();
        assert!(part_of_bound(&number(value), &exact, &bound) <= 1.0);
    }
}

#[test]
fn values_of_sums_keep_their_bound() {
    // A leading digit of 1, and below the 106 bits kept nothing but ones.
    let start =
        |random: &mut Random| [32.0, -20.0, -73.5].map(|e| 2_f64.powf(e) * random.mantissa());
    let worst = search("value of a sum", 50, 100, start, |[a, b, c]| {
        let both = Both { terms: [a, b, c].map(|x| (1, [x, 1.0, 1.0, 1.0])).into() };
        let exact = both.exact();
        Some(part_of_bound(&number(both.sum().value()), &exact, &(&value_error() * &exact)))
    });
    assert!(worst > 0.9);
}

/// A factor of up to 54 bits, and the same by the oracle.
fn random_factor(random: &mut Random) -> (Factor, Dyadic) {
    if random.below(2) == 0 {
        let x = random.any_float();
        return (x.into(), Dyadic::exactly(x));
    }
    let ones = (1_u64 << 54) - 1;
    let magnitude = match random.below(3) {
        0 => ones,
        1 => random.bits() >> 10 | 1 << 53,
        _ => random.bits() >> 10 >> random.below(54),
    };
    let integer = i64::try_from(magnitude).unwrap() * if random.below(2) == 0 { 1 } else { -1 };
    let exponent = random.integer(-1075..=970);
    (Factor::new(integer, exponent), Dyadic::new(integer, exponent.into()))
}

#[test]
fn factors_of_54_bits_are_exact() {
    let mut random = Random::new(6);
    for _ in 0..2000 {
        let mut sum = Sum::zero();
        let mut exact = Dyadic::ZERO;
        for _ in 0..=random.below(8) {
            let times = random_times(&mut random);
            let factors = [0; 4].map(|_| random_factor(&mut random));
            add(&mut sum, times, [0, 1, 2, 3].map(|index: usize| factors[index].0));
            let product =
                factors.iter().fold(Dyadic::new(times, 0), |product, (_, x)| &product * x);
            exact = &exact + &product;
        }
        assert_eq!(sum.sign(), exact.sign());
        let bound = &value_error() * &exact.clone().abs();
        assert!(part_of_bound(&number(sum.value()), &exact, &bound) <= 1.0);
    }
}

#[test]
fn the_largest_factors_reach_the_fifth_digit() {
    // 216 bits of the product and a shift by each of the places in a digit.
    let ones = Factor::new((1 << 54) - 1, 0);
    for exponent in 0..64 {
        for times in [1, -1, 2, -2] {
            let mut sum = Sum::zero();
            let last = Factor::new((1 << 54) - 1, exponent);
            add(&mut sum, times, [ones, ones, ones, last]);
            let integer = Dyadic::new((1_i64 << 54) - 1, 0);
            let fourth = &(&integer * &integer) * &(&integer * &integer);
            let exact = (&fourth * &Dyadic::new(times, 0)).scaled(exponent.into());
            let bound = &value_error() * &exact.clone().abs();
            assert!(part_of_bound(&number(sum.value()), &exact, &bound) <= 1.0);
            // Less what it was rounded to, its rest is exact still.
            let rounded = sum.value();
            let unit = rounded.exponent();
            let pair = rounded.scaled(-unit);
            let mut rest = exact.clone();
            for part in [pair.hi, pair.lo] {
                add(&mut sum, -1, [part, 2_f64.powi(unit), 1.0, 1.0].map(Factor::from));
                rest = &rest - &Dyadic::exactly(part).scaled(unit.into());
            }
            assert_eq!(sum.sign(), rest.sign());
            let bound = &value_error() * &rest.clone().abs();
            assert!(part_of_bound(&number(sum.value()), &rest, &bound) <= 1.0);
        }
    }
}

#[test]
fn one_is_one() {
    let mut sum = Sum::zero();
    add(&mut sum, 1, [Factor::ONE; 4]);
    assert_eq!(number(sum.value()), Dyadic::new(1, 0));
    add(&mut sum, -1, [Factor::ONE; 4]);
    assert!(sum.value().is_zero());
    // Nothing is added, not even of a product of a zero.
    add(&mut sum, 1, [Factor::ONE, Factor::new(0, 5), Factor::ONE, Factor::ONE]);
    assert!(sum.used.is_empty() || sum.sign().is_eq());
}

#[test]
fn a_carry_runs_through_all_digits() {
    // Blocks of 54 ones, and one more, which leaves a single bit.
    for times in [1, -1] {
        for first in 0..64 {
            let mut sum = Sum::zero();
            for block in 0..15 {
                let ones = Factor::new((1 << 54) - 1, first + 54 * block);
                add(&mut sum, times, [ones, Factor::ONE, Factor::ONE, Factor::ONE]);
            }
            let one = Factor::new(1, first);
            add(&mut sum, times, [one, Factor::ONE, Factor::ONE, Factor::ONE]);
            assert_eq!(number(sum.value()), Dyadic::new(times, i64::from(first) + 54 * 15));
        }
    }
}

#[test]
fn terms_are_combined_exactly_where_they_fit() {
    let mut random = Random::new(9);
    let (mut fits, mut apart) = (0, 0);
    for _ in 0..5000 {
        // Of any bits, next to each other or far apart.
        let span = random.integer(0..=90);
        let terms = [0; 4].map(|_| {
            let (integer, other) = (random_factor(&mut random).0, random_factor(&mut random).0);
            let zero = random.below(8) == 0;
            Term::new(if zero { 0 } else { (integer * other).integer }, random.integer(0..=span))
        });
        let exact = |terms: [Term; 4]| {
            total(terms.map(|term| {
                let [high, low] = [term.integer >> 62, term.integer & ((1 << 62) - 1)]
                    .map(|part| i64::try_from(part).expect("124 bits and a sign"));
                let exponent = i64::from(term.exponent);
                &Dyadic::new(high, exponent + 62) + &Dyadic::new(low, exponent)
            }))
        };
        let combined = Term::combined(terms);
        assert_eq!(exact(combined), exact(terms), "{terms:?}");
        let count = |terms: [Term; 4]| terms.into_iter().filter(|term| !term.is_zero()).count();
        assert!(count(combined) <= count(terms), "{terms:?}");
        // First those that are not zero.
        let places = combined.map(|term| !term.is_zero());
        assert!(places.is_sorted_by(|a, b| a >= b), "{combined:?}");
        assert!(combined.iter().all(|term| term.integer.unsigned_abs() < 1 << Term::BITS));
        if span <= 12 {
            // 108 bits, 12 places and the sum of four.
            assert!(count(combined) <= 1, "{terms:?}");
            fits += 1;
        }
        apart += u32::from(count(combined) > 1);
    }
    assert!(fits > 500 && apart > 500, "{fits} fit, {apart} do not");
}
