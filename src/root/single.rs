//! `f32`: the plain step in `f64`, where the inputs and most of their products are exact, and one rounding.

use core::ops::Range;

use glam::{DVec3, Vec3};

use super::answer::{Found, Question, Side, Verdict};
use super::bounded_chord::Bounded;
use super::chord::{Chord, Derivation};
use super::format::Format;
use super::halves;
use super::line::{Line, Setting};
use super::plain::{self, Both, Nearest};
use super::points::{self, Crossing, Near};
use super::precision::Precision;
use super::{ask_carefully, power, ties};
use crate::algebraic::Quadratic;
use crate::arithmetic::comparison::{exceeds, is_not_positive};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, U};
use crate::arithmetic::rounding::rounds_safely;
use crate::float::sqrt;
use crate::target::{HAS_F64, once_if};
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
pub(super) mod tests;

/// The part `clear` of the plain step.
///
/// The smaller, the more rays are decided there, but the less is known of each root; at 2⁻¹⁶ one easy case in 230 has a root too
/// close to the middle of two `f32`.
pub(super) const CLEAR: f64 = 1.0 / 65536.0;

/// The plain step's error in units of the last of 53 places, at most its relative error over 2⁻⁵³.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1,179,648")]
const MARGIN: u32 = (plain::ROOT_ERROR / CLEAR / U) as u32;

/// Up to this square of distance over radius, t d - o is a good way from the center to the point.
///
/// With |o| ≤ 128 r, the error of t moves the point by no more than 18 u / [`CLEAR`] of 129 r, which is 2⁻²⁵ r.
const NEAR: f64 = 16384.0;

impl Setting {
    /// The hit at a root of the plain step, with the root rounded, from no farther than [`NEAR`].
    #[inline(always)]
    fn found(&self, t: f64, rounded: f32) -> Found {
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
    /// of [`half_chord_from_afar`], whose bounds include these. The far crossing is as far from the foot as the near one.
    #[inline(always)]
    fn found_from_afar(&self, chord: &Chord<f64>, side: Side, rounded: f32) -> Found {
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

    /// The power where the plain one is too small to be certain.
    #[inline(always)]
    fn fine_power(&self, chord: &Chord<f64>) -> f64 {
        let (square, other) = (chord.distance_squared, self.radius_squared);
        let larger = if square > other { square } else { other };
        once_if(Format::F32.has_few_steps(), || halves::power(self.line, self.o, larger))
    }

    /// The nearest root ahead by the plain step; asked a second time, with a finer power.
    #[inline(always)]
    fn nearest_ahead(&self, chord: &Chord<f64>, is_second: bool) -> Nearest {
        if HAS_F64 && !is_second {
            return plain::nearest_ahead(chord, self.radius_squared, CLEAR, || None);
        }
        // Where `f64` is software, the same copy of the code for both times.
        let fine_power = || if is_second { Some(self.fine_power(chord)) } else { None };
        plain::nearest_ahead(chord, self.radius_squared, CLEAR, fine_power)
    }
}

/// Rounds a root of the plain step that is close to the middle of two `f32`.
#[cold]
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "it is rounded already")]
fn round_carefully(line: &Line, t: f64, half_chord: f64) -> Option<f32> {
    let side = side_of(half_chord);
    let rounded = if Format::F32.has_few_steps() {
        None
    } else {
        let compare = |midpoint| ties::compare_root(line, side, midpoint, None);
        Format::F32.round(t.into(), plain::ROOT_ERROR / CLEAR, compare)
    };
    // Only roots are asked for, so that the point is the plain step's, with many steps and with few.
    let carefully = || {
        let [near, far] = ask_carefully(line, Format::F32, &Question::Both)?.roots()?;
        Some(if side == Side::Near { near } else { far })
    };
    rounded.or_else(carefully).map(|t| t as f32)
}

