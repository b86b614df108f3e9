//! The lecture's camera in integers: the formulas evaluated on the given inputs, with no rounding that could matter.

use glam::{DVec2, DVec3};
use num_bigint::BigInt;
use num_bigint::Sign::NoSign;

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
    cross(&integers(up), &back(eye, target)).iter().all(|coordinate| coordinate.sign() == NoSign)
}

fn back(eye: DVec3, target: DVec3) -> Vector {
    let (eye, target) = (integers(eye), integers(target));
    [0, 1, 2].map(|i| &eye[i] - &target[i])
}

pub(crate) struct Camera {
    eye: DVec3,
    basis: [Vector; 3],
}

impl Camera {
    pub(crate) fn new(eye: DVec3, target: DVec3, up: DVec3) -> Self {
        let w = reduced(back(eye, target));
        let u = reduced(cross(&reduced(integers(up)), &w));
        let v = reduced(cross(&w, &u));
        Self { eye, basis: [unit(&u), unit(&v), unit(&w)] }
    }

    /// U, V and W.
    pub(crate) fn basis(&self) -> [Exact; 3] {
        self.basis.clone().map(|vector| Exact(vector.map(|coordinate| coordinate << INPUT_BITS)))
    }

    /// u U + v V - distance W: the direction of a perspective ray.
    pub(crate) fn direction(&self, uv: DVec2, distance: f64) -> Exact {
        self.combine(uv, distance)
    }

    /// e + u U + v V: the origin of an orthographic ray.
    pub(crate) fn origin(&self, uv: DVec2) -> Exact {
        let Exact(in_plane) = self.combine(uv, 0.0);
        let eye = integers(self.eye);
        Exact([0, 1, 2].map(|i| &in_plane[i] + (&eye[i] << UNIT_BITS)))
    }

    fn combine(&self, uv: DVec2, distance: f64) -> Exact {
        let [u, v, w] = &self.basis;
        let (x, y, z) = (integer(uv.x), integer(uv.y), integer(distance));
        Exact([0, 1, 2].map(|i| &x * &u[i] + &y * &v[i] - &z * &w[i]))
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
