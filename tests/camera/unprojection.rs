//! Cameras from glam's own view and projection matrices against unprojection by exact arithmetic, also far from the world's
//! origin; and the way back.

use eyeray::{Camera, Frame, Scalar, ViewRect};
use glam::{DMat4, DVec2, DVec3, Vec3, dvec2};
use proptest::prelude::*;

use crate::accuracy::{ulp_f32, ulp_f64};
use crate::conventions::{Api, Convention, Kind, Lens, Matrices};
use crate::dyadic::Dyadic;

/// The rounding error of an f64 operation.
const H: f64 = f64::EPSILON / 2.0;

/// What the rows of a rotation that are not orthonormal add to a direction, in ε of its length.
///
/// With ε the most by which a product of two rows is off from 0, or of one with itself from 1: W is the third row made as long as
/// 1, off by ε/2. V is off by as much, and by ε along W: √5/2 ε. U is off by ε/2, and by ε along V and along W: 3/2 ε. Together
/// √(1/4 + 5/4 + 9/4) < 1.94; what is left is for ε² and more.
const OF_ROTATION: f64 = 2.0;

/// What ε of glam's view matrices is below, in ulp of 1, where the sine of the angle between up and the direction is at least
/// 0.1.
///
/// Each coordinate of their cross product is rounded by at most 1 ulp of 1, all three by √3; made as long as 1, they are off by
/// ten times that. Nothing else is longer than 2.
const GLAM: f64 = 32.0;

/// What the errors of the sides, each 2 H of itself, add to (u, v), in H of the largest side: in the image, or as far around it
/// as it is wide, one side counts at most twice and the other once, and both u and v are √2 times as much as one.
const OF_VIEW: f64 = 2.0 * 3.0 * 1.42;

/// As in `accuracy_of_pixels`: a direction in f64, in ulp of its length, an origin, in H (|e| + |u| + |v|), and what is rounded
/// in each of three coordinates, in ulp of the largest.
const DIRECTION: f64 = 7.0;
const ORIGIN: f64 = 8.0;
const ROUNDED: f64 = 0.87;

/// Bits of a quotient: far more than any result is compared in.
const BITS: i64 = 300;

type Exact = [Dyadic; 3];

fn exactly(vector: DVec3) -> Exact {
    vector.to_array().map(Dyadic::exactly)
}

