//! Packets and boxes, in f32 and many lanes at a time: which of 16 boxes some ray may pass through, by the frustum of all, and
//! which of 16 rays pass through a box. A box may be kept though no ray passes through it; it is never dropped if a sphere in it
//! is hit.
//!
//! **The frustum.** The coordinates of all rays at t are between those of two lines: from p₀ along d₀, and from p₁ along d₁, the
//! least and the largest by axis. So a hit at t in a box from b₀ to b₁ has
//!
//! ```text
//! p₀ + t d₀ ≤ b₁   and   p₁ + t d₁ ≥ b₀
//! ```
//!
//! on each axis: six bounds on t, each an upper or a lower one by the sign of its d.
//!
//! A component below 2 u D (D: the largest component of all directions) is replaced by that, downwards for d₀ and upwards for d₁,
//! which takes nothing from the frustum. With r for 1 / d and L for the largest coordinate of all, relative to the center of the
//! region, as for one ray, an error of u r in a quotient, two products and two sums make 7 u L r, and the difference of an origin
//! and the center, which is rounded, u L r. What is left of the [`MARGIN`](super::boxes) of 16 u L r is more than the rounding of
//! t.
//!
//! **A box and 16 rays.** With c and h for the middle of a slab and half its width, a ray is in it between c r - p r ∓ h |r|.
//! That does not depend on signs. With a component below 2 u D (of this ray) replaced by that, of the same sign:
//!
//! ```text
//! r                 a quotient                  is off by at most  u r, and so c r, p r and h r by 3 u L r
//! c, h              a sum each, halved                             2 u L r
//! c r, p r, h r     a product each                                 3 u L r
//! c r - p r         a sum                                          2 u L r
//! that ∓ h r        a sum                                          3 u L r
//! p                 less the center                                u L r
//! the replaced                                                     4 u L r
//! ```
//!
//! Together 18 u L r. The half-width is made larger by [`RAY_MARGIN`] L, 24 u L, which takes a rounding. Of one ray, 16 boxes are
//! asked as without a packet, with the same r and p r: that takes less than 18 u L r, as it has no c and h.

use glam::{Vec3, Vec4};

use super::boxes::{self, Boxes, LEAST_COMPONENT};
use super::region::Region;
use crate::Vector;
use crate::spheres::lanes::{Instructions, LANES, Vectorized};
use crate::spheres::local::narrow;
use crate::spheres::packet::{Mask, Packet, RAYS, Sixteen};

#[cfg(test)]
mod tests;

/// By how much a box may be missed by a single ray, in L: 24 u. See the derivation above.
const RAY_MARGIN: f32 = 12.0 * f32::EPSILON;

/// A bound on t: where a line meets a plane, as a product and a sum.
#[derive(Clone, Copy, Debug)]
struct Bound {
    reciprocal: Vec4,
    offset: Vec4,
}

impl Bound {
    /// At any plane, that number.
    fn none(number: f32) -> Self {
        Self { reciprocal: Vec4::ZERO, offset: Vec4::splat(number) }
    }

    fn set(&mut self, axis: usize, origin: f32, direction: f32, reach: f32) {
        let reciprocal = direction.recip();
        self.reciprocal[axis] = reciprocal;
        self.offset[axis] = -(origin * reciprocal) + reciprocal.abs() * reach;
    }

    #[inline(always)]
    fn at<I: Instructions>(&self, instructions: I, axis: usize, plane: f32) -> f32 {
        instructions.multiply_add(plane, self.reciprocal[axis], self.offset[axis])
    }
}

/// The frustum of a packet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    /// Where the lowest line is below a high plane: from a bound on, and up to one, of which one is none.
    below: [Bound; 2],
    /// Where the highest line is above a low plane.
    above: [Bound; 2],
    first: f32,
}

