//! `nearest_each` and `occludes_each` against one ray at a time: the same bits, with every set of instructions.

use super::*;

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
            scan.nearest_each_in_lanes(lanes, rays, range, &mut by_scan);
            let mut by_bvh = std::vec![old; rays.len()];
            bvh.nearest_each_in_lanes(lanes, rays, range, &mut by_bvh);
            let mut occluded_by_scan = std::vec![true; rays.len()];
            scan.occludes_each_in_lanes(lanes, rays, range, &mut occluded_by_scan);
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
