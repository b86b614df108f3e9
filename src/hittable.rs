//! The trait of everything that a ray can hit, and the nearest hit among many objects.

use core::hint::black_box;
use core::iter;
use core::ops::Range;

use crate::order::{is_nearer, next_above};
use crate::sealed::Crate;
use crate::target::HAS_VECTORS;
use crate::{Hit, Ray, Sphere, Vector};

/// A trait for everything that a ray can hit: a sphere, many spheres, or a shape of your own.
///
/// Ranges of `t` are half open, as everywhere in Rust, and count in lengths of the ray's direction. Whatever the range, a hit has
/// `t` > 0. `0.0..f32::INFINITY` is the whole half-line. A range that is empty or has a NaN contains no hit.
///
/// ```
/// use eyeray::{Hittable, Ray, Sphere};
/// use glam::{Vec3, vec3};
///
/// let near = Sphere::new(vec3(0.0, 0.0, -3.0), 1.0);
/// let far = Sphere::new(vec3(0.0, 0.0, -9.0), 1.0);
/// let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
///
/// // Slices, arrays, `Vec`, references, `Box`, `Rc` and `Arc` are hittable as their content is.
/// let scene: &dyn Hittable = &[far, near];
/// assert_eq!(scene.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(2.0));
///
/// // For a shadow ray, whether there is a hit is enough: none up to t = 1, one up to t = 3.
/// assert!(!scene.occludes(&ray, 0.0..1.0));
/// assert!(scene.occludes(&ray, 0.0..3.0));
/// ```
///
/// # Implementing `Hittable`
///
/// [`nearest`] and collections of shapes rely on the following:
///
/// - The `t` of a hit is finite, above 0 and in the range. Otherwise, points behind the ray's origin, or the origin itself, would
///   be hit.
/// - It is the hit with the least such `t`.
/// - A ray that is not finite or has a zero direction hits nothing.
/// - In a range that is empty or has a NaN, there is no hit.
/// - [`occludes`](Self::occludes) returns `true` if and only if [`intersect`](Self::intersect) returns a hit.
///
/// [`Hit::new`] has an example.
pub trait Hittable<V: Vector = glam::Vec3> {
    /// Returns the nearest hit with `t` > 0 and in `range`, or `None` if there is none.
    ///
    /// To find where the ray leaves a sphere after `hit`, begin the range just above its `t`: at `hit.t.next_up()` or, before
    /// Rust 1.86, at `f32::from_bits(hit.t.to_bits() + 1)`. It costs about what the entry costs. Among several objects, such a
    /// range skips what has the same `t`. All crossings with spheres, in order, are what [`SphereBvh::hits`] returns.
    ///
    #[cfg_attr(feature = "alloc", doc = "[`SphereBvh::hits`]: crate::SphereBvh::hits")]
    #[cfg_attr(
        not(feature = "alloc"),
        doc = "[`SphereBvh::hits`]: https://docs.rs/eyeray/latest/eyeray/struct.SphereBvh.html#method.hits"
    )]
    ///
    /// ```
    /// use eyeray::{Hittable, Ray, Sphere};
    /// use glam::Vec3;
    ///
    /// let sphere = Sphere::new(Vec3::ZERO, 1.0);
    /// let ray = Ray::new(Vec3::Z * 3.0, Vec3::NEG_Z);
    /// let entry = sphere.intersect(&ray, 0.0..f32::INFINITY);
    /// let exit = entry.and_then(|entry| {
    ///     let just_after = f32::from_bits(entry.t.to_bits() + 1);
    ///     sphere.intersect(&ray, just_after..f32::INFINITY)
    /// });
    /// assert_eq!(exit.map(|exit| exit.t), Some(4.0));
    ///
    /// // A ray starts inside a sphere if and only if its roots lie on either side of 0.
    /// let is_inside = |[near, far]: [f32; 2]| near < 0.0 && 0.0 < far;
    /// assert_eq!(sphere.roots(&ray).map(is_inside), Some(false));
    /// ```
    #[doc(alias("raycast", "ray_cast", "cast_ray", "trace", "hit"))]
    #[must_use]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>>;

    /// Returns whether the ray hits anything with `t` in `range`, for shadow rays and lines of sight.
    ///
    /// For a point light, which is not an object of the scene, take the vector from the hit to the light for the direction of the
    /// shadow ray, and `0.0..1.0` for the range: objects behind the light do not count.
    ///
    /// A lamp that is an object of the scene must not occlude itself. The shadow ray does not hit it exactly at t = 1, because
    /// the ray starts a little off the surface. So let the range end where the ray hits the lamp: a half-open range excludes its
    /// end.
    ///
    /// ```
    /// use eyeray::{Hittable, Ray, Sphere};
    /// use glam::{Vec3, vec3};
    ///
    /// let ground = Sphere::new(vec3(0.0, -1000.0, 0.0), 1000.0);
    /// let lamp = Sphere::new(vec3(0.0, 4.0, 0.0), 1.0);
    /// let scene = [ground, lamp];
    ///
    /// /// Returns whether light from the lamp reaches the origin of the shadow ray.
    /// fn is_lit(shadow: &Ray, lamp: &Sphere, scene: &[Sphere]) -> bool {
    ///     let at_lamp = lamp.intersect(shadow, 0.0..f32::INFINITY);
    ///     at_lamp.is_some_and(|at_lamp| !scene.occludes(shadow, 0.0..at_lamp.t))
    /// }
    ///
    /// let eye = vec3(0.0, 5.0, 9.0);
    /// let ray = Ray::new(eye, vec3(1.0, 0.0, 0.0) - eye);
    /// if let Some(hit) = ground.intersect(&ray, 0.0..f32::INFINITY) {
    ///     // A point of the lamp, chosen at random.
    ///     let sample = vec3(0.0, 3.0, 0.0);
    ///     assert!(is_lit(&hit.spawn(sample - hit.point), &lamp, &scene));
    /// }
    /// ```
    #[inline]
    #[doc(alias("occluded", "shadow_ray", "any_hit", "line_of_sight"))]
    #[must_use]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.intersect(ray, range).is_some()
    }

    /// Returns `false` only if the ray has no hit with `t` in `range`.
    ///
    /// This rejects most misses at less cost than [`intersect`](Self::intersect). [`nearest`] and slices call it first, which
    /// never changes what they return. The default implementation returns `true`. A shape that contains a sphere, such as a
    /// sphere with a material, should forward the call to the sphere.
    #[inline]
    #[must_use]
    fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        let _ = (ray, range);
        true
    }

    /// Returns the sphere that this object is, or `None` for any other shape.
    ///
    /// [`nearest`] and slices ask for it where two objects are hit at an equal `t`: which of the two spheres is in front is then
    /// decided by their exact roots. The default implementation returns `None`. A shape that contains a sphere, such as a sphere
    /// with a material, should forward the call to the sphere, if its hits are those of the sphere on the same ray.
    ///
    /// ```
    /// use core::ops::Range;
    /// use eyeray::{Hit, Hittable, Ray, Sphere, nearest};
    /// use glam::{Vec3, vec3};
    ///
    /// struct Ball {
    ///     sphere: Sphere,
    ///     color: Vec3,
    /// }
    ///
    /// impl Hittable for Ball {
    ///     fn intersect(&self, ray: &Ray, range: Range<f32>) -> Option<Hit> {
    ///         self.sphere.intersect(ray, range)
    ///     }
    ///
    ///     fn may_hit(&self, ray: &Ray, range: Range<f32>) -> bool {
    ///         self.sphere.may_hit(ray, range)
    ///     }
    ///
    ///     fn as_sphere(&self) -> Option<Sphere> {
    ///         self.sphere.as_sphere()
    ///     }
    /// }
    ///
    /// // The green ball begins 0.01 before the red one. From 1e6 away, both distances round to 1e6.
    /// let ball = |z, color| Ball { sphere: Sphere::new(vec3(0.0, 0.0, z), 1.0), color };
    /// let balls = [ball(-1.01, Vec3::X), ball(-1.0, Vec3::Y)];
    /// let ray = Ray::new(vec3(0.0, 0.0, 1e6), Vec3::NEG_Z);
    ///
    /// let found = nearest(&balls, &ray, 0.0..f32::INFINITY);
    /// assert_eq!(found.map(|(index, _)| balls[index].color), Some(Vec3::Y));
    /// ```
    #[inline]
    #[must_use]
    fn as_sphere(&self) -> Option<Sphere<V>> {
        None
    }

    /// Which of four objects [may be hit](Self::may_hit): the bit `1 << i` is that of `objects[i]`. Only this crate can call it
    /// or implement it, so that it may change.
    #[doc(hidden)]
    #[inline]
    fn may_hit_four(objects: &[Self; 4], ray: &Ray<V>, range: Range<V::Scalar>, _: Crate) -> u32
    where
        Self: Sized,
    {
        let mut near = 0;
        for (place, object) in objects.iter().enumerate() {
            near |= u32::from(object.may_hit(ray, range.clone())) << place;
        }
        near
    }
}