impl Frustum {
    pub(super) fn new<V: Vector>(packet: &Packet, region: &Region<V>, margin: f32) -> Self {
        let center = narrow(region.center);
        let [low, high] = packet.extent.origins.map(|origin| origin - center);
        let [least, greatest] = packet.extent.directions;
        let reach = margin * largest([low, high]).max(region.extent);
        let smallest = largest(packet.extent.directions) * LEAST_COMPONENT;
        let none = [Bound::none(f32::NEG_INFINITY), Bound::none(f32::INFINITY)];
        let mut frustum = Self { below: none, above: none, first: packet.first };
        for axis in 0..3 {
            let d = if least[axis].abs() < smallest { -smallest } else { least[axis] };
            let is_upper = d > 0.0;
            let towards = if is_upper { reach } else { -reach };
            frustum.below[usize::from(is_upper)].set(axis, low[axis], d, towards);
            let d = if greatest[axis].abs() < smallest { smallest } else { greatest[axis] };
            let is_upper = d < 0.0;
            let towards = if is_upper { reach } else { -reach };
            frustum.above[usize::from(is_upper)].set(axis, high[axis], d, towards);
        }
        frustum
    }

    /// The boxes through which a ray may pass before `end`, a bit for each, and where the first may enter them.
    #[inline(always)]
    pub(super) fn entered<I: Instructions>(
        &self,
        instructions: I,
        boxes: &Boxes,
        end: f32,
        entries: &mut [f32; LANES],
    ) -> u32 {
        let Self { below, above, first } = *self;
        let [x, y, z] = boxes.planes();
        // Not infinite: an empty box is entered nowhere, and left before.
        let end = if end < f32::MAX { end } else { f32::MAX };
        // Comparisons that are one instruction each, and pass over NaN, of an empty box and of no bound.
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let mut lengths = [0.0; LANES];
        for lane in 0..LANES {
            let pass = |axis: usize, [low, high]: &[[f32; LANES]; 2]| {
                (
                    larger(
                        below[0].at(instructions, axis, high[lane]),
                        larger(above[0].at(instructions, axis, low[lane]), first),
                    ),
                    smaller(
                        below[1].at(instructions, axis, high[lane]),
                        smaller(above[1].at(instructions, axis, low[lane]), end),
                    ),
                )
            };
            let (x, y, z) = (pass(0, x), pass(1, y), pass(2, z));
            let enter = larger(larger(x.0, y.0), z.0);
            let leave = smaller(smaller(x.1, y.1), z.1);
            entries[lane] = enter;
            lengths[lane] = leave - enter;
        }
        !instructions.signs(&lengths) & 0xFFFF
    }
}

/// The largest coordinate of two.
fn largest([low, high]: [Vec3; 2]) -> f32 {
    low.abs().max(high.abs()).max_element()
}

/// What boxes are tested with: the rays of a packet, 16 at a time.
#[derive(Debug)]
pub(super) struct Slabs {
    sixteens: [SixteenSlabs; RAYS / LANES],
    /// What half a box's width is made larger by.
    reach: f32,
}

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct SixteenSlabs {
    /// r and -p r, by axis.
    reciprocal: [[f32; LANES]; 3],
    offset: [[f32; LANES]; 3],
}

impl Slabs {
    pub(super) const EMPTY: Self = Self {
        sixteens: [SixteenSlabs { reciprocal: [[0.0; LANES]; 3], offset: [[0.0; LANES]; 3] };
            RAYS / LANES],
        reach: 0.0,
    };

    /// Those of one ray, as for one ray alone.
    #[inline(always)]
    pub(super) fn alone(&self, ray: usize) -> boxes::Slabs {
        let SixteenSlabs { reciprocal, offset } = &self.sixteens[ray / LANES % (RAYS / LANES)];
        let vector = |numbers: &[[f32; LANES]; 3]| {
            let [x, y, z] = numbers.each_ref().map(|numbers| numbers[ray % LANES]);
            Vec4::new(x, y, z, 0.0)
        };
        boxes::Slabs::from_reciprocal(vector(reciprocal), vector(offset), self.reach)
    }
}

/// Prepares the slabs of a packet.
pub(super) struct Prepare<'a> {
    pub(super) slabs: &'a mut Slabs,
    pub(super) packet: &'a Packet,
    /// That of the region.
    pub(super) center: Vec3,
    pub(super) extent: f32,
    pub(super) margin: f32,
}

