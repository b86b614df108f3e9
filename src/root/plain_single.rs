//! What the plain step in `f64` says of `f32`, where the inputs and most of their products are exact: how its roots are rounded, and
//! where the points are.

use super::answer::{Found, Side};
use super::chord::Chord;
use super::line::Setting;
use super::plain;
use crate::arithmetic::comparison::is_not_positive;
use crate::arithmetic::pair::U;
use crate::arithmetic::rounding::rounds_safely;
use crate::float::sqrt;

/// The part `clear` of the plain step.
///
/// The smaller, the more rays are decided there, but the less is known of each root; at 2⁻¹⁶ one easy case in 230 has a root too
/// close to the middle of two `f32`.
pub(super) const CLEAR: f64 = 1.0 / 65536.0;

/// The plain step's error in units of the last of 53 places, at most its relative error over 2⁻⁵³.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1,179,648")]
pub(super) const MARGIN: u32 = (plain::ROOT_ERROR / CLEAR / U) as u32;

/// Up to this square of distance over radius, t d - o is a good way from the center to the point.
///
/// With |o| ≤ 128 r, the error of t moves the point by no more than 18 u / [`CLEAR`] of 129 r, which is 2⁻²⁵ r.
pub(super) const NEAR: f64 = 16384.0;

impl Setting {
    /// The hit at a root of the plain step, with the root rounded, from no farther than [`NEAR`].
    #[inline(always)]
    pub(super) fn found(&self, t: f64, rounded: f32) -> Found {
        let Self { line, o, .. } = *self;
        let step = line.direction * t;
        let normal = (step - o) * line.radius.recip();
        Found { t: rounded.into(), point: line.origin + step, normal }
    }

    /// The same from afar, where the error of t would move the point: by the closest approach.
    ///
    /// Its foot is (h / a) d - o, and half the chord's length l = s / √a. With r² exact,
    ///
    /// ```text
    /// h / a       h 3 u without o, a 3 u, its reciprocal, a product        |error| ≤ 8 u |o|, along d
    /// (h / a) d   a product                                                |error| ≤   u |o|
    /// o           across d; along d, the error in h cancels it             |error| ≤   u |o|, across d
    /// the foot    together, √(8² + 1) u |o| + u |o|                        |error| < 9.1 u |o|
    /// l²          2 r times what the foot is off by across d, 2 u |o|      |error| ≤ 4 u r |o|
    ///             the foot's difference, its square and r² less that       |error| ≤ 5 u r²
    /// l           both over l, and as r < |o| / 128                        |error| < 5 u r |o| / l
    ///             1 / a, a product, the root                               |error| < 4 u r
    /// ```
    ///
    /// What the foot is off by along d counts in l² only by its square, which is next to nothing.
    ///
    /// A root of the plain step has l > 2⁻¹⁶ |o|, and both the foot and l are off by less than 2⁻³¹ r. The other roots are those
    /// of [`again`](super::again), whose bounds include these. The far crossing is as far from the foot as the near one.
    #[inline(always)]
    pub(super) fn found_from_afar(&self, chord: &Chord<f64>, side: Side, rounded: f32) -> Found {
        let Self { line, o, radius_squared } = *self;
        let per_a = chord.a.recip();
        // From the center to the closest approach, and the square of half the chord's length.
        let foot = line.direction * (chord.h * per_a) - o;
        let square = radius_squared - foot.length_squared();
        let along = if is_not_positive(square) { 0.0 } else { sqrt(square * per_a) };
        let along = if side == Side::Near { -along } else { along };
        let offset = foot + line.direction * along;
        let normal = offset * line.radius.recip();
        Found { t: rounded.into(), point: line.center + offset, normal }
    }
}

/// Both roots of the plain step rounded, if that is certain.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
pub(super) fn surely_rounded([near, far]: [f64; 2]) -> Option<[f32; 2]> {
    if rounds_safely::<MARGIN>(near) && rounds_safely::<MARGIN>(far) {
        let rounded = [near as f32, far as f32];
        // As for the nearest root.
        let is_certain = |rounded: f32| rounded.is_normal() && rounded.abs() != f32::MIN_POSITIVE;
        if is_certain(rounded[0]) && is_certain(rounded[1]) {
            return Some(rounded);
        }
    }
    None
}
