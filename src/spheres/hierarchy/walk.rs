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

/// Where the ray enters the boxes of a node. Two references, so that both are passed in registers.
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

#[repr(align(64))]
struct Entries([f32; LANES]);

/// A ray on its way.
struct Query {
    slabs: Slabs,
    tube: Tube,
    /// The end of the range, or of the nearest hit so far.
    end: f32,
    entries: Entries,
    clearances: Entries,
    one_over_length: f64,
}

impl Query {
    #[inline(never)]
    fn first_of(&self, mut near: u32) -> usize {
        let mut first = near.trailing_zeros() as usize % LANES;
        let mut least = f64::INFINITY;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % LANES;
            near &= near - 1;
            let half_chord = crate::float::sqrt(f64::from(-self.clearances.0[lane])) * self.one_over_length;
            let entry = f64::from(self.entries.0[lane]) - half_chord;
            if entry < least {
                (first, least) = (lane, entry);
            }
        }
        first
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
        end: f32,
        mut ask: impl FnMut(u32, &Sphere, f32) -> Option<f32>,
    ) {
        if self.leaves.is_empty() {
            return;
        }
        let mut query = Query {
            slabs: Slabs::new(ray, self.largest_coordinate, boxes::MARGIN),
            tube: Tube::new(ray, leaf::RADIUS_MARGIN, leaf::DISTANCE_MARGIN),
            end,
            entries: Entries([0.0; LANES]),
            clearances: Entries([0.0; LANES]),
            one_over_length: 1.0 / f64::from(ray.direction.length()),
        };
        let mut waiting = ArrayVec::<Key, MOST_WAITING>::new();
        let mut next = key(0.0, self.top << PLACE_BITS);
        loop {
            #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
            let place = next as u32;
            let level = place >> PLACE_BITS;
            let in_level = place & ((1 << PLACE_BITS) - 1);
            if level == 0 {
                let Some(leaf) = self.leaves.get(in_level as usize) else { return };
                let mut near = lanes.run(Near { leaf, query: &mut query });
                while near != 0 {
                    let lane = if near & (near - 1) == 0 {
                        near.trailing_zeros() as usize % LANES
                    } else {
                        query.first_of(near)
                    };
                    near &= !(1 << lane);
                    if let Some(nearer) = ask(leaf.index(lane), &leaf.sphere(lane), query.end) {
                        if nearer < 0.0 {
                            return;
                        }
                        query.end = nearer;
                        if near != 0 {
                            near &= lanes.run(Near { leaf, query: &mut query });
                        }
                    }
                }
            } else {
                let node = self.first[level as usize % LEVELS] + in_level;
                let Some(node) = self.nodes.get(node as usize) else { return };
                let mut entered = lanes.run(Enter { node, query: &mut query });
                if entered != 0 {
                    let child = (level - 1) << PLACE_BITS | in_level * 16;
                    let mut nearest = Key::MAX;
                    loop {
                        let lane = entered.trailing_zeros();
                        entered &= entered - 1;
                        let other = key(query.entries.0[lane as usize % LANES], child + lane);
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
                if entry(key) <= query.end {
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
