//! What a ray can meet.

use core::hint::black_box;
use core::iter;
use core::ops::Range;

use crate::rejection::HAS_VECTORS;
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
/// // A slice of hittable things is hittable, and so is an array, a `Vec`, a reference, a `Box`, an `Rc` or an `Arc`.
/// let scene: &dyn Hittable = &[far, near];
/// assert_eq!(scene.intersect(&ray, 0.0..f32::INFINITY).map(|hit| hit.t), Some(2.0));
///
/// // A shadow ray asks only whether anything is in the way: here nothing up to t = 1, and something up to t = 3.
/// assert!(!scene.occludes(&ray, 0.0..1.0));
/// assert!(scene.occludes(&ray, 0.0..3.0));
/// ```
///
/// # What an implementation owes
///
/// A shape of your own keeps what this crate's spheres keep, for [`nearest`] and the shapes around it pass on what it returns:
///
/// - The `t` of a hit is finite and above 0, whatever the range says, and the range contains it. Else what lies behind a ray, or
///   where it starts, counts as met.
/// - The hit is the nearest of those.
/// - A ray that is not finite or has a zero direction meets nothing, and neither does a range that is empty or has a NaN.
/// - [`occludes`](Self::occludes) says what [`intersect`](Self::intersect) finds: `true` if and only if there is a hit.
///
/// [`Hit::new`] has an example.
pub trait Hittable<V: Vector = glam::Vec3> {
    /// Returns the nearest hit whose `t`, as it is returned, is above 0 and in `range`; `None` if there is none.
    ///
    /// To find where the ray leaves a sphere after `hit`, begin the range just above its `t`: at `hit.t.next_up()` or, before Rust
    /// 1.86, at `f32::from_bits(hit.t.to_bits() + 1)`.
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
    /// assert_eq!(sphere.roots_algebraic(&ray).map(is_inside), Some(false));
    /// ```
    #[doc(alias("raycast", "ray_cast", "cast_ray", "trace", "hit"))]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>>;

    /// Returns whether anything is hit with `t` in `range`: what a shadow ray asks.
    ///
    /// For a point light that is not in the scene, the direction to it has its end at t = 1, and the range is `0.0..1.0`: what is
    /// behind the light does not count.
    ///
    /// A lamp that is itself in the scene must not be in its own way. Where a shadow ray hits it is not at t = 1, because the ray
    /// starts a little off the surface. So the range ends where the ray hits the lamp; being half open, it leaves the lamp out:
    ///
    /// ```
    /// use eyeray::{Hittable, Ray, Sphere};
    /// use glam::{Vec3, vec3};
    ///
    /// let ground = Sphere::new(vec3(0.0, -1000.0, 0.0), 1000.0);
    /// let lamp = Sphere::new(vec3(0.0, 4.0, 0.0), 1.0);
    /// let scene = [ground, lamp];
    ///
    /// /// Whether light from there reaches the shadow ray's origin.
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
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.intersect(ray, range).is_some()
    }

    /// Returns `false` only if the ray certainly has no hit with `t` in `range`: a test that costs less than
    /// [`intersect`](Self::intersect), for many objects of which most are missed.
    ///
    /// [`nearest`] and slices ask it first, and what it returns never changes their answer. Without an implementation it returns
    /// `true`. A shape that consists of a sphere and more passes the question on to the sphere.
    #[inline]
    fn may_hit(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        let _ = (ray, range);
        true
    }

    /// Returns which of four objects [may be hit](Self::may_hit), with the bit `1 << i` for `objects[i]`.
    ///
    /// Where a target has vectors of four numbers, [`nearest`] and slices ask four objects at a time.
    #[inline]
    fn may_hit_four(objects: &[Self; 4], ray: &Ray<V>, range: Range<V::Scalar>) -> u32
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

/// What leads to something hittable is hittable as that is.
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

/// Returns which of `objects` the ray meets first with `t` in `range`, and where: of equal `t`, the lowest index.
///
/// Every object that [may be hit](Hittable::may_hit) is tried in turn. Of spheres in `f32`, `Spheres` and `SphereBvh` (with the feature `alloc`) give the same answer,
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
        // The ray from where the compiler does not know it: what only a hit needs of it is not computed ahead of the loop.
        if let Some(hit) = object.intersect(black_box(ray), start..end) {
            // The range is half open: what comes later must be strictly nearer.
            end = hit.t;
            found = Some((index, hit));
        }
    }
    let (index, hit) = found?;
    Some((index, hit))
}

/// The nearest of the objects that `next` gives, by ascending index, each time told where the range ends by now.
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
            // The range is half open: what comes later must be strictly nearer.
            end = hit.t;
            found = Some((index, hit));
        }
    }
    // Taken apart: else it is the caller's memory from the start, and each ray waits until the one before has written there.
    let (index, hit) = found?;
    Some((index, hit))
}

/// The objects that a ray may hit, and perhaps others, by ascending index.
struct Candidates<'a, H> {
    objects: &'a [H],
    /// The first that has not been asked.
    next: usize,
    /// Of the four before it, those that may be hit and were not given yet: a bit for each.
    passed: u32,
}

impl<'a, H> Candidates<'a, H> {
    #[inline(always)]
    fn new(objects: &'a [H]) -> Self {
        Self { objects, next: 0, passed: 0 }
    }

    /// The next one that the ray may hit with t in the range.
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
            self.passed = H::may_hit_four(four, ray, range.clone());
            self.next += 4;
        }
        let index = self.next - 4 + self.passed.trailing_zeros() as usize;
        self.passed &= self.passed - 1;
        Some((index, self.objects.get(index)?))
    }
}
