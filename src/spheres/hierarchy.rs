//! Many spheres, sorted once into a hierarchy of boxes.

mod boxes;
mod build;
mod leaf;
mod walk;

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use boxes::Boxes;
use leaf::Leaf;

use super::Spheres;
use super::lanes::Lanes;
use crate::{Hit, Hittable, Ray, Sphere};

/// Many spheres in `f32`, sorted once into a bounding volume hierarchy, of which a ray meets the nearest.
///
/// It answers what [`nearest`](crate::nearest) answers for a slice of the same spheres, bit for bit: the same index, the lowest
/// among equal distances, and the same hit. It skips spheres in groups whose boxes the ray does not enter, or enters beyond the
/// nearest hit so far; what these tests may be off by is bounded, so that they never skip a sphere that is hit.
///
/// Any spheres are allowed. Those that nothing can meet, with a NaN, an infinity or a negative radius, cost nothing. Up to 16
/// that are much larger than how far apart the others lie, such as the ground that they stand on, are kept apart and tested by
/// each ray. One with a coordinate or a radius beyond 2⁶⁰ is asked exactly by every ray. So are all spheres by a ray whose
/// origin is farther than 2⁶⁰ from the world's, or whose direction is longer than that or shorter than 2⁻³⁰.
///
/// # When to use it
///
/// For more than some hundred spheres that stay as they are: they cannot be changed, only sorted again, which takes a
/// million less than half a second. For few spheres it is a [`Spheres`], which can be changed one by one. It takes 26 bytes a
/// sphere. (`cargo bench --manifest-path benches/peers/Cargo.toml --bench many_spheres` measures it beside other libraries, and
/// `examples/many_spheres` shows it at work.)
///
/// # How
///
/// Nodes are 16 boxes wide, and leaves 16 spheres, as wide as the widest vectors (Wald, Benthin and Boulos, *Getting Rid of
/// Packets*, 2008). Every block is full, so the tree is implicit and has no pointers. The instructions are those that
/// [`Spheres`] uses.
///
/// ```
/// use eyeray::{Ray, Sphere, SphereBvh};
/// use glam::{Vec3, vec3};
///
/// // A square of 90,000 spheres, seen from above.
/// let spheres: SphereBvh = (0..300_u16)
///     .flat_map(|i| (0..300_u16).map(move |k| vec3(f32::from(i), 0.0, f32::from(k))))
///     .map(|center| Sphere::new(center, 0.25))
///     .collect();
///
/// let down = Ray::new(vec3(7.0, 10.0, 12.0), Vec3::NEG_Y);
/// let found = spheres.nearest(&down, 0.0..f32::INFINITY);
/// assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((7 * 300 + 12, 9.75)));
/// ```
#[derive(Clone)]
pub struct SphereBvh(Shape);

#[derive(Clone)]
enum Shape {
    /// So few that a scan is faster; or more than an index of 32 bits can tell apart.
    Scan(Spheres),
    Tree(Tree),
}

/// The spheres in leaves of 16, and the leaves in boxes, 16 to a node, up to one root. All are full but the last of each level:
/// the children of node n are the nodes from 16 n on of the level below, and no pointers are kept.
#[derive(Clone, Debug)]
struct Tree {
    leaves: Vec<Leaf>,
    /// The levels above the leaves, the root first.
    nodes: Vec<Boxes>,
    /// Where in `nodes` each level begins. Level 0 is that of the leaves.
    first: [u32; LEVELS],
    /// The level of the root.
    top: u32,
    /// The largest coordinate of all boxes.
    largest_coordinate: f32,
    /// The spheres whose boxes would make those of all others useless, and what cannot be computed with, by ascending index.
    apart: Spheres,
    /// Their indices.
    apart_indices: Vec<u32>,
    /// The spheres that nothing can meet.
    unreachable: Vec<Sphere>,
    /// Where each sphere is: in a lane of a leaf, or else behind them, apart, or else unreachable.
    places: Vec<u32>,
}

/// 16⁸ = 2³² spheres would have leaves and 7 levels above them.
const LEVELS: usize = 8;

impl SphereBvh {
    /// Returns the number of spheres.
    #[inline]
    pub fn len(&self) -> usize {
        match &self.0 {
            Shape::Scan(spheres) => spheres.len(),
            Shape::Tree(tree) => tree.places.len(),
        }
    }

    /// Returns whether there are no spheres.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the sphere at `index`, as it was given.
    pub fn get(&self, index: usize) -> Option<Sphere> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.get(index),
            Shape::Tree(tree) => tree.at_place(*tree.places.get(index)?),
        }
    }

    /// Returns an iterator over the spheres by ascending index, as they were given.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Sphere> + DoubleEndedIterator + Clone + '_ {
        // There is a sphere at each of these indices.
        (0..self.len()).map(|index| self.get(index).unwrap_or_default())
    }

    /// Returns which sphere the ray meets first with `t` in `range`, and where: of equal `t`, the lowest index.
    #[inline]
    pub fn nearest(&self, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.nearest(ray, range),
            Shape::Tree(tree) => tree.nearest(Lanes::best(), ray, range),
        }
    }

    /// A tree, however few the spheres are.
    #[cfg(test)]
    pub(super) fn tree(spheres: &Spheres) -> Self {
        Self(Shape::Tree(Tree::new(spheres)))
    }

    /// The same with that set of instructions.
    #[cfg(test)]
    pub(super) fn nearest_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray,
        range: Range<f32>,
    ) -> Option<(usize, Hit)> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.nearest_in_lanes(lanes, ray, range),
            Shape::Tree(tree) => tree.nearest(lanes, ray, range),
        }
    }

    /// [`Hittable::occludes`] with that set of instructions.
    #[cfg(test)]
    pub(super) fn occludes_in_lanes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        match &self.0 {
            Shape::Scan(spheres) => spheres.occludes_in_lanes(lanes, ray, range),
            Shape::Tree(tree) => tree.occludes(lanes, ray, range),
        }
    }
}

impl Tree {
    /// The sphere at one of the `places`.
    fn at_place(&self, place: u32) -> Option<Sphere> {
        let place = place as usize;
        if let Some(leaf) = self.leaves.get(place / Leaf::LANES) {
            return Some(leaf.sphere(place % Leaf::LANES));
        }
        let place = place - self.leaves.len() * Leaf::LANES;
        self.apart.get(place).or_else(|| self.unreachable.get(place - self.apart.len()).copied())
    }
}

impl Hittable for SphereBvh {
    #[inline]
    fn intersect(&self, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        self.nearest(ray, range).map(|(_, hit)| hit)
    }

    /// Stops at the first sphere found that blocks the ray.
    #[inline]
    fn occludes(&self, ray: &Ray, range: Range<f32>) -> bool {
        match &self.0 {
            Shape::Scan(spheres) => spheres.occludes(ray, range),
            Shape::Tree(tree) => tree.occludes(Lanes::best(), ray, range),
        }
    }
}

/// No spheres.
impl Default for SphereBvh {
    fn default() -> Self {
        Self(Shape::Scan(Spheres::new()))
    }
}

/// Prints the spheres as a list, in the order in which they were given.
impl fmt::Debug for SphereBvh {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}

impl FromIterator<Sphere> for SphereBvh {
    fn from_iter<I: IntoIterator<Item = Sphere>>(iter: I) -> Self {
        iter.into_iter().collect::<Spheres>().into()
    }
}
