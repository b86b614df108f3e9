//! A collection of many spheres: a bounding volume hierarchy.

pub(super) mod bounds;
mod boxes;
mod build;
mod frustum;
mod hits;
mod leaf;
mod number;
mod packet;
mod refit;
mod region;
mod split;
mod tree;
mod visits;
mod walk;
mod wide;

use alloc::vec::Vec;
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;

use bounds::Bounds;
use build::is_tree;
use glam::Vec3;
pub(super) use hits::Hits;
use tree::Tree;

use super::Spheres;
use super::lanes::Lanes;
use crate::{Hit, Hittable, Ray, Sphere, Vector};

/// A collection of many spheres, which finds the nearest hit with a bounding volume hierarchy (BVH).
///
/// It returns what [`nearest`](crate::nearest) returns for a slice of the same spheres, bit for bit: the same hit and the same
/// index, that of the sphere in front, also where distances round to the same number. It skips groups of spheres whose box the
/// ray does not enter, or enters beyond the nearest hit so far. The error of these tests is bounded, so they never skip a sphere
/// that is hit.
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
///
/// Any spheres are allowed. Those that no ray can hit, with a NaN, an infinity or a negative radius, cost nothing. Up to 16 that
/// are large compared to the extent of the others, such as the ground, are kept apart and tested with each ray. Where the spheres
/// are does not matter: far from the world's origin, a few far from all others, or in clusters far apart.
///
/// # When to use it
///
/// For more than some hundred spheres, in `f32` and in `f64`. To build it of 20,000 takes some 6 ms, and of a million less than
/// half a second: compared with a scan of 20,000, that pays from some 1,200 rays a frame (`cargo bench --bench sphere_scenes`).
/// If the spheres move, [`update`](Self::update) takes less. So few spheres that a scan is faster are scanned, as [`Spheres`]
/// does. It takes at most 32 bytes a sphere, and at most 56 in `f64`. (In the repository, `cargo bench --manifest-path
/// benches/peers/Cargo.toml --bench many_spheres` measures it beside other libraries.)
///
/// # How
///
/// Nodes are 16 boxes wide, and leaves 16 spheres, as wide as the widest vectors (Wald, Benthin and Boulos, *Getting Rid of
/// Packets*, 2008). Their boxes are in `f32` in both precisions, around centers of their own. A surface-area heuristic sorts the
/// spheres into them, and prefers to fill them. The instructions are those that [`Spheres`] uses.
///
/// # Limits
///
/// A sphere with a coordinate or a radius beyond 2⁶⁰ is always intersected exactly, and so are all spheres with a ray whose
/// origin is farther than 2⁶⁰ from the world's, or whose direction is longer than that or shorter than 2⁻³⁰.
#[derive(Clone)]
pub struct SphereBvh<V: Vector = Vec3>(pub(super) Shape<V>);

#[derive(Clone)]
pub(super) enum Shape<V: Vector> {
    /// So few that a scan is faster; or more than an index of 32 bits can tell apart.
    Scan(Spheres<V>),
    Tree(Tree<V>),
}

impl<V: Vector> SphereBvh<V> {
    /// Builds the hierarchy of spheres. The index of each is its place in the slice.
    ///
    /// `From` takes a `Vec`, an array or a [`Spheres`] as well, and `collect` an iterator.
    ///
    /// ```
    /// use eyeray::{Sphere, SphereBvh};
    /// use glam::Vec3;
    ///
    /// let spheres = [1.0, 2.0, 3.0].map(|x| Sphere::new(Vec3::X * x, 0.1));
    /// let bvh = SphereBvh::new(&spheres);
    /// assert_eq!(bvh.get(2), Some(spheres[2]));
    ///
    /// assert_eq!(SphereBvh::from(spheres), bvh);
    /// assert_eq!(spheres.iter().collect::<SphereBvh>(), bvh);
    /// ```
    #[must_use]
    pub fn new(spheres: &[Sphere<V>]) -> Self {
        if is_tree(spheres.len(), Lanes::best()) {
            Self(Shape::Tree(Tree::new(spheres)))
        } else {
            Self(Shape::Scan(spheres.into()))
        }
    }