/// Finds the nearest hit of a line that starts exactly on the surface: its roots are 0 and 2 h / a.
#[cold]
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn from_the_surface(line: &Line, chord: Chord<f64>, range: Range<f32>) -> Verdict<Found> {
    /// Of the point, in t |d|: with h² > clear a m, h errs by 2¹⁰ u of itself, and t by 1,030 u; o, products and sums bring 8 u
    /// r, and t |d| > 2⁻⁷ r.
    const ERROR: f64 = 4096.0 * U;
    let Chord { a, h, distance_squared, power, .. } = chord;
    if line.radius < 0.0
        || power.abs() > plain::SURE_SIGN * distance_squared
        || h * h <= CLEAR * (a * distance_squared)
    {
        return Verdict::Doubt;
    }
    let (power, error) = power::closest_power(line.o(), line.radius);
    if power.hi != 0.0 || error != 0.0 {
        return Verdict::Doubt;
    }
    if h < 0.0 {
        return Verdict::Miss;
    }
    let t = 2.0 * h / a;
    let rounded = t as f32;
    if !rounds_safely::<MARGIN>(t) || rounded <= f32::MIN_POSITIVE {
        return Verdict::Doubt;
    }
    if !range.contains(&rounded) {
        return Verdict::Miss;
    }
    let error = ERROR * (t * sqrt(a));
    let near = |value: DVec3| Near::within(Triple::from(value).map(Pair::from), error);
    let step = line.direction * t;
    let (point, offset) = (near(line.origin + step), near(step - (line.center - line.origin)));
    let crossing = Crossing { side: Side::Far, point, offset };
    points::surely(*line, Format::F32, rounded.into(), crossing)
        .map_or(Verdict::Doubt, Verdict::Hit)
}

/// Finds the nearest hit where the plain step is in doubt: with a finer power close to the surface, and with the bound of the
/// case from afar.
#[cold]
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn nearest_again(
    sphere: &Sphere,
    ray: &Ray,
    line: &Line,
    Range { start, end }: Range<f32>,
) -> Option<Found> {
    // Where `f64` is hardware, it takes less time to convert anew than to load.
    let setting = if HAS_F64 { Setting::new(sphere, ray) } else { Setting::of(*line) };
    let chord = setting.chord::<Quadratic>();
    let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
    let nearest =
        if is_far { from_afar(&setting, &chord) } else { setting.nearest_ahead(&chord, true) };
    let question = Question::Nearest(start.into()..end.into());
    let carefully = || ask_carefully(line, Format::F32, &question)?.nearest();
    let (t, half_chord) = match nearest {
        Nearest::Miss => return None,
        Nearest::Root { t, half_chord } => (t, half_chord),
        Nearest::Doubt if is_far || Format::F32.has_few_steps() => return carefully(),
        Nearest::Doubt => match from_the_surface(line, chord, start..end) {
            Verdict::Miss => return None,
            Verdict::Hit(found) => return Some(found),
            Verdict::Doubt => return carefully(),
        },
    };
    // Rounding is another matter below the normal numbers, and of what is rounded up to the smallest of them.
    let round = |t: f64, half_chord: f64| {
        let rounded = if rounds_safely::<MARGIN>(t) {
            Some(t as f32)
        } else {
            round_carefully(line, t, half_chord)
        };
        rounded.filter(|&rounded| rounded > f32::MIN_POSITIVE)
    };
    let Some(rounded) = round(t, half_chord) else { return carefully() };
    let (t, half_chord, rounded) = if rounded < start && half_chord > 0.0 {
        let (t, half_chord) = (plain::far_root(&chord, half_chord), -half_chord);
        let Some(rounded) = round(t, half_chord) else { return carefully() };
        (t, half_chord, rounded)
    } else {
        (t, half_chord, rounded)
    };
    (start..end).contains(&rounded).then(|| {
        if is_far {
            setting.found_from_afar(&chord, side_of(half_chord), rounded)
        } else {
            setting.found(t, rounded)
        }
    })
}

/// The side of a root of the plain step, by the sign of its half-chord.
#[inline(always)]
fn side_of(half_chord: f64) -> Side {
    if half_chord > 0.0 { Side::Near } else { Side::Far }
}

