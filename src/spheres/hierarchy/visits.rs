//! Counts what walks visit, for tests: answers are right whatever a tree is like, and only these numbers tell a good one.

#[cfg(test)]
use core::cell::Cell;

/// What is counted.
#[derive(Clone, Copy, Debug)]
pub(super) enum Visit {
    Node,
    Leaf,
    /// A sphere that is intersected exactly.
    Sphere,
}

#[cfg(test)]
std::thread_local! {
    static VISITS: Cell<[u32; 3]> = const { Cell::new([0; 3]) };
}

/// Counts a visit in tests.
#[inline(always)]
#[cfg_attr(not(test), expect(unused_variables, reason = "only tests count"))]
pub(super) fn count(visit: Visit) {
    #[cfg(test)]
    VISITS.with(|visits| {
        let mut counts = visits.get();
        counts[visit as usize] += 1;
        visits.set(counts);
    });
}

/// How many nodes, leaves and spheres this thread has visited since it was last asked.
#[cfg(test)]
pub(super) fn taken() -> [u32; 3] {
    VISITS.take()
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use glam::{DVec3, Vec3, dvec3};

    use super::*;
    use crate::spheres::SphereBvh;
    use crate::spheres::lanes::Lanes;
    use crate::spheres::tests::families::Rng;
    use crate::{Ray, Scalar, Sphere, Vector};

    /// How many rays are asked of each scene.
    const RAYS: u32 = 500;

    fn within(rng: &mut Rng, extent: f64) -> DVec3 {
        [(); 3].map(|()| rng.uniform(-extent, extent)).into()
    }

    /// A cloud of spheres around the origin, up to 40 from it on each axis.
    fn cloud(rng: &mut Rng, count: usize) -> Vec<(DVec3, f64)> {
        (0..count).map(|_| (within(rng, 40.0), rng.uniform(0.2, 0.8))).collect()
    }

    /// What a thousand rays visit of nodes, leaves and spheres, from around the origin.
    fn visits<V: Vector>(lanes: Lanes, spheres: &[(DVec3, f64)], world: DVec3) -> [u32; 3] {
        let slice: Vec<Sphere<V>> = spheres
            .iter()
            .map(|&(center, radius)| {
                Sphere::new(V::from_f64(world + center), V::Scalar::from_f64(radius))
            })
            .collect();
        visits_of(lanes, &SphereBvh::new(&slice), world)
    }

    fn visits_of<V: Vector>(lanes: Lanes, bvh: &SphereBvh<V>, world: DVec3) -> [u32; 3] {
        let mut rng = Rng::new(7);
        taken();
        for _ in 0..RAYS {
            let eye = within(&mut rng, 60.0);
            let direction = V::from_f64(within(&mut rng, 30.0) - eye);
            let ray = Ray::new(V::from_f64(world + eye), direction);
            let range = V::Scalar::ZERO..V::Scalar::INFINITY;
            if let Some((_, hit)) = bvh.nearest_in_lanes(lanes, &ray, range.clone()) {
                let bounced = hit.spawn(hit.normal + V::from_f64(rng.unit_vector()));
                bvh.nearest_in_lanes(lanes, &bounced, range);
            }
        }
        taken()
    }

    /// Checks what rays visit against numbers of nodes, leaves and spheres, with every set of instructions. What is allowed more,
    /// a hundredth, is for roundings that differ between them.
    fn assert_visits(found: &[(&str, Lanes, [u32; 3])], limits: &[(&str, [u32; 3])]) {
        for &(name, lanes, visits) in found {
            let of_name = limits.iter().find(|(other, _)| *other == name);
            let limits = of_name.map(|&(_, limits)| limits).unwrap_or_default();
            let is_in = |(&visits, &limit): (&u32, &u32)| visits <= limit + limit / 100;
            assert!(
                visits.iter().zip(&limits).all(is_in),
                "{name}, {lanes:?}: {visits:?} instead of {limits:?}"
            );
        }
    }

    /// What a thousand rays visit is known, of scenes of each kind that the builder takes care of. Who makes it better lowers the
    /// numbers.
    #[test]
    fn visits_are_few() {
        let mut rng = Rng::new(1);
        let cloud_of_many = cloud(&mut rng, 5000);
        let with = |more: Vec<(DVec3, f64)>| [cloud_of_many.clone(), more].concat();
        let far = |rng: &mut Rng, count: usize, extents: f64| -> Vec<(DVec3, f64)> {
            (0..count).map(|_| (rng.unit_vector() * 40.0 * extents, 0.5)).collect()
        };
        let clusters: Vec<(DVec3, f64)> = (0..50)
            .flat_map(|_| {
                let center = within(&mut rng, 40.0);
                (0..100)
                    .map(|_| (center + within(&mut rng, 3.0), rng.uniform(0.1, 0.3)))
                    .collect::<Vec<_>>()
            })
            .collect();
        let decades: Vec<(DVec3, f64)> = (0..5000)
            .map(|_| (within(&mut rng, 40.0), 10_f64.powf(rng.uniform(-2.5, 0.7))))
            .collect();
        let sheet: Vec<(DVec3, f64)> = cloud_of_many
            .iter()
            .map(|&(center, radius)| (center * dvec3(1.0, 0.01, 1.0), radius))
            .collect();
        let unreachable =
            (0..500).map(|_| (DVec3::NAN, 1.0)).chain((0..500).map(|_| (DVec3::ZERO, -1.0)));
        let scenes = [
            ("cloud", cloud_of_many.clone()),
            ("few", cloud_of_many[..400].to_vec()),
            ("ground", with(std::vec![(dvec3(0.0, -1030.0, 0.0), 1000.0)])),
            ("large", with((0..16).map(|i| (dvec3(f64::from(i), -530.0, 0.0), 500.0)).collect())),
            ("stray", with(far(&mut rng, 1, 1e5))),
            ("strays", with(far(&mut rng, 100, 1e6))),
            ("clusters", clusters),
            ("decades", decades),
            ("sheet", sheet),
            ("unreachable", with(unreachable.collect())),
        ];
        let planet = dvec3(3.1e6, 4.4e6, -3.4e6);
        let mut found = Vec::new();
        for lanes in Lanes::available() {
            for (name, spheres) in &scenes {
                found.push((*name, lanes, visits::<Vec3>(lanes, spheres, DVec3::ZERO)));
            }
            found.push(("on a planet", lanes, visits::<DVec3>(lanes, &cloud_of_many, planet)));
        }
        assert_visits(&found, &VISITS_OF_SCENES);
    }

    /// Spheres that move by a tenth of a radius, and then by more and more: as long as the tree is kept, rays visit little more
    /// than in one that is built anew, and once it is not, no more.
    #[test]
    fn visits_are_few_where_spheres_move() {
        let mut rng = Rng::new(2);
        let mut slice: Vec<Sphere> = cloud(&mut rng, 5000)
            .iter()
            .map(|&(center, radius)| Sphere::new(center.as_vec3(), f32::from_f64(radius)))
            .collect();
        let lanes = Lanes::best();
        let mut updated = SphereBvh::new(&slice);
        let (mut kept, mut built) = (0, 0);
        for turn in 0..40_u8 {
            let step = 0.1 * (1.0 + 0.25 * f32::from(turn));
            for sphere in &mut slice {
                sphere.center += rng.unit_vector().as_vec3() * (step * sphere.radius);
            }
            updated.update(&slice);
            let fresh = SphereBvh::new(&slice);
            let all = |bvh: &SphereBvh| visits_of(lanes, bvh, DVec3::ZERO).iter().sum::<u32>();
            let (visits, of_fresh) = (all(&updated), all(&fresh));
            let is_kept = updated.is_moved();
            assert!(is_kept || turn > 0);
            let [tenths, of] = if turn == 0 { [11, 10] } else { [13, 10] };
            assert!(visits * of <= of_fresh * tenths, "{turn}: {visits}, {of_fresh}");
            kept += u32::from(is_kept);
            built += u32::from(!is_kept);
        }
        assert!(kept > 5 && built > 0, "{kept}, {built}");
    }

    /// To find the first crossing, as much is opened as for the nearest hit, or less, for the box that the ray enters first is
    /// opened first; and what is nearer than the first box that waits opens nothing.
    fn few_are_opened_for_the_first_crossings<V: Vector>() {
        let mut rng = Rng::new(3);
        let slice: Vec<Sphere<V>> = cloud(&mut rng, 5000)
            .iter()
            .map(|&(center, radius)| Sphere::new(V::from_f64(center), V::Scalar::from_f64(radius)))
            .collect();
        let bvh = SphereBvh::new(&slice);
        for lanes in Lanes::available() {
            let mut sums = [[0; 3]; 3];
            for _ in 0..RAYS {
                let eye = within(&mut rng, 60.0);
                let direction = V::from_f64(within(&mut rng, 30.0) - eye);
                let ray = Ray::new(V::from_f64(eye), direction);
                let range = V::Scalar::ZERO..V::Scalar::INFINITY;
                taken();
                bvh.nearest_in_lanes(lanes, &ray, range.clone());
                let nearest = taken();
                let mut hits = bvh.hits_in_lanes(lanes, &ray, range);
                hits.next();
                let first = taken();
                hits.by_ref().for_each(drop);
                for (sums, visits) in sums.iter_mut().zip([nearest, first, taken()]) {
                    for (sum, visits) in sums.iter_mut().zip(visits) {
                        *sum += visits;
                    }
                }
            }
            let [nearest, first, rest] = sums;
            let case = std::format!("{lanes:?}: {nearest:?}, {first:?}, {rest:?}");
            std::println!("{case}");
            assert!(first[0] <= nearest[0] && first[1] <= nearest[1], "{case}");
            assert!(first[2] <= nearest[2] + nearest[2] / 4, "{case}");
            assert!(rest.iter().all(|visits| *visits > 0), "{case}");
        }
    }

    #[test]
    fn few_are_opened_for_the_first_crossings_in_both_precisions() {
        few_are_opened_for_the_first_crossings::<Vec3>();
        few_are_opened_for_the_first_crossings::<DVec3>();
    }

    /// Of each scene, nodes, leaves and spheres.
    const VISITS_OF_SCENES: [(&str, [u32; 3]); 11] = [
        ("cloud", [3944, 5323, 325]),
        ("few", [974, 2151, 32]),
        ("ground", [4442, 6067, 377]),
        ("large", [4390, 5957, 355]),
        ("stray", [6541, 5314, 325]),
        ("strays", [6483, 5845, 322]),
        ("clusters", [1385, 463, 33]),
        ("decades", [3710, 3779, 814]),
        ("sheet", [1600, 974, 295]),
        ("unreachable", [3944, 5323, 325]),
        ("on a planet", [3944, 5323, 590]),
    ];
}
