//! Properties of all rays, spheres and cameras.

use core::ops::Range;

use approx::abs_diff_eq;
use eyeray::{
    Algebraic, Camera, Geometric, Hit, Hittable, Ray, Scalar, Sphere, Vector, ViewRect, nearest,
};
use glam::{DVec2, DVec3, Vec2, Vec3};
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;

/// The half-line.
fn ahead<S: Scalar>() -> Range<S> {
    S::ZERO..S::INFINITY
}

/// The bounds of a precision.
trait Precision: Vector {
    /// An ulp of 1. A root is within half of it of the exact one, relative to it.
    const ULP: f64;
    /// How far a hit may be from the exact point, relative to |center| + radius: 0.51 ulp a coordinate, half an ulp of the radius
    /// more, and in three coordinates √3 times as much.
    const POINT_ERROR: f64 = 1.01 * 1.7321 * Self::ULP;
    /// How far a ray may be from the exact one at t, relative to its length: direction and product are rounded once each in
    /// f32. In f64 the camera's own rounding counts: 7 ulp for the ray, and 1 for the product.
    const RAY_ERROR: f64;
}

impl Precision for Vec3 {
    const ULP: f64 = f32::EPSILON as f64;
    const RAY_ERROR: f64 = 2.0 * f32::EPSILON as f64;
}

impl Precision for DVec3 {
    const ULP: f64 = f64::EPSILON;
    const RAY_ERROR: f64 = 8.0 * f64::EPSILON;
}

/// That both are a miss, or hits with the same roots, bit for bit but for the sign of zero.
fn same_roots<V: Precision>(
    a: Option<[V::Scalar; 2]>,
    b: Option<[V::Scalar; 2]>,
) -> TestCaseResult {
    prop_assert_eq!(a.is_some(), b.is_some(), "{:?} and {:?}", a, b);
    for (a, b) in a.into_iter().flatten().zip(b.into_iter().flatten()) {
        prop_assert!(a == b, "{a} and {b}");
    }
    Ok(())
}

/// That the algebraic and the geometric routine give the same roots.
///
/// Their points may differ within the error that each may have, because a point is computed from a root that is not yet
/// rounded.
fn agree<V: Precision>(sphere: &Sphere<V>, ray: &Ray<V>) -> TestCaseResult {
    same_roots::<V>(sphere.roots_algebraic(ray), sphere.roots_geometric(ray))?;
    let hits = [
        sphere.intersect(ray, ahead()),
        Algebraic(*sphere).intersect(ray, ahead()),
        Geometric(*sphere).intersect(ray, ahead()),
    ];
    for (a, b) in [(0, 1), (1, 2)] {
        let roots = hits.map(|hit| hit.map(|hit| [hit.t; 2]));
        same_roots::<V>(roots[a], roots[b])?;
    }
    Ok(())
}

/// That the ray at `t` is on the sphere, as far as the root is exact: moving along a ray by x changes the distance to the
/// center by x at most. The measurement itself is made in f64, in about eight operations.
fn on_the_sphere<V: Precision>(sphere: &Sphere<V>, ray: &Ray<V>, t: V::Scalar) -> TestCaseResult {
    let (t, radius): (f64, f64) = (t.into(), sphere.radius.into());
    let from_center = ray.origin.to_f64() - sphere.center.to_f64();
    let along = ray.direction.to_f64() * t;
    let tolerance = 0.5 * V::ULP * along.length()
        + 8.0 * f64::EPSILON * (from_center.length() + along.length());
    let distance = (from_center + along).length();
    prop_assert!(
        abs_diff_eq!(distance, radius, epsilon = tolerance),
        "{distance} from the center, not {radius}"
    );
    Ok(())
}

/// That the point of a hit is on the sphere, and that its normal is the unit vector from the center to there.
fn hit_is_on_the_sphere<V: Precision>(sphere: &Sphere<V>, hit: &Hit<V>) -> TestCaseResult {
    let (center, radius): (DVec3, f64) = (sphere.center.to_f64(), sphere.radius.into());
    let (point, normal) = (hit.point.to_f64(), hit.normal.to_f64());
    let size = center.length() + radius;
    // The measurement itself is made in f64, in about four operations.
    let tolerance = (V::POINT_ERROR + 4.0 * f64::EPSILON) * size;
    let distance = point.distance(center);
    prop_assert!(
        abs_diff_eq!(distance, radius, epsilon = tolerance),
        "{distance} from the center, not {radius}"
    );
    // 2 ulp of 1 a coordinate, √3 times as much in three.
    let unit_tolerance = 2.0 * 1.7321 * V::ULP + 4.0 * f64::EPSILON;
    prop_assert!(abs_diff_eq!(normal.length(), 1.0, epsilon = unit_tolerance));
    let aside = normal * radius - (point - center);
    prop_assert!(
        aside.length() <= unit_tolerance * radius + tolerance,
        "the normal is off by {aside}"
    );
    Ok(())
}

