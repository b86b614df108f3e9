//! Where most spheres of a collection are, whatever a few of them are.
//!
//! Answers do not depend on it, only how many spheres the filter lets pass. So a sample will do, and medians, which no stray
//! sphere moves.

use arrayvec::ArrayVec;

use super::filter::{LARGEST, is_in_reach};
use super::local::to_f32;
use crate::rejection::can_be_hit;
use crate::{Sphere, Vector};

/// How many spheres a sample has at most.
const SAMPLE: usize = 64;

/// From how many extents on a ray begins anew closer to the spheres. Up to there, what the filter's margin is of the distance is
/// less than a fiftieth of the extent.
const FAR: f32 = 16.0;

/// A center in the middle of most spheres, and how far they are from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle<V> {
    pub(super) center: V,
    /// The largest coordinate of most, relative to the center.
    pub(super) extent: f32,
    /// The square of the distance up to which a ray is not far away.
    pub(super) near_squared: f32,
}

impl<V: Vector> Middle<V> {
    pub(super) const OF_NONE: Self =
        Self { center: V::ZERO, extent: 0.0, near_squared: LARGEST * LARGEST };

    pub(super) fn of(spheres: &[Sphere<V>]) -> Self {
        let step = spheres.len().div_ceil(SAMPLE).max(1);
        let sample = || {
            spheres.iter().step_by(step).filter(|sphere| can_be_hit(sphere) && is_in_reach(sphere))
        };
        let median = |axis| part(sample().map(|sphere| sphere.center.to_f64()[axis]), 1, 2);
        let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(median) else { return Self::OF_NONE };
        let center = V::from_f64([x, y, z].into());
        let distances = sample().map(|sphere| {
            (sphere.center - center).to_f64().abs().max_element() + sphere.radius.into()
        });
        let extent = to_f32(part(distances, 7, 8).unwrap_or(0.0));
        let near = (FAR * extent).min(LARGEST);
        Self { center, extent, near_squared: near * near }
    }
}

impl<V: Vector> Default for Middle<V> {
    fn default() -> Self {
        Self::OF_NONE
    }
}

/// The number that has that part of all numbers, up to 64, below it.
fn part(numbers: impl Iterator<Item = f64>, below: usize, of: usize) -> Option<f64> {
    let mut numbers: ArrayVec<f64, SAMPLE> = numbers.take(SAMPLE).collect();
    if numbers.is_empty() {
        return None;
    }
    let place = numbers.len() * below / of;
    let (_, number, _) = numbers.select_nth_unstable_by(place, f64::total_cmp);
    Some(*number)
}
