//! Sorts spheres into the hierarchy.

use alloc::vec::Vec;

use arrayvec::ArrayVec;
use glam::Vec4;

use super::Tree;
use super::bounds::Bounds;
use super::leaf::{Leaf, NONE};
use super::split::split_up;
use super::wide::Wide;
use crate::rejection::can_be_hit;
use crate::spheres::filter::is_in_reach;
use crate::spheres::lanes::{LANES, Lanes};
use crate::spheres::local::{narrow, to_f32};
use crate::{Scalar, Sphere, Vector};

/// Up to so many spheres, as a multiple of the numbers in a vector, a scan takes no longer than the hierarchy.
const FEW: usize = 20;

/// How many spheres a hierarchy has at most: the places of all, with the lanes of leaves that are not full, are numbers of 32
/// bits.
pub(super) const MOST: usize = 1 << 31;

/// How many large spheres are kept apart at most: one block for the scan to filter.
const APART: usize = LANES;

/// A sphere is large if its radius is more than the extent of the others divided by this.
const LARGE: f32 = 4.0;

/// A sphere, and its place in the order in which the spheres were given.
#[derive(Clone, Copy)]
pub(super) struct Member {
    /// The center, relative to that of the region, and the radius, in a vector.
    pub(super) sphere: Vec4,
    pub(super) index: u32,
}

impl Member {
    #[inline(always)]
    pub(super) fn new<V: Vector>(index: u32, sphere: &Sphere<V>, center: V) -> Self {
        let Sphere { center: own, radius } = *sphere;
        Self { sphere: narrow(own - center).extend(to_f32(radius)), index }
    }
}

/// Whether a tree answers sooner than a scan, of so many spheres and with these instructions, and can be built.
pub(super) fn is_tree(count: usize, lanes: Lanes) -> bool {
    count > FEW * lanes.at_a_time() && count <= MOST
}

impl<V: Vector> Tree<V> {
    /// Sorts [`MOST`] spheres at most.
    pub(super) fn new(spheres: &[Sphere<V>]) -> Self {
        let mut members = Vec::with_capacity(spheres.len());
        let mut apart = Vec::new();
        let mut unreachable = Vec::new();
        for (index, sphere) in (0..).zip(spheres) {
            if !can_be_hit(sphere) {
                unreachable.push(index);
            } else if !is_in_reach(sphere) {
                apart.push(index);
            } else {
                members.push(Member::new(index, sphere, V::ZERO));
            }
        }
        set_apart_the_large(&mut members, &mut apart);
        apart.sort_unstable();
        let binary = split_up(&mut members, spheres);
        let mut wide = Wide::new(spheres, &members, &binary, alloc::vec![0; spheres.len()]);
        wide.make();
        let Wide { leaves, nodes, regions, mut places, .. } = wide;

        let behind = number(leaves.len() * LANES);
        for (place, &index) in (behind..).zip(apart.iter().chain(&unreachable)) {
            places[index as usize] = place;
        }
        Self {
            leaves,
            nodes,
            regions,
            apart: apart.iter().map(|&index| spheres[index as usize]).collect(),
            apart_indices: apart,
            unreachable: unreachable.iter().map(|&index| spheres[index as usize]).collect(),
            places,
        }
    }
}

/// A number that 32 bits hold, for there are at most [`MOST`] spheres.
#[expect(clippy::cast_possible_truncation, reason = "it is not beyond them")]
pub(super) fn number(number: usize) -> u32 {
    number as u32
}

/// The leaf of up to 16 of the spheres, and the box around it. In each lane that is left is a point, which hardly a ray comes
/// near, with an index that tells it.
pub(super) fn leaf<V: Vector>(
    members: &[Member],
    spheres: &[Sphere<V>],
) -> Option<(Leaf<V::Scalar>, Bounds)> {
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

/// Moves the few members that are as large as all others together, such as the ground that they stand on: every box that held
/// one would be in the way of nearly every ray.
fn set_apart_the_large(members: &mut Vec<Member>, apart: &mut Vec<u32>) {
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
            apart.push(members.swap_remove(place).index);
        }
    }
}
