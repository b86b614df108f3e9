use super::*;
use crate::arithmetic::pair::two_sum;
use crate::testing::{Dyadic, Float, Random, exactly, part_of_bound};

/// A line along x from (-9, 1, 0) to a sphere of radius 5 around the origin, scaled: it is at (-√24, 1, 0) of it.
fn line(scale: f64) -> Line {
    Line {
        origin: DVec3::new(-9.0, 1.0, 0.0) * scale,
        direction: DVec3::X,
        center: DVec3::ZERO,
        radius: 5.0 * scale,
    }
}

/// -√24 as a pair.
fn x() -> Pair {
    let root = 24_f64.sqrt();
    // By Newton's step: 24 - root² is exact.
    -two_sum(root, (-root).mul_add(root, 24.0) / (2.0 * root))
}

/// The hit where each coordinate is known within that part of the scale.
fn found(format: Format, scale: f64, error: f64) -> Option<Found> {
    let at = |x: f64| Pair::from(x * scale);
    let x = Pair { hi: x().hi * scale, lo: x().lo * scale };
    let value = Triple { x, y: at(1.0), z: at(0.0) };
    let near = Near::within(value, error * scale);
    let crossing = Crossing { side: Side::Near, point: near, offset: near };
    surely(line(scale), format, 1.0, crossing)
}

#[test]
fn points_and_normals_are_rounded_once() {
    let root = -(24_f64.sqrt());
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what this is about")]
    let single = [root as f32, 1.0 / 5.0, (root as f32) / 5.0].map(f64::from);
    for (format, error, [x, y_normal, x_normal]) in [
        (Format::F64, 2_f64.powi(-90), [root, 1.0 / 5.0, root / 5.0]),
        (Format::F32, 2_f64.powi(-40), single),
    ] {
        for scale in [1.0, 2_f64.powi(30), 2_f64.powi(-30), 2_f64.powi(60), 2_f64.powi(-120)] {
            let found = found(format, scale, error).expect("certain");
            assert_eq!(found.point, DVec3::new(x, 1.0, 0.0) * scale, "{format:?} {scale:e}");
            assert_eq!(found.normal, DVec3::new(x_normal, y_normal, 0.0), "{format:?} {scale:e}");
            assert_eq!(found.t, 1.0);
        }
    }
}

#[test]
fn what_is_not_certain_is_not_told() {
    assert!(found(Format::F64, 1.0, 2_f64.powi(-50)).is_none());
    assert!(found(Format::F32, 1.0, 2_f64.powi(-20)).is_none());
    assert!(found(Format::F64, 1.0, f64::NAN).is_none());
    assert!(found(Format::F64, 1.0, f64::INFINITY).is_none());
    // Where the sphere is so small or large that there are no units for it.
    assert!(found(Format::F64, 2_f64.powi(-1000), 0.0).is_none());
    assert!(found(Format::F64, 2_f64.powi(1000), 0.0).is_none());
}

#[test]
fn next_to_zero_a_normal_is_zero_and_a_point_in_doubt() {
    let along_z = Line { direction: DVec3::new(1.0, 0.0, 1.0), ..line(1.0) };
    let found = |point: f64, offset: f64, error: f64| {
        let near = |z: f64| {
            let value = Triple { x: x(), y: Pair::from(1.0), z: Pair::from(z) };
            Near::within(value, error)
        };
        let (point, offset) = (near(point), near(offset));
        surely(along_z, Format::F64, 1.0, Crossing { side: Side::Near, point, offset })
    };
    let error = 2_f64.powi(-90);
    // Below 5 2^-53 for sure.
    for offset in [0.0, -0.0, 1e-27, -1e-27, 5.5e-16, -5.5e-16] {
        let found = found(1.0, offset, error).expect("certain");
        assert_eq!(found.normal.z.to_bits(), 0, "{offset:e}");
    }
    assert_eq!(found(1.0, 5.6e-16, 1e-36).expect("certain").normal.z, 5.6e-16 / 5.0);
    assert!(found(1.0, 5.6e-16, error).is_none(), "as small, but less certain");
    assert!(found(0.0, 1.0, error).is_none(), "a point has no smallest coordinate");
    assert_eq!(found(-0.0, 1.0, 0.0).expect("certain").point.z.to_bits(), 0);
}

