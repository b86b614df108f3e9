//! Packets: up to 64 rays that are asked together, for neighbors share their way.
//!
//! What all have in common is asked first, of many boxes or spheres at a time: a frustum, or a [`cone`] around the rays. What
//! passes is asked of 16 rays at a time. For each sphere that a ray meets there, [`bounds`] of t in single precision tell whether
//! it can be the nearest. So each ray keeps one sphere that is certainly the nearest so far, and the exact routine is asked once,
//! at the end; at once only where the bounds of two spheres overlap, at the limb, and at the ends of the range. So the answers
//! are those of one ray at a time, bit for bit.

pub(super) mod bounds;
pub(super) mod cone;
#[cfg(test)]
mod tests;

use core::ops::Range;

use glam::Vec3;

use self::cone::Cone;
use super::filter::{LARGEST, LEAST_SQUARE};
use super::lanes::{Instructions, LANES, Lanes, Vectorized};
use super::local::{narrow, to_f32};
use super::scan::{Bits, Spheres};
use crate::float::sqrt_f32;
use crate::{Ray, Sphere, Vector};

/// How many rays a packet has at most.
pub(super) const RAYS: usize = 64;

/// Fewer rays are asked one by one.
const FEWEST: usize = 4;

/// What a test of 16 spheres with one ray takes is to that of 16 rays with one sphere as 1 to this.
const RAYS_IN_A_TEST: u32 = 2;

/// By how many tests of 16 rays a packet may fall behind before it is given up: it takes as long as some of its rays, one by one.
const PATIENCE: i32 = 256;

/// How far apart the origins of neighbors may be, in extents of the collection, and their directions, in their lengths. Rays
/// farther apart share little more than the first nodes.
pub(super) const NEIGHBORS: [f32; 2] = [0.125, 0.1];

/// How many pairs of rays tell whether they are neighbors.
const PAIRS: usize = 4;

/// In the place of a sphere, that there is none.
const NOWHERE: u32 = u32::MAX;

/// The least positive number.
const LEAST_POSITIVE: f32 = f32::from_bits(1);

/// The factor that makes a length larger than it is: a square errs by 3 u of itself, its reciprocal by 4 u, a root of either by 3
/// u, and 3 u more are for the product.
const LENGTH_FACTOR: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A bit for each ray of a packet.
pub(super) type Mask = u64;

/// The first rays of a packet, some at least.
pub(super) const fn first(rays: usize) -> Mask {
    Mask::MAX >> (RAYS - rays)
}

/// 16 rays, and the nearest sphere so far of each.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Sixteen {
    pub(super) origin: [[f32; LANES]; 3],
    pub(super) direction: [[f32; LANES]; 3],
    /// 1 / d·d.
    one_over_a: [f32; LANES],
    /// |d|, and 1 / |d|, made larger.
    length: [f32; LANES],
    one_over_length: [f32; LANES],
    /// The bounds of t at the nearest sphere so far: a sphere is nearer if it is met below the one, and is not if it is met above
    /// the other. At first, both are the end of the range; of a ray that is no longer asked, below zero.
    lower: [f32; LANES],
    pub(super) end: [f32; LANES],
    /// Where that sphere is, if it has not been asked exactly.
    place: [u32; LANES],
}

/// Rays that are asked together.
#[derive(Debug)]
pub(super) struct Packet {
    sixteens: [Sixteen; RAYS / LANES],
    /// How many of the sixteens have rays.
    count: usize,
    /// The rays that are still asked.
    pub(super) alive: Mask,
    /// The rays that have to be asked one by one.
    pub(super) alone: Mask,
    /// How many tests the packet may still fall behind.
    patience: i32,
    /// The first number that t may be.
    pub(super) first: f32,
    /// No sphere is wanted beyond it by any ray.
    pub(super) farthest: f32,
    pub(super) extent: Extent,
    pub(super) cone: Cone,
}

impl Packet {
    /// No rays.
    pub(super) const EMPTY: Self = Self {
        sixteens: [const { Sixteen::EMPTY }; RAYS / LANES],
        count: 0,
        alive: 0,
        alone: 0,
        patience: 0,
        first: 0.0,
        farthest: 0.0,
        extent: Extent { origins: [Vec3::ZERO; 2], directions: [Vec3::ZERO; 2] },
        cone: Cone::EMPTY,
    };

