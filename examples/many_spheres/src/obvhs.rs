//! Spheres in a hierarchy of another library, for comparison: the crate obvhs builds it and goes through it, eyeray gives it the
//! boxes and says what a ray meets.
//!
//! Of the two layouts that obvhs has, this is the one with eight compressed boxes to a node: the binary one was slower in
//! clouds of every size.

use std::time::Duration;

use eyeray::{Hit, Hittable, Ray, Sphere};
use glam::{UVec2, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::{BvhBuildParams, traverse};

pub(crate) struct Hierarchy {
    tree: CwBvh,
    /// In the order of the leaves, so that neighbors in space are neighbors in memory.
    spheres: Vec<Sphere>,
}

/// By how much each box is larger than it need be.
///
/// A box that contains its sphere is not enough: the crate computes in `f32` where the ray enters and leaves the box, and could
/// miss it by rounding. Over the 6,000 that a ray may go from the eye to the far side of the cloud, the six
/// roundings on the way make at most 0.003, and that the crate takes the coordinates of a direction below 2⁻²³ for 2⁻²³
/// makes 0.001, for directions of about unit length. To those, it also matters that the crate skips boxes that the ray
/// leaves before `t` = 0.0001.
const PADDING: f32 = 1.0 / 64.0;

impl Hierarchy {
    pub(crate) fn new(spheres: &[Sphere]) -> Self {
        let boxes: Vec<Aabb> = spheres
            .iter()
            .map(|sphere| {
                let (low, high) = sphere.bounds();
                Aabb::new(Vec3A::from(low) - PADDING, Vec3A::from(high) + PADDING)
            })
            .collect();
        // With the slower builds, queries are hardly any faster.
        let tree = build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        let spheres = tree.primitive_indices.iter().map(|&index| spheres[index as usize]).collect();
        Self { tree, spheres }
    }

    /// Returns the nearest hit and its index, as [`eyeray::nearest`] does: of equal `t`, the lowest index.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        let mut found: Option<(u32, Hit)> = None;
        let Ray { origin, direction } = *ray;
        // Its end is the nearest hit so far: boxes that begin beyond are skipped.
        let mut segment = obvhs::ray::Ray::new(origin.into(), direction.into(), 0.0, f32::INFINITY);
        let mut state = self.tree.new_traversal(segment.direction);
        let mut node;
        traverse!(self.tree, node, state, node.intersect_ray(&segment, state.oct_inv4), {
            let leaf = state.primitive_id as usize;
            if let Some(hit) = self.spheres[leaf].intersect(ray, 0.0..f32::INFINITY) {
                let index = self.tree.primitive_indices[leaf];
                // The leaves come in no order: an equal `t` may be that of a lower index.
                if found.is_none_or(|(lowest, nearest)| (hit.t, index) < (nearest.t, lowest)) {
                    segment.tmax = hit.t;
                    found = Some((index, hit));
                }
            }
        });
        found.map(|(index, hit)| (index as usize, hit))
    }
}
