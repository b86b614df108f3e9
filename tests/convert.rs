//! Conversions to `f64` are exact, and those to `f32` round once.

use eyeray::{Hit, Hittable, Ray, Sphere, ViewRect};
use glam::{DVec3, Vec3, dvec3, vec3};
use proptest::prelude::*;

/// Numbers, and the nearest of `f32` to each, ties to even.
fn rounded() -> [(f64, f32); 14] {
    let ulp = f64::from(f32::EPSILON);
    let (largest, smallest) = (f64::from(f32::MAX), f64::from(f32::from_bits(1)));
    // Half an ulp of the largest.
    let half = 2.0_f64.powi(103);
    [
        (1.0 + 0.5 * ulp, 1.0),
        (1.0 + 0.500_000_1 * ulp, 1.0 + f32::EPSILON),
        (1.0 + 1.5 * ulp, 1.0 + 2.0 * f32::EPSILON),
        (-1.0 - 1.5 * ulp, -1.0 - 2.0 * f32::EPSILON),
        (0.1, 0.1),
        (-0.0, -0.0),
        (largest + 0.999 * half, f32::MAX),
        (largest + half, f32::INFINITY),
        (-1e300, f32::NEG_INFINITY),
        (f64::INFINITY, f32::INFINITY),
        (0.5 * smallest, 0.0),
        (0.500_000_1 * smallest, f32::from_bits(1)),
        (-2.5 * smallest, -f32::from_bits(2)),
        (-1e-300, -0.0),
    ]
}

#[test]
fn each_number_is_rounded_to_the_nearest() {
    for (x, nearest) in rounded() {
        let ray = Ray::new(dvec3(x, 2.0, 3.0), dvec3(4.0, x, 6.0)).to_f32();
        let sphere = Sphere::new(dvec3(1.0, 2.0, x), x).to_f32();
        let view = ViewRect { left: x, right: 1.0, bottom: 2.0, top: x }.to_f32();
        for y in
            [ray.origin.x, ray.direction.y, sphere.center.z, sphere.radius, view.left, view.top]
        {
            assert_eq!(y.to_bits(), nearest.to_bits(), "{x:e}");
        }
    }
}

#[test]
fn every_field_stays_in_its_place() {
    let ray = Ray::new(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0));
    let wide = Ray::new(dvec3(1.0, 2.0, 3.0), dvec3(4.0, 5.0, 6.0));
    assert_eq!((Ray::<DVec3>::from(ray), wide.to_f32()), (wide, ray));

    let sphere = Sphere::new(vec3(1.0, 2.0, 3.0), 4.0);
    let wide = Sphere::new(dvec3(1.0, 2.0, 3.0), 4.0);
    assert_eq!((Sphere::<DVec3>::from(sphere), wide.to_f32()), (wide, sphere));

    let view = ViewRect { left: 1.0_f32, right: 2.0, bottom: 3.0, top: 4.0 };
    let wide = ViewRect { left: 1.0_f64, right: 2.0, bottom: 3.0, top: 4.0 };
    assert_eq!((ViewRect::<f64>::from(view), wide.to_f32()), (wide, view));

    let hit = Hit::new(1.0, vec3(2.0, 3.0, 4.0), vec3(5.0, 6.0, 7.0), 8.0);
    let wide = Hit::<DVec3>::from(hit);
    let (point, normal) = (dvec3(2.0, 3.0, 4.0), dvec3(5.0, 6.0, 7.0));
    assert_eq!((wide.t, wide.point, wide.normal), (1.0, point, normal));
    // The point stays as coarse as it is.
    assert!((f64::from(hit.clearance())..8.001).contains(&wide.clearance()));
}

proptest! {
    #[test]
    fn there_and_back_is_the_same(bits in any::<[u32; 6]>()) {
        // Infinities and subnormal numbers among them; a NaN need not keep its bits.
        let [a, b, c, d, e, f] = bits.map(f32::from_bits).map(|x| if x.is_nan() { 0.0 } else { x });
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);

        let ray = Ray::new(vec3(a, b, c), vec3(d, e, f));
        let back = Ray::<DVec3>::from(ray).to_f32();
        prop_assert_eq!(bits(back.origin), bits(ray.origin));
        prop_assert_eq!(bits(back.direction), bits(ray.direction));

        let sphere = Sphere::new(vec3(a, b, c), d);
        let back = Sphere::<DVec3>::from(sphere).to_f32();
        prop_assert_eq!(bits(back.center), bits(sphere.center));
        prop_assert_eq!(back.radius.to_bits(), sphere.radius.to_bits());
    }

    /// The hit of an f32 ray, continued in f64: what is spawned there leaves the sphere, or meets its far wall.
    #[test]
    fn a_hit_goes_on_in_f64(
        target in [-0.7_f32..0.7, -0.7_f32..0.7], to in [-1.0_f64..1.0, -1.0_f64..1.0, -1.0_f64..1.0],
    ) {
        let sphere = Sphere::new(vec3(3.0, -2.0, -9.0), 1.0);
        let ray = Ray::new(Vec3::ZERO, sphere.center + vec3(target[0], target[1], 0.0));
        let hit = sphere.intersect(&ray, 0.0..f32::INFINITY);
        prop_assert!(hit.is_some());
        let (Some(hit), to) = (hit.map(Hit::<DVec3>::from), DVec3::from(to)) else { return Ok(()) };
        let met = Sphere::<DVec3>::from(sphere).intersect(&hit.spawn(to), 0.0..f64::INFINITY);
        prop_assert_eq!(met.is_some(), to.dot(hit.normal) < 0.0);
    }
}

/// What `Ray::to_f32` warns of: rays that leave a surface do not hit it, and about half of them do once they are rounded.
#[test]
fn a_spawned_ray_is_rounded_back_to_its_surface() {
    let sphere = Sphere::new(dvec3(0.3, -0.7, 20.0), 1.1);
    let (mut rays, mut hit_again) = (0, 0);
    for i in -30..=30_i8 {
        for k in -30..=30_i8 {
            let direction = dvec3(0.3 + f64::from(i) * 0.03, -0.7 + f64::from(k) * 0.03, 20.0);
            let ray = Ray::new(DVec3::ZERO, direction);
            let Some(hit) = sphere.intersect(&ray, 0.0..f64::INFINITY) else { continue };
            let spawned = hit.spawn(hit.normal);
            assert!(!sphere.occludes(&spawned, 0.0..f64::INFINITY));
            rays += 1;
            hit_again += u32::from(sphere.to_f32().occludes(&spawned.to_f32(), 0.0..f32::INFINITY));
        }
    }
    assert!(
        rays > 1000 && hit_again * 3 > rays && hit_again * 3 < rays * 2,
        "{hit_again} of {rays}"
    );
}