fn dot(a: &Exact, b: &Exact) -> Dyadic {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

fn cross(a: &Exact, b: &Exact) -> Exact {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn plus(a: &Exact, b: &Exact) -> Exact {
    [0, 1, 2].map(|i| &a[i] + &b[i])
}

/// How far a computed vector is from the exact one.
fn error(computed: DVec3, exact: &Exact) -> f64 {
    let difference = [0, 1, 2].map(|i| &Dyadic::exactly(computed[i]) - &exact[i]);
    dot(&difference, &difference).square_root(60).approximately()
}

/// A view matrix, exactly.
struct View {
    rows: [Exact; 3],
    translation: Exact,
}

impl View {
    fn new(matrix: DMat4) -> Self {
        assert_eq!(matrix.row(3).to_array(), [0.0, 0.0, 0.0, 1.0]);
        let rows = [0, 1, 2].map(|row| exactly(matrix.row(row).truncate()));
        Self { rows, translation: exactly(matrix.w_axis.truncate()) }
    }

    /// R⁻¹ v.
    fn unrotate(&self, v: &Exact) -> Exact {
        let [x, y, z] = &self.rows;
        let columns = [cross(y, z), cross(z, x), cross(x, y)];
        let determinant = dot(x, &columns[0]);
        [0, 1, 2].map(|i| {
            let coordinate = dot(v, &[0, 1, 2].map(|j| columns[j][i].clone()));
            coordinate.divided_by(&determinant, BITS)
        })
    }

    /// The point that is moved to the origin.
    fn eye(&self) -> Exact {
        self.unrotate(&[0, 1, 2].map(|i| -&self.translation[i]))
    }

    /// ε: the most by which a product of two rows is off from 0, or of one with itself from 1.
    fn misfit(&self) -> f64 {
        let one = Dyadic::exactly(1.0);
        let mut misfit = 0.0;
        for i in 0..3 {
            for j in 0..=i {
                let product = dot(&self.rows[i], &self.rows[j]);
                let off = if i == j { &product - &one } else { product };
                misfit = f64::max(misfit, off.abs().approximately());
            }
        }
        misfit
    }
}

/// The x or y of view space at which the image has `ndc`, where z has that value: of the row of x or y of a projection matrix,
/// and of its last row.
fn on_axis(matrix: DMat4, axis: usize, ndc: &Dyadic, z: f64) -> Dyadic {
    let row = |row: usize| matrix.row(row).to_array().map(Dyadic::exactly);
    let ([x, last], z) = ([row(axis), row(3)], Dyadic::exactly(z));
    let w = &(&last[2] * &z) + &last[3];
    let along = &(ndc * &w) - &(&(&x[2] * &z) + &x[3]);
    along.divided_by(&x[axis], BITS)
}

#[derive(Debug)]
struct Case {
    convention: Convention,
    eye: DVec3,
    direction: DVec3,
    up: DVec3,
    lens: Lens,
    width: u32,
    height: u32,
    /// In parts of the image, and around it.
    place: DVec2,
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from)
}

/// Centered, about the axis or beside it.
fn side() -> impl Strategy<Value = (f64, f64)> {
    prop_oneof![
        (0.1..3.0f64).prop_map(|half| (-half, half)),
        (-3.0..-0.01f64, 0.01..3.0f64),
        (-3.0..3.0f64, 0.1..3.0f64).prop_map(|(start, length)| (start, start + length)),
    ]
}

fn case() -> impl Strategy<Value = Case> {
    let lens = ((side(), side()), 0.01..1.0f64, 2.0..1e4f64, 0.1..2.5f64, 0.3..3.0f64).prop_map(
        |((u, v), near, far, fov_y, aspect)| {
            let view = ViewRect { left: u.0, right: u.1, bottom: v.0, top: v.1 };
            Lens { view, near, far, fov_y, aspect }
        },
    );
    let image = (
        prop_oneof![8u32..30, 100u32..5000],
        prop_oneof![8u32..30, 100u32..5000],
        prop_oneof![[0.0..1.0f64, 0.0..1.0f64], [-1.0..2.0f64, -1.0..2.0f64]].prop_map(DVec2::from),
    );
    let eye = prop_oneof![vector(10.0), vector(1e7)];
    (prop::sample::select(Convention::all()), eye, vector(1.0), vector(1.0), lens, image)
        .prop_map(|(convention, eye, direction, up, lens, (width, height, place))| Case {
            convention,
            eye,
            direction,
            up,
            lens,
            width,
            height,
            place,
        })
        .prop_filter("glam's basis needs a direction, and an up well apart from it", |case| {
            case.direction.normalize_or_zero().cross(case.up.normalize_or_zero()).length() > 0.1
        })
}

/// An ulp of `V`.
fn ulp<V: Matrices>(value: f64) -> f64 {
    if V::IS_SINGLE { ulp_f32(value.abs()) } else { ulp_f64(value.abs()) }
}

fn check<V: Matrices>(case: &Case) -> Result<(), TestCaseError> {
    let Case { convention, width, height, .. } = *case;
    let [eye, direction, up] = [case.eye, case.direction, case.up].map(V::from_f64);
    let view_matrix = V::look_to(convention.is_left_handed, eye, direction, up);
    let projection_matrix = V::projection(convention, case.lens);
    let camera = Camera::from_matrices(&view_matrix, &projection_matrix);
    prop_assert!(camera.is_ok(), "{camera:?}");
    let Ok(camera) = camera else { unreachable!() };
    let (view, projection) =
        (View::new(V::to_doubles(view_matrix)), V::to_doubles(projection_matrix));
    let misfit = view.misfit();
    prop_assert!(misfit < GLAM * ulp::<V>(1.0), "{misfit}");
    let off_axes = OF_ROTATION * misfit;

    // Normalized device coordinates, and the point of view space in the plane at distance 1.
    let size = dvec2(f64::from(width), f64::from(height));
    let pixel = V::vec2_from_f64(case.place * size);
    let DVec2 { x, y } = V::vec2_to_f64(pixel);
    let from_middle = |pixel: f64, pixels: u32| {
        let (pixel, pixels) = (Dyadic::exactly(pixel), Dyadic::exactly(f64::from(pixels)));
        (&pixel.scaled(1) - &pixels).divided_by(&pixels, BITS)
    };
    let (ndc_x, downwards) = (from_middle(x, width), from_middle(y, height));
    let ndc_y = if convention.api == Api::Vulkan { downwards } else { -&downwards };
    let forwards = if convention.is_left_handed { 1.0 } else { -1.0 };
    let u = on_axis(projection, 0, &ndc_x, forwards);
    let v = on_axis(projection, 1, &ndc_y, forwards);
    let ViewRect { left, right, bottom, top } = camera.view();
    let largest_side = [left, right, bottom, top]
        .map(|side: V::Scalar| Into::<f64>::into(side).abs())
        .into_iter()
        .fold(0.0, f64::max);
    let off_view = OF_VIEW * H * largest_side;

    let ray = camera.pixel_ray(pixel, width, height);
    let [origin, direction] = [ray.origin, ray.direction].map(V::to_f64);
    let eye = view.eye();
    let mut eye_off = 0.0;
    for (computed, exact) in camera.eye().to_f64().to_array().iter().zip(&eye) {
        let off = (&Dyadic::exactly(*computed) - exact).abs().approximately();
        // Rounded once; in f32 from an f64.
        prop_assert!(off <= 0.500_000_1 * ulp::<V>(*computed), "{computed} is off by {off}");
        eye_off = f64::max(eye_off, off);
    }

    let uv_length = u.approximately().hypot(v.approximately());
    if convention.is_orthographic() {
        let ahead = view.unrotate(&exactly(DVec3::Z * forwards));
        let bound = off_axes + ROUNDED * ulp::<V>(1.0) + H;
        let off = error(direction, &ahead);
        prop_assert!(off <= bound, "direction off by {off}, beyond {bound}");

        let exact = plus(&eye, &view.unrotate(&[u, v, Dyadic::ZERO]));
        let largest = origin.abs().max_element();
        let bound = off_axes * uv_length
            + off_view
            + eye_off * 3f64.sqrt()
            + ORIGIN * H * (camera.eye().to_f64().length() + 2.0 * uv_length)
            + ROUNDED * ulp::<V>(largest);
        let off = error(origin, &exact);
        prop_assert!(off <= bound, "origin off by {off}, beyond {bound}");
    } else {
        prop_assert_eq!(ray.origin, camera.eye());
        let exact = view.unrotate(&[u, v, Dyadic::exactly(forwards)]);
        let length = direction.length();
        let rounding = if V::IS_SINGLE { ROUNDED } else { DIRECTION };
        let bound = off_axes * length + off_view + rounding * ulp::<V>(length);
        let off = error(direction, &exact);
        prop_assert!(off <= bound, "direction off by {off}, beyond {bound}");
    }
    check_way_back(case, &camera, &view_matrix, misfit)
}

/// The view matrix of the camera is the one that it is from: 2 ε away, and rounded.
fn check_way_back<V: Matrices>(
    case: &Case,
    camera: &Camera<V>,
    view_matrix: &V::Mat4,
    misfit: f64,
) -> Result<(), TestCaseError> {
    let mut back = V::to_doubles(camera.view_matrix());
    if case.convention.is_left_handed {
        back = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * back;
    }
    let matrix = V::to_doubles(*view_matrix);
    let eye = camera.eye().to_f64();
    let off_axes = OF_ROTATION * misfit;
    for row in 0..3 {
        let (a, b) = (back.row(row), matrix.row(row));
        let off = (a - b).truncate().length();
        prop_assert!(off <= off_axes + ROUNDED * ulp::<V>(1.0), "row {row} off by {off}");
        // The rows differ by 2 ε, the eye is rounded in each coordinate, and the result once more.
        let bound = off_axes * eye.length()
            + ROUNDED * ulp::<V>(eye.abs().max_element())
            + 0.51 * ulp::<V>(b.w);
        let off = (a.w - b.w).abs();
        prop_assert!(off <= bound, "translation {row} off by {off}, beyond {bound}");
    }
    prop_assert_eq!(back.row(3).to_array(), [0.0, 0.0, 0.0, 1.0]);
    Ok(())
}

/// What a camera loses on the way through its own matrices, in roundings u of `V`.
///
/// Each element of the rotation is rounded by u/2, a row by √3/2 u, all by 3/2 u. So ε is √3 u, and the basis that is made of the
/// rows is within 1.94 √3 u of them and 4.9 u of the first.
const BASIS_AGAIN: f64 = 5.0;
/// The eye is off by 3/2 u |e|, because of the rotation, by u |e|, because of the translation, and is rounded, by u |e|.
const EYE_AGAIN: f64 = 4.0;
/// A side, in u (|start| + |end|): glam rounds start and end (once more in the near plane), their sum and difference, the
/// reciprocal of that, and two products. What is left of their sum is off by 5 u, of their difference by 5 u of itself, each half
/// as much in a side.
const SIDE_AGAIN: f64 = 6.0;

fn check_again<V: Matrices>(case: &Case) -> Result<(), TestCaseError> {
    let Case { mut convention, lens, .. } = *case;
    if convention.is_symmetric() {
        convention.kind = Kind::Frustum;
    }
    let [eye, direction, up] = [case.eye, case.direction, case.up].map(V::from_f64);
    let ViewRect { left, right, bottom, top } = lens.view;
    let [left, right, bottom, top] = [left, right, bottom, top].map(V::Scalar::from_f64);
    let view = ViewRect { left, right, bottom, top };
    let Ok(frame) = Frame::look_to(eye, direction, up) else { panic!("no frame") };
    let camera = if convention.is_orthographic() {
        frame.orthographic(view)
    } else {
        frame.perspective(view, V::Scalar::ONE)
    };
    let Ok(camera) = camera else { panic!("no camera") };

    // In a left-handed view space, z is the other way.
    let mut view_matrix = V::to_doubles(camera.view_matrix());
    if convention.is_left_handed {
        view_matrix = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * view_matrix;
    }
    let again = Camera::from_matrices(&V::rounded(view_matrix), &V::projection(convention, lens));
    let Ok(again) = again else { panic!("{again:?}") };

    let rounding = if V::IS_SINGLE { f64::from(f32::EPSILON) / 2.0 } else { H };
    let off: f64 = camera
        .basis()
        .into_iter()
        .zip(again.basis())
        .map(|(a, b)| (a.to_f64() - b.to_f64()).length_squared())
        .sum::<f64>()
        .sqrt();
    // And rounded when they are returned.
    let bound = (BASIS_AGAIN + 2.0 * 1.5) * rounding;
    prop_assert!(off <= bound, "basis off by {off}, beyond {bound}");
    let (eye, off) = (eye.to_f64().length(), (eye.to_f64() - again.eye().to_f64()).length());
    prop_assert!(off <= EYE_AGAIN * rounding * eye, "eye {eye} away off by {off}");
    let sides = |view: ViewRect<V::Scalar>| -> [f64; 4] {
        [view.left, view.right, view.bottom, view.top].map(Into::into)
    };
    let (expected, sides) = (sides(view), sides(again.view()));
    for side in 0..4 {
        let off = (expected[side] - sides[side]).abs();
        let other = expected[side ^ 1].abs();
        let bound = (SIDE_AGAIN * (expected[side].abs() + other) + expected[side].abs()) * rounding;
        prop_assert!(off <= bound, "side {side} of {expected:?} off by {off}, beyond {bound}");
    }
    prop_assert_eq!(again.distance().is_none(), convention.is_orthographic());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rays_of_f32_matrices_are_those_of_unprojection(case in case()) {
        check::<Vec3>(&case)?;
    }

    #[test]
    fn rays_of_f64_matrices_are_those_of_unprojection(case in case()) {
        check::<DVec3>(&case)?;
    }

    #[test]
    fn an_f32_camera_survives_its_matrices(case in case()) {
        check_again::<Vec3>(&case)?;
    }

    #[test]
    fn an_f64_camera_survives_its_matrices(case in case()) {
        check_again::<DVec3>(&case)?;
    }
}

/// A field of view is that of `perspective_fov`, whatever the depths.
#[test]
fn a_field_of_view_is_the_same_in_every_convention() {
    let view = ViewRect::centered(1.0, 1.0);
    let lens = Lens { view, near: 0.1, far: 100.0, fov_y: 0.9, aspect: 1.6 };
    let (eye, direction, up) = (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Z, DVec3::Y);
    let frame = Frame::look_to(eye, direction, up).expect("a frame");
    let expected = frame.perspective_fov(lens.fov_y, lens.aspect).expect("a camera").view();
    for convention in Convention::all().into_iter().filter(|convention| convention.is_symmetric()) {
        let view_matrix = DVec3::look_to(convention.is_left_handed, eye, direction, up);
        let projection_matrix = DVec3::projection(convention, lens);
        let camera = Camera::from_matrices(&view_matrix, &projection_matrix).expect("a camera");
        assert_eq!((camera.eye(), camera.distance()), (eye, Some(1.0)));
        let right = if convention.is_left_handed { DVec3::NEG_X } else { DVec3::X };
        assert_eq!(camera.basis(), [right, DVec3::Y, DVec3::Z], "{convention:?}");
        let off = [camera.view().right - expected.right, camera.view().top - expected.top];
        assert!(off.iter().all(|off| off.abs() < 1e-15), "{convention:?}: {:?}", camera.view());
    }
}
