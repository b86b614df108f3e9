//! `project`, where it is not simply the inverse of `ray`: the points that no eye ray reaches, and the limits of f64.

use eyeray::{Camera, CameraError, Frame, ViewRect};
use glam::{DVec3, Vec2, Vec3, dvec2, dvec3, vec2, vec3};
use proptest::prelude::*;

use crate::dyadic::Dyadic;

const VIEW: ViewRect = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const DVIEW: ViewRect<f64> = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const EYE: Vec3 = Vec3::new(1.0, 2.0, 3.0);

fn perspective() -> Result<Camera, CameraError> {
    Camera::perspective(EYE, EYE - Vec3::Z, Vec3::Y, VIEW, 2.0)
}

fn orthographic() -> Result<Camera, CameraError> {
    Camera::orthographic(EYE, EYE - Vec3::Z, Vec3::Y, VIEW)
}

#[test]
fn perspective_reaches_what_is_before_the_eye() -> Result<(), CameraError> {
    let camera = perspective()?;
    assert_eq!(camera.project(EYE + vec3(1.0, -2.0, -4.0)), Some(vec2(0.5, -1.0)));
    // Between the eye and the view plane as well.
    assert_eq!(camera.project(EYE + vec3(0.5, 0.25, -0.5)), Some(vec2(2.0, 1.0)));
    for unreached in [Vec3::ZERO, Vec3::X, vec3(1.0, -2.0, 0.0), Vec3::Z, vec3(1.0, 1.0, 1e-6)] {
        assert_eq!(camera.project(EYE + unreached), None, "{unreached}");
    }
    Ok(())
}

#[test]
fn orthographic_reaches_what_is_before_the_view_plane() -> Result<(), CameraError> {
    let camera = orthographic()?;
    assert_eq!(camera.project(EYE + vec3(1.0, -2.0, -4.0)), Some(vec2(1.0, -2.0)));
    // On the plane t is 0, and a ray is t > 0.
    for unreached in [Vec3::ZERO, Vec3::X, vec3(1.0, -2.0, 0.0), Vec3::Z, vec3(1.0, 1.0, 1e-6)] {
        assert_eq!(camera.project(EYE + unreached), None, "{unreached}");
    }
    Ok(())
}

#[test]
fn no_ray_reaches_what_is_not_finite() -> Result<(), CameraError> {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for point in [vec3(value, 0.0, 0.0), vec3(0.0, value, 0.0), vec3(0.0, 0.0, value)] {
            assert_eq!(perspective()?.project(point), None);
            assert_eq!(orthographic()?.project(point), None);
        }
    }
    Ok(())
}

#[test]
fn no_ray_reaches_what_needs_an_infinite_u() -> Result<(), CameraError> {
    // u would be 2e38 · 2 / 1e-3.
    assert_eq!(perspective()?.project(vec3(2e38, 0.0, 2.999)), None);
    let camera =
        Camera::orthographic(vec3(-3e38, 0.0, 0.0), vec3(-3e38, 0.0, -1.0), Vec3::Y, VIEW)?;
    assert_eq!(camera.project(vec3(3e38, 0.0, -1.0)), None);
    assert_eq!(camera.project(vec3(0.0, 0.0, -1.0)), Some(Vec2::new(3e38, 0.0)));
    Ok(())
}

#[test]
fn the_largest_and_the_smallest_points_are_projected() -> Result<(), CameraError> {
    let camera = Camera::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, DVIEW, 1.0)?;
    for size in [f64::MAX, 1e300, 1e-300, 4e-320] {
        let point = dvec3(0.25, -0.5, -1.0) * size;
        assert_eq!(camera.project(point), Some(dvec2(0.25, -0.5)), "{size}");
    }

    // The difference of point and eye overflows, what it is projected to does not.
    let eye = dvec3(0.0, 0.0, f64::MAX);
    let point = dvec3(f64::MAX, -f64::MAX, -f64::MAX);
    let camera = Camera::perspective(eye, DVec3::ZERO, DVec3::Y, DVIEW, 1.0)?;
    assert_eq!(camera.project(point), Some(dvec2(0.5, -0.5)));
    let camera = Camera::orthographic(eye, DVec3::ZERO, DVec3::Y, DVIEW)?;
    assert_eq!(camera.project(point), Some(dvec2(f64::MAX, -f64::MAX)));
    assert_eq!(camera.project(dvec3(1.0, 2.0, -f64::MAX)), Some(dvec2(1.0, 2.0)));
    Ok(())
}