impl<'a> Prepare<'a> {
    pub(super) fn new<V: Vector>(
        slabs: &'a mut Slabs,
        packet: &'a Packet,
        region: &Region<V>,
    ) -> Self {
        let (center, extent) = (narrow(region.center), region.extent);
        Self { slabs, packet, center, extent, margin: RAY_MARGIN }
    }
}

impl Vectorized for Prepare<'_> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) {
        let Self { slabs, packet, center, extent, margin } = self;
        slabs.reach =
            margin * largest(packet.extent.origins.map(|origin| origin - center)).max(extent);
        for (slabs, sixteen) in slabs.sixteens.iter_mut().zip(packet.sixteens()) {
            let Sixteen { origin, direction: [x, y, z], .. } = sixteen;
            let larger = |a: f32, b: f32| if a > b { a } else { b };
            let mut least = [0.0; LANES];
            for lane in 0..LANES {
                let largest = larger(larger(x[lane].abs(), y[lane].abs()), z[lane].abs());
                least[lane] = largest * LEAST_COMPONENT;
            }
            for (axis, (origin, direction)) in origin.iter().zip([x, y, z]).enumerate() {
                let (mut reciprocals, mut offsets) = ([0.0; LANES], [0.0; LANES]);
                for lane in 0..LANES {
                    let magnitude = larger(direction[lane].abs(), least[lane]);
                    let reciprocal = (1.0 / magnitude).copysign(direction[lane]);
                    reciprocals[lane] = reciprocal;
                    offsets[lane] = -((origin[lane] - center[axis]) * reciprocal);
                }
                (slabs.reciprocal[axis], slabs.offset[axis]) = (reciprocals, offsets);
            }
        }
    }
}

/// Asks which rays pass through a box before the nearest sphere so far.
pub(super) struct Enter<'a> {
    pub(super) slabs: &'a Slabs,
    pub(super) packet: &'a Packet,
    pub(super) boxes: &'a Boxes,
    pub(super) lane: usize,
    /// The rays that are asked.
    pub(super) rays: Mask,
}

impl Vectorized for Enter<'_> {
    type Output = Mask;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> Mask {
        let Self { slabs, packet, boxes, lane, rays } = self;
        let mut middle = [0.0; 3];
        let mut half = [0.0; 3];
        for axis in 0..3 {
            let [low, high] = boxes.planes()[axis].map(|planes| planes[lane % LANES]);
            middle[axis] = (low + high) * 0.5;
            half[axis] = (high - low) * 0.5 + slabs.reach;
        }
        let mut entered = 0;
        for ((slabs, sixteen), number) in slabs.sixteens.iter().zip(packet.sixteens()).zip(0..) {
            let shift = number * LANES;
            if rays >> shift & 0xFFFF != 0 {
                let left = slabs.leave(instructions, [middle, half], packet.first, &sixteen.end);
                entered |= Mask::from(!left & 0xFFFF) << shift;
            }
        }
        entered & rays
    }
}

impl SixteenSlabs {
    /// Which rays leave the box before they enter it.
    #[inline(always)]
    fn leave<I: Instructions>(
        &self,
        instructions: I,
        [middle, half]: [[f32; 3]; 2],
        first: f32,
        end: &[f32; LANES],
    ) -> u32 {
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let mut lengths = [0.0; LANES];
        let [reciprocal_x, reciprocal_y, reciprocal_z] = &self.reciprocal;
        let [offset_x, offset_y, offset_z] = &self.offset;
        for lane in 0..LANES {
            let pass = |axis: usize, reciprocals: &[f32; LANES], offsets: &[f32; LANES]| {
                let reciprocal = reciprocals[lane];
                let t = instructions.multiply_add(middle[axis], reciprocal, offsets[lane]);
                (
                    instructions.multiply_add(-half[axis], reciprocal.abs(), t),
                    instructions.multiply_add(half[axis], reciprocal.abs(), t),
                )
            };
            let x = pass(0, reciprocal_x, offset_x);
            let y = pass(1, reciprocal_y, offset_y);
            let z = pass(2, reciprocal_z, offset_z);
            let enter = larger(larger(x.0, y.0), larger(z.0, first));
            let leave = smaller(smaller(x.1, y.1), smaller(z.1, end[lane]));
            lengths[lane] = leave - enter;
        }
        instructions.signs(&lengths)
    }
}
