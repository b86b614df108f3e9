use num_bigint::{BigInt, BigUint};

use super::*;
use crate::testing::{Dyadic, Random, exactly};

fn integer(product: Product) -> BigUint {
    (BigUint::from(product.high) << 128) + BigUint::from(product.low)
}

fn number(wide: ScaledPair) -> Dyadic {
    exactly(wide.scaled(-wide.exponent())).scaled(wide.exponent().into())
}

/// Any bits, few of them, or nothing but ones.
fn random_integer(random: &mut Random) -> u128 {
    let bits = u128::from(random.bits()) << 64 | u128::from(random.bits());
    match random.below(5) {
        0 => bits,
        1 => u128::MAX >> random.below(128),
        2 => u128::MAX << random.below(128),
        3 => 1 << random.below(128),
        _ => bits >> random.below(128),
    }
}

fn random_product(random: &mut Random) -> Product {
    Product { high: random_integer(random), low: random_integer(random) }
}

#[test]
fn products_are_exact() {
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let (a, b) = (random_integer(&mut random), random_integer(&mut random));
        assert_eq!(integer(Product::new(a, b)), BigUint::from(a) * b, "{a:#x} {b:#x}");
        let signed = i128::from_ne_bytes(a.to_ne_bytes());
        let square = BigInt::from(signed).pow(2).into_parts().1;
        assert_eq!(integer(Product::square(signed)), square, "{signed:#x}");
    }
    assert_eq!(integer(Product::new(u128::MAX, u128::MAX)), BigUint::from(u128::MAX).pow(2));
    assert_eq!(integer(Product::square(i128::MIN)), BigUint::from(1_u8) << 254);
    assert_eq!(Product::new(0, u128::MAX), Product { high: 0, low: 0 });
}

#[test]
fn sums_and_differences_are_exact() {
    let mut random = Random::new(2);
    for _ in 0..20_000 {
        let [mut a, mut b] = [0; 2].map(|_| random_product(&mut random));
        assert_eq!(a.cmp(&b), integer(a).cmp(&integer(b)));
        let (larger, smaller) = if a < b { (b, a) } else { (a, b) };
        assert_eq!(integer(larger.minus(smaller)), integer(larger) - integer(smaller));
        // A sum of 256 bits.
        (a.high, b.high) = (a.high >> 1, b.high >> 1);
        assert_eq!(integer(a.plus(b)), integer(a) + integer(b));
    }
}

#[test]
fn what_is_rounded_is_cut_off_after_106_bits() {
    let mut random = Random::new(4);
    for _ in 0..20_000 {
        let mut product = random_product(&mut random);
        if random.below(4) == 0 {
            product.high = 0;
        }
        let unit = random.integer(-5000..=5000);
        let exact = Dyadic::new(integer(product), unit.into());
        let wide = product.to_scaled_pair(unit);
        assert_eq!(wide.is_zero(), product == Product { high: 0, low: 0 });
        if wide.is_zero() {
            continue;
        }
        assert_eq!(i64::from(wide.exponent()), exact.magnitude(), "{product:x?}");
        let error = &exact - &number(wide);
        assert!(!error.is_negative(), "{product:x?}");
        assert!(error < Dyadic::new(1, exact.magnitude() - 105), "{product:x?}");
    }
    assert_eq!(number(Product { high: 1, low: 1 << 127 }.to_scaled_pair(-1)), Dyadic::new(3, 126));
}
