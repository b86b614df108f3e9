//! The second chance of `f32` where the plain step leaves a doubt: a finer power close to the surface, and the bound of the case
//! from afar.

use core::ops::Range;

use super::answer::{Found, Question, Side, Verdict};
use super::ask_carefully;
use super::bounded_chord::Bounded;
use super::chord::Chord;
use super::format::Format;
use super::line::{Line, Setting};
use super::near_surface::from_the_surface;
use super::plain::{self, Both, Nearest};
use super::plain_single::{CLEAR, MARGIN, NEAR, surely_rounded};
use super::{power, ties};
use crate::algebraic::Quadratic;
use crate::arithmetic::comparison::{exceeds, is_not_positive};
use crate::arithmetic::rounding::rounds_safely;
use crate::float::sqrt;
use crate::target::{HAS_F64, once_if};
use crate::{Ray, Sphere};

#[cfg(test)]
pub(super) mod tests;

/// The power where the plain one is too small to be certain.
#[inline(always)]
fn fine_power(setting: &Setting, chord: &Chord<f64>) -> f64 {
    let larger = setting.larger(chord);
    once_if(Format::F32.has_few_steps(), || power::power_in_halves(setting.line, setting.o, larger))
}

/// The nearest root ahead by the plain step; asked a second time, with a finer power.
#[inline(always)]
pub(super) fn nearest_ahead(setting: &Setting, chord: &Chord<f64>, is_second: bool) -> Nearest {
    if HAS_F64 && !is_second {
        return plain::nearest_ahead(chord, setting.radius_squared, CLEAR, || None);
    }
    // Where `f64` is software, the same copy of the code for both times.
    let fine_power = || if is_second { Some(fine_power(setting, chord)) } else { None };
    plain::nearest_ahead(chord, setting.radius_squared, CLEAR, fine_power)
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

/// Finds the nearest hit where the plain step is in doubt: with a finer power close to the surface, and with the bound of the
/// case from afar.
#[cold]
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
pub(super) fn nearest_again(
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
        if is_far { from_afar(&setting, &chord) } else { nearest_ahead(&setting, &chord, true) };
    let wide = f64::from(start)..f64::from(end);
    let carefully =
        || ask_carefully(line, Format::F32, &Question::Nearest(wide.clone()))?.nearest();
    let (t, half_chord) = match nearest {
        Nearest::Miss => return None,
        Nearest::Root { t, half_chord } => (t, half_chord),
        Nearest::Doubt if is_far || Format::F32.has_few_steps() => return carefully(),
        Nearest::Doubt => {
            return from_the_surface(*line, Format::F32, &wide).unwrap_or_else(carefully);
        }
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
pub(super) fn both_again(sphere: &Sphere, ray: &Ray, line: &Line) -> Option<[f64; 2]> {
    let setting = Setting::new(sphere, ray);
    let chord = setting.chord::<Quadratic>();
    let roots = if exceeds(chord.distance_squared, NEAR, setting.radius_squared) {
        match half_chord_from_afar(&setting) {
            Verdict::Miss => return None,
            Verdict::Hit(half_chord) => Both::from_half_chord(&chord, half_chord),
            Verdict::Doubt => Both::Doubt,
        }
    } else {
        let fine_power = || Some(fine_power(&setting, &chord));
        plain::both(&chord, setting.radius_squared, CLEAR, fine_power)
    };
    if let Both::Roots { t, .. } = roots {
        if let Some(rounded) = surely_rounded(t) {
            return Some(rounded.map(f64::from));
        }
    }
    ask_carefully(line, Format::F32, &Question::Both)?.roots()
}
