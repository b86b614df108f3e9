//! The exact answer for any ray and sphere, in integers of any size.
//!
//! With p the origin, d the direction, c the center and r the radius, and o = c - p, the line meets the sphere where
//! |t d - o| = r: at t = (h ± √N) / a with a = d·d, h = d·o and N = h² - a (o·o - r²). All of a, h and N are exact here,
//! so the sign of N decides whether there are roots, and whether a root is above or below a given number is decided by
//! integers too: t > x where ±√N > a x - h, that is where a square is larger than another.

use std::cmp::Ordering;
use std::marker::PhantomData;

use eyeray::{Ray, Sphere, Vector};
use glam::{DVec3, Vec3};

use super::dyadic::Dyadic;
use super::float::Float;

/// How many bits of a root are kept where its exact value is not needed.
pub const BITS: i64 = 192;

/// A vector whose coordinates the oracle can read.
pub trait Coordinates: Vector<Scalar: Float> {
    /// Its coordinates.
    fn coordinates(self) -> [Self::Scalar; 3];
}

impl Coordinates for Vec3 {
    fn coordinates(self) -> [f32; 3] {
        self.to_array()
    }
}

impl Coordinates for DVec3 {
    fn coordinates(self) -> [f64; 3] {
        self.to_array()
    }
}

/// A vector of exact numbers.
type Exact = [Dyadic; 3];

/// The exact vector, if it is finite.
fn exactly<V: Coordinates>(vector: V) -> Option<Exact> {
    let coordinates = vector.coordinates().map(Into::<f64>::into);
    coordinates
        .iter()
        .all(|coordinate| coordinate.is_finite())
        .then(|| coordinates.map(Dyadic::exactly))
}

fn dot(v: &Exact, w: &Exact) -> Dyadic {
    let [x, y, z] = [0, 1, 2].map(|i| &v[i] * &w[i]);
    &(&x + &y) + &z
}

fn difference(v: &Exact, w: &Exact) -> Exact {
    [0, 1, 2].map(|i| &v[i] - &w[i])
}

/// The side of the sphere's surface that a point is on: `Less` is inside. `None` where a value is not finite.
pub fn side<V: Coordinates>(sphere: &Sphere<V>, point: V) -> Option<Ordering> {
    let radius: f64 = sphere.radius.into();
    if !radius.is_finite() {
        return None;
    }
    let from_center = difference(&exactly(point)?, &exactly(sphere.center)?);
    let radius = Dyadic::exactly(radius);
    Some(dot(&from_center, &from_center).cmp(&(&radius * &radius)))
}

/// Where a line meets a sphere, exactly.
#[derive(Debug)]
pub struct Truth<V> {
    /// The nearer root along the line and the farther one. They are equal where the line is tangent.
    pub roots: [Root; 2],
    direction: Exact,
    to_center: Exact,
    center: Exact,
    radius: Dyadic,
    precision: PhantomData<V>,
}

impl<V: Coordinates> Truth<V> {
    /// Where the whole line of the ray meets the sphere, or `None`: where it does not, where a value is not finite,
    /// where the direction is zero, where the radius is negative.
    pub fn new(ray: &Ray<V>, sphere: &Sphere<V>) -> Option<Self> {
        let origin = exactly(ray.origin)?;
        let direction = exactly(ray.direction)?;
        let center = exactly(sphere.center)?;
        let radius: f64 = sphere.radius.into();
        if !radius.is_finite() || radius < 0.0 || direction.iter().all(Dyadic::is_zero) {
            return None;
        }
        let radius = Dyadic::exactly(radius);

        let to_center = difference(&center, &origin);
        let a = dot(&direction, &direction);
        let h = dot(&direction, &to_center);
        let squared_distance = dot(&to_center, &to_center);
        let c = &squared_distance - &(&radius * &radius);
        let discriminant = &(&h * &h) - &(&a * &c);
        if discriminant.is_negative() {
            return None;
        }

        // From afar, the point on the surface is a small difference: it takes more bits of the root.
        let cancelled = if squared_distance.is_zero() || radius.is_zero() {
            0
        } else {
            (squared_distance.magnitude() / 2 - radius.magnitude()).max(0)
        };
        let roots = [-1, 1].map(|sign| {
            let numbers = [&h, &Dyadic::new(sign, 0), &discriminant, &a].map(Dyadic::clone);
            Root::new(numbers, BITS + cancelled)
        });
        Some(Self { roots, direction, to_center, center, radius, precision: PhantomData })
    }

    /// From the center to the point of the surface at a root.
    fn center_to_point(&self, root: usize) -> Exact {
        if self.radius.is_zero() {
            return [Dyadic::ZERO; 3];
        }
        let t = &self.roots[root].cut_off;
        [0, 1, 2].map(|i| &(&self.direction[i] * t) - &self.to_center[i])
    }

    /// How far the ray has travelled at a root.
    pub fn travelled(&self, root: usize) -> Dyadic {
        let length = dot(&self.direction, &self.direction).square_root(BITS);
        &self.roots[root].cut_off.clone().abs() * &length
    }

