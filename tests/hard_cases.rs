//! Cases on which other projects have failed, each by name, against the exact answer.

mod support;

use core::ops::Range;

use eyeray::{Algebraic, Geometric, Hit, Hittable, Ray, Scalar, Sphere, Vector};
use glam::{DVec3, Vec3, dvec3, vec3};
use support::float::Float;
use support::oracle::{Coordinates, Truth};
use support::reproduce::source;

/// Every t ahead.
const ALL: Range<f32> = 0.0..f32::INFINITY;

/// The exact roots, rounded to nearest, after checking that both derivations return them, to the bit.
fn roots<V: Coordinates>(ray: &Ray<V>, sphere: &Sphere<V>) -> Option<[V::Scalar; 2]> {
    let truth = Truth::new(ray, sphere);
    for roots in [sphere.roots_algebraic(ray), sphere.roots_geometric(ray)] {
        assert_eq!(roots.is_some(), truth.is_some(), "hit or miss\n{}", source(ray, sphere));
        for (exact, computed) in
            truth.iter().flat_map(|truth| &truth.roots).zip(roots.into_iter().flatten())
        {
            assert_eq!(
                computed,
                exact.nearest(),
                "{} ulps off\n{}",
                exact.error(computed),
                source(ray, sphere)
            );
        }
    }
    truth.map(|truth| truth.roots.map(|root| root.nearest()))
}

/// The nearest hit ahead, after checking that `Sphere` and both derivations have it, and its roots, point and normal.
fn nearest_hit<V: Coordinates>(ray: &Ray<V>, sphere: &Sphere<V>) -> Option<Hit<V>> {
    let ahead = V::Scalar::ZERO..V::Scalar::INFINITY;
    let hits = [
        sphere.intersect(ray, ahead.clone()),
        Algebraic(*sphere).intersect(ray, ahead.clone()),
        Geometric(*sphere).intersect(ray, ahead),
    ];
    let expected =
        roots(ray, sphere).map(|roots| roots.map(|t| t > V::Scalar::ZERO && t.is_finite()));
    let index = expected.and_then(|accepted| accepted.iter().position(|&accepted| accepted));
    for hit in hits {
        assert_eq!(hit.is_some(), index.is_some(), "a hit ahead\n{}", source(ray, sphere));
        if let (Some(hit), Some(index), Some(truth)) = (hit, index, Truth::new(ray, sphere)) {
            let (point, normal) =
                (truth.point_error(index, hit.point), truth.normal_error(index, hit.normal));
            assert_eq!(hit.t, truth.roots[index].nearest(), "{}", source(ray, sphere));
            assert!(point <= 1.0, "the point is off: {point}\n{}", source(ray, sphere));
            assert!(normal <= 2.0, "the normal is {normal} ulps off\n{}", source(ray, sphere));
        }
    }
    if V::Scalar::DIGITS == f32::MANTISSA_DIGITS {
        let t = hits.map(|hit| hit.map(|hit| hit.t));
        assert!(t[0] == t[1] && t[1] == t[2], "{hits:?}\n{}", source(ray, sphere));
    }
    hits[0]
}

/// pytracer, issue 22: from 1e7 away single precision loses the hit of a sphere of radius 0.1.
#[test]
fn pytracer_small_sphere_from_ten_million_away() {
    let sphere = Sphere::new(Vec3::ZERO, 0.1);
    let hit = nearest_hit(&Ray::new(vec3(-1e7, 0.095, 0.0), Vec3::X), &sphere)
        .expect("0.095 is less than 0.1");
    // The half-chord, 0.0312, is far below the ulp of the distance, 1; that of the point is below 1e-8.
    assert_eq!(hit.t, 1e7);
    assert!((hit.point - vec3(-0.031_225, 0.095, 0.0)).abs().max_element() < 1e-6);
    assert!(nearest_hit(&Ray::new(vec3(-1e7, 0.105, 0.0), Vec3::X), &sphere).is_none());

    // The limb is where it should be, to the last bit.
    let limb = 0.1_f32.to_bits();
    for bits in limb - 8..=limb + 8 {
        let hit = nearest_hit(&Ray::new(vec3(-1e7, f32::from_bits(bits), 0.0), Vec3::X), &sphere);
        assert_eq!(hit.is_some(), bits <= limb);
    }
}

