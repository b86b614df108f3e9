use super::*;
use crate::testing::{Dyadic, Float, Random};

#[test]
fn the_exponent_is_that_of_the_largest_power_of_two_below() {
    let mut random = Random::new(1);
    for _ in 0..10_000 {
        let x = random.any_float();
        let expected = if x.is_normal() { Dyadic::exactly(x).magnitude() } else { -1023 };
        assert_eq!(i64::from(exponent(x)), expected, "{x:e}");
    }
    assert_eq!(exponent(0.0), -1023);
    assert_eq!(exponent(-0.0), -1023);
    assert_eq!(exponent(f64::MIN_POSITIVE), -1022);
    assert_eq!(exponent(-f64::MAX), 1023);
}

/// That `scale` gives the exact product rounded to nearest-even.
fn check(x: f64, e: i32) {
    let exact = Dyadic::exactly(x).scaled(e.into());
    let scaled = scale(x, e);
    assert_eq!(scaled, f64::nearest(&exact), "{x:e} times 2^{e}");
    assert_eq!(scaled.is_sign_negative(), x.is_sign_negative(), "{x:e} times 2^{e}");
}

#[test]
fn scaling_rounds_once() {
    let mut random = Random::new(2);
    for _ in 0..20_000 {
        let x = random.any_float();
        // Anything, and what ends around the smallest numbers or the largest.
        let near = |end: i32, random: &mut Random| end - exponent(x) + random.integer(-4..=4);
        check(x, random.integer(-2200..=2200));
        check(x, near(-1022, &mut random));
        check(x, near(-1050, &mut random));
        check(x, near(-1074, &mut random));
        check(x, near(1023, &mut random));
    }
}

#[test]
fn ties_go_to_even() {
    for integer in 0..64_u32 {
        for exponent in -1080..=-1068 {
            // Straight to the subnormal numbers, and by a detour.
            for detour in [0, 900, 1000, 1900] {
                let x =
                    f64::from(integer) * 2_f64.powi(detour / 2) * 2_f64.powi(detour - detour / 2);
                check(x.min(2_f64.powi(1000)), exponent - detour);
                check(-f64::from(integer), exponent);
            }
        }
    }
}

#[test]
fn next_to_a_tie_there_is_no_tie() {
    // The last bit of 53 decides, however far it is to go.
    for exponent in -1000..=1000 {
        for x in [1.0 + f64::EPSILON, 1.5 - f64::EPSILON, 1.5 + f64::EPSILON, 1.0 - f64::EPSILON] {
            for end in -1076..=-1073 {
                check(x * 2_f64.powi(exponent), end - exponent);
            }
        }
    }
}

#[test]
fn the_ends_of_the_range_scale() {
    let tiny = f64::from_bits(1);
    for x in [tiny, f64::MIN_POSITIVE, 1.0, f64::MAX, 2.0 - f64::EPSILON] {
        for e in [-5000, -3000, -2098, -2097, -1075, -1074, -1022, 0, 1023, 1024, 2097, 2098, 5000]
        {
            check(x, e);
            check(-x, e);
        }
    }
    check(0.0, 5000);
    check(-0.0, -5000);
    assert_eq!(scale(1.0, i32::MAX), f64::INFINITY);
    assert_eq!(scale(1.0, i32::MIN), 0.0);
    assert_eq!(scale(tiny, 2097), 2_f64.powi(1023));
}