/// Finds half the chord of a line from farther than [`NEAR`] by the closest approach.
///
/// With the discriminant within e, half the chord s errs by e / 2 s, which counts against a sum of P or more in the root, and in
/// the point against a radius, of which it is to be less than 2⁻²⁶.
#[inline(always)]
fn half_chord_from_afar(setting: &Setting) -> Verdict<f64> {
    /// Of s P, so that the root errs by 2⁻³⁵ of itself.
    const OF_REACH: f64 = 1.0 / 17_179_869_184.0; // 2^-34
    const OF_RADIUS: f64 = 1.0 / 33_554_432.0; // 2^-25
    /// The foot of the closest approach errs by 9.1 u |o|, less than 2⁻²⁶ r up to that.
    const FARTHEST: f64 = 14_680_064.0; // 7/8 2^24

    let Setting { line, o, radius_squared } = *setting;
    let bounded = Bounded::new(o.into(), line.direction.into(), radius_squared);
    let Bounded { chord: Chord { discriminant, .. }, error, length, distance } = bounded;
    if discriminant < -error {
        return Verdict::Miss;
    }
    let half_chord = sqrt(discriminant);
    let is_certain = error < OF_REACH * (half_chord * bounded.reach())
        && error < OF_RADIUS * (half_chord * line.radius * length)
        && distance < FARTHEST * line.radius;
    if is_certain { Verdict::Hit(half_chord) } else { Verdict::Doubt }
}

/// Finds the nearest root ahead from farther than [`NEAR`].
#[inline(always)]
fn from_afar(setting: &Setting, &Chord { h, power, .. }: &Chord<f64>) -> Nearest {
    // Outside for sure: both roots lie on the side of the closest approach, as in the plain step.
    if is_not_positive(h) {
        return Nearest::Miss;
    }
    match half_chord_from_afar(setting) {
        Verdict::Miss => Nearest::Miss,
        Verdict::Hit(half_chord) => Nearest::Root { t: power / (h + half_chord), half_chord },
        Verdict::Doubt => Nearest::Doubt,
    }
}

/// Finds both roots where the plain step is in doubt, as [`nearest_again`] does.
#[cold]
#[inline(never)]
fn both_again(sphere: &Sphere, ray: &Ray, line: &Line) -> Option<[f64; 2]> {
    let setting = Setting::new(sphere, ray);
    let chord = setting.chord::<Quadratic>();
    let roots = if exceeds(chord.distance_squared, NEAR, setting.radius_squared) {
        match half_chord_from_afar(&setting) {
            Verdict::Miss => return None,
            Verdict::Hit(half_chord) => Both::from_half_chord(&chord, half_chord),
            Verdict::Doubt => Both::Doubt,
        }
    } else {
        let fine_power = || Some(setting.fine_power(&chord));
        plain::both(&chord, setting.radius_squared, CLEAR, fine_power)
    };
    if let Both::Roots { t, .. } = roots {
        if let Some(rounded) = surely_rounded(t) {
            return Some(rounded.map(f64::from));
        }
    }
    ask_carefully(line, Format::F32, &Question::Both)?.roots()
}

/// Finds the nearest hit: the plain step, and the way to the others.
// Inlined always: so that what a caller does not use of the hit is not computed.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
    let setting = Setting::new(sphere, ray);
    let chord = setting.chord::<D>();
    match setting.nearest_ahead(&chord, false) {
        Nearest::Miss => return None,
        Nearest::Root { t, half_chord } => {
            let rounded = t as f32;
            // Down to the smallest normal number, rounding is another matter.
            let is_certain = rounds_safely::<MARGIN>(t) && rounded > f32::MIN_POSITIVE;
            if is_certain && rounded >= range.start {
                // Not where that is NaN.
                let is_in_range = rounded < range.end;
                if !is_in_range {
                    return None;
                }
                let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
                // From so far outside, it is the near one.
                let side = Side::Near;
                if is_far && HAS_F64 {
                    // Apart, so that the compiler need not keep what only one of the two needs.
                    return Some(hit(sphere, ray, setting.found_from_afar(&chord, side, rounded)));
                }
                let found = if is_far {
                    setting.found_from_afar(&chord, side, rounded)
                } else {
                    setting.found(t, rounded)
                };
                return Some(hit(sphere, ray, found));
            }
            // Where the near root is below the range, the far one may be in it.
            if is_certain && HAS_F64 {
                if half_chord < 0.0 {
                    return None;
                }
                let t = plain::far_root(&chord, half_chord);
                if rounds_safely::<MARGIN>(t) {
                    let rounded = t as f32;
                    if !range.contains(&rounded) {
                        return None;
                    }
                    let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
                    let found = if is_far {
                        setting.found_from_afar(&chord, Side::Far, rounded)
                    } else {
                        setting.found(t, rounded)
                    };
                    return Some(hit(sphere, ray, found));
                }
            }
        }
        Nearest::Doubt => {}
    }
    let found = nearest_again(sphere, ray, &Line::new(sphere, ray), range)?;
    Some(hit(sphere, ray, found))
}

