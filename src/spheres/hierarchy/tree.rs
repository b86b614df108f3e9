//! The hierarchy: what it keeps, and where each sphere is in it.

use alloc::vec::Vec;

use super::boxes::Boxes;
use super::leaf::Leaf;
use super::region::Region;
use crate::spheres::Spheres;
use crate::{Sphere, Vector};

/// The spheres in leaves of up to 16, and the leaves in boxes, up to 16 to a node. The children of a node lie together: first its
/// leaves among all leaves, then its nodes among all nodes.
#[derive(Clone, Debug)]
pub(in crate::spheres) struct Tree<V: Vector> {
    pub(super) leaves: Vec<Leaf<V::Scalar>>,
    pub(super) nodes: Vec<Boxes>,
    /// The whole tree, where a ray begins, and the parts of it that have coordinates of their own. There are none without
    /// spheres.
    pub(super) regions: Vec<Region<V>>,
    /// The spheres whose boxes would make those of all others useless, and what cannot be computed with, by ascending index.
    pub(super) apart: Spheres<V>,
    /// Their indices.
    pub(super) apart_indices: Vec<u32>,
    /// The spheres that nothing can meet.
    pub(super) unreachable: Vec<Sphere<V>>,
    /// Where each sphere is: in a lane of a leaf, or else behind them, apart, or else unreachable.
    pub(super) places: Vec<u32>,
    /// The sizes of boxes as they were built, once spheres have moved.
    pub(super) sizes: Vec<f32>,
}

impl<V: Vector> Tree<V> {
    /// The sphere at `index`.
    pub(super) fn get(&self, index: usize) -> Option<Sphere<V>> {
        self.at_place(*self.places.get(index)?)
    }

    /// The sphere at one of the `places`.
    pub(super) fn at_place(&self, place: u32) -> Option<Sphere<V>> {
        let place = place as usize;
        if let Some(leaf) = self.leaves.get(place / Leaf::<V::Scalar>::LANES) {
            return Some(leaf.sphere(place % Leaf::<V::Scalar>::LANES));
        }
        let place = place - self.leaves.len() * Leaf::<V::Scalar>::LANES;
        self.apart.get(place).or_else(|| self.unreachable.get(place - self.apart.len()).copied())
    }
}