    /// Takes up to [`RAYS`] rays, except those that single precision cannot compute with and those from afar. Returns which: none
    /// if they are too few or too far apart, or if the range is empty.
    pub(super) fn load<V: Vector>(
        &mut self,
        lanes: Lanes,
        rays: &[Ray<V>],
        range: &Range<V::Scalar>,
        around: Around,
    ) -> Mask {
        let [start, end] = [range.start, range.end].map(to_f32);
        (self.alone, self.alive) = (0, 0);
        self.first = if start > 0.0 { start } else { LEAST_POSITIVE };
        if !around.are_neighbors(rays) {
            return 0;
        }
        let is_empty = start.is_nan() || end.is_nan() || self.first >= end;
        let Some(ray) = rays.first().filter(|_| rays.len() >= FEWEST && !is_empty) else {
            return 0;
        };
        self.count = rays.len().div_ceil(LANES).min(self.sixteens.len());
        let sixteens = &mut self.sixteens[..self.count];
        for (sixteen, rays) in sixteens.iter_mut().zip(rays.chunks(LANES)) {
            for (lane, ray) in rays.iter().enumerate() {
                sixteen.set(lane, ray);
            }
            for lane in rays.len()..LANES {
                sixteen.set(lane, ray);
            }
        }
        let given = first(rays.len());
        let allowed = given & lanes.run(Allowed { sixteens, around });
        if allowed == 0 {
            return 0;
        }
        if allowed != given {
            // In their lanes are others, so that these bound all.
            let Some(other) = rays.get(allowed.trailing_zeros() as usize) else { return 0 };
            for place in Bits(given & !allowed) {
                sixteens[place / LANES].set(place % LANES, other);
            }
        }
        self.farthest = end;
        let extent = lanes.run(Prepare { sixteens, end });
        // Not the least positive number: to compute with that takes many times as long.
        let from = if start > 0.0 { start } else { 0.0 };
        let Some(cone) = Cone::around(lanes, sixteens, &extent, from, cone::MARGINS) else {
            return 0;
        };
        (self.extent, self.cone, self.alive) = (extent, cone, allowed);
        self.patience = PATIENCE;
        for place in Bits(!allowed & first(self.count * LANES)) {
            self.silence(place);
        }
        allowed
    }

    /// The sixteens that have rays.
    #[inline(always)]
    pub(super) fn sixteens(&self) -> &[Sixteen] {
        &self.sixteens[..self.count]
    }

    /// The cone of one ray, and the end that it has so far.
    #[inline(always)]
    pub(super) fn alone(&self, place: usize) -> (Cone, f32) {
        let (sixteen, lane) = (&self.sixteens[place / LANES % (RAYS / LANES)], place % LANES);
        let at = |numbers: &[[f32; LANES]; 3]| {
            Vec3::from(numbers.each_ref().map(|numbers| numbers[lane]))
        };
        let [origin, direction] = [at(&sixteen.origin), at(&sixteen.direction)];
        let Sixteen { one_over_a, length, end, .. } = sixteen;
        (
            Cone::of_one(
                origin,
                direction,
                one_over_a[lane],
                length[lane],
                self.cone.first,
                cone::MARGINS,
            ),
            end[lane],
        )
    }

    /// The end that a ray has so far.
    #[inline(always)]
    pub(super) fn end(&self, place: usize) -> f32 {
        self.sixteens[place / LANES % (RAYS / LANES)].end[place % LANES]
    }

    /// Asks a ray no more.
    pub(super) fn drop_ray(&mut self, place: usize) {
        self.alive &= !(1 << place);
        self.silence(place);
    }

    fn silence(&mut self, place: usize) {
        let sixteen = &mut self.sixteens[place / LANES % (RAYS / LANES)];
        (sixteen.lower[place % LANES], sixteen.end[place % LANES]) = (-1.0, -1.0);
    }

    /// The sphere that is certainly the nearest of that ray so far, if it was not asked exactly.
    pub(super) fn nearest(&self, place: usize) -> Option<u32> {
        let place = self.sixteens[place / LANES % (RAYS / LANES)].place[place % LANES];
        (place != NOWHERE).then_some(place)
    }

    /// Sets the exact distance of the nearest sphere so far, and the number above it.
    pub(super) fn set_nearest(&mut self, place: usize, t: f32, above: f32) {
        let sixteen = &mut self.sixteens[place / LANES % (RAYS / LANES)];
        let lane = place % LANES;
        (sixteen.lower[lane], sixteen.end[lane], sixteen.place[lane]) = (t, above, NOWHERE);
    }

    /// Looks again up to where spheres are wanted.
    pub(super) fn update_farthest(&mut self) {
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let mut farthest = [-1.0; LANES];
        for sixteen in self.sixteens() {
            for (farthest, &end) in farthest.iter_mut().zip(&sixteen.end) {
                *farthest = larger(*farthest, end);
            }
        }
        self.farthest = reduce(farthest, larger);
    }

