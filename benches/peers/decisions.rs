//! CGAL beside eyeray where only hit or miss is asked: it decides exactly, and gives no root.

use std::cmp::Ordering;
use std::hint::black_box;

use eyeray_peers_cgal::{self as cgal, DECISIONS, Decision};
use rayon::prelude::*;

use crate::measure::arguments::Effort;
use crate::measure::price;
use crate::measure::report::Table;
use crate::measure::timing::Turn;
use crate::measure::{Measured, SEED, Timed, cases, groups};
use crate::support::families::{Case, Family};
use crate::support::oracle::{self, Truth};

/// A decision of CGAL's, asked for cases in either precision.
struct OfCgal(Decision);

fn as_cgal_has_it<V: Measured>((ray, sphere): &Case<V>) -> cgal::Case {
    let coordinates = |vector: V| vector.to_f64().to_array();
    cgal::Case {
        origin: coordinates(ray.origin),
        direction: coordinates(ray.direction),
        center: coordinates(sphere.center),
        radius: sphere.radius.into(),
    }
}

impl<V: Measured> Timed<V> for OfCgal {
    fn turn<'a>(&'a self, cases: &'a [Case<V>]) -> Turn<'a> {
        let cases: Vec<_> = cases.iter().map(as_cgal_has_it).collect();
        let mut answers = vec![false; cases.len()];
        Box::new(move || {
            self.0.decide(black_box(&cases), &mut answers);
            black_box(&answers);
        })
    }
}

/// What is the case: whether the line meets the sphere, and whether the ray does, its origin being part of it for CGAL.
/// `None` where the two take an origin on the surface differently, and where there is no ray or no sphere.
fn truth<V: Measured>((ray, sphere): &Case<V>) -> Option<[bool; 2]> {
    let side = oracle::side(sphere, ray.origin)?;
    let finite = ray.direction.to_f64().is_finite() && ray.direction != V::default();
    if !finite || side == Ordering::Equal || sphere.radius < V::Scalar::default() {
        return None;
    }
    let Some(truth) = Truth::new(ray, sphere) else { return Some([false; 2]) };
    // Above 0, however small.
    let ahead = truth.roots[1].compare(&crate::support::dyadic::Dyadic::exactly(0.0));
    Some([true, ahead == Ordering::Greater])
}

/// Of the cases of a family, how many in a million each decision has wrong.
fn wrong<V: Measured>(family: &Family, count: usize) -> Vec<f64> {
    const CHUNK: usize = 1000;
    let counts = (0..count.div_ceil(CHUNK)).into_par_iter().map(|chunk| {
        let cases = cases::<V>(family, SEED + chunk as u64, CHUNK.min(count));
        let truths: Vec<_> = cases.iter().map(truth).collect();
        let theirs: Vec<_> = cases.iter().map(as_cgal_has_it).collect();
        let judged = truths.iter().flatten().count();
        let wrong = DECISIONS.map(|decision| {
            let mut answers = vec![false; cases.len()];
            decision.decide(&theirs, &mut answers);
            let right = |truth: &[bool; 2]| truth[usize::from(!decision.is_line)];
            let pairs = truths.iter().zip(answers);
            pairs
                .filter(|(truth, answer)| {
                    truth.as_ref().is_some_and(|truth| right(truth) != *answer)
                })
                .count()
        });
        (judged, wrong)
    });
    let (judged, wrong) = counts.reduce(
        || (0, DECISIONS.map(|_| 0)),
        |mut sum, (judged, wrong)| {
            sum.0 += judged;
            for (sum, wrong) in sum.1.iter_mut().zip(wrong) {
                *sum += wrong;
            }
            sum
        },
    );
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    wrong.map(|wrong| wrong as f64 * 1e6 / judged as f64).to_vec()
}

/// The families that tell the kernels apart.
const FAMILIES: [&str; 11] = [
    "easy",
    "inside",
    "far",
    "very far",
    "huge",
    "grazing",
    "grazing from afar",
    "exact tangent",
    "tangent's neighbor",
    "scene scale",
    "random finite bits",
];

/// The table of a precision: of so many cases a family, the wrong decisions, and the times beside ours for the same
/// questions, of a line and of a ray.
pub fn compare<V: Measured>(
    line: &dyn Timed<V>,
    ray: &dyn Timed<V>,
    full_cases: usize,
    effort: Effort,
) -> String {
    if DECISIONS.is_empty() {
        let skipped = "Skipped: CGAL is not installed (Debian: `apt-get install libcgal-dev`).\n";
        eprint!("{skipped}");
        return skipped.into();
    }
    let count = effort.cases(full_cases);
    let theirs = DECISIONS.map(OfCgal);
    let mut tests: Vec<&dyn Timed<V>> = vec![line, ray];
    tests.extend(theirs.iter().map(|test| -> &dyn Timed<V> { test }));

    let mut heads = vec!["what".to_owned()];
    heads.extend(["line, eyeray", "ray, eyeray"].map(Into::into));
    heads.extend(DECISIONS.map(|decision| decision.name.into()));
    let mut table = Table::new(&heads.iter().map(String::as_str).collect::<Vec<_>>());
    for family in groups::families().filter(|family| FAMILIES.contains(&family.name)) {
        let times = price::predicted(&tests, line, family, effort);
        let mut cells = vec![format!("{} {}", V::NAME, family.name)];
        cells.extend(times[..2].iter().map(|time| format!("{:.1} ns", time.nanoseconds)));
        for (time, wrong) in times[2..].iter().zip(wrong::<V>(family, count)) {
            let time = format!("{:.0} ns", time.nanoseconds);
            cells.push(if wrong > 0.0 { format!("{wrong:.0} wrong, {time}") } else { time });
        }
        table.row(cells);
    }
    table.to_string()
}
