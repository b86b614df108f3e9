//! The way of a ray through the hierarchy: the nearest box first, and none that begins beyond the nearest hit so far.

use core::ops::Range;

use arrayvec::ArrayVec;

use super::boxes::{self, Boxes, Slabs};
use super::leaf::{Leaf, NONE, Tube};
use super::split::DEEPEST;
use super::{LEAF, Tree};
use crate::float::sqrt;
use crate::spheres::filter::Segment;
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::{Hit, Hittable, Ray, Sphere};

/// How much waits to be visited at most: of each node on the way to a leaf, all children but one.
pub(super) const MOST_WAITING: usize = DEEPEST * (LANES - 1);

/// A node or a leaf that waits, and where the ray enters its box: the bits of that distance, which is not negative, are above
/// those of what it is. So the nearer has the lower key.
pub(super) type Key = u64;

#[inline(always)]
pub(super) fn key(entry: f32, child: u32) -> Key {
    u64::from(entry.to_bits()) << 32 | u64::from(child)
}

/// Where the ray enters the box.
#[inline(always)]
pub(super) fn entry(key: Key) -> f32 {
    f32::from_bits((key >> 32) as u32)
}

/// What it is.
#[inline(always)]
pub(super) fn child(key: Key) -> u32 {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    let child = key as u32;
    child
}

/// The float after one that is positive and finite.
#[inline(always)]
pub(super) fn above(t: f32) -> f32 {
    f32::from_bits(t.to_bits() + 1)
}

/// Numbers of 16 boxes or spheres, where one instruction can write them.
#[derive(Default)]
#[repr(align(64))]
struct Numbers([f32; LANES]);

/// A ray on its way.
struct Query {
    slabs: Slabs,
    tube: Tube,
    /// The end of the range, or that of what is nearer than the nearest hit so far.
    end: f32,
    /// Where the ray enters the boxes of the last node; of the spheres of the last leaf, where it is nearest to the center.
    entries: Numbers,
    /// By how much the ray is clear of the spheres of the last leaf, as a difference of squares.
    clearances: Numbers,
}

impl Query {
    /// Of these spheres of the last leaf, the one that the ray probably enters first.
    #[inline(never)]
    fn first_of(&self, mut near: u32, length: f32) -> usize {
        let mut first = near.trailing_zeros() as usize % LANES;
        let mut least = f32::INFINITY;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % LANES;
            near &= near - 1;
            // How far the closest approach is, less the half-chord.
            #[expect(clippy::cast_possible_truncation, reason = "it is that of an f32")]
            let half_chord = sqrt(f64::from(-self.clearances.0[lane])) as f32;
            let entry = self.entries.0[lane] * length - half_chord;
            if entry < least {
                (first, least) = (lane, entry);
            }
        }
        first
    }
}

/// Asks which boxes of a node the ray enters. These two, and the exact routine, do not share a function: the compiler would save
/// and restore the vectors. Two references are passed in registers.
struct Enter<'a> {
    node: &'a Boxes,
    query: &'a mut Query,
}

impl Vectorized for Enter<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        let Query { slabs, end, entries, .. } = self.query;
        self.node.entered(instructions, slabs, *end, &mut entries.0)
    }
}

/// Asks which spheres of a leaf the ray may meet.
struct Near<'a> {
    leaf: &'a Leaf,
    query: &'a mut Query,
}

impl Vectorized for Near<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        let Query { tube, end, entries, clearances, .. } = self.query;
        self.leaf.near(instructions, tube, *end, &mut entries.0, &mut clearances.0)
    }
}

