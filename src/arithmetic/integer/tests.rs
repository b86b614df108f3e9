use super::*;
use crate::testing::{Dyadic, Random};

/// The digits as an exact number.
fn number(integer: &Integer) -> Dyadic {
    let magnitude = integer
        .digits()
        .iter()
        .rev()
        .fold(Dyadic::ZERO, |sum, digit| &sum.scaled(PLACES.into()) + &Dyadic::new(*digit, 0));
    if integer.is_negative() { -&magnitude } else { magnitude }
}

fn factor(random: &mut Random) -> Shifted {
    let bits = random.below(65);
    let magnitude = if bits == 0 { 0 } else { random.bits() >> (64 - bits) };
    // Sometimes all ones, whose products carry far.
    let magnitude =
        if random.below(4) == 0 && bits > 0 { u64::MAX >> (64 - bits) } else { magnitude };
    let places = u32::try_from(random.below(200)).unwrap();
    let integer = i64::try_from(magnitude / 2).unwrap();
    Shifted { integer: if random.below(2) == 0 { integer } else { -integer }, places }
}

fn exactly(Shifted { integer, places }: Shifted) -> Dyadic {
    Dyadic::new(integer, places.into())
}

#[test]
fn sums_of_products_are_exact() {
    let mut random = Random::new(1);
    let (mut signs, mut zeros) = ([0; 2], 0);
    for _ in 0..2000 {
        let mut memory = [[Digit::MAX; 40]; 3];
        let [a, b, sum] = &mut memory;
        let [mut a, mut b, mut sum] = [a, b, sum].map(|digits| Integer::new(digits));
        let factors = [(); 4].map(|()| factor(&mut random));
        a.add_number(factors[0]);
        a.add_number(factors[1]);
        b.add_number(factors[2]);
        let exact_a = &exactly(factors[0]) + &exactly(factors[1]);
        let exact_b = exactly(factors[2]);
        assert_eq!(number(&a), exact_a);
        assert_eq!(number(&b), exact_b);
        let mut exact = Dyadic::ZERO;
        for _ in 0..4 {
            let product = &exact_a * &exact_b;
            match random.below(4) {
                0 => {
                    sum.add(&a, &b);
                    exact = &exact + &product;
                }
                1 => {
                    sum.subtract(&a, &b);
                    exact = &exact - &product;
                }
                2 => {
                    sum.add_times(&a, factors[3]);
                    exact = &exact + &(&exact_a * &exactly(factors[3]));
                }
                _ => {
                    sum.add_times(&a, factors[3].negated());
                    exact = &exact - &(&exact_a * &exactly(factors[3]));
                }
            }
            assert_eq!(number(&sum), exact, "{factors:?}");
            assert_eq!(sum.is_negative(), exact.is_negative());
            assert_eq!(sum.is_zero(), exact.is_zero());
            signs[usize::from(exact.is_negative())] += 1;
            zeros += u32::from(exact.is_zero());
        }
        sum.clear();
        assert!(sum.is_zero() && !sum.is_negative());
        sum.add(&b, &b);
        assert_eq!(number(&sum), &exact_b * &exact_b);
    }
    assert!(signs[0] > 2000 && signs[1] > 2000 && zeros > 100, "{signs:?} {zeros}");
}

#[test]
fn the_leading_digits_are_within_3_u() {
    let mut random = Random::new(2);
    for _ in 0..2000 {
        let mut memory = [[0; 40]; 2];
        let [a, sum] = &mut memory;
        let [mut a, mut sum] = [a, sum].map(|digits| Integer::new(digits));
        a.add_number(factor(&mut random));
        sum.add_times(&a, factor(&mut random));
        sum.add_number(factor(&mut random));
        let ScaledFloat { value, exponent } = sum.to_scaled_float();
        let exact = number(&sum);
        let found = Dyadic::exactly(value).scaled(exponent.into());
        let bound = exact.clone().abs().scaled(-53);
        let bound = &bound + &bound.clone().scaled(1);
        assert!((&found - &exact).abs() <= bound, "{exact:?}");
        assert_eq!(exponent % 2, 0, "for square roots");
    }
    let nothing = Integer::new(&mut []).to_scaled_float();
    assert_eq!(nothing.value, 0.0);
}

#[test]
fn the_leading_106_bits_are_kept() {
    let mut random = Random::new(3);
    for _ in 0..5000 {
        let mut memory = [[0; 40]; 2];
        let [a, sum] = &mut memory;
        let [mut a, mut sum] = [a, sum].map(|digits| Integer::new(digits));
        a.add_number(factor(&mut random));
        a.add_number(factor(&mut random));
        sum.add_times(&a, factor(&mut random));
        let unit = random.integer(-5000..=5000);
        let (wide, exact) = (sum.to_scaled_pair(unit), number(&sum).scaled(unit.into()));
        assert_eq!(wide.is_zero(), exact.is_zero());
        if exact.is_zero() {
            continue;
        }
        assert_eq!(i64::from(wide.exponent()), exact.magnitude());
        let pair = wide.scaled(-wide.exponent());
        let found =
            &(&Dyadic::exactly(pair.hi) + &Dyadic::exactly(pair.lo)).scaled(wide.exponent().into());
        let error = if exact.is_negative() { found - &exact } else { &exact - found };
        assert!(!error.is_negative(), "{exact:?}");
        assert!(error < Dyadic::new(1, exact.magnitude() - 105), "{exact:?}");
    }
    assert!(Integer::new(&mut []).to_scaled_pair(3).is_zero());
}

#[test]
fn numbers_are_integers_of_their_units() {
    for (number, unit, integer, places) in [
        (3.0, 0, 3, 0),
        (-3.0, -1, -6, 0),
        (0.0, -1074, 0, 0),
        (-0.0, 7, 0, 0),
        (f64::from_bits(1), -1074, 1, 0),
        (-1024.0, 10, -1, 0),
    ] {
        let factor = Shifted::new(number, unit);
        assert_eq!((factor.integer, factor.places), (integer, places), "{number} in 2^{unit}");
        let ScaledFloat { value, exponent } = factor.to_scaled_float();
        assert_eq!(value, f64::from(i32::try_from(integer).unwrap()));
        assert_eq!(exponent, 0);
    }
    let Shifted { integer, places } = Shifted::new(f64::MAX, -1074);
    assert_eq!((integer, places), ((1 << 53) - 1, 971 + 1074));
    let ScaledFloat { value, exponent } =
        Shifted { integer: -5, places: 77 }.negated().to_scaled_float();
    assert_eq!((value, exponent), (5.0, 77));
}
