//! The camera basis: three orthonormal vectors, from the direction of view and the up vector.
//!
//! ```text
//!     w = -(to - from) / |to - from|      against the direction of view
//!     u = up × w / |up × w|               to the right
//!     v = w × u                           up, as far as a right angle to w allows
//! ```
//!
//! With an eye far from the origin and near its target, or an up nearly along the view, `to - from` and `up × w`
//! cancel, and what is left of them could be all rounding. So both are computed exactly, which also tells for sure whether
//! there is anything left, and the basis in pairs, of which only the result is rounded to f64.

use glam::DVec3;

use crate::arithmetic::integer::{Integer, PLACES, Shifted};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::Pair;
use crate::arithmetic::scaled_pair::ScaledPair;

/// The basis u, v, w of a view in the direction from `from` to `to`, all three arguments finite.
///
/// `None` if there is none: `from` is `to`, or `up` is zero or parallel to the view.
pub(super) fn basis(from: DVec3, to: DVec3, up: DVec3) -> Option<[DVec3; 3]> {
    let w = unit([0, 1, 2].map(|i| sum([[1.0, from[i]], [-1.0, to[i]]])))?;
    // up × (from - to), multiplied out.
    let u = unit([(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        sum([[up[i], from[j]], [-up[i], to[j]], [-up[j], from[i]], [up[j], to[i]]])
    }))?;
    let v = w.cross(u);
    Some([u, v, w].map(|axis| axis.map(|coordinate| coordinate.hi).into()))
}

/// The point that the rotation of these rows, followed by the translation, moves to the origin: -R⁻¹ t.
///
/// By Cramer's rule, with exact determinants, so that it is rounded once. They are not zero.
pub(super) fn moved_to_origin([x, y, z]: [DVec3; 3], t: DVec3) -> DVec3 {
    // The coordinate `i` of a × b, times `factor`.
    let of_cross = |factor: f64, a: DVec3, b: DVec3, i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        [[factor, a[j], b[k]], [-factor, a[k], b[j]]]
    };
    let determinant = {
        let [[a, b], [c, d], [e, f]] = [0, 1, 2].map(|i| of_cross(x[i], y, z, i));
        sum([a, b, c, d, e, f])
    };
    let coordinate = |i: usize| {
        let [a, b] = of_cross(-t.x, y, z, i);
        let [c, d] = of_cross(-t.y, z, x, i);
        let [e, f] = of_cross(-t.z, x, y, i);
        // A quotient of zero may be -0.
        (sum([a, b, c, d, e, f]) / determinant).to_f64() + 0.0
    };
    DVec3::new(coordinate(0), coordinate(1), coordinate(2))
}

/// -a·b, rounded once.
pub(super) fn negated_dot(a: DVec3, b: DVec3) -> f64 {
    sum([[-a.x, b.x], [-a.y, b.y], [-a.z, b.z]]).to_f64()
}

/// The sum of at most six products of two or three factors, rounded to 106 bits.
fn sum<const N: usize, const FACTORS: usize>(products: [[f64; FACTORS]; N]) -> ScaledPair {
    /// All numbers are multiples of this, 2⁻¹⁰⁷⁴, and have so many places.
    const UNIT: i32 = -1074;
    const NUMBER: u32 = 2098;
    /// The sum of six products, and what an [`Integer`] has to spare.
    const DIGITS: usize = (3 * NUMBER + 3).div_ceil(PLACES) as usize + 3;
    let mut memory = [[0; DIGITS]; 3];
    let [mut product, mut next, mut sum] = memory.each_mut().map(|digits| Integer::new(digits));
    let mut unit = 0;
    for factors in products {
        let [first, middle @ .., last] = factors.as_slice() else { continue };
        product.clear();
        product.add_number(Shifted::new(*first, UNIT));
        unit = 2 * UNIT;
        for &factor in middle {
            next.clear();
            next.add_times(&product, Shifted::new(factor, UNIT));
            core::mem::swap(&mut product, &mut next);
            unit += UNIT;
        }
        sum.add_times(&product, Shifted::new(*last, UNIT));
    }
    sum.to_scaled_pair(unit)
}

/// The unit vector along `vector`, unless that is zero.
fn unit(vector: [ScaledPair; 3]) -> Option<Triple<Pair>> {
    let exponent = vector
        .into_iter()
        .filter(|coordinate| !coordinate.is_zero())
        .map(ScaledPair::exponent)
        .max()?;
    // With the largest coordinate between 1 and 2, the length neither overflows nor underflows.
    let [x, y, z] = vector.map(|coordinate| coordinate.scaled(-exponent));
    let vector = Triple { x, y, z };
    let length = vector.dot(vector).sqrt();
    Some(vector.map(|coordinate| coordinate / length))
}
