use super::*;
use crate::testing::{Dyadic, Random, exactly, part_of_bound, search, total};

/// Exponents between which neither a product nor its error overflows or underflows.
const MIDDLE: std::ops::RangeInclusive<i32> = -400..=400;

fn exact_product(a: f64, b: f64) -> Dyadic {
    &Dyadic::exactly(a) * &Dyadic::exactly(b)
}

/// A pair near 1, in which the low part may be as large as it can be.
fn pair_from([hi, lo]: [f64; 2]) -> Pair {
    two_sum(hi, lo * V.sqrt())
}

fn random_parts(random: &mut Random) -> [f64; 2] {
    [random.float(-1..=1), random.float(-1..=0)]
}

/// A second pair, often nearly the opposite of the first.
fn random_pairs(random: &mut Random) -> [f64; 4] {
    let [a, b] = random_parts(random);
    let [c, d] = random_parts(random);
    match random.below(3) {
        0 => [a, b, c, d],
        1 => [a, b, -a, d],
        _ => [a, b, -random.nudge(a), d],
    }
}

/// Searches for the worst case of an operation on two pairs.
fn search_pairs(
    what: &str,
    operation: impl Fn(Pair, Pair) -> Pair,
    exact: impl Fn(&Dyadic, &Dyadic) -> Dyadic,
    bound: impl Fn(&Dyadic, &Dyadic) -> Dyadic,
) -> f64 {
    search(what, 150, 200, random_pairs, |[a, a_low, b, b_low]| {
        let (a, b) = (pair_from([a, a_low]), pair_from([b, b_low]));
        if a.hi == 0.0 || b.hi == 0.0 {
            return None;
        }
        let computed = operation(a, b);
        assert_eq!(computed.hi + computed.lo, computed.hi, "{a:?} and {b:?}");
        let (a, b) = (exactly(a), exactly(b));
        Some(part_of_bound(&exactly(computed), &exact(&a, &b), &bound(&a, &b)))
    })
}

#[test]
fn sums_and_differences_are_exact() {
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let a = random.float(-1000..=1000);
        let b = match random.below(3) {
            0 => random.float(-1000..=1000),
            1 => -random.nudge(a),
            _ => random.float(0..=60) * 2_f64.powi(crate::arithmetic::scaling::exponent(a) - 50),
        };
        if b.is_infinite() || (a + b).is_infinite() || (a - b).is_infinite() {
            continue;
        }
        let (x, y) = (Dyadic::exactly(a), Dyadic::exactly(b));
        assert_eq!(two_sum(a, b).hi, a + b);
        assert_eq!(exactly(two_sum(a, b)), &x + &y, "{a:e} + {b:e}");
        assert_eq!(two_difference(a, b).hi, a - b);
        assert_eq!(exactly(two_difference(a, b)), &x - &y, "{a:e} - {b:e}");
        let (a, b) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
        assert_eq!(fast_two_sum(a, b), two_sum(a, b), "{a:e} + {b:e}");
    }
    // And where the first is the smaller one, but a multiple of the last place of the second.
    for _ in 0..20_000 {
        let b = random.float(0..=3);
        let place = 2_f64.powi(crate::arithmetic::scaling::exponent(b) - 52);
        let a = random.float(-53..=2) / place;
        let a = a.round() * place * [1.0, -1.0, -2.0][random.below(3)];
        assert_eq!(fast_two_sum(a, b), two_sum(a, b), "{a:e} + {b:e}");
    }
    // Not where it is none.
    assert_ne!(fast_two_sum(f64::EPSILON / 4.0, 1.5), two_sum(f64::EPSILON / 4.0, 1.5));
    let tiny = f64::from_bits(1);
    assert_eq!(two_sum(1.0, tiny), Pair { hi: 1.0, lo: tiny });
    assert_eq!(two_difference(tiny, 1.0), Pair { hi: -1.0, lo: tiny });
}

#[test]
fn products_are_exact() {
    let mut random = Random::new(2);
    for _ in 0..20_000 {
        let (a, b) = (random.float(MIDDLE), random.float(MIDDLE));
        assert_eq!(two_product(a, b).hi, a * b);
        assert_eq!(exactly(two_product(a, b)), exact_product(a, b), "{a:e} times {b:e}");
    }
    // The largest that Veltkamp's split takes, and the smallest products whose error is a number.
    let (large, small) = (f64::MAX * 2_f64.powi(-28), 2_f64.powi(-969) * 1.1);
    assert_eq!(exactly(two_product(large, 0.3)), exact_product(large, 0.3));
    assert_eq!(exactly(two_product(small, 0.3)), exact_product(small, 0.3));
    assert_eq!(two_product(small, 0.0), Pair { hi: 0.0, lo: 0.0 });
}

