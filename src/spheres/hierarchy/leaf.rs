//! Which of 16 spheres a ray may meet.

use glam::Vec3;

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
    pub(super) fn near<I: Instructions>(&self, instructions: I, tube: &Tube, end: f32) -> u32 {
        let Tube { origin, direction, one_over_a, radius_factor, widening } = *tube;
        let mut clearance = [0.0; LANES];
        for (lane, clearance) in clearance.iter_mut().enumerate() {
            let x = self.x[lane] - origin.x;
            let y = self.y[lane] - origin.y;
            let z = self.z[lane] - origin.z;
            let h = instructions.multiply_add(direction.y, y, direction.x * x);
            let h = instructions.multiply_add(direction.z, z, h);
            let m = h * one_over_a;
            let m = if m > 0.0 { m } else { 0.0 };
            let m = if m < end { m } else { end };
            let x = instructions.multiply_add(-m, direction.x, x);
            let y = instructions.multiply_add(-m, direction.y, y);
            let z = instructions.multiply_add(-m, direction.z, z);
            let radius = instructions.multiply_add(self.radius[lane], radius_factor, LEAST);
            let radius = instructions.multiply_add(widening, m, radius);
            let square = x * x;
            let square = instructions.multiply_add(y, y, square);
            let square = instructions.multiply_add(z, z, square);
            *clearance = instructions.multiply_add(-radius, radius, square);
        }
        instructions.signs(&clearance)
    }
}

/// What the leaves are tested with: a ray, and how far around it a sphere may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tube {
    origin: Vec3,
    direction: Vec3,
    /// 1 / d·d.
    one_over_a: f32,
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
            origin,
            direction,
            one_over_a: a.recip(),
            radius_factor: 1.0 + radius_margin,
            widening: distance_margin * length,
        }
    }
}
