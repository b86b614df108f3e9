//! Which of 16 boxes a ray passes through, and where it enters them.

use glam::{Vec3, Vec4};

use crate::Ray;
use crate::spheres::lanes::{Instructions, LANES};

pub(super) const MARGIN: f32 = 4.0 * f32::EPSILON;

/// The least component of a direction, in the largest one.
const LEAST_COMPONENT: f32 = f32::EPSILON;

/// What the largest coordinate is taken for if it is less.
pub(super) const LEAST_COORDINATE: f32 = f32::from_bits((127 - 60) << 23); // 2^-60

/// A node: 16 boxes, those of its children.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Boxes {
    /// By axis, the low ones and the high ones.
    planes: [[[f32; LANES]; 2]; 3],
}

impl Boxes {
    /// No boxes: no ray enters one.
    pub(super) const EMPTY: Self =
        Self { planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3] };

    /// Puts a box into a lane.
    pub(super) fn set(&mut self, lane: usize, (low, high): (Vec3, Vec3)) {
        for (planes, bounds) in self.planes.iter_mut().zip(low.to_array().into_iter().zip(high.to_array())) {
            planes[0][lane] = bounds.0;
            planes[1][lane] = bounds.1;
        }
    }

    /// The box around all of them.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        let low = self.planes.map(|[low, _]| low.into_iter().fold(f32::INFINITY, f32::min));
        let high = self.planes.map(|[_, high]| high.into_iter().fold(f32::NEG_INFINITY, f32::max));
        (low.into(), high.into())
    }

    /// The boxes through which the ray passes before `end`, a bit for each, and where it enters them.
    #[inline(always)]
    pub(super) fn entered<I: Instructions>(
        &self,
        instructions: I,
        slabs: &Slabs,
        end: f32,
        entries: &mut [f32; LANES],
    ) -> u32 {
        let Slabs { reciprocal, near, far, is_negative } = *slabs;
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let is_negative = usize::from(is_negative[axis]);
            (&self.planes[axis][is_negative], &self.planes[axis][1 - is_negative])
        });
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let mut lengths = [0.0; LANES];
        for lane in 0..LANES {
            let at = |planes: &[f32; LANES], axis: usize, offset: Vec4| {
                instructions.multiply_add(planes[lane], reciprocal[axis], offset[axis])
            };
            let enter = larger(
                larger(at(x.0, 0, near), at(y.0, 1, near)),
                larger(at(z.0, 2, near), 0.0),
            );
            let leave = smaller(
                smaller(at(x.1, 0, far), at(y.1, 1, far)),
                smaller(at(z.1, 2, far), end),
            );
            entries[lane] = enter;
            lengths[lane] = leave - enter;
        }
        !instructions.signs(&lengths) & 0xFFFF
    }
}

/// What the boxes are tested with: a ray.
///
/// As vectors of four: the filters' loops load the numbers one by one, which would have to wait if they were written in other
/// groups than the compiler happens to load.
#[derive(Clone, Copy, Debug)]
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
    pub(super) fn new(ray: &Ray, largest_coordinate: f32, margin: f32) -> Self {
        let origin = ray.origin.extend(largest_coordinate);
        // The last number, 1, is not used.
        let direction = ray.direction.extend(0.0);
        let magnitude = direction.abs();
        let least = Vec4::splat(magnitude.max_element() * LEAST_COMPONENT);
        let reciprocal = magnitude.max(least).recip();
        let reach = reciprocal * (origin.abs().max_element() * margin);
        let reciprocal = reciprocal.copysign(direction);
        let offset = origin * reciprocal;
        let mask = direction.is_negative_bitmask();
        Self {
            reciprocal,
            near: -offset - reach,
            far: reach - offset,
            is_negative: [mask & 1 != 0, mask & 2 != 0, mask & 4 != 0],
        }
    }
}
