//! A box in the coordinates of the world, and as it is in those of a region.

use glam::{DVec3, Vec3};

use crate::arithmetic::pair::{Pair, two_difference};
use crate::arithmetic::rounding::RoundDown;
use crate::{Sphere, Vector};

/// The lowest and the highest corner.
#[derive(Clone, Copy, Debug)]
pub(in crate::spheres) struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    /// The box around nothing.
    pub(super) const NONE: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The box around a sphere.
    pub(super) fn of<V: Vector>(sphere: &Sphere<V>) -> Self {
        let (low, high) = sphere.bounds();
        Self { low: low.to_f64(), high: high.to_f64() }
    }

    /// The box around two.
    pub(super) fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The box around some spheres.
    pub(in crate::spheres) fn of_all<V: Vector>(spheres: impl Iterator<Item = Sphere<V>>) -> Self {
        spheres.fold(Self::NONE, |bounds, sphere| bounds.and(Self::of(&sphere)))
    }

    /// The corners, for coordinates that the precision holds.
    pub(in crate::spheres) fn corners<V: Vector>(self) -> (V, V) {
        (V::from_f64(self.low), V::from_f64(self.high))
    }

    /// The corners relative to a center, rounded outwards.
    pub(super) fn relative_to<V: Vector>(self, center: V) -> (Vec3, Vec3) {
        let center = center.to_f64();
        // Upwards is downwards in the mirror.
        (round_down(self.low, center), -round_down(-self.high, -center))
    }
}

/// The difference, each coordinate rounded down.
fn round_down(a: DVec3, b: DVec3) -> Vec3 {
    let round_down = |a, b| {
        let Pair { hi, lo } = two_difference(a, b);
        f32::round_down(hi, lo)
    };
    Vec3::new(round_down(a.x, b.x), round_down(a.y, b.y), round_down(a.z, b.z))
}
