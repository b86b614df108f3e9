//! The filter: which of 16 spheres a ray may meet, in `f32` and many lanes at a time, in either precision. It may let a sphere
//! pass that the ray misses; it never drops one that it hits.
//!
//! It is the test of [`rejection`](crate::rejection), which derives it and its margins: with o = c - p, h = d·o, a = d·d, and
//! s = h, but at least a `start` and at most a `end`, a sphere is dropped where
//!
//! ```text
//! |m d - o|² - r² = (o·o - r²) - T > 0,   T = 2 h m - a m² = s (2 h - s) / a
//! ```
//!
//! For the whole line s = h and T = h² / a, which is quicker: it goes first where there are many spheres. For the half-line there
//! is no end: that is enough where there are few.
//!
//! **Coordinates** are relative to a center of the collection, and rounded ([`local`](super::local)). What that makes of the
//! center of a sphere and of the ray's origin, r has added to it: [`COORDINATE_MARGIN`], 3 u, of c. So the factor of T is in what
//! is kept of a ray and all else in what is kept of each sphere: the loop pays nothing for the bound, and it holds wherever a
//! sphere is.
//!
//! **A moved origin.** Where a ray begins anew far ahead of its origin, `start` may be below zero. Then a sphere before the new
//! origin has m < 0; with d turned around, that is a case of the derivation.
//!
//! **The sign.** So the result is below zero for every sphere that is hit, and its sign alone says which spheres pass. It is
//! NaN only where `end` is NaN or below zero: then nothing is hit, and any answer will do.
//!
//! **Overflow and underflow.** Lengths up to [`LARGEST`] and directions of 2⁻³⁰ to 2⁶⁰ keep every intermediate result finite:
//! |o| < 2⁶², |h| < 2¹²², and m < 2⁹² for a sphere that is hit, wherever the range starts. (Only a `start` and a `end` may be
//! infinite, and then they limit nothing, or nothing is hit.) A product that underflows is off by 2⁻¹⁵⁰ more, which factors of
//! 2 m, 2 |h| and 2 |o| / |d|, together below 2⁶² |o|, bring to 2⁻⁸⁸ |o|. Either |o| < 2⁻¹² and that is below `LEAST`, which each
//! r² has added to it, or it is far below u o·o. Larger spheres pass always, and other rays ask all.

use glam::{Vec3, Vec4};

use super::lanes::{Instructions, LANES};
use super::local::{Moved, local_end, local_start, narrow, to_f32};
use crate::rejection::{Bounds, can_be_hit};
use crate::{Scalar, Sphere, Vector};

/// How many spheres are few: those of one vector of four.
pub(crate) const FEW: usize = 4;

/// By which part of itself T, and by three times which r², is made larger.
pub(crate) const MARGIN: f32 = f32::MARGIN;

/// What r has added to it for rounded coordinates, in the sum of those of the center, which is no less than its distance: 3 u.
const COORDINATE_MARGIN: f64 = 1.5 * f32::EPSILON as f64;

/// The largest coordinate, radius and length that the filter computes with.
pub(super) const LARGEST: f32 = f32::from_bits((127 + 60) << 23); // 2^60

/// The least square of a direction's length that it computes with.
pub(super) const LEAST_SQUARE: f32 = f32::SQUARES[0];

/// What the filter knows of 16 spheres.
///
/// The four arrays of a block lie together: a scan reads one stream of memory in whole cache lines. That measured as the best
/// layout, and it has no rest of the last block to be treated apart, because lanes without a sphere are dropped like others.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct Block {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    /// -r², made larger. Infinite for a sphere that is always dropped, negative infinite for one that passes always.
    negative_radius_squared: [f32; LANES],
}

impl Block {
    /// A block without spheres: every lane is dropped.
    pub(crate) const EMPTY: Self = Self {
        x: [0.0; LANES],
        y: [0.0; LANES],
        z: [0.0; LANES],
        negative_radius_squared: [f32::INFINITY; LANES],
    };

    /// Puts a sphere into a lane, with coordinates relative to `middle`.
    pub(crate) fn set<V: Vector>(
        &mut self,
        lane: usize,
        sphere: &Sphere<V>,
        middle: V,
        margin: f32,
    ) {
        let center = narrow(sphere.center - middle);
        let (center, negative_radius_squared) = if !can_be_hit(sphere) {
            (Vec3::ZERO, f32::INFINITY)
        } else if !(center.abs().max_element() <= LARGEST && to_f32(sphere.radius) <= LARGEST) {
            (Vec3::ZERO, f32::NEG_INFINITY)
        } else {
            let distance: f64 = center.abs().element_sum().into();
            let radius = sphere.radius.into() + distance * COORDINATE_MARGIN;
            (center, -enlarged_square(radius, margin))
        };
        self.x[lane] = center.x;
        self.y[lane] = center.y;
        self.z[lane] = center.z;
        self.negative_radius_squared[lane] = negative_radius_squared;
    }