/// Implements the trait for containers and pointers, by calls of the content's methods.
macro_rules! hittable_as_its_content {
    ($([$($parameters:tt)+] $type:ty => $content:ty;)+) => {$(
        impl<V: Vector, $($parameters)+> Hittable<V> for $type {
            #[inline]
            fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
                let content: &$content = self;
                content.intersect(ray, range)
            }

            #[inline]
            fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
                let content: &$content = self;
                content.occludes(ray, range)
            }

            #[inline]
            fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
                let content: &$content = self;
                content.may_hit(ray, range)
            }

            #[inline]
            fn as_sphere(&self) -> Option<Sphere<V>> {
                let content: &$content = self;
                content.as_sphere()
            }
        }
    )+};
}

hittable_as_its_content! {
    [H: Hittable<V> + ?Sized] &H => H;
    [H: Hittable<V>, const N: usize] [H; N] => [H];
}

#[cfg(feature = "alloc")]
hittable_as_its_content! {
    [H: Hittable<V> + ?Sized] alloc::boxed::Box<H> => H;
    [H: Hittable<V> + ?Sized] alloc::rc::Rc<H> => H;
    [H: Hittable<V>] alloc::vec::Vec<H> => [H];
}

#[cfg(all(feature = "alloc", target_has_atomic = "ptr"))]
hittable_as_its_content! {
    [H: Hittable<V> + ?Sized] alloc::sync::Arc<H> => H;
}