    /// Moves the spheres: the one at each index is replaced by the one at the same index of the slice.
    ///
    /// All queries then return what they return of a hierarchy that is built of these spheres. The time differs: while spheres
    /// are still near where they were, this only makes new boxes around them, which takes a part of the time of building. Once
    /// boxes have grown by more than a little, on average, or a sphere is of another kind, such as one that no ray could hit, it
    /// builds the hierarchy anew. So it does if the number of spheres differs.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere, SphereBvh};
    /// use glam::{Vec3, vec3};
    ///
    /// let mut spheres: Vec<Sphere> =
    ///     (0..1000_u16).map(|i| Sphere::new(Vec3::X * (3.0 * f32::from(i)), 1.0)).collect();
    /// let mut bvh = SphereBvh::new(&spheres);
    ///
    /// let down = Ray::new(vec3(300.0, 10.0, 0.0), Vec3::NEG_Y);
    /// for frame in 1..=3_u8 {
    ///     for sphere in &mut spheres {
    ///         sphere.center.y += 0.1;
    ///     }
    ///     bvh.update(&spheres);
    ///     let found = bvh.nearest(&down, 0.0..f32::INFINITY);
    ///     assert_eq!(found.map(|(index, _)| index), Some(100));
    ///     assert!(found.is_some_and(|(_, hit)| (hit.t - (9.0 - 0.1 * f32::from(frame))).abs() < 1e-5));
    /// }
    /// ```
    #[doc(alias("refit", "rebuild"))]
    pub fn update(&mut self, spheres: &[Sphere<V>]) {
        let is_moved = match &mut self.0 {
            Shape::Tree(tree) => tree.places.len() == spheres.len() && tree.refit(spheres),
            Shape::Scan(_) => false,
        };
        if !is_moved {
            *self = Self::new(spheres);
        }
    }

    /// Returns the number of spheres.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.0 {
            Shape::Scan(spheres) => spheres.len(),
            Shape::Tree(tree) => tree.places.len(),
        }
    }

    /// Returns whether there are no spheres.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the sphere at `index`, or `None` if `index` is out of bounds.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Sphere<V>> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.get(index),
            Shape::Tree(tree) => tree.get(index),
        }
    }

    /// Returns an iterator over the spheres, in the order in which they were collected.
    pub fn iter(
        &self,
    ) -> impl ExactSizeIterator<Item = Sphere<V>> + DoubleEndedIterator + Clone + '_ {
        self.into_iter()
    }

    /// Returns the axis-aligned bounding box of all spheres: its lowest and its highest corner, each coordinate rounded outwards.
    ///
    /// Spheres that no ray can hit do not count. Without others, the box is empty: from +∞ to -∞. It takes time in proportion to
    /// the number of spheres. [`Spheres::bounds`] has an example.
    #[must_use]
    pub fn bounds(&self) -> (V, V) {
        Bounds::of_all(self.iter()).corners()
    }

    /// Returns the nearest hit with `t` in `range`, and the index of its sphere: of equal `t`, the sphere in
    /// front by the exact roots, and of equal exact roots the lowest index.
    #[inline]
    #[must_use]
    pub fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.nearest(ray, range),
            Shape::Tree(tree) => tree.nearest(Lanes::best(), ray, range),
        }
    }

    /// A tree, however few the spheres are.
    #[cfg(test)]
    pub(super) fn tree(spheres: &Spheres<V>) -> Self {
        Self(Shape::Tree(Tree::new(spheres.as_slice())))
    }

    /// Whether spheres have moved since it was built.
    #[cfg(test)]
    fn is_moved(&self) -> bool {
        matches!(&self.0, Shape::Tree(tree) if !tree.sizes.is_empty())
    }

    /// The same with that set of instructions.
    #[cfg(test)]
    pub(super) fn nearest_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        match &self.0 {
            Shape::Scan(spheres) => spheres.nearest_in_lanes(lanes, ray, range),
            Shape::Tree(tree) => tree.nearest(lanes, ray, range),
        }
    }

    /// [`Hittable::occludes`] with that set of instructions.
    #[cfg(test)]
    pub(super) fn occludes_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> bool {
        match &self.0 {
            Shape::Scan(spheres) => spheres.occludes_in_lanes(lanes, ray, range),
            Shape::Tree(tree) => tree.occludes(lanes, ray, range),
        }
    }
}

impl<V: Vector> Hittable<V> for SphereBvh<V> {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        self.nearest(ray, range).map(|(_, hit)| hit)
    }

    /// Returns whether any sphere is hit, at the first one found.
    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        match &self.0 {
            Shape::Scan(spheres) => spheres.occludes(ray, range),
            Shape::Tree(tree) => tree.occludes(Lanes::best(), ray, range),
        }
    }
}