/// Photon-v2, issue 7: a sphere of radius 0.005 seen from (0, 6, 40) has a ragged edge in single precision.
#[test]
fn photon_tiny_sphere_has_a_smooth_edge() {
    // A picture of the sphere and a little around it.
    const PIXELS: i16 = 80;
    let eye = vec3(0.0, 6.0, 40.0);
    let sphere = Sphere::new(Vec3::ZERO, 0.005);
    let mut previous = 0;
    for row in 0..PIXELS {
        let mut spans = 0;
        let mut width = 0;
        let mut inside = false;
        for column in 0..PIXELS {
            let offset =
                |pixel: i16| (f32::from(pixel) + 0.5 - f32::from(PIXELS) / 2.0) * (0.006 / 40.0);
            let target = vec3(offset(column), offset(row), 0.0);
            let hit = nearest_hit(&Ray::new(eye, target - eye), &sphere).is_some();
            spans += u16::from(hit && !inside);
            width += i16::from(hit);
            inside = hit;
        }
        // A disk: one span a row, wider and wider to the middle, then narrower.
        assert!(spans <= 1, "row {row} has a gap");
        if row < PIXELS / 2 {
            assert!(width >= previous, "row {row} is narrower than the one before");
        } else if row > PIXELS / 2 {
            assert!(width <= previous, "row {row} is wider than the one before");
        }
        previous = width;
    }
    assert_eq!(previous, 0);
}

/// pbrt-v3, issue 265: a sphere near x = 800,000 seen from x = 796,800 has a dark ring at the limb.
#[test]
fn pbrt_no_dark_ring_far_from_the_worlds_origin() {
    for radius in [1.0_f32, 100.0, 1000.0] {
        let eye = vec3(796_800.0, 0.0, 0.0);
        let sphere = Sphere::new(vec3(800_000.0, 0.0, 0.0), radius);
        let light = vec3(0.0, 1e6, 0.0) - sphere.center;
        // Across the limb from 1% inside to 1% outside.
        for step in 0_i16..=2000 {
            let offset = radius * (0.99 + f32::from(step) * 1e-5);
            let ray = Ray::new(eye, vec3(3200.0, offset, 0.0));
            let Some(hit) = nearest_hit(&ray, &sphere) else { continue };
            assert!(hit.front_face(&ray), "the near side at the limb faces the eye: {hit:?}");
            // Where the surface faces the light, the sphere does not shadow itself: this is what rings were made of.
            if hit.normal.dot(light) > 0.0 {
                let shadow = hit.spawn(light);
                assert!(!sphere.occludes(&shadow, 0.0..1.0), "{hit:?} shadows itself");
                let ahead = Truth::new(&shadow, &sphere)
                    .map(|truth| truth.roots.map(|root| root.nearest::<f64>()));
                assert!(
                    ahead.is_none_or(|roots| roots.iter().all(|&t| t < 0.0)),
                    "{hit:?} shadows itself exactly"
                );
            }
        }
    }
}

/// Ray Tracing in One Weekend, issue 1298: with roots at 0.0007 and 1000, a least t of 0.001 returns the far side.
/// The near one is there for whoever asks for it, and exact.
#[test]
fn one_weekend_near_root_below_a_thousandth() {
    let (near, far) = (0.0007, 1000.0);
    let radius = (far - near) / 2.0;
    let ray = Ray::new(dvec3(0.0, 0.0, 0.0), dvec3(0.0, 0.0, -1.0));
    let sphere = Sphere::new(dvec3(0.0, 0.0, -(far + near) / 2.0), radius);
    let hit = nearest_hit(&ray, &sphere).expect("straight ahead");
    assert!((hit.t - near).abs() < 1e-12);
    assert!(hit.front_face(&ray));
    let behind_the_epsilon = sphere.intersect(&ray, 0.001..f64::INFINITY).expect("the far side");
    assert!((behind_the_epsilon.t - far).abs() < 1e-9);

    let ray = Ray::new(Vec3::ZERO, -Vec3::Z);
    let sphere = Sphere::new(vec3(0.0, 0.0, -500.000_35), 499.999_66);
    let hit = nearest_hit(&ray, &sphere).expect("straight ahead");
    // The inputs are exact, so the near root is their exact difference.
    assert_eq!(hit.t, 500.000_35 - 499.999_66);
    assert_eq!(sphere.intersect(&ray, 0.001..f32::INFINITY).map(|hit| hit.t), Some(1000.0));
}