    /// Takes the sphere out of a lane: it is dropped from now on.
    pub(crate) fn clear(&mut self, lane: usize) {
        self.negative_radius_squared[lane] = f32::INFINITY;
    }

    /// The coordinates of the centers, and -r², made larger: infinite for a sphere that is always dropped, negative infinite for
    /// one that passes always.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [&[f32; LANES]; 4] {
        [&self.x, &self.y, &self.z, &self.negative_radius_squared]
    }

    /// The spheres that the ray may hit from the segment's start to `end`, a bit for each.
    #[inline(always)]
    pub(crate) fn near_segment<I: Instructions>(
        &self,
        instructions: I,
        segment: &Segment,
        end: f32,
    ) -> u32 {
        let longest = segment.a * end;
        // Not by `array::from_fn`, which stays a call: it is compiled for other instructions than its caller.
        let mut clearance = [0.0; LANES];
        for (lane, clearance) in clearance.iter_mut().enumerate() {
            let (power, h) = self.power_and_h(instructions, lane, segment);
            // Comparisons that are one instruction each: `f32::clamp` looks for NaN.
            let s = if h > segment.shortest { h } else { segment.shortest };
            let s = if s < longest { s } else { longest };
            *clearance = instructions.multiply_add(s * segment.one_over_a, (s - h) - h, power);
        }
        instructions.signs(&clearance)
    }

    /// Whether there is a sphere that the whole line may hit, ahead or behind.
    #[inline(always)]
    pub(crate) fn is_near_line<I: Instructions>(&self, instructions: I, segment: &Segment) -> bool {
        let mut clearance = [0.0; LANES];
        for (lane, clearance) in clearance.iter_mut().enumerate() {
            let (power, h) = self.power_and_h(instructions, lane, segment);
            *clearance = instructions.multiply_add(-(h * segment.one_over_a), h, power);
        }
        instructions.signs(&clearance) != 0
    }

    /// o·o - r² and d·o.
    #[inline(always)]
    fn power_and_h<I: Instructions>(
        &self,
        instructions: I,
        lane: usize,
        segment: &Segment,
    ) -> (f32, f32) {
        let Segment { origin, direction, .. } = *segment;
        let x = self.x[lane] - origin.x;
        let y = self.y[lane] - origin.y;
        let z = self.z[lane] - origin.z;
        let power = instructions.multiply_add(x, x, self.negative_radius_squared[lane]);
        let power = instructions.multiply_add(y, y, power);
        let power = instructions.multiply_add(z, z, power);
        let h = instructions.multiply_add(direction.y, y, direction.x * x);
        (power, instructions.multiply_add(direction.z, z, h))
    }

    /// Which of the first [`FEW`] spheres the half-line may hit, a bit for each: in one vector, whatever the instructions.
    #[inline(always)]
    pub(crate) fn few_near_half_line(&self, segment: &Segment) -> u32 {
        let Segment { origin, direction, one_over_a, shortest, .. } = *segment;
        let first = |lanes: &[f32; LANES]| Vec4::from_slice(lanes);
        let x = first(&self.x) - origin.x;
        let y = first(&self.y) - origin.y;
        let z = first(&self.z) - origin.z;
        let power = x * x + y * y + z * z + first(&self.negative_radius_squared);
        let h = x * direction.x + y * direction.y + z * direction.z;
        let s = h.max(Vec4::splat(shortest));
        (power - s * one_over_a * ((h - s) + h)).is_negative_bitmask()
    }
}

/// Whether the filters can compute with a sphere that can be hit.
pub(super) fn is_in_reach<V: Vector>(sphere: &Sphere<V>) -> bool {
    narrow(sphere.center).abs().max_element() <= LARGEST && to_f32(sphere.radius) <= LARGEST
}

/// r², made larger by three times `margin` of itself and by what underflow can take from it.
fn enlarged_square(radius: f64, margin: f32) -> f32 {
    // The margin has room for rounding.
    to_f32(radius * radius * (1.0 + 3.0 * f64::from(margin)) + f64::from(f32::LEAST))
}

/// What the filter knows of a ray.
///
/// The quotient is the last: the compiler writes four numbers together, and the loop, which reads each alone, would have to wait
/// for the division before it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    origin: Vec3,
    direction: Vec3,
    /// d·d.
    a: f32,
    /// a times the t at which the segment begins.
    shortest: f32,
    /// 1 / d·d, made larger.
    one_over_a: f32,
    /// Where on the ray its origin is.
    moved: f64,
}

