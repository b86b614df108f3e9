//! What a method costs and how far it errs, family by family: the measuring that the reports share.
#![allow(dead_code, unreachable_pub, reason = "each report takes what it needs")]

pub mod accuracy;
pub mod arguments;
pub mod comparison;
pub mod conditions;
pub mod groups;
pub mod plot;
pub mod report;
pub mod timing;

use std::hint::black_box;

use eyeray::{Ray, Scalar, Sphere};

use self::timing::Pass;
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

/// Whose method it is, which the plot shows by color and shape.
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

/// Finds the first root ahead.
pub type Nearest<V> = dyn Fn(&Case<V>) -> Option<<V as eyeray::Vector>::Scalar> + Sync;

/// A way to find where a ray meets a sphere first.
pub struct Method<V: Measured> {
    /// Its short name.
    pub name: &'static str,
    /// Where it comes from, and what it does not promise.
    pub source: &'static str,
    pub kind: Kind,
    /// Whether it promises an answer.
    pub promises: Promise<V>,
    pub nearest: Box<Nearest<V>>,
    pub pass: Pass<V>,
}

impl<V: Measured> Method<V> {
    pub fn new(
        name: &'static str,
        source: &'static str,
        kind: Kind,
        nearest: impl Fn(&Ray<V>, &Sphere<V>) -> Option<V::Scalar> + Copy + Sync + 'static,
    ) -> Self {
        Self {
            name,
            source,
            kind,
            promises: |_, _| true,
            nearest: Box::new(move |(ray, sphere)| nearest(ray, sphere)),
            pass: sum_of(move |ray, sphere| nearest(ray, sphere).unwrap_or(V::Scalar::ZERO)),
        }
    }

    /// The same method, which promises an answer to these cases only.
    #[must_use]
    pub fn promising(self, promises: Promise<V>) -> Self {
        Self { promises, ..self }
    }

    /// The same method, of which this pass is timed.
    #[must_use]
    pub fn timed(self, pass: Pass<V>) -> Self {
        Self { pass, ..self }
    }
}

/// A pass over cases that adds up what a test returns, so that nothing of it is left out.
pub fn sum_of<V: Measured>(
    test: impl Fn(&Ray<V>, &Sphere<V>) -> V::Scalar + Sync + 'static,
) -> Pass<V> {
    Box::new(move |cases| {
        let mut sum = V::Scalar::ZERO;
        for (ray, sphere) in cases {
            sum = sum + test(ray, sphere);
        }
        black_box(sum);
    })
}

/// A pass over cases that has all that a test returns stored.
pub fn stored_of<V: Measured, T>(
    test: impl Fn(&Ray<V>, &Sphere<V>) -> T + Sync + 'static,
) -> Pass<V> {
    Box::new(move |cases| {
        for (ray, sphere) in cases {
            black_box(test(ray, sphere));
        }
    })
}
