//! Sorts spheres into the hierarchy.
//!
//! The spheres are halved by the median of their centers, along the axis on which these are farthest apart, until 16 are left:
//! a leaf. Each half is rounded to whole subtrees, so that every block of 16 is full. A surface-area heuristic in place of the
//! median, which costs as much to build as all else, was faster by a tenth among clusters, and slower on a plane.

use alloc::vec::Vec;

use glam::Vec3;

use super::boxes::{Boxes, LEAST_COORDINATE};
use super::leaf::Leaf;
use super::{LEVELS, Shape, SphereBvh, Tree};
use crate::Sphere;
use crate::spheres::Spheres;
use crate::spheres::filter::{can_be_met, is_in_reach};
use crate::spheres::lanes::{LANES, Lanes};

/// Up to so many spheres, as a multiple of the numbers in a vector, a scan takes no longer than the hierarchy.
const FEW: usize = 20;

/// How many spheres a hierarchy has at most: the places of all, and of the lanes of the last leaf, are numbers of 32 bits.
const MOST: usize = u32::MAX as usize - LANES;

/// How many large spheres are kept apart at most: one block for the scan to filter.
const APART: usize = LANES;

/// A sphere is large if its radius is more than the extent of the others divided by this.
const LARGE: f32 = 4.0;

/// A sphere, and its place in the order in which the spheres were given.
#[derive(Clone, Copy)]
struct Member {
    sphere: Sphere,
    index: u32,
}

impl From<Spheres> for SphereBvh {
    fn from(spheres: Spheres) -> Self {
        let few = FEW * Lanes::best().at_a_time();
        let is_tree = spheres.len() > few && spheres.len() <= MOST;
        Self(if is_tree { Shape::Tree(Tree::new(&spheres)) } else { Shape::Scan(spheres) })
    }
}

impl Tree {
    /// Sorts [`MOST`] spheres at most.
    pub(super) fn new(spheres: &Spheres) -> Self {
        let mut members = Vec::with_capacity(spheres.len());
        let mut apart = Vec::new();
        let mut unreachable = Vec::new();
        for (index, sphere) in (0..).zip(spheres) {
            let kind = if !can_be_met(&sphere) {
                &mut unreachable
            } else if !is_in_reach(&sphere) {
                &mut apart
            } else {
                &mut members
            };
            kind.push(Member { sphere, index });
        }
        set_apart_the_large(&mut members, &mut apart);
        apart.sort_unstable_by_key(|member| member.index);
        arrange(&mut members);

        let leaves: Vec<Leaf> = members.chunks(LANES).filter_map(leaf).collect();
        let mut bounds: Vec<(Vec3, Vec3)> = members.chunks(LANES).map(bounds_of).collect();
        let largest_coordinate = bounds
            .iter()
            .map(|(low, high)| low.abs().max(high.abs()).max_element())
            .fold(LEAST_COORDINATE, f32::max);
        let mut levels: Vec<Vec<Boxes>> = Vec::new();
        while bounds.len() > 1 {
            let level: Vec<Boxes> = bounds.chunks(LANES).map(node).collect();
            bounds = level.iter().map(Boxes::bounds).collect();
            levels.push(level);
        }
        let mut first = [0; LEVELS];
        let mut nodes = Vec::with_capacity(levels.iter().map(Vec::len).sum());
        for (level, boxes) in levels.iter().enumerate().rev() {
            first[level + 1] = number(nodes.len());
            nodes.extend_from_slice(boxes);
        }

        let mut places = alloc::vec![0; spheres.len()];
        let behind = number(leaves.len() * LANES);
        for (place, member) in
            (0..).zip(&members).chain((behind..).zip(apart.iter().chain(&unreachable)))
        {
            places[member.index as usize] = place;
        }
        Self {
            leaves,
            nodes,
            first,
            top: number(levels.len()),
            largest_coordinate,
            apart: apart.iter().map(|member| member.sphere).collect(),
            apart_indices: apart.iter().map(|member| member.index).collect(),
            unreachable: unreachable.iter().map(|member| member.sphere).collect(),
            places,
        }
    }
}

/// A number that 32 bits hold, for there are at most [`MOST`] spheres.
#[expect(clippy::cast_possible_truncation, reason = "it is not beyond them")]
fn number(number: usize) -> u32 {
    number as u32
}

/// The leaf of up to 16 members. Lanes that are left have the first of them again: to meet it twice changes nothing.
fn leaf(members: &[Member]) -> Option<Leaf> {
    let first = members.first()?;
    let mut leaf = Leaf::filled(first.index, first.sphere);
    for (lane, member) in members.iter().enumerate() {
        leaf.set(lane, member.index, member.sphere);
    }
    Some(leaf)
}

/// The node of up to 16 boxes.
fn node(bounds: &[(Vec3, Vec3)]) -> Boxes {
    let mut boxes = Boxes::EMPTY;
    for (lane, &bounds) in bounds.iter().enumerate() {
        boxes.set(lane, bounds);
    }
    boxes
}

/// The box around the members.
fn bounds_of(members: &[Member]) -> (Vec3, Vec3) {
    members.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), member| {
        let bounds = member.sphere.bounds();
        (low.min(bounds.0), high.max(bounds.1))
    })
}

/// How far apart the centers are, on each axis.
fn extent(members: &[Member]) -> Vec3 {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = members.iter().fold(none, |(low, high), member| {
        (low.min(member.sphere.center), high.max(member.sphere.center))
    });
    high - low
}

/// Moves the few members that are as large as all others together, such as the ground that they stand on: every box that held
/// one would be in the way of nearly every ray.
fn set_apart_the_large(members: &mut Vec<Member>, apart: &mut Vec<Member>) {
    if members.len() <= APART {
        return;
    }
    let others = members.len() - APART;
    members.select_nth_unstable_by(others, |a, b| a.sphere.radius.total_cmp(&b.sphere.radius));
    let large = extent(&members[..others]).max_element() / LARGE;
    for place in (others..members.len()).rev() {
        if members[place].sphere.radius > large {
            apart.push(members.swap_remove(place));
        }
    }
}

/// Sorts the members so that 16 of them in a row are a leaf, 16 leaves in a row a node, and so on.
fn arrange(mut members: &mut [Member]) {
    while members.len() > LANES {
        // The spheres below a child of the node that is split up.
        let mut child = LANES;
        while child * LANES < members.len() {
            child *= LANES;
        }
        let half = members.len().div_ceil(child) / 2 * child;
        let axis = extent(members).max_position();
        members.select_nth_unstable_by(half, |a, b| {
            a.sphere.center[axis].total_cmp(&b.sphere.center[axis])
        });
        let (left, right) = members.split_at_mut(half);
        arrange(left);
        members = right;
    }
}
