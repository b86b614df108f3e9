//! Which of many objects a ray hits first, for code that does not depend on how they are kept.

use core::ops::Range;

use crate::{Hit, Hittable, Ray, Vector, nearest};

/// A trait for collections that find the nearest hit and the index of the object hit: slices, arrays, `Vec`, `Spheres`,
/// `SphereBvh`, and references to them.
///
/// Use it to write a function for all of them. On spheres, all return the same, bit for bit.
///
/// ```
/// use eyeray::{Nearest, Ray, Sphere, SphereBvh, Spheres};
/// use glam::{Vec3, vec3};
///
/// /// Returns the index of the object that the ray hits first.
/// fn pick(scene: &impl Nearest, ray: &Ray) -> Option<usize> {
///     scene.nearest(ray, 0.0..f32::INFINITY).map(|(index, _)| index)
/// }
///
/// let spheres = [-9.0, -3.0].map(|z| Sphere::new(vec3(0.0, 0.0, z), 1.0));
/// let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
/// assert_eq!(pick(&spheres, &ray), Some(1));
/// assert_eq!(pick(&Spheres::from(spheres), &ray), Some(1));
/// assert_eq!(pick(&SphereBvh::from(spheres), &ray), Some(1));
/// ```
pub trait Nearest<V: Vector = glam::Vec3>: Hittable<V> {
    /// Returns the nearest hit with `t` > 0 and in `range`, and the index of the object hit.
    ///
    /// Of equal `t`, it is that of [`nearest`](crate::nearest). [`intersect`](Hittable::intersect) returns the same hit.
    #[must_use]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)>;
}

impl<V: Vector, H: Hittable<V>> Nearest<V> for [H] {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        nearest(self, ray, range)
    }
}

impl<V: Vector, H: Hittable<V>, const N: usize> Nearest<V> for [H; N] {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        nearest(self, ray, range)
    }
}

impl<V: Vector, C: Nearest<V> + ?Sized> Nearest<V> for &C {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        (**self).nearest(ray, range)
    }
}

#[cfg(feature = "alloc")]
impl<V: Vector, H: Hittable<V>> Nearest<V> for alloc::vec::Vec<H> {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        nearest(self, ray, range)
    }
}

#[cfg(feature = "alloc")]
impl<V: Vector> Nearest<V> for crate::Spheres<V> {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        self.nearest(ray, range)
    }
}

#[cfg(feature = "alloc")]
impl<V: Vector> Nearest<V> for crate::SphereBvh<V> {
    #[inline]
    fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        self.nearest(ray, range)
    }
}
