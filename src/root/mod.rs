//! From a ray and a sphere to a correctly rounded root: arithmetic that is tried step by step, until one is certain.
//!
//! TABLE

mod bounded;
pub(crate) mod chord;
mod crossing;
mod format;
mod halves;
mod in_f32;
mod in_f64;
mod integers;
mod pairs;
mod plain;
pub(crate) mod precision;
mod surface;

use core::ops::Range;

use crossing::{Answer, Found, Line, Question, Verdict};
use format::Format;
use integers::Exact;

use crate::{Ray, Sphere};

#[cfg(test)]
mod tests;

/// Finds the nearest hit, where the plain step in `f32` leaves a doubt.
///
/// The line is that of the ray and the sphere. It is at hand and later steps want it, but it has just been written, and to read it
/// at once, two numbers at a time where they were not written so, takes longer than to convert them again.
#[cold]
#[inline(never)]
fn nearest_carefully_f32(
    sphere: &Sphere,
    ray: &Ray,
    line: &Line,
    range: Range<f64>,
) -> Option<Found> {
    carefully(Line::new(sphere, ray), line, Format::F32, &Question::Nearest(range))?.nearest()
}

/// Finds both roots, ascending, where the plain step in `f32` leaves a doubt. As above of the line.
#[cold]
#[inline(never)]
fn both_carefully_f32(sphere: &Sphere, ray: &Ray, line: &Line) -> Option<[f64; 2]> {
    carefully(Line::new(sphere, ray), line, Format::F32, &Question::Both)?.both()
}

/// Finds the nearest hit, where the plain step in `f64` and its correction leave a doubt.
#[cold]
#[inline(never)]
fn nearest_carefully_f64(line: &Line, range: Range<f64>) -> Option<Found> {
    carefully(*line, line, Format::F64, &Question::Nearest(range))?.nearest()
}

/// Finds both roots, ascending, where the plain step in `f64` and its correction leave a doubt.
#[cold]
#[inline(never)]
fn both_carefully_f64(line: &Line) -> Option<[f64; 2]> {
    carefully(*line, line, Format::F64, &Question::Both)?.both()
}

/// Takes the steps with a bound of the case in turn, until one is certain of the answer.
///
/// The first of them is compiled for each precision, the others once for both. Both lines are the same.
#[inline(always)]
fn carefully(converted: Line, line: &Line, format: Format, question: &Question) -> Option<Answer> {
    match bounded::chord(converted, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => in_pairs(line, format, question),
    }
}

/// Takes the steps that are compiled once for both precisions.
#[cold]
#[inline(never)]
fn in_pairs(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    if !line.is_valid() {
        return None;
    }
    let exact = Exact::new(line);
    // What is in doubt in f32 is so for pairs too, more often than not, and integers are no slower where they are narrow.
    if format == Format::F64 || exact.is_wide() {
        match pairs::chord(line, format).and_then(|chord| question.ask(&chord)) {
            Verdict::Miss => return None,
            Verdict::Hit(answer) => return Some(answer),
            Verdict::Doubt => {}
        }
    }
    match integers::chord(line, exact, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Hit(answer) => Some(answer),
        Verdict::Miss | Verdict::Doubt => None,
    }
}
