//! Which of 16 boxes a ray passes through, and where it enters them, in f32 and many lanes at a time.
//!
//! A box is passed through between the last near plane and the first far plane of its three slabs (Kay and Kajiya). It may be
//! kept though the ray misses it; it is never dropped if a sphere in it is hit.
//!
//! Coordinates are relative to the center of a region ([`region`](super::region)). Let p and d be a component of the ray's origin
//! and direction, c the coordinate of a plane, L the largest coordinate of all boxes or of the origin, and D the largest
//! component of the direction, by magnitude. A hit at t is a point of the box: it is beyond each near plane and before each far
//! one, so for d > 0
//!
//! ```text
//! (c_near - p) / d ≤ t ≤ (c_far - p) / d
//! ```
//!
//! and its exact t is no less than the start of the range and no more than its end, which [`local`](crate::spheres::local) rounds
//! outwards. So the start counts as one more near plane, and the end as one more far plane.
//!
//! **Rounded numbers.** The planes are rounded outwards. The origin is rounded to `f32`, by at most u L with u = 2⁻²⁴, and may
//! have been moved, by u L / 8 ([`local`](crate::spheres::local): u / 16 of its distance, which is at most √3 L). A component of
//! the direction is rounded by u d, and so the coordinate of the point at t by u t d. How far the hit is from the origin along
//! that axis, t d, is at most 2 L. Together that moves the point by 3.13 u L, and t by 3.13 u L / d.
//!
//! **Components near zero.** A component below 2 u D is replaced by that, of the same sign: no reciprocal is infinite, and no
//! product with it NaN. The coordinate of the point at t changes by at most 2 u t D, and t D is at most 2 L: so t moves by 4 u L
//! / d.
//!
//! **The error.** With r for 1 / d, and every operation rounded (a fused multiply-add rounds less),
//!
//! ```text
//! r             a quotient                    is off by at most  u r, and so c r and p r each by u L r
//! c r, p r      a product each                                   u L r each
//! - p r ∓ reach a sum                                            u L r
//! c r + that    a sum                                            2 u L r
//! ```
//!
//! Together 7 u L r, 11 u L r with what was replaced, and 14.13 u L r with what was rounded before. The reach, [`MARGIN`] L r, 16
//! u L r, is subtracted from where the ray meets the near planes and added for the far ones, once a ray. It must not be relative
//! to c - p: in a box's face that is zero. What is left of it, more than u L r, is far more than all terms of the second order,
//! and than what underflows: L counts as at least [`LEAST_COORDINATE`], 2⁻⁶⁰, so that u L r ≥ 2⁻¹⁴⁴ for directions up to 2⁶⁰, and
//! a product that underflows is off by 2⁻¹⁵⁰. Nothing overflows: r ≤ 2⁵⁴ for directions from 2⁻³⁰ on, and L ≤ 2⁶¹.

use glam::{Vec3, Vec4};

use crate::spheres::lanes::{Instructions, LANES};

/// By how much a box may be missed, in L r: 16 u. See the derivation above. Proved in `tests/proofs/boxes.g`.
pub(super) const MARGIN: f32 = 8.0 * f32::EPSILON;

/// The least component of a direction, in the largest one: 2 u.
pub(super) const LEAST_COMPONENT: f32 = f32::EPSILON;

/// What L is taken for if it is less.
pub(super) const LEAST_COORDINATE: f32 = f32::from_bits((127 - 60) << 23); // 2^-60

/// The bit that tells the number of a leaf from that of a node.
pub(super) const LEAF: u32 = 1 << 31;

/// A node: 16 boxes, those of its children.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Boxes {
    /// By axis, the low ones and the high ones.
    planes: [[[f32; LANES]; 2]; 3],
    /// What the first box is if it is a leaf, and what it is if not, so that box n is `leaf + n` or `node + n`.
    leaf: u32,
    node: u32,
    /// How many of the boxes, the first, are leaves.
    leaves: u32,
    /// The region that this is the door of, or [`NO_DOOR`].
    region: u32,
}

/// The region that no node is the door of.
const NO_DOOR: u32 = u32::MAX;

