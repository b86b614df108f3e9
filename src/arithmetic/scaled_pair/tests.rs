use super::*;
use crate::arithmetic::pair::QUOTIENT_ERROR;
use crate::testing::{Dyadic, Float, Random, exactly, part_of_bound};

fn number(wide: ScaledPair) -> Dyadic {
    exactly(wide.value).scaled(wide.exponent.into())
}

#[test]
fn integers_keep_106_bits() {
    let mut random = Random::new(1);
    for _ in 0..5000 {
        let bits = u128::from(random.bits()) << 64 | u128::from(random.bits());
        let bits = match random.below(3) {
            0 => bits,
            1 => bits >> random.below(128),
            _ => u128::MAX >> random.below(128),
        };
        let unit = random.integer(-5000..=5000);
        let exact = Dyadic::new(bits, unit.into());
        let wide = ScaledPair::from_integer(bits, unit);
        assert_eq!(wide.is_zero(), bits == 0);
        assert!(wide.value.hi >= 0.0);
        if bits == 0 {
            continue;
        }
        assert_eq!(i64::from(wide.exponent()), exact.magnitude(), "{bits:#x}");
        assert_eq!(wide.value.hi + wide.value.lo, wide.value.hi, "{bits:#x}");
        // Cut off after 106 bits.
        let part = part_of_bound(&number(wide), &exact, &Dyadic::new(1, exact.magnitude() - 105));
        assert!(part < 1.0, "{bits:#x}");
        if bits < 1 << 106 || bits.trailing_zeros() >= 22 {
            assert_eq!(number(wide), exact, "{bits:#x}");
        }
    }
    assert_eq!(number(ScaledPair::from_integer(1, -7)), Dyadic::new(1, -7));
}

/// A number of either sign and any exponent.
fn random_wide(random: &mut Random) -> ScaledPair {
    let bits = u128::from(random.bits()) << 64 | u128::from(random.bits());
    let integer = i128::from_ne_bytes((bits >> random.below(128)).to_ne_bytes());
    let integer = if random.below(2) == 0 { integer } else { -integer };
    let wide = ScaledPair::from_signed(integer, random.integer(-4000..=4000));
    assert_eq!((wide.value.hi < 0.0, wide.is_zero()), (integer < 0, integer == 0));
    wide
}

#[test]
fn wide_numbers_keep_the_bounds_of_pairs() {
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
            b = ScaledPair { value: Pair { lo: b.value.lo, ..-a.value }, ..a };
        }
        let (x, y) = (number(a), number(b));
        assert_eq!(number(-a), -&x);

        let part = |computed, exact: &Dyadic, error, size: &Dyadic| {
            part_of_bound(&number(computed), exact, &(&Dyadic::exactly(error) * size))
        };
        let quotient = x.divided_by(&y, 240);
        let size = quotient.clone().abs();
        assert!(part(a / b, &quotient, QUOTIENT_ERROR, &size) <= 1.0, "{a:?} / {b:?}");
        let a = if a.value.hi < 0.0 { -a } else { a };
        let middle = a.scaled(-a.exponent());
        assert!((1.0..=2.0).contains(&middle.hi), "{a:?}");
        assert_eq!(exactly(middle), number(a).scaled((-a.exponent()).into()));
    }
}

#[test]
fn wide_zero_is_zero() {
    let one = ScaledPair::from_integer(1, 0);
    let zero = ScaledPair::from_signed(0, 7);
    assert!(zero.is_zero() && (-zero).is_zero() && (zero / one).is_zero());
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
            assert_eq!(rounded, f64::nearest(&exact), "{wide:?}");
        } else {
            // Rounded twice: by half a unit in the last place, and before that by very little.
            let error = (&Dyadic::exactly(rounded) - &exact).abs();
            assert!(error <= Dyadic::new((1_u64 << 40) + 1, -1075 - 40), "{wide:?}");
        }
    }
}
