//! Each margin is enough, and none can be left out.
//!
//! A packet here is one ray, over and over: what bounds all rays is then that ray, and nothing but the margins makes it wider.

use glam::DVec3;
use sobol_burley::sample;

use super::bounds::{Margins, Meet, Met};
use super::*;
use crate::Hittable;
use crate::order::next_above;

/// Takes any rays.
const ANY: Around =
    Around { center: Vec3::ZERO, radius_squared: f32::INFINITY, neighbors: [f32::INFINITY; 2] };

/// From afar, where the distance makes the error.
const FAR: f64 = 1e4;

/// Numbers of one case, the same in every run.
struct Random(u32);

impl Random {
    fn number(&self, dimension: u32) -> f64 {
        sample(self.0, dimension, 5).into()
    }

    fn vector(&self, dimension: u32) -> DVec3 {
        DVec3::from([0, 1, 2].map(|axis: u32| self.number(dimension + axis))) - DVec3::splat(0.5)
    }
}

/// A ray and a sphere that it meets at the limb, or anywhere.
fn at_the_limb(case: u32, far: f64) -> (Ray, Sphere) {
    let random = Random(case);
    let direction = random.vector(0);
    let outward = direction.cross(random.vector(3)).normalize_or(DVec3::X);
    let center = random.vector(6) * 10.0;
    let radius = 0.01 + random.number(9) * random.number(9);
    let limb = 1.0 - 1e-6 * (random.number(10) - 0.1);
    let closest = if case % 2 == 0 { limb } else { random.number(10) } * radius;
    let origin = center + outward * closest - direction * (far * random.number(11));
    let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
    (ray, Sphere::new(center.as_vec3(), to_f32(radius)))
}

/// [`Meet`] with other margins.
struct MeetWith<'a>(Meet<'a>, Margins);

impl Vectorized for MeetWith<'_> {
    type Output = Met;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> Met {
        self.0.run_with(instructions, self.1)
    }
}

/// How many answers are wrong with these margins: hits that are missed, misses that are hits, and t out of its bounds.
fn wrong_bounds(margins: Margins, far: f64, lanes: Lanes, cases: u32) -> u32 {
    let mut packet = Packet::EMPTY;
    let (mut sure, mut wrong) = (0, 0);
    for case in 0..cases {
        let (ray, sphere) = at_the_limb(case, far);
        let hit = sphere.intersect(&ray, 0.0..f32::INFINITY);
        let behind = hit.map_or(0.0, |hit| next_above::<Vec3>(hit.t));
        for range in [0.0..f32::INFINITY, behind..f32::INFINITY] {
            let expected = sphere.intersect(&ray, range.clone()).map(|hit| hit.t);
            if packet.load(lanes, &[ray; FEWEST], &range, ANY) == 0 {
                continue;
            }
            let meet = Meet { packet: &mut packet, sphere: &sphere, place: 7, rays: 1 };
            let met = lanes.run(MeetWith(meet, margins));
            let Sixteen { lower, end, .. } = &packet.sixteens[0];
            sure += u32::from(met.surely != 0);
            wrong += u32::from(match expected {
                Some(t) if met.surely != 0 => !(lower[0] <= t && next_above::<Vec3>(t) <= end[0]),
                Some(_) => met.doubtfully == 0,
                None => met.surely != 0,
            });
        }
    }
    assert!(sure > cases / 8, "{sure}");
    wrong
}

#[test]
fn t_is_in_its_bounds() {
    for lanes in Lanes::available() {
        for far in [0.001, 2.0, 20.0, FAR] {
            assert_eq!(wrong_bounds(Margins::PROVEN, far, lanes, 20_000), 0, "{lanes:?}, {far}");
        }
    }
}

#[test]
fn the_bounds_of_t_need_each_margin() {
    let proven = Margins::PROVEN;
    for lanes in Lanes::available() {
        for (margins, far) in
            [(Margins { radius: 0.0, ..proven }, 0.001), (Margins { distance: 0.0, ..proven }, FAR)]
        {
            assert!(wrong_bounds(margins, far, lanes, 20_000) > 0, "{lanes:?}, {margins:?}");
        }
    }
}

/// 16 spheres and a cone.
struct InCone<'a> {
    cone: &'a Cone,
    numbers: [[f32; LANES]; 4],
}

