//! Every crossing of a ray with the spheres of a collection, in order: the methods of both collections, and their iterators.

use core::iter::FusedIterator;
use core::ops::Range;

use super::crossings::Crossings;
use super::hierarchy::{self, Shape};
use super::lanes::Lanes;
use super::{SphereBvh, Spheres};
use crate::{Hit, Ray, Sphere, Vector};

#[cfg(test)]
mod tests;

impl<V: Vector> Spheres<V> {
    /// Returns an iterator over every crossing of the ray with a sphere, nearest first, each with the index of its sphere.
    ///
    /// It returns what [`SphereBvh::hits`] returns, which has more examples, in the same order. All spheres are filtered for the
    /// first crossing, and the rest takes no more than the crossings returned. Memory is allocated only if more than four
    /// crossings were found and not yet returned.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere, Spheres};
    /// use glam::Vec3;
    ///
    /// // A ball in another: the ray enters both, and leaves both.
    /// let spheres = Spheres::from(vec![Sphere::new(Vec3::ZERO, 1.0), Sphere::new(Vec3::ZERO, 2.0)]);
    /// let ray = Ray::new(Vec3::Z * 5.0, Vec3::NEG_Z);
    /// let crossings = spheres.hits(&ray, 0.0..f32::INFINITY).map(|(index, hit)| (index, hit.t));
    /// assert!(crossings.eq([(1, 3.0), (0, 4.0), (0, 6.0), (1, 7.0)]));
    /// ```
    #[inline]
    #[doc(alias("all_hits", "raycast_all", "intersect_all", "multi_hit"))]
    pub fn hits(
        &self,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> impl FusedIterator<Item = (usize, Hit<V>)> + Clone + use<'_, V> {
        self.hits_in_lanes(Lanes::best(), ray, range)
    }

    /// The same with that set of instructions.
    #[inline(always)]
    pub(super) fn hits_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> ScanHits<'_, V> {
        ScanHits {
            spheres: self,
            lanes,
            is_begun: false,
            crossings: Crossings::new(self.as_slice(), ray, range),
        }
    }
}

