//! Sorts spheres into the hierarchy.

use alloc::vec::Vec;

use glam::{Vec3, Vec4};

use super::boxes::LEAST_COORDINATE;
use super::leaf::{Leaf, NONE};
use super::split::split_up;
use super::wide::Wide;
use super::{Shape, SphereBvh, Tree};
use crate::Sphere;
use crate::spheres::Spheres;
use crate::spheres::filter::{can_be_met, is_in_reach};
use crate::spheres::lanes::{LANES, Lanes};

/// Up to so many spheres, as a multiple of the numbers in a vector, a scan takes no longer than the hierarchy.
const FEW: usize = 20;

/// How many spheres a hierarchy has at most: the places of all, with the lanes of leaves that are not full, are numbers of 32 bits.
pub(super) const MOST: usize = 1 << 31;

/// How many large spheres are kept apart at most: one block for the scan to filter.
const APART: usize = LANES;

/// A sphere is large if its radius is more than the extent of the others divided by this.
const LARGE: f32 = 4.0;

/// A sphere, and its place in the order in which the spheres were given.
#[derive(Clone, Copy)]
pub(super) struct Member {
    /// The center and the radius, in a vector.
    pub(super) sphere: Vec4,
    pub(super) index: u32,
}

impl Member {
    pub(super) fn new(index: u32, Sphere { center, radius }: Sphere) -> Self {
        Self { sphere: center.extend(radius), index }
    }

    fn sphere(&self) -> Sphere {
        Sphere::new(self.sphere.truncate(), self.sphere.w)
    }
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
            kind.push(Member::new(index, sphere));
        }
        set_apart_the_large(&mut members, &mut apart);
        apart.sort_unstable_by_key(|member| member.index);
        let splits = split_up(&mut members);
        let mut wide = Wide::new(&members, &splits, alloc::vec![0; spheres.len()]);
        let root = wide.make();
        let Wide { leaves, nodes, mut places, .. } = wide;
        let mut largest_coordinate = LEAST_COORDINATE;
        if let Some(root) = nodes.first() {
            let (low, high) = root.bounds();
            largest_coordinate = largest_coordinate.max(low.abs().max(high.abs()).max_element());
        }

        let behind = number(leaves.len() * LANES);
        for (place, member) in (behind..).zip(apart.iter().chain(&unreachable)) {
            places[member.index as usize] = place;
        }
        Self {
            leaves,
            nodes,
            root,
            largest_coordinate,
            apart: apart.iter().map(Member::sphere).collect(),
            apart_indices: apart.iter().map(|member| member.index).collect(),
            unreachable: unreachable.iter().map(Member::sphere).collect(),
            places,
        }
    }
}

/// A number that 32 bits hold, for there are at most [`MOST`] spheres.
#[expect(clippy::cast_possible_truncation, reason = "it is not beyond them")]
pub(super) fn number(number: usize) -> u32 {
    number as u32
}

/// The leaf of up to 16 members. In each lane that is left is a point, which hardly a ray comes near, with an index that tells it.
pub(super) fn leaf(members: &[Member]) -> Option<Leaf> {
    let first = members.first()?;
    let mut leaf = Leaf::filled(NONE, Sphere::new(first.sphere.truncate(), 0.0));
    for (lane, member) in members.iter().enumerate() {
        leaf.set(lane, member.index, member.sphere());
    }
    Some(leaf)
}

/// The box around the members.
pub(super) fn bounds_of(members: &[Member]) -> (Vec3, Vec3) {
    members.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), member| {
        let bounds = member.sphere().bounds();
        (low.min(bounds.0), high.max(bounds.1))
    })
}

/// Moves the few members that are as large as all others together, such as the ground that they stand on: every box that held
/// one would be in the way of nearly every ray.
fn set_apart_the_large(members: &mut Vec<Member>, apart: &mut Vec<Member>) {
    if members.len() <= APART {
        return;
    }
    let others = members.len() - APART;
    members.select_nth_unstable_by(others, |a, b| a.sphere.w.total_cmp(&b.sphere.w));
    let none = (Vec4::INFINITY, Vec4::NEG_INFINITY);
    let (low, high) = members[..others]
        .iter()
        .fold(none, |(low, high), member| (low.min(member.sphere), high.max(member.sphere)));
    let large = (high - low).truncate().max_element() / LARGE;
    for place in (others..members.len()).rev() {
        if members[place].sphere.w > large {
            apart.push(members.swap_remove(place));
        }
    }
}
