//! Sorts spheres into the hierarchy.

use alloc::vec::Vec;

use glam::Vec3;

use super::boxes::{Boxes, LEAST_COORDINATE};
use super::leaf::Leaf;
use super::{LEVELS, Shape, SphereBvh, Tree};
use crate::spheres::Spheres;
use crate::spheres::filter::{can_be_met, is_in_reach};
use crate::spheres::lanes::LANES;
use crate::Sphere;

/// Up to so many spheres, a scan is as fast.
const FEW: usize = 64;

/// Up to so many spheres, a place is a number of 32 bits, those of lanes without a sphere included.
const MOST: usize = (u32::MAX - 64) as usize;

/// How many spheres are kept apart at most, if they can be computed with.
const APART: usize = 16;

#[derive(Clone, Copy)]
struct Member {
    sphere: Sphere,
    index: u32,
}

impl From<Spheres> for SphereBvh {
    fn from(spheres: Spheres) -> Self {
        let is_tree = (FEW + 1..=MOST).contains(&spheres.len());
        Self(if is_tree { Shape::Tree(Tree::new(&spheres)) } else { Shape::Scan(spheres) })
    }
}

impl Tree {
    /// Of [`MOST`] spheres at most.
    pub(super) fn new(spheres: &Spheres) -> Self {
        let count = spheres.len();
        let mut members = Vec::with_capacity(count);
        let mut apart = Vec::new();
        let mut unreachable = Vec::new();
        for (index, sphere) in (0..).zip(spheres) {
            let member = Member { sphere, index };
            if !can_be_met(&sphere) {
                unreachable.push(member);
            } else if !is_in_reach(&sphere) {
                apart.push(member);
            } else {
                members.push(member);
            }
        }
        set_apart_large(&mut members, &mut apart);
        apart.sort_unstable_by_key(|member| member.index);
        arrange(&mut members);

        let leaves: Vec<Leaf> = members
            .chunks(LANES)
            .map(|members| {
                let mut leaf = Leaf::filled(members[0].index, members[0].sphere);
                for (lane, member) in members.iter().enumerate() {
                    leaf.set(lane, member.index, member.sphere);
                }
                leaf
            })
            .collect();
        let bounds_of = |members: &[Member]| {
            members.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), member| {
                let bounds = member.sphere.bounds();
                (low.min(bounds.0), high.max(bounds.1))
            })
        };
        let mut bounds: Vec<(Vec3, Vec3)> = members.chunks(LANES).map(bounds_of).collect();
        let largest_coordinate = bounds
            .iter()
            .map(|(low, high)| low.abs().max(high.abs()).max_element())
            .fold(LEAST_COORDINATE, f32::max);
        let mut levels: Vec<Vec<Boxes>> = Vec::new();
        while bounds.len() > 1 {
            let level: Vec<Boxes> = bounds
                .chunks(LANES)
                .map(|bounds| {
                    let mut boxes = Boxes::EMPTY;
                    for (lane, &bounds) in bounds.iter().enumerate() {
                        boxes.set(lane, bounds);
                    }
                    boxes
                })
                .collect();
            bounds = level.iter().map(Boxes::bounds).collect();
            levels.push(level);
        }
        let top = levels.len();
        let mut first = [0; LEVELS];
        let mut nodes = Vec::new();
        for (level, boxes) in levels.into_iter().enumerate().rev() {
            first[level + 1] = nodes.len() as u32;
            nodes.extend(boxes);
        }

        let mut places = alloc::vec![0; count];
        for (place, member) in (0..).zip(&members) {
            places[member.index as usize] = place;
        }
        let behind = (leaves.len() * LANES) as u32;
        for (place, member) in (behind..).zip(apart.iter().chain(&unreachable)) {
            places[member.index as usize] = place;
        }
        Self {
            leaves,
            nodes,
            first,
            top: top as u32,
            largest_coordinate,
            apart: apart.iter().map(|member| member.sphere).collect(),
            apart_indices: apart.iter().map(|member| member.index).collect(),
            unreachable: unreachable.iter().map(|member| member.sphere).collect(),
            places,
        }
    }
}

fn extent(members: &[Member]) -> Vec3 {
    let (low, high) = members.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), member| {
        (low.min(member.sphere.center), high.max(member.sphere.center))
    });
    high - low
}

fn set_apart_large(members: &mut Vec<Member>, apart: &mut Vec<Member>) {
    if members.len() <= APART {
        return;
    }
    let rest = members.len() - APART;
    members.select_nth_unstable_by(rest, |a, b| a.sphere.radius.total_cmp(&b.sphere.radius));
    let large = extent(&members[..rest]).max_element() / 4.0;
    for place in (rest..members.len()).rev() {
        if members[place].sphere.radius > large {
            apart.push(members.swap_remove(place));
        }
    }
}

/// Sorts the members so that 16 of them in a row are a leaf, 16 leaves in a row a node, and so on.
fn arrange(mut members: &mut [Member]) {
    while members.len() > LANES {
        let mut unit = LANES;
        while unit * LANES < members.len() {
            unit *= LANES;
        }
        let half = members.len().div_ceil(unit) / 2 * unit;
        let extent = extent(members);
        let axis = extent.max_position();
        members.select_nth_unstable_by(half, |a, b| {
            a.sphere.center[axis].total_cmp(&b.sphere.center[axis])
        });
        let (left, right) = members.split_at_mut(half);
        arrange(left);
        members = right;
    }
}