impl Tree {
    /// Calls `ask` for every sphere in the leaves that the ray may meet before `end`, and perhaps for others, the nearest boxes
    /// first. What it returns is the new end; a negative one ends the walk.
    #[inline(always)]
    fn walk(
        &self,
        lanes: Lanes,
        ray: &Ray,
        end: f32,
        mut ask: impl FnMut(u32, &Sphere, f32) -> Option<f32>,
    ) {
        let mut query = Query {
            slabs: Slabs::new(ray, self.largest_coordinate, boxes::MARGIN),
            tube: Tube::new(ray),
            end,
            entries: Numbers::default(),
            clearances: Numbers::default(),
        };
        // Not cleared first: that would take as long as some visits.
        let mut waiting = ArrayVec::<Key, MOST_WAITING>::new();
        let mut next = key(0.0, self.root);
        loop {
            let place = child(next);
            if place & LEAF != 0 {
                let Some(leaf) = self.leaves.get((place & !LEAF) as usize) else { return };
                let mut near = lanes.run(Near { leaf, query: &mut query });
                while near != 0 {
                    let lane = if near.is_power_of_two() {
                        near.trailing_zeros() as usize % LANES
                    } else {
                        query.first_of(near, ray.direction.length())
                    };
                    near &= !(1 << lane);
                    if leaf.index(lane) == NONE {
                        continue;
                    }
                    if let Some(end) = ask(leaf.index(lane), &leaf.sphere(lane), query.end) {
                        if end < 0.0 {
                            return;
                        }
                        query.end = end;
                        if near != 0 {
                            // Most of the others are beyond that.
                            near &= lanes.run(Near { leaf, query: &mut query });
                        }
                    }
                }
            } else {
                let Some(node) = self.nodes.get(place as usize) else { return };
                let mut entered = lanes.run(Enter { node, query: &mut query });
                if entered != 0 {
                    let entries = &query.entries.0;
                    let mut take = || {
                        let lane = entered.trailing_zeros();
                        entered &= entered - 1;
                        (key(entries[lane as usize % LANES], node.child(lane)), entered != 0)
                    };
                    // The nearest is next, and of those that wait the second is taken first; the others as they come.
                    let (first, mut are_more) = take();
                    next = first;
                    if are_more {
                        let mut second = Key::MAX;
                        while are_more {
                            let child;
                            (child, are_more) = take();
                            let farther = next.max(child);
                            next = next.min(child);
                            let third = second.max(farther);
                            second = second.min(farther);
                            if third != Key::MAX {
                                // There is room for all.
                                let _ = waiting.try_push(third);
                            }
                        }
                        let _ = waiting.try_push(second);
                    }
                    continue;
                }
            }
            loop {
                let Some(key) = waiting.pop() else { return };
                if entry(key) <= query.end {
                    next = key;
                    break;
                }
            }
        }
    }

    /// Which sphere the ray meets first, and where: of equal `t`, the lowest index.
    pub(super) fn nearest(
        &self,
        lanes: Lanes,
        ray: &Ray,
        range: Range<f32>,
    ) -> Option<(usize, Hit)> {
        if !Segment::allows(ray) {
            return self.nearest_of_all(ray, range);
        }
        let Range { start, end } = range;
        let mut nearest = None;
        self.walk(lanes, ray, end, |index, sphere, end| {
            let hit = sphere.intersect(ray, start..end)?;
            is_nearer((index, hit), nearest).then(|| {
                nearest = Some((index, hit));
                // Equal distances too: they may be those of a lower index.
                above(hit.t)
            })
        });
        if !self.apart.is_empty() {
            let end = nearest.map_or(end, |(_, hit)| above(hit.t));
            if let Some((place, hit)) = self.apart.nearest_in_lanes(lanes, ray, start..end) {
                let found = (*self.apart_indices.get(place)?, hit);
                if is_nearer(found, nearest) {
                    nearest = Some(found);
                }
            }
        }
        let (index, hit) = nearest?;
        Some((index as usize, hit))
    }

    /// Whether any sphere is hit.
    pub(super) fn occludes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        if !Segment::allows(ray) {
            return self.nearest_of_all(ray, range).is_some();
        }
        if !self.apart.is_empty() && self.apart.occludes_in_lanes(lanes, ray, range.clone()) {
            return true;
        }
        let mut occludes = false;
        self.walk(lanes, ray, range.end, |_, sphere, _| {
            occludes = sphere.occludes(ray, range.clone());
            occludes.then_some(-1.0)
        });
        occludes
    }

    /// The nearest of all spheres, each asked exactly, for a ray that the filters cannot compute with.
    #[cold]
    fn nearest_of_all(&self, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        let Ray { origin, direction } = *ray;
        if !(origin.is_finite() && direction.is_finite()) {
            return None;
        }
        let Range { start, mut end } = range;
        let mut nearest = None;
        for (index, &place) in self.places.iter().enumerate() {
            let hit = self.at_place(place).and_then(|sphere| sphere.intersect(ray, start..end));
            if let Some(hit) = hit {
                end = hit.t;
                nearest = Some((index, hit));
            }
        }
        nearest
    }
}

/// Whether a hit comes before the nearest so far.
#[inline(always)]
pub(super) fn is_nearer((index, hit): (u32, Hit), nearest: Option<(u32, Hit)>) -> bool {
    nearest.is_none_or(|(lowest, nearest)| (hit.t, index) < (nearest.t, lowest))
}
