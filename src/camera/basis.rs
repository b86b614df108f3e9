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
use crate::arithmetic::wide::Wide;

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

/// The sum of at most four products, rounded to 106 bits.
fn sum<const N: usize>(products: [[f64; 2]; N]) -> Wide {
    /// All numbers are multiples of this, 2⁻¹⁰⁷⁴, and have so many places.
    const UNIT: i32 = -1074;
    const NUMBER: u32 = 2098;
    /// The sum of four products, and what an [`Integer`] has to spare.
    const DIGITS: usize = (2 * NUMBER + 2).div_ceil(PLACES) as usize + 3;
    let mut memory = [[0; DIGITS]; 2];
    let [mut factor, mut sum] = memory.each_mut().map(|digits| Integer::new(digits));
    for [a, b] in products {
        factor.clear();
        factor.add_number(Shifted::new(a, UNIT));
        sum.add_times(&factor, Shifted::new(b, UNIT));
    }
    sum.to_wide(2 * UNIT)
}

/// The unit vector along `vector`, unless that is zero.
fn unit(vector: [Wide; 3]) -> Option<Triple<Pair>> {
    let exponent =
        vector.into_iter().filter(|coordinate| !coordinate.is_zero()).map(Wide::exponent).max()?;
    // With the largest coordinate between 1 and 2, the length neither overflows nor underflows.
    let [x, y, z] = vector.map(|coordinate| coordinate.scaled(-exponent));
    let vector = Triple { x, y, z };
    let length = vector.dot(vector).sqrt();
    Some(vector.map(|coordinate| coordinate / length))
}
