//! The order of two crossings by exact integers.

use core::cmp::Ordering;

use glam::DVec3;

use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::root::Side;
use crate::root::line::Line;
use crate::root::surds::compute_chord;
use crate::root::unit::Unit;
use crate::{Ray, Sphere, Vector};

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
pub(super) struct CrossingPair {
    /// The ray with either sphere.
    lines: [Line; 2],
    /// The signs of x and y, where these are not zero.
    signs: [Ordering; 2],
}

impl CrossingPair {
    #[inline(always)]
    pub(super) fn new<V: Vector>(
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
    pub(super) fn compare_in_integers(&self) -> Ordering {
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
