//! Points and normals, where a careful step finds them: correctly rounded, so that it does not matter which of these steps that
//! is.
//!
//! A coordinate of the point is the exact one, rounded to the format. The normal is (t d - o) / r: each coordinate of the
//! dividend is the exact one, rounded to the digits of the format; the quotient is rounded once more; and below half an ulp of 1
//! it is zero.
//!
//! Both ends of an interval that holds a coordinate are rounded, as those of a root are. Where they are neighbors, the point's
//! coordinate is compared with the number midway ([`ties`]). Otherwise the point is taken from the origin instead of the center
//! ([`Crossing::from_root`]), and then the next step has to look.

use core::ops::Range;

use glam::DVec3;

use super::answer::{Found, Side};
use super::format::Format;
use super::line::Line;
use super::ties;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, V, two_difference, two_sum};
use crate::arithmetic::scaled_pair::ScaledPair;
use crate::arithmetic::scaling::{self, exponent, integer_and_exponent, scale};

#[cfg(test)]
mod tests;

/// Below this, half an ulp of 1, a coordinate of the normal is zero.
const fn least(format: Format) -> f64 {
    match format {
        Format::F32 => f32::EPSILON as f64 / 2.0,
        Format::F64 => f64::EPSILON / 2.0,
    }
}

/// A positive number as one in 1..2 and the exponent of its power of two.
pub(super) fn normalized(x: f64) -> (f64, i32) {
    let (integer, unit) = integer_and_exponent(x);
    #[expect(clippy::cast_possible_wrap, reason = "at most 63")]
    let exponent = unit + 63 - integer.leading_zeros() as i32;
    (scale(x, -exponent), exponent)
}

/// A coordinate of the normal, from the point's offset from the center, correctly rounded, and the radius, both in units of the
/// radius' power of two.
pub(super) fn normal(format: Format, offset: f64, radius: f64) -> f64 {
    let normal = format.nearest(offset / radius);
    if normal.abs() < least(format) { 0.0 } else { normal }
}

/// A vector whose coordinates are known within errors.
///
/// To round a coordinate, its error is added to the low part and subtracted from it ([`Format::ends`]). These two operations are
/// rounded, by half an ulp of the low part at most: the error has to include that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) value: Triple<Pair>,
    pub(super) error: Triple<f64>,
}

impl Near {
    /// Each coordinate within the same error.
    #[inline(always)]
    pub(super) fn within(value: Triple<Pair>, error: f64) -> Self {
        Self { value, error: Triple { x: error, y: error, z: error } }
    }
}

/// p + t d, with t = `root` 2^`exponent` known within a part of itself: each coordinate in units of its own power of two, and
/// known within a part of its terms.
fn on_the_line(line: &Line, root: Pair, exponent: i32, relative_error: f64) -> (Near, Triple<i32>) {
    /// Of the product and the sum.
    const ERROR: f64 = 10.0 * V;
    /// Where nothing overflows, and what underflows is next to nothing.
    const MIDDLE: i32 = 700;
    let coordinate = |p: f64, d: f64| {
        let ((p, p_exponent), (d, d_exponent)) = (normalized(p), normalized(d));
        let step = root.times(d);
        let step_exponent = exponent + d_exponent;
        let unit = p_exponent.max(step_exponent + scaling::exponent(step.hi));
        // Most are in the middle of the range as they are.
        let unit = if unit.abs() < MIDDLE { 0 } else { unit };
        let p = scale(p, p_exponent - unit);
        let [hi, lo] = [step.hi, step.lo].map(|x| scale(x, step_exponent - unit));
        let sum = two_sum(p, hi);
        // And what may underflow.
        let error = relative_error * hi.abs() + ERROR * (p.abs() + hi.abs()) + f64::MIN_POSITIVE;
        (Pair { hi: sum.hi, lo: sum.lo + lo }, error, unit)
    };
    let [x, y, z] = [0, 1, 2].map(|axis| coordinate(line.origin[axis], line.direction[axis]));
    let value = Triple { x: x.0, y: y.0, z: z.0 };
    let error = Triple { x: x.1, y: y.1, z: z.1 };
    (Near { value, error }, Triple { x: x.2, y: y.2, z: z.2 })
}

/// Where a line crosses a sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) side: Side,
    /// In units of 2^`units`.
    pub(super) point: Near,
    pub(super) units: Triple<i32>,
    /// From the center to there, and the radius, in units of their own.
    pub(super) offset: Near,
    pub(super) radius: f64,
}

