//! The crossings of a ray with the spheres of a hierarchy, in order: the box that the ray enters first is opened first, and a
//! crossing is given once no box begins at or before it.
//!
//! What waits may be in different regions ([`region`](super::region)), and is compared by where the ray enters it from its
//! origin. The way through a region is found anew each time that the next node is in another one: regions are rare.

use core::ops::Range;

use super::boxes::LEAF;
use super::leaf::{Leaf, NONE};
use super::number::number;
use super::tree::Tree;
use super::visits::{self, Visit};
use super::walk::{Enter, Query, allows};
use crate::order::next_above;
use crate::spheres::crossings::{Crossings, Places};
use crate::spheres::lanes::Lanes;
use crate::spheres::queue::Queue;
use crate::{Hit, Ray, Scalar, Sphere, Vector};

/// For how many nodes and leaves that wait there is room without allocating.
const FEW: usize = 32;

impl<V: Vector> Places<V> for &Tree<V> {
    #[inline(always)]
    fn sphere(&self, place: usize) -> Option<Sphere<V>> {
        self.at_place(number(place))
    }

    fn index(&self, place: usize) -> usize {
        let lanes = Leaf::<V::Scalar>::LANES;
        let index = if let Some(leaf) = self.leaves.get(place / lanes) {
            leaf.index(place % lanes)
        } else {
            // Nothing crosses what is behind those apart.
            let apart = place - self.leaves.len() * lanes;
            self.apart_indices.get(apart).copied().unwrap_or(NONE)
        };
        index as usize
    }
}

/// A node or a leaf that waits.
#[derive(Clone, Copy)]
struct Waiting {
    /// No crossing in it has an exact t below that.
    entry: f64,
    /// What it is.
    child: u32,
    /// The region that it is in.
    region: u32,
}

impl Waiting {
    #[inline(always)]
    fn is_before(&self, other: &Self) -> bool {
        self.entry < other.entry
    }
}

/// An iterator over the crossings.
#[derive(Clone)]
pub(in crate::spheres) struct Hits<'a, V: Vector> {
    lanes: Lanes,
    is_begun: bool,
    query: Query<V::Scalar>,
    /// The region that the query is in.
    region: u32,
    /// The nodes and leaves that the ray enters and that were not opened yet.
    waiting: Queue<Waiting, FEW>,
    crossings: Crossings<V, &'a Tree<V>>,
}

impl<'a, V: Vector> Hits<'a, V> {
    #[inline(always)]
    pub(in crate::spheres) fn new(
        tree: &'a Tree<V>,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Self {
        Self {
            lanes,
            is_begun: false,
            query: Query::default(),
            region: 0,
            waiting: Queue::new(),
            crossings: Crossings::new(tree, ray, range),
        }
    }

    /// Asks what is apart, and begins at the root.
    #[inline(never)]
    fn begin(&mut self) {
        let Self { lanes, query, waiting, crossings, .. } = self;
        let (tree, ray, range) = (crossings.places, crossings.ray, crossings.range.clone());
        if allows(&ray) {
            if let Some(whole) = tree.regions.first() {
                // Otherwise, an end that is NaN would open no box.
                if range.end > V::Scalar::ZERO && query.enter(whole, &ray, range.clone()) {
                    let root = Waiting { entry: 0.0, child: whole.root, region: 0 };
                    waiting.push(root, Waiting::is_before);
                }
            }
            let behind_leaves = tree.leaves.len() * Leaf::<V::Scalar>::LANES;
            if !tree.apart.is_empty() {
                tree.apart.for_each_near(*lanes, &ray, &range, |place| {
                    crossings.ask(behind_leaves + place);
                });
            }
        } else if ray.origin.to_f64().is_finite() && ray.direction.to_f64().is_finite() {
            for &place in &tree.places {
                crossings.ask(place as usize);
            }
        }
    }

    /// Opens a node or a leaf.
    #[inline(always)]
    fn open(&mut self, Waiting { entry, child, region }: Waiting) {
        if region != self.region {
            self.go_back(region);
        }
        let Self { lanes, query, waiting, crossings, .. } = self;
        if child & LEAF == 0 {
            let Some(node) = crossings.places.nodes.get(child as usize) else { return };
            visits::count(Visit::Node);
            let mut entered = lanes.run(Enter { node, query });
            if entered == 0 {
                if let Some(inner) = node.region() {
                    self.go_inside(inner, entry);
                }
                return;
            }
            while entered != 0 {
                let lane = entered.trailing_zeros();
                entered &= entered - 1;
                let entry = from_the_origin(query.entry(lane), query.way.moved);
                let child = Waiting { entry, child: node.child(lane), region };
                waiting.push(child, Waiting::is_before);
            }
        } else {
            let place = (child & !LEAF) as usize;
            let Some(leaf) = crossings.places.leaves.get(place) else { return };
            visits::count(Visit::Leaf);
            let mut near = query.near(*lanes, leaf);
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                if leaf.index(lane) != NONE {
                    visits::count(Visit::Sphere);
                    crossings.ask(place * Leaf::<V::Scalar>::LANES + lane);
                }
            }
        }
    }

    /// Goes into a region for the first time.
    #[cold]
    #[inline(never)]
    fn go_inside(&mut self, region: u32, entry: f64) {
        let Crossings { places, ray, range, .. } = &self.crossings;
        let Some(inside) = places.regions.get(region as usize) else { return };
        if self.query.enter(inside, ray, range.clone()) {
            self.region = region;
            let root = Waiting { entry, child: inside.root, region };
            self.waiting.push(root, Waiting::is_before);
        }
    }

    /// Goes back into a region.
    #[cold]
    #[inline(never)]
    fn go_back(&mut self, region: u32) {
        let Crossings { places, ray, range, .. } = &self.crossings;
        let Some(back) = places.regions.get(region as usize) else { return };
        self.query.enter_again(back, ray, range.clone());
        self.region = region;
    }
}

/// Where the ray enters what it enters at `entry` after it begins anew, rounded downwards.
#[inline(always)]
fn from_the_origin(entry: f32, moved: f64) -> f64 {
    if moved == 0.0 {
        entry.into()
    } else {
        let entry = moved + f64::from(entry);
        entry - entry * f64::EPSILON
    }
}

impl<V: Vector> Iterator for Hits<'_, V> {
    type Item = (usize, Hit<V>);

    fn next(&mut self) -> Option<(usize, Hit<V>)> {
        if self.is_begun {
            self.crossings.ask_for_exit();
        } else {
            self.is_begun = true;
            self.begin();
        }
        while let Some(&next) = self.waiting.first() {
            // What has an exact t from the float above on has no t, rounded, that is equal.
            if self.crossings.first().is_some_and(|t| next_above::<V>(t).into() <= next.entry) {
                break;
            }
            self.waiting.pop(Waiting::is_before);
            self.open(next);
        }
        self.crossings.take()
    }
}
