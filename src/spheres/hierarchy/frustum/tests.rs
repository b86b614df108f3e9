//! Both margins are enough, and neither can be left out. A packet here is one ray, over and over.

use glam::DVec3;
use sobol_burley::sample;

use super::super::boxes::MARGIN;
use super::*;
use crate::order::next_above;
use crate::spheres::lanes::Lanes;
use crate::spheres::local::to_f32;
use crate::spheres::packet::Around;
use crate::{Hittable, Ray, Sphere};

/// Takes any rays.
const ANY: Around =
    Around { center: Vec3::ZERO, radius_squared: f32::INFINITY, neighbors: [f32::INFINITY; 2] };

const LANE: usize = 5;

struct EnterAny<'a>(&'a Frustum, &'a Boxes, f32);

impl Vectorized for EnterAny<'_> {
    type Output = (u32, f32);

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> (u32, f32) {
        let mut entries = [0.0; LANES];
        let entered = self.0.entered(instructions, self.1, self.2, &mut entries);
        (entered, entries[LANE])
    }
}

/// A ray along a face of the box of a sphere, or nearly so, through the point where the sphere touches it.
fn along_a_face(case: u32) -> (Ray, Sphere) {
    let random = |dimension: u32| f64::from(sample(case, dimension, 2));
    let vector = |dimension: u32| {
        DVec3::from([0, 1, 2].map(|axis: u32| random(dimension + axis))) - DVec3::splat(0.5)
    };
    let center = (vector(0) * 64.0).as_vec3();
    let sphere = Sphere::new(center, to_f32(random(3) * random(4) * 8.0));
    let axis = case as usize % 3;
    let mut touching = center;
    touching[axis] += if case % 2 == 0 { sphere.radius } else { -sphere.radius };
    let mut direction = vector(5).as_vec3();
    direction[axis] = [0.0, -0.0, 1e-30, -1e-9, 1e-7, direction[axis]][case as usize / 6 % 6];
    if case % 5 == 0 {
        direction[(axis + 1) % 3] = 0.0;
    }
    (Ray::new(touching - direction * to_f32(random(8) * 200.0), direction), sphere)
}

/// How many of the boxes of spheres that are hit near a face of the box are dropped by the frustum, and by the rays, with these
/// margins.
fn dropped([of_frustum, of_rays]: [f32; 2], lanes: Lanes, cases: u32) -> [u32; 2] {
    let (mut hits, mut dropped) = (0, [0; 2]);
    let (mut packet, mut slabs) = (Packet::EMPTY, Slabs::EMPTY);
    for case in 0..cases {
        let (ray, sphere) = along_a_face(case);
        let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };
        // Around any center, as in the middle of nowhere.
        let center = if case % 2 == 0 { Vec3::ZERO } else { sphere.center + Vec3::splat(33.3) };
        let mut boxes = Boxes::EMPTY;
        let (low, high) = sphere.bounds();
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let relative = [low, high].map(|corner| corner - center.as_dvec3());
        let outwards = |rounded: Vec3, exact: DVec3, is_high: bool| {
            let mut rounded = rounded;
            for axis in 0..3 {
                let number = rounded[axis];
                let is_inside = if is_high {
                    f64::from(number) < exact[axis]
                } else {
                    f64::from(number) > exact[axis]
                };
                if is_inside {
                    rounded[axis] = if is_high == (number > 0.0) {
                        f32::from_bits(number.to_bits() + 1)
                    } else {
                        f32::from_bits(number.to_bits() - 1)
                    };
                }
            }
            rounded
        };
        let (low, high) = (
            outwards(relative[0].as_vec3(), relative[0], false),
            outwards(relative[1].as_vec3(), relative[1], true),
        );
        boxes.set(LANE, (low, high));
        let region = Region { center, extent: low.abs().max(high.abs()).max_element(), root: 0 };
        for end in [f32::INFINITY, next_above::<Vec3>(hit.t)] {
            hits += 1;
            assert_ne!(packet.load(lanes, &[ray; 4], &(0.0..end), ANY), 0, "{ray:?}");
            let frustum = Frustum::new(&packet, &region, of_frustum);
            let (entered, entry) = lanes.run(EnterAny(&frustum, &boxes, end));
            assert_eq!(entered & !(1 << LANE), 0, "an empty box was entered");
            dropped[0] += u32::from(entered == 0 || entry > hit.t);
            let (center, extent) = (region.center, region.extent);
            let packet = &packet;
            lanes.run(Prepare { slabs: &mut slabs, packet, center, extent, margin: of_rays });
            let rays =
                lanes.run(Enter { slabs: &slabs, packet, boxes: &boxes, lane: LANE, rays: 1 });
            dropped[1] += u32::from(rays == 0);
        }
    }
    assert!(hits > cases / 4, "{hits}");
    dropped
}

#[test]
fn drop_no_box_of_a_sphere_that_is_hit() {
    for lanes in Lanes::available() {
        assert_eq!(dropped([MARGIN, RAY_MARGIN], lanes, 20_000), [0, 0], "{lanes:?}");
    }
}

#[test]
fn need_their_margins() {
    for lanes in Lanes::available() {
        let [by_frustum, by_rays] = dropped([0.0, 0.0], lanes, 20_000);
        assert!(by_frustum > 0 && by_rays > 0, "{lanes:?}, {by_frustum}, {by_rays}");
    }
}
