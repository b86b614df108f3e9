//! The time and the error of a method, family by family: what the reports share.
#![allow(dead_code, unreachable_pub, reason = "each report takes what it needs")]

pub mod accuracy;
pub mod arguments;
pub mod comparison;
pub mod conditions;
pub mod groups;
pub mod page;
pub mod plot;
pub mod price;
pub mod report;
pub mod timing;

use std::hint::black_box;

use eyeray::{Ray, Sphere};

use self::timing::Turn;
use crate::support::families::{Case, Family, Precision, Rng};
use crate::support::oracle::Coordinates;

/// The seed of every family's cases: of its accuracy in chunks, this, the next and so on.
pub const SEED: u64 = 1;

/// A precision to measure in.
pub trait Measured: Precision + Coordinates {
    /// "f32" or "f64".
    const NAME: &'static str;

    fn generate(family: &Family, rng: &mut Rng) -> Case<Self>;
}

impl Measured for glam::Vec3 {
    const NAME: &'static str = "f32";

    fn generate(family: &Family, rng: &mut Rng) -> Case<Self> {
        (family.f32)(rng)
    }
}

impl Measured for glam::DVec3 {
    const NAME: &'static str = "f64";

    fn generate(family: &Family, rng: &mut Rng) -> Case<Self> {
        (family.f64)(rng)
    }
}

/// So many cases of a family.
pub fn cases<V: Measured>(family: &Family, seed: u64, count: usize) -> Vec<Case<V>> {
    let mut rng = Rng::new(seed);
    (0..count).map(|_| V::generate(family, &mut rng)).collect()
}

/// The kind of a method, which the plot shows by color and shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Computed in the precision of the inputs.
    Plain,
    /// Computed in f64 from f32 inputs.
    Widened,
    /// Ours.
    Eyeray,
}

/// Where the ray starts, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    Outside,
    OnTheSurface,
    Inside,
}

/// Whether an answer is promised to a case.
pub type Promise<V> = fn(&Case<V>, Start) -> bool;

/// A test that is applied to one case after the other, and whose results are stored.
///
/// There is one loop, which calls the test in one place: what is timed is what is judged. A closure that is called in two
/// places is not inlined into either, and then a call, and an answer by way of memory, is most of a fast test's time.
/// The sum of the answers instead takes the same time.
pub struct Test<V: Measured, T> {
    answer: Box<Answer<V, T>>,
}

type Answer<V, T> = dyn Fn(&[Case<V>], &mut [Option<T>]) + Sync;

impl<V: Measured, T> Test<V, T> {
    pub fn new(test: impl Fn(&Ray<V>, &Sphere<V>) -> Option<T> + Sync + 'static) -> Self {
        Self {
            answer: Box::new(move |cases, answers| {
                for ((ray, sphere), answer) in cases.iter().zip(answers) {
                    *answer = test(ray, sphere);
                    // So that each is stored before the next: a path tracer asks for one at a time.
                    black_box(answer);
                }
            }),
        }
    }

    pub fn answers(&self, cases: &[Case<V>]) -> Vec<Option<T>> {
        let mut answers = Vec::new();
        answers.resize_with(cases.len(), || None);
        (self.answer)(cases, &mut answers);
        answers
    }
}

/// What can be timed over cases, in turns with others.
pub trait Timed<V: Measured>: Sync {
    fn turn<'a>(&'a self, cases: &'a [Case<V>]) -> Turn<'a>;
}

impl<V: Measured, T> Timed<V> for Test<V, T> {
    fn turn<'a>(&'a self, cases: &'a [Case<V>]) -> Turn<'a> {
        let mut answers = self.answers(cases);
        Box::new(move || (self.answer)(black_box(cases), &mut answers))
    }
}

/// A method of finding the first hit of a ray on a sphere.
pub struct Method<V: Measured> {
    /// Its short name.
    pub name: &'static str,
    /// Its source, and its limits.
    pub source: &'static str,
    pub kind: Kind,
    /// Whether it promises an answer.
    pub promises: Promise<V>,
    /// Finds the first root ahead.
    pub nearest: Test<V, V::Scalar>,
    /// What is timed instead.
    timed: Option<Box<dyn Timed<V>>>,
}

impl<V: Measured> Method<V> {
    pub fn new(
        name: &'static str,
        source: &'static str,
        kind: Kind,
        nearest: impl Fn(&Ray<V>, &Sphere<V>) -> Option<V::Scalar> + Sync + 'static,
    ) -> Self {
        let nearest = Test::new(nearest);
        Self { name, source, kind, promises: |_, _| true, nearest, timed: None }
    }

    /// The same method, which promises an answer to these cases only.
    #[must_use]
    pub fn promising(self, promises: Promise<V>) -> Self {
        Self { promises, ..self }
    }

    /// The same method, of which this is timed.
    #[must_use]
    pub fn timed_by(self, timed: impl Timed<V> + 'static) -> Self {
        Self { timed: Some(Box::new(timed)), ..self }
    }
}

impl<V: Measured> Timed<V> for Method<V> {
    fn turn<'a>(&'a self, cases: &'a [Case<V>]) -> Turn<'a> {
        self.timed.as_ref().map_or_else(|| self.nearest.turn(cases), |timed| timed.turn(cases))
    }
}
