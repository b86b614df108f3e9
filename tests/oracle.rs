//! The oracle itself, against answers that are known without it.

mod support;

use std::cmp::Ordering;

use eyeray::{Ray, Sphere};
use glam::{DVec3, Vec3, dvec3, vec3};
use support::dyadic::Dyadic;
use support::float::Float;
use support::oracle::{Coordinates, Truth, side};

/// Both roots, rounded to nearest.
fn roots<V: Coordinates>(ray: &Ray<V>, sphere: &Sphere<V>) -> Option<[V::Scalar; 2]> {
    Truth::new(ray, sphere).map(|truth| truth.roots.map(|root| root.nearest()))
}

/// The float after this one.
fn above<F: Float>(value: F) -> F {
    F::from_ordinal(value.ordinal() + 1)
}

/// The float before this one.
fn below<F: Float>(value: F) -> F {
    F::from_ordinal(value.ordinal() - 1)
}

/// Along +x from a distance before the center, at an offset from it.
fn along_x(before: f32, offset: f32, radius: f32) -> (Ray, Sphere) {
    (Ray::new(vec3(-before, offset, 0.0), Vec3::X), Sphere::new(Vec3::ZERO, radius))
}

fn along_x_f64(before: f64, offset: f64, radius: f64) -> (Ray<DVec3>, Sphere<DVec3>) {
    (Ray::new(dvec3(-before, offset, 0.0), DVec3::X), Sphere::new(DVec3::ZERO, radius))
}

#[test]
fn pythagorean_triangles_have_integer_roots() {
    for (closest, half_chord, radius) in [(3.0, 4.0, 5.0), (5.0, 12.0, 13.0), (20.0, 21.0, 29.0)] {
        let (ray, sphere) = along_x(100.0, closest, radius);
        assert_eq!(roots(&ray, &sphere), Some([100.0 - half_chord, 100.0 + half_chord]));
        let (ray, sphere) = along_x_f64(100.0, closest.into(), radius.into());
        assert_eq!(
            roots(&ray, &sphere),
            Some([100.0 - f64::from(half_chord), 100.0 + f64::from(half_chord)])
        );
    }
}

#[test]
fn tangents_of_pythagorean_quadruples_are_hits_with_two_equal_roots() {
    // (1, 2, 2) and (2, 1, -2) are perpendicular, each of length 3.
    let (along, outward) = (vec3(1.0, 2.0, 2.0), vec3(2.0, 1.0, -2.0));
    let center = vec3(5.0, -7.0, 11.0);
    let tangent = Ray::new(center + outward * 4.0 - along * 6.0, along * 2.0);
    assert_eq!(roots(&tangent, &Sphere::new(center, 12.0)), Some([3.0, 3.0]));
    // A sphere that is an ulp smaller is missed; one an ulp larger is met twice.
    assert_eq!(roots(&tangent, &Sphere::new(center, 12.0 - 1e-6)), None);
    let larger = roots(&tangent, &Sphere::new(center, 12.0 + 1e-6)).expect("the line cuts it");
    assert!(larger[0] < 3.0 && 3.0 < larger[1]);
    // The line of a ray goes both ways.
    let away = Ray::new(tangent.origin, -tangent.direction);
    assert_eq!(roots(&away, &Sphere::new(center, 12.0)), Some([-3.0, -3.0]));
}

#[test]
fn rational_roots_are_rounded_to_nearest() {
    // A tangent at t = 1/3 and one at 2/3: the literals are the nearest floats.
    let ray = Ray::new(vec3(-1.0, 1.0, 0.0), vec3(3.0, 0.0, 0.0));
    let third = roots(&ray, &Sphere::new(Vec3::ZERO, 1.0));
    assert_eq!(third, Some([1.0 / 3.0; 2]));
    let ray = Ray::new(dvec3(-2.0, 1.0, 0.0), dvec3(3.0, 0.0, 0.0));
    assert_eq!(roots(&ray, &Sphere::new(DVec3::ZERO, 1.0)), Some([2.0 / 3.0; 2]));
}

#[test]
fn irrational_roots_are_rounded_to_nearest() {
    // 2 ± √2: the closest approach is √2 from the center of a sphere of radius 2.
    let ray = Ray::new(dvec3(-2.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0));
    let truth =
        Truth::new(&ray, &Sphere::new(dvec3(0.0, 1.0, 1.0), 2.0)).expect("√2 is less than 2");
    let digits =
        ["0.58578643762690495119831127579030192143", "3.41421356237309504880168872420969807857"];
    for (root, digits) in truth.roots.iter().zip(digits) {
        assert_eq!(root.nearest::<f64>(), digits.parse().expect("digits"));
        assert_eq!(root.nearest::<f32>(), digits.parse().expect("digits"));
    }
}