    /// Has these rays asked one by one.
    pub(super) fn leave_alone(&mut self, rays: Mask) {
        self.alone |= rays & self.alive;
        for place in Bits(rays & self.alive) {
            self.drop_ray(place);
        }
    }

    /// Counts what a step costs, and what it would cost the rays one by one, each as tests of 16 rays. Returns `false` where the
    /// packet is given up, because it has cost more for too long.
    #[inline(always)]
    pub(super) fn pays(&mut self, cost: u32, one_by_one: u32) -> bool {
        // Both are small.
        #[expect(clippy::cast_possible_wrap, reason = "both are small")]
        let gain = one_by_one as i32 - cost as i32;
        self.patience = (self.patience + gain).min(PATIENCE);
        if self.patience < 0 {
            self.leave_alone(self.alive);
        }
        self.patience >= 0
    }

    /// How many tests of 16 rays one of so many is.
    #[inline(always)]
    pub(super) fn tests(rays: Mask) -> u32 {
        (0..RAYS / LANES).map(|number| u32::from(rays >> (number * LANES) & 0xFFFF != 0)).sum()
    }

    /// Asks all spheres of a collection, as far as any rays are left to be asked.
    pub(super) fn scan<V: Vector, Q: Question<V>>(
        &mut self,
        lanes: Lanes,
        spheres: &Spheres<V>,
        first_place: u32,
        question: &mut Q,
    ) {
        let cone = self.cone.relative_to(narrow(spheres.middle.center));
        let mut filtered = 0;
        while let Some(blocks) = spheres.blocks.get(filtered..).filter(|rest| !rest.is_empty()) {
            let near = cone::InBlocks { blocks, cone: &cone, end: self.farthest };
            let (skipped, near) = lanes.run(near);
            let first = (filtered + skipped) * LANES;
            for index in Bits(near.into()).map(|lane| first + lane) {
                let Some(sphere) = spheres.spheres.get(index) else { break };
                #[expect(clippy::cast_possible_truncation, reason = "they are fewer")]
                question.ask(self, lanes, self.alive, sphere, first_place + index as u32);
            }
            filtered += skipped + 1;
            let cost = near.count_ones() * Self::tests(self.alive);
            #[expect(clippy::cast_possible_truncation, reason = "more would do as well")]
            let blocks = skipped.min(RAYS) as u32 + 1;
            if !self.pays(cost, self.alive.count_ones() * blocks / RAYS_IN_A_TEST) {
                return;
            }
        }
    }
}

/// What is asked of all rays.
pub(super) trait Question<V: Vector> {
    /// Whether spheres may be asked in any order: the nearest need not be the first.
    const IN_ANY_ORDER: bool;

    /// Asks whether those rays meet the sphere at that place.
    fn ask(
        &mut self,
        packet: &mut Packet,
        lanes: Lanes,
        rays: Mask,
        sphere: &Sphere<V>,
        place: u32,
    );
}

impl Sixteen {
    const EMPTY: Self = Self {
        origin: [[0.0; LANES]; 3],
        direction: [[0.0; LANES]; 3],
        one_over_a: [0.0; LANES],
        length: [0.0; LANES],
        one_over_length: [0.0; LANES],
        lower: [0.0; LANES],
        end: [0.0; LANES],
        place: [NOWHERE; LANES],
    };

    /// Puts a ray into a lane.
    #[inline(always)]
    fn set<V: Vector>(&mut self, lane: usize, ray: &Ray<V>) {
        let (origin, direction) = (narrow(ray.origin), narrow(ray.direction));
        for axis in 0..3 {
            self.origin[axis][lane] = origin[axis];
            self.direction[axis][lane] = direction[axis];
        }
    }
}

/// The square of a length.
#[inline(always)]
pub(super) fn square<I: Instructions>(instructions: I, x: f32, y: f32, z: f32) -> f32 {
    instructions.multiply_add(z, z, instructions.multiply_add(y, y, x * x))
}

/// One number of all, the least or the largest.
#[inline(always)]
fn reduce(mut numbers: [f32; LANES], choose: impl Fn(f32, f32) -> f32) -> f32 {
    let mut half = LANES / 2;
    while half > 0 {
        for lane in 0..half {
            numbers[lane] = choose(numbers[lane], numbers[lane + half]);
        }
        half /= 2;
    }
    numbers[0]
}