    /// The largest error of a coordinate of a point that was computed for a root, as a part of what is promised: half an ulp of
    /// that coordinate and a hundredth, or an ulp where it is below 2^-900 or, in single precision, subnormal, and the smaller of
    /// a part of the distance travelled and a part of the radius.
    pub fn point_error(&self, root: usize, point: V) -> f64 {
        let [of_distance, of_radius] = if V::Scalar::DIGITS == 24 { [30, 24] } else { [60, 53] };
        let allowed =
            self.travelled(root).scaled(-of_distance).min(self.radius.clone().scaled(-of_radius));
        let from_center = self.center_to_point(root);
        let parts = [0, 1, 2].map(|i| {
            let exact = &self.center[i] + &from_center[i];
            let ulp = V::Scalar::ulp(&exact);
            let is_small = ulp < -900 || ulp == V::Scalar::LEAST_EXPONENT;
            let hundredths = if is_small { 100 } else { 51 };
            let rounding = Dyadic::new(hundredths, ulp);
            let promised = &rounding + &(&allowed * &Dyadic::new(100, 0));
            // In hundredths of an ulp.
            point.coordinates()[i].error(&exact, ulp) * 100.0
                / promised.scaled(-ulp).approximately()
        });
        parts.into_iter().fold(0.0, f64::max)
    }

    /// The largest error of a coordinate of a unit normal that was computed for a root, in ulps of 1. A sphere of
    /// radius 0 has for its normal the unit vector back along the ray.
    pub fn normal_error(&self, root: usize, normal: V) -> f64 {
        let (vector, length) = if self.radius.is_zero() {
            let backwards = [0, 1, 2].map(|i| -&self.direction[i]);
            let length = dot(&backwards, &backwards).square_root(BITS);
            (backwards, length)
        } else {
            (self.center_to_point(root), self.radius.clone())
        };
        let errors = [0, 1, 2].map(|i| {
            let exact = vector[i].divided_by(&length, BITS);
            normal.coordinates()[i].error(&exact, 1 - i64::from(V::Scalar::DIGITS))
        });
        errors.into_iter().fold(0.0, f64::max)
    }
}

/// One root (h ± √N) / a, or any other such number.
#[derive(Clone, Debug)]
pub struct Root {
    h: Dyadic,
    /// The sign of the square root.
    sign: Ordering,
    discriminant: Dyadic,
    a: Dyadic,
    /// The root, cut off after a few hundred bits.
    cut_off: Dyadic,
}

impl Root {
    /// (h + `factor` √N) / a, cut off after at least `bits` bits. N is not negative, and a is above 0.
    pub fn new([h, factor, n, a]: [Dyadic; 4], bits: i64) -> Self {
        let discriminant = &(&factor * &factor) * &n;
        let sign = factor.sign();
        let square_root = discriminant.square_root(bits);
        let square_root = if sign.is_lt() { -&square_root } else { square_root };
        let sum = if h.is_negative() == square_root.is_negative() {
            &h + &square_root
        } else {
            // Without cancellation.
            let norm = &(&h * &h) - &discriminant;
            let difference = &h - &square_root;
            if norm.is_zero() { norm } else { norm.divided_by(&difference, bits) }
        };
        let cut_off = sum.divided_by(&a, bits);
        Self { h, sign, discriminant, a, cut_off }
    }

    /// How the root compares with a number, exactly.
    pub fn compare(&self, number: &Dyadic) -> Ordering {
        // t and x compare as ±√N and a x - h do.
        let other = &(&self.a * number) - &self.h;
        let sign = if self.discriminant.is_zero() { Ordering::Equal } else { self.sign };
        match (sign, other.sign()) {
            (Ordering::Greater, Ordering::Greater) => self.discriminant.cmp(&(&other * &other)),
            (Ordering::Less, Ordering::Less) => (&other * &other).cmp(&self.discriminant),
            (sign, other) => sign.cmp(&other),
        }
    }

    /// How the root compares with one of another sphere on the same line, exactly.
    ///
    /// By square roots of as many digits as it takes. Equal only where the product of the difference and its conjugates is zero.
    pub fn order(&self, other: &Self) -> Ordering {
        let difference = &self.h - &other.h;
        let k = &(&(&difference * &difference) - &self.discriminant) - &other.discriminant;
        let product = &self.discriminant * &other.discriminant;
        let may_be_equal = (&k * &k).scaled(-2).cmp(&product).is_eq();
        let mut bits = BITS;
        loop {
            let [x, y] = [self, other].map(|root| root.discriminant.square_root(bits));
            let error = (&x + &y).scaled(1 - bits);
            let x = if self.sign.is_lt() { -&x } else { x };
            let y = if other.sign.is_lt() { y } else { -&y };
            let sum = &(&difference + &x) + &y;
            if sum.clone().abs().cmp(&error).is_gt() || error.is_zero() {
                return sum.sign();
            }
            if may_be_equal && bits > 4096 {
                return Ordering::Equal;
            }
            bits *= 2;
        }
    }

    /// The value of the format nearest to the root: see [`Float::nearest`].
    pub fn nearest<F: Float>(&self) -> F {
        F::nearest_by(&self.cut_off, |number| self.compare(number))
    }

    /// How far a computed value is from the root, in ulps of the root.
    pub fn error<F: Float>(&self, computed: F) -> f64 {
        computed.error(&self.cut_off, F::ulp(&self.cut_off))
    }

    /// Whether the root is exactly 0, which has no sign to be kept.
    pub fn is_zero(&self) -> bool {
        self.compare(&Dyadic::ZERO).is_eq()
    }
}