impl Boxes {
    /// No boxes: no ray enters one.
    pub(super) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
        leaf: 0,
        node: 0,
        leaves: 0,
        region: NO_DOOR,
    };

    /// The door of a region: a node of the tree around it, without boxes, in the place of those in the region.
    pub(super) fn door(region: u32) -> Self {
        Self { region, ..Self::EMPTY }
    }

    /// The region that this is the door of.
    #[inline(always)]
    pub(super) fn region(&self) -> Option<u32> {
        (self.region != NO_DOOR).then_some(self.region)
    }

    /// The first boxes are these leaves, and the others these nodes.
    pub(super) fn set_children(&mut self, leaf: u32, node: u32, leaves: u32) {
        (self.leaf, self.node, self.leaves) = (leaf | LEAF, node.wrapping_sub(leaves), leaves);
    }

    /// What is in a box.
    #[inline(always)]
    pub(super) fn child(&self, lane: u32) -> u32 {
        lane.wrapping_add(if lane < self.leaves { self.leaf } else { self.node })
    }

    /// Puts a box into a lane.
    pub(super) fn set(&mut self, lane: usize, (low, high): (Vec3, Vec3)) {
        for (axis, [lows, highs]) in self.planes.iter_mut().enumerate() {
            (lows[lane], highs[lane]) = (low[axis], high[axis]);
        }
    }

    /// The low and the high planes, by axis.
    #[inline(always)]
    pub(super) fn planes(&self) -> &[[[f32; LANES]; 2]; 3] {
        &self.planes
    }

    /// The box of a lane.
    pub(super) fn bounds_of(&self, lane: usize) -> (Vec3, Vec3) {
        let low = self.planes.map(|[low, _]| low[lane]);
        (low.into(), self.planes.map(|[_, high]| high[lane]).into())
    }

    /// The box around all of them.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        let low = self.planes.map(|[low, _]| low.into_iter().fold(f32::INFINITY, f32::min));
        let high = self.planes.map(|[_, high]| high.into_iter().fold(f32::NEG_INFINITY, f32::max));
        (low.into(), high.into())
    }

    /// The boxes through which the ray passes from a start to an end, a bit for each, and where it enters them, or else the
    /// start.
    #[inline(always)]
    pub(super) fn entered<I: Instructions>(
        &self,
        instructions: I,
        slabs: &Slabs,
        [start, end]: [f32; 2],
        entries: &mut [f32; LANES],
    ) -> u32 {
        let Slabs { reciprocal, near, far, is_negative } = *slabs;
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let is_negative = usize::from(is_negative[axis]);
            (&self.planes[axis][is_negative], &self.planes[axis][1 - is_negative])
        });
        // Comparisons that are one instruction each: `f32::max` looks for NaN.
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let mut lengths = [0.0; LANES];
        for lane in 0..LANES {
            let at = |planes: &[f32; LANES], axis: usize, offset: Vec4| {
                instructions.multiply_add(planes[lane], reciprocal[axis], offset[axis])
            };
            let enter =
                larger(larger(at(x.0, 0, near), at(y.0, 1, near)), larger(at(z.0, 2, near), start));
            let leave =
                smaller(smaller(at(x.1, 0, far), at(y.1, 1, far)), smaller(at(z.1, 2, far), end));
            entries[lane] = enter;
            lengths[lane] = leave - enter;
        }
        !instructions.signs(&lengths) & 0xFFFF
    }
}

/// What the boxes are tested with: a ray.
///
/// In vectors of four: the loop over the boxes loads single numbers or groups of them, as the compiler likes, and has to wait for
/// a group whose numbers were written one by one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slabs {
    /// Of each component of the direction.
    reciprocal: Vec4,
    /// What is added to a near plane times the reciprocal: where the ray meets it, or earlier.
    near: Vec4,
    /// Likewise of a far plane: where the ray meets it, or later.
    far: Vec4,
    is_negative: [bool; 3],
}

impl Slabs {
    #[inline(always)]
    pub(super) fn new(origin: Vec3, direction: Vec3, largest_coordinate: f32, margin: f32) -> Self {
        // The fourth number is there for the maximum.
        let origin = origin.extend(largest_coordinate);
        let direction = direction.extend(0.0);
        let magnitude = direction.abs();
        let least = Vec4::splat(magnitude.max_element() * LEAST_COMPONENT);
        let reciprocal = magnitude.max(least).recip();
        let reach = origin.abs().max_element() * margin;
        let reciprocal = reciprocal.copysign(direction);
        Self::from_reciprocal(reciprocal, -(origin * reciprocal), reach)
    }

