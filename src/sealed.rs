//! What the crate computes in each precision, out of its users' reach.
//!
//! A function of a user's that is generic over `V: Vector` can call every method of every supertrait of [`Vector`], in whatever
//! module that trait is. So the traits with what only this crate may call are no supertraits. [`Internal`] has them all, and an
//! [`Operation`] is what needs it: [`Sealed::perform`], which every [`Vector`] has, runs it in the vector's precision. A user
//! finds that method too, but nothing to call it with, because there are no operations outside of this crate.

use glam::{DVec3, Vec3};

use crate::Vector;
use crate::arithmetic::rounding::RoundDown;
use crate::rejection::{Bounds, Rejection};
use crate::root::precision::Precision;

/// A vector with all that the crate knows of it.
pub trait Internal: Vector<Scalar: RoundDown + Bounds> + Precision + Rejection {}

impl Internal for Vec3 {}
impl Internal for DVec3 {}

/// A computation that needs what is internal to the vector type `V`.
pub trait Operation<V> {
    /// What it computes.
    type Output;

    /// Computes it.
    fn run(self) -> Self::Output
    where
        V: Internal;
}

/// The supertrait of [`Vector`] that only this crate can implement.
pub trait Sealed: Sized {
    /// Runs the operation.
    fn perform<O: Operation<Self>>(operation: O) -> O::Output;
}

impl Sealed for Vec3 {
    #[inline(always)]
    fn perform<O: Operation<Self>>(operation: O) -> O::Output {
        operation.run()
    }
}

impl Sealed for DVec3 {
    #[inline(always)]
    fn perform<O: Operation<Self>>(operation: O) -> O::Output {
        operation.run()
    }
}

/// The supertrait of [`Scalar`](crate::Scalar) that only this crate can implement.
pub trait SealedScalar {}

impl SealedScalar for f32 {}
impl SealedScalar for f64 {}

/// The last parameter of a method that only this crate can call or implement, in a trait that others implement.
#[derive(Clone, Copy, Debug)]
pub struct Crate(pub(crate) ());

/// What a user's function that is generic over the precision cannot call.
///
/// ```compile_fail
/// fn ulp<V: eyeray::Vector>() -> f64 {
///     <V::Scalar>::UNIT_ULP
/// }
/// ```
///
/// ```compile_fail
/// fn margin<S: eyeray::Scalar>() -> S {
///     S::MARGIN
/// }
/// ```
///
/// ```compile_fail
/// fn below<S: eyeray::Scalar>(x: S) -> S {
///     x.next_below()
/// }
/// ```
///
/// ```compile_fail
/// use eyeray::{Ray, Sphere, Vector};
///
/// fn may_hit<V: Vector>(spheres: [&Sphere<V>; 4], ray: &Ray<V>, end: V::Scalar) -> u32 {
///     V::may_hit_four_within(end, spheres, ray, end..end)
/// }
/// ```
///
/// The way to all of these takes an operation, and there are none.
///
/// ```compile_fail,E0277
/// fn perform<V: eyeray::Vector>() {
///     V::perform(())
/// }
/// ```
///
/// ```compile_fail,E0603
/// use eyeray::sealed::Operation;
/// ```
///
/// Nor can a shape of the user's own rely on how many objects are tested at a time.
///
/// ```compile_fail
/// use eyeray::{Hittable, Ray, Sphere};
///
/// fn may_hit(spheres: &[Sphere; 4], ray: &Ray) -> u32 {
///     Sphere::may_hit_four(spheres, ray, 0.0..1.0)
/// }
/// ```
///
/// A function that calls what users may call compiles:
///
/// ```
/// use eyeray::{Hittable, Ray, Scalar, Sphere, Vector};
///
/// fn may_hit<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>) -> bool {
///     sphere.may_hit(ray, V::Scalar::ZERO..V::Scalar::INFINITY)
/// }
/// ```
#[cfg(doctest)]
mod out_of_reach {}