/// Creates an empty collection.
impl<V: Vector> Default for SphereBvh<V> {
    fn default() -> Self {
        Self(Shape::Scan(Spheres::new()))
    }
}

/// Formats the spheres as a list, in the order in which they were collected.
impl<V: Vector> fmt::Debug for SphereBvh<V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}

/// Compares the spheres, in the order in which they were collected, as slices do.
impl<V: Vector> PartialEq for SphereBvh<V> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

/// Builds the hierarchy of these spheres, with the same indices.
impl<V: Vector> From<Spheres<V>> for SphereBvh<V> {
    fn from(spheres: Spheres<V>) -> Self {
        if is_tree(spheres.len(), Lanes::best()) {
            Self(Shape::Tree(Tree::new(spheres.as_slice())))
        } else {
            Self(Shape::Scan(spheres))
        }
    }
}

/// Builds the hierarchy, as [`SphereBvh::new`] does.
impl<V: Vector> From<Vec<Sphere<V>>> for SphereBvh<V> {
    fn from(spheres: Vec<Sphere<V>>) -> Self {
        Self::new(&spheres)
    }
}

/// Builds the hierarchy, as [`SphereBvh::new`] does.
impl<V: Vector, const N: usize> From<[Sphere<V>; N]> for SphereBvh<V> {
    fn from(spheres: [Sphere<V>; N]) -> Self {
        Self::new(&spheres)
    }
}

/// Builds the hierarchy, as [`SphereBvh::new`] does.
impl<V: Vector> From<&[Sphere<V>]> for SphereBvh<V> {
    fn from(spheres: &[Sphere<V>]) -> Self {
        Self::new(spheres)
    }
}

/// Collects the spheres into a `Vec`, and builds their hierarchy. The index of each is its place among them.
impl<V: Vector> FromIterator<Sphere<V>> for SphereBvh<V> {
    fn from_iter<I: IntoIterator<Item = Sphere<V>>>(iter: I) -> Self {
        iter.into_iter().collect::<Vec<_>>().into()
    }
}

/// Collects copies of the spheres.
impl<'a, V: Vector> FromIterator<&'a Sphere<V>> for SphereBvh<V> {
    fn from_iter<I: IntoIterator<Item = &'a Sphere<V>>>(iter: I) -> Self {
        iter.into_iter().copied().collect()
    }
}

/// Returns the spheres in the order in which they were collected, in a `Vec` of their own.
impl<V: Vector> IntoIterator for SphereBvh<V> {
    type Item = Sphere<V>;
    type IntoIter = alloc::vec::IntoIter<Sphere<V>>;

    fn into_iter(self) -> Self::IntoIter {
        match self.0 {
            Shape::Scan(spheres) => spheres.into_iter(),
            Shape::Tree(_) => self.iter().collect::<Vec<_>>().into_iter(),
        }
    }
}

/// Returns the spheres in the order in which they were collected.
impl<'a, V: Vector> IntoIterator for &'a SphereBvh<V> {
    type Item = Sphere<V>;
    type IntoIter = SphereBvhIter<'a, V>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        SphereBvhIter { spheres: self, indices: 0..self.len() }
    }
}

/// An iterator over the spheres of a [`SphereBvh`], in the order in which they were collected.
#[derive(Clone, Debug)]
pub struct SphereBvhIter<'a, V: Vector = Vec3> {
    spheres: &'a SphereBvh<V>,
    /// There is a sphere at each of these indices.
    indices: Range<usize>,
}

impl<V: Vector> Iterator for SphereBvhIter<'_, V> {
    type Item = Sphere<V>;

    fn next(&mut self) -> Option<Sphere<V>> {
        self.spheres.get(self.indices.next()?)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.indices.size_hint()
    }

    fn nth(&mut self, n: usize) -> Option<Sphere<V>> {
        self.spheres.get(self.indices.nth(n)?)
    }
}

impl<V: Vector> DoubleEndedIterator for SphereBvhIter<'_, V> {
    fn next_back(&mut self) -> Option<Sphere<V>> {
        self.spheres.get(self.indices.next_back()?)
    }
}

impl<V: Vector> ExactSizeIterator for SphereBvhIter<'_, V> {}
impl<V: Vector> FusedIterator for SphereBvhIter<'_, V> {}
