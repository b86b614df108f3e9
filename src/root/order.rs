//! The order of crossings along a ray, exactly: which of two spheres is in front where their distances round to the same float.
//!
//! Two spheres on one ray share a = d·d. So their roots (h₁ ∓ √D₁) / a and (h₂ ∓ √D₂) / a compare as
//!
//! ```text
//! H + x + y   with 0,   H = h₁ - h₂ = d·(c₁ - c₂),   x = ∓√D₁,   y = ±√D₂
//! ```
//!
//! In plain `f64` with a bound, that decides nearly all crossings in `f32` that are not equal. What is left is decided by
//! integers: the sign of x + y by comparing D₁ with D₂; that of H + (x + y) by comparing H² with (x + y)² = D₁ + D₂ + 2 x y; and that, with
//! K = H² - D₁ - D₂, by comparing K² with 4 D₁ D₂.

use core::cmp::Ordering;

use glam::DVec3;

use super::bounded::Bounded;
use super::crossing::{Line, Side};
use super::in_f64::is_safe;
use super::surds::common_unit;
use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::pair::U;
use crate::arithmetic::scaling::exponent;
use crate::float::sqrt;
use crate::{Ray, Sphere, Vector};

#[cfg(test)]
mod tests;

/// Compares two crossings of one ray, which both exist: `Less` where the first comes before the second, `Equal` only where their
/// exact roots are equal.
pub(crate) fn compare_crossings<V: Vector>(
    ray: &Ray<V>,
    (first, first_side): (&Sphere<V>, Side),
    (second, second_side): (&Sphere<V>, Side),
) -> Ordering {
    if first == second && first_side == second_side {
        return Ordering::Equal;
    }
    let pair = CrossingPair::new(ray, (first, first_side), (second, second_side));
    pair.compare_plainly().unwrap_or_else(|| pair.compare_in_integers())
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

    /// The order, where plain `f64` is certain of it.
    fn compare_plainly(&self) -> Option<Ordering> {
        let (sum, error) = self.plain_sum()?;
        // Neither where a half-chord is zero or NaN.
        if sum.abs() > error { sum.partial_cmp(&0.0) } else { None }
    }

    /// H + x + y in plain `f64`, and what it is off by at most; `None` where that bound does not hold.
    ///
    /// H errs by 4 u of the sum of the |dᵢ eᵢ|, e = c₁ - c₂: by its difference, product and two sums. A half-chord s is a root of
    /// a discriminant within `error`, as [`Bounded`] has it, so that it errs by at most `error` / s, and is rounded by u. The two
    /// sums add u of H and of the first half-chord twice, and of the second once.
    fn plain_sum(&self) -> Option<(f64, f64)> {
        /// Of the sum of the |dᵢ eᵢ| and of the half-chords: 6 u and 3 u, and what this bound is rounded by.
        const ERROR: f64 = 8.0 * U;
        let [first, second] = self.lines;
        let d = first.direction;
        let e = first.center - second.center;
        let mut sum = d.dot(e);
        let mut error = ERROR * d.abs().dot(e.abs());
        for (line, sign) in self.lines.iter().zip(self.signs) {
            let radius_squared = line.radius * line.radius;
            let bounded =
                Bounded::new((line.center - line.origin).into(), d.into(), radius_squared);
            // So that what underflows is far below the error of r² a, and nothing overflows.
            let is_certain = is_safe(bounded.chord.a)
                && is_safe(radius_squared)
                && is_safe(bounded.chord.distance_squared + radius_squared);
            if !is_certain {
                return None;
            }
            let half_chord = sqrt(bounded.chord.discriminant);
            sum += if sign.is_lt() { -half_chord } else { half_chord };
            error += ERROR * half_chord + bounded.error / half_chord;
        }
        Some((sum, error))
    }

    /// The order, by integers.
    #[cold]
    #[inline(never)]
    fn compare_in_integers(&self) -> Ordering {
        let [Line { origin, direction, center, radius }, other] = self.lines;
        let lengths = [origin, center, other.center, DVec3::new(radius, other.radius, 0.0)];
        let (Some((length_unit, length_places)), Some((direction_unit, direction_places))) =
            (unit_and_places(&lengths), unit_and_places(&[direction]))
        else {
            return Ordering::Equal;
        };
        let size = Size { length_unit, direction_unit, places: length_places + direction_places };
        // Most scenes need little memory, and all of it is cleared.
        if size.places <= ORDINARY_PLACES {
            self.compare_within::<{ memory(ORDINARY_PLACES) }>(size)
        } else if size.places <= F32_PLACES {
            self.compare_within::<{ memory(F32_PLACES) }>(size)
        } else {
            self.compare_within::<{ memory(F64_PLACES) }>(size)
        }
    }

    /// The order, by integers in memory of `N` digits.
    #[inline(never)]
    fn compare_within<const N: usize>(&self, size: Size) -> Ordering {
        let Size { length_unit, direction_unit, places } = size;
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
            for number in [&mut a, &mut h, &mut power] {
                number.clear();
            }
            for axis in 0..3 {
                let coordinate = Shifted::new(line.direction[axis], direction_unit);
                d.clear();
                d.add_number(coordinate);
                o.clear();
                o.add_number(Shifted::new(line.center[axis], length_unit));
                o.add_number(Shifted::new(-line.origin[axis], length_unit));
                a.add_times(&d, coordinate);
                h.add_times(&o, coordinate);
                power.add(&o, &o);
            }
            let radius = Shifted::new(line.radius, length_unit);
            o.clear();
            o.add_number(radius);
            power.add_times(&o, radius.negated());
            discriminant.add(&h, &h);
            discriminant.subtract(&a, &power);
            difference.add_times(&h, if is_first { one } else { one.negated() });
        }

        let [first, second] = discriminants;
        let [x, y] = [(&first, self.signs[0]), (&second, self.signs[1])]
            .map(|(square, sign)| if square.is_zero() { Ordering::Equal } else { sign });
        let halves = sign_of_sum(x, y, || {
            power.clear();
            power.add_times(&first, one);
            power.add_times(&second, one.negated());
            sign(&power)
        });
        sign_of_sum(sign(&difference), halves, || {
            // H² against D₁ + D₂ + 2 x y: the sign of K - 2 x y.
            let k = &mut power;
            k.clear();
            k.add(&difference, &difference);
            k.add_times(&first, one.negated());
            k.add_times(&second, one.negated());
            let xy = sign_of_product(x, y);
            sign_of_sum(sign(k), xy.reverse(), || {
                squares.add(k, k);
                // 4 D₁, so that all that is subtracted is one product.
                h.clear();
                h.add_times(&first, Shifted { integer: 1, places: 2 });
                squares.subtract(&h, &second);
                sign(&squares)
            })
        })
    }
}

/// The units of a pair's integers, and how many binary places those of lengths and of directions have together.
#[derive(Clone, Copy)]
struct Size {
    length_unit: i32,
    direction_unit: i32,
    places: u32,
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

/// The unit of the coordinates, and how many places the largest of them has; `None` where one is not finite.
fn unit_and_places(vectors: &[DVec3]) -> Option<(i32, u32)> {
    let unit = common_unit(vectors)?;
    let largest = vectors.iter().map(|vector| vector.abs().max_element()).fold(0.0, f64::max);
    Some((unit, (exponent(largest) + 1 - unit).max(0).unsigned_abs()))
}

/// How an integer compares with 0.
fn sign(integer: &Integer) -> Ordering {
    if integer.is_zero() {
        Ordering::Equal
    } else if integer.is_negative() {
        Ordering::Less
    } else {
        Ordering::Greater
    }
}

/// The sign of a product of numbers of these signs.
fn sign_of_product(a: Ordering, b: Ordering) -> Ordering {
    match a {
        Ordering::Less => b.reverse(),
        Ordering::Equal => Ordering::Equal,
        Ordering::Greater => b,
    }
}
