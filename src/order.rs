//! The order of crossings along a ray, exactly: which of two spheres is in front where their distances round to the same float.
//!
//! Two spheres on one ray share a = d·d, wherever on its line the ray begins. So their roots (h₁ ∓ √D₁) / a and (h₂ ∓ √D₂) / a
//! compare as
//!
//! ```text
//! H + x + y   with 0,   H = h₁ - h₂ = d·(c₁ - c₂),   x = ∓√D₁,   y = ±√D₂
//! ```
//!
//! From a point of the line close to both crossings, exactly moved there, h ∓ √D is next to nothing, and plain `f64` tells it
//! within some u r |d| ([`nearby`]). That decides nearly all crossings whose roots round alike, in both precisions, unless they
//! are equal. What is left is decided by [`integers`]: the sign of x + y by comparing D₁ with D₂; that of H + (x + y) by comparing
//! H² with (x + y)² = D₁ + D₂ + 2 x y; and that, with K = H² - D₁ - D₂, by comparing K² with 4 D₁ D₂.

mod integers;
mod nearby;
#[cfg(test)]
mod tests;

use core::cmp::Ordering;

use integers::CrossingPair;
use nearby::{Nearby, Within};

use crate::arithmetic::rounding::RoundDown;
use crate::root::Side;
use crate::root::line::Line;
use crate::sealed::{Internal, Operation};
use crate::{Ray, Sphere, Vector};

/// Whether the first of two hits of one ray, each given as its index and its `t`, comes before the second: the order of all that
/// returns a nearest hit.
///
/// First by `t`. Where that is equal, by the exact roots of the two spheres that are hit, which are asked for only then; where
/// these are equal too, and where one object is no sphere, by index.
#[inline(always)]
pub(crate) fn is_nearer<V: Vector, I: Ord>(
    ray: &Ray<V>,
    (first, first_t): (I, V::Scalar),
    (second, second_t): (I, V::Scalar),
    spheres: impl FnOnce() -> [Option<Sphere<V>>; 2],
) -> bool {
    first_t < second_t
        || (first_t == second_t
            && compare_at(first_t, ray, spheres()).then(first.cmp(&second)).is_lt())
}

/// The order of two spheres that are hit at the same `t`; `Equal` also where one has no crossing there.
#[cold]
#[inline(never)]
fn compare_at<V: Vector>(t: V::Scalar, ray: &Ray<V>, spheres: [Option<Sphere<V>>; 2]) -> Ordering {
    let [Some(first), Some(second)] = &spheres else { return Ordering::Equal };
    let [a, b] = [first, second].map(|sphere| Known::new(ray, sphere, t));
    let [Some(a_side), Some(b_side)] = [&a, &b].map(|known| known.side_at(ray, t)) else {
        return Ordering::Equal;
    };
    compare_known(ray, (a, a_side), (b, b_side))
}

/// Compares two crossings of one ray, which both exist: `Less` where the first comes before the second, `Equal` only where their
/// exact roots are equal. The result does not depend on `t`, but takes less time where that is close to both.
#[cfg(any(test, feature = "alloc"))]
pub(crate) fn compare_crossings<V: Vector>(
    ray: &Ray<V>,
    t: V::Scalar,
    (first, first_side): (&Sphere<V>, Side),
    (second, second_side): (&Sphere<V>, Side),
) -> Ordering {
    let [first, second] = [first, second].map(|sphere| Known::new(ray, sphere, t));
    compare_known(ray, (first, first_side), (second, second_side))
}

/// The float after one that is positive and finite.
#[inline(always)]
pub(crate) fn next_above<V: Vector>(t: V::Scalar) -> V::Scalar {
    V::perform(NextAbove(t))
}

struct NextAbove<S>(S);

impl<V: Vector> Operation<V> for NextAbove<V::Scalar> {
    type Output = V::Scalar;

    #[inline(always)]
    fn run(self) -> V::Scalar
    where
        V: Internal,
    {
        self.0.next_above()
    }
}

/// A sphere, and what `f64` knows of its crossings.
struct Known<'a, V: Vector> {
    sphere: &'a Sphere<V>,
    nearby: Option<Nearby>,
}

impl<'a, V: Vector> Known<'a, V> {
    #[inline(always)]
    fn new(ray: &Ray<V>, sphere: &'a Sphere<V>, t: V::Scalar) -> Self {
        Self { sphere, nearby: Nearby::new(&Line::new(sphere, ray), t.into()) }
    }

    /// The side of the crossing whose root rounds to `t`, the near one where both do. Where neither does, `None`, or the side of one
    /// that is next to it: all hits have a crossing at their `t`.
    #[inline(always)]
    fn side_at(&self, ray: &Ray<V>, t: V::Scalar) -> Option<Side> {
        if let Some(nearby) = &self.nearby {
            let (t, above): (f64, f64) = (t.into(), next_above::<V>(t).into());
            // Of the largest number, the next float tells no ulp.
            if above < f64::INFINITY {
                match nearby.side_within(above - t, nearby::is_power_of_two(t)) {
                    Within::Neither => return None,
                    Within::One(side) => return Some(side),
                    Within::Doubt => {}
                }
            }
        }
        let [near, far] = self.sphere.roots(ray)?;
        if near == t {
            Some(Side::Near)
        } else if far == t {
            Some(Side::Far)
        } else {
            None
        }
    }
}

/// Compares two crossings, by `f64` and by integers.
#[inline(always)]
fn compare_known<V: Vector>(
    ray: &Ray<V>,
    (first, first_side): (Known<V>, Side),
    (second, second_side): (Known<V>, Side),
) -> Ordering {
    if first.sphere == second.sphere && first_side == second_side {
        return Ordering::Equal;
    }
    if let (Some(first), Some(second)) = (&first.nearby, &second.nearby) {
        if let Some(order) = first.compare(first_side, second, second_side) {
            return order;
        }
    }
    let [first, second] = [(first.sphere, first_side), (second.sphere, second_side)];
    CrossingPair::new(ray, first, second).compare_in_integers()
}