/// aardvark.base, issue 127: tangency rejected.
#[test]
fn aardvark_tangency_is_a_hit() {
    let ray = Ray::new(vec3(-5.0, 1.0, 0.0), Vec3::X);
    assert_eq!(nearest_hit(&ray, &Sphere::new(Vec3::ZERO, 1.0)).map(|hit| hit.t), Some(5.0));
    assert_eq!(roots(&ray, &Sphere::new(Vec3::ZERO, 1.0)), Some([5.0, 5.0]));
    let ray = Ray::new(dvec3(-5.0, 1.0, 0.0), DVec3::X);
    assert_eq!(nearest_hit(&ray, &Sphere::new(DVec3::ZERO, 1.0)).map(|hit| hit.t), Some(5.0));
    assert_eq!(roots(&ray, &Sphere::new(DVec3::ZERO, 1.0)), Some([5.0, 5.0]));
}

/// aardvark.base, issue 127: zero radius rejected.
#[test]
fn aardvark_zero_radius_is_hit_through_the_center() {
    let sphere = Sphere::new(vec3(3.0, 6.0, 9.0), 0.0);
    let ray = Ray::new(Vec3::ZERO, vec3(1.0, 2.0, 3.0));
    let hit = nearest_hit(&ray, &sphere).expect("exactly through the center");
    assert_eq!((hit.t, hit.point), (3.0, sphere.center));
    assert!(nearest_hit(&Ray::new(Vec3::ZERO, vec3(1.0, 2.0, 3.000_000_2)), &sphere).is_none());
    let sphere = Sphere::new(dvec3(3.0, 6.0, 9.0), 0.0);
    let hit = nearest_hit(&Ray::new(DVec3::ZERO, dvec3(1.0, 2.0, 3.0)), &sphere)
        .expect("exactly through the center");
    assert_eq!((hit.t, hit.point), (3.0, sphere.center));
}

/// aardvark.base, issue 127: coefficients overflow and lose hits that could be represented.
#[test]
fn aardvark_coefficients_that_overflow_lose_no_hit() {
    // 1e25² is beyond an f32, 1e200² beyond an f64.
    let ray = Ray::new(vec3(-1e25, 0.0, 0.0), Vec3::X);
    assert_eq!(
        nearest_hit(&ray, &Sphere::new(Vec3::ZERO, 4e24)).map(|hit| hit.t),
        Some(1e25 - 4e24)
    );
    let ray = Ray::new(vec3(-1.0, 0.0, 0.0), vec3(1e25, 0.0, 0.0));
    assert_eq!(nearest_hit(&ray, &Sphere::new(Vec3::ZERO, 0.5)).map(|hit| hit.t), Some(0.5 / 1e25));
    let ray = Ray::new(dvec3(-1e200, 0.0, 0.0), DVec3::X);
    let hit = nearest_hit(&ray, &Sphere::new(DVec3::ZERO, 4e199)).expect("straight ahead");
    assert!((hit.t / 6e199 - 1.0).abs() < 1e-15);
    // And 1e-25² below an f32, 1e-200² below an f64.
    let ray = Ray::new(vec3(-1e-25, 0.0, 0.0), Vec3::X);
    assert!(nearest_hit(&ray, &Sphere::new(Vec3::ZERO, 4e-26)).is_some());
    let ray = Ray::new(dvec3(-1e-200, 0.0, 0.0), DVec3::X);
    assert!(nearest_hit(&ray, &Sphere::new(DVec3::ZERO, 4e-201)).is_some());
}

/// aardvark.base, issue 127: roots ordered by magnitude instead of along the ray.
#[test]
fn aardvark_roots_are_ordered_along_the_ray() {
    let sphere = Sphere::new(Vec3::ZERO, 5.0);
    // From inside, one root is behind and larger in magnitude; from beyond, both are behind.
    assert_eq!(roots(&Ray::new(vec3(3.0, 0.0, 0.0), Vec3::X), &sphere), Some([-8.0, 2.0]));
    assert_eq!(roots(&Ray::new(vec3(3.0, 0.0, 0.0), -Vec3::X), &sphere), Some([-2.0, 8.0]));
    assert_eq!(roots(&Ray::new(vec3(10.0, 0.0, 0.0), Vec3::X), &sphere), Some([-15.0, -5.0]));
    assert_eq!(
        nearest_hit(&Ray::new(vec3(3.0, 0.0, 0.0), Vec3::X), &sphere).map(|hit| hit.t),
        Some(2.0)
    );
}

