//! The way of a packet through the hierarchy: as that of one ray, with what passes for any ray asked of each.

use core::cmp::Reverse;
use core::ops::Range;

use arrayvec::ArrayVec;

use super::boxes::{Boxes, LEAF, MARGIN};
use super::frustum::{Enter, Frustum, Prepare, Slabs};
use super::leaf::{Leaf, NONE};
use super::region::FAR;
use super::tree::Tree;
use super::walk::{Key, MOST_WAITING, child, entry, key};
use crate::spheres::each::Collection;
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::spheres::packet::cone::Cone;
use crate::spheres::packet::{Around, Mask, Packet, Question, RAYS};
use crate::spheres::scan::Bits;
use crate::{Hit, Ray, Scalar, Sphere, Vector};

const RATIO: u32 = 1;

/// Numbers of 16 boxes, where one instruction can write them.
#[repr(align(64))]
struct Numbers([f32; LANES]);

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

/// Asks 16 boxes or spheres of each ray, one by one, and returns for each which rays may meet it.
#[inline(always)]
fn one_by_one<I: Instructions>(
    instructions: I,
    rays: Mask,
    wanted: u32,
    mut near: impl FnMut(usize) -> u32,
) -> [Mask; LANES] {
    let mut bits = [[0; LANES]; RAYS / LANES];
    let mut any = 0;
    for ray in Bits(rays) {
        let near = near(ray);
        any |= near;
        bits[ray / LANES % (RAYS / LANES)][ray % LANES] = near;
    }
    let wanted = wanted & any;
    let mut masks = [0; LANES];
    for lane in Bits(wanted.into()) {
        for (bits, number) in bits.iter().zip(0..) {
            let signs = bits.map(|bits: u32| f32::from_bits(bits << (31 - lane)));
            masks[lane % LANES] |= Mask::from(instructions.signs(&signs)) << (number * LANES);
        }
    }
    masks
}

/// Asks which rays may meet each sphere of a leaf, one by one: where they are fewer than what 16 rays would have to be asked of.
struct InLeafAlone<'a, S> {
    leaf: &'a Leaf<S>,
    packet: &'a Packet,
    rays: Mask,
    wanted: u32,
}

impl<S: Scalar> Vectorized for InLeafAlone<'_, S> {
    type Output = [Mask; LANES];

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> [Mask; LANES] {
        let Self { leaf, packet, rays, wanted } = self;
        one_by_one(instructions, rays, wanted, |ray| {
            let (cone, end) = packet.alone(ray);
            cone.near(instructions, leaf.numbers(), end)
        })
    }
}

/// Asks which rays may enter each box of a node, one by one.
struct EnterAlone<'a> {
    slabs: &'a Slabs,
    packet: &'a Packet,
    boxes: &'a Boxes,
    rays: Mask,
    wanted: u32,
}

impl Vectorized for EnterAlone<'_> {
    type Output = [Mask; LANES];

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> [Mask; LANES] {
        let Self { slabs, packet, boxes, rays, wanted } = self;
        let mut entries = [0.0; LANES];
        one_by_one(instructions, rays, wanted, |ray| {
            let (slabs, end) = slabs.alone(packet, ray);
            boxes.entered(instructions, &slabs, [packet.first, end], &mut entries)
        })
    }
}

impl<V: Vector> Collection<V> for Tree<V> {
    fn around(&self) -> Around {
        self.regions.first().map_or_else(
            || self.apart.around(),
            |whole| {
                let radius = whole.extent * FAR;
                Around::new(whole.center, radius * radius, whole.extent)
            },
        )
    }

    fn ask<Q: Question<V>>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q) {
        if !self.apart.is_empty() {
            packet.scan(lanes, &self.apart, self.first_apart(), question);
            packet.update_farthest();
        }
        let Some(whole) = self.regions.first().filter(|_| packet.alive != 0) else { return };
        let mut slabs = Slabs::EMPTY;
        lanes.run(Prepare::new(&mut slabs, packet, whole));
        let ratio = crate::spheres::packet::tune(2, 1.0);
        let frustum = Frustum::new(packet, whole, MARGIN);
        let mut entries = Numbers([0.0; LANES]);
        let mut waiting = ArrayVec::<(Key, Mask, bool), MOST_WAITING>::new();
        let (mut place, mut rays) = (whole.root, packet.alive);
        loop {
            if place & LEAF != 0 {
                if !self.ask_leaf(lanes, packet, place & !LEAF, rays, question) {
                    return;
                }
            } else if let Some(node) = self.nodes.get(place as usize) {
                let end = packet.farthest;
                let mut entered =
                    lanes.run(EnterAny { node, frustum: &frustum, end, entries: &mut entries });
                let mut masks = [rays; LANES];
                let are_tested = Q::IS_ANY_ORDER
                    && (rays.count_ones() as f32) < ratio * (entered.count_ones() * Packet::tests(rays)) as f32;
                if are_tested && entered != 0 {
                    masks = lanes.run(EnterAlone {
                        slabs: &slabs,
                        packet,
                        boxes: node,
                        rays,
                        wanted: entered,
                    });
                }
                // The nearest is next, and the others as they come.
                let first = waiting.len();
                while entered != 0 {
                    let lane = entered.trailing_zeros();
                    entered &= entered - 1;
                    // A box, by its node and its lane: there are fewer than 32 bits can tell apart.
                    let key = key(entries.0[lane as usize % LANES], place * 16 + lane);
                    let mask = masks[lane as usize % LANES];
                    if mask != 0 {
                        let _ = waiting.try_push((key, mask, are_tested));
                    }
                }
                let pushed = waiting.get_mut(first..).unwrap_or_default();
                if !Q::IS_ANY_ORDER { pushed.sort_unstable_by_key(|&(key, ..)| Reverse(key)); }
                if node.region().is_some() {
                    packet.leave_alone(rays);
                }
            }
            loop {
                let Some((key, asked, is_tested)) = waiting.pop() else { return };
                let asked = asked & packet.alive;
                let (place_of_node, lane) =
                    (child(key) as usize / LANES, child(key) as usize % LANES);
                if entry(key) > packet.farthest || asked == 0 {
                    continue;
                }
                let Some(boxes) = self.nodes.get(place_of_node) else { continue };
                if is_tested {
                    rays = asked;
                } else {
                    rays = lanes.run(Enter { slabs: &slabs, packet, boxes, lane, rays: asked });
                    if !packet.pays(2 + Packet::tests(asked), 2 * rays.count_ones()) {
                        return;
                    }
                }
                if rays != 0 {
                    place = boxes.child(child(key) % 16);
                    break;
                }
            }
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
        let near = lanes.run(InLeaf { leaf, cone: &packet.cone, end: packet.farthest });
        if near == 0 {
            return true;
        }
        let (alone, together) = (rays.count_ones(), near.count_ones() * Packet::tests(rays));
        if !packet.pays(alone.min(together), alone) {
            return false;
        }
        let of_spheres = if alone < together {
            lanes.run(InLeafAlone { leaf, packet, rays, wanted: near })
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
