//! The pixels' rays and the projections against exact arithmetic, for view rectangles on and off the axis.

use eyeray::{Camera, Frame, Scalar, Vector, ViewRect};
use glam::{DVec2, DVec3, Vec3, dvec2};
use proptest::prelude::*;

use crate::accuracy::{ulp_f32, ulp_f64};
use crate::exact::{self, Number, ViewPoint};

/// The rounding error of an f64 operation.
const H: f64 = f64::EPSILON / 2.0;

/// A direction in f64, in ulp of its length L, which are at least H L. With P the part of L in the view plane and d the distance:
///
/// - u and v are off by 2 H of themselves (src/camera/pixels.rs): 2 P.
/// - Each vector of the basis is off by √3/2 H, three coordinates by half an ulp: 0.87 (|u| + |v| + d).
/// - Their products with u, v and d are rounded: |u| + |v| + d.
/// - So are the two sums: P or less, and L.
///
/// In H: at most (2 + 1.87 √2 + 1) P + 1.87 d + L ≤ (5.94 + 1) L.
const DIRECTION: f64 = 7.0;

/// An origin in f64, in H (|e| + |u| + |v|): 2 + 0.87 + 1 as above, and two sums.
const ORIGIN: f64 = 6.0;

/// The same in f32, where half an ulp in each of three coordinates is added.
const ROUNDED: f64 = 0.87;
const ORIGIN_IN_F32: f64 = 8.0;

/// A distance along an axis of the basis, in H |f|, f being where the point is from the eye: 1 from the difference, 3 from the
/// dot product and 0.87 from the basis.
const ALONG_AXIS: f64 = 5.0;

/// u or v of a perspective camera, in H L (1 + L/d): 4.87 L, as above, and as much times L/d for the depth, and 2 L for a
/// division and a multiplication; L/d is at least 1.
const PROJECTED: f64 = 6.0;

/// A pixel, in H of itself: a subtraction, the size of the view, a division and a multiplication.
const PIXEL: f64 = 4.0;

#[derive(Debug)]
struct Case {
    eye: DVec3,
    direction: DVec3,
    up: DVec3,
    view: ViewRect<f64>,
    distance: f64,
    width: u32,
    height: u32,
    /// In parts of the image, and a little around it.
    place: DVec2,
    depth: f64,
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from)
}

/// A side of the view rectangle: centered, about the axis, or far off it.
fn side() -> impl Strategy<Value = (f64, f64)> {
    prop_oneof![
        (0.01..4.0f64).prop_map(|half| (-half, half)),
        (-3.0..-0.001f64, 0.001..3.0f64),
        (-1000.0..1000.0f64, 0.01..10.0f64).prop_map(|(start, length)| (start, start + length)),
    ]
}

fn pixels() -> impl Strategy<Value = u32> {
    prop_oneof![1u32..9, 1u32..5000, Just(1 << 24)]
}

fn case() -> impl Strategy<Value = Case> {
    let camera = (
        prop_oneof![vector(10.0), vector(1e7)],
        vector(1.0),
        vector(1.0),
        (side(), side()),
        prop_oneof![0.5..4.0f64, 0.001..0.1f64],
    );
    let place = prop_oneof![[0.0..1.0f64, 0.0..1.0f64], [-1.0..2.0f64, -1.0..2.0f64]];
    let image = (pixels(), pixels(), place.prop_map(DVec2::from), 0.01..100.0f64);
    (camera, image)
        .prop_map(|((eye, direction, up, (u, v), distance), (width, height, place, depth))| {
            let view = ViewRect { left: u.0, right: u.1, bottom: v.0, top: v.1 };
            Case { eye, direction, up, view, distance, width, height, place, depth }
        })
        .prop_filter("a direction of view, and an up apart from it", |case| {
            case.direction.cross(case.up).length() > 1e-6
        })
        .prop_filter("a direction as long as a part of a pixel", |case| {
            // Of a whole image in one pixel, most of the error would be that of the pixel.
            let pixel = case.view.width() / f64::from(case.width);
            let row = case.view.height() / f64::from(case.height);
            case.distance > pixel.max(row) / 8.0
        })
}

/// What rounding to a precision adds to a coordinate of that size.
trait Rounding: Vector {
    const IS_SINGLE: bool;
}

impl Rounding for Vec3 {
    const IS_SINGLE: bool = true;
}

impl Rounding for DVec3 {
    const IS_SINGLE: bool = false;
}

fn half_ulp<V: Rounding>(value: f64) -> f64 {
    if V::IS_SINGLE { ulp_f32(value.abs()) / 2.0 } else { 0.0 }
}

/// The view in the precision of `V`, and back.
fn rounded_view<V: Vector>(view: ViewRect<f64>) -> (ViewRect<V::Scalar>, ViewRect<f64>) {
    let [left, right, bottom, top] =
        [view.left, view.right, view.bottom, view.top].map(V::Scalar::from_f64);
    let rounded = ViewRect { left, right, bottom, top };
    let [left, right, bottom, top] = [left, right, bottom, top].map(Into::into);
    (rounded, ViewRect { left, right, bottom, top })
}