/// mitsuba3, pull request 1871: concentric spheres of radius 1 and 1 + 4e-5. Rays spawned inwards on the outer one must
/// find the inner one.
#[test]
fn mitsuba_concentric_spheres() {
    use std::cmp::Ordering;
    use support::families::Rng;
    use support::oracle::side;

    let inner = Sphere::new(Vec3::ZERO, 1.0);
    let outer = Sphere::new(Vec3::ZERO, 1.0 + 4e-5);
    let (mut found, mut passed) = (0, 0);
    let mut rng = Rng::new(0);
    for _ in 0..2000 {
        // Half of the rays pass within a ten-thousandth of the limb of the inner sphere.
        let direction = rng.unit_vector();
        let closest = if rng.coin() { rng.uniform(0.9999, 1.0001) } else { rng.uniform(0.0, 1.0) };
        let origin = rng.perpendicular(direction) * closest - direction * 3.0;
        let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
        let Some(hit) = nearest_hit(&ray, &outer) else { continue };
        // It goes straight on, so what it meets is what the first ray would meet.
        let spawned = hit.spawn(ray.direction);
        assert_eq!(
            side(&outer, spawned.origin),
            Some(Ordering::Less),
            "{}",
            source(&spawned, &outer)
        );
        assert_eq!(
            side(&inner, spawned.origin),
            Some(Ordering::Greater),
            "{}",
            source(&spawned, &inner)
        );
        let second = nearest_hit(&spawned, &inner);
        match roots(&ray, &inner) {
            // Its origin is half an ulp and a clearance away from the first ray: at the very limb that may decide.
            Some([near, far]) if far - near > 0.01 => {
                let second = second.unwrap_or_else(|| {
                    panic!("the inner one is lost\n{}", source(&spawned, &inner))
                });
                assert!((hit.t + second.t - near).abs() < 1e-3, "{}", source(&spawned, &inner));
                found += 1;
            }
            None if closest > 1.00001 => {
                assert!(
                    second.is_none(),
                    "the inner one is not there\n{}",
                    source(&spawned, &inner)
                );
                passed += 1;
            }
            _ => {}
        }
        let far_wall = nearest_hit(&spawned, &outer).expect("the way out");
        assert!(!far_wall.front_face(&spawned));
    }
    assert!(found > 900 && passed > 100, "{found} found, {passed} passed by");
}

/// Lomont, *A Better Algorithm for Solving Quadratic Equations*: coefficients over 2^±32, 2^±70 and 2^±126.
#[test]
fn lomont_coefficients_of_three_ranges() {
    use support::families::{FAMILIES, Rng};

    for family in FAMILIES.iter().filter(|family| family.name.starts_with("coefficients")) {
        let mut rng = Rng::new(1 << 32);
        let (mut hits, mut ahead) = (0, 0);
        for _ in 0..300 {
            let (ray, sphere) = (family.f32)(&mut rng);
            hits += u32::from(roots(&ray, &sphere).is_some());
            ahead += u32::from(nearest_hit(&ray, &sphere).is_some());
        }
        assert!(
            (100..300).contains(&hits) && ahead > 50,
            "{}: {hits} hits, {ahead} ahead",
            family.name
        );
    }
}

/// demont-engine, issue 256: a point on a planet that is off by a hand's breadth.
#[test]
fn a_point_on_a_planet_is_as_fine_as_its_coordinates() {
    let planet = Sphere::new(vec3(0.0, -6.371e6, 0.0), 6.371e6);
    let ray = Ray::new(vec3(0.0, 2.0, 0.0), vec3(3000.0, -2.7, 100.0));
    let hit = planet.intersect(&ray, ALL).expect("the ray goes down");
    assert!((f64::from(hit.point.y) - -0.714_976_684).abs() < 6e-8, "{}", hit.point);
}

