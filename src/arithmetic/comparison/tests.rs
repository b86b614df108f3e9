use super::*;
use crate::testing::{Dyadic, Random};

const PARTS: [f64; 5] = [1.0, 0.5, 4096.0, 1.0 / 65536.0, f64::EPSILON];

/// Numbers close to each other and far apart, to either side of powers of two.
fn magnitude(random: &mut Random) -> f64 {
    let x = random.mantissa() * 2_f64.powi(random.integer(-3..=3));
    match random.below(4) {
        0 => x,
        1 => 1.0 + f64::EPSILON * f64::from(random.integer(-3..=3)),
        2 => 2_f64.powi(random.integer(-3..=3)),
        _ => x * 2_f64.powi(random.integer(-250..=250)),
    }
}

#[test]
fn signs_are_those_of_the_numbers() {
    for x in [1.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::INFINITY] {
        assert!(!is_not_positive(x) && is_not_positive(-x));
    }
    assert!(is_not_positive(0.0) && is_not_positive(-0.0));
}

#[test]
fn one_comparison_is_that_of_the_floats() {
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let part = PARTS[random.below(PARTS.len())];
        let y = magnitude(&mut random);
        let [below, above] =
            [-1, 1].map(|step| f64::from_bits((part * y).to_bits().wrapping_add_signed(step)));
        for x in [magnitude(&mut random), part * y, below, above] {
            assert_eq!(exceeds(x, part, y), x > part * y, "{x} {part} {y}");
            assert!(!exceeds(-x, part, y), "-{x} {part} {y}");
        }
        assert!(exceeds(y, part, 0.0) && !exceeds(-y, part, 0.0) && !exceeds(0.0, part, y));
    }
}

#[test]
fn comparisons_of_products_are_certain() {
    let mut random = Random::new(2);
    for _ in 0..5_000 {
        let part = PARTS[random.below(PARTS.len())];
        let [x, y] = [0; 2].map(|_| magnitude(&mut random));
        let product = &Dyadic::exactly(x) * &Dyadic::exactly(y);
        for factor in [1.0 + f64::EPSILON, 1.0, 1.0 - f64::EPSILON, 0.999, 0.95, 0.89, 0.8888, 0.5]
        {
            let z = x * y / part * factor;
            let is_certain = product_exceeds([x, y], part, z);
            let exceeds = product > &Dyadic::exactly(part) * &Dyadic::exactly(z);
            assert!(exceeds || !is_certain, "{x} {y} {part} {z}");
            assert!(is_certain || factor > 8.0 / 9.0, "{x} {y} {part} {z}");
        }
    }
    // As little below as can be, and as much above as is needed.
    assert!(product_exceeds([1.0, 1.0 + f64::EPSILON], 1.0, 1.0));
    assert!(!product_exceeds([1.5; 2], 1.0, 2.0) && product_exceeds([1.5; 2], 1.0, 1.99));
}
