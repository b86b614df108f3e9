//! Many spheres: filter in many lanes, then ask those that are left exactly.

mod filter;
mod lanes;

use alloc::vec::Vec;
use core::ops::Range;

use filter::{Block, LANES, MARGIN, Segment};
use lanes::Vectorized;

#[doc(hidden)]
pub use lanes::Lanes;

use crate::{Hit, Hittable, Ray, Sphere, nearest};

/// Up to how many spheres are asked one by one.
const FEW: usize = 4;
const CHUNK: usize = 8;

/// Many spheres.
#[derive(Clone, Debug, Default)]
pub struct Spheres {
    spheres: Vec<Sphere>,
    /// The same spheres, 32 to a block, as the filter needs them; what is left of the last block is empty.
    blocks: Vec<Block>,
}

impl Spheres {
    /// None yet.
    #[inline]
    pub const fn new() -> Self {
        Self { spheres: Vec::new(), blocks: Vec::new() }
    }

    /// None yet, but room for that many.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            spheres: Vec::with_capacity(capacity),
            blocks: Vec::with_capacity(capacity.div_ceil(LANES)),
        }
    }

    /// Adds a sphere: its index is the number of those before it. Any value is allowed.
    pub fn push(&mut self, sphere: Sphere) {
        let lane = self.spheres.len() % LANES;
        if lane == 0 {
            self.blocks.push(Block::EMPTY);
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(lane, &sphere, MARGIN);
        }
        self.spheres.push(sphere);
    }

    /// Removes all.
    pub fn clear(&mut self) {
        self.spheres.clear();
        self.blocks.clear();
    }

    /// How many there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// Whether there are none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// The sphere of that index, as it was given.
    #[inline]
    pub fn get(&self, index: usize) -> Option<Sphere> {
        self.spheres.get(index).copied()
    }

    /// The spheres in order.
    #[inline]
    pub fn iter(&self) -> core::iter::Copied<core::slice::Iter<'_, Sphere>> {
        self.spheres.iter().copied()
    }

    /// Which sphere the ray meets first with `t` in `range`, and where: of equal `t`, the lowest index.
    #[inline]
    pub fn nearest(&self, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        if self.len() <= FEW {
            return nearest(&self.spheres, ray, range);
        }
        self.nearest_in_lanes(Lanes::best(), ray, range)
    }

    #[doc(hidden)]
    #[inline]
    pub fn nearest_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray,
        range: Range<f32>,
    ) -> Option<(usize, Hit)> {
        if is_empty(&range) {
            return None;
        }
        match Segment::new(ray, MARGIN) {
            Some(segment) => lanes.run(Nearest { spheres: self, ray, segment, range }),
            None => nearest(&self.spheres, ray, range),
        }
    }

    #[doc(hidden)]
    #[inline]
    pub fn occludes_in_lanes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        if is_empty(&range) {
            return false;
        }
        match Segment::new(ray, MARGIN) {
            Some(segment) => lanes.run(Occludes { spheres: self, ray, segment, range }),
            None => self.spheres.occludes(ray, range),
        }
    }
}

/// Whether no positive number is in the range; also where an end is NaN.
#[inline(always)]
fn is_empty(range: &Range<f32>) -> bool {
    !(range.end > 0.0 && range.start < range.end)
}

struct Nearest<'a> {
    spheres: &'a Spheres,
    ray: &'a Ray,
    segment: Segment,
    range: Range<f32>,
}

impl Vectorized for Nearest<'_> {
    type Output = Option<(usize, Hit)>;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Option<(usize, Hit)> {
        let Self { spheres, ray, segment, mut range } = self;
        let mut found = None;
        for (chunk, blocks) in spheres.blocks.chunks(CHUNK).enumerate() {
            let mut touched = [0; CHUNK];
            for (touched, block) in touched.iter_mut().zip(blocks) {
                *touched = block.touched::<FUSED>(&segment, range.end);
            }
            for (block, touched) in touched.iter().enumerate().take(blocks.len()) {
                let mut touched = *touched;
                while touched != 0 {
                    let index = (chunk * CHUNK + block) * LANES + touched.trailing_zeros() as usize;
                    touched &= touched - 1;
                    if let Some(hit) = spheres.spheres[index].intersect(ray, range.clone()) {
                        range.end = hit.t;
                        found = Some((index, hit));
                    }
                }
            }
        }
        found
    }
}

struct Occludes<'a> {
    spheres: &'a Spheres,
    ray: &'a Ray,
    segment: Segment,
    range: Range<f32>,
}

impl Vectorized for Occludes<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> bool {
        let Self { spheres, ray, segment, range } = self;
        for (index, block) in spheres.blocks.iter().enumerate() {
            let mut touched = block.touched::<FUSED>(&segment, range.end);
            while touched != 0 {
                let index = index * LANES + touched.trailing_zeros() as usize;
                touched &= touched - 1;
                if spheres.spheres[index].occludes(ray, range.clone()) {
                    return true;
                }
            }
        }
        false
    }
}

impl Hittable for Spheres {
    #[inline]
    fn intersect(&self, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        self.nearest(ray, range).map(|(_, hit)| hit)
    }

    #[inline]
    fn occludes(&self, ray: &Ray, range: Range<f32>) -> bool {
        if self.len() <= FEW {
            return self.spheres.occludes(ray, range);
        }
        self.occludes_in_lanes(Lanes::best(), ray, range)
    }
}

impl FromIterator<Sphere> for Spheres {
    fn from_iter<I: IntoIterator<Item = Sphere>>(iter: I) -> Self {
        let mut spheres = Self::new();
        spheres.extend(iter);
        spheres
    }
}

impl Extend<Sphere> for Spheres {
    fn extend<I: IntoIterator<Item = Sphere>>(&mut self, iter: I) {
        for sphere in iter {
            self.push(sphere);
        }
    }
}
