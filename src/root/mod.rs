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

use crossing::{Crossings, Found, Line, Verdict, both, nearest};
use format::Format;

/// Finds the nearest hit, where the plain steps leave a doubt.
#[cold]
#[inline(never)]
fn nearest_carefully(line: &Line, format: Format, range: Range<f64>) -> Option<Found> {
    carefully(line, format, |crossings| nearest(crossings, &range))
}

/// Finds both roots, ascending, where the plain steps leave a doubt.
#[cold]
#[inline(never)]
fn both_carefully(line: &Line, format: Format) -> Option<[f64; 2]> {
    carefully(line, format, both)
}

/// Takes each step after the plain ones in turn, until one is certain of what is asked of its crossings.
#[inline(always)]
fn carefully<T>(
    line: &Line,
    format: Format,
    ask: impl Fn(&dyn Crossings) -> Verdict<T>,
) -> Option<T> {
    if format == Format::F32 {
        match bounded::chord(line).and_then(|chord| ask(&chord)) {
            Verdict::Miss => return None,
            Verdict::Hit(answer) => return Some(answer),
            Verdict::Doubt => {}
        }
    }
    if !line.is_valid() {
        return None;
    }
    match pairs::chord(line, format).and_then(|chord| ask(&chord)) {
        Verdict::Miss => return None,
        Verdict::Hit(answer) => return Some(answer),
        Verdict::Doubt => {}
    }
    match integers::chord(line, format).and_then(|chord| ask(&chord)) {
        Verdict::Hit(answer) => Some(answer),
        Verdict::Miss | Verdict::Doubt => None,
    }
}