impl Vectorized for InCone<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        let [x, y, z, radius] = &self.numbers;
        self.cone.near(instructions, [x, y, z, radius], f32::INFINITY)
    }
}

/// How many of the spheres that are hit a cone with these margins leaves out, one around rays and that of one ray.
fn left_out(margins: [f64; 2], far: f64, lanes: Lanes, cases: u32) -> [u32; 2] {
    let (mut hits, mut left_out) = (0, [0; 2]);
    for case in 0..cases {
        let (ray, Sphere { center, radius }) = at_the_limb(case, far);
        if !Sphere::new(center, radius).occludes(&ray, 0.0..f32::INFINITY) {
            continue;
        }
        hits += 1;
        let mut sixteens = [Sixteen::EMPTY];
        for lane in 0..LANES {
            sixteens[0].set(lane, &ray);
        }
        let end = f32::INFINITY;
        let extent = lanes.run(Prepare { sixteens: &mut sixteens, end });
        let cone = Cone::around(lanes, &sixteens, &extent, 0.0, end, margins).unwrap();
        let numbers = [center.x, center.y, center.z, radius].map(|number| [number; LANES]);
        let Sixteen { one_over_a, length, .. } = &sixteens[0];
        let (origin, direction) = (ray.origin, ray.direction);
        let alone = Cone::of_one(origin, direction, one_over_a[0], length[0], 0.0, margins);
        for (cone, left_out) in [cone, alone].iter().zip(&mut left_out) {
            *left_out += u32::from(lanes.run(InCone { cone, numbers }) == 0);
        }
    }
    assert!(hits > cases / 2, "{hits}");
    left_out
}

#[test]
fn a_cone_has_every_sphere_that_is_hit() {
    for lanes in Lanes::available() {
        for far in [0.001, 2.0, 20.0, FAR] {
            assert_eq!(left_out(cone::MARGINS, far, lanes, 20_000), [0; 2], "{lanes:?}, {far}");
        }
    }
}

#[test]
fn a_cone_needs_both_margins() {
    let [of_radius, of_distance] = cone::MARGINS;
    for lanes in Lanes::available() {
        for (margins, far) in [([0.0, of_distance], 0.001), ([of_radius, 0.0], FAR)] {
            let left_out = left_out(margins, far, lanes, 20_000);
            assert!(left_out.iter().all(|&left_out| left_out > 0), "{lanes:?}, {left_out:?}");
        }
    }
}

/// How many rays, which meet at the end of the range, leave the lines that bound them on the way there.
fn beyond_the_slopes(error: f32, lanes: Lanes, cases: u32) -> u32 {
    let mut beyond = 0;
    for case in 0..cases {
        let random = Random(case);
        let (lamp, corner) = (random.vector(0) * 10.0, random.vector(3) * 100.0);
        let end = to_f32(0.1 + random.number(6));
        let mut sixteens = [Sixteen::EMPTY];
        let rays: [Ray; LANES] = core::array::from_fn(|lane| {
            let random = Random(case * 16 + u32::try_from(lane).unwrap_or(0));
            let origin = corner + random.vector(7);
            Ray::new(origin.as_vec3(), ((lamp - origin) / f64::from(end)).as_vec3())
        });
        for (lane, ray) in rays.iter().enumerate() {
            sixteens[0].set(lane, ray);
        }
        let extent = lanes.run(Prepare { sixteens: &mut sixteens, end });
        let [low, high] = extent.slopes(end, error).map(Vec3::as_dvec3);
        let [lowest, highest] = extent.origins.map(Vec3::as_dvec3);
        for ray in rays {
            let end = f64::from(end);
            let point = ray.origin.as_dvec3() + ray.direction.as_dvec3() * end;
            let is_between = (lowest + low * end).cmple(point).all()
                && (highest + high * end).cmpge(point).all();
            beyond += u32::from(!is_between);
        }
    }
    beyond
}

#[test]
fn rays_stay_between_their_slopes() {
    for lanes in Lanes::available() {
        assert_eq!(beyond_the_slopes(SLOPE_ERROR, lanes, 2_000), 0, "{lanes:?}");
        assert!(beyond_the_slopes(0.0, lanes, 2_000) > 0, "{lanes:?}");
    }
}