#[test]
fn numbers_are_normalized() {
    for (x, expected, exponent) in [
        (1.0, 1.0, 0),
        (5.0, 1.25, 2),
        (0.75, 1.5, -1),
        (f64::MIN_POSITIVE, 1.0, -1022),
        (3.0 * f64::from_bits(1), 1.5, -1073),
        (f64::MAX, 2.0 - f64::EPSILON, 1023),
    ] {
        assert_eq!(normalized(x), (expected, exponent), "{x:e}");
    }
}

#[test]
fn points_on_the_line_keep_their_bound() {
    let mut random = Random::new(1);
    let mut worst = 0.0_f64;
    for round in 0..4000 {
        // Of all sizes, and where the terms nearly cancel.
        let range = if round % 2 == 0 { -2..=2 } else { -400..=400 };
        let [x, y, z, u, v, w, t] = [0.0; 7].map(|_| random.float(range.clone()));
        let root = two_sum(t, t * f64::EPSILON * 0.3);
        let mut line = Line {
            origin: DVec3::new(x, y, z),
            direction: DVec3::new(u, v, w),
            center: DVec3::ZERO,
            radius: 1.0,
        };
        if round % 4 == 0 {
            line.origin = -line.direction * t;
        }
        let near = on_the_line(&line, root, 0.0);
        let values = [near.value.x, near.value.y, near.value.z];
        let errors = [near.error.x, near.error.y, near.error.z];
        for axis in 0..3 {
            let [p, d] = [line.origin[axis], line.direction[axis]].map(Dyadic::exactly);
            let expected = &p + &(&exactly(root) * &d);
            let bound = Dyadic::exactly(errors[axis]);
            worst = worst.max(part_of_bound(&exactly(values[axis]), &expected, &bound));
        }
    }
    println!("{worst} of the bound");
    assert!(worst <= 1.0 && worst > 0.02, "{worst}");
}

/// The quotient of two numbers, correctly rounded; zero below half an ulp of 1.
fn exact_normal<F: Float>(offset: f64, radius: f64) -> f64 {
    let [offset, radius] = [offset, radius].map(Dyadic::exactly);
    let near = offset.divided_by(&radius, 80);
    let quotient: f64 = F::nearest_by(&near, |number| offset.cmp(&(number * &radius))).into();
    let digits = i32::try_from(F::DIGITS).expect("53 at most");
    if quotient.abs() < 2_f64.powi(-digits) { 0.0 } else { quotient }
}

#[test]
fn a_normal_is_the_quotient_rounded_or_zero() {
    let mut random = Random::new(3);
    for round in 0..20_000 {
        // At half an ulp of 1, within a few digits of it, and of any size.
        let radius = [1.0, random.mantissa()][random.below(2)];
        let half = [f64::from(f32::EPSILON) / 2.0, f64::EPSILON / 2.0][round % 2];
        let part = match random.below(4) {
            0 => 1.0,
            1 => 1.0 + random.float(-60..=-20),
            _ => random.float(-3..=3),
        };
        let offset = random.sign() * half * part * radius;
        #[expect(clippy::cast_possible_truncation, reason = "those of the format")]
        let [single_offset, single_radius] = [offset, radius].map(|x| f64::from(x as f32));
        assert_eq!(
            normal(Format::F32, single_offset, single_radius),
            exact_normal::<f32>(single_offset, single_radius),
            "{single_offset:e} / {single_radius}"
        );
        let found = normal(Format::F64, offset, radius);
        assert_eq!(found, exact_normal::<f64>(offset, radius), "{offset:e} / {radius}");
    }
}

/// The hit at a point and at an offset, known as well as that, of a sphere of radius 5 and a line along no axis.
fn found_at(point: [f64; 3], offset: [f64; 3], error: f64) -> Option<Found> {
    let line = Line { direction: DVec3::ONE, ..line(1.0) };
    let near = |[x, y, z]: [f64; 3]| Near::within(Triple { x, y, z }.map(Pair::from), error);
    let (point, offset) = (near(point), near(offset));
    surely(line, Format::F64, 1.0, Crossing { side: Side::Near, point, offset })
}

#[test]
fn a_coordinate_of_a_normal_that_is_next_to_nothing_is_zero() {
    let point = [1.5, -1.25, 1.75];
    for axes in 0..8 {
        let offset = [1, 2, 4].map(|axis| if axes & axis == 0 { 2.5 } else { 1e-27 });
        let found = found_at(point, offset, 1e-50).expect("certain");
        let expected = offset.map(|x| if x == 2.5 { 0.5 } else { 0.0 });
        assert_eq!(found.normal.to_array(), expected);
        assert_eq!(found.point.to_array(), point);
    }
}
