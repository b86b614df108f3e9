//! The way of a ray through the hierarchy: the nearest box first, and none that begins beyond the nearest hit so far.
//!
//! A region inside of another ([`region`](super::region)) is walked through before what waits outside. On the way, `t` counts
//! from where the ray begins anew for the region: entries and the end that they are compared with.

use core::ops::Range;

use arrayvec::ArrayVec;

use super::boxes::{Boxes, LEAF};
use super::leaf::{Leaf, NONE};
use super::number::number;
use super::region::{Region, Way};
use super::split::{DEEPEST, MOST_NESTED};
use super::tree::Tree;
use super::visits::{self, Visit};
use crate::float::sqrt;
use crate::order::{is_nearer, next_above};
use crate::spheres::filter::{LARGEST, Segment};
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::spheres::local::{local_end, local_start, narrow, to_f32};
use crate::{Hit, Hittable, Ray, Scalar, Sphere, Vector};

/// How much waits to be visited at most: of each node on the way to a leaf, all children but one, and of each region the way out.
pub(super) const MOST_WAITING: usize = DEEPEST * (LANES - 1) + MOST_NESTED;

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

/// Numbers of 16 boxes or spheres, where one instruction can write them.
#[derive(Clone, Default)]
#[repr(align(64))]
pub(super) struct Numbers(pub(super) [f32; LANES]);

/// A ray on its way.
#[derive(Clone, Default)]
pub(super) struct Query<S> {
    /// Through the region that it is in.
    pub(super) way: Way<S>,
    /// The start of the range, or 0, as it is on that way.
    start: f32,
    /// The end of the range, or that of what is nearer than the nearest hit so far, as it is on that way.
    end: f32,
    /// Where the ray enters the boxes of the last node; of the spheres of the last leaf, where it is nearest to the center.
    entries: Numbers,
    /// By how much the ray is clear of the spheres of the last leaf, as a difference of squares.
    clearances: Numbers,
}

/// Where a range starts for a ray that begins anew at `moved`, which hits nothing before that.
#[inline(always)]
fn first_start<V: Vector>(start: V::Scalar, moved: f64) -> f32 {
    let start = local_start::<V>(start, moved);
    if start > 0.0 { start } else { 0.0 }
}

impl<S: Scalar> Query<S> {
    /// Goes into a region. Returns whether the ray may enter one of its boxes before `end`.
    // A call: inlined into the walk, it would be prepared for in each query.
    #[inline(never)]
    pub(super) fn enter<V: Vector<Scalar = S>>(
        &mut self,
        region: &Region<V>,
        ray: &Ray<V>,
        range: Range<S>,
    ) -> bool {
        self.way = if region.is_near(ray) {
            region.way(ray)
        } else {
            let Some(way) = region.way_from_afar(ray, range.end) else { return false };
            way
        };
        self.set_range::<V>(range);
        true
    }

    /// Goes back into a region.
    pub(super) fn enter_again<V: Vector<Scalar = S>>(
        &mut self,
        region: &Region<V>,
        ray: &Ray<V>,
        range: Range<S>,
    ) {
        self.enter(region, ray, range.start..S::INFINITY);
        self.set_range::<V>(range);
    }

    #[inline(always)]
    fn set_range<V: Vector<Scalar = S>>(&mut self, Range { start, end }: Range<S>) {
        self.start = first_start::<V>(start, self.way.moved);
        self.set_end(end);
    }

    #[inline(always)]
    fn set_end(&mut self, end: S) {
        self.end = local_end(end, self.way.moved);
    }

    /// Where the ray enters a box of the last node.
    #[inline(always)]
    pub(super) fn entry(&self, lane: u32) -> f32 {
        self.entries.0[lane as usize % LANES]
    }

    /// Which spheres of a leaf the ray may meet.
    #[inline(always)]
    pub(super) fn near(&mut self, lanes: Lanes, leaf: &Leaf<S>) -> u32 {
        // As bits, that is one comparison with memory: a float may be NaN.
        if self.way.moved.to_bits() == 0 {
            lanes.run(Near::<S, false> { leaf, query: self })
        } else {
            lanes.run(Near::<S, true> { leaf, query: self })
        }
    }