impl Crossing {
    /// The point in the caller's units.
    #[inline(always)]
    pub(super) fn new(side: Side, point: Near, offset: Near, radius: f64) -> Self {
        Self { side, point, units: Triple { x: 0, y: 0, z: 0 }, offset, radius }
    }

    /// The point as p + t d, with t = `root` 2^`exponent` known within a part of itself.
    pub(super) fn from_root(
        line: &Line,
        side: Side,
        (root, exponent, relative_error): (Pair, i32, f64),
        offset: Near,
        radius: f64,
    ) -> Self {
        let (point, units) = on_the_line(line, root, exponent, relative_error);
        Self { side, point, units, offset, radius }
    }
}

/// The hit at a crossing, if its coordinates are known well enough to round them.
#[inline(always)]
pub(super) fn surely(line: Line, format: Format, t: f64, crossing: Crossing) -> Option<Found> {
    /// Where all coordinates of a normal are far above the subnormal `f32`, and no scaled number overflows.
    const MIDDLE: Range<f64> = 1.0 / 1_099_511_627_776.0..1_099_511_627_776.0; // 2^-40 to 2^40
    let Crossing { side, point, units, mut offset, mut radius } = crossing;
    if !MIDDLE.contains(&radius) {
        (offset, radius) = scaled(offset, radius)?;
    }
    let Near { value: Triple { x, y, z }, error: of_point } = point;
    let Near { value: Triple { x: u, y: v, z: w }, error: of_offset } = offset;
    let [mut low, mut high] = format.ends(
        [x.hi, y.hi, z.hi, u.hi, v.hi, w.hi],
        [x.lo, y.lo, z.lo, u.lo, v.lo, w.lo],
        [of_point.x, of_point.y, of_point.z, of_offset.x, of_offset.y, of_offset.z],
    );
    if (units.x | units.y | units.z) != 0 {
        for (i, unit) in [units.x, units.y, units.z].into_iter().enumerate() {
            [low[i], high[i]] = unscaled([low[i], high[i]], unit);
        }
    }
    let [x, y, z, u, v, w] = low;
    let normal = (DVec3::new(u, v, w) / radius).map(|coordinate| format.nearest(coordinate));
    let DVec3 { x: u, y: v, z: w } = normal.abs();
    let least = least(format);
    #[expect(clippy::needless_bitwise_bool, reason = "so that it is one decision for all")]
    let is_large = (u >= least) & (v >= least) & (w >= least);
    #[expect(clippy::needless_bitwise_bool, reason = "so that it is one decision for all")]
    let are_certain = low.iter().zip(&high).fold(true, |all, (low, high)| all & (low == high));
    if !(are_certain & is_large) {
        // A copy, so that the line itself need not be in memory.
        return in_doubt(&{ line }, format, side, t, [low, high], radius);
    }
    // A zero has no sign.
    let point = DVec3::new(x, y, z) + DVec3::ZERO;
    Some(Found { t, point, normal })
}

/// Both ends of an interval in units of 2^`unit`.
#[cold]
#[inline(never)]
fn unscaled([low, high]: [f64; 2], unit: i32) -> [f64; 2] {
    let ends = [low, high].map(|end| scale(end, unit));
    if ends.iter().all(|end| end.abs() >= 2.0 * f64::MIN_POSITIVE) {
        return ends;
    }
    // A subnormal end is rounded twice: it is moved outwards by as much as the first time may have moved it inwards.
    let [low, high] = [low - low.abs() * f64::EPSILON, high + high.abs() * f64::EPSILON];
    [low, high].map(|end| scale(end, unit))
}

/// An offset and a radius in units of the radius' power of two.
#[cold]
#[inline(never)]
fn scaled(offset: Near, radius: f64) -> Option<(Near, f64)> {
    /// Where powers of two and what they scale are normal numbers.
    const MIDDLE: i32 = 900;
    let (radius, exponent) = normalized(radius);
    if exponent.abs() > MIDDLE {
        return None;
    }
    let per_unit = scale(1.0, -exponent);
    let value = offset.value.map(|x| Pair { hi: x.hi * per_unit, lo: x.lo * per_unit });
    Some((Near { value, error: offset.error.map(|error| error * per_unit) }, radius))
}

