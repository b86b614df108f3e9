//! Every crossing of a ray with the spheres of a collection, in order.

use core::iter::FusedIterator;
use core::ops::Range;

use super::crossings::Crossings;
use super::hierarchy;
use super::lanes::Lanes;
use super::{SphereBvh, Spheres};
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
mod tests;

impl Spheres {
    /// Returns an iterator over all crossings.
    #[inline]
    pub fn hits(
        &self,
        ray: &Ray,
        range: Range<f32>,
    ) -> impl FusedIterator<Item = (usize, Hit)> + Clone + use<'_> {
        self.hits_in_lanes(Lanes::best(), ray, range)
    }

    /// The same with that set of instructions.
    #[inline(always)]
    pub(super) fn hits_in_lanes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> ScanHits<'_> {
        ScanHits {
            spheres: self,
            lanes,
            is_begun: false,
            crossings: Crossings::new(self.as_slice(), ray, range),
        }
    }
}

impl SphereBvh {
    /// Returns an iterator over all crossings.
    #[inline]
    pub fn hits(
        &self,
        ray: &Ray,
        range: Range<f32>,
    ) -> impl FusedIterator<Item = (usize, Hit)> + Clone + use<'_> {
        self.hits_in_lanes(Lanes::best(), ray, range)
    }
}

/// An iterator over the crossings with spheres that are all tested.
#[derive(Clone)]
pub(super) struct ScanHits<'a> {
    spheres: &'a Spheres,
    lanes: Lanes,
    is_begun: bool,
    crossings: Crossings<&'a [Sphere]>,
}

impl Iterator for ScanHits<'_> {
    type Item = (usize, Hit);

    #[inline]
    fn next(&mut self) -> Option<(usize, Hit)> {
        let Self { spheres, lanes, is_begun, crossings } = self;
        if *is_begun {
            crossings.ask_for_exit();
        } else {
            *is_begun = true;
            let (ray, range) = (crossings.ray, crossings.range.clone());
            spheres.for_each_near(*lanes, &ray, range, |place| crossings.ask(place));
        }
        crossings.take()
    }
}

/// An iterator over crossings.
#[derive(Clone)]
pub(super) enum Hits<'a> {
    Scan(ScanHits<'a>),
    Tree(hierarchy::Hits<'a>),
}

impl Iterator for Hits<'_> {
    type Item = (usize, Hit);

    #[inline]
    fn next(&mut self) -> Option<(usize, Hit)> {
        match self {
            Self::Scan(hits) => hits.next(),
            Self::Tree(hits) => hits.next(),
        }
    }
}

impl FusedIterator for ScanHits<'_> {}
impl FusedIterator for Hits<'_> {}
