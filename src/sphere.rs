//! The sphere.

use core::ops::Range;

use crate::algebraic::Quadratic;
use crate::geometric::ClosestApproach;
use crate::{Hit, Hittable, Ray, Vector};

/// A sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Sphere<V: Vector = glam::Vec3> {
    /// The center.
    pub center: V,
    /// The radius. A negative one is no sphere: nothing meets it.
    pub radius: V::Scalar,
}

impl<V: Vector> Sphere<V> {
    /// The sphere of that center and radius.
    #[inline]
    pub const fn new(center: V, radius: V::Scalar) -> Self {
        Self { center, radius }
    }

    /// Both roots along the whole line, ascending, by the algebraic derivation.
    #[inline(always)]
    pub fn roots_algebraic(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        V::roots::<Quadratic>(self, ray)
    }

    /// Both roots along the whole line, ascending, by the geometric derivation.
    #[inline(always)]
    pub fn roots_geometric(&self, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        V::roots::<ClosestApproach>(self, ray)
    }
}

impl<V: Vector> Hittable<V> for Sphere<V> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        // The faster of the two derivations where neither is in doubt.
        V::intersect::<Quadratic>(self, ray, range)
    }
}
