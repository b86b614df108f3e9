//! The camera basis: three unit vectors at right angles, from where the camera is, what it looks at, and what is up.
//!
//! ```text
//!     w = -(target - eye) / |target - eye|      against the direction of view
//!     u = up × w / |up × w|                     to the right
//!     v = w × u                                 up, as far as a right angle to w allows
//! ```
//!
//! With an eye far from the origin and near its target, or an up nearly along the view, `target - eye` and `up × w`
//! cancel, and what is left of them could be all rounding. So both are computed exactly and rounded once.

use glam::DVec3;

use crate::CameraError;
use crate::float::sqrt;

/// 2^256, the step in which vectors are scaled. Products of two vectors scaled by [`scaled`] are far from overflow.
const STEP: f64 = f64::from_bits(0x4ff0_0000_0000_0000);

/// 2^-256.
const STEP_DOWN: f64 = f64::from_bits(0x2ff0_0000_0000_0000);

/// 2^1000: a vector with a coordinate beyond it is one whose dot products could overflow.
const HUGE: f64 = f64::from_bits(0x7e70_0000_0000_0000);

/// 2^-64: brings any vector below [`HUGE`].
const SHRINK: f64 = f64::from_bits(0x3bf0_0000_0000_0000);

/// 2^-960, the sine of the least angle between up and the view. Underflow loses less than 2^-1060 of the two lengths, so
/// what is above has all its digits. Vectors of f32 never come near it: they are parallel, or more than 2^-560 apart.
const LEAST_SINE: f64 = f64::from_bits(0x03f0_0000_0000_0000);

/// The basis u, v, w of a camera whose `eye`, `target` and `up` are finite.
pub(crate) fn basis(eye: DVec3, target: DVec3, up: DVec3) -> Result<[DVec3; 3], CameraError> {
    if eye == target {
        return Err(CameraError::EyeAtTarget);
    }
    if up == DVec3::ZERO {
        return Err(CameraError::ZeroUp);
    }
    let shrink = shrink(eye - target);
    let [back, tail] = scaled(difference(eye * shrink, target * shrink));
    let [up] = scaled([up]);
    let right = cross(up, [back, tail]);
    if largest(right) < LEAST_SINE * up.length() * back.length() {
        return Err(CameraError::UpAlongView);
    }
    let w = unit(back);
    let u = unit(right);
    let v = w.cross(u);
    Ok([u, v, w])
}

/// What to multiply two points by, before they are subtracted, so that neither their difference nor a dot product of it
/// with a unit vector overflows: 1, unless their `difference` says otherwise.
pub(crate) fn shrink(difference: DVec3) -> f64 {
    if largest(difference) < HUGE { 1.0 } else { SHRINK }
}

/// The vectors times the power of two that brings the largest coordinate of the first, which is not zero, into
/// [1, 2^256): there its square and its length can neither overflow nor underflow.
pub(crate) fn scaled<const N: usize>(mut vectors: [DVec3; N]) -> [DVec3; N] {
    while largest(vectors[0]) >= STEP {
        vectors = vectors.map(|vector| vector * STEP_DOWN);
    }
    while largest(vectors[0]) < 1.0 {
        vectors = vectors.map(|vector| vector * STEP);
    }
    vectors
}

/// The largest coordinate, sign apart.
fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}

/// The unit vector along `vector`, which is not zero.
fn unit(vector: DVec3) -> DVec3 {
    let [vector] = scaled([vector]);
    vector / sqrt(vector.length_squared())
}

/// `a - b` exactly, as the rounded difference and what rounding took off it (Knuth's `TwoSum`).
fn difference(a: DVec3, b: DVec3) -> [DVec3; 2] {
    let rounded = a - b;
    let b_part = a - rounded;
    let a_part = rounded + b_part;
    [rounded, (a - a_part) + (b_part - b)]
}

/// `a × (b + tail)`, every coordinate to its last digit however much cancels.
fn cross(a: DVec3, [b, tail]: [DVec3; 2]) -> DVec3 {
    let coordinate = |i: usize, j: usize| {
        let [p, q] = product(a[i], b[j]);
        let [r, s] = product(-a[j], b[i]);
        let [x, y] = product(a[i], tail[j]);
        let [z, o] = product(-a[j], tail[i]);
        sum([p, q, r, s, x, y, z, o])
    };
    DVec3::new(coordinate(1, 2), coordinate(2, 0), coordinate(0, 1))
}

/// `a b` exactly, as the rounded product and what rounding took off it (Dekker's product, with Veltkamp's splitting).
fn product(a: f64, b: f64) -> [f64; 2] {
    fn split(value: f64) -> [f64; 2] {
        let spread = 134_217_729.0 * value; // 2^27 + 1
        let high = spread - (spread - value);
        [high, value - high]
    }
    let rounded = a * b;
    let ([a_high, a_low], [b_high, b_low]) = (split(a), split(b));
    let rest = ((a_high * b_high - rounded) + a_high * b_low + a_low * b_high) + a_low * b_low;
    [rounded, rest]
}

/// The sum of the terms, as if computed exactly and then rounded, give or take one unit in the last place.
///
/// The terms become Shewchuk's expansion of the sum: the same sum in parts that do not overlap, the least first.
fn sum(mut terms: [f64; 8]) -> f64 {
    for last in 1..terms.len() {
        let (parts, rest) = terms.split_at_mut(last);
        for part in parts {
            let rounded = rest[0] + *part;
            let part_part = rounded - rest[0];
            let rest_part = rounded - part_part;
            *part = (*part - part_part) + (rest[0] - rest_part);
            rest[0] = rounded;
        }
    }
    terms.iter().sum()
}