    /// Of these spheres of the last leaf, the one that the ray probably enters first.
    #[inline(never)]
    fn first_of(&self, mut near: u32) -> usize {
        let length = self.way.tube.length();
        let mut first = near.trailing_zeros() as usize % LANES;
        let mut least = f32::INFINITY;
        while near != 0 {
            let lane = near.trailing_zeros() as usize % LANES;
            near &= near - 1;
            // How far the closest approach is, less the half-chord.
            let half_chord = to_f32(sqrt(f64::from(-self.clearances.0[lane])));
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
pub(super) struct Enter<'a, S> {
    pub(super) node: &'a Boxes,
    pub(super) query: &'a mut Query<S>,
}

impl<S: Scalar> Vectorized for Enter<'_, S> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        let Query { way, start, end, entries, .. } = self.query;
        self.node.entered(instructions, &way.slabs, [*start, *end], &mut entries.0)
    }
}

/// Asks which spheres of a leaf the ray may meet, which begins anew or not.
struct Near<'a, S, const MOVED: bool> {
    leaf: &'a Leaf<S>,
    query: &'a mut Query<S>,
}

impl<S: Scalar, const MOVED: bool> Vectorized for Near<'_, S, MOVED> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        let Query { way: Way { tube, .. }, start, end, entries, clearances } = self.query;
        let (closest, clearances) = (&mut entries.0, &mut clearances.0);
        let limits = [*start, *end];
        if MOVED {
            self.leaf.near_moved(instructions, tube, limits, closest, clearances)
        } else {
            self.leaf.near(instructions, tube, limits, closest, clearances)
        }
    }
}

