//! The way of a packet through the hierarchy: as that of one ray, with what passes for any ray asked of each.
//!
//! A box that some ray may enter is asked of 16 rays at a time. Where rays are too far apart to share much, as shadow rays from
//! hits at many depths, each box of a node is entered by few of them, and it takes less to ask each ray of 16 boxes at a time. It
//! still takes less than to ask one ray after the other: a node is fetched once for all, and nothing waits for which box a ray
//! enters next. That is done only for occlusion, where the order does not matter. To find the nearest hit, rays would be asked
//! of boxes that they need not enter once they have found it.

use core::cmp::Reverse;
use core::ops::Range;

use arrayvec::ArrayVec;

use super::boxes::{Boxes, LEAF, MARGIN};
use super::frustum::{Enter, Frustum, Prepare, Slabs};
use super::leaf::{Leaf, NONE};
use super::region::FAR;
use super::tree::Tree;
use super::walk::{Key, MOST_WAITING, Numbers, child, entry, key};
use crate::spheres::each::Collection;
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::spheres::local::narrow;
use crate::spheres::packet::cone::Cone;
use crate::spheres::packet::{Around, Mask, NEIGHBORS, Packet, Question, RAYS};
use crate::spheres::scan::Bits;
use crate::{Hit, Ray, Scalar, Sphere, Vector};

/// A bit for each box of a node or each sphere of a leaf.
const ALL: u32 = 0xFFFF;

/// [`NEIGHBORS`] for occlusion: farther apart, but not so far that rays in any order are taken.
const NEIGHBORS_IN_ANY_ORDER: [f32; 2] = [0.3, 0.25];

/// So few rays are asked one by one at once, not together before that.
const FEW: u32 = 4;

/// What a test of a box with 16 rays takes is to that of 16 boxes with one ray as this to 1.
const RAYS_FOR_A_BOX: u32 = 2;

/// What a visit takes besides the tests, in tests: of a node whose boxes are asked of rays one by one, and of a leaf. (One ray
/// at a time, a visit takes 2 tests with all.) With less, rays that have nothing in common are given up too late: `cargo bench
/// --bench pictures` has them, shuffled.
const OF_NODE: u32 = 10;
const OF_LEAF: u32 = 5;

/// Asks which boxes of a node any ray may enter.
struct EnterAny<'a> {
    node: &'a Boxes,
    frustum: &'a Frustum,
    end: f32,
    entries: &'a mut Numbers,
}

impl Vectorized for EnterAny<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        self.frustum.entered(instructions, self.node, self.end, &mut self.entries.0)
    }
}

/// Asks which spheres of a leaf any ray may meet.
struct InLeaf<'a, S> {
    leaf: &'a Leaf<S>,
    cone: &'a Cone,
    end: f32,
}

impl<S: Scalar> Vectorized for InLeaf<'_, S> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> u32 {
        self.cone.near(instructions, self.leaf.numbers(), self.end)
    }
}

/// Asks rays one by one which of 16 boxes or spheres they may meet, and returns for each of these which rays do.
#[inline(always)]
fn one_by_one<I: Instructions>(
    instructions: I,
    rays: Mask,
    mut near: impl FnMut(usize) -> u32,
) -> [Mask; LANES] {
    let mut of_rays = [[0; LANES]; RAYS / LANES];
    let mut any = 0;
    for ray in Bits(rays) {
        // The only call, or it would not be inlined.
        let near = near(ray);
        any |= near;
        of_rays[ray / LANES % (RAYS / LANES)][ray % LANES] = near;
    }
    let mut masks = [0; LANES];
    for lane in Bits(any.into()) {
        for (near, number) in of_rays.iter().zip(0..) {
            let shift = number * LANES;
            if rays >> shift & 0xFFFF != 0 {
                let signs = near.map(|near: u32| f32::from_bits(near << (31 - lane)));
                masks[lane % LANES] |= Mask::from(instructions.signs(&signs)) << shift;
            }
        }
    }
    masks
}

/// Asks which rays may meet each sphere of a leaf, one by one.
struct InLeafAlone<'a, S> {
    leaf: &'a Leaf<S>,
    packet: &'a Packet,
    rays: Mask,
}

impl<S: Scalar> Vectorized for InLeafAlone<'_, S> {
    type Output = [Mask; LANES];

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> [Mask; LANES] {
        let Self { leaf, packet, rays } = self;
        one_by_one(instructions, rays, |ray| {
            let (cone, end) = packet.alone(ray);
            cone.near(instructions, leaf.numbers(), end)
        })
    }
}

