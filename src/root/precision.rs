//! What each of the two precisions does with a derivation.

use core::ops::Range;

use super::chord::Derivation;
use crate::{Hit, Ray, Sphere, Vector};

/// A vector type whose precision has a way to carry a derivation through to the contract.
pub trait Precision: Sized {
    /// Where the ray meets the sphere first with `t` in `range`.
    fn intersect<D: Derivation>(
        sphere: &Sphere<Self>,
        ray: &Ray<Self>,
        range: Range<Self::Scalar>,
    ) -> Option<Hit<Self>>
    where
        Self: Vector;

    /// Where the ray leaves the sphere, if `t` is above 0 and finite there, told from where it enters even if both have the same
    /// `t`.
    fn exit_at_same_t(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<Hit<Self>>
    where
        Self: Vector;

    /// Both roots along the whole line, ascending.
    fn roots<D: Derivation>(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<[Self::Scalar; 2]>
    where
        Self: Vector;
}
