//! `nearest_each` and `occludes_each` against one ray at a time: the same bits, with every set of instructions.

use super::*;

/// Rays that begin and go nearly as one does, or, if `mixed`, some that do not.
fn neighbors(rng: &mut Rng, slice: &[Sphere], count: u64) -> Vec<Ray> {
    let base = questions::ray(rng, slice);
    let spread =
        |rng: &mut Rng| choose(rng, &[0.0, 0.0, 1e-7, 1e-5, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0]);
    let length = base.direction.length();
    let extent = slice.iter().map(|sphere| sphere.radius).fold(0.0, f32::max).min(1e6);
    let (of_origin, of_direction) = (spread(rng) * extent, spread(rng) * length);
    let mixed = rng.below(4) == 0;
    // Rays that meet where t is 1, as shadow rays do at a lamp.
    let meet = rng.below(4) == 0;
    let mut rays: Vec<Ray> = (0..count)
        .map(|_| {
            if mixed && rng.below(6) == 0 {
                return questions::ray(rng, slice);
            }
            let mut inside = || {
                let [x, y, z] = [(); 3].map(|()| rng.uniform(-1.0, 1.0));
                glam::dvec3(x, y, z).as_vec3()
            };
            let moved = inside() * of_origin;
            let turned = inside() * of_direction;
            let turned = if meet { turned * 0.01 - moved } else { turned };
            Ray::new(base.origin + moved, base.direction + turned)
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

impl Scene {
    #[track_caller]
    fn assert_same_for_each(&self, rays: &[Ray], range: &Range<f32>) -> usize {
        let Self { slice, scan, bvh } = self;
        let expected: Vec<_> =
            rays.iter().map(|ray| bits(nearest(slice, ray, range.clone()))).collect();
        for lanes in Lanes::available() {
            // What is there before makes no difference.
            let old = Some((7, Hit::new(1.0, Vec3::ONE, Vec3::ONE, 0.0)));
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
#[test]
#[expect(clippy::cast_possible_truncation, reason = "it is below the number of ranges")]
fn packets_equal_one_ray_at_a_time_in_a_long_run() {
    let wanted = std::env::var("EYERAY_QUESTIONS");
    let wanted: u64 = wanted.map_or(10_000, |number| number.parse().unwrap());
    let most = if wanted < 100_000 { 300 } else { 1000 };
    let mut rng = Rng::new(wanted + 1);
    let (mut asked, mut hits) = (0, 0);
    while asked < wanted {
        let scene = Scene::new(questions::scene(&mut rng, most));
        for _ in 0..10 {
            let count =
                choose(&mut rng, &[1, 4, 15, 16, 17, 40, 63, 64, 64, 64, 65, 100, 128, 150]);
            let rays = neighbors(&mut rng, &scene.slice, count);
            hits += scene.assert_same_for_each(&rays, &ALL);
            let ray = choose(&mut rng, &rays);
            let ranges = ranges(&mut rng, &scene.slice, &ray);
            scene.assert_same_for_each(&rays, &ranges[rng.below(ranges.len() as u64) as usize]);
            asked += 2 * count;
        }
    }
    println!("{asked} rays of each set of instructions, {hits} hits in the whole range");
    assert!(hits as u64 > wanted / 10, "{hits}");
}