impl<V: Vector> Tree<V> {
    /// Calls `ask` for every sphere in the leaves that the ray may meet in the range, and perhaps for others, the nearest boxes
    /// first. What it returns is the new end; a negative one ends the walk.
    #[inline(always)]
    fn walk(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        Range { start, mut end }: Range<V::Scalar>,
        mut ask: impl FnMut(u32, &Sphere<V>, V::Scalar) -> Option<V::Scalar>,
    ) {
        // A NaN is no end of a range, and would open the boxes of no child.
        let is_range = end > V::Scalar::ZERO;
        let Some(whole) = self.regions.first().filter(|_| is_range) else { return };
        let is_near = whole.is_near(ray);
        // In either case, and in its place: to copy what was just written takes as long as a visit.
        let mut query = Query {
            way: whole.way(ray),
            start: first_start::<V>(start, 0.0),
            end: local_end(end, 0.0),
            entries: Numbers::default(),
            clearances: Numbers::default(),
        };
        if !is_near && !query.enter(whole, ray, start..end) {
            return;
        }
        // Not cleared first: that would take as long as some visits.
        let mut waiting = ArrayVec::<Key, MOST_WAITING>::new();
        // Numbers behind those of all nodes are regions that the walk goes back to.
        let outside = number(self.nodes.len());
        let mut region = 0;
        let mut next = key(0.0, whole.root);
        loop {
            let place = child(next);
            if place & LEAF != 0 {
                let Some(leaf) = self.leaves.get((place & !LEAF) as usize) else { return };
                visits::count(Visit::Leaf);
                let mut near = query.near(lanes, leaf);
                while near != 0 {
                    let lane = if near.is_power_of_two() {
                        near.trailing_zeros() as usize % LANES
                    } else {
                        query.first_of(near)
                    };
                    near &= !(1 << lane);
                    if leaf.index(lane) == NONE {
                        continue;
                    }
                    visits::count(Visit::Sphere);
                    if let Some(nearer) = ask(leaf.index(lane), &leaf.sphere(lane), end) {
                        if nearer < V::Scalar::ZERO {
                            return;
                        }
                        end = nearer;
                        query.set_end(end);
                        if near != 0 {
                            // Most of the others are beyond that.
                            near &= query.near(lanes, leaf);
                        }
                    }
                }
            } else if let Some(node) = self.nodes.get(place as usize) {
                visits::count(Visit::Node);
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
                // No box is entered, or the node is the door of a region.
                if let Some(inner) = node.region() {
                    let Some(inside) = self.regions.get(inner as usize) else { return };
                    if query.enter(inside, ray, start..end) {
                        if !waiting.is_empty() {
                            // There is room for it.
                            let _ = waiting.try_push(key(0.0, outside + region));
                        }
                        region = inner;
                        next = key(0.0, inside.root);
                        continue;
                    }
                }
            } else {
                region = place - outside;
                let Some(back) = self.regions.get(region as usize) else { return };
                query.enter_again(back, ray, start..end);
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
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        if !allows(ray) {
            return self.nearest_of_all(ray, range);
        }
        let Range { start, end } = range;
        let mut nearest = None;
        self.walk(lanes, ray, start..end, |index, sphere, end| {
            let hit = sphere.intersect(ray, start..end)?;
            self.is_nearer(ray, (index, hit.t), t_of(nearest)).then(|| {
                nearest = Some((index, hit));
                // Equal distances too: they may be those of a lower index.
                next_above::<V>(hit.t)
            })
        });
        if !self.apart.is_empty() {
            let end = nearest.map_or(end, |(_, hit)| next_above::<V>(hit.t));
            if let Some((place, hit)) = self.apart.nearest_in_lanes(lanes, ray, start..end) {
                let found = (*self.apart_indices.get(place)?, hit);
                if self.is_nearer(ray, (found.0, found.1.t), t_of(nearest)) {
                    nearest = Some(found);
                }
            }
        }
        let (index, hit) = nearest?;
        Some((index as usize, hit))
    }

    /// Whether any sphere is hit.
    pub(super) fn occludes(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        if !allows(ray) {
            return self.nearest_of_all(ray, range).is_some();
        }
        if !self.apart.is_empty() && self.apart.occludes_in_lanes(lanes, ray, range.clone()) {
            return true;
        }
        let mut occludes = false;
        self.walk(lanes, ray, range.clone(), |_, sphere, _| {
            occludes = sphere.occludes(ray, range.clone());
            occludes.then_some(-V::Scalar::ONE)
        });
        occludes
    }

    /// The nearest of all spheres, each asked exactly, for a ray that the filters cannot compute with.
    #[cold]
    fn nearest_of_all(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        let Ray { origin, direction } = *ray;
        if !(origin.to_f64().is_finite() && direction.to_f64().is_finite()) {
            return None;
        }
        let Range { start, mut end } = range;
        let mut nearest = None;
        for (index, &place) in self.places.iter().enumerate() {
            let hit = self.at_place(place).and_then(|sphere| sphere.intersect(ray, start..end));
            if let Some(hit) = hit {
                if self.is_nearer(ray, (number(index), hit.t), t_of(nearest)) {
                    end = next_above::<V>(hit.t);
                    nearest = Some((number(index), hit));
                }
            }
        }
        let (index, hit) = nearest?;
        Some((index as usize, hit))
    }

    /// Whether a hit comes before the nearest so far, each given as its index and its t.
    #[inline(always)]
    fn is_nearer(
        &self,
        ray: &Ray<V>,
        hit: (u32, V::Scalar),
        nearest: Option<(u32, V::Scalar)>,
    ) -> bool {
        nearest.is_none_or(|nearest| {
            let spheres = || [hit.0, nearest.0].map(|index| self.get(index as usize));
            is_nearer(ray, hit, nearest, spheres)
        })
    }
}

/// Where the nearest so far is: not a reference to it, which would keep it in memory.
#[inline(always)]
fn t_of<V: Vector>(nearest: Option<(u32, Hit<V>)>) -> Option<(u32, V::Scalar)> {
    nearest.map(|(index, hit)| (index, hit.t))
}

/// Whether the filters can compute with a ray.
#[inline(always)]
pub(super) fn allows<V: Vector>(ray: &Ray<V>) -> bool {
    Segment::allows(narrow(ray.origin), narrow(ray.direction), LARGEST * LARGEST)
}
