//! A part of the tree with a coordinate system of its own.
//!
//! The errors of the boxes are a part of the largest coordinate of all. So that a sphere far away does not make all others' boxes
//! useless, and so that spheres may be anywhere, a subtree whose spheres are close together, as seen from the center of the
//! region that it is in, is a region: the coordinates of its boxes are relative to a center of its own, up to its extent. The
//! whole tree is one, and scenes have no others unless a few spheres are far from the rest.
//!
//! A ray that enters a region from afar begins anew, not far before its closest approach to the center ([`local`]), and t counts
//! from there: so that the coordinates of the origin are a few extents at most, too.
//!
//! **What is missed.** All boxes of a region are in the ball of √3 extents around its center. The closest approach is computed in
//! `f64`, with v = 2⁻⁵³: h is off by 4 v |O| |d|, and so the point by 8 v |O| with the division, the product and the sum. So it
//! is missed where the distance, with b for 2⁻⁵⁰ |O|, is more than √3 extents + b. The square of that is below 3.1 extents² + 33
//! b², because 2 √3 b ≤ 0.03 · 3 + 34 b² / 3; [`OF_DISTANCE`] is more.
//!
//! A ray that does not miss it begins anew at least 4 extents / √3 > √3 extents before its closest approach: no hit in the region
//! is lost behind the new origin.
//!
//! [`local`]: crate::spheres::local

use glam::Vec3;

use super::boxes::{self, Slabs};
use super::leaf::Tube;
use crate::spheres::local::{Approach, narrow};
use crate::{Ray, Vector};

/// From how many extents on a ray comes from afar. Up to there, the errors of the boxes are less than a ten-thousandth of the
/// extent.
pub(super) const FAR: f32 = 64.0;

/// The square of what the closest approach may be off by, in that of the origin's distance.
const OF_DISTANCE: f64 = f64::from_bits((1023 - 80) << 52); // 2^-80

/// A part of the tree.
#[derive(Clone, Debug)]
pub(super) struct Region<V> {
    pub(super) center: V,
    /// The largest coordinate of its boxes, relative to the center.
    pub(super) extent: f32,
    /// Where a ray begins: one of the nodes or of the leaves.
    pub(super) root: u32,
}

/// A ray as it goes through a region.
#[derive(Clone, Debug, Default)]
pub(super) struct Way<S> {
    pub(super) slabs: Slabs,
    pub(super) tube: Tube<S>,
    /// The t at which it begins anew, or zero.
    pub(super) moved: f64,
}

impl<V: Vector> Region<V> {
    /// Whether a ray does not come from afar.
    #[inline(always)]
    pub(super) fn is_near(&self, ray: &Ray<V>) -> bool {
        narrow(ray.origin - self.center).abs().max_element() <= self.extent * FAR
    }

    /// The way of a ray that the filters can compute with. It is of use only if the ray [is near](Self::is_near).
    #[inline(always)]
    pub(super) fn way(&self, ray: &Ray<V>) -> Way<V::Scalar> {
        let slabs = self.slabs(narrow(ray.origin - self.center), ray);
        Way { slabs, tube: Tube::new(ray), moved: 0.0 }
    }

    /// The way of one that comes from afar, if it may enter one of the boxes before `end`.
    #[cold]
    #[inline(never)]
    pub(super) fn way_from_afar(&self, ray: &Ray<V>, end: V::Scalar) -> Option<Way<V::Scalar>> {
        let origin = ray.origin.to_f64() - self.center.to_f64();
        let extent = f64::from(self.extent);
        let approach = Approach::new(origin, ray.direction.to_f64(), extent);
        let farthest = 3.1 * extent * extent + OF_DISTANCE * origin.length_squared();
        let moved = approach.moved(f64::INFINITY);
        let enters = approach.distance_squared() <= farthest && moved.t < end.into();
        enters.then(|| Way {
            slabs: self.slabs(moved.origin.as_vec3(), ray),
            tube: Tube::moved(ray, moved.t),
            moved: moved.t,
        })
    }

    #[inline(always)]
    fn slabs(&self, origin: Vec3, ray: &Ray<V>) -> Slabs {
        Slabs::new(origin, narrow(ray.direction), self.extent, boxes::MARGIN)
    }
}
