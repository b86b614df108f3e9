//! From a ray and a sphere to a correctly rounded root: arithmetic that is tried step by step, until one is certain.
//!
//! A [`chord`] is what both derivations find of a [`line`](mod@line) and a sphere: how far away the line passes, and where. The
//! way from there to the root reads downwards in this table; [`single`] and [`double`] are where it begins, in the user's code,
//! and from [`moved_origin`] on, for a line brought near 1 ([`scaled_line`]), it is one function for both precisions. [`power`] has
//! o·o - r² where nearly all of it cancels, [`ziv`] rounds to a [`format`](mod@format), [`ties`] compares with the number midway
//! between two floats, [`points`] finds points and normals, and [`answer`] chooses the root that a ray hits.
//!
//! | step | arithmetic | error known by | decides | time, of a family |
//! |:--|:--|:--|:--|:--|
//! | [`plain`] | `f64` | one bound for all cases | hit, miss and root in `f32`; hit and miss in `f64` | 1.9, "inside" in `f32` |
//! | [`halves`] | `f64`, exact in the leading 26 bits | one bound for all cases | the root in `f64` | 5.7, "inside" in `f64` |
//! | [`again`] | `f64` with a finer power, or by the closest approach with a bound of the case ([`bounded_chord`]) | the same | `f32` close to the surface and from afar | 4.5, "on the surface" in `f32` |
//! | [`near_surface`] | `f64` with a power in three floats | the power's | `f64` close to the surface, `f32` exactly on it | 18, "on the surface" in `f64` |
//! | [`moved_origin`] | offsets and powers in pairs of `f64`, the rest in `f64` | a bound of the case | the limb, and from afar in `f64` | 23, "at the limb from afar" in `f64` |
//! | [`integers`] | integers of 64 bits, products of 256 ([`narrow`]) | exact | tangents | 55 and 48, "exact tangent" |
//! | [`surds`] | integers of many digits | exact | coordinates that span more places, points next to a midpoint or to zero | 113, "tie of a tiny sphere" in `f64` |
//!
//! How many in a hundred each decides (`cargo test --release --lib how_often -- --nocapture` has every family; "again" counts
//! [`near_surface`], and a root compared with the midpoint of two floats counts as integers in `f32`):
//!
//! | rays and spheres | | plain, halves | again | moved origin | integers |
//! |:--|:--|--:|--:|--:|--:|
//! | unit sphere at 2 to 10 | `f32` | 99.7 | 0 | 0 | 0.3 |
//! | | `f64` | 99.8 | 0 | 0.2 | 0 |
//! | distance/radius 1e4 to 1e7 | `f32` | 60.5 | 39.1 | 0.2 | 0.2 |
//! | | `f64` | 60.6 | 0 | 39.4 | 0 |
//! | huge spheres | `f32` | 81.2 | 18.4 | 0.1 | 0.3 |
//! | | `f64` | 54.9 | 43.5 | 1.6 | 0 |
//! | grazing the limb | `f32` | 99.7 | 0 | 0.2 | 0.1 |
//! | | `f64` | 84.5 | 0 | 15.4 | 0 |
//! | from the surface | `f32` | 49.1 | 50.3 | 0.2 | 0.4 |
//! | | `f64` | 5.6 | 93.5 | 0 | 0.9 |
//! | exact tangents | `f32` | 18.9 | 0 | 0 | 81.1 |
//! | | `f64` | 19.3 | 0 | 0 | 80.7 |
//!
//! The times are those of the nearest root of a family that the step decides, misses and the steps before it included, in
//! multiples of the textbook's on easy cases in `f32` (`benches/report/speed_vs_error.md` has every family).
//!
//! A step that is not certain hands over to the next, and so does one that is certain of the root but not of the point. No step
//! assumes what another has found, so each can be tested by itself.
//!
//! From [`near_surface`] on, the points and normals are correctly rounded, too. So all these steps answer alike, bit for bit, and those between the first and the
//! last can be left out where there is no room for their code ([`Format::has_few_steps`]).

mod again;
mod answer;
pub(crate) mod bounded_chord;
pub(crate) mod chord;
mod double;
mod format;
mod halves;
mod integers;
pub(crate) mod line;
pub(crate) mod moved_origin;
mod narrow;
mod near_surface;
mod plain;
mod plain_single;
mod points;
mod power;
pub(crate) mod precision;
mod scaled_line;
mod single;
pub(crate) mod surds;
mod ties;
pub(crate) mod unit;
mod ziv;

pub(crate) use answer::Side;
use answer::{Answer, Question, Verdict};
use format::Format;
use line::Line;
use scaled_line::Scaled;

#[cfg(test)]
mod any_exponent;
#[cfg(test)]
mod tests;

/// Asks the steps that are compiled once, or of few steps the last, where the plain steps leave a doubt.
#[inline(always)]
fn ask_carefully(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    if format.has_few_steps() {
        in_any_integers(line, format, question)
    } else {
        carefully(line, format, question)
    }
}

/// Takes the steps that are the same for both precisions, and compiled once.
#[cold]
#[inline(never)]
fn carefully(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    let Some(scaled) = Scaled::new(line) else { return in_any_integers(line, format, question) };
    let verdict = moved_origin::chord(&scaled.line, format)
        .and_then(|chord| question.ask(&mut scaled.unscaled(chord)));
    match verdict {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => in_integers(line, &scaled, format, question),
    }
}

/// Takes the last step but one.
#[cold]
#[inline(never)]
fn in_integers(
    line: &Line,
    scaled: &Scaled,
    format: Format,
    question: &Question,
) -> Option<Answer> {
    let verdict = integers::chord(&scaled.line, format)
        .and_then(|chord| question.ask(&mut scaled.unscaled(chord)));
    match verdict {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => in_any_integers(line, format, question),
    }
}

/// Takes the last step.
#[inline(always)]
fn in_any_integers(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    surds::answer(line, format, question)
}