#[test]
fn ties_go_to_even() {
    // The near root is 2^24 + 1 and 2^24 + 3, each midway between two floats.
    for (root, even) in [(16_777_217.0, 16_777_216.0), (16_777_219.0, 16_777_220.0)] {
        let before = root - 8_000_000.0 + 1.0;
        let ray = Ray::new(vec3(-8_000_000.0, 0.0, 0.0), Vec3::X);
        #[expect(clippy::cast_possible_truncation, reason = "a small integer")]
        let sphere = Sphere::new(vec3(before as f32, 0.0, 0.0), 1.0);
        let truth = Truth::new(&ray, &sphere).expect("the line goes through the center");
        assert_eq!(truth.roots[0].nearest::<f64>(), root);
        assert_eq!(truth.roots[0].nearest::<f32>(), even);
        assert_eq!(truth.roots[0].error(even), 0.5);
        // Behind the origin the same, mirrored.
        let truth = Truth::new(&Ray::new(ray.origin, -ray.direction), &sphere).expect("likewise");
        assert_eq!(truth.roots[1].nearest::<f32>(), -even);
    }
}

#[test]
fn what_is_just_beyond_a_tie_goes_to_its_side() {
    // The roots are plus and minus the radius. The tie itself goes down, to even.
    let tie = 16_777_217.0_f64;
    let ray = Ray::new(dvec3(0.0, 0.0, 0.0), DVec3::X);
    let sphere = Sphere::new(dvec3(0.0, 0.0, 0.0), above(tie));
    let truth = Truth::new(&ray, &sphere).expect("from within");
    assert_eq!(truth.roots[1].nearest::<f32>(), 16_777_218.0);
    assert_eq!(truth.roots[0].nearest::<f32>(), -16_777_218.0);
    let sphere = Sphere::new(dvec3(0.0, 0.0, 0.0), below(tie));
    let truth = Truth::new(&ray, &sphere).expect("from within");
    assert_eq!(truth.roots[1].nearest::<f32>(), 16_777_216.0);
}

#[test]
fn small_roots_underflow_gradually() {
    let smallest = f32::from_bits(1);
    let root = |radius: f32, length: f32| {
        let ray = Ray::new(Vec3::ZERO, vec3(length, 0.0, 0.0));
        roots(&ray, &Sphere::new(Vec3::ZERO, radius)).expect("from within")
    };
    assert_eq!(root(smallest, 1.0), [-smallest, smallest]);
    // Half of the smallest is a tie: to even, which is zero. A root below zero is a negative zero.
    let [near, far] = root(smallest, 2.0);
    assert!(near.identical(-0.0) && far.identical(0.0));
    assert_eq!(root(smallest, 1.99), [-smallest, smallest]);
    // One and a half goes to two, five halves too.
    assert_eq!(root(3.0 * smallest, 2.0)[1], f32::from_bits(2));
    assert_eq!(root(5.0 * smallest, 2.0)[1], f32::from_bits(2));
    // The largest subnormal and the smallest normal number.
    assert_eq!(root(f32::MIN_POSITIVE, 1.0)[1], f32::MIN_POSITIVE);
    assert_eq!(root(f32::from_bits(0x7f_ffff), 1.0)[1], f32::from_bits(0x7f_ffff));
    // A tie between these two.
    assert_eq!(root(f32::from_bits(0xff_ffff), 2.0)[1], f32::MIN_POSITIVE);
}

#[test]
fn large_roots_overflow_half_an_ulp_beyond_the_largest() {
    // From the far side of the origin: 2^127 + 2^127 - x, for x around half an ulp of the largest.
    let half = 2.0_f32.powi(127);
    let half_ulp = 2.0_f32.powi(103);
    let root = |beyond: f32| {
        let sphere = Sphere::new(vec3(half - beyond, 0.0, 0.0), 0.0);
        roots(&Ray::new(vec3(-half, 0.0, 0.0), Vec3::X), &sphere).expect("through the center")[0]
    };
    assert_eq!(root(2.0 * half_ulp), f32::MAX);
    assert_eq!(root(0.0), f32::INFINITY);
    // 2^128 less half an ulp is midway between the largest and 2^128: to even, which is infinite.
    assert_eq!(root(half_ulp), f32::INFINITY);
    let root = |length: f32| {
        let ray = Ray::new(Vec3::ZERO, vec3(length, 0.0, 0.0));
        roots(&ray, &Sphere::new(Vec3::ZERO, 1.0)).expect("from within")
    };
    assert_eq!(root(f32::from_bits(1)), [f32::NEG_INFINITY, f32::INFINITY]);
}

