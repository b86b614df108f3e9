//! The public functions of rays, spheres and cameras by criterion, beside the textbook's.
//!
//! ```text
//! cargo bench --bench throughput                  # everything, in half a minute
//! cargo bench --bench throughput -- "f32, easy"   # what matches
//! cargo bench --bench throughput -- --save-baseline before     # then, after a change: -- --baseline before
//! cargo bench --bench throughput -- --test        # each once, untimed
//! ```
//!
//! This is for comparing one version with the next. Each benchmark has more inputs than the branch predictor can learn;
//! `speed_vs_error` measures both, predicted and not, in the same loop.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group};
use eyeray::{Algebraic, Geometric, Hittable, Ray, Sphere};
use glam::{DVec3, Vec3};

mod eye_rays;
#[path = "../measure/mod.rs"]
mod measure;
#[path = "../methods/mod.rs"]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;

use measure::arguments::Effort;
use measure::{Measured, Test, Timed, page};
use support::families::{Case, FAMILIES, Family, Precision, Rng};

const SEED: u64 = 20;

/// The cases of each benchmark: more than a branch predictor can learn.
const CASES: usize = 16_384;

/// The family of that name.
fn family(name: &str) -> &'static Family {
    FAMILIES.iter().find(|family| family.name == name).expect("it is one of them")
}

/// So many cases from a generator, of those that are wanted.
fn cases<V: Precision>(
    next: fn(&mut Rng) -> Case<V>,
    wanted: impl Fn(&Case<V>) -> bool,
) -> Vec<Case<V>> {
    let mut rng = Rng::new(SEED);
    std::iter::repeat_with(|| next(&mut rng)).filter(wanted).take(CASES).collect()
}

/// Times `test` over all the cases.
fn time<V: Measured, T: 'static>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    cases: &[Case<V>],
    test: impl Fn(&Ray<V>, &Sphere<V>) -> Option<T> + Sync + 'static,
) {
    let test = Test::new(test);
    let mut turn = test.turn(cases);
    group.bench_function(name, |bencher| bencher.iter(&mut turn));
}

macro_rules! single_ray {
    ($function:ident, $module:ident, $vector:ident, $float:ident) => {
        fn $function(criterion: &mut Criterion) {
            use methods::$module::{ahead, textbook, textbook_shading};

            const ALL: std::ops::Range<$float> = 0.0..$float::INFINITY;
            let is_hit = |(ray, sphere): &Case<$vector>| sphere.intersect(ray, ALL).is_some();
            let situations = [
                ("easy", cases(family("easy").$float, |_| true)),
                ("hits only", cases(family("easy").$float, is_hit)),
                ("misses only", cases(family("easy").$float, |case| !is_hit(case))),
                ("from inside", cases(family("inside").$float, |_| true)),
                ("grazing the limb", cases(family("grazing").$float, |_| true)),
            ];
            for (situation, cases) in &situations {
                let name = format!("{}, {situation}", stringify!($float));
                let mut group = criterion.benchmark_group(name);
                group.throughput(Throughput::Elements(cases.len() as u64));

                time(&mut group, "nearest root, textbook", cases, |ray, sphere| {
                    ahead(textbook(ray, sphere))
                });
                time(&mut group, "nearest root, intersect", cases, |ray, sphere| {
                    sphere.intersect(ray, ALL).map(|hit| hit.t)
                });
                time(&mut group, "nearest root, Algebraic", cases, |ray, sphere| {
                    Algebraic(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                });
                time(&mut group, "nearest root, Geometric", cases, |ray, sphere| {
                    Geometric(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                });

                time(&mut group, "point and normal, textbook", cases, textbook_shading);
                time(&mut group, "point and normal, intersect", cases, |ray, sphere| {
                    sphere.intersect(ray, ALL)
                });

                time(&mut group, "shadow ray, textbook", cases, |ray, sphere| {
                    ahead(textbook(ray, sphere)).is_some().then_some(())
                });
                time(&mut group, "shadow ray, occludes", cases, |ray, sphere| {
                    sphere.occludes(ray, ALL).then_some(())
                });

                time(&mut group, "both roots, textbook", cases, textbook);
                time(&mut group, "both roots, roots_algebraic", cases, |ray, sphere| {
                    sphere.roots_algebraic(ray)
                });
                time(&mut group, "both roots, roots_geometric", cases, |ray, sphere| {
                    sphere.roots_geometric(ray)
                });
            }
        }
    };
}

single_ray!(single_ray_f32, single, Vec3, f32);
single_ray!(single_ray_f64, double, DVec3, f64);

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .nresamples(1001)
        .warm_up_time(Duration::from_millis(50))
        .measurement_time(Duration::from_millis(150))
        .without_plots();
    targets = single_ray_f32, single_ray_f64, eye_rays::eye_rays
}

fn main() -> std::io::Result<()> {
    benches();
    Criterion::default().configure_from_args().final_summary();
    let once = std::env::args().any(|argument| argument == "--test");
    let effort = if once { Effort::Test } else { Effort::Usual };
    page::finish(
        "throughput",
        effort,
        "The functions of rays, spheres and cameras beside the textbook's, branches not predicted, to compare one version with \
the next: the estimates above, and in target/criterion.",
    )
}
