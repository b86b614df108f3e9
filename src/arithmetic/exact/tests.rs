use super::*;
use crate::testing::{Dyadic, Random, exactly, nearest, part_of_bound, search, total};

/// 2⁻⁹⁶, what a sum may be off by relative to itself.
fn value_error() -> Dyadic {
    Dyadic::new(1, -96)
}

fn number(wide: Wide) -> Dyadic {
    exactly(wide.value).scaled(wide.exponent.into())
}

/// A sum of products, and the same by the oracle.
#[derive(Default)]
struct Both {
    terms: Vec<(i64, [f64; 4])>,
}

impl Both {
    fn sum(&self) -> Sum {
        let mut sum = Sum::zero();
        for (times, factors) in &self.terms {
            sum.add(*times, *factors);
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
            sum.add(times, factors);
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
    // A leading digit of 1, and below the 97 bits kept nothing but ones.
    let start =
        |random: &mut Random| [32.0, -20.0, -72.0].map(|e| 2_f64.powf(e) * random.mantissa());
    let worst = search("value of a sum", 50, 100, start, |[a, b, c]| {
        let both = Both { terms: [a, b, c].map(|x| (1, [x, 1.0, 1.0, 1.0])).into() };
        let exact = both.exact();
        Some(part_of_bound(&number(both.sum().value()), &exact, &(&value_error() * &exact)))
    });
    assert!(worst > 0.9);
}

/// A value of a sum of any exponent.
fn random_wide(random: &mut Random) -> Wide {
    let mut sum = Sum::zero();
    let factors = [0; 4].map(|_| random.any_float());
    sum.add(1, factors);
    sum.add(1, [factors[0], factors[1], factors[2], factors[3] * f64::EPSILON]);
    sum.value()
}

#[test]
fn wide_numbers_keep_the_bounds_of_pairs() {
    use crate::arithmetic::pair::{QUOTIENT_ERROR, ROOT_ERROR, SUM_ERROR};
    let mut random = Random::new(4);
    for _ in 0..2000 {
        let a = random_wide(&mut random);
        let mut b = random_wide(&mut random);
        if a.is_zero() || b.is_zero() {
            continue;
        }
        if random.below(2) == 0 {
            b.exponent = a.exponent + random.integer(-120..=120);
        }
        if random.below(4) == 0 {
            b = Wide { value: Pair { lo: b.value.lo, ..-a.value }, ..a };
        }
        let (x, y) = (number(a), number(b));
        assert_eq!(number(-a), -&x);

        let size = &x.clone().abs() + &y.clone().abs();
        let part = |computed, exact: &Dyadic, error, size: &Dyadic| {
            part_of_bound(&number(computed), exact, &(&Dyadic::exactly(error) * size))
        };
        assert!(part(a + b, &(&x + &y), SUM_ERROR, &size) <= 1.0, "{a:?} + {b:?}");
        let quotient = x.divided_by(&y, 240);
        let size = quotient.clone().abs();
        assert!(part(a / b, &quotient, QUOTIENT_ERROR, &size) <= 1.0, "{a:?} / {b:?}");
        let a = if a.is_negative() { -a } else { a };
        let root = number(a).square_root(240);
        assert!(part(a.sqrt(), &root, ROOT_ERROR, &root) <= 1.0, "square root of {a:?}");

        let middle = a.scaled(-a.exponent());
        assert!((1.0..=2.0).contains(&middle.hi), "{a:?}");
        assert_eq!(exactly(middle), number(a).scaled((-a.exponent()).into()));
    }
}

#[test]
fn wide_zero_is_zero() {
    let one = Both { terms: vec![(1, [1.0; 4])] }.sum().value();
    let zero = Sum::zero().value();
    assert!(zero.is_zero() && !zero.is_negative() && zero.sqrt().is_zero() && (-zero).is_zero());
    assert!((zero / one).is_zero() && (one + -one).is_zero());
    assert_eq!(number(one + zero), Dyadic::new(1, 0));
    assert_eq!(number(zero + one), Dyadic::new(1, 0));
    assert_eq!(zero.to_f64(), 0.0);
}

#[test]
fn wide_numbers_round_to_f64_once_where_normal() {
    let mut random = Random::new(5);
    for _ in 0..2000 {
        let mut wide = random_wide(&mut random);
        if wide.is_zero() {
            continue;
        }
        wide.exponent = random.integer(-1100..=1030);
        let (rounded, exact) = (wide.to_f64(), number(wide));
        if rounded.is_normal() || rounded.is_infinite() {
            assert_eq!(rounded, nearest(&exact, rounded), "{wide:?}");
        } else {
            // Rounded twice: by half a unit in the last place, and before that by very little.
            let error = (&Dyadic::exactly(rounded) - &exact).abs();
            assert!(error <= Dyadic::new((1_u64 << 40) + 1, -1075 - 40), "{wide:?}");
        }
    }
}
