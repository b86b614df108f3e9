//! The errors of methods, compared with the exact oracle.

use std::cmp::Ordering;

use eyeray::{Ray, Scalar, Sphere, Vector};
use rayon::prelude::*;

use super::{Measured, Method, SEED, Start, cases};
use crate::support::dyadic::Dyadic;
use crate::support::families::{Case, Family};
use crate::support::float::Float;
use crate::support::oracle::{self, Root, Truth};

/// Cases that share a seed.
const CHUNK: usize = 1000;

/// How a method answered the cases of a family.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Cases that the method promises to answer.
    pub judged: u64,
    /// Cases left out because the method does not promise to answer them.
    pub apart: u64,
    /// Hits called misses, and misses called hits.
    pub wrong: u64,
    /// Answers that are nearer to the other root than to the first one ahead.
    pub other_root: u64,
    /// Answers that are not the correctly rounded root.
    pub unrounded: u64,
    /// Inputs that are no ray or no sphere: a NaN, an infinity, a zero direction, a negative radius.
    pub invalid: u64,
    /// Those for which a hit was returned.
    pub invalid_hits: u64,
    /// The errors of the answers where there is a root ahead, in ulps; in f32 to save memory.
    errors: Vec<f32>,
}

/// The errors of a method on a family.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// The cases that the method promises to answer.
    pub judged: f64,
    /// In a million of these; NaN where there are none.
    pub wrong: f64,
    pub other_root: f64,
    /// In a million of all valid cases.
    pub apart: f64,
    /// Of all invalid inputs, the part that was called a hit; NaN where there were none.
    pub invalid_hits: f64,
    /// In ulps; NaN where nothing was hit.
    pub median: f64,
    pub percentile_99: f64,
    pub worst: f64,
    /// Whether every answer was the correctly rounded root.
    pub correctly_rounded: bool,
}

impl Tally {
    fn merge(mut self, other: Self) -> Self {
        self.judged += other.judged;
        self.apart += other.apart;
        self.wrong += other.wrong;
        self.other_root += other.other_root;
        self.unrounded += other.unrounded;
        self.invalid += other.invalid;
        self.invalid_hits += other.invalid_hits;
        self.errors.extend(other.errors);
        self
    }

    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    pub fn summary(mut self) -> Summary {
        let per_million = |count: u64, of: u64| count as f64 * 1e6 / of as f64;
        self.errors.sort_unstable_by(f32::total_cmp);
        let quantile = |hundredths: usize| {
            let last = self.errors.len().checked_sub(1)?;
            Some(f64::from(self.errors[last * hundredths / 100]))
        };
        let [median, percentile_99, worst] =
            [50, 99, 100].map(|hundredths| quantile(hundredths).unwrap_or(f64::NAN));
        Summary {
            judged: self.judged as f64,
            wrong: per_million(self.wrong, self.judged),
            other_root: per_million(self.other_root, self.judged),
            apart: per_million(self.apart, self.judged + self.apart),
            invalid_hits: self.invalid_hits as f64 / self.invalid as f64,
            median,
            percentile_99,
            worst,
            correctly_rounded: self.judged > 0 && self.wrong == 0 && self.unrounded == 0,
        }
    }
}

/// The first root ahead that counts: one that rounds to a finite value above 0.
struct Ahead<F> {
    rounded: F,
    /// The root less `rounded`, in ulps.
    remainder: f64,
    ulp: f64,
    /// Which of the two roots it is.
    index: usize,
}

impl<F: Float> Ahead<F> {
    fn new(index: usize, root: &Root) -> Option<Self> {
        let rounded: F = root.nearest();
        if !(rounded > F::ZERO && rounded.is_finite()) {
            return None;
        }
        // Of the two neighbors about the root, the lower one and their distance.
        let side = root.compare(&Dyadic::exactly(rounded.into()));
        let lower = rounded.ordinal() - i64::from(side == Ordering::Less);
        let upper = (lower + 1).min(F::INFINITE - 1);
        let distance = |from: i64, to: i64| -> f64 {
            F::from_ordinal(to).into() - F::from_ordinal(from).into()
        };
        let sign = if side == Ordering::Less { -1.0 } else { 1.0 };
        let remainder = sign * root.error(rounded);
        Some(Self { rounded, remainder, ulp: distance(upper - 1, upper), index })
    }