#[test]
fn errors_are_in_ulps_of_the_root() {
    let (ray, sphere) = along_x(100.0, 3.0, 5.0);
    let truth = Truth::new(&ray, &sphere).expect("a triangle of 3, 4 and 5");
    let ulp = 2.0_f32.powi(-17);
    assert_eq!(truth.roots[0].error(96.0_f32), 0.0);
    assert_eq!(truth.roots[0].error(96.0 + ulp), 1.0);
    assert_eq!(truth.roots[0].error(96.0 - 3.0 * ulp), 3.0);
    assert_eq!(truth.roots[0].error(f32::NAN), f64::INFINITY);
    assert!(truth.roots[0].error(f32::INFINITY) > 1e40);
    assert!(truth.roots[0].error(f32::NEG_INFINITY) > 1e40);
    let (ray, sphere) = along_x_f64(100.0, 3.0, 5.0);
    let truth = Truth::new(&ray, &sphere).expect("a triangle of 3, 4 and 5");
    assert_eq!(truth.roots[0].error(96.0 + 2.0_f64.powi(-46)), 1.0);
    // The smallest subnormal is the ulp of all that is small.
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let truth = Truth::new(&ray, &Sphere::new(Vec3::ZERO, f32::from_bits(5))).expect("from within");
    assert_eq!(truth.roots[1].error(f32::from_bits(7)), 2.0);
    // What is too large for the format is infinite without an error.
    let ray = Ray::new(Vec3::ZERO, vec3(1e-30, 0.0, 0.0));
    let truth = Truth::new(&ray, &Sphere::new(Vec3::ZERO, 1e30)).expect("from within");
    assert_eq!(truth.roots[1].error(f32::INFINITY), 0.0);
    assert!(truth.roots[1].error(f32::MAX) > 1e20);
}

#[test]
fn a_point_sphere_is_hit_exactly_through_its_center() {
    let ray = Ray::new(vec3(1.0, 2.0, 3.0), vec3(3.0, -1.0, 2.0));
    let center = ray.origin + ray.direction * 5.0;
    assert_eq!(roots(&ray, &Sphere::new(center, 0.0)), Some([5.0, 5.0]));
    assert_eq!(roots(&ray, &Sphere::new(center, -0.0)), Some([5.0, 5.0]));
    assert_eq!(roots(&ray, &Sphere::new(vec3(center.x, center.y, above(center.z)), 0.0)), None);
    assert_eq!(roots(&ray, &Sphere::new(ray.origin, 0.0)), Some([0.0, 0.0]));
    let truth = Truth::new(&ray, &Sphere::new(center, 0.0)).expect("through the center");
    assert_eq!(truth.point_error(0, center), 0.0);
    assert!(truth.normal_error(0, -ray.direction.normalize()) < 1.0);
    assert!(truth.normal_error(0, ray.direction.normalize()) > 1e6);
}

#[test]
fn an_origin_on_the_surface_is_a_root_of_zero() {
    let origin = vec3(2.0, 3.0, 6.0);
    let sphere = Sphere::new(Vec3::ZERO, 7.0);
    assert_eq!(side(&sphere, origin), Some(Ordering::Equal));
    let outward = Truth::new(&Ray::new(origin, Vec3::X), &sphere).expect("the line meets it");
    assert!(outward.roots[1].is_zero());
    assert_eq!(outward.roots.map(|root| root.nearest::<f32>()), [-4.0, 0.0]);
    let inward = Truth::new(&Ray::new(origin, -Vec3::X), &sphere).expect("the line meets it");
    assert!(inward.roots[0].is_zero());
    assert_eq!(inward.roots.map(|root| root.nearest::<f32>()), [0.0, 4.0]);
    let tangent =
        Truth::new(&Ray::new(origin, vec3(3.0, -2.0, 0.0)), &sphere).expect("tangency is a hit");
    assert!(tangent.roots.iter().all(support::oracle::Root::is_zero));
}