#[test]
fn compensated_dot_products_keep_their_bound() {
    let start = |random: &mut Random| {
        let mut case = [0.0; 6].map(|_: f64| random.float(-1..=1));
        if random.below(2) == 0 {
            // The last product cancels the others.
            case[5] = -(case[0] * case[3] + case[1] * case[4]) / case[2];
        }
        case
    };
    let worst = search("compensated dot product", 150, 200, start, |[a, b, c, d, e, f]| {
        let (x, y) = (Triple { x: a, y: b, z: c }, Triple { x: d, y: e, z: f });
        let computed = compensated_dot(x, y);
        assert_eq!(computed.hi, x.dot(y));
        let products = [(a, d), (b, e), (c, f)].map(|(a, b)| exact_product(a, b));
        let size = total(products.clone().map(Dyadic::abs));
        let bound = &Dyadic::exactly(COMPENSATED_DOT_ERROR) * &size;
        Some(part_of_bound(&exactly(computed), &total(products), &bound))
    });
    assert!(worst > 0.2);
}

#[test]
fn sums_of_pairs_keep_their_bound() {
    let bound = |a: &Dyadic, b: &Dyadic| {
        &Dyadic::exactly(SUM_ERROR) * &(&a.clone().abs() + &b.clone().abs())
    };
    assert!(search_pairs("sum", |a, b| a + b, |a, b| a + b, bound) > 0.3);
    assert!(search_pairs("difference", |a, b| a - b, |a, b| a - b, bound) > 0.3);
}

#[test]
fn products_of_pairs_keep_their_bound() {
    let bound = |a: &Dyadic, b: &Dyadic| &Dyadic::exactly(PRODUCT_ERROR) * &(a * b).abs();
    assert!(search_pairs("product", |a, b| a * b, |a, b| a * b, bound) > 0.5);
}

#[test]
fn products_with_numbers_keep_their_bound() {
    // What is rounded are the low part's product, by v, and its sum with the error of the high part's, by 2 v.
    let start =
        |random: &mut Random| [random.float(-1..=1), random.float(-1..=0), random.float(-1..=1)];
    let worst = search("product with a number", 100, 200, start, |[hi, lo, factor]| {
        let pair = pair_from([hi, lo]);
        let computed = pair.times(factor);
        assert_eq!(computed.hi, pair.hi * factor);
        let exact = &exactly(pair) * &Dyadic::exactly(factor);
        let bound = &Dyadic::exactly(3.0 * V) * &exact.clone().abs();
        Some(part_of_bound(&exactly(computed), &exact, &bound))
    });
    assert!(worst > 0.4);
    // Far below, what may have underflowed is left out.
    let third = Pair { hi: 1.0 / 3.0, lo: 2_f64.powi(-60) };
    let factor = 2_f64.powi(-899) / 3.0;
    assert_eq!(third.times(factor), Pair { hi: third.hi * factor, lo: third.lo * factor });
    let factor = 2_f64.powi(-896) / 3.0;
    assert_ne!(third.times(factor).lo, third.lo * factor);
}

#[test]
fn quotients_of_pairs_keep_their_bound() {
    let exact = |a: &Dyadic, b: &Dyadic| a.divided_by(b, 240);
    let bound =
        |a: &Dyadic, b: &Dyadic| &Dyadic::exactly(QUOTIENT_ERROR) * &a.divided_by(b, 64).abs();
    assert!(search_pairs("quotient", |a, b| a / b, exact, bound) > 0.4);
}

#[test]
fn square_roots_of_pairs_keep_their_bound() {
    let start = |random: &mut Random| random_parts(random);
    let worst = search("square root", 150, 200, start, |parts| {
        let [hi, lo] = parts;
        let pair = pair_from([hi.abs(), lo]);
        let computed = pair.sqrt();
        let exact = exactly(pair).square_root(240);
        let bound = &Dyadic::exactly(ROOT_ERROR) * &exact;
        Some(part_of_bound(&exactly(computed), &exact, &bound))
    });
    assert!(worst > 0.4);
}

#[test]
fn opposites_cancel() {
    let pair = two_sum(-3.0, 1e-17);
    assert_eq!(pair + -pair, Pair { hi: 0.0, lo: 0.0 });
    assert_eq!(pair - pair, Pair { hi: 0.0, lo: 0.0 });
}