    fn error(&self, t: F) -> f64 {
        let off: f64 = t.into() - self.rounded.into();
        (off / self.ulp - self.remainder).abs()
    }
}

/// Judges methods on so many cases of a family.
pub fn judge<V: Measured>(family: &Family, methods: &[Method<V>], count: usize) -> Vec<Tally> {
    let chunks = count.div_ceil(CHUNK);
    (0..chunks)
        .into_par_iter()
        .map(|chunk| {
            let mut tallies = vec![Tally::default(); methods.len()];
            let cases = cases::<V>(family, SEED + chunk as u64, CHUNK.min(count));
            let answers: Vec<_> =
                methods.iter().map(|method| method.nearest.answers(&cases)).collect();
            for (index, case) in cases.iter().enumerate() {
                let answers = answers.iter().map(|answers| answers[index]);
                judge_case(case, methods.iter().zip(answers), &mut tallies);
            }
            tallies
        })
        .reduce(
            || vec![Tally::default(); methods.len()],
            |one, other| one.into_iter().zip(other).map(|(one, other)| one.merge(other)).collect(),
        )
}

/// Judges the methods' answers to a case.
fn judge_case<'a, V: Measured>(
    case: &Case<V>,
    answers: impl Iterator<Item = (&'a Method<V>, Option<V::Scalar>)>,
    tallies: &mut [Tally],
) {
    let (ray, sphere) = case;
    // A root that is accepted is finite and above 0.
    let answers = answers.map(|(method, answer)| {
        (method, answer.filter(|&t| t > V::Scalar::ZERO && Float::is_finite(t)))
    });
    if !is_valid(ray, sphere) {
        for ((_, answer), tally) in answers.zip(tallies) {
            tally.invalid += 1;
            tally.invalid_hits += u64::from(answer.is_some());
        }
        return;
    }

    let truth = Truth::new(ray, sphere);
    let roots = truth.as_ref().map(|truth| &truth.roots);
    let ahead = roots
        .and_then(|roots| (0..2).find_map(|index| Ahead::<V::Scalar>::new(index, &roots[index])));
    let start = match oracle::side(sphere, ray.origin) {
        Some(Ordering::Less) => Start::Inside,
        Some(Ordering::Equal) => Start::OnTheSurface,
        _ => Start::Outside,
    };
    for ((method, answer), tally) in answers.zip(tallies) {
        if !(method.promises)(case, start) {
            tally.apart += 1;
            continue;
        }
        tally.judged += 1;
        match (answer, &ahead) {
            (None, None) => {}
            (Some(t), Some(ahead)) => {
                let error = ahead.error(t);
                #[expect(clippy::cast_possible_truncation, reason = "to save room")]
                tally.errors.push(error as f32);
                tally.unrounded += u64::from(t != ahead.rounded);
                // Nothing so near is the other root, or else it makes no difference.
                if error > 1000.0 {
                    let other = roots.map_or(f64::NAN, |roots| {
                        roots[1 - ahead.index].nearest::<V::Scalar>().into()
                    });
                    let (t, right): (f64, f64) = (t.into(), ahead.rounded.into());
                    tally.other_root += u64::from((t - other).abs() < (t - right).abs());
                }
            }
            _ => tally.wrong += 1,
        }
    }
}

/// Whether the ray and the sphere are valid.
fn is_valid<V: Measured>(ray: &Ray<V>, sphere: &Sphere<V>) -> bool {
    let finite = |vector: V| Vector::to_f64(vector).is_finite();
    finite(ray.origin)
        && finite(ray.direction)
        && finite(sphere.center)
        && Float::is_finite(sphere.radius)
        && sphere.radius >= V::Scalar::ZERO
        && ray.direction != V::default()
}
