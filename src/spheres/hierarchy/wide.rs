//! Makes nodes of up to 16 boxes, and leaves, of a binary tree.
//!
//! Those splits become nodes for which the sum of the areas of all nodes and leaves is least: that is how many of them a ray visits
//! (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs*, 2017, section 3.1). With
//! C(n, i) for the least sum below and in split n, in i boxes at most, l and r for its halves, and A for its area,
//!
//! ```text
//! C(n, 1) = A(n)                                       of a leaf
//! C(n, 1) = A(n) + M + D(n, 16)                        of others: a node
//! C(n, i) = min(D(n, i), C(n, i - 1))
//! D(n, i) = min over k of C(l, k) + C(r, i - k)
//! ```
//!
//! M is what a node costs besides, for its memory: without it, many small ones would have few children.

use alloc::vec::Vec;

use glam::Vec3;

use super::LEAF;
use super::boxes::Boxes;
use super::build::{Member, bounds_of, leaf, number};
use super::leaf::Leaf;
use super::split::Split;
use crate::spheres::lanes::LANES;

/// M for all leaves together, in areas of the root.
const MEMORY: f32 = 4.0;

/// The least costs of a split: C(n, i) for i from 1 to 16.
#[derive(Clone, Copy)]
struct Costs {
    least: [f32; LANES],
    /// Of each, the number of boxes that the first half has: 0 if the split is one box itself.
    first: [u8; LANES],
    /// That of D(n, 16), where the split is a node.
    first_of_node: u8,
}

/// The leaves and the nodes, and what they are made of.
pub(super) struct Wide<'a> {
    members: &'a [Member],
    splits: &'a [Split],
    costs: Vec<Costs>,
    pub(super) leaves: Vec<Leaf>,
    /// The root first.
    pub(super) nodes: Vec<Boxes>,
    /// Of each sphere, by its index, the leaf and the lane that it is in.
    pub(super) places: Vec<u32>,
}

impl<'a> Wide<'a> {
    pub(super) fn new(members: &'a [Member], splits: &'a [Split], places: Vec<u32>) -> Self {
        Self {
            members,
            splits,
            costs: costs(splits),
            leaves: Vec::with_capacity(splits.iter().filter(|split| split.is_leaf()).count()),
            nodes: Vec::new(),
            places,
        }
    }

    /// Makes all of them. Returns where a ray begins.
    pub(super) fn make(&mut self) -> u32 {
        let Some(top) = self.splits.len().checked_sub(1) else { return LEAF };
        if self.splits[top].is_leaf() {
            self.leaf(top);
            LEAF
        } else {
            self.nodes.push(Boxes::EMPTY);
            self.node(top, 0);
            self.nodes.shrink_to_fit();
            0
        }
    }

    /// Makes the leaf of a split. Returns the box around it.
    fn leaf(&mut self, split: usize) -> (Vec3, Vec3) {
        let members = &self.members[self.splits[split].members()];
        for (lane, member) in members.iter().enumerate() {
            self.places[member.index as usize] = number(self.leaves.len() * LANES + lane);
        }
        self.leaves.extend(leaf(members));
        bounds_of(members)
    }

    /// Makes the node of a split, at that place. Returns the box around it.
    fn node(&mut self, split: usize, place: usize) -> (Vec3, Vec3) {
        let mut children = Vec::with_capacity(LANES);
        let [left, right] = self.splits[split].halves.map(|half| half as usize);
        let first = usize::from(self.costs[split].first_of_node);
        self.collect(left, first, &mut children);
        self.collect(right, LANES - first, &mut children);
        children.sort_by_key(|&child| !self.splits[child].is_leaf());
        let leaves = children.iter().filter(|&&child| self.splits[child].is_leaf()).count();
        let first_node = self.nodes.len();
        let mut boxes = Boxes::EMPTY;
        boxes.set_children(number(self.leaves.len()), number(first_node), number(leaves));
        self.nodes.resize(first_node + children.len() - leaves, Boxes::EMPTY);
        for (lane, &child) in children.iter().enumerate().take(leaves) {
            let bounds = self.leaf(child);
            boxes.set(lane, bounds);
        }
        for (lane, &child) in children.iter().enumerate().skip(leaves) {
            let bounds = self.node(child, first_node + lane - leaves);
            boxes.set(lane, bounds);
        }
        let bounds = boxes.bounds();
        self.nodes[place] = boxes;
        bounds
    }

    /// Collects the splits that up to so many boxes in a split are.
    fn collect(&self, split: usize, mut boxes: usize, children: &mut Vec<usize>) {
        let Costs { least, first, .. } = &self.costs[split];
        // As few as have this cost.
        while boxes > 1 && least[boxes - 2] == least[boxes - 1] {
            boxes -= 1;
        }
        let first = usize::from(first[boxes - 1]);
        if first == 0 {
            children.push(split);
            return;
        }
        let [left, right] = self.splits[split].halves.map(|half| half as usize);
        self.collect(left, first, children);
        self.collect(right, boxes - first, children);
    }
}

