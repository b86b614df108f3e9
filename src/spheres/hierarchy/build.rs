//! Sorts spheres into the hierarchy.

use alloc::vec::Vec;

use glam::Vec4;

use super::number::{MOST, number};
use super::split::{Member, split_up};
use super::tree::Tree;
use super::wide::Wide;
use crate::rejection::can_be_hit;
use crate::spheres::filter::is_in_reach;
use crate::spheres::lanes::{LANES, Lanes};
use crate::{Sphere, Vector};

/// Up to so many spheres, as a multiple of the numbers in a vector, a scan takes no longer than the hierarchy.
const FEW: usize = 20;

/// How many large spheres are kept apart at most: one block for the scan to filter.
const APART: usize = LANES;

/// A sphere is large if its radius is more than the extent of the others divided by this.
const LARGE: f32 = 4.0;

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
            sizes: Vec::new(),
        }
    }
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

#[cfg(test)]
mod tests {
    use std::mem::size_of;

    use glam::{DVec3, Vec3, dvec3};
    use sobol_burley::sample;

    use super::*;
    use crate::spheres::hierarchy::boxes::Boxes;
    use crate::spheres::hierarchy::leaf::{Leaf, NONE};
    use crate::spheres::hierarchy::region::Region;

    /// A scan is as fast up to 80, 160 or 320 spheres.
    #[test]
    fn a_tree_is_for_many() {
        for lanes in Lanes::available() {
            let most = match lanes.at_a_time() {
                4 => 80,
                8 => 160,
                at_a_time => at_a_time * 20,
            };
            assert!(!is_tree(0, lanes) && !is_tree(most, lanes), "{lanes:?}");
            assert!(is_tree(most + 1, lanes) && is_tree(MOST, lanes), "{lanes:?}");
            assert!(!is_tree(MOST + 1, lanes), "{lanes:?}");
        }
    }

    /// A thousand points from 0 to 8 on the x axis, and among them spheres of these radii.
    fn apart_of(radii: &[f32]) -> Vec<u32> {
        let mut members: Vec<Member> = (0..1001_u16)
            .map(|i| Sphere::new(Vec3::X * (0.008 * f32::from(i)), 0.0))
            .chain(radii.iter().map(|&radius| Sphere::new(Vec3::X, radius)))
            .zip(0..)
            .map(|(sphere, index)| Member::new(index, &sphere, Vec3::ZERO))
            .collect();
        let count = members.len();
        let mut apart = Vec::new();
        set_apart_the_large(&mut members, &mut apart);
        assert_eq!(members.len() + apart.len(), count);
        assert!(members.iter().all(|member| !apart.contains(&member.index)));
        apart.sort_unstable();
        apart
    }

    /// Those with a radius of more than a quarter of the extent, 16 at most.
    #[test]
    fn the_large_are_set_apart() {
        assert_eq!(apart_of(&[]), []);
        assert_eq!(apart_of(&[1.9]), []);
        assert_eq!(apart_of(&[2.1]), [1001]);
        assert_eq!(apart_of(&[1.9, 1000.0, 0.1, 2.1]), [1002, 1004]);
        assert_eq!(apart_of(&[3.0; 16]), (1001..1017).collect::<Vec<_>>());
        assert_eq!(apart_of(&[3.0; 17]).len(), 16);

        // Of 16 spheres, there are no others.
        let sphere = Sphere::new(Vec3::ZERO, 1.0);
        for (count, expected) in [(16, 0), (17, 16)] {
            let mut members: Vec<Member> =
                (0..count).map(|index| Member::new(index, &sphere, Vec3::ZERO)).collect();
            let mut apart = Vec::new();
            set_apart_the_large(&mut members, &mut apart);
            assert_eq!(apart.len(), expected);
        }
    }

    /// Each kind is where it belongs.
    #[test]
    fn kinds_are_kept_apart() {
        let mut spheres: Vec<Sphere<DVec3>> = (0..100_u8)
            .map(|i| Sphere::new(dvec3(f64::from(i), f64::from(i % 10), 0.0), 0.5))
            .collect();
        spheres[7].radius = -1.0;
        spheres[9].center.x = f64::NAN;
        spheres[20].radius = 1e3;
        spheres[30].center.y = 1e20;
        let tree = Tree::new(&spheres);
        assert_eq!(tree.apart_indices, [20, 30]);
        assert_eq!(tree.apart.as_slice(), [spheres[20], spheres[30]]);
        assert_eq!(tree.unreachable[0], spheres[7]);
        assert_eq!(tree.unreachable.len(), 2);
        let in_leaves = tree
            .leaves
            .iter()
            .map(|leaf| (0..LANES).filter(|&lane| leaf.index(lane) != NONE).count());
        assert_eq!(in_leaves.sum::<usize>(), 96);
    }

    /// In `f64`, at most 56 bytes a sphere, with all that a hierarchy keeps.
    #[test]
    fn memory_is_little_in_f64() {
        for (group, extent) in [(1, 0.0), (9, 0.001), (9, 0.3), (17, 0.01), (100, 0.1), (40, 0.02)]
        {
            let random = |index, dimension| f64::from(sample(index, dimension, 8));
            let spheres: Vec<Sphere<DVec3>> = (0..10_000)
                .map(|index| {
                    let center = [0, 1, 2].map(|dimension| {
                        random(index / group, dimension) + extent * random(index, 3 + dimension)
                    });
                    Sphere::new(center.into(), 0.001)
                })
                .collect();
            let tree = Tree::new(&spheres);
            let bytes = size_of::<Leaf<f64>>() * tree.leaves.capacity()
                + size_of::<Boxes>() * tree.nodes.capacity()
                + size_of::<Region<DVec3>>() * tree.regions.capacity()
                + size_of::<u32>() * tree.places.capacity();
            assert!(bytes <= 56 * spheres.len(), "groups of {group} in {extent}: {bytes} bytes");
        }
    }
}