#[test]
fn points_and_normals_are_measured_against_the_surface() {
    let (ray, sphere) = along_x(100.0, 3.0, 5.0);
    let truth = Truth::new(&ray, &sphere).expect("a triangle of 3, 4 and 5");
    // Promised are 0.51 ulp of the coordinate and, of the 96 travelled, 2^-30; an ulp of a normal is that of 1.
    let ulp = 2.0_f32.powi(-21);
    let close = |x: f64, y: f64| (x - y).abs() < 1e-9;
    assert_eq!(truth.point_error(0, vec3(-4.0, 3.0, 0.0)), 0.0);
    assert_eq!(truth.point_error(1, vec3(4.0, 3.0, 0.0)), 0.0);
    assert!(close(truth.point_error(0, vec3(-4.0 + ulp, 3.0, 0.0)), 1.0 / (0.51 + 0.1875)));
    assert!(close(truth.point_error(0, vec3(-4.0, 3.0, -2.0 * ulp)), 2.0 / 0.1875));
    let truth = Truth::new(&ray, &Sphere::new(vec3(0.0, 0.0, 0.0), 5.0)).expect("the same");
    let exact = |value: f64| Dyadic::exactly(value);
    let normal = vec3(-0.8, 0.6, 0.0);
    let expected = normal.x.error(&exact(-0.8), -23).max(normal.y.error(&exact(0.6), -23));
    assert!((truth.normal_error(0, normal) - expected).abs() < 1e-6);
    assert!(truth.normal_error(0, vec3(0.8, 0.6, 0.0)) > 1e7);
    // From 1e15 radii away the point is as exact: 2^-53 of the radius is 1.25 ulp of 3.
    let (ray, sphere) = along_x_f64(5e15, 3.0, 5.0);
    let truth = Truth::new(&ray, &sphere).expect("the same");
    assert_eq!(truth.point_error(0, dvec3(-4.0, 3.0, 0.0)), 0.0);
    let off = truth.point_error(1, dvec3(4.0, 3.0 + 2.0_f64.powi(-50), 0.0));
    assert!(close(off, 2.0 / (0.51 + 1.25)));
}

#[test]
fn points_are_strictly_inside_or_outside_by_the_last_bit() {
    let sphere = Sphere::new(vec3(1e6, 0.0, 0.0), 1.0);
    assert_eq!(side(&sphere, vec3(1e6, 1.0, 0.0)), Some(Ordering::Equal));
    assert_eq!(side(&sphere, vec3(1e6, above(1.0_f32), 0.0)), Some(Ordering::Greater));
    assert_eq!(side(&sphere, vec3(1e6, below(1.0_f32), 0.0)), Some(Ordering::Less));
    assert_eq!(side(&sphere, vec3(1e6, 1.0, f32::from_bits(1))), Some(Ordering::Greater));
    assert_eq!(side(&sphere, Vec3::NAN), None);
}

#[test]
fn what_is_not_finite_or_no_ray_or_no_sphere_has_no_roots() {
    let (ray, sphere) = along_x(10.0, 0.0, 1.0);
    assert!(Truth::new(&ray, &sphere).is_some());
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in Vec3::AXES {
            // Infinity times 0 is NaN: every coordinate is then bad.
            assert!(
                Truth::new(&Ray::new(ray.origin + axis * bad, ray.direction), &sphere).is_none()
            );
            assert!(
                Truth::new(&Ray::new(ray.origin, ray.direction + axis * bad), &sphere).is_none()
            );
            assert!(Truth::new(&ray, &Sphere::new(axis * bad, 1.0)).is_none());
        }
        assert!(Truth::new(&ray, &Sphere::new(Vec3::ZERO, bad)).is_none());
    }
    assert!(Truth::new(&Ray::new(ray.origin, Vec3::ZERO), &sphere).is_none());
    assert!(Truth::new(&Ray::new(Vec3::ZERO, -Vec3::ZERO), &sphere).is_none());
    assert!(Truth::new(&ray, &Sphere::new(Vec3::ZERO, -1.0)).is_none());
    assert!(Truth::new(&ray, &Sphere::new(Vec3::ZERO, -f32::from_bits(1))).is_none());
}

#[test]
fn exact_numbers_hold_every_float() {
    for value in [0.0, -0.0, 1.0, -0.1, 5e-324, f64::MIN_POSITIVE, f64::MAX, -f64::MAX, 1.0 / 3.0] {
        let exact = Dyadic::exactly(value);
        assert_eq!(exact.approximately(), value);
        assert_eq!(f64::number(value.ordinal()), exact);
        assert_eq!(f64::from_ordinal(f64::ordinal_towards_zero(&exact)), value);
    }
    assert_eq!(f32::number(f32::INFINITE), Dyadic::new(1, 128));
    assert_eq!(f32::ordinal_towards_zero(&Dyadic::new(1, 128)), f32::INFINITE);
    assert_eq!(f32::ordinal_towards_zero(&Dyadic::exactly(-1e300)), -f32::INFINITE);
    assert_eq!(f32::ordinal_towards_zero(&Dyadic::exactly(1e-46)), 0);
    assert_eq!(f32::ulp(&Dyadic::exactly(f32::MAX.into())), 104);
    assert_eq!(f64::ulp(&Dyadic::exactly(1.0)), -52);
    assert_eq!(f64::ulp(&Dyadic::exactly(below(1.0_f64))), -53);
    assert_eq!(f64::ulp(&Dyadic::ZERO), -1074);
}
