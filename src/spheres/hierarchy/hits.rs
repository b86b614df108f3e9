//! The crossings of a ray with the spheres of a hierarchy, in order: the box that the ray enters first is opened first, and a crossing
//! is given once no box begins at or before it.

use core::ops::Range;

use super::build::number;
use super::leaf::{Leaf, NONE};
use super::walk::{self, Enter, Key, Near, Query};
use super::{LEAF, Tree};
use crate::spheres::crossings::{Crossings, Places};
use crate::spheres::filter::Segment;
use crate::spheres::lanes::Lanes;
use crate::spheres::queue::Queue;
use crate::{Hit, Ray, Sphere};

/// For how many nodes and leaves that wait there is room without allocating.
const FEW: usize = 32;

impl Places for &Tree {
    #[inline(always)]
    fn sphere(&self, place: usize) -> Option<Sphere> {
        self.at_place(number(place))
    }

    fn index(&self, place: usize) -> usize {
        let (leaf, lane) = (place / Leaf::LANES, place % Leaf::LANES);
        let index = match self.leaves.get(leaf) {
            Some(leaf) => leaf.index(lane),
            // Nothing crosses what is behind these.
            None => self
                .apart_indices
                .get(place - self.leaves.len() * Leaf::LANES)
                .copied()
                .unwrap_or(NONE),
        };
        index as usize
    }
}

/// An iterator over the crossings.
#[derive(Clone)]
pub(in crate::spheres) struct Hits<'a> {
    lanes: Lanes,
    is_begun: bool,
    query: Query,
    /// The nodes and leaves that the ray enters and that were not opened yet.
    waiting: Queue<Key, FEW>,
    crossings: Crossings<&'a Tree>,
}

impl<'a> Hits<'a> {
    #[inline(always)]
    pub(super) fn new(tree: &'a Tree, lanes: Lanes, ray: &Ray, range: Range<f32>) -> Self {
        Self {
            lanes,
            is_begun: false,
            query: Query::new(tree, ray, &range),
            waiting: Queue::new(),
            crossings: Crossings::new(tree, ray, range),
        }
    }

    /// Asks what is apart, and begins at the root.
    #[inline(never)]
    fn begin(&mut self) {
        let Self { lanes, waiting, crossings, .. } = self;
        let (tree, ray, range) = (crossings.places, crossings.ray, crossings.range.clone());
        if Segment::allows(&ray) {
            waiting.push(walk::key(0.0, tree.root), Key::lt);
            let behind_leaves = tree.leaves.len() * Leaf::LANES;
            if !tree.apart.is_empty() {
                tree.apart.for_each_near(*lanes, &ray, range, |place| {
                    crossings.ask(behind_leaves + place);
                });
            }
        } else if ray.origin.is_finite() && ray.direction.is_finite() {
            for &place in &tree.places {
                crossings.ask(place as usize);
            }
        }
    }

    /// Opens a node or a leaf.
    #[inline(always)]
    fn open(&mut self, place: u32) {
        let Self { lanes, query, waiting, crossings, .. } = self;
        if place & LEAF == 0 {
            let Some(node) = crossings.places.nodes.get(place as usize) else { return };
            let mut entered = lanes.run(Enter { node, query });
            while entered != 0 {
                let lane = entered.trailing_zeros();
                entered &= entered - 1;
                waiting.push(walk::key(query.entry(lane), node.child(lane)), Key::lt);
            }
        } else {
            let place = (place & !LEAF) as usize;
            let Some(leaf) = crossings.places.leaves.get(place) else { return };
            let mut near = lanes.run(Near { leaf, query });
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                if leaf.index(lane) != NONE {
                    crossings.ask(place * Leaf::LANES + lane);
                }
            }
        }
    }
}

impl Iterator for Hits<'_> {
    type Item = (usize, Hit);

    fn next(&mut self) -> Option<(usize, Hit)> {
        if self.is_begun {
            self.crossings.ask_for_exit();
        } else {
            self.is_begun = true;
            self.begin();
        }
        while let Some(&key) = self.waiting.first() {
            if self.crossings.first().is_some_and(|t| t < walk::entry(key)) {
                break;
            }
            self.waiting.pop(Key::lt);
            self.open(walk::child(key));
        }
        self.crossings.take()
    }
}