/// The same by a call: where `f64` is software, that costs next to nothing, and copies of the plain step much.
#[inline(never)]
fn intersect_by_a_call<D: Derivation>(
    sphere: &Sphere,
    ray: &Ray,
    range: Range<f32>,
) -> Option<Hit> {
    intersect::<D>(sphere, ray, range)
}

impl Precision for Vec3 {
    const UNIT_ULP: f64 = f32::EPSILON as f64;
    const LEAST_POSITIVE: f64 = f32::from_bits(1) as f64;

    #[inline(always)]
    fn next_above(t: f32) -> f32 {
        f32::from_bits(t.to_bits().wrapping_add(1))
    }

    #[inline(always)]
    fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        if HAS_F64 {
            intersect::<D>(sphere, ray, range)
        } else {
            intersect_by_a_call::<D>(sphere, ray, range)
        }
    }

    fn exit_at_same_t(sphere: &Sphere, ray: &Ray) -> Option<Hit> {
        let line = Line::new(sphere, ray);
        let found = ask_carefully(&line, Format::F32, &Question::Exit)?.nearest()?;
        Some(hit(sphere, ray, found))
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
    fn roots<D: Derivation>(sphere: &Sphere, ray: &Ray) -> Option<[f32; 2]> {
        let setting = Setting::new(sphere, ray);
        match plain::both(&setting.chord::<D>(), setting.radius_squared, CLEAR, || None) {
            Both::Miss => return None,
            Both::Roots { t, .. } => {
                if let Some(rounded) = surely_rounded(t) {
                    return Some(rounded);
                }
            }
            Both::Doubt => {}
        }
        let roots = both_again(sphere, ray, &Line::new(sphere, ray))?;
        Some(roots.map(|root| root as f32))
    }
}

/// Both roots of the plain step rounded, if that is certain.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
fn surely_rounded([near, far]: [f64; 2]) -> Option<[f32; 2]> {
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

/// The hit, rounded.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded already")]
fn hit(sphere: &Sphere, ray: &Ray, found: Found) -> Hit {
    let (t, point) = (found.t as f32, found.point.as_vec3());
    let (normal, error) = (found.normal.as_vec3(), point_error(t, sphere, ray));
    Hit { t, point, normal, error }
}

/// How far off the point may be besides the rounding of its coordinates, and more: see [`Hit::clearance`].
///
/// The point is off by at most the smaller of 2⁻³¹ of the distance travelled and 2⁻²⁵ of the radius; here are 2⁻²⁹ of the largest
/// coordinate of the way travelled, which is at least 1/√3 of it, and 2⁻²⁴ of the radius. A direction that is outward by the
/// rounded normal is inward in truth by no more than that is off, e < √3 2⁻²⁵, and passes the surface from e² r / 2 above it;
/// here are 2⁻⁴⁸ r.
#[inline(always)]
fn point_error(t: f32, sphere: &Sphere, ray: &Ray) -> f32 {
    const OF_DISTANCE: f32 = f32::EPSILON / 64.0;
    const OF_RADIUS: f32 = f32::EPSILON / 2.0;
    const OF_CURVATURE: f32 = f32::EPSILON * f32::EPSILON / 4.0;
    // Not `f32::max`, which takes care of NaN: here there is none.
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let Vec3 { x, y, z } = ray.direction.abs();
    let travelled = t * larger(larger(x, y), z);
    let radius = sphere.radius;
    smaller(travelled * OF_DISTANCE, radius * OF_RADIUS) + radius * OF_CURVATURE
}
