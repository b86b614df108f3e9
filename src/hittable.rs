//! What a ray can meet.

use core::ops::Range;

use crate::{Hit, Ray, Vector};

/// Anything that a ray can meet.
pub trait Hittable<V: Vector = glam::Vec3> {
    /// The nearest hit with `t` in `range`, or `None`.
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>>;

    /// Whether anything is hit with `t` in `range`: what a shadow ray asks.
    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.intersect(ray, range).is_some()
    }
}

impl<V: Vector, H: Hittable<V> + ?Sized> Hittable<V> for &H {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        (**self).intersect(ray, range)
    }

    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        (**self).occludes(ray, range)
    }
}

#[cfg(feature = "alloc")]
impl<V: Vector, H: Hittable<V> + ?Sized> Hittable<V> for alloc::boxed::Box<H> {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        (**self).intersect(ray, range)
    }

    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        (**self).occludes(ray, range)
    }
}

impl<V: Vector, H: Hittable<V>> Hittable<V> for [H] {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        nearest(self, ray, range).map(|(_, hit)| hit)
    }

    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.iter().any(|object| object.occludes(ray, range.clone()))
    }
}

/// Which of `objects` the ray meets first with `t` in `range`, and where: of equal `t`, the lowest index.
pub fn nearest<V: Vector, H: Hittable<V>>(
    objects: &[H],
    ray: &Ray<V>,
    mut range: Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let mut found = None;
    for (index, object) in objects.iter().enumerate() {
        if let Some(hit) = object.intersect(ray, range.clone()) {
            // The range is half open: what comes later must be strictly nearer.
            range.end = hit.t;
            found = Some((index, hit));
        }
    }
    found
}
