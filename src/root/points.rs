//! Points and normals, where a careful step finds them: correctly rounded, so that it does not matter which of these steps that
//! is.
//!
//! A coordinate of the point is the exact one, rounded to the format. The normal is (t d - o) / r: each coordinate of the
//! dividend is the exact one, rounded to the digits of the format; the quotient is rounded once more; and below half an ulp of 1
//! it is zero.
//!
//! Both ends of an interval that holds a coordinate are rounded, as those of a root are. Where they are neighbors, the point's
//! coordinate is compared with the number midway ([`ties`]). Otherwise the point is taken from the origin instead of the center
//! ([`on_the_line`]), and then the next step has to look.

use core::ops::Range;

use glam::DVec3;

use super::answer::{Found, Side};
use super::format::Format;
use super::line::Line;
use super::ties;
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{LEAST_PAIR, Pair, V, two_difference, two_sum};
use crate::arithmetic::scaling::{integer_and_exponent, scale};

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

/// A coordinate of the normal, from the point's offset from the center, correctly rounded, and the radius, both in the same units.
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

/// p + t d, with t known within a part of itself.
pub(super) fn on_the_line(line: &Line, root: Pair, relative_error: f64) -> Near {
    /// Of the product and the sum.
    const ERROR: f64 = 10.0 * V;
    let terms = Triple::from(line.origin).zip(line.direction.into(), |p, d| {
        let step = root.times(d);
        let sum = two_sum(p, step.hi);
        // And what may underflow.
        let error = relative_error * step.hi.abs() + ERROR * (p.abs() + step.hi.abs()) + LEAST_PAIR;
        (Pair { hi: sum.hi, lo: sum.lo + step.lo }, error)
    });
    let Triple { x, y, z } = terms;
    Near { value: Triple { x: x.0, y: y.0, z: z.0 }, error: Triple { x: x.1, y: y.1, z: z.1 } }
}

/// Where a line crosses a sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) side: Side,
    pub(super) point: Near,
    /// From the center to there.
    pub(super) offset: Near,
}

/// The hit at a crossing, if its coordinates are known well enough to round them.
#[inline(always)]
pub(super) fn surely(line: Line, format: Format, t: f64, crossing: Crossing) -> Option<Found> {
    /// Where all coordinates of a normal are far above the subnormal `f32` before they are divided by the radius.
    const MIDDLE: Range<f64> = 1.0 / 1_099_511_627_776.0..1_099_511_627_776.0; // 2^-40 to 2^40
    let (Crossing { side, point, mut offset }, mut radius) = (crossing, line.radius);
    if !MIDDLE.contains(&radius) {
        (offset, radius) = scaled(offset, radius)?;
    }
    let Near { value: Triple { x, y, z }, error: of_point } = point;
    let Near { value: Triple { x: u, y: v, z: w }, error: of_offset } = offset;
    let [low, high] = format.ends(
        [x.hi, y.hi, z.hi, u.hi, v.hi, w.hi],
        [x.lo, y.lo, z.lo, u.lo, v.lo, w.lo],
        [of_point.x, of_point.y, of_point.z, of_offset.x, of_offset.y, of_offset.z],
    );
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
            let compare = |number| ties::compare_coordinate(line, side, axis, number);
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

/// The hit of a sphere of radius 0, if it is certain how that is rounded: there is no outward normal, but one back along the ray.
#[cold]
#[inline(never)]
pub(super) fn at_center(line: &Line, format: Format, t: f64, a: Pair) -> Option<Found> {
    /// a is known within 2⁻⁹⁶ of itself, 1,024 v: its root within half of that and 4 v, and the quotient within 10 v more, 526 v.
    const ERROR: f64 = 4096.0 * V;
    let length = a.sqrt();
    let normal = line.direction.to_array().map(|d| Pair::from(-d) / length);
    // A quotient that may underflow is in doubt.
    let errors = normal.map(|x| if x.hi == 0.0 { 0.0 } else { ERROR * x.hi.abs() + LEAST_PAIR });
    let [low, high] = format.ends(normal.map(|x| x.hi), normal.map(|x| x.lo), errors);
    // A zero has no sign.
    let [point, normal] = [line.center, low.into()].map(|vector| vector + DVec3::ZERO);
    (low == high).then_some(Found { t, point, normal })
}