/// That whatever meets the ray gives a hit without a NaN, inside the range and ahead.
fn meets_without_nan<V: Precision>(
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    range: Range<V::Scalar>,
    direction: V,
) -> TestCaseResult {
    let has_nan = |vector: V| vector.to_f64().is_nan();
    for t in sphere.roots_algebraic(ray).into_iter().chain(sphere.roots_geometric(ray)).flatten() {
        let t: f64 = t.into();
        prop_assert!(!t.is_nan());
    }
    let hits = [
        sphere.intersect(ray, range.clone()),
        Algebraic(*sphere).intersect(ray, range.clone()),
        Geometric(*sphere).intersect(ray, range.clone()),
        nearest(&[*sphere, *sphere], ray, range.clone()).map(|(_, hit)| hit),
    ];
    prop_assert_eq!(sphere.occludes(ray, range.clone()), hits[0].is_some());
    for hit in hits.into_iter().flatten() {
        prop_assert!(
            hit.t > V::Scalar::ZERO && hit.t < V::Scalar::INFINITY && range.contains(&hit.t),
            "{hit:?}"
        );
        prop_assert!(!has_nan(hit.point) && !has_nan(hit.normal), "{hit:?}");
        let _ = hit.front_face(ray);
        let spawned = hit.spawn(direction);
        prop_assert!(!has_nan(spawned.origin) || has_nan(direction), "{spawned:?} from {hit:?}");
    }
    Ok(())
}

