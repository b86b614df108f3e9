//! Moves the spheres of a tree, which keeps its shape: new boxes around them, from the leaves upwards.
//!
//! The farther spheres move, the more their boxes grow and overlap. How large a box is, is told by the sum of its sides, and how
//! good the tree still is by how many times as large its boxes are, on average, as when it was built. Where a node has become
//! smaller, the boxes in it should have, too: they count in proportion to it. So neither the scale of the scene matters nor that
//! of its parts, and one sphere that flies away is noticed.

use alloc::vec::Vec;

use glam::Vec3;

use super::bounds::Bounds;
use super::boxes::{Boxes, LEAF, LEAST_COORDINATE};
use super::leaf::NONE;
use super::number::number;
use super::tree::Tree;
use crate::rejection::can_be_hit;
use crate::spheres::filter::is_in_reach;
use crate::spheres::lanes::LANES;
use crate::{Scalar, Sphere, Vector};

/// How many times as large as when the tree was built boxes may be on average.
const MOST_GROWTH: f32 = 1.06;

/// From which excess of growth on, as a part of the number of all boxes, the others need not be looked at.
const ABANDON: f32 = 1.0 / 16.0;

/// How far from the center of a region the box around it may reach, in half its size: it is 1 where the center is that of the
/// box.
const MOST_REACH: f32 = 2.0;

impl<V: Vector> Tree<V> {
    /// Moves the spheres, of which there are as many as before. Returns whether the tree is still good. If not, it must not be
    /// asked: some of the spheres may not have moved.
    pub(super) fn refit(&mut self, spheres: &[Sphere<V>]) -> bool {
        self.move_others(spheres) && self.move_members(spheres).is_some()
    }

    /// Moves the spheres that are in no leaf. Returns whether each is still of its kind.
    fn move_others(&mut self, spheres: &[Sphere<V>]) -> bool {
        for (place, &index) in self.apart_indices.iter().enumerate() {
            let sphere = spheres[index as usize];
            let before = self.apart.set(place, sphere);
            if before.is_none_or(|before| is_in_reach(&before) != is_in_reach(&sphere)) {
                return false;
            }
        }
        let behind = number(self.leaves.len() * LANES + self.apart.len());
        if !self.unreachable.is_empty() {
            for (sphere, &place) in spheres.iter().zip(&self.places) {
                if let Some(place) = place.checked_sub(behind) {
                    if can_be_hit(sphere) {
                        return false;
                    }
                    self.unreachable[place as usize] = *sphere;
                }
            }
        }
        true
    }

    /// Moves the spheres in leaves. `None` if they do not belong there anymore or if the tree is not good.
    fn move_members(&mut self, spheres: &[Sphere<V>]) -> Option<()> {
        if self.regions.is_empty() {
            return Some(());
        }
        if self.sizes.is_empty() {
            self.sizes = self.sizes_as_built();
        }
        let whole = self.leaves.len();
        #[expect(clippy::cast_precision_loss, reason = "it is an estimate")]
        let allowance = self.sizes.len() as f32 * ABANDON;
        let mut refit = Refit { tree: self, spheres, growth: 0.0, boxes: 0.0, allowance };
        refit.region(0, whole)?;
        (refit.growth <= refit.boxes * MOST_GROWTH).then_some(())
    }

    /// The size of each leaf and, behind them, of each node that is in a box, and of the root of the tree.
    fn sizes_as_built(&self) -> Vec<f32> {
        let mut sizes = alloc::vec![0.0; self.leaves.len() + self.nodes.len()];
        for node in &self.nodes {
            for lane in 0..LANES {
                if let Some(child) = child(node, lane) {
                    sizes[self.size_place(child)] = size(node.bounds_of(lane));
                }
            }
        }
        if let Some(root) = self.nodes.first() {
            sizes[self.leaves.len()] = size(root.bounds());
        }
        sizes
    }

    /// Where the size of what is in a box is.
    fn size_place(&self, child: u32) -> usize {
        let place = (child & !LEAF) as usize;
        if child & LEAF != 0 { place } else { self.leaves.len() + place }
    }
}

/// What is in the box of a lane, if it has one.
fn child(node: &Boxes, lane: usize) -> Option<u32> {
    let (low, high) = node.bounds_of(lane);
    (low.x <= high.x).then(|| node.child(number(lane)))
}