/// The same where a coordinate is zero, or next to it, or in doubt: of the ends of point and offset.
#[cold]
#[inline(never)]
fn in_doubt(
    line: &Line,
    format: Format,
    side: Side,
    t: f64,
    [low, high]: [[f64; 6]; 2],
    radius: f64,
) -> Option<Found> {
    let [mut point, mut normal] = [DVec3::ZERO; 2];
    for axis in 0..3 {
        let (start, center) = (line.origin[axis], line.center[axis]);
        let (low, high) = ([low[axis], low[3 + axis]], [high[axis], high[3 + axis]]);
        if line.direction[axis] == 0.0 {
            // Across the line, nothing changes along it: the point is the origin there, and the difference is exact or rounded
            // once.
            let difference = two_difference(start, center);
            if format == Format::F32 && difference.lo != 0.0 || !difference.hi.is_finite() {
                return None;
            }
            point[axis] = start + 0.0;
            let (radius, exponent) = normalized(line.radius);
            let offset = format.nearest(scale(difference.hi, -exponent));
            normal[axis] = self::normal(format, offset, radius);
        } else {
            // The quotient by the radius is rounded twice, to 53 bits and to those of the format, at most by 2⁻²⁴ of itself each
            // time: it stays below the least where it is below 1 - 2⁻²² of that. What lies between is left to the next step.
            let is_zero = low[1].abs().max(high[1].abs()) < radius * least(format) * 0.999;
            normal[axis] =
                if is_zero { 0.0 } else { self::normal(format, certain(low[1], high[1])?, radius) };
            let compare = |number| ties::compare(line, side, axis, number);
            let coordinate =
                certain(low[0], high[0]).or_else(|| format.nearer([low[0], high[0]], compare))?;
            point[axis] = coordinate + 0.0;
        }
    }
    Some(Found { t, point, normal })
}

/// The number that both ends are rounded to.
fn certain(low: f64, high: f64) -> Option<f64> {
    (low == high).then_some(low)
}

/// Where a line crosses a sphere, from the center, by the lecture's closest approach: from its foot, at (o × d) × d / a, `along`
/// d / a, which is half the chord to either side. The radius and d are near 1.
///
/// The moment o × d and a are known within 2⁻⁹⁶ of themselves, 1,024 v, and `along`, a root, within 516 v. A product of a pair
/// and an `f64` rounds its low part by 3 v, and a sum of two such products by 5 v of their magnitudes. So, in r a,
///
/// ```text
/// moment × d       1,024 + 3 + 5, by Cauchy and Schwarz of |moment| |d| ≤ r a     |error| ≤ 1,032 v r a
/// along d          516 + 3, of |along| |d| ≤ r a                                  |error| ≤   519 v r a
/// their sum        5 of |moment| |d| + |along| |d| ≤ √2 r a                       |error| ≤     8 v r a
/// over a           1,024, and a quotient of pairs 12, of r                        |error| ≤ 1,036 v r
/// ```
///
/// That makes 2,595 v r, less than 2¹³ v because r < 2. The bound taken is 2¹⁶ v.
pub(super) fn from_closest_approach(
    moment: Triple<Pair>,
    d: Triple<f64>,
    along: Pair,
    a: Pair,
) -> Near {
    const ERROR: f64 = 65536.0 * V;
    let coordinate = |mj: Pair, dk: f64, mk: Pair, dj: f64| mj.times(dk) + -mk.times(dj);
    let foot = Triple {
        x: coordinate(moment.y, d.z, moment.z, d.y),
        y: coordinate(moment.z, d.x, moment.x, d.z),
        z: coordinate(moment.x, d.y, moment.y, d.x),
    };
    Near::within(foot.zip(d, |foot, d| (foot + along.times(d)) / a), ERROR)
}

/// The hit of a sphere of radius 0, if it is certain how that is rounded: there is no outward normal, but one back along the ray.
#[cold]
#[inline(never)]
pub(super) fn at_center(line: &Line, format: Format, t: f64, a: ScaledPair) -> Option<Found> {
    /// a is known within 2⁻⁹⁶ of itself, 1,024 v: its root within half of that and 4 v, and the quotient within 10 v more, 526 v.
    const ERROR: f64 = 4096.0 * V;
    let direction = line.direction.to_array();
    let longest = exponent(line.direction.abs().max_element());
    let length = a.scaled(-2 * longest).sqrt();
    let normal = direction.map(|d| Pair::from(scale(-d, -longest)) / length);
    let errors = normal.map(|x| {
        // And what may underflow.
        if x.hi == 0.0 { 0.0 } else { ERROR * x.hi.abs() + f64::MIN_POSITIVE }
    });
    let [low, high] = format.ends(normal.map(|x| x.hi), normal.map(|x| x.lo), errors);
    // A zero has no sign.
    let [point, normal] = [line.center, low.into()].map(|vector| vector + DVec3::ZERO);
    (low == high).then_some(Found { t, point, normal })
}
