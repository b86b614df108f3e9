//! Rays and bases against exact arithmetic.

use approx::assert_abs_diff_eq;
use eyeray::{Camera, CameraError, ViewRect};
use glam::{DVec2, DVec3, Vec2, Vec3, dvec3, vec3};
use proptest::prelude::*;

use crate::exact::{self, ViewPoint};

/// The distance between neighboring f32 at `value`.
pub(crate) fn ulp_f32(value: f64) -> f64 {
    let exponent = value.log2().floor().clamp(-126.0, 127.0);
    2f64.powf(exponent - 23.0)
}

/// The distance between neighboring f64 at `value`.
pub(crate) fn ulp_f64(value: f64) -> f64 {
    let exponent = value.log2().floor().max(-1022.0);
    f64::MIN_POSITIVE.max(2f64.powf(exponent)) * f64::EPSILON
}

const VIEW: ViewRect = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const DVIEW: ViewRect<f64> = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };

/// What a test of accuracy needs: eye, target, up, (u, v) and the distance.
type Case<V, V2, S> = (V, V, V, V2, S);

fn coordinate(size: f32) -> impl Strategy<Value = f32> {
    -size..size
}

fn point(size: f32) -> impl Strategy<Value = Vec3> {
    [coordinate(size), coordinate(size), coordinate(size)].prop_map(Vec3::from)
}

fn pair(size: f32) -> impl Strategy<Value = Vec2> {
    [coordinate(size), coordinate(size)].prop_map(Vec2::from)
}

/// A scene of everyday size.
fn everyday() -> impl Strategy<Value = Case<Vec3, Vec2, f32>> {
    (point(100.0), point(100.0), point(2.0), pair(4.0), 0.1f32..10.0)
}

/// Eye and target a hundred kilometers from the origin, and ten centimeters from each other.
fn distant() -> impl Strategy<Value = Case<Vec3, Vec2, f32>> {
    (point(1e5), point(0.1), point(2.0), pair(4.0), 0.1f32..10.0)
        .prop_map(|(eye, view, up, uv, distance)| (eye, eye + view, up, uv, distance))
}

/// Up as near to the view as f32 allows: a multiple of the view, with a coordinate moved by a few ulp.
fn nearly_parallel() -> impl Strategy<Value = Case<Vec3, Vec2, f32>> {
    (point(10.0), point(10.0), 0.01f32..100.0, 0usize..3, -3i32..=3, pair(4.0), 0.1f32..10.0)
        .prop_map(|(eye, target, factor, axis, steps, uv, distance)| {
            let mut up = (eye - target) * factor;
            up[axis] = f32::from_bits(up[axis].to_bits().wrapping_add_signed(steps));
            (eye, target, up, uv, distance)
        })
}

/// Any exponent at all, for every number on its own.
fn extreme() -> impl Strategy<Value = Case<Vec3, Vec2, f32>> {
    use prop::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    let any = || POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO;
    let point = move || [any(), any(), any()].prop_map(Vec3::from);
    (point(), point(), point(), [any(), any()].prop_map(Vec2::from), POSITIVE | NORMAL | SUBNORMAL)
}

/// The same in f64.
fn extreme_f64() -> impl Strategy<Value = Case<DVec3, DVec2, f64>> {
    use prop::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    let any = || POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO;
    let point = move || [any(), any(), any()].prop_map(DVec3::from);
    (point(), point(), point(), [any(), any()].prop_map(DVec2::from), POSITIVE | NORMAL | SUBNORMAL)
}

/// Any f64 of everyday size, and up at any angle to the view down to the least there is.
fn nearly_parallel_f64() -> impl Strategy<Value = Case<DVec3, DVec2, f64>> {
    let any = || -10.0..10.0f64;
    let point = move || [any(), any(), any()].prop_map(DVec3::from);
    (
        point(),
        point(),
        0.01..100.0f64,
        point(),
        0..60i32,
        [any(), any()].prop_map(DVec2::from),
        0.1..10.0f64,
    )
        .prop_map(|(eye, target, factor, aside, exponent, uv, distance)| {
            let up = (eye - target) * factor + aside * 0.5f64.powi(exponent);
            (eye, target, up, uv, distance)
        })
}