/// The costs of all splits.
fn costs(splits: &[Split]) -> Vec<Costs> {
    let mut costs: Vec<Costs> = Vec::with_capacity(splits.len());
    let leaves = splits.iter().filter(|split| split.is_leaf()).count();
    #[expect(clippy::cast_precision_loss, reason = "it is an estimate")]
    let of_memory = splits.last().map_or(0.0, |root| root.area * MEMORY / leaves as f32);
    for split in splits {
        let mut all = Costs { least: [split.area; LANES], first: [0; LANES], first_of_node: 0 };
        if !split.is_leaf() {
            let [left, right] = split.halves.map(|half| &costs[half as usize].least);
            let (below, first_of_node) = in_both(left, right, LANES);
            all.first_of_node = first_of_node;
            all.least[0] = split.area + of_memory + below;
            for boxes in 2..=LANES {
                let (below, first) = in_both(left, right, boxes);
                (all.least[boxes - 1], all.first[boxes - 1]) = if below < all.least[boxes - 2] {
                    (below, first)
                } else {
                    (all.least[boxes - 2], all.first[boxes - 2])
                };
            }
        }
        costs.push(all);
    }
    costs
}

/// D(n, i): the least cost of both halves in so many boxes, and how many of these the first half has.
fn in_both(left: &[f32; LANES], right: &[f32; LANES], boxes: usize) -> (f32, u8) {
    // If no cost is finite, any number will do.
    let mut best = (f32::INFINITY, 1);
    for (left, first) in left[..boxes - 1].iter().zip(1..) {
        let cost = left + right[boxes - 1 - usize::from(first)];
        if cost < best.0 {
            best = (cost, first);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use std::mem::size_of;
    use std::vec::Vec;

    use sobol_burley::sample;

    use super::*;
    use crate::Sphere;
    use crate::spheres::hierarchy::leaf::NONE;
    use crate::spheres::hierarchy::split::split_up;

    /// Every sphere is in one leaf, every leaf and every node but the root in one box, and every box around what is in it.
    #[test]
    fn boxes_are_around_what_is_in_them() {
        for count in [1, 16, 17, 256, 257, 3000] {
            let mut members: Vec<Member> = (0..count)
                .map(|index| {
                    let random = |dimension| sample(index, dimension, 6);
                    let center = Vec3::new(random(0), random(1), random(2).powi(3));
                    Member::new(index, Sphere::new(center, random(3).powi(4)))
                })
                .collect();
            let splits = split_up(&mut members);
            let mut wide = Wide::new(&members, &splits, std::vec![u32::MAX; count as usize]);
            let mut waiting = std::vec![(wide.make(), None)];
            let (mut leaves, mut nodes, mut spheres) = (0, 0, 0);
            while let Some((child, bounds)) = waiting.pop() {
                let (low, high) = bounds.unwrap_or((Vec3::NEG_INFINITY, Vec3::INFINITY));
                if child & LEAF != 0 {
                    leaves += 1;
                    let place = (child & !LEAF) as usize;
                    for lane in 0..LANES {
                        let index = wide.leaves[place].index(lane);
                        if index != NONE {
                            spheres += 1;
                            let sphere = wide.leaves[place].sphere(lane);
                            assert!(sphere.bounds().0.cmpge(low).all());
                            assert!(sphere.bounds().1.cmple(high).all());
                            assert_eq!(wide.places[index as usize], number(place * LANES + lane));
                        }
                    }
                } else {
                    nodes += 1;
                    let node = &wide.nodes[child as usize];
                    assert!(node.bounds().0.cmpge(low).all() && node.bounds().1.cmple(high).all());
                    for lane in 0..LANES {
                        let bounds = node.bounds_of(lane);
                        if bounds.0.cmple(bounds.1).all() {
                            waiting.push((node.child(number(lane)), Some(bounds)));
                        }
                    }
                }
            }
            assert_eq!((leaves, nodes), (wide.leaves.len(), wide.nodes.len()), "{count}");
            assert_eq!(spheres, count);
        }
    }

    /// With the place of each sphere, at most 32 bytes a sphere.
    #[test]
    fn memory_is_little() {
        for (group, extent) in [(1, 0.0), (9, 0.001), (9, 0.3), (17, 0.01), (100, 0.1), (40, 0.02)]
        {
            let random = |index, dimension| sample(index, dimension, 8);
            let mut members: Vec<Member> = (0..10_000)
                .map(|index| {
                    let center = [0, 1, 2].map(|dimension| {
                        random(index / group, dimension) + extent * random(index, 3 + dimension)
                    });
                    Member::new(index, Sphere::new(center.into(), 0.001))
                })
                .collect();
            let splits = split_up(&mut members);
            let mut wide = Wide::new(&members, &splits, std::vec![0; members.len()]);
            wide.make();
            let bytes = size_of::<Leaf>() * wide.leaves.capacity()
                + size_of::<Boxes>() * wide.nodes.capacity()
                + size_of::<u32>() * wide.places.capacity();
            let limit = 32 * members.len();
            assert!(bytes <= limit, "groups of {group} in {extent}: {bytes} bytes");
        }
    }

    /// 256 spheres need one node, and no tree of the same splits has fewer.
    #[test]
    fn nodes_are_few() {
        let mut members: Vec<Member> = (0..4096)
            .map(|index| {
                let center = Vec3::from([0, 1, 2].map(|dimension| sample(index, dimension, 7)));
                Member::new(index, Sphere::new(center, 0.01))
            })
            .collect();
        let splits = split_up(&mut members);
        let mut wide = Wide::new(&members, &splits, std::vec![0; members.len()]);
        wide.make();
        assert!(wide.nodes.len() <= 22, "{}", wide.nodes.len());
    }
}