impl Segment {
    /// Whether the filters can compute with a ray of that origin, no farther from the center than the root of `farthest_squared`,
    /// and of that direction: of a NaN, they cannot.
    #[inline(always)]
    pub(crate) fn allows(origin: Vec3, direction: Vec3, farthest_squared: f32) -> bool {
        let a = direction.length_squared();
        origin.length_squared() <= farthest_squared
            && (LEAST_SQUARE..=LARGEST * LARGEST).contains(&a)
    }

    /// Of a ray, its origin relative to the center, from the start of a range on.
    #[inline(always)]
    pub(crate) fn new<V: Vector>(
        origin: Vec3,
        direction: Vec3,
        start: V::Scalar,
        margin: f32,
    ) -> Self {
        let a = direction.length_squared();
        let one_over_a = (1.0 + margin) / a;
        let shortest = local_start::<V>(start, 0.0) * a;
        Self { origin, direction, a, shortest, one_over_a, moved: 0.0 }
    }

    /// Of a ray that begins anew.
    pub(crate) fn moved<V: Vector>(
        Moved { t, origin }: Moved,
        direction: Vec3,
        start: V::Scalar,
        margin: f32,
    ) -> Self {
        let mut segment = Self::new::<V>(origin.as_vec3(), direction, start, margin);
        segment.shortest = local_start::<V>(start, t) * segment.a;
        segment.moved = t;
        segment
    }

    /// The end of a range, where t counts from the segment's origin.
    #[inline(always)]
    pub(crate) fn end<S: Scalar>(&self, end: S) -> f32 {
        local_end(end, self.moved)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use sobol_burley::sample;

    use super::*;
    use crate::spheres::lanes::{Lanes, Vectorized};
    use crate::{Hittable, Ray};

    /// A block, and whether it passes each of the tests.
    struct Tests<'a> {
        block: &'a Block,
        segment: Segment,
        end: f32,
    }

    impl Vectorized for Tests<'_> {
        type Output = (u32, bool);

        #[inline(always)]
        fn run<I: Instructions>(self, instructions: I) -> (u32, bool) {
            let Self { block, segment, end } = self;
            (
                block.near_segment(instructions, &segment, end),
                block.is_near_line(instructions, &segment),
            )
        }
    }

    /// How many of the hits of random rays that graze a sphere, or end where they meet it, a filter of that margin drops.
    fn dropped(margin: f32, lanes: Lanes, cases: u32) -> u32 {
        const LANE: usize = 3;
        let mut hits = 0;
        let mut dropped = 0;
        for case in 0..cases {
            let random = |dimension| f64::from(sample(case, dimension, 1));
            let vector = |dimension| {
                DVec3::new(random(dimension), random(dimension + 1), random(dimension + 2))
                    - DVec3::splat(0.5)
            };
            let direction = vector(0);
            let outward = direction.cross(vector(3)).normalize_or(DVec3::X);
            let center = vector(6) * 10.0;
            let radius = 0.01 + random(9) * random(9);
            let at_the_limb = 1.0 - 1e-6 * random(10);
            let closest =
                if case % 2 == 0 { at_the_limb } else { random(10) * at_the_limb } * radius;
            let origin = center + outward * closest - direction * (20.0 * random(11));

            #[expect(clippy::cast_possible_truncation, reason = "any radius will do")]
            let sphere = Sphere::new(center.as_vec3(), radius as f32);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
            let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };
            let mut block = Block::EMPTY;
            block.set(LANE, &sphere, Vec3::ZERO, margin);
            let just_after = f32::from_bits(hit.t.to_bits() + 1);
            let Some([_, exit]) = sphere.roots(&ray) else { continue };
            for [start, end] in [
                [0.0, f32::INFINITY],
                [0.0, just_after],
                [hit.t, f32::INFINITY],
                [exit, f32::INFINITY],
            ] {
                hits += 1;
                let segment = Segment::new::<Vec3>(ray.origin, ray.direction, start, margin);
                let (near, near_line) = lanes.run(Tests { block: &block, segment, end });
                let near_half_line = block.few_near_half_line(&segment);
                assert_eq!((near | near_half_line) & !(1 << LANE), 0, "an empty lane passed");
                dropped += u32::from(near == 0 || !near_line || near_half_line == 0);
            }
        }
        assert!(hits > cases / 2);
        dropped
    }

    #[test]
    fn drops_no_sphere_that_is_hit() {
        for lanes in Lanes::available() {
            assert_eq!(dropped(MARGIN, lanes, 60_000), 0, "{lanes:?}");
        }
    }

    #[test]
    fn needs_its_margin() {
        for lanes in Lanes::available() {
            assert!(dropped(0.0, lanes, 60_000) > 0, "{lanes:?}");
        }
    }
}