fn check<V: Rounding>(case: &Case) -> Result<(), TestCaseError> {
    let [eye, direction, up] = [case.eye, case.direction, case.up].map(V::from_f64);
    let distance = V::Scalar::from_f64(case.distance);
    let (view, exact_view) = rounded_view::<V>(case.view);
    let (width, height) = (case.width, case.height);
    let Ok(frame) = Frame::look_to(eye, direction, up) else { panic!("no frame") };
    let cameras = (frame.perspective(view, distance), frame.orthographic(view));
    let (Ok(perspective), Ok(orthographic)) = cameras else { return Ok(()) };
    let exact = exact::Camera::look_to(eye.to_f64(), direction.to_f64(), up.to_f64());
    let distance: f64 = distance.into();

    let size = dvec2(f64::from(width), f64::from(height));
    let pixel = V::vec2_from_f64(case.place * size);
    let uv = ViewPoint::of_pixel(exact_view, V::vec2_to_f64(pixel), width, height);

    let ray = perspective.pixel_ray(pixel, width, height);
    prop_assert_eq!(ray.origin, eye);
    let along = exact.direction(&uv, distance);
    let length = along.length();
    let (ulp, bound) =
        if V::IS_SINGLE { (ulp_f32(length), ROUNDED) } else { (ulp_f64(length), DIRECTION) };
    let error = along.error(ray.direction.to_f64()) / ulp;
    prop_assert!(error <= bound, "direction {error} ulp");

    let ray = orthographic.pixel_ray(pixel, width, height);
    let from = exact.origin(&uv);
    let terms = H * (eye.to_f64().length() + uv.length());
    let bound = if V::IS_SINGLE {
        ROUNDED * ulp_f32(from.largest_coordinate()) + ORIGIN_IN_F32 * terms
    } else {
        ORIGIN * terms
    };
    let error = from.error(ray.origin.to_f64());
    prop_assert!(error <= bound, "origin off by {error}, beyond {bound}");

    // A point that this pixel shows, rounded to V: wherever it is then.
    let t = V::Scalar::from_f64(case.depth / distance);
    let point = perspective.pixel_ray(pixel, width, height).at(t);
    let [u, v, depth] = exact.see(point.to_f64());
    let from_eye = (u.to_f64().powi(2) + v.to_f64().powi(2) + depth.to_f64().powi(2)).sqrt();
    prop_assume!(depth.to_f64() > 1e-6 * from_eye);

    let off = ALONG_AXIS * H * from_eye;
    for camera in [perspective, orthographic] {
        let computed: f64 = camera.depth(point).into();
        let (error, bound) = (depth.error(computed), off + half_ulp::<V>(computed));
        prop_assert!(error <= bound, "depth off by {error}, beyond {bound}");
    }
    check_projection(&orthographic, point, [&u, &v], off, exact_view, (width, height))?;

    let along = [&u, &v].map(|along| along.times(&Number::new(distance), &depth));
    let length = from_eye / depth.to_f64() * distance;
    let off = PROJECTED * H * length * (1.0 + length / distance);
    check_projection(&perspective, point, [&along[0], &along[1]], off, exact_view, (width, height))
}

/// That the camera projects the point to where it should, in the view plane and in the image. u and v may be off by so much
/// before they are rounded.
fn check_projection<V: Rounding>(
    camera: &Camera<V>,
    point: V,
    uv: [&Number; 2],
    off: f64,
    view: ViewRect<f64>,
    (width, height): (u32, u32),
) -> Result<(), TestCaseError> {
    let Some(computed) = camera.project(point).map(V::vec2_to_f64) else { panic!("not seen") };
    for (exact, computed) in uv.into_iter().zip(computed.to_array()) {
        let (error, bound) = (exact.error(computed), off + half_ulp::<V>(computed));
        prop_assert!(error <= bound, "u or v off by {error}, beyond {bound}");
    }

    let pixel = camera.project_to_pixel(point, width, height).map(V::vec2_to_f64);
    let Some(computed) = pixel else { panic!("not seen") };
    let [left, right, bottom, top] =
        [view.left, view.right, view.bottom, view.top].map(Number::new);
    let sides = [(&left, &right, width), (&top, &bottom, height)];
    for ((exact, computed), (start, end, pixels)) in
        uv.into_iter().zip(computed.to_array()).zip(sides)
    {
        let side = end.minus(start);
        let exact = exact.minus(start).times(&Number::new(f64::from(pixels)), &side);
        let a_pixel = side.to_f64().abs() / f64::from(pixels);
        let bound = off / a_pixel + PIXEL * H * computed.abs() + half_ulp::<V>(computed);
        let error = exact.error(computed);
        prop_assert!(error <= bound, "pixel off by {error}, beyond {bound}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pixels_in_f32_are_accurate(case in case()) {
        check::<Vec3>(&case)?;
    }

    #[test]
    fn pixels_in_f64_are_accurate(case in case()) {
        check::<DVec3>(&case)?;
    }
}

/// The two sides of the view cancel: plain f64 leaves thousands of ulp of them.
#[test]
fn a_direction_near_the_axis_of_a_wide_view_keeps_its_digits() {
    let view = ViewRect { left: -0.7, right: 0.3, bottom: -0.9, top: 0.1 };
    let frame = Frame::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y).expect("a frame");
    let exact = exact::Camera::look_to(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y);
    for (width, height, distance) in
        [(1001, 977, 1e-3), (1, 1, 0.1), (1 << 24, 3, 1e-3), (7, 5, 0.05)]
    {
        let camera = frame.perspective(view, distance).expect("a camera");
        let axis = dvec2(0.7 * f64::from(width), 0.1 * f64::from(height));
        for (x, y) in [(0.0, 0.0), (0.3, 0.2), (-0.1, 1e-3), (1e-7, -1e-5), (2.9e-11, 1.7e-13)] {
            let pixel = axis + dvec2(x, y);
            let along = exact.direction(&ViewPoint::of_pixel(view, pixel, width, height), distance);
            let error = along.error(camera.pixel_ray(pixel, width, height).direction);
            // The basis is exact and straight: what remains are two roundings of u and v, and two of their products.
            let bound = 3.0 * ulp_f64(along.length());
            assert!(error <= bound, "{pixel} of {width} by {height}: {error:e}, beyond {bound:e}");
        }
    }
}