/// tantalum issue 3, `ByroRedux` issue 649: light leaks where the offset of a ray skips what touches the surface.
#[test]
fn what_stands_on_a_large_sphere_is_not_skipped() {
    let ground = Sphere::new(vec3(0.0, -1000.0, 0.0), 1000.0);
    let ball = Sphere::new(vec3(0.0, 0.2, 0.0), 0.2);
    let eye = vec3(0.0, 1.0, 3.0);
    // Rays upwards from the ground within a hundredth of the contact hit the ball from outside.
    for x in [0.001_f32, 0.002, 0.005, 0.01] {
        let hit = ground.intersect(&Ray::new(eye, vec3(x, 0.0, 0.0) - eye), ALL);
        let hit = hit.expect("the ray goes down");
        let up = hit.spawn(Vec3::Y);
        let at_ball = ball.intersect(&up, ALL).expect("the ball is above");
        assert!(at_ball.front_face(&up), "at {x}, the ray starts inside the ball");
    }

    // A house on a planet casts a shadow.
    let planet = Sphere::new(vec3(0.0, -6.371e6, 0.0), 6.371e6);
    let house = Sphere::new(vec3(0.0, 0.0, 0.0), 3.0);
    let eye = vec3(0.0, 2.0, 50.0);
    let hit = planet.intersect(&Ray::new(eye, vec3(0.0, 0.0, 1.0) - eye), ALL);
    let shadow = hit.expect("the ray goes down").spawn(vec3(0.0, 0.3, -1.0));
    assert!(house.occludes(&shadow, ALL));
}

/// pbrt-v3 issue 178, visionaray issue 29: a lamp at t = 1 that shadows itself.
#[test]
fn a_lamp_is_not_in_its_own_way() {
    fn check<V: Vector>(radii: [f64; 6], scene: impl Fn(f64) -> (Sphere<V>, Sphere<V>, Ray<V>, V)) {
        for radius in radii {
            let (ground, lamp, ray, sample) = scene(radius);
            let all = V::Scalar::ZERO..V::Scalar::INFINITY;
            let hit = ground.intersect(&ray, all.clone()).expect("the ray goes down");
            let shadow = hit.spawn(sample - hit.point);
            let at_lamp = lamp.intersect(&shadow, all).expect("the lamp is above");
            let scene: [&dyn Hittable<V>; 2] = [&ground, &lamp];
            assert!(!scene.occludes(&shadow, V::Scalar::ZERO..at_lamp.t), "radius {radius}");
        }
    }
    let radii = [10.0, 100.0, 1e3, 1e5, 1e6, 1e7];
    let scene = |radius: f64| {
        let eye = dvec3(0.0, 5.0, 9.0);
        (
            Sphere::new(dvec3(0.0, -radius, 0.0), radius),
            Sphere::new(dvec3(0.0, 4.0, 0.0), 1.0),
            Ray::new(eye, dvec3(0.5, -0.1, 0.0) - eye),
            dvec3(0.0, 3.0, 0.0),
        )
    };
    check::<DVec3>(radii, scene);
    check::<Vec3>(radii, |radius| {
        let (ground, lamp, ray, sample) = scene(radius);
        (ground.to_f32(), lamp.to_f32(), ray.to_f32(), sample.as_vec3())
    });
}

#[test]
fn through_the_worlds_origin_from_next_to_it() {
    // A product of the radius and what is left underflows: the origin is not on the surface.
    let tiny = 2_f64.powi(-1000);
    let sphere = Sphere::new(DVec3::X * 2_f64.powi(-100), 2_f64.powi(-100));
    let found = nearest_hit(&Ray::new(DVec3::X * tiny, DVec3::NEG_X), &sphere);
    assert_eq!(found.map(|hit| hit.t), Some(tiny));
    let found = nearest_hit(&Ray::new(DVec3::X * -tiny, DVec3::X), &sphere);
    assert_eq!(found.map(|hit| hit.t), Some(tiny));
    // The far root is close to the midpoint of two numbers.
    let radius = 2_f64.powi(-100) * (1.0 - f64::EPSILON / 2.0);
    let sphere = Sphere::new(DVec3::X * 2_f64.powi(-99), radius);
    assert!(nearest_hit(&Ray::new(DVec3::X * -tiny, DVec3::X), &sphere).is_some());
}
