//! The way of a ray through the hierarchy, the nearest boxes first.

use core::ops::Range;

use arrayvec::ArrayVec;

use super::boxes::{self, Boxes, Slabs};
use super::leaf::{self, Leaf, Tube};
use super::{LEVELS, Tree};
use crate::hittable::nearest_among;
use crate::spheres::filter::Segment;
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::{Hit, Hittable, Ray, Sphere};

/// What waits to be visited: of every level above the leaves all children of a node but one, at most.
const MOST_WAITING: usize = (LEVELS - 1) * (LANES - 1);

/// A node or a leaf, and where the ray enters its box: the bits of the distance, which is not negative, are above those of the
/// level and of the place in it. So the nearer is the smaller.
type Key = u64;

const PLACE_BITS: u32 = 28;

#[inline(always)]
fn key(entry: f32, place: u32) -> Key {
    u64::from(entry.to_bits()) << 32 | u64::from(place)
}

#[inline(always)]
fn entry(key: Key) -> f32 {
    f32::from_bits((key >> 32) as u32)
}

struct Enter<'a> {
    node: &'a Boxes,
    slabs: &'a Slabs,
    end: f32,
}

impl Vectorized for Enter<'_> {
    type Output = (u32, [f32; LANES]);

    #[inline(always)]
    fn run<I: Instructions>(&self, instructions: I) -> (u32, [f32; LANES]) {
        let mut entries = [0.0; LANES];
        let entered = self.node.entered(instructions, self.slabs, self.end, &mut entries);
        (entered, entries)
    }
}

struct Near<'a> {
    leaf: &'a Leaf,
    tube: &'a Tube,
    end: f32,
}

impl Vectorized for Near<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(&self, instructions: I) -> u32 {
        self.leaf.near(instructions, self.tube, self.end)
    }
}

/// The float after one that is positive and finite.
#[inline(always)]
fn next_up(t: f32) -> f32 {
    f32::from_bits(t.to_bits() + 1)
}

impl Tree {
    #[inline(always)]
    fn walk(
        &self,
        lanes: Lanes,
        ray: &Ray,
        mut end: f32,
        mut ask: impl FnMut(u32, &Sphere, f32) -> Option<f32>,
    ) {
        if self.leaves.is_empty() {
            return;
        }
        let slabs = Slabs::new(ray, self.largest_coordinate, boxes::MARGIN);
        let tube = Tube::new(ray, leaf::RADIUS_MARGIN, leaf::DISTANCE_MARGIN);
        let mut waiting = ArrayVec::<Key, MOST_WAITING>::new();
        let mut next = key(0.0, self.top << PLACE_BITS);
        loop {
            #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
            let place = next as u32;
            let level = place >> PLACE_BITS;
            let in_level = place & ((1 << PLACE_BITS) - 1);
            if level == 0 {
                let Some(leaf) = self.leaves.get(in_level as usize) else { return };
                let mut near = lanes.run(&Near { leaf, tube: &tube, end });
                while near != 0 {
                    let lane = near.trailing_zeros() as usize % LANES;
                    near &= near - 1;
                    if let Some(nearer) = ask(leaf.index(lane), &leaf.sphere(lane), end) {
                        end = nearer;
                    }
                }
            } else {
                let node = self.first[level as usize % LEVELS] + in_level;
                let Some(node) = self.nodes.get(node as usize) else { return };
                let (mut entered, entries) = lanes.run(&Enter { node, slabs: &slabs, end });
                if entered != 0 {
                    let child = (level - 1) << PLACE_BITS | in_level * 16;
                    let mut nearest = Key::MAX;
                    loop {
                        let lane = entered.trailing_zeros();
                        entered &= entered - 1;
                        let other = key(entries[lane as usize % LANES], child + lane);
                        let farther = nearest.max(other);
                        nearest = nearest.min(other);
                        if farther != Key::MAX {
                            let _ = waiting.try_push(farther);
                        }
                        if entered == 0 {
                            break;
                        }
                    }
                    next = nearest;
                    continue;
                }
            }
            loop {
                let Some(key) = waiting.pop() else { return };
                if entry(key) <= end {
                    next = key;
                    break;
                }
            }
        }
    }

    pub(super) fn nearest(
        &self,
        lanes: Lanes,
        ray: &Ray,
        range: Range<f32>,
    ) -> Option<(usize, Hit)> {
        if !Segment::allows(ray) {
            return self.nearest_of_all(ray, range);
        }
        let Range { start, mut end } = range;
        let mut found: Option<(u32, Hit)> = None;
        self.walk(lanes, ray, end, |index, sphere, end| {
            let hit = sphere.intersect(ray, start..end)?;
            if found.is_none_or(|(lowest, nearest)| (hit.t, index) < (nearest.t, lowest)) {
                found = Some((index, hit));
                // An equal distance may be that of a lower index.
                return Some(next_up(hit.t));
            }
            None
        });
        if let Some((_, hit)) = found {
            end = next_up(hit.t);
        }
        if !self.apart.is_empty() {
            if let Some((place, hit)) = self.apart.nearest_in_lanes(lanes, ray, start..end) {
                let index = self.apart_indices[place];
                if found.is_none_or(|(lowest, nearest)| (hit.t, index) < (nearest.t, lowest)) {
                    found = Some((index, hit));
                }
            }
        }
        let (index, hit) = found?;
        Some((index as usize, hit))
    }

    pub(super) fn occludes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        if !Segment::allows(ray) {
            return self.nearest_of_all(ray, range).is_some();
        }
        if self.apart.occludes_in_lanes(lanes, ray, range.clone()) {
            return true;
        }
        let mut occludes = false;
        self.walk(lanes, ray, range.end, |_, sphere, _| {
            sphere.occludes(ray, range.clone()).then(|| {
                occludes = true;
                f32::NEG_INFINITY
            })
        });
        occludes
    }

    /// Asks every sphere.
    #[cold]
    fn nearest_of_all(&self, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        let spheres: alloc::vec::Vec<Sphere> =
            self.places.iter().filter_map(|&place| self.at_place(place)).collect();
        let mut objects = spheres.iter().enumerate();
        nearest_among(ray, range, |_| objects.next())
    }
}
