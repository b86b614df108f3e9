//! One sphere, asked for crossings in ranges that begin behind its near root: the exit, a clipping plane within, nothing ahead.
//!
//! ```text
//! cargo bench --bench ranges
//! ```
//!
//! Each ray hits a unit sphere from 2 to 10 radii, or from 1e2 to 1e4. The time of a group's `entry` is the one to compare with.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use eyeray::{Hittable, Ray, Scalar, Sphere, Vector};
use glam::{DVec3, Vec3};

#[path = "../tests/support/mod.rs"]
mod support;

use support::families::Rng;

/// More than a branch predictor learns by heart.
const CASES: usize = 2048;

/// A ray, its sphere, and where the ranges begin.
struct Case<V: Vector> {
    ray: Ray<V>,
    sphere: Sphere<V>,
    starts: [V::Scalar; 4],
}

/// What begins at each of the starts.
const RANGES: [&str; 4] = ["entry", "exit", "from the middle", "behind the sphere"];

fn cases<V: Vector>([from, to]: [f64; 2], next_above: fn(V::Scalar) -> V::Scalar) -> Vec<Case<V>> {
    let mut rng = Rng::new(1);
    let mut cases = Vec::new();
    while cases.len() < CASES {
        let center = rng.unit_vector() * 2.0;
        let origin = center + rng.unit_vector() * rng.uniform(from.ln(), to.ln()).exp();
        let target = center + rng.unit_vector() * rng.uniform(0.0, 0.9);
        let ray = Ray::new(V::from_f64(origin), V::from_f64(target - origin));
        let sphere = Sphere::new(V::from_f64(center), V::Scalar::ONE);
        if let Some([near, far]) = sphere.roots(&ray) {
            let between = |part: f64| {
                let [near, far]: [f64; 2] = [near.into(), far.into()];
                V::Scalar::from_f64(near + (far - near) * part)
            };
            let starts = [V::Scalar::ZERO, next_above(near), between(0.5), between(2.0)];
            cases.push(Case { ray, sphere, starts });
        }
    }
    cases
}

fn group<V: Vector>(criterion: &mut Criterion, name: &str, cases: &[Case<V>]) {
    let mut group = criterion.benchmark_group(format!("ranges of one sphere, {name}"));
    group.throughput(Throughput::Elements(CASES as u64));
    group.warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    for (range, what) in RANGES.into_iter().enumerate() {
        group.bench_function(what, |bencher| {
            bencher.iter(|| {
                for Case { ray, sphere, starts } in cases {
                    let range = black_box(starts[range])..V::Scalar::INFINITY;
                    let hit = black_box(sphere).intersect(black_box(ray), range);
                    black_box(hit.map(|hit| hit.t));
                }
            });
        });
    }
    group.finish();
}

fn ranges(criterion: &mut Criterion) {
    for (place, distances) in [("from near", [2.0, 10.0]), ("from far", [1e2, 1e4])] {
        let single = cases::<Vec3>(distances, |t| f32::from_bits(t.to_bits() + 1));
        group(criterion, &format!("f32, {place}"), &single);
        let double = cases::<DVec3>(distances, |t| f64::from_bits(t.to_bits() + 1));
        group(criterion, &format!("f64, {place}"), &double);
    }
}

criterion_group!(benches, ranges);
criterion_main!(benches);
