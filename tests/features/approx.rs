//! Two values are close if all of their fields are.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use core::fmt::Debug;
use eyeray::{Hit, Ray, Sphere, ViewRect};
use glam::{DVec3, Vec3, dvec3, vec3};

/// `one_ulp` and `farther` differ from `value` in one number each, where that is 4: by 1 ulp, and by 2⁻¹¹.
fn check<T>(value: T, one_ulp: &[T], farther: &[T])
where
    T: AbsDiffEq + RelativeEq + UlpsEq + Debug + Copy,
    T::Epsilon: From<f32> + Copy,
{
    let zero = T::Epsilon::from(0.0);
    assert!(value.abs_diff_eq(&value, zero));
    assert!(value.relative_eq(&value, zero, zero));
    assert!(value.ulps_eq(&value, zero, 0));

    for other in one_ulp {
        assert!(!value.abs_diff_eq(other, zero), "{other:?}");
        assert!(value.abs_diff_eq(other, T::Epsilon::from(1e-6)), "{other:?}");
        assert!(!value.relative_eq(other, zero, zero), "{other:?}");
        assert!(value.relative_eq(other, zero, T::default_max_relative()), "{other:?}");
        assert!(!value.ulps_eq(other, zero, 0), "{other:?}");
        assert!(value.ulps_eq(other, zero, 1), "{other:?}");
    }
    for other in farther {
        assert!(!value.abs_diff_eq(other, T::default_epsilon()), "{other:?}");
        assert!(value.abs_diff_eq(other, T::Epsilon::from(1.0 / 1024.0)), "{other:?}");
        assert!(!value.relative_eq(other, T::default_epsilon(), T::default_max_relative()));
        assert!(value.relative_eq(other, zero, T::Epsilon::from(1.0 / 4096.0)), "{other:?}");
        assert!(!value.ulps_eq(other, T::default_epsilon(), T::default_max_ulps()), "{other:?}");
    }
}

/// 4, 1 ulp more, and 2⁻¹¹ more.
const F32: [f32; 3] = [4.0, 4.0 * (1.0 + f32::EPSILON), 4.0 + 1.0 / 2048.0];
const F64: [f64; 3] = [4.0, 4.0 * (1.0 + f64::EPSILON), 4.0 + 1.0 / 2048.0];

#[test]
fn rays() {
    let ray = |x, z| Ray::new(vec3(x, 1.0, 2.0), vec3(0.0, 1.0, z));
    let [a, b, c] = F32;
    check(ray(a, a), &[ray(b, a), ray(a, b)], &[ray(c, a), ray(a, c)]);

    let ray = |x, z| Ray::new(dvec3(x, 1.0, 2.0), dvec3(0.0, 1.0, z));
    let [a, b, c] = F64;
    check(ray(a, a), &[ray(b, a), ray(a, b)], &[ray(c, a), ray(a, c)]);
}

#[test]
fn spheres() {
    let sphere = |y, radius| Sphere::new(vec3(1.0, y, 2.0), radius);
    let [a, b, c] = F32;
    check(sphere(a, a), &[sphere(b, a), sphere(a, b)], &[sphere(c, a), sphere(a, c)]);

    let sphere = |y, radius| Sphere::new(dvec3(1.0, y, 2.0), radius);
    let [a, b, c] = F64;
    check(sphere(a, a), &[sphere(b, a), sphere(a, b)], &[sphere(c, a), sphere(a, c)]);
}

#[test]
fn hits() {
    let hit = |t, x, z| Hit::new(t, vec3(x, 0.0, 0.0), vec3(0.0, 0.0, z), 1e-6);
    let [a, b, c] = F32;
    check(
        hit(a, a, a),
        &[hit(b, a, a), hit(a, b, a), hit(a, a, b)],
        &[hit(c, a, a), hit(a, c, a), hit(a, a, c)],
    );

    let hit = |t, x, z| Hit::new(t, dvec3(x, 0.0, 0.0), dvec3(0.0, 0.0, z), 1e-6);
    let [a, b, c] = F64;
    check(
        hit(a, a, a),
        &[hit(b, a, a), hit(a, b, a), hit(a, a, b)],
        &[hit(c, a, a), hit(a, c, a), hit(a, a, c)],
    );
}

#[test]
fn the_clearance_of_a_hit_does_not_count() {
    let hit = |clearance| Hit::new(1.0, Vec3::X, Vec3::X, clearance);
    assert!(hit(1e-6).relative_eq(&hit(1e-3), 0.0, 0.0));
    let hit = |clearance| Hit::new(1.0, DVec3::X, DVec3::X, clearance);
    assert!(hit(1e-6).ulps_eq(&hit(1e-3), 0.0, 0));
}

#[test]
fn view_rectangles() {
    fn view<S>([left, right, bottom, top]: [S; 4]) -> ViewRect<S> {
        ViewRect { left, right, bottom, top }
    }
    let [a, b, c] = F32;
    let changed = |to| [[to, a, a, a], [a, to, a, a], [a, a, to, a], [a, a, a, to]].map(view);
    check(view([a; 4]), &changed(b), &changed(c));

    let [a, b, c] = F64;
    let changed = |to| [[to, a, a, a], [a, to, a, a], [a, a, to, a], [a, a, a, to]].map(view);
    check(view([a; 4]), &changed(b), &changed(c));
}

#[test]
fn nan_is_close_to_nothing() {
    let sphere = Sphere::new(Vec3::ZERO, f32::NAN);
    assert!(!sphere.abs_diff_eq(&sphere, f32::INFINITY));
    assert!(!sphere.ulps_eq(&sphere, 1.0, u32::MAX));
}