/// The properties, in one precision.
macro_rules! properties {
    ($precision:ident, $scalar:ident, $V:ident, $V2:ident) => {
        mod $precision {
            use super::*;

            type S = $scalar;

            /// A coordinate of everyday size, with all its digits.
            fn coordinate() -> impl Strategy<Value = S> {
                -10.0..10.0 as S
            }

            fn point() -> impl Strategy<Value = $V> {
                [coordinate(), coordinate(), coordinate()].prop_map($V::from)
            }

            /// A ray that is aimed about at the sphere: hits, misses, and origins inside.
            fn scene() -> impl Strategy<Value = (Sphere<$V>, Ray<$V>)> {
                (point(), 0.1..10.0 as S, point(), point(), 0.1..2.0 as S).prop_map(
                    |(center, radius, origin, aside, length)| {
                        let aim = center + aside * (radius * 0.15);
                        (Sphere::new(center, radius), Ray::new(origin, (aim - origin) * length))
                    },
                )
            }

            /// Small integers: sums and products of a few are exact, and so is a scene of them when it is moved.
            fn lattice() -> impl Strategy<Value = $V> {
                let coordinate = || (-100..=100i8).prop_map(S::from);
                [coordinate(), coordinate(), coordinate()].prop_map($V::from)
            }

            /// Every bit pattern: zeros, subnormal numbers, infinities and NaN among them.
            fn any_number() -> impl Strategy<Value = S> {
                // A third is of a size that makes things meet.
                prop_oneof![prop::num::$scalar::ANY, coordinate(), prop::sample::select(vec![0.0, -0.0, 1.0, S::MAX])]
            }

            fn any_point() -> impl Strategy<Value = $V> {
                [any_number(), any_number(), any_number()].prop_map($V::from)
            }

            fn any_scene() -> impl Strategy<Value = (Sphere<$V>, Ray<$V>)> {
                (any_point(), any_number(), any_point(), any_point())
                    .prop_map(|(center, radius, origin, direction)| (Sphere::new(center, radius), Ray::new(origin, direction)))
            }

            fn any_view() -> impl Strategy<Value = ViewRect<S>> {
                [any_number(), any_number(), any_number(), any_number()].prop_map(|[left, right, bottom, top]| ViewRect { left, right, bottom, top })
            }

            proptest! {
                #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

                #[test]
                fn the_two_routines_agree((sphere, ray) in scene()) {
                    agree::<$V>(&sphere, &ray)?;
                }

                #[test]
                fn the_two_routines_agree_on_anything((sphere, ray) in any_scene()) {
                    agree::<$V>(&sphere, &ray)?;
                }

                #[test]
                fn a_root_is_a_point_of_the_sphere((sphere, ray) in scene()) {
                    for t in sphere.roots_algebraic(&ray).into_iter().flatten() {
                        on_the_sphere(&sphere, &ray, t)?;
                    }
                }

                #[test]
                fn a_hit_is_a_point_of_the_sphere((sphere, ray) in scene()) {
                    if let Some(hit) = sphere.intersect(&ray, ahead()) {
                        hit_is_on_the_sphere(&sphere, &hit)?;
                    }
                }

                #[test]
                fn a_longer_direction_divides_t((sphere, ray) in scene(), k in -60..=60i32) {
                    let factor = (2.0 as S).powi(k);
                    let longer = Ray::new(ray.origin, ray.direction * factor);
                    let divided = |roots: Option<[S; 2]>| roots.map(|roots| roots.map(|t| t / factor));
                    prop_assert_eq!(sphere.roots_algebraic(&longer), divided(sphere.roots_algebraic(&ray)));
                    prop_assert_eq!(sphere.roots_geometric(&longer), divided(sphere.roots_geometric(&ray)));
                    let t = |ray| sphere.intersect(ray, ahead()).map(|hit| hit.t);
                    prop_assert_eq!(t(&longer), t(&ray).map(|t| t / factor));
                }

                #[test]
                fn a_larger_scene_multiplies_t((sphere, ray) in scene(), k in -60..=60i32) {
                    let factor = (2.0 as S).powi(k);
                    let larger = Sphere::new(sphere.center * factor, sphere.radius * factor);
                    let far = Ray::new(ray.origin * factor, ray.direction);
                    let expected = sphere.roots_algebraic(&ray).map(|roots| roots.map(|t| t * factor));
                    same_roots::<$V>(larger.roots_algebraic(&far), expected)?;
                    let expected = sphere.roots_geometric(&ray).map(|roots| roots.map(|t| t * factor));
                    same_roots::<$V>(larger.roots_geometric(&far), expected)?;
                }

                #[test]
                fn a_moved_scene_keeps_t(
                    center in lattice(), radius in 1..=100i8, origin in lattice(), direction in lattice(), by in lattice(),
                    k in -20..=20i32,
                ) {
                    let factor = (2.0 as S).powi(k);
                    let sphere = |by: $V| Sphere::new((center + by) * factor, S::from(radius) * factor);
                    let ray = |by: $V| Ray::new((origin + by) * factor, direction);
                    let (here, there) = ((sphere($V::ZERO), ray($V::ZERO)), (sphere(by), ray(by)));
                    same_roots::<$V>(there.0.roots_algebraic(&there.1), here.0.roots_algebraic(&here.1))?;
                    same_roots::<$V>(there.0.roots_geometric(&there.1), here.0.roots_geometric(&here.1))?;
                }

                #[test]
                fn a_mirrored_scene_keeps_t((sphere, ray) in scene()) {
                    let mirrored = Sphere::new(-sphere.center, sphere.radius);
                    let other = Ray::new(-ray.origin, -ray.direction);
                    same_roots::<$V>(mirrored.roots_algebraic(&other), sphere.roots_algebraic(&ray))?;
                    // Backwards along the same line, the roots change their signs and their order.
                    let back = Ray::new(ray.origin, -ray.direction);
                    let expected = sphere.roots_algebraic(&ray).map(|[near, far]| [-far, -near]);
                    same_roots::<$V>(sphere.roots_algebraic(&back), expected)?;
                }

                #[test]
                fn a_root_is_hit_if_it_is_in_the_range((sphere, ray) in scene(), start in 0.0..20.0 as S, size in 0.0..20.0 as S) {
                    let range = start..start + size;
                    let expected = sphere.roots_algebraic(&ray).and_then(|roots| {
                        roots.into_iter().find(|t| *t > 0.0 && range.contains(t))
                    });
                    prop_assert_eq!(sphere.intersect(&ray, range.clone()).map(|hit| hit.t), expected);
                    prop_assert_eq!(sphere.occludes(&ray, range), expected.is_some());
                }

                /// The point at t is off by the error of the ray, by half an ulp for the sum and for the origin, and by what f64
                /// makes of the sums of the camera: 4 ulp of their terms there, and as much back. Seen from the view plane,
                /// where t is 1, that is t times less sideways; and as much in depth, which moves a point that is m distances
                /// aside by m times as much.
                #[test]
                fn projection_undoes_ray_generation(
                    (eye, target, up) in (point(), point(), point()),
                    (u, v) in (coordinate(), coordinate()), distance in 0.5..10.0 as S, t in 0.1..10.0 as S,
                ) {
                    let view = ViewRect::centered(1.0, 1.0);
                    let uv = $V2::new(u, v);
                    for (camera, shrinks, aside) in [
                        (Camera::perspective(eye, target, up, view, distance), t, uv.length() / distance),
                        (Camera::orthographic(eye, target, up, view), 1.0, 0.0),
                    ] {
                        let Ok(camera) = camera else { return Err(TestCaseError::reject("no camera")) };
                        let ray = camera.ray(uv);
                        let point = ray.at(t);
                        let along = f64::from(t * ray.direction.length());
                        let rounded = f64::from(S::EPSILON) * f64::from(point.length() + ray.origin.length());
                        let sums = 8.0 * f64::EPSILON * f64::from(eye.length() + uv.length() + point.length());
                        let off = $V::RAY_ERROR * along + rounded + sums;
                        let tolerance = off * f64::from((1.0 + aside) / shrinks);
                        let Some(back) = camera.project(point) else {
                            return Err(TestCaseError::fail(format!("no ray reaches {point}")));
                        };
                        prop_assert!(
                            abs_diff_eq!(f64::from(back.x), f64::from(u), epsilon = tolerance)
                                && abs_diff_eq!(f64::from(back.y), f64::from(v), epsilon = tolerance),
                            "{uv} became {back}, with a tolerance of {tolerance}"
                        );
                    }
                }

                #[test]
                fn no_bits_make_an_intersection_panic_or_give_nan(
                    (sphere, ray) in any_scene(), start in any_number(), end in any_number(), direction in any_point(), t in any_number(),
                ) {
                    meets_without_nan::<$V>(&sphere, &ray, start..end, direction)?;
                    meets_without_nan::<$V>(&sphere, &ray, ahead(), direction)?;
                    let finite = ray.origin.is_finite() && ray.direction.is_finite() && t.is_finite();
                    prop_assert!(!finite || !ray.at(t).is_nan());
                }

                #[test]
                fn no_bits_make_a_camera_panic_or_finite_ones_give_nan(
                    (eye, target, up) in (any_point(), any_point(), any_point()),
                    view in any_view(), distance in any_number(), fov_y in any_number(), aspect in any_number(),
                    (x, y) in (any_number(), any_number()), (width, height) in (any::<u32>(), any::<u32>()), point in any_point(),
                ) {
                    let cameras = [
                        Camera::orthographic(eye, target, up, view),
                        Camera::perspective(eye, target, up, view, distance),
                        Camera::perspective_fov(eye, target, up, fov_y, aspect),
                        // The view and the distance are rarely all right by chance.
                        Camera::perspective(eye, target, up, ViewRect::centered(4.0, 3.0), 2.0),
                    ];
                    for camera in cameras {
                        let camera = match camera {
                            Ok(camera) => camera,
                            Err(error) => {
                                prop_assert!(!error.to_string().is_empty());
                                continue;
                            }
                        };
                        let finite = x.is_finite() && y.is_finite();
                        let pixel = $V2::new(x, y);
                        let rays = [
                            (camera.ray(pixel), finite),
                            (camera.pixel_ray(pixel, width, height), finite),
                            (camera.pixel_ray(pixel, 0, height % 2), finite),
                        ];
                        let others = [camera.rays(width, height).next(), camera.rays(width, height).next_back()];
                        for (ray, finite) in rays.into_iter().chain(others.into_iter().flatten().map(|ray| (ray, true))) {
                            let nan = ray.origin.is_nan() || ray.direction.is_nan();
                            prop_assert!(!(finite && nan), "{camera:?} {pixel} {ray:?}");
                        }
                        if let Some(uv) = camera.project(point) {
                            prop_assert!(uv.is_finite() && point.is_finite());
                        }
                        prop_assert!(camera.basis().into_iter().all($V::is_finite));
                        prop_assert!(camera.eye().is_finite() && !camera.view().width().is_nan());
                        prop_assert!(camera.distance().is_none_or(|distance| distance > 0.0));
                    }
                }
            }
        }
    };
}

properties!(single, f32, Vec3, Vec2);
properties!(double, f64, DVec3, DVec2);

/// Found by the properties above: a ray that grazes the unit sphere 1e-27 inside its limb. Both routines have the same t,
/// and a half-chord of 4.8e-14 at which their points differ, by far less than an ulp of the radius.
#[test]
fn the_two_routines_agree_on_a_point_at_the_limb() -> TestCaseResult {
    let sphere = Sphere::new(Vec3::new(0.0, 1.151_337_6e-27, 0.0), 1.0);
    let ray = Ray::new(Vec3::new(0.0, 1.0, -6.60017), Vec3::new(0.0, 0.0, 156.097_73));
    agree(&sphere, &ray)?;
    let point = |hit: Option<Hit>| hit.map(|hit| hit.point);
    let algebraic = point(Algebraic(sphere).intersect(&ray, ahead())).unwrap_or(Vec3::NAN);
    let geometric = point(Geometric(sphere).intersect(&ray, ahead())).unwrap_or(Vec3::NAN);
    prop_assert!(algebraic.abs_diff_eq(geometric, 1.5 * f32::EPSILON));
    Ok(())
}
