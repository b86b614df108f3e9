//! `nearest_each` and `occludes_each` against one ray at a time: the same bits, with every set of instructions.

use super::*;
use crate::spheres::each;

/// Rays that begin and go nearly as one does, or, if `mixed`, some that do not.
fn neighbors<V: Tested>(rng: &mut Rng, slice: &[Sphere<V>], count: u64) -> Vec<Ray<V>> {
    let base = questions::ray(rng, slice);
    let spread =
        |rng: &mut Rng| choose(rng, &[0.0, 0.0, 1e-7, 1e-5, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0]);
    let (origin, direction) = (base.origin.to_f64(), base.direction.to_f64());
    let extent = slice.iter().map(|sphere| sphere.radius.into()).fold(0.0, f64::max).min(1e6);
    let (of_origin, of_direction) = (spread(rng) * extent, spread(rng) * direction.length());
    let mixed = rng.below(4) == 0;
    // Rays that meet where t is 1, as shadow rays do at a lamp.
    let meet = rng.below(4) == 0;
    let mut rays: Vec<Ray<V>> = (0..count)
        .map(|_| {
            if mixed && rng.below(6) == 0 {
                return questions::ray(rng, slice);
            }
            let mut inside = || DVec3::from([(); 3].map(|()| rng.uniform(-1.0, 1.0)));
            let moved = inside() * of_origin;
            let turned = inside() * of_direction;
            let turned = if meet { turned * 0.01 - moved } else { turned };
            ray(origin + moved, direction + turned)
        })
        .collect();
    if !rays.is_empty() && rng.below(4) == 0 {
        // Duplicates.
        for _ in 0..5 {
            let ray = choose(rng, &rays);
            let place = usize::try_from(rng.below(count)).unwrap_or(0);
            rays[place] = ray;
        }
    }
    rays
}

impl<V: Tested> Scene<V> {
    #[track_caller]
    fn assert_same_for_each(&self, rays: &[Ray<V>], range: &Range<V::Scalar>) -> usize {
        let Self { slice, scan, bvh } = self;
        let expected: Vec<_> =
            rays.iter().map(|ray| bits(nearest(slice, ray, range.clone()))).collect();
        for lanes in Lanes::available() {
            // What is there before makes no difference.
            let old = Some((7, Hit::new(V::Scalar::ONE, V::ZERO, V::ZERO, V::Scalar::ZERO)));
            let mut by_scan = std::vec![old; rays.len()];
            each::nearest_each(scan, lanes, rays, range, &mut by_scan);
            let mut by_bvh = std::vec![old; rays.len()];
            bvh.nearest_each_in_lanes(lanes, rays, range, &mut by_bvh);
            let mut occluded_by_scan = std::vec![true; rays.len()];
            each::occludes_each(scan, lanes, rays, range, &mut occluded_by_scan);
            let mut occluded_by_bvh = std::vec![true; rays.len()];
            bvh.occludes_each_in_lanes(lanes, rays, range, &mut occluded_by_bvh);
            for (place, (ray, expected)) in rays.iter().zip(&expected).enumerate() {
                let context = || {
                    format!(
                        "{lanes:?}, {} spheres, {place} of {}, {ray:?}, {range:?}",
                        slice.len(),
                        rays.len()
                    )
                };
                assert_eq!(bits(by_scan[place]), *expected, "scan, {}", context());
                assert_eq!(bits(by_bvh[place]), *expected, "hierarchy, {}", context());
                assert_eq!(occluded_by_scan[place], expected.is_some(), "scan, {}", context());
                assert_eq!(occluded_by_bvh[place], expected.is_some(), "hierarchy, {}", context());
            }
        }
        expected.iter().flatten().count()
    }
}

/// `EYERAY_QUESTIONS=10000000 cargo test --release --lib spheres::tests::pictures -- --nocapture`
#[expect(clippy::cast_possible_truncation, reason = "it is below the number of ranges")]
fn many_equal_one_at_a_time_in_a_long_run<V: Tested>(by_default: u64) {
    let wanted = std::env::var("EYERAY_QUESTIONS");
    let wanted: u64 = wanted.map_or(by_default, |number| number.parse().unwrap());
    let most = if wanted < 100_000 { 300 } else { 1000 };
    let mut rng = Rng::new(wanted + 1);
    let (mut asked, mut hits) = (0, 0);
    while asked < wanted {
        let scene = Scene::<V>::new(questions::scene(&mut rng, most));
        for _ in 0..10 {
            let count =
                choose(&mut rng, &[1, 4, 15, 16, 17, 40, 63, 64, 64, 64, 65, 100, 128, 150]);
            let rays = neighbors(&mut rng, &scene.slice, count);
            hits += scene.assert_same_for_each(&rays, &all::<V>());
            let ray = choose(&mut rng, &rays);
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            scene.assert_same_for_each(&rays, &ranges[rng.below(ranges.len() as u64) as usize]);
            asked += 2 * count;
        }
    }
    println!("{asked} rays of each set of instructions, {hits} hits in the whole range");
    assert!(hits as u64 > wanted / 10, "{hits}");
}

#[test]
fn many_equal_one_at_a_time_in_a_long_run_in_f32() {
    many_equal_one_at_a_time_in_a_long_run::<Vec3>(10_000);
}

