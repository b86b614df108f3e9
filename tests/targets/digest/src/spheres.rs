//! `Spheres` and `SphereBvh` with the lanes that this target has.

use core::array;

use eyeray::{SphereBvh, Spheres, nearest};
use glam::Vec3;

use crate::CASES;
use crate::families::{Case, FAMILIES, Rng};

/// The spheres that a ray is asked for at a time.
const MOST: usize = 100;

/// Compares `Spheres` and `SphereBvh` with the slice, in numbers from 1 to [`MOST`] of each family.
///
/// # Panics
/// If they differ.
pub fn assert_spheres_find_the_same() {
    for family in FAMILIES {
        let mut rng = Rng::new(1);
        for case in 0..CASES as usize {
            let cases: [Case<Vec3>; MOST] = array::from_fn(|_| (family.f32)(&mut rng));
            let spheres = cases.map(|(_, sphere)| sphere);
            let spheres = &spheres[..=case % MOST];
            let lanes: Spheres = spheres.iter().copied().collect();
            let hierarchy: SphereBvh = spheres.iter().copied().collect();
            for (ray, _) in &cases[..10] {
                let found = lanes.nearest(ray, 0.0..f32::INFINITY);
                assert_eq!(
                    found,
                    hierarchy.nearest(ray, 0.0..f32::INFINITY),
                    "{}: {ray:?}",
                    family.name
                );
                let expected = nearest(spheres, ray, 0.0..f32::INFINITY);
                assert_eq!(found, expected, "{}: {ray:?}, {spheres:?}", family.name);
            }
        }
    }
}
