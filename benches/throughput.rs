//! Each public function by criterion, beside the textbook: one ray and one sphere, the nearest of a slice, eye rays.
//!
//! ```text
//! cargo bench --bench throughput                  # everything, in under a minute
//! cargo bench --bench throughput -- "f32, easy"   # what matches
//! cargo bench --bench throughput -- --save-baseline before     # then, after a change: -- --baseline before
//! cargo bench --bench throughput -- --test        # each once, untimed
//! ```
//!
//! This is for comparing one version with the next. Each benchmark goes through inputs enough that the branch predictor does
//! not learn them by heart; `speed_vs_error` tells both, learned and not, in the same loop.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group};
use eyeray::{Algebraic, Camera, Geometric, Hittable, Ray, Sphere, Vector, ViewRect, nearest};
use glam::{DVec2, DVec3, Vec2, Vec3};

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::Effort;
use measure::{Measured, Test, Timed, page};
use support::families::{Case, FAMILIES, Family, Precision, Rng};

const SEED: u64 = 20;

/// The cases of each benchmark: too many to learn by heart.
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

macro_rules! nearest_of_slice {
    ($function:ident, $module:ident, $vector:ident, $float:ident) => {
        /// Small spheres about a box that the rays cross.
        fn $function(criterion: &mut Criterion) {
            use methods::$module as published;

            const RAYS: usize = 256;
            for count in [46, 1024] {
                let mut rng = Rng::new(SEED);
                let mut point = |extent: f64| $vector::from_f64(rng.unit_vector() * extent);
                let spheres: Vec<_> = (0..count).map(|_| Sphere::new(point(10.0), 0.75)).collect();
                let rays: Vec<_> = (0..RAYS)
                    .map(|_| {
                        let origin = point(20.0);
                        Ray::new(origin, point(8.0) - origin)
                    })
                    .collect();

                let mut group = criterion
                    .benchmark_group(format!("{}, nearest of {count}", stringify!($float)));
                group.throughput(Throughput::Elements((count * RAYS) as u64));
                group.bench_function("textbook", |bencher| {
                    bencher.iter(|| {
                        let mut sum = 0.0;
                        for ray in black_box(&rays) {
                            let mut found = $float::INFINITY;
                            for sphere in &spheres {
                                let t = published::ahead(published::textbook(ray, sphere));
                                found = found.min(t.unwrap_or($float::INFINITY));
                            }
                            sum += if found < $float::INFINITY { found } else { 0.0 };
                        }
                        sum
                    });
                });
                group.bench_function("nearest", |bencher| {
                    bencher.iter(|| -> $float {
                        let hits = black_box(&rays)
                            .iter()
                            .filter_map(|ray| nearest(&spheres, ray, 0.0..$float::INFINITY));
                        hits.map(|(_, hit)| hit.t).sum()
                    });
                });
            }
        }
    };
}

nearest_of_slice!(nearest_f32, single, Vec3, f32);
nearest_of_slice!(nearest_f64, double, DVec3, f64);

const EYE: Vec3 = Vec3::new(3.0, 2.0, 5.0);
const VIEW: ViewRect = ViewRect { left: -1.6, right: 1.6, bottom: -0.9, top: 0.9 };
const DISTANCE: f32 = 2.0;
const WIDTH: u32 = 160;
const HEIGHT: u32 = 90;

/// The image-plane points of the pixels' centers, as the textbook has them.
#[expect(clippy::cast_precision_loss, reason = "pixels are few")]
fn pixel_centers() -> impl Iterator<Item = (f32, f32)> {
    let u =
        |column: u32| VIEW.left + (VIEW.right - VIEW.left) * (column as f32 + 0.5) / WIDTH as f32;
    let v = |row: u32| VIEW.top - (VIEW.top - VIEW.bottom) * (row as f32 + 0.5) / HEIGHT as f32;
    (0..HEIGHT).flat_map(move |row| (0..WIDTH).map(move |column| (u(column), v(row))))
}

/// Times making all the rays of an image.
fn image<V: Precision, I: Iterator<Item = Ray<V>>>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    rays: impl Fn() -> I,
) {
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for ray in rays() {
                black_box(ray);
            }
        });
    });
}

fn eye_rays(criterion: &mut Criterion) {
    let wide = |vector: Vec3| vector.as_dvec3();
    let view = ViewRect::from(VIEW);
    let (target, up) = (Vec3::ZERO, Vec3::Y);
    let cameras = [
        (
            "perspective",
            Camera::perspective(EYE, target, up, VIEW, DISTANCE),
            Camera::perspective(wide(EYE), wide(target), wide(up), view, f64::from(DISTANCE)),
        ),
        (
            "orthographic",
            Camera::orthographic(EYE, target, up, VIEW),
            Camera::orthographic(wide(EYE), wide(target), wide(up), view),
        ),
    ];
    for (projection, camera, camera_f64) in cameras {
        let (Ok(camera), Ok(camera_f64)) = (camera, camera_f64) else { continue };
        let mut group = criterion.benchmark_group(format!("eye rays, {projection}"));
        group.throughput(Throughput::Elements(u64::from(WIDTH) * u64::from(HEIGHT)));

        let basis = camera.basis();
        if projection == "perspective" {
            image(&mut group, "f32 ray, textbook", || {
                let (eye, basis) = black_box((EYE, basis));
                pixel_centers()
                    .map(move |(u, v)| methods::perspective_ray(eye, basis, DISTANCE, u, v))
            });
        } else {
            image(&mut group, "f32 ray, textbook", || {
                let (eye, basis) = black_box((EYE, basis));
                pixel_centers().map(move |(u, v)| methods::orthographic_ray(eye, basis, u, v))
            });
        }
        image(&mut group, "f32 ray", || {
            let camera = black_box(camera);
            pixel_centers().map(move |(u, v)| camera.ray(Vec2::new(u, v)))
        });
        image(&mut group, "f32 rays", || black_box(camera).rays(WIDTH, HEIGHT));
        image(&mut group, "f64 ray", || {
            let camera = black_box(camera_f64);
            pixel_centers().map(move |(u, v)| camera.ray(DVec2::new(u.into(), v.into())))
        });
        image(&mut group, "f64 rays", || black_box(camera_f64).rays(WIDTH, HEIGHT));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .nresamples(1000)
        .warm_up_time(Duration::from_millis(50))
        .measurement_time(Duration::from_millis(150))
        .without_plots();
    targets = single_ray_f32, single_ray_f64, nearest_f32, nearest_f64, eye_rays
}

fn main() -> std::io::Result<()> {
    benches();
    Criterion::default().configure_from_args().final_summary();
    let once = std::env::args().any(|argument| argument == "--test");
    let effort = if once { Effort::Test } else { Effort::Usual };
    page::finish(
        "throughput",
        effort,
        "Each public function beside the textbook, branches not predicted, one version beside the next: criterion's \
estimates above, and in target/criterion.",
    )
}
