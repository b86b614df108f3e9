//! The lecture's camera in integers: the formulas evaluated on the given inputs, with no rounding that could matter.

use eyeray::ViewRect;
use glam::{DVec2, DVec3};
use num_bigint::BigInt;
use num_bigint::Sign::{Minus, NoSign};

/// Every finite f64 is an integer multiple of 2^-1074.
const INPUT_BITS: u32 = 1074;

/// Basis vectors are kept in multiples of 2^-256: far more digits than any result is compared in.
const UNIT_BITS: u32 = 256;

pub(crate) type Vector = [BigInt; 3];

/// `value` in multiples of 2^-1074.
fn integer(value: f64) -> BigInt {
    let bits = value.to_bits();
    let exponent = (bits >> 52) & 0x7ff;
    let fraction = bits & ((1 << 52) - 1);
    let magnitude = match exponent {
        0 => BigInt::from(fraction),
        0x7ff => panic!("{value} is not finite"),
        _ => BigInt::from(fraction | (1 << 52)) << (exponent - 1),
    };
    if value.is_sign_negative() { -magnitude } else { magnitude }
}

fn integers(vector: DVec3) -> Vector {
    vector.to_array().map(integer)
}

fn dot(a: &Vector, b: &Vector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

/// The same direction in smaller integers, for speed.
fn reduced(vector: Vector) -> Vector {
    let zeros = vector.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    vector.map(|coordinate| coordinate >> zeros)
}

/// The unit vector along `vector`, in multiples of 2^-256.
fn unit(vector: &Vector) -> Vector {
    let length = (dot(vector, vector) << (2 * UNIT_BITS)).sqrt();
    vector.clone().map(|coordinate| (coordinate << (2 * UNIT_BITS)) / &length)
}

/// Whether up is exactly parallel to the direction of view.
pub(crate) fn parallel(eye: DVec3, target: DVec3, up: DVec3) -> bool {
    let back = difference(eye, target);
    cross(&integers(up), &back).iter().all(|coordinate| coordinate.sign() == NoSign)
}

/// a - b.
fn difference(a: DVec3, b: DVec3) -> Vector {
    let (a, b) = (integers(a), integers(b));
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

pub(crate) struct Camera {
    eye: DVec3,
    basis: [Vector; 3],
}

impl Camera {
    pub(crate) fn new(eye: DVec3, target: DVec3, up: DVec3) -> Self {
        Self::of(eye, difference(eye, target), up)
    }

    pub(crate) fn look_to(eye: DVec3, direction: DVec3, up: DVec3) -> Self {
        Self::of(eye, integers(-direction), up)
    }

    fn of(eye: DVec3, back: Vector, up: DVec3) -> Self {
        let w = reduced(back);
        let u = reduced(cross(&reduced(integers(up)), &w));
        let v = reduced(cross(&w, &u));
        Self { eye, basis: [unit(&u), unit(&v), unit(&w)] }
    }

    /// U, V and W.
    pub(crate) fn basis(&self) -> [Exact; 3] {
        self.basis.clone().map(|vector| Exact(vector.map(|coordinate| coordinate << INPUT_BITS)))
    }

    /// u U + v V - distance W: the direction of a perspective ray.
    pub(crate) fn direction(&self, uv: &ViewPoint, distance: f64) -> Exact {
        self.combine(uv, distance)
    }

    /// e + u U + v V: the origin of an orthographic ray.
    pub(crate) fn origin(&self, uv: &ViewPoint) -> Exact {
        let Exact(in_plane) = self.combine(uv, 0.0);
        let eye = integers(self.eye);
        Exact([0, 1, 2].map(|i| &in_plane[i] + (&eye[i] << UNIT_BITS)))
    }

    fn combine(&self, ViewPoint([x, y]): &ViewPoint, distance: f64) -> Exact {
        let [u, v, w] = &self.basis;
        let z = integer(distance) << INPUT_BITS;
        Exact([0, 1, 2].map(|i| (x * &u[i] + y * &v[i] - &z * &w[i]) >> INPUT_BITS))
    }

    /// How far the point is from the eye along U, V and -W.
    pub(crate) fn see(&self, point: DVec3) -> [Number; 3] {
        let from_eye = difference(point, self.eye);
        let [u, v, w] = &self.basis;
        [Number(dot(&from_eye, u)), Number(dot(&from_eye, v)), Number(-dot(&from_eye, w))]
    }
}

/// A point (u, v) of the view plane, in multiples of 2^-2148.
pub(crate) struct ViewPoint([BigInt; 2]);

impl ViewPoint {
    pub(crate) fn new(uv: DVec2) -> Self {
        Self(uv.to_array().map(|coordinate| integer(coordinate) << INPUT_BITS))
    }

    /// The point of the view rectangle at a pixel, truncated after the last bit.
    pub(crate) fn of_pixel(view: ViewRect<f64>, pixel: DVec2, width: u32, height: u32) -> Self {
        let on_axis = |start, end, x, pixels| {
            let (start, end) = (integer(start), integer(end));
            (((&start * pixels) << INPUT_BITS) + (end - &start) * integer(x)) / pixels
        };
        let u = on_axis(view.left, view.right, pixel.x, width);
        Self([u, on_axis(view.top, view.bottom, pixel.y, height)])
    }

    /// Its distance from the point straight ahead, in f64.
    pub(crate) fn length(&self) -> f64 {
        let ViewPoint([u, v]) = self;
        to_f64(&((u * u + v * v).sqrt() >> (INPUT_BITS - UNIT_BITS)))
    }
}

/// A number in multiples of 2^-1330.
#[derive(Clone)]
pub(crate) struct Number(BigInt);

impl Number {
    pub(crate) fn new(value: f64) -> Self {
        Self(integer(value) << UNIT_BITS)
    }

    /// The product with a quotient, truncated after the last bit.
    pub(crate) fn times(&self, numerator: &Self, denominator: &Self) -> Self {
        Self(&self.0 * &numerator.0 / &denominator.0)
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self(&self.0 - &other.0)
    }

    /// The number in f64, truncated.
    pub(crate) fn to_f64(&self) -> f64 {
        let magnitude = to_f64(&self.0.magnitude().clone().into());
        if self.0.sign() == Minus { -magnitude } else { magnitude }
    }

    /// The absolute error of `computed`, in f64.
    pub(crate) fn error(&self, computed: f64) -> f64 {
        self.minus(&Self::new(computed)).to_f64().abs()
    }
}

/// A vector in multiples of 2^-1330.
pub(crate) struct Exact(Vector);

impl Exact {
    /// How far `computed` is from this, in f64: the length of the difference.
    pub(crate) fn error(&self, computed: DVec3) -> f64 {
        let computed = integers(computed);
        let difference: Vector = [0, 1, 2].map(|i| (&computed[i] << UNIT_BITS) - &self.0[i]);
        to_f64(&dot(&difference, &difference).sqrt())
    }

    pub(crate) fn length(&self) -> f64 {
        to_f64(&dot(&self.0, &self.0).sqrt())
    }

    pub(crate) fn largest_coordinate(&self) -> f64 {
        self.0
            .iter()
            .map(|coordinate| to_f64(&coordinate.magnitude().clone().into()))
            .fold(0.0, f64::max)
    }
}

/// A number of multiples of 2^-1330, to 53 bits and rounded downwards.
fn to_f64(number: &BigInt) -> f64 {
    let excess = number.bits().saturating_sub(53);
    let bits: u64 = (number >> excess).try_into().expect("53 bits");
    let exponent = i32::try_from(excess).expect("a small shift") - 1330;
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    let leading = bits as f64;
    // In two steps, because the power alone may underflow.
    leading * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}
