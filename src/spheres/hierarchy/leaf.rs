//! Which of 16 spheres a ray may meet.

use glam::{Vec3, Vec4};

use crate::spheres::lanes::{Instructions, LANES};
use crate::{Ray, Sphere};

pub(super) const RADIUS_MARGIN: f32 = 10.0 * f32::EPSILON;
pub(super) const DISTANCE_MARGIN: f32 = 16.0 * f32::EPSILON;

/// What is added to every radius: more than underflow can take from it.
const LEAST: f32 = f32::from_bits((127 - 60) << 23); // 2^-60

/// 16 spheres.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Leaf {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    radius: [f32; LANES],
    /// Of each, its place in the order in which the spheres were given.
    index: [u32; LANES],
}

impl Leaf {
    pub(super) const LANES: usize = LANES;

    /// One sphere, over and over.
    pub(super) fn filled(index: u32, sphere: Sphere) -> Self {
        let Sphere { center, radius } = sphere;
        Self {
            x: [center.x; LANES],
            y: [center.y; LANES],
            z: [center.z; LANES],
            radius: [radius; LANES],
            index: [index; LANES],
        }
    }

    /// Puts a sphere into a lane.
    pub(super) fn set(&mut self, lane: usize, index: u32, sphere: Sphere) {
        let Sphere { center, radius } = sphere;
        self.x[lane] = center.x;
        self.y[lane] = center.y;
        self.z[lane] = center.z;
        self.radius[lane] = radius;
        self.index[lane] = index;
    }

    #[inline(always)]
    pub(super) fn sphere(&self, lane: usize) -> Sphere {
        Sphere::new(Vec3::new(self.x[lane], self.y[lane], self.z[lane]), self.radius[lane])
    }

    #[inline(always)]
    pub(super) fn index(&self, lane: usize) -> u32 {
        self.index[lane]
    }

    /// The spheres that the ray may meet before `end`, a bit for each.
    #[inline(always)]
    pub(super) fn near<I: Instructions>(&self, instructions: I, tube: &Tube, end: f32, ms: &mut [f32; LANES], clearances: &mut [f32; LANES]) -> u32 {
        let Tube { origin, direction, over_a, radius_factor, widening } = *tube;
        let mut closest = [0.0; LANES];
        let mut clearance = [0.0; LANES];
        for lane in 0..LANES {
            let x = self.x[lane] - origin.x;
            let y = self.y[lane] - origin.y;
            let z = self.z[lane] - origin.z;
            let m = instructions.multiply_add(over_a.y, y, over_a.x * x);
            let m = instructions.multiply_add(over_a.z, z, m);
            let m = if m > 0.0 { m } else { 0.0 };
            let m = if m < end { m } else { end };
            let x = instructions.multiply_add(-m, direction.x, x);
            let y = instructions.multiply_add(-m, direction.y, y);
            let z = instructions.multiply_add(-m, direction.z, z);
            let radius = instructions.multiply_add(self.radius[lane], radius_factor, LEAST);
            let radius = instructions.multiply_add(widening, m, radius);
            // In two halves, neither of which waits for the other.
            let one = instructions.multiply_add(y, y, x * x);
            let other = instructions.multiply_add(-radius, radius, z * z);
            closest[lane] = m;
            clearance[lane] = one + other;
        }
        *ms = closest;
        *clearances = clearance;
        instructions.signs(&clearance)
    }
}

/// What the leaves are tested with: a ray, and how far around it a sphere may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tube {
    origin: Vec4,
    direction: Vec4,
    /// d / d·d.
    over_a: Vec4,
    radius_factor: f32,
    widening: f32,
}

impl Tube {
    #[inline(always)]
    pub(super) fn new(ray: &Ray, radius_margin: f32, distance_margin: f32) -> Self {
        let Ray { origin, direction } = *ray;
        let a = direction.length_squared();
        // An upper bound on the length.
        let length = direction.x.abs() + direction.y.abs() + direction.z.abs();
        Self {
            origin: origin.extend(0.0),
            direction: direction.extend(0.0),
            over_a: direction.extend(0.0) * a.recip(),
            radius_factor: 1.0 + radius_margin,
            widening: distance_margin * length,
        }
    }
}
