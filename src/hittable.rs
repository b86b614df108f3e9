//! What a ray can meet.

use core::ops::Range;

use crate::{Hit, Ray, Vector};

/// Anything that a ray can meet: one sphere, or many, or a shape of your own.
///
/// A range is half open, as everywhere in Rust, and counts in lengths of the ray's direction. Whatever the range, only
/// `t` > 0 is a hit. `0.0..f32::INFINITY` is the whole half line; a range that is empty, or has a NaN, holds nothing.
///
/// ```
/// use eyeray::{Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let near = Sphere::new(vec3(0.0, 0.0, -3.0), 1.0);
/// let far = Sphere::new(vec3(0.0, 0.0, -9.0), 1.0);
/// let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
///
/// // A slice of hittable things is hittable, and so is a reference to one, or a box.
/// let scene = [far, near];
/// let scene: &dyn Hittable = &scene.as_slice();
/// assert_eq!(scene.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(2.0));
///
/// // A shadow ray asks only whether anything is in the way, here of a lamp at t = 1.
/// assert!(!scene.occludes(&ray, 0.0..1.0));
/// ```
pub trait Hittable<V: Vector = glam::Vec3> {
    /// The nearest hit whose `t`, as it is returned, is above 0 and in `range`; `None` if there is none.
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
///
/// Every object is tried in turn. Of spheres in `f32`, `Spheres` and `SphereBvh` (with the feature `alloc`) give the same answer,
/// few several times as fast and many a thousand times.
///
/// ```
/// use eyeray::{Ray, Sphere, nearest};
/// use glam::{Vec3, vec3};
///
/// let far = Sphere::new(vec3(0.0, 0.0, -9.0), 1.0);
/// let near = Sphere::new(vec3(0.0, 0.0, -3.0), 1.0);
/// let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
///
/// let found = nearest(&[far, near], &ray, 0.0..f32::INFINITY);
/// assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((1, 2.0)));
/// ```
pub fn nearest<V: Vector, H: Hittable<V>>(
    objects: &[H],
    ray: &Ray<V>,
    range: Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let mut objects = objects.iter().enumerate();
    nearest_among(ray, range, |_| objects.next())
}

/// The nearest of the objects that `next` gives, by ascending index, each time told where the range ends by now.
#[inline(always)]
pub(crate) fn nearest_among<'a, V: Vector, H: Hittable<V> + 'a>(
    ray: &Ray<V>,
    range: Range<V::Scalar>,
    mut next: impl FnMut(V::Scalar) -> Option<(usize, &'a H)>,
) -> Option<(usize, Hit<V>)> {
    let Range { start, mut end } = range;
    let mut found = None;
    while let Some((index, object)) = next(end) {
        if let Some(hit) = object.intersect(ray, start..end) {
            // The range is half open: what comes later must be strictly nearer.
            end = hit.t;
            found = Some((index, hit));
        }
    }
    // Taken apart: else it is the caller's memory from the start, and each ray waits until the one before has written there.
    let (index, hit) = found?;
    Some((index, hit))
}
