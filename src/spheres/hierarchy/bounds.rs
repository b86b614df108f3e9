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

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::Scalar;
    use crate::testing::{Dyadic, Float, Random};

    /// The corners relative to a center are the next floats outwards, and a sphere's are around it.
    fn corners_are_rounded_outwards<V: Vector>(exponents: i32) {
        let mut random = Random::new(1);
        for _ in 0..2_000 {
            let mut vector =
                || V::from_f64(DVec3::from([0; 3].map(|_| random.float(-exponents..=exponents))));
            let centers = [vector(), vector()];
            let center = vector();
            let spheres = centers.map(|center| {
                Sphere::new(center, V::Scalar::from_f64(random.float(-exponents..=exponents).abs()))
            });
            let all = Bounds::of_all(spheres.into_iter());
            let (low, high) = all.relative_to(center);
            let [world_low, world_high] = [all.low, all.high];
            assert_eq!(all.corners::<V>(), (V::from_f64(world_low), V::from_f64(world_high)));
            for axis in 0..3 {
                let exactly = |vector: V| Dyadic::exactly(vector.to_f64()[axis]);
                for Sphere { center, radius } in spheres {
                    let [center, radius] = [exactly(center), Dyadic::exactly(radius.into())];
                    assert!(Dyadic::exactly(world_low[axis]) <= &center - &radius);
                    assert!(Dyadic::exactly(world_high[axis]) >= &center + &radius);
                }
                let outwards = |corner: f64, relative: f32, sign: f64| {
                    let exact = &Dyadic::exactly(corner) - &exactly(center);
                    let exact = if sign < 0.0 { -&exact } else { exact };
                    let found = if sign < 0.0 { -relative } else { relative };
                    let next = f32::from_ordinal(found.ordinal() + 1);
                    assert!(Dyadic::exactly(found.into()) <= exact, "{corner} {relative}");
                    assert!(Dyadic::exactly(next.into()) > exact, "{corner} {relative}");
                };
                outwards(world_low[axis], low[axis], 1.0);
                outwards(world_high[axis], high[axis], -1.0);
            }
        }
    }

    #[test]
    fn corners_are_rounded_outwards_in_both_precisions() {
        corners_are_rounded_outwards::<Vec3>(40);
        corners_are_rounded_outwards::<DVec3>(40);
        corners_are_rounded_outwards::<DVec3>(4);
    }

    #[test]
    fn the_box_around_nothing_is_empty() {
        let (low, high) = Bounds::of_all(Vec::<Sphere>::new().into_iter()).corners::<Vec3>();
        assert_eq!((low, high), (Vec3::INFINITY, Vec3::NEG_INFINITY));
    }
}