/// Both cameras of one case against the exact ones.
fn check_f32((eye, target, up, uv, distance): Case<Vec3, Vec2, f32>) -> Result<(), TestCaseError> {
    let (exact_eye, exact_target, exact_up) = (eye.as_dvec3(), target.as_dvec3(), up.as_dvec3());
    let perspective = Camera::perspective(eye, target, up, VIEW, distance);
    let orthographic = Camera::orthographic(eye, target, up, VIEW);
    if exact::parallel(exact_eye, exact_target, exact_up) {
        prop_assert!(perspective.is_err() && orthographic.is_err());
        return Ok(());
    }
    prop_assert!(perspective.is_ok() && orthographic.is_ok(), "{perspective:?}");
    let (Ok(perspective), Ok(orthographic)) = (perspective, orthographic) else { unreachable!() };
    let exact = exact::Camera::new(exact_eye, exact_target, exact_up);

    for (computed, exact) in perspective.basis().into_iter().zip(exact.basis()) {
        // Each coordinate is rounded once, from f64: half an ulp of 1, three times in quadrature, and a little.
        prop_assert!(exact.error(computed.as_dvec3()) <= 0.87 * f64::from(f32::EPSILON) / 2.0);
    }

    let direction = exact.direction(&ViewPoint::new(uv.as_dvec2()), f64::from(distance));
    let ray = perspective.ray(uv);
    prop_assert_eq!(ray.origin, eye);
    if direction.largest_coordinate() < f64::from(f32::MAX) {
        // Likewise. The contract asks for 4.
        let error = direction.error(ray.direction.as_dvec3()) / ulp_f32(direction.length());
        prop_assert!(error <= 0.87, "direction {error} ulp");
    }

    let origin = exact.origin(&ViewPoint::new(uv.as_dvec2()));
    let ray = orthographic.ray(uv);
    prop_assert_eq!(ray.direction, -orthographic.basis()[2]);
    if origin.largest_coordinate() < f64::from(f32::MAX) {
        // Where the terms cancel, the f64 that they were added in shows: 2^-50 is 8 of its half ulps.
        let cancelled = (eye.as_dvec3().length() + uv.as_dvec2().length()) * 2f64.powi(-50);
        let error = origin.error(ray.origin.as_dvec3());
        let bound = 0.87 * ulp_f32(origin.largest_coordinate()) + cancelled;
        prop_assert!(error <= bound, "origin off by {error}, beyond {bound}");
    }
    Ok(())
}

/// The basis and the direction of one case in f64.
fn check_f64(
    (eye, target, up, uv, distance): Case<DVec3, DVec2, f64>,
) -> Result<(), TestCaseError> {
    let camera = Camera::perspective(eye, target, up, DVIEW, distance);
    if exact::parallel(eye, target, up) {
        prop_assert!(camera.is_err());
        return Ok(());
    }
    prop_assert!(camera.is_ok(), "{camera:?}");
    let Ok(camera) = camera else { unreachable!() };
    let exact = exact::Camera::new(eye, target, up);

    for (computed, exact) in camera.basis().into_iter().zip(exact.basis()) {
        // Rounded once here too.
        let error = exact.error(computed) / f64::EPSILON;
        prop_assert!(error <= 0.87 / 2.0, "basis {error} ulp of 1");
    }
    let direction = exact.direction(&ViewPoint::new(uv), distance);
    if direction.length() < f64::MAX / 4.0 {
        let error = direction.error(camera.ray(uv).direction) / ulp_f64(direction.length());
        // A coordinate sums up three products. With L the length of the direction, they come to L at most, and are off by
        // half an ulp of L each: √3 half ulps from the basis in quadrature, one from the products, two from the sums,
        // 3.9 in all with a half ulp counted generously, as 2^-53 L. Three coordinates are √3 times as much.
        prop_assert!(error <= 7.0, "direction {error} ulp");
    }
    Ok(())
}