/// The sum of the sides of a box.
fn size((low, high): (Vec3, Vec3)) -> f32 {
    (high - low).element_sum()
}

/// A tree whose boxes are being made anew.
struct Refit<'a, V: Vector> {
    tree: &'a mut Tree<V>,
    spheres: &'a [Sphere<V>],
    /// The sum of how many times as large boxes are, and how many there are.
    growth: f32,
    boxes: f32,
    /// By how much the sum may exceed what is allowed for the boxes so far.
    allowance: f32,
}

impl<V: Vector> Refit<'_, V> {
    /// Makes the boxes of a region, whose size has that place. Returns the box around it.
    fn region(&mut self, region: usize, size_place: usize) -> Option<Bounds> {
        let center = self.tree.regions[region].center;
        let root = self.tree.regions[region].root;
        let bounds = if root & LEAF != 0 {
            self.leaf((root & !LEAF) as usize)?
        } else {
            self.node(root as usize, center, size_place)?
        };
        let (low, high) = bounds.relative_to(center);
        let reach = low.abs().max(high.abs()).max_element();
        if reach > (high - low).max_element() * (0.5 * MOST_REACH) {
            return None;
        }
        self.tree.regions[region].extent = reach.max(LEAST_COORDINATE);
        Some(bounds)
    }

    /// Moves the spheres of a leaf. Returns the box around it.
    fn leaf(&mut self, place: usize) -> Option<Bounds> {
        let leaf = &mut self.tree.leaves[place];
        let mut bounds = Bounds::NONE;
        let mut point = Sphere::default();
        for lane in 0..LANES {
            let index = leaf.index(lane);
            if index == NONE {
                leaf.set(lane, NONE, &point);
                continue;
            }
            let sphere = &self.spheres[index as usize];
            if !(can_be_hit(sphere) && is_in_reach(sphere)) {
                return None;
            }
            // Those without a sphere are the last.
            point = Sphere::new(sphere.center, V::Scalar::ZERO);
            leaf.set(lane, index, sphere);
            bounds = bounds.and(Bounds::of(sphere));
        }
        Some(bounds)
    }

    /// Makes the boxes of a node, whose size has that place. Returns the box around it.
    fn node(&mut self, place: usize, center: V, size_place: usize) -> Option<Bounds> {
        let mut all = Bounds::NONE;
        let mut growth = 0.0;
        for lane in 0..LANES {
            let Some(child) = child(&self.tree.nodes[place], lane) else { continue };
            let child_place = (child & !LEAF) as usize;
            let child_size_place = self.tree.size_place(child);
            let bounds = if child & LEAF != 0 {
                self.leaf(child_place)
            } else if let Some(region) = self.tree.nodes[child_place].region() {
                self.region(region as usize, child_size_place)
            } else {
                self.node(child_place, center, child_size_place)
            }?;
            let relative = bounds.relative_to(center);
            self.tree.nodes[place].set(lane, relative);
            growth += self.growth_of(child_size_place, size(relative));
            self.boxes += 1.0;
            all = all.and(bounds);
        }
        let own = self.growth_of(size_place, size(all.relative_to(center)));
        self.growth += growth / own.min(1.0);
        (self.growth <= self.boxes * MOST_GROWTH + self.allowance).then_some(all)
    }

    /// How many times as large a box is as when it was built.
    fn growth_of(&self, size_place: usize, size: f32) -> f32 {
        size / self.tree.sizes[size_place].max(f32::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use glam::DVec3;

    use super::*;
    use crate::spheres::tests::families::Rng;

    fn within(rng: &mut Rng, extent: f64) -> DVec3 {
        [(); 3].map(|()| rng.uniform(-extent, extent)).into()
    }

    fn cloud<V: Vector>(rng: &mut Rng) -> Vec<Sphere<V>> {
        let mut sphere = |_| {
            let radius = rng.uniform(0.2, 0.8);
            Sphere::new(V::from_f64(within(rng, 40.0)), V::Scalar::from_f64(radius))
        };
        (0..5000).map(&mut sphere).collect()
    }

    fn step<V: Vector>(rng: &mut Rng, spheres: &mut [Sphere<V>], radii: f64) {
        for sphere in spheres {
            let shift = rng.unit_vector() * sphere.radius.into() * radii;
            sphere.center = V::from_f64(sphere.center.to_f64() + shift);
        }
    }

    fn keeps_a_tree_that_is_good<V: Vector>() {
        let mut rng = Rng::new(1);
        let spheres = cloud::<V>(&mut rng);
        let tree = Tree::new(&spheres);
        let is_kept = |spheres: &[Sphere<V>]| tree.clone().refit(spheres);
        assert!(is_kept(&spheres));
        let moved = |rng: &mut Rng, radii: f64| {
            let mut moved = spheres.clone();
            step(rng, &mut moved, radii);
            moved
        };
        assert!(is_kept(&moved(&mut rng, 0.1)));
        assert!(!is_kept(&moved(&mut rng, 10.0)));
        // All together by a little, and far away.
        let all = |change: &dyn Fn(DVec3) -> DVec3| -> Vec<Sphere<V>> {
            let moved = |sphere: &Sphere<V>| {
                Sphere::new(V::from_f64(change(sphere.center.to_f64())), sphere.radius)
            };
            spheres.iter().map(moved).collect()
        };
        assert!(is_kept(&all(&|center| center + 10.0)));
        assert!(!is_kept(&all(&|center| center + 1e4)));
        // Others in their places, in the same space or in a smaller one.
        let mut others = spheres.clone();
        others.reverse();
        assert!(!is_kept(&others));
        for sphere in &mut others {
            sphere.center = V::from_f64(sphere.center.to_f64() * 0.01);
            sphere.radius = V::Scalar::from_f64(sphere.radius.into() * 0.01);
        }
        assert!(!is_kept(&others));
        // One that is elsewhere, or of another kind.
        for (center, radius) in
            [(DVec3::X * 1e4, 1.0), (DVec3::NAN, 1.0), (DVec3::ZERO, -1.0), (DVec3::X * 1e20, 1.0)]
        {
            let mut others = spheres.clone();
            others[77] = Sphere::new(V::from_f64(center), V::Scalar::from_f64(radius));
            assert!(!is_kept(&others), "{center}, {radius}");
        }
    }

    /// Boxes that are all as many times as large as before are that on average, and where all have become smaller, none has
    /// grown.
    fn keeps_a_tree_that_has_grown_by_little<V: Vector>() {
        let spheres = cloud::<V>(&mut Rng::new(5));
        let tree = Tree::new(&spheres);
        for (scale, is_kept) in
            [(0.1, true), (0.9, true), (1.05, true), (1.055, true), (1.065, false), (1.1, false)]
        {
            let scaled: Vec<Sphere<V>> = spheres
                .iter()
                .map(|sphere| {
                    let center = V::from_f64(sphere.center.to_f64() * scale);
                    Sphere::new(center, V::Scalar::from_f64(sphere.radius.into() * scale))
                })
                .collect();
            assert_eq!(tree.clone().refit(&scaled), is_kept, "{scale}");
        }
    }

    #[test]
    fn keeps_a_tree_that_has_grown_by_little_in_both_precisions() {
        keeps_a_tree_that_has_grown_by_little::<glam::Vec3>();
        keeps_a_tree_that_has_grown_by_little::<DVec3>();
    }

    /// Spheres apart and those that no ray can hit are moved, too, and do not make it build anew.
    #[test]
    fn moves_spheres_of_each_kind() {
        for apart in [0, 2] {
            let mut rng = Rng::new(3);
            let mut spheres = cloud::<glam::Vec3>(&mut rng);
            for index in [7, 4000] {
                spheres[index].radius = -1.0;
            }
            for sphere in &mut spheres[..apart] {
                sphere.radius = 1e3;
            }
            let mut tree = Tree::new(&spheres);
            assert_eq!((tree.apart.len(), tree.unreachable.len()), (apart, 2));
            for sphere in &mut spheres {
                sphere.center.y += 0.01;
            }
            assert!(tree.refit(&spheres));
            for (index, sphere) in spheres.iter().enumerate() {
                assert_eq!(tree.get(index), Some(*sphere), "{index}");
            }
        }
    }

    #[test]
    fn keeps_a_tree_that_is_good_in_both_precisions() {
        keeps_a_tree_that_is_good::<glam::Vec3>();
        keeps_a_tree_that_is_good::<DVec3>();
    }
}
