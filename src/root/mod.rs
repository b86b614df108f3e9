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

use crossing::{Answer, Found, Line, Question, Verdict};
use format::Format;
use glam::{DVec3, Vec3};

use crate::{Ray, Sphere, Vector};

/// Defines what a precision calls where its plain step leaves a doubt.
///
/// The line is that of the ray and the sphere. It is handed over too because it is at hand, and is read by later steps only: what
/// has just been written is not there yet to be read at once.
macro_rules! carefully {
    ($nearest:ident, $both:ident, $vector:ty, $format:expr) => {
        /// Finds the nearest hit.
        #[cold]
        #[inline(never)]
        fn $nearest(
            sphere: &Sphere<$vector>,
            ray: &Ray<$vector>,
            line: &Line,
            start: f64,
            end: f64,
        ) -> Option<Found> {
            match carefully(sphere, ray, line, $format, &Question::Nearest(start..end)) {
                Some(Answer::Nearest(found)) => Some(found),
                _ => None,
            }
        }

        /// Finds both roots, ascending.
        #[cold]
        #[inline(never)]
        fn $both(sphere: &Sphere<$vector>, ray: &Ray<$vector>, line: &Line) -> Option<[f64; 2]> {
            match carefully(sphere, ray, line, $format, &Question::Both) {
                Some(Answer::Both(roots)) => Some(roots),
                _ => None,
            }
        }
    };
}

carefully!(nearest_carefully_f32, both_carefully_f32, Vec3, Format::F32);
carefully!(nearest_carefully_f64, both_carefully_f64, DVec3, Format::F64);

/// Takes the steps with a bound of the case in turn, until one is certain of the answer.
///
/// The first of them is compiled for each precision, the others once for both.
#[inline(always)]
fn carefully<V: Vector>(
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    line: &Line,
    format: Format,
    question: &Question,
) -> Option<Answer> {
    match bounded::chord(Line::new(sphere, ray), format).and_then(|chord| question.ask(&chord)) {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => in_pairs(line, format, question),
    }
}

#[cold]
#[inline(never)]
fn in_pairs(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    if !line.is_valid() {
        return None;
    }
    match pairs::chord(line, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => exactly(line, format, question),
    }
}

/// Takes the step that is never in doubt.
#[cold]
#[inline(never)]
fn exactly(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    match integers::chord(line, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Hit(answer) => Some(answer),
        Verdict::Miss | Verdict::Doubt => None,
    }
}