/// The lengths and the right angles of a basis in f64.
fn check_orthonormal([u, v, w]: [DVec3; 3]) {
    for axis in [u, v, w] {
        assert_abs_diff_eq!(axis.length_squared(), 1.0, epsilon = 1e-15);
    }
    for (a, b) in [(u, v), (v, w), (w, u)] {
        assert_abs_diff_eq!(a.dot(b), 0.0, epsilon = 1e-15);
    }
    // Right-handed: u × v = w.
    assert_abs_diff_eq!((u.cross(v) - w).length(), 0.0, epsilon = 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn everyday_rays_are_rounded_once(case in everyday()) {
        check_f32(case)?;
    }

    #[test]
    fn distant_rays_are_rounded_once(case in distant()) {
        check_f32(case)?;
    }

    #[test]
    fn rays_with_up_nearly_along_the_view_are_rounded_once(case in nearly_parallel()) {
        check_f32(case)?;
    }

    #[test]
    fn rays_of_any_magnitude_are_rounded_once(case in extreme()) {
        check_f32(case)?;
    }

    #[test]
    fn f64_rays_of_any_magnitude_are_accurate(case in extreme_f64()) {
        check_f64(case)?;
    }

    #[test]
    fn f64_rays_with_up_nearly_along_the_view_are_accurate(case in nearly_parallel_f64()) {
        check_f64(case)?;
    }

    #[test]
    fn a_basis_is_orthonormal(case in nearly_parallel_f64(), extreme in extreme_f64()) {
        for (eye, target, up, ..) in [case, extreme] {
            if let Ok(camera) = Camera::orthographic(eye, target, up, DVIEW) {
                check_orthonormal(camera.basis());
            }
        }
    }

    /// A ray that starts near the origin of the scene, by an eye far from it: the terms cancel.
    #[test]
    fn an_origin_near_zero_keeps_its_digits(eye in pair(1e5), up in pair(1.0), depth in 0.1f32..10.0) {
        let (eye, up) = (eye.extend(0.0), up.extend(0.0));
        prop_assume!(up != Vec3::ZERO);
        let camera = Camera::orthographic(eye, eye - vec3(0.0, 0.0, depth), up, VIEW);
        prop_assert!(camera.is_ok());
        let Ok(camera) = camera else { unreachable!() };
        let [u, v, _] = camera.basis();
        check_f32((eye, eye - vec3(0.0, 0.0, depth), up, Vec2::new(-eye.dot(u), -eye.dot(v)), 1.0))?;
    }
}

#[test]
fn extreme_vectors_give_the_basis_of_everyday_ones() {
    let camera =
        |eye, target, up| Camera::orthographic(eye, target, up, DVIEW).map(|camera| camera.basis());
    let everyday = camera(dvec3(0.0, 3.0, 4.0), DVec3::ZERO, dvec3(0.0, 1.0, 0.0));
    assert_eq!(everyday, Ok([DVec3::X, dvec3(0.0, 0.8, -0.6), dvec3(0.0, 0.6, 0.8)]));

    // Powers of two of the above, up to the largest and down to subnormal.
    for (size, up) in
        [(1020, -1000), (1020, -1074), (-1074, 1023), (-1074, -1074), (512, 512), (-512, -512)]
    {
        let power = |exponent: i32| 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        let eye = dvec3(0.0, 3.0, 4.0) * power(size);
        assert_eq!(camera(eye, DVec3::ZERO, DVec3::Y * power(up)), everyday, "2^{size}, 2^{up}");
    }
    // The difference overflows.
    let corner = dvec3(0.0, 0.0, f64::MAX);
    assert_eq!(camera(corner, -corner, DVec3::Y), Ok([DVec3::X, DVec3::Y, DVec3::Z]));
    assert_eq!(camera(dvec3(1e300, 0.0, 0.0), DVec3::ZERO, dvec3(0.0, 1e-300, 0.0)), {
        Ok([DVec3::NEG_Z, DVec3::Y, DVec3::X])
    });
}

#[test]
fn up_is_refused_only_if_exactly_parallel() {
    let eye = vec3(1.0, 2.0, 3.0);
    let camera = |up| Camera::orthographic(eye, Vec3::ZERO, up, VIEW);
    for factor in [1.0, -1.0, 0.5, 3.0, 1e30, -1e-30] {
        // 3 and the powers of ten round nothing here: 2 and 3 times such a number may.
        let up = Vec3::splat(factor);
        let parallel = Camera::orthographic(Vec3::splat(7.0), Vec3::splat(5.0), up, VIEW);
        assert_eq!(parallel, Err(CameraError::UpAlongView), "{factor}");
    }
    assert_eq!(camera(eye * 2.0), Err(CameraError::UpAlongView));
    // One ulp aside, the basis is as good as any other.
    assert!(camera(vec3(1.0, 2.0, f32::from_bits(3f32.to_bits() + 1))).is_ok());
    let nearly = dvec3(1.0, 2.0, f64::from_bits(3f64.to_bits() + 1));
    let basis = Camera::orthographic(dvec3(1.0, 2.0, 3.0), DVec3::ZERO, nearly, DVIEW)
        .map(|camera| camera.basis());
    check_orthonormal(basis.expect("not parallel"));
}