/// What is finite is returned, though u, or a quotient on the way, may overflow.
#[test]
fn what_is_finite_is_found_beyond_the_range_of_f64() -> Result<(), CameraError> {
    let frame = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y)?;
    // The quotient is 1e320.
    let camera = frame.perspective(ViewRect::centered(1e-200, 1e-200), 1e-200)?;
    let point = dvec3(1e160, 0.0, -1e-160);
    assert!(camera.project(point).is_some_and(|uv| (uv.x / 1e120 - 1.0).abs() < 1e-15));
    assert_eq!(camera.project_to_pixel(point, 10, 10), None);
    // The view is narrow, and the point in it.
    let point = dvec3(1e100, 2e100, -4e100);
    let pixel = camera.project_to_pixel(point, 10, 10);
    assert!(pixel.is_some_and(|pixel| (pixel - dvec2(7.5, 0.0)).length() < 1e-14), "{pixel:?}");
    // u is 1e360, and the view 1e300 wide.
    let camera = frame.perspective(ViewRect::centered(1e300, 1e300), 1e200)?;
    let point = dvec3(1e160, 0.0, -1.0);
    assert_eq!(camera.project(point), None);
    let pixel = camera.project_to_pixel(point, 10, 10);
    assert!(pixel.is_some_and(|pixel| (pixel.x / 1e61 - 1.0).abs() < 1e-14), "{pixel:?}");
    // The quotient is 1e-400, u is 1e-200, and the view 1e-200 wide.
    let camera = frame.perspective(ViewRect::centered(1e-200, 1e-200), 1e200)?;
    let point = dvec3(1e-200, 0.0, -1e200);
    let pixel = camera.project_to_pixel(point, 10, 10);
    assert!(pixel.is_some_and(|pixel| (pixel.x / 15.0 - 1.0).abs() < 1e-14), "{pixel:?}");

    let camera = frame.orthographic(ViewRect::centered(1.6e308, 1.6e308))?;
    let pixel = camera.project_to_pixel(dvec3(1.6e308, -1.6e308, -1.0), 100, 100);
    assert!(pixel.is_some_and(|pixel| (pixel - 150.0).length() < 1e-12), "{pixel:?}");
    Ok(())
}

/// How far a computed number may be from the exact one, in H of each.
fn check_number(computed: f64, exact: &Dyadic, off: &Dyadic) -> Result<(), TestCaseError> {
    let error = (&Dyadic::exactly(computed) - exact).abs();
    // And half the smallest number.
    let bound = &off.clone().scaled(-53) + &Dyadic::new(1, -1075);
    prop_assert!(error <= bound, "{computed:e} instead of {:e}", exact.approximately());
    Ok(())
}

/// The largest number that is rounded to a finite one.
fn is_finite(exact: &Dyadic, off: &Dyadic) -> Option<bool> {
    let (size, off) = (exact.clone().abs(), off.clone().scaled(-53));
    let largest = Dyadic::exactly(f64::MAX);
    if &size + &off < largest {
        Some(true)
    } else if &size - &off > largest.scaled(1) {
        Some(false)
    } else {
        None
    }
}

/// Any f64, of any exponent.
fn any() -> impl Strategy<Value = f64> {
    use prop::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO, -2.0..2.0f64]
}

fn positive() -> impl Strategy<Value = f64> {
    use prop::num::f64::{NORMAL, POSITIVE, SUBNORMAL};
    prop_oneof![POSITIVE | NORMAL | SUBNORMAL, 0.5..2.0f64]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, ..ProptestConfig::default() })]

    /// u and x against exact arithmetic, over all exponents of each input.
    #[test]
    fn projections_of_any_exponent_are_accurate(
        along in any(), depth in positive(), distance in positive(), left in any(), width in positive(),
    ) {
        const PIXELS: u32 = 1000;
        // At least an ulp wide, and at most half the largest number.
        let left = left.clamp(f64::MIN / 2.0, f64::MAX / 2.0);
        let right = left + width.max(left.abs() * f64::EPSILON).min(f64::MAX / 2.0);
        let view = ViewRect { left, right, bottom: -1.0, top: 1.0 };
        let Ok(frame) = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y) else { panic!("no frame") };
        let [Ok(perspective), Ok(orthographic)] = [frame.perspective(view, distance), frame.orthographic(view)]
            else { panic!("no camera") };
        let point = dvec3(along, 0.0, -depth);
        let exactly = Dyadic::exactly;
        let quotient = (&exactly(along) * &exactly(distance)).divided_by(&exactly(depth), 200);
        // Of the largest vectors, an eighth is taken: that of the smallest numbers is rounded.
        let lost = if depth.max(along.abs()) > 1e307 { Dyadic::new(1, -1072 + 53) } else { Dyadic::ZERO };
        let lost_far = (&lost * &exactly(distance)).divided_by(&exactly(depth), 200);
        for (camera, u, lost) in [(perspective, quotient, lost_far), (orthographic, exactly(along), lost)] {
            // A quotient and a product; and the end result is rounded.
            let off = &u.clone().abs().scaled(1) + &lost;
            let computed = camera.project(point).map(|uv| uv.x);
            if let Some(is_finite) = is_finite(&u, &off) {
                prop_assert_eq!(computed.is_some(), is_finite);
            }
            if let Some(computed) = computed {
                check_number(computed, &u, &off)?;
            }

            // The error of u, in pixels, and the four roundings of x, one to spare.
            let side = &exactly(right) - &exactly(left);
            let pixels = |length: &Dyadic| (length * &exactly(f64::from(PIXELS))).divided_by(&side, 200);
            let x = pixels(&(&u - &exactly(left)));
            let off = &pixels(&off) + &(&x.clone().abs() * &exactly(5.0));
            let computed = camera.project_to_pixel(point, PIXELS, 1).map(|pixel| pixel.x);
            if let Some(is_finite) = is_finite(&x, &off) {
                prop_assert_eq!(computed.is_some(), is_finite, "{:?} {:?}", camera, point);
            }
            if let Some(computed) = computed {
                check_number(computed, &x, &off)?;
            }
        }
    }
}