/// Asks which rays may enter each box of a node, one by one.
pub(super) struct EnterAlone<'a> {
    pub(super) node: &'a Boxes,
    pub(super) slabs: &'a Slabs,
    pub(super) packet: &'a Packet,
    pub(super) rays: Mask,
}

impl Vectorized for EnterAlone<'_> {
    type Output = [Mask; LANES];

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> [Mask; LANES] {
        let Self { node, slabs, packet, rays } = self;
        one_by_one(instructions, rays, |ray| {
            let (slabs, end) = (slabs.alone(ray), packet.end(ray));
            node.entered(instructions, &slabs, [packet.first, end], &mut [0.0; LANES])
        })
    }
}

/// The way of a packet through a tree.
struct Walk<'a, V: Vector> {
    tree: &'a Tree<V>,
    lanes: Lanes,
    packet: &'a mut Packet,
    slabs: &'a Slabs,
    frustum: &'a Frustum,
    entries: Numbers,
    /// Boxes, each by its node and its lane, and the rays that may enter it. There are fewer boxes than 32 bits can tell apart.
    waiting: ArrayVec<(Key, Mask), MOST_WAITING>,
}

impl<V: Vector> Walk<'_, V> {
    /// The boxes of a node that some ray may enter.
    #[inline(always)]
    fn entered_by_any(&mut self, node: &Boxes) -> u32 {
        let Self { frustum, entries, .. } = self;
        self.lanes.run(EnterAny { node, frustum, end: self.packet.farthest, entries })
    }

    /// Which of these rays enter a box; `None` where the packet is given up.
    #[inline(always)]
    fn enter(&mut self, boxes: &Boxes, lane: usize, rays: Mask) -> Option<Mask> {
        let Self { lanes, packet, slabs, .. } = self;
        let entering = lanes.run(Enter { slabs, packet, boxes, lane, rays });
        let pays = packet.pays(2 + Packet::tests(rays), 2 * entering.count_ones());
        pays.then_some(entering)
    }

    /// Has a box of a node wait. There is room for all that can wait at once.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "it is below 16")]
    fn wait(&mut self, entry: f32, place: u32, lane: usize, rays: Mask) {
        let _ = self.waiting.try_push((key(entry, place * 16 + lane as u32), rays));
    }

    /// Has the boxes of a node wait that some ray may enter, so that the nearest is next. Rays are asked of a box when it is its
    /// turn: many have no more to ask then.
    #[inline(always)]
    fn wait_in_order(&mut self, place: u32, node: &Boxes, rays: Mask) {
        let first = self.waiting.len();
        for lane in Bits(self.entered_by_any(node).into()) {
            self.wait(self.entries.0[lane % LANES], place, lane, rays);
        }
        let pushed = self.waiting.get_mut(first..).unwrap_or_default();
        pushed.sort_unstable_by_key(|&(key, _)| Reverse(key));
    }

    /// Has the boxes of a node wait that rays enter. Returns `false` where the packet is given up.
    #[inline(always)]
    fn wait_in_any_order(&mut self, place: u32, node: &Boxes, rays: Mask) -> bool {
        let count = rays.count_ones();
        let entered = if count <= FEW { ALL } else { self.entered_by_any(node) };
        if count < RAYS_FOR_A_BOX * (entered.count_ones() * Packet::tests(rays)) {
            if !self.packet.pays(OF_NODE + count, 2 * count) {
                return false;
            }
            let Self { lanes, packet, slabs, .. } = self;
            let masks = lanes.run(EnterAlone { node, slabs, packet, rays });
            for (&rays, lane) in masks.iter().zip(0..).filter(|&(&rays, _)| rays != 0) {
                self.wait(0.0, place, lane, rays);
            }
            return true;
        }
        for lane in Bits(entered.into()) {
            let Some(rays) = self.enter(node, lane, rays) else { return false };
            self.wait(0.0, place, lane, rays);
        }
        true
    }

    /// The next node or leaf, and the rays that enter it.
    #[inline(always)]
    fn next(&mut self, in_any_order: bool) -> Option<(u32, Mask)> {
        loop {
            let (key, rays) = self.waiting.pop()?;
            let mut rays = rays & self.packet.alive;
            if entry(key) > self.packet.farthest || rays == 0 {
                continue;
            }
            let (node, lane) = (child(key) as usize / LANES, child(key) as usize % LANES);
            let Some(boxes) = self.tree.nodes.get(node) else { continue };
            if !in_any_order {
                rays = self.enter(boxes, lane, rays)?;
            }
            if rays != 0 {
                return Some((boxes.child(child(key) % 16), rays));
            }
        }
    }
}

