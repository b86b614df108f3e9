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

use core::array;

use glam::DVec3;

use crate::arithmetic::exact::{Factor, Sum, Wide};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::Pair;

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

/// The sum of the products.
fn sum<const N: usize, const FACTORS: usize>(products: [[f64; FACTORS]; N]) -> Wide {
    let mut sum = Sum::zero();
    for factors in products {
        let [a, b, c] =
            array::from_fn(|i| factors.get(i).map_or(Factor::ONE, |x| Factor::from(*x)));
        sum.add(1, [a * b, c.into()]);
    }
    sum.value()
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
