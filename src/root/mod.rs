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

use core::ops::Range;

use crossing::{Answer, Found, Line, Question, Verdict};
use format::Format;

/// Finds the nearest hit, where the plain steps leave a doubt.
#[cold]
#[inline(never)]
fn nearest_carefully(line: &Line, format: Format, range: Range<f64>) -> Option<Found> {
    match carefully(line, format, &Question::Nearest(range)) {
        Some(Answer::Nearest(found)) => Some(found),
        _ => None,
    }
}

/// Finds both roots, ascending, where the plain steps leave a doubt.
#[cold]
#[inline(never)]
fn both_carefully(line: &Line, format: Format) -> Option<[f64; 2]> {
    match carefully(line, format, &Question::Both) {
        Some(Answer::Both(roots)) => Some(roots),
        _ => None,
    }
}

/// Takes each step after the plain ones in turn, until one is certain of the answer.
fn carefully(line: &Line, format: Format, question: &Question) -> Option<Answer> {
    if format == Format::F32 {
        match bounded::chord(line).and_then(|chord| question.ask(&chord)) {
            Verdict::Miss => return None,
            Verdict::Hit(answer) => return Some(answer),
            Verdict::Doubt => {}
        }
    }
    if !line.is_valid() {
        return None;
    }
    match pairs::chord(line, format).and_then(|chord| question.ask(&chord)) {
        Verdict::Miss => return None,
        Verdict::Hit(answer) => return Some(answer),
        Verdict::Doubt => {}
    }
    exactly(line, format, question)
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