impl<V: Vector> Collection<V> for Tree<V> {
    fn around(&self, in_any_order: bool) -> Around {
        let Some(whole) = self.regions.first() else { return self.apart.around(in_any_order) };
        let (center, extent) = (narrow(whole.center), whole.extent);
        let [apart, wide] = if in_any_order { NEIGHBORS_IN_ANY_ORDER } else { NEIGHBORS };
        let neighbors = [apart * extent, wide];
        Around { center, radius_squared: extent * FAR * (extent * FAR), neighbors }
    }

    fn ask<Q: Question<V>>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q) {
        if !self.apart.is_empty() {
            packet.scan(lanes, &self.apart, self.first_apart(), question);
            packet.update_farthest();
        }
        let Some(whole) = self.regions.first().filter(|_| packet.alive != 0) else { return };
        let mut slabs = Slabs::EMPTY;
        lanes.run(Prepare::new(&mut slabs, packet, whole));
        let frustum = &Frustum::new(packet, whole, MARGIN);
        let mut next = Some((whole.root, packet.alive));
        let (entries, waiting) = (Numbers::default(), ArrayVec::new());
        let mut walk = Walk { tree: self, lanes, packet, slabs: &slabs, frustum, entries, waiting };
        while let Some((place, rays)) = next {
            if place & LEAF != 0 {
                if !self.ask_leaf(lanes, walk.packet, place & !LEAF, rays, question) {
                    return;
                }
            } else if let Some(node) = self.nodes.get(place as usize) {
                if !Q::IN_ANY_ORDER {
                    walk.wait_in_order(place, node, rays);
                } else if !walk.wait_in_any_order(place, node, rays) {
                    return;
                }
                if node.region().is_some() {
                    walk.packet.leave_alone(rays);
                }
            }
            next = walk.next(Q::IN_ANY_ORDER);
        }
    }

    fn sphere(&self, index: usize) -> Option<Sphere<V>> {
        self.get(index)
    }

    fn member(&self, place: u32) -> Option<(usize, Sphere<V>)> {
        let (leaf, lane) = (place as usize / LANES, place as usize % LANES);
        let index = match self.leaves.get(leaf) {
            Some(leaf) => leaf.index(lane),
            None => *self.apart_indices.get((place - self.first_apart()) as usize)?,
        };
        Some((index as usize, self.at_place(place)?))
    }

    fn nearest_alone(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        self.nearest(lanes, ray, range)
    }

    fn occludes_alone(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.occludes(lanes, ray, range)
    }
}

impl<V: Vector> Tree<V> {
    /// Asks the spheres of a leaf. Returns `false` where the packet is given up.
    fn ask_leaf<Q: Question<V>>(
        &self,
        lanes: Lanes,
        packet: &mut Packet,
        place: u32,
        rays: Mask,
        question: &mut Q,
    ) -> bool {
        let Some(leaf) = self.leaves.get(place as usize) else { return true };
        let (alone, end) = (rays.count_ones(), packet.farthest);
        let near = if Q::IN_ANY_ORDER && alone <= FEW {
            ALL
        } else {
            lanes.run(InLeaf { leaf, cone: &packet.cone, end })
        };
        if near == 0 {
            return true;
        }
        let together = near.count_ones() * Packet::tests(rays);
        let of_leaf = if Q::IN_ANY_ORDER { OF_LEAF } else { alone };
        if !packet.pays(of_leaf + alone.min(together), 2 * alone) {
            return false;
        }
        let of_spheres = if alone < together {
            lanes.run(InLeafAlone { leaf, packet, rays })
        } else {
            [rays; LANES]
        };
        for lane in Bits(near.into()) {
            let rays = of_spheres[lane % LANES] & packet.alive;
            if rays != 0 && leaf.index(lane % LANES) != NONE {
                let sphere = leaf.sphere(lane % LANES);
                #[expect(clippy::cast_possible_truncation, reason = "it is below 16")]
                question.ask(packet, lanes, rays, &sphere, place * 16 + lane as u32);
            }
        }
        packet.update_farthest();
        true
    }

    /// The place of the first sphere that is kept apart.
    fn first_apart(&self) -> u32 {
        super::number::number(self.leaves.len() * LANES)
    }
}