#[test]
fn many_equal_one_at_a_time_in_a_long_run_in_f64() {
    many_equal_one_at_a_time_in_a_long_run::<DVec3>(2_000);
}

/// A scene of many spheres, and 64 neighboring pixels.
fn tile(rng: &mut Rng, count: usize) -> (Scene<Vec3>, Vec<Ray>) {
    let slice = (0..count).map(|_| sphere(rng.unit_vector() * rng.uniform(0.0, 30.0), 1.0));
    let scene = Scene::new(slice.collect());
    let eye = rng.unit_vector() * 60.0;
    let [right, up] = [eye.cross(DVec3::Y), eye.cross(DVec3::X)].map(DVec3::normalize);
    let corner = DVec3::from([(); 3].map(|()| rng.uniform(-15.0, 15.0))) - eye;
    let pixel = |i: u8| right * f64::from(i % 8) * 0.2 + up * f64::from(i / 8) * 0.2;
    let rays = (0..64).map(|i| ray(eye, corner + pixel(i))).collect();
    (scene, rays)
}

#[test]
fn neighbors_are_asked_together() {
    let mut rng = Rng::new(11);
    for count in [20, 70, 300, 2000] {
        let mut together = [0; 2];
        for _ in 0..10 {
            let (scene, rays) = tile(&mut rng, count);
            for lanes in Lanes::available() {
                let _ = each::tests::together();
                each::nearest_each(&scene.scan, lanes, &rays, &all::<Vec3>(), &mut [None; 64]);
                each::occludes_each(&scene.scan, lanes, &rays, &all::<Vec3>(), &mut [false; 64]);
                together[0] += each::tests::together();
                scene.bvh.nearest_each_in_lanes(lanes, &rays, &all::<Vec3>(), &mut [None; 64]);
                scene.bvh.occludes_each_in_lanes(lanes, &rays, &all::<Vec3>(), &mut [false; 64]);
                together[1] += each::tests::together();
            }
            scene.assert_same_for_each(&rays, &all::<Vec3>());
        }
        let asked = 10 * 128 * u32::try_from(Lanes::available().count()).unwrap_or(0);
        assert!(together.iter().all(|&together| together > asked / 4 * 3), "{together:?}, {count}");
    }
}

#[test]
fn rays_that_are_none_among_neighbors() {
    let mut rng = Rng::new(12);
    let mut together = 0;
    for _ in 0..20 {
        let (scene, mut rays) = tile(&mut rng, 300);
        for _ in 0..choose(&mut rng, &[1, 5, 30]) {
            let place = choose(&mut rng, &[0, 1, 7, 16, 17, 31, 40, 63]);
            let axis = choose(&mut rng, &[0, 1, 2]);
            let number = choose(&mut rng, &[f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX]);
            match rng.below(3) {
                0 => rays[place].origin[axis] = number,
                1 => rays[place].direction[axis] = number,
                _ => rays[place].direction = Vec3::ZERO,
            }
        }
        let _ = each::tests::together();
        scene.bvh.nearest_each(&rays, all::<Vec3>(), &mut [None; 64]);
        together += each::tests::together();
        scene.assert_same_for_each(&rays, &all::<Vec3>());
        for range in [f32::NAN..1.0, 0.0..f32::NAN, 60.0..f32::INFINITY, 61.0..30.0, -5.0..0.9] {
            scene.assert_same_for_each(&rays, &range);
        }
    }
    assert!(together > 20 * 40, "the others go together: {together}");
}

#[test]
fn of_slices_that_differ_in_length_the_shorter_one_counts() {
    let mut rng = Rng::new(13);
    let (scene, rays) = tile(&mut rng, 300);
    let old = Some((7, Hit::new(1.0, Vec3::ONE, Vec3::ONE, 0.0)));
    for [count, room] in [[0, 0], [0, 5], [5, 0], [3, 64], [64, 3], [17, 64], [64, 63], [40, 41]] {
        let (rays, asked) = (&rays[..count], count.min(room));
        for find in [
            &|found: &mut [_]| scene.scan.nearest_each(rays, all::<Vec3>(), found),
            &|found: &mut [_]| scene.bvh.nearest_each(rays, all::<Vec3>(), found),
        ] as [&dyn Fn(&mut [Option<(usize, Hit)>]); 2]
        {
            let mut found = std::vec![old; room];
            find(&mut found);
            for (found, ray) in found.iter().zip(rays) {
                assert_eq!(bits(*found), bits(scene.bvh.nearest(ray, all::<Vec3>())));
            }
            assert!(found[asked..].iter().all(|&left| bits(left) == bits(old)));
        }
        for value in [false, true] {
            let mut occluded = std::vec![value; room];
            scene.bvh.occludes_each(rays, all::<Vec3>(), &mut occluded);
            scene.scan.occludes_each(rays, all::<Vec3>(), &mut occluded);
            for (occluded, ray) in occluded.iter().zip(rays) {
                assert_eq!(*occluded, scene.bvh.occludes(ray, all::<Vec3>()));
            }
            assert!(occluded[asked..].iter().all(|&left| left == value));
        }
    }
}