    /// With r, which has the sign of the direction, - p r, and how far a plane may be missed.
    #[inline(always)]
    pub(super) fn from_reciprocal(reciprocal: Vec4, offset: Vec4, reach: f32) -> Self {
        let reach = reciprocal.abs() * reach;
        let mask = reciprocal.is_negative_bitmask();
        Self {
            reciprocal,
            near: offset - reach,
            far: offset + reach,
            is_negative: [mask & 1 != 0, mask & 2 != 0, mask & 4 != 0],
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use sobol_burley::sample;

    use super::*;
    use crate::spheres::lanes::{Lanes, Vectorized};
    use crate::{Hittable, Ray, Sphere};

    struct Enter<'a> {
        boxes: &'a Boxes,
        slabs: Slabs,
        limits: [f32; 2],
    }

    impl Vectorized for Enter<'_> {
        type Output = (u32, [f32; LANES]);

        #[inline(always)]
        fn run<I: Instructions>(self, instructions: I) -> Self::Output {
            let mut entries = [0.0; LANES];
            let entered = self.boxes.entered(instructions, &self.slabs, self.limits, &mut entries);
            (entered, entries)
        }
    }

    /// How many of the boxes of spheres that are hit near a face of the box are dropped with that margin.
    fn dropped(margin: f32, lanes: Lanes, cases: u32) -> u32 {
        const LANE: usize = 5;
        let mut hits = 0;
        let mut dropped = 0;
        for case in 0..cases {
            let random = |dimension| f64::from(sample(case, dimension, 2));
            let vector = |dimension| {
                DVec3::new(random(dimension), random(dimension + 1), random(dimension + 2))
                    - DVec3::splat(0.5)
            };
            let center = (vector(0) * 64.0).as_vec3();
            #[expect(clippy::cast_possible_truncation, reason = "any radius will do")]
            let sphere = Sphere::new(center, (random(3) * random(4) * 8.0) as f32);
            // Through the point where the sphere touches a face, along it or nearly so.
            let axis = case as usize % 3;
            let mut touching = center;
            touching[axis] += if case % 2 == 0 { sphere.radius } else { -sphere.radius };
            let mut direction = vector(5).as_vec3();
            direction[axis] =
                [0.0, -0.0, 1e-30, -1e-9, 1e-7, direction[axis]][case as usize / 6 % 6];
            if case % 5 == 0 {
                direction[(axis + 1) % 3] = 0.0;
            }
            #[expect(clippy::cast_possible_truncation, reason = "any distance will do")]
            let origin = touching - direction * (random(8) * 200.0) as f32;
            let ray = Ray::new(origin, direction);
            let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };

            let mut boxes = Boxes::EMPTY;
            boxes.set(LANE, sphere.bounds());
            let (low, high) = boxes.bounds();
            let largest = low.abs().max(high.abs()).max_element();
            let just_after = f32::from_bits(hit.t.to_bits() + 1);
            let Some([_, exit]) = sphere.roots(&ray) else { continue };
            // The exact t may be less than the one returned.
            let before = |t: f32| f32::from_bits(t.to_bits() - 1);
            for (limits, t) in [
                ([0.0, f32::INFINITY], hit.t),
                ([0.0, just_after], hit.t),
                ([before(hit.t), just_after], hit.t),
                ([before(exit), f32::INFINITY], exit),
            ] {
                hits += 1;
                let slabs = Slabs::new(ray.origin, ray.direction, largest, margin);
                let (entered, entries) = lanes.run(Enter { boxes: &boxes, slabs, limits });
                assert_eq!(entered & !(1 << LANE), 0, "an empty box was entered");
                dropped += u32::from(entered == 0 || entries[LANE] > t);
            }
        }
        assert!(hits > cases / 4, "{hits}");
        dropped
    }

    #[test]
    fn drops_no_box_of_a_sphere_that_is_hit() {
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
