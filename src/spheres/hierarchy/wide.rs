//! Makes nodes of up to 16 boxes, and leaves, of a binary tree.
//!
//! Those splits become nodes for which the sum of the areas of all nodes and leaves is least: that is how many of them a ray
//! visits (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs*, 2017, section
//! 3.1). With C(n, i) for the least sum below and in split n, in i boxes at most, l and r for its halves, and A for its area,
//!
//! ```text
//! C(n, 1) = A(n)                                       of a leaf
//! C(n, 1) = A(n) + M + D(n, 16)                        of others: a node
//! C(n, i) = min(D(n, i), C(n, i - 1))
//! D(n, i) = min over k of C(l, k) + C(r, i - k)
//! ```
//!
//! M is what a node costs besides, for its memory: without it, many small ones would have few children. A region inside of
//! another is one box, whatever is in it: C(n, i) = C(n, 1). A node without boxes is its door.

use alloc::vec::Vec;

use arrayvec::ArrayVec;

use super::bounds::Bounds;
use super::boxes::{Boxes, LEAF, LEAST_COORDINATE};
use super::leaf::{Leaf, NONE};
use super::number::number;
use super::region::Region;
use super::split::{Binary, Member, Split};
use crate::spheres::lanes::LANES;
use crate::{Scalar, Sphere, Vector};

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
pub(super) struct Wide<'a, V: Vector> {
    spheres: &'a [Sphere<V>],
    members: &'a [Member],
    splits: &'a [Split],
    centers: &'a [V],
    costs: Vec<Costs>,
    pub(super) leaves: Vec<Leaf<V::Scalar>>,
    pub(super) nodes: Vec<Boxes>,
    /// The whole tree first.
    pub(super) regions: Vec<Region<V>>,
    /// Of each sphere, by its index, the leaf and the lane that it is in.
    pub(super) places: Vec<u32>,
}

impl<'a, V: Vector> Wide<'a, V> {
    pub(super) fn new(
        spheres: &'a [Sphere<V>],
        members: &'a [Member],
        Binary { splits, centers }: &'a Binary<V>,
        places: Vec<u32>,
    ) -> Self {
        let regions = centers
            .iter()
            .map(|&center| Region { center, extent: LEAST_COORDINATE, root: LEAF })
            .collect();
        Self {
            spheres,
            members,
            splits,
            centers,
            costs: costs(splits),
            leaves: Vec::with_capacity(splits.iter().filter(|split| split.is_leaf()).count()),
            nodes: Vec::new(),
            regions,
            places,
        }
    }

    /// Makes all of them.
    pub(super) fn make(&mut self) {
        let Some(top) = self.splits.len().checked_sub(1) else { return };
        self.region(top, 0);
        self.nodes.shrink_to_fit();
    }

    /// Makes the region of a split. Returns the box around it.
    fn region(&mut self, split: usize, region: usize) -> Bounds {
        let center = self.centers[region];
        let (root, bounds) = if self.splits[split].is_leaf() {
            let bounds = self.leaf(split);
            (number(self.leaves.len() - 1) | LEAF, bounds)
        } else {
            let root = self.nodes.len();
            self.nodes.push(Boxes::EMPTY);
            (number(root), self.node(split, root, center))
        };
        let (low, high) = bounds.relative_to(center);
        let extent = low.abs().max(high.abs()).max_element().max(LEAST_COORDINATE);
        self.regions[region] = Region { center, extent, root };
        bounds
    }

    /// Makes the leaf of a split. Returns the box around it.
    fn leaf(&mut self, split: usize) -> Bounds {
        let members = &self.members[self.splits[split].members()];
        for (lane, member) in members.iter().enumerate() {
            self.places[member.index as usize] = number(self.leaves.len() * LANES + lane);
        }
        let Some((leaf, bounds)) = leaf(members, self.spheres) else { return Bounds::NONE };
        self.leaves.push(leaf);
        bounds
    }