impl<V: Vector> SphereBvh<V> {
    /// Returns an iterator over every crossing of the ray with a sphere, nearest first, each with the index of its sphere.
    ///
    /// A ray crosses a sphere where it enters and where it leaves. The normal is outward at both, and
    /// [`front_face`](Hit::front_face) tells them apart. Each has a `t` that is finite, above 0 and in `range`: of a sphere
    /// around the ray's origin, only where the ray leaves it is ahead.
    ///
    /// # Order
    ///
    /// The order is that of the exact distances, also where these round to the same `t`. Of equal distances, that of the sphere
    /// with the lowest index comes first, and of one sphere the entry. No crossing is left out, not even of spheres that are
    /// there twice. A ray that touches a sphere enters and leaves it at the same point: there, the directions of ray and normal
    /// do not tell which is which, but of two crossings with one index the first is the entry.
    ///
    /// The first crossing is what [`nearest`](Self::nearest) returns, bit for bit.
    ///
    /// # Time and memory
    ///
    /// The iterator finds what it is asked for: the first crossing takes about as long as `nearest`, and `take` or `find` only
    /// search as far as they go. Memory is allocated only if more than four crossings were found and not yet returned, as in the
    /// midst of many spheres that overlap, or if more than 32 boxes of the hierarchy wait to be searched.
    /// (`cargo bench --bench crossings`, in the repository, measures it beside a tree that collects all and sorts.)
    ///
    /// # Examples
    ///
    /// Picking that clicks through: what lies below the mouse, from front to back. The next click at the same place takes the
    /// next.
    ///
    /// ```
    /// use eyeray::{Ray, Sphere, SphereBvh};
    /// use glam::{Vec3, vec3};
    ///
    /// let spheres: SphereBvh = (0..100_u16).map(|i| Sphere::new(Vec3::X * f32::from(i), 1.0)).collect();
    /// let ray = Ray::new(vec3(50.25, 0.0, 9.0), Vec3::NEG_Z);
    ///
    /// let below = spheres.hits(&ray, 0.0..f32::INFINITY).filter(|(_, hit)| hit.front_face(&ray));
    /// let indices: Vec<usize> = below.map(|(index, _)| index).collect();
    /// assert_eq!(indices, [50, 51]);
    /// ```
    ///
    /// The nearest that is visible:
    ///
    /// ```
    /// # use eyeray::{Ray, Sphere, SphereBvh};
    /// # use glam::Vec3;
    /// let spheres: SphereBvh = (0..100_u16).map(|i| Sphere::new(Vec3::X * f32::from(i), 0.25)).collect();
    /// let mut visible = vec![true; spheres.len()];
    /// visible[..7].fill(false);
    ///
    /// let ray = Ray::new(Vec3::NEG_X, Vec3::X);
    /// let found = spheres.hits(&ray, 0.0..f32::INFINITY).find(|(index, _)| visible[*index]);
    /// assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((7, 7.75)));
    /// ```
    ///
    /// How much glass a ray from outside passes through:
    ///
    /// ```
    /// # use eyeray::{Ray, Sphere, SphereBvh};
    /// # use glam::Vec3;
    /// # use std::collections::HashMap;
    /// let balls: SphereBvh = (0..100_u16).map(|i| Sphere::new(Vec3::X * f32::from(i), 0.25)).collect();
    /// let ray = Ray::new(Vec3::NEG_X, Vec3::X * 2.0);
    ///
    /// let mut entries = HashMap::new();
    /// let mut thickness = 0.0;
    /// for (index, hit) in balls.hits(&ray, 0.0..f32::INFINITY) {
    ///     if let Some(entry) = entries.remove(&index) {
    ///         thickness += hit.t - entry;
    ///     } else {
    ///         entries.insert(index, hit.t);
    ///     }
    /// }
    /// // `t` counts in lengths of the direction.
    /// assert_eq!(thickness * ray.direction.length(), 50.0);
    /// ```
    #[inline]
    #[doc(alias("all_hits", "raycast_all", "intersect_all", "multi_hit"))]
    pub fn hits(
        &self,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> impl FusedIterator<Item = (usize, Hit<V>)> + Clone + use<'_, V> {
        self.hits_in_lanes(Lanes::best(), ray, range)
    }

    /// The same with that set of instructions.
    #[inline(always)]
    pub(super) fn hits_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Hits<'_, V> {
        match &self.0 {
            Shape::Scan(spheres) => Hits::Scan(spheres.hits_in_lanes(lanes, ray, range)),
            Shape::Tree(tree) => Hits::Tree(hierarchy::Hits::new(tree, lanes, ray, range)),
        }
    }
}

/// An iterator over the crossings with spheres that are all tested.
#[derive(Clone)]
pub(super) struct ScanHits<'a, V: Vector> {
    spheres: &'a Spheres<V>,
    lanes: Lanes,
    is_begun: bool,
    crossings: Crossings<V, &'a [Sphere<V>]>,
}

impl<V: Vector> Iterator for ScanHits<'_, V> {
    type Item = (usize, Hit<V>);

    #[inline]
    fn next(&mut self) -> Option<(usize, Hit<V>)> {
        let Self { spheres, lanes, is_begun, crossings } = self;
        if *is_begun {
            crossings.ask_for_exit();
        } else {
            *is_begun = true;
            let (ray, range) = (crossings.ray, crossings.range.clone());
            spheres.for_each_near(*lanes, &ray, &range, |place| crossings.ask(place));
        }
        crossings.take()
    }
}

/// An iterator over crossings.
#[derive(Clone)]
#[expect(clippy::large_enum_variant, reason = "a box would be allocated for every ray")]
pub(super) enum Hits<'a, V: Vector> {
    Scan(ScanHits<'a, V>),
    Tree(hierarchy::Hits<'a, V>),
}

impl<V: Vector> Iterator for Hits<'_, V> {
    type Item = (usize, Hit<V>);

    #[inline]
    fn next(&mut self) -> Option<(usize, Hit<V>)> {
        match self {
            Self::Scan(hits) => hits.next(),
            Self::Tree(hits) => hits.next(),
        }
    }
}

impl<V: Vector> FusedIterator for ScanHits<'_, V> {}
impl<V: Vector> FusedIterator for Hits<'_, V> {}
