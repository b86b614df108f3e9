use std::cmp::Ordering;

use glam::{DVec3, Vec3, Vec3Swizzles};

use super::*;
use crate::testing::{Dyadic, Random, total};
use crate::{Hit, Ray, Scalar, Vector};

/// The sign of the dot product by the oracle.
fn exact_sign(a: DVec3, b: DVec3) -> Ordering {
    total([0, 1, 2].map(|axis| &Dyadic::exactly(a[axis]) * &Dyadic::exactly(b[axis]))).sign()
}

fn sign(number: f64) -> Ordering {
    number.partial_cmp(&0.0).expect("a number")
}

/// Compares the sign with the oracle, also by what users call, in precision `V`. Returns whether a plain dot product is wrong.
fn check<V: Vector>(direction: DVec3, normal: DVec3) -> bool {
    // Rounded to the precision.
    let [direction, normal] = [direction, normal].map(V::from_f64);
    let [wide_direction, wide_normal] = [direction, normal].map(V::to_f64);
    if !(wide_direction.is_finite() && wide_normal.is_finite()) {
        return false;
    }
    let exact = exact_sign(wide_direction, wide_normal);
    let case = || format!("{wide_direction:?} {wide_normal:?}");
    assert_eq!(sign(of_dot(wide_direction, wide_normal)), exact, "{}", case());
    let [x, y, z] = [0, 1, 2].map(|axis| (wide_direction[axis], wide_normal[axis]));
    assert_eq!(sign(exactly(x, y, z)), exact, "{}", case());
    let zero = V::Scalar::from_f64(0.0);
    let hit = Hit::new(zero, V::from_f64(DVec3::ZERO), normal, zero);
    assert_eq!(hit.is_outward(direction), exact.is_ge(), "{}", case());
    assert_eq!(hit.front_face(&Ray::new(direction, direction)), exact.is_lt(), "{}", case());
    direction.dot(normal).into().partial_cmp(&0.0) != Some(exact)
}

/// Directions that are at a right angle to a normal but for rounding, of any length.
fn tangential(random: &mut Random, lengths: i32) -> [DVec3; 2] {
    let mut vector = || DVec3::from([0; 3].map(|_| random.float(-3..=0)));
    let normal = vector().normalize();
    let direction = normal.cross(vector());
    let length = 2_f64.powi(random.integer(-lengths..=lengths) / 2);
    [direction * length * length, normal]
}

/// Products of any exponents, of which the last two cancel but for a few places or all.
fn canceling(random: &mut Random, exponents: i32) -> [DVec3; 2] {
    let mut number = || random.float(-exponents..=exponents);
    let [a, b] = [0; 2].map(|_| DVec3::new(number(), number(), number()));
    let b = b.with_z(-a.y * b.y / a.z);
    let x = if random.below(4) == 0 { 0.0 } else { b.x };
    if random.below(2) == 0 {
        return [a, b.with_x(x)];
    }
    // With equal factors, exactly.
    let power = 2_f64.powi(random.integer(-8..=8));
    let [a, b] = [a, DVec3::new(x, -a.z * power, a.y * power)];
    if random.below(2) == 0 { [b, a] } else { [a.zxy(), b.zxy()] }
}

fn check_family<V: Vector>(cases: u64, family: impl Fn(&mut Random) -> [DVec3; 2]) {
    let mut wrong_plainly = 0;
    for case in 0..cases {
        let [direction, normal] = family(&mut Random::new(case));
        wrong_plainly += u32::from(check::<V>(direction, normal));
    }
    println!("{wrong_plainly} of {cases} are wrong by a plain dot product");
    assert!(u64::from(wrong_plainly) > cases / 100, "the cases are too easy");
}

#[test]
fn tangential_directions_of_any_length_have_the_exact_sign() {
    check_family::<Vec3>(40_000, |random| tangential(random, 140));
    check_family::<DVec3>(40_000, |random| tangential(random, 1060));
}

#[test]
fn products_of_any_exponents_have_the_exact_sign() {
    check_family::<Vec3>(40_000, |random| canceling(random, 120));
    check_family::<DVec3>(40_000, |random| canceling(random, 30));
    check_family::<DVec3>(40_000, |random| canceling(random, 500));
    check_family::<DVec3>(40_000, |random| canceling(random, 1000));
}

#[test]
fn random_bits_have_the_exact_sign() {
    let mut random = Random::new(1);
    for _ in 0..100_000 {
        let [a, b] = [0; 2].map(|_| DVec3::from([0; 3].map(|_| random.any_float())));
        assert_eq!(sign(of_dot(a, b)), exact_sign(a, b), "{a:?} {b:?}");
    }
}

/// One step beyond the places where a product stands apart from two that cancel.
#[test]
fn the_smallest_product_decides_where_the_others_cancel() {
    for exponent in -1074..=1023 {
        let small = 2_f64.powi(exponent / 2) * 2_f64.powi(exponent - exponent / 2);
        for large in [f64::MAX, 1.0, 3e-200] {
            for sign_of_small in [1.0, -1.0] {
                let a = DVec3::new(large, sign_of_small * small, large);
                let b = DVec3::new(large, small, -large);
                check::<DVec3>(a, b);
                check::<DVec3>(b.yzx(), a.yzx());
                // The others differ by a last place.
                let below = f64::from_bits(large.to_bits() - 1);
                check::<DVec3>(a, b.with_z(-below));
                check::<DVec3>(a.with_z(below), b);
            }
        }
    }
}

#[test]
fn a_nan_has_no_sign() {
    for axis in 0..3 {
        let mut direction = DVec3::ONE;
        direction[axis] = f64::NAN;
        assert!(of_dot(direction, DVec3::X).is_nan());
        let hit = Hit::new(0.0, DVec3::ZERO, DVec3::X, 0.0);
        assert!(!hit.is_outward(direction));
        assert!(!hit.front_face(&Ray::new(DVec3::ZERO, direction)));
    }
    assert!(
        Hit::new(0.0, DVec3::ZERO, DVec3::X, 0.0)
            .is_outward(DVec3::INFINITY.with_y(1.0).with_z(1.0))
    );
}

/// Beside an infinity, other products do not count: without another, or with none of the other sign, it has the sign of the sum.
#[test]
fn an_infinity_has_the_sign_of_its_product() {
    let mut random = Random::new(2);
    for _ in 0..4_000 {
        let [mut a, mut b] = [0; 2].map(|_| DVec3::from([0; 3].map(|_| random.float(-30..=30))));
        if random.below(4) == 0 {
            b[random.below(3)] = 0.0;
        }
        let mut signs = Vec::new();
        for _ in 0..=random.below(2) {
            let (axis, in_first) = (random.below(3), random.below(2) == 0);
            let vector = if in_first { &mut a } else { &mut b };
            vector[axis] = f64::INFINITY * random.sign();
        }
        for axis in 0..3 {
            if a[axis].is_infinite() || b[axis].is_infinite() {
                let is_number = a[axis] != 0.0 && b[axis] != 0.0;
                signs.push(is_number.then_some(a[axis].signum() * b[axis].signum()));
            }
        }
        let found = of_dot(a, b);
        match signs[0] {
            Some(sign) if signs.iter().all(|other| *other == Some(sign)) => {
                assert_eq!(found, f64::INFINITY * sign, "{a} {b}");
            }
            _ => assert!(found.is_nan(), "{a} {b}"),
        }
    }
}