    /// Makes the node of a split, at that place. Returns the box around it.
    fn node(&mut self, split: usize, place: usize, center: V) -> Bounds {
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
        let mut all = Bounds::NONE;
        for (lane, &child) in children.iter().enumerate() {
            let bounds = if lane < leaves {
                self.leaf(child)
            } else {
                let place = first_node + lane - leaves;
                match self.splits[child].region {
                    Some(region) => {
                        self.nodes[place] = Boxes::door(region);
                        self.region(child, region as usize)
                    }
                    None => self.node(child, place, center),
                }
            };
            boxes.set(lane, bounds.relative_to(center));
            all = all.and(bounds);
        }
        self.nodes[place] = boxes;
        all
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

/// The leaf of up to 16 of the spheres, and the box around it. In each lane that is left is a point, which hardly a ray comes
/// near, with an index that tells it.
fn leaf<V: Vector>(members: &[Member], spheres: &[Sphere<V>]) -> Option<(Leaf<V::Scalar>, Bounds)> {
    // All first: they may be anywhere in memory, and one is not waited for before the next is asked for.
    let spheres: ArrayVec<Sphere<V>, LANES> =
        members.iter().take(LANES).map(|member| spheres[member.index as usize]).collect();
    let mut leaf = Leaf::filled(NONE, &Sphere::new(spheres.first()?.center, V::Scalar::ZERO));
    let mut bounds = Bounds::NONE;
    for (lane, (member, sphere)) in members.iter().zip(&spheres).enumerate() {
        leaf.set(lane, member.index, sphere);
        bounds = bounds.and(Bounds::of(sphere));
    }
    Some((leaf, bounds))
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
            all.least = [split.area + of_memory + below; LANES];
            let most = if split.region.is_some() { 1 } else { LANES };
            for boxes in 2..=most {
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

    use glam::Vec3;
    use sobol_burley::sample;

    use super::*;
    use crate::spheres::hierarchy::split::split_up;

    /// A tree of spheres and what they are.
    fn wide_of<T>(spheres: &[Sphere], then: impl FnOnce(&Wide<Vec3>) -> T) -> T {
        let mut members: Vec<Member> = (0..)
            .zip(spheres)
            .map(|(index, sphere)| Member::new(index, sphere, Vec3::ZERO))
            .collect();
        let binary = split_up(&mut members, spheres);
        let mut wide = Wide::new(spheres, &members, &binary, std::vec![u32::MAX; spheres.len()]);
        wide.make();
        then(&wide)
    }

    /// Every sphere is in one leaf, every leaf and every node but the roots in one box, and every box around what is in it.
    #[test]
    fn boxes_are_around_what_is_in_them() {
        // Clusters far from each other are regions.
        for (clusters, count) in
            [(1, 1), (1, 16), (1, 17), (1, 256), (1, 257), (1, 3000), (7, 3000), (100, 3000)]
        {
            let spheres: Vec<Sphere> = (0..count)
                .map(|index| {
                    let random = |dimension| sample(index, dimension, 6);
                    let cluster = |dimension| sample(index % clusters, dimension, 6) * 1e6;
                    let center = Vec3::new(
                        random(0) + cluster(1),
                        random(1) + cluster(2),
                        random(2).powi(3) + cluster(3),
                    );
                    Sphere::new(center, random(3).powi(4))
                })
                .collect();
            wide_of(&spheres, |wide| check(wide, count, clusters > 1));
        }
    }

    fn check(wide: &Wide<Vec3>, count: u32, has_regions: bool) {
        let first = &wide.regions[0];
        let mut waiting = std::vec![(first.root, first, None)];
        let (mut leaves, mut nodes, mut spheres, mut all_regions) = (0, 0, 0, 1);
        while let Some((child, region, bounds)) = waiting.pop() {
            let (low, high) = bounds.unwrap_or((Vec3::NEG_INFINITY, Vec3::INFINITY));
            let is_in = |(lowest, highest): (Vec3, Vec3)| {
                lowest.cmpge(low).all() && highest.cmple(high).all()
            };
            if child & LEAF != 0 {
                leaves += 1;
                let place = (child & !LEAF) as usize;
                for lane in 0..LANES {
                    let index = wide.leaves[place].index(lane);
                    if index != NONE {
                        spheres += 1;
                        let sphere: Sphere = wide.leaves[place].sphere(lane);
                        assert!(is_in(Bounds::of(&sphere).relative_to(region.center)));
                        assert_eq!(sphere, wide.spheres[index as usize]);
                        assert_eq!(wide.places[index as usize], number(place * LANES + lane));
                    }
                }
                continue;
            }
            nodes += 1;
            let node = &wide.nodes[child as usize];
            if let Some(inner) = node.region() {
                all_regions += 1;
                let inner = &wide.regions[inner as usize];
                assert!(inner.extent * 1024.0 < region.extent);
                waiting.push((inner.root, inner, None));
                continue;
            }
            let (lowest, highest) = node.bounds();
            assert!(is_in((lowest, highest)));
            assert!(lowest.abs().max(highest.abs()).max_element() <= region.extent);
            for lane in 0..LANES {
                let bounds = node.bounds_of(lane);
                if bounds.0.cmple(bounds.1).all() {
                    waiting.push((node.child(number(lane)), region, Some(bounds)));
                }
            }
        }
        assert_eq!((leaves, nodes), (wide.leaves.len(), wide.nodes.len()), "{count}");
        assert_eq!(spheres, count);
        assert_eq!(wide.regions.len(), all_regions);
        assert_eq!(all_regions > 1, has_regions, "{count}: {all_regions}");
    }

    /// With the place of each sphere, at most 32 bytes a sphere.
    #[test]
    fn memory_is_little() {
        for (group, extent) in [(1, 0.0), (9, 0.001), (9, 0.3), (17, 0.01), (100, 0.1), (40, 0.02)]
        {
            let random = |index, dimension| sample(index, dimension, 8);
            let spheres: Vec<Sphere> = (0..10_000)
                .map(|index| {
                    let center = [0, 1, 2].map(|dimension| {
                        random(index / group, dimension) + extent * random(index, 3 + dimension)
                    });
                    Sphere::new(center.into(), 0.001)
                })
                .collect();
            let bytes = wide_of(&spheres, |wide| {
                size_of::<Leaf<f32>>() * wide.leaves.capacity()
                    + size_of::<Boxes>() * wide.nodes.capacity()
                    + size_of::<u32>() * wide.places.capacity()
            });
            let limit = 32 * spheres.len();
            assert!(bytes <= limit, "groups of {group} in {extent}: {bytes} bytes");
        }
    }

    /// 256 spheres need one node, and no tree of the same splits has fewer.
    #[test]
    fn nodes_are_few() {
        let spheres: Vec<Sphere> = (0..4096)
            .map(|index| {
                let center = Vec3::from([0, 1, 2].map(|dimension| sample(index, dimension, 7)));
                Sphere::new(center, 0.01)
            })
            .collect();
        let nodes = wide_of(&spheres, |wide| wide.nodes.len());
        assert!(nodes <= 22, "{nodes}");
    }
}
