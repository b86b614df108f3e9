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

use glam::{DVec3, Vec3};

use crossing::{Answer, Line, Question, Verdict};
use format::Format;

use crate::{Ray, Sphere, Vector};

/// Answers where the plain step in `f32` leaves a doubt.
#[cold]
#[inline(never)]
fn carefully_f32(sphere: &Sphere<Vec3>, ray: &Ray<Vec3>, question: Question) -> Option<Answer> {
    carefully(sphere, ray, Format::F32, &question)
}

/// Answers where the plain step in `f64` and its correction leave a doubt.
#[cold]
#[inline(never)]
fn carefully_f64(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>, question: Question) -> Option<Answer> {
    carefully(sphere, ray, Format::F64, &question)
}

/// Takes the steps with a bound of the case in turn, until one is certain of the answer.
///
/// The first of them is compiled for each precision, the others once for both.
#[inline(always)]
fn carefully<V: Vector>(
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    format: Format,
    question: &Question,
) -> Option<Answer> {
    let line = Line::new(sphere, ray);
    match bounded::chord(line, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Miss => None,
        Verdict::Hit(answer) => Some(answer),
        Verdict::Doubt => {
            let line = Line::new(sphere, ray);
            in_pairs(&line, format, question)
        }
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
