use super::*;

fn float(value: f64, exponent: i32) -> ScaledFloat {
    ScaledFloat { value, exponent }
}

/// In units of 2^`unit`, where that is a number.
fn scaled(x: ScaledFloat, unit: i32) -> f64 {
    scale(x.value, x.exponent - unit)
}

#[test]
fn operations_are_those_of_numbers() {
    let (a, b) = (float(3.0, 5000), float(-5.0, 5001));
    assert_eq!(scaled(a + b, 5000), -7.0);
    assert_eq!(scaled(b + a, 5000), -7.0);
    assert_eq!(scaled(a - b, 5000), 13.0);
    assert_eq!(scaled(-a, 5000), -3.0);
    assert_eq!(scaled(a * b, 10_001), -15.0);
    assert_eq!(scaled(b / a, 1), -5.0 / 3.0);
    assert_eq!(scaled(a.times(0.5), 5000), 1.5);
    assert_eq!(scaled(float(9.0, -8000).sqrt(), -4000), 3.0);
}

#[test]
fn next_to_nothing_is_dropped_and_zero_adds_nothing() {
    let (large, small) = (float(1.5, 9000), float(1.5, -9000));
    assert_eq!(scaled(large + small, 9000), 1.5);
    assert_eq!(scaled(small - large, 9000), -1.5);
    for zero in [float(0.0, 9000), float(-0.0, -9000)] {
        for x in [large, small] {
            assert_eq!(scaled(x + zero, x.exponent), 1.5);
            assert_eq!(scaled(zero + x, x.exponent), 1.5);
        }
    }
}

#[test]
fn magnitudes_are_compared() {
    assert!(float(3.0, 100).is_less_than(float(-1.0, 102)));
    assert!(!float(-1.0, 102).is_less_than(float(3.0, 100)));
    assert!(!float(1.0, 1).is_less_than(float(2.0, 0)));
    assert!(float(0.0, 500).is_less_than(float(1.0, -500)));
}

#[test]
fn leading_exponents_are_those_of_the_value() {
    assert_eq!(float(1.0, 77).leading_exponent(), 77);
    assert_eq!(float(-5.5, -3000).leading_exponent(), -2998);
}