/// Where rays are asked together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    /// Where rays do not come from afar.
    pub(super) center: Vec3,
    pub(super) radius_squared: f32,
    /// How far apart the origins of neighbors may be, and their directions, in their lengths.
    pub(super) neighbors: [f32; 2],
}

impl Around {
    /// Whether most of a few pairs of rays are neighbors: those that have nothing in common are told before they cost anything.
    fn are_neighbors<V: Vector>(&self, rays: &[Ray<V>]) -> bool {
        let [apart, wide] = self.neighbors.map(|limit| limit * limit);
        let step = rays.len() / PAIRS;
        let others = rays.iter().skip(step / 2).step_by(step.max(1));
        let strangers = rays.iter().step_by(step.max(1)).zip(others).filter(|(one, other)| {
            let origins = narrow(one.origin - other.origin).length_squared();
            let directions = narrow(one.direction - other.direction).length_squared();
            origins > apart || directions > wide * narrow(one.direction).length_squared()
        });
        strangers.take(PAIRS).count() * 2 <= PAIRS
    }
}

/// Finds the rays that single precision can compute with, as [`Segment::allows`](super::filter::Segment::allows) does, and that
/// do not come from afar.
struct Allowed<'a> {
    sixteens: &'a [Sixteen],
    around: Around,
}

impl Vectorized for Allowed<'_> {
    type Output = Mask;

    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "so that the loop has no branches")]
    fn run<I: Instructions>(self, instructions: I) -> Mask {
        let Self { sixteens, around: Around { center, radius_squared, .. } } = self;
        let mut allowed = 0;
        for (place, Sixteen { origin, direction, .. }) in sixteens.iter().enumerate() {
            let mut signs = [0.0; LANES];
            let ([p, q, r], [x, y, z]) = (origin, direction);
            for lane in 0..LANES {
                let a = square(instructions, x[lane], y[lane], z[lane]);
                let all = a + square(instructions, p[lane], q[lane], r[lane]);
                let [x, y, z] = [p[lane] - center.x, q[lane] - center.y, r[lane] - center.z];
                let is_near = square(instructions, x, y, z) <= radius_squared;
                let is_allowed = (all <= LARGEST * LARGEST) & (a >= LEAST_SQUARE) & is_near;
                signs[lane] = if is_allowed { -1.0 } else { 1.0 };
            }
            allowed |= Mask::from(instructions.signs(&signs)) << (place * LANES);
        }
        allowed
    }
}

/// Computes what is the same for all spheres, and the extent of the rays.
struct Prepare<'a> {
    sixteens: &'a mut [Sixteen],
    end: f32,
}

impl Vectorized for Prepare<'_> {
    type Output = Extent;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> Extent {
        let Self { sixteens, end } = self;
        for sixteen in &mut *sixteens {
            let [x, y, z] = &sixteen.direction;
            let mut numbers = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let a = square(instructions, x[lane], y[lane], z[lane]);
                let one_over_a = 1.0 / a;
                numbers[0][lane] = one_over_a;
                numbers[1][lane] = sqrt_f32(a) * LENGTH_FACTOR;
                numbers[2][lane] = sqrt_f32(one_over_a) * LENGTH_FACTOR;
            }
            [sixteen.one_over_a, sixteen.length, sixteen.one_over_length] = numbers;
            (sixteen.lower, sixteen.end) = ([end; LANES], [end; LANES]);
            sixteen.place = [NOWHERE; LANES];
        }
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let mut extent = Packet::EMPTY.extent;
        for axis in 0..3 {
            let [mut p_low, mut d_low] = [[f32::MAX; LANES]; 2];
            let [mut p_high, mut d_high] = [[f32::MIN; LANES]; 2];
            for Sixteen { origin, direction, .. } in &*sixteens {
                let (origin, direction) = (&origin[axis], &direction[axis]);
                for lane in 0..LANES {
                    p_low[lane] = smaller(p_low[lane], origin[lane]);
                    d_low[lane] = smaller(d_low[lane], direction[lane]);
                    p_high[lane] = larger(p_high[lane], origin[lane]);
                    d_high[lane] = larger(d_high[lane], direction[lane]);
                }
            }
            extent.origins[0][axis] = reduce(p_low, smaller);
            extent.origins[1][axis] = reduce(p_high, larger);
            extent.directions[0][axis] = reduce(d_low, smaller);
            extent.directions[1][axis] = reduce(d_high, larger);
        }
        extent
    }
}

/// The least and the largest of all origins, and of all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) origins: [Vec3; 2],
    pub(super) directions: [Vec3; 2],
}