impl<V: Vector, H: Hittable<V>> Hittable<V> for [H] {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        nearest(self, ray, range).map(|(_, hit)| hit)
    }

    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        let mut candidates = Candidates::new(self);
        iter::from_fn(|| candidates.next(ray, range.clone()))
            .any(|(_, object)| object.occludes(ray, range.clone()))
    }
}

/// Returns the nearest hit among `objects` with `t` in `range`, and the index of the object hit.
///
/// Of equal `t`, the sphere in front is returned: the exact roots are compared, and only where these are equal too, the lowest
/// index is returned. For that, both objects must be spheres, or contain one that [`as_sphere`](Hittable::as_sphere) returns. Of
/// other objects with equal `t`, the one with the lowest index is returned. Each object is tested in turn, first by
/// [`may_hit`](Hittable::may_hit). For spheres, `Spheres` and `SphereBvh` (feature `alloc`) return the same in less time.
///
/// Use it for picking: with the [`pixel_ray`](crate::Camera::pixel_ray) of the mouse, the index is that of the object below it.
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
#[must_use]
#[doc(alias("raycast", "closest_hit", "picking"))]
pub fn nearest<V: Vector, H: Hittable<V>>(
    objects: &[H],
    ray: &Ray<V>,
    range: Range<V::Scalar>,
) -> Option<(usize, Hit<V>)> {
    let Range { start, mut end } = range;
    let mut candidates = Candidates::new(objects);
    let mut found = None;
    while let Some((index, object)) = candidates.next(ray, start..end) {
        // `black_box`, so that what only a hit needs of the ray is not computed ahead of the loop.
        if let Some(hit) = object.intersect(black_box(ray), start..end) {
            if comes_first(ray, (index, object, &hit), found.as_ref()) {
                end = next_above::<V>(hit.t);
                found = Some((index, object, hit));
            }
        }
    }
    let (index, _, hit) = found?;
    Some((index, hit))
}

/// The nearest hit among the objects that `next` returns, by ascending index. `next` is told where the range now ends.
#[cfg(feature = "alloc")]
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
            if comes_first(ray, (index, object, &hit), found.as_ref()) {
                end = next_above::<V>(hit.t);
                found = Some((index, object, hit));
            }
        }
    }
    // Taken apart: otherwise it is in the caller's memory from the start, and each ray waits until the one before has written it.
    let (index, _, hit) = found?;
    Some((index, hit))
}

/// Whether the hit of an object comes before the first so far. The range then ends just above its `t`, so that all that may tie
/// is compared.
#[inline(always)]
fn comes_first<V: Vector, H: Hittable<V>>(
    ray: &Ray<V>,
    (index, object, hit): (usize, &H, &Hit<V>),
    first: Option<&(usize, &H, Hit<V>)>,
) -> bool {
    first.is_none_or(|(first_index, first_object, first)| {
        let spheres = || [object.as_sphere(), first_object.as_sphere()];
        is_nearer(ray, (index, hit.t), (*first_index, first.t), spheres)
    })
}

/// The objects that pass the first test, [`Hittable::may_hit`], by ascending index.
struct Candidates<'a, H> {
    objects: &'a [H],
    /// The index of the first that has not been tested.
    next: usize,
    /// A bit for each of the four before it that has passed and has not been returned yet.
    passed: u32,
}

impl<'a, H> Candidates<'a, H> {
    #[inline(always)]
    fn new(objects: &'a [H]) -> Self {
        Self { objects, next: 0, passed: 0 }
    }

    /// The next object that the ray may hit with t in the range.
    #[inline(always)]
    fn next<V: Vector>(&mut self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, &'a H)>
    where
        H: Hittable<V>,
    {
        while self.passed == 0 {
            let rest = self.objects.get(self.next..)?;
            let four = if HAS_VECTORS { rest.first_chunk() } else { None };
            let Some(four) = four else {
                let place = rest.iter().position(|object| object.may_hit(ray, range.clone()))?;
                let index = self.next + place;
                self.next = index + 1;
                return Some((index, self.objects.get(index)?));
            };
            self.passed = H::may_hit_four(four, ray, range.clone(), Crate(()));
            self.next += 4;
        }
        let index = self.next - 4 + self.passed.trailing_zeros() as usize;
        self.passed &= self.passed - 1;
        Some((index, self.objects.get(index)?))
    }
}
