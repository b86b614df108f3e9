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
//! within some u r |d| ([`Nearby`]). That decides nearly all crossings whose roots round alike, in both precisions, unless they
//! are equal. What is left is decided by integers: the sign of x + y by comparing D₁ with D₂; that of H + (x + y) by comparing H²
//! with (x + y)² = D₁ + D₂ + 2 x y; and that, with K = H² - D₁ - D₂, by comparing K² with 4 D₁ D₂.

use core::cmp::Ordering;

use glam::DVec3;

use super::answer::Side;
use super::bounded_chord::Bounded;
use super::chord::Chord;
use super::line::{Line, is_safe};
use super::moved_origin::offset;
use super::surds::compute_chord;
use super::unit::Unit;
use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::U;
use crate::arithmetic::rounding::RoundDown;
use crate::float::sqrt;
use crate::sealed::{Internal, Operation};
use crate::{Ray, Sphere, Vector};

#[cfg(test)]
mod tests;

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

    /// The side of the crossing whose root rounds to `t`, the near one where both do; `None` where neither does.
    #[inline(always)]
    fn side_at(&self, ray: &Ray<V>, t: V::Scalar) -> Option<Side> {
        if let Some(nearby) = &self.nearby {
            let (t, above): (f64, f64) = (t.into(), next_above::<V>(t).into());
            // Of the largest number, the next float tells no ulp.
            if above < f64::INFINITY {
                match nearby.side_within(above - t, is_power_of_two(t)) {
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

/// Where a line crosses a sphere, from a point of the line close by.
///
/// With o from that point to the center, its coordinates rounded once, h errs by 4 u |o| |d|: by o, a product and two sums. Half
/// the chord s is a root of a discriminant within `error`, as [`Bounded`] has it, so that it errs by at most `error` / s, and is
/// rounded by u. The sum of the two adds u of either.
#[derive(Clone, Copy)]
struct Nearby {
    /// How far the two roots are from that point, times a: h ∓ s.
    roots: [f64; 2],
    /// How far off these may be.
    error: f64,
    a: f64,
}

/// Which of two roots lie within half an ulp.
enum Within {
    Neither,
    One(Side),
    Doubt,
}

impl Nearby {
    /// From the point at `t`; `None` where the bounds do not hold.
    #[inline(always)]
    fn new(line: &Line, t: f64) -> Option<Self> {
        /// Of |o| |d| and of s: 5 u and 2 u, and what this bound is rounded by.
        const ERROR: f64 = 8.0 * U;
        /// The offset errs by u of itself and 4 u v (|t d| + |c - p|). Of more than 2⁻⁷⁹ |t d|, that is next to nothing beside u.
        const SHORTEST_SQUARED: f64 = U * U * U; // 2^-159
        if !(line.radius >= 0.0 && line.radius < f64::INFINITY) {
            return None;
        }
        let d = Triple::from(line.direction);
        let o = offset(line.o(), d, t).map(|w| -w.hi);
        let radius_squared = line.radius * line.radius;
        let bounded = Bounded::new(o, d, radius_squared);
        let Chord { a, h, distance_squared, discriminant, .. } = bounded.chord;
        // So that what underflows is far below all that counts, and nothing overflows.
        let is_certain = is_safe(a)
            && is_safe(radius_squared)
            && is_safe(distance_squared)
            && distance_squared > SHORTEST_SQUARED * (t * t * a);
        if !is_certain || discriminant <= bounded.error {
            return None;
        }
        let half_chord = sqrt(discriminant);
        let error = ERROR * (bounded.reach() + half_chord) + bounded.error / half_chord;
        Some(Self { roots: [h - half_chord, h + half_chord], error, a })
    }

    fn root(&self, side: Side) -> f64 {
        let [near, far] = self.roots;
        if side == Side::Near { near } else { far }
    }

    /// Which of the roots rounds to that point, where the next float is an ulp away, and the one before as far, or half as far
    /// from a power of two.
    #[inline(always)]
    fn side_within(&self, ulp: f64, is_power_of_two: bool) -> Within {
        let half_ulp = 0.5 * ulp * self.a;
        let [near, far] = self.roots.map(f64::abs);
        let may_be = |root: f64| root <= half_ulp + self.error;
        match (may_be(near), may_be(far)) {
            (false, false) => Within::Neither,
            (true, false) => Within::One(Side::Near),
            (false, true) => Within::One(Side::Far),
            (true, true) => {
                let certain = if is_power_of_two { 0.5 * half_ulp } else { half_ulp };
                let is_near = near + self.error < certain;
                if is_near { Within::One(Side::Near) } else { Within::Doubt }
            }
        }
    }

    /// How two crossings compare, from the same point, if that is certain.
    #[inline(always)]
    fn compare(&self, side: Side, other: &Self, other_side: Side) -> Option<Ordering> {
        let difference = self.root(side) - other.root(other_side);
        if difference.abs() > self.error + other.error {
            difference.partial_cmp(&0.0)
        } else {
            None
        }
    }
}

/// Whether a float above 0 is, or may be, a power of two.
fn is_power_of_two(t: f64) -> bool {
    t.to_bits().trailing_zeros() >= f64::MANTISSA_DIGITS - 1
}

impl Side {
    /// The sign of the half-chord in the root.
    fn sign(self) -> Ordering {
        match self {
            Self::Near => Ordering::Less,
            Self::Far => Ordering::Greater,
        }
    }
}

/// The sign of a sum of two numbers of known signs; `compare` compares their magnitudes.
fn sign_of_sum(a: Ordering, b: Ordering, compare: impl FnOnce() -> Ordering) -> Ordering {
    match (a, b) {
        (Ordering::Equal, _) => b,
        (_, Ordering::Equal) => a,
        _ if a == b => a,
        _ => match compare() {
            Ordering::Greater => a,
            Ordering::Equal => Ordering::Equal,
            Ordering::Less => b,
        },
    }
}

/// Two crossings of one ray.
struct CrossingPair {
    /// The ray with either sphere.
    lines: [Line; 2],
    /// The signs of x and y, where these are not zero.
    signs: [Ordering; 2],
}

impl CrossingPair {
    #[inline(always)]
    fn new<V: Vector>(
        ray: &Ray<V>,
        (first, first_side): (&Sphere<V>, Side),
        (second, second_side): (&Sphere<V>, Side),
    ) -> Self {
        Self {
            lines: [Line::new(first, ray), Line::new(second, ray)],
            signs: [first_side.sign(), second_side.sign().reverse()],
        }
    }

    /// The order, by integers.
    #[cold]
    #[inline(never)]
    fn compare_in_integers(&self) -> Ordering {
        let [Line { origin, direction, center, radius }, other] = self.lines;
        let lengths = [origin, center, other.center, DVec3::new(radius, other.radius, 0.0)];
        let (Some(length), Some(direction)) = (Unit::common(&lengths), Unit::common(&[direction]))
        else {
            return Ordering::Equal;
        };
        let (units, places) = ([length, direction], length.places + direction.places);
        // Most scenes need little memory, and all of it is cleared.
        if places <= ORDINARY_PLACES {
            self.compare_within::<{ memory(ORDINARY_PLACES) }>(units)
        } else if places <= F32_PLACES {
            self.compare_within::<{ memory(F32_PLACES) }>(units)
        } else {
            self.compare_within::<{ memory(F64_PLACES) }>(units)
        }
    }

    /// The order, by integers in memory of `N` digits.
    #[inline(never)]
    fn compare_within<const N: usize>(&self, units: [Unit; 2]) -> Ordering {
        let places = units[0].places + units[1].places;
        let mut memory = [0; N];
        let (squares, products) = memory.split_at_mut(digits_of_squares(places));
        let mut products = products.chunks_mut(digits_of_products(places)).map(Integer::new);
        let mut squares = Integer::new(squares);
        let [Some(mut a), Some(mut h), Some(mut power), Some(mut o), Some(mut d)] =
            [(); 5].map(|()| products.next())
        else {
            return Ordering::Equal;
        };
        let [Some(mut difference), Some(first), Some(second)] = [(); 3].map(|()| products.next())
        else {
            return Ordering::Equal;
        };
        let mut discriminants = [first, second];
        let one = Shifted { integer: 1, places: 0 };

        // H = h₁ - h₂ is the difference, for now.
        for ((line, discriminant), is_first) in
            self.lines.iter().zip(&mut discriminants).zip([true, false])
        {
            compute_chord(
                line,
                units,
                [&mut a, &mut h, discriminant],
                [&mut o, &mut d, &mut power],
            );
            difference.add_times(&h, if is_first { one } else { one.negated() });
        }

        let [first, second] = discriminants;
        let [x, y] = [(&first, self.signs[0]), (&second, self.signs[1])]
            .map(|(square, sign)| if square.is_zero() { Ordering::Equal } else { sign });
        let halves = sign_of_sum(x, y, || {
            power.clear();
            power.add_times(&first, one);
            power.add_times(&second, one.negated());
            power.sign()
        });
        sign_of_sum(difference.sign(), halves, || {
            // H² against D₁ + D₂ + 2 x y: the sign of K - 2 x y.
            let k = &mut power;
            k.clear();
            k.add(&difference, &difference);
            k.add_times(&first, one.negated());
            k.add_times(&second, one.negated());
            let xy = sign_of_product(x, y);
            sign_of_sum(k.sign(), xy.reverse(), || {
                squares.add(k, k);
                // 4 D₁, so that all that is subtracted is one product.
                h.clear();
                h.add_times(&first, Shifted { integer: 1, places: 2 });
                squares.subtract(&h, &second);
                squares.sign()
            })
        })
    }
}

/// Of 61 places for lengths and as many for directions: more than scenes span.
const ORDINARY_PLACES: u32 = 122;
/// Between the smallest and the largest `f32` lie 277 places.
const F32_PLACES: u32 = 2 * 277;
/// And 2,098 for `f64`.
const F64_PLACES: u32 = 2 * 2098;

/// What an integer has room for besides its digits: a digit that a sum has to spare, and two of zeros at the top of its factors.
const SPARE: usize = 3;

/// The digits of a discriminant and its terms: with B places in all, h², a power and H² are at most 36 2²ᴮ, as o, the sum of two
/// lengths, has a place more than these. So K is below 2²ᴮ⁺⁶.
const fn digits_of_products(places: u32) -> usize {
    (2 * places + 6).div_ceil(PLACES) as usize + SPARE
}

/// The digits of K² and of 4 D₁ D₂.
const fn digits_of_squares(places: u32) -> usize {
    (4 * places + 12).div_ceil(PLACES) as usize + SPARE
}

/// The digits of all integers of a comparison.
const fn memory(places: u32) -> usize {
    digits_of_squares(places) + 8 * digits_of_products(places)
}

/// The sign of a product of numbers of these signs.
fn sign_of_product(a: Ordering, b: Ordering) -> Ordering {
    match a {
        Ordering::Less => b.reverse(),
        Ordering::Equal => Ordering::Equal,
        Ordering::Greater => b,
    }
}
