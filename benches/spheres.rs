//! One ray against many spheres: `Spheres` and `SphereBvh` beside loops over the slice, and the scan beside the least that the
//! machine could take. (`benches/peers/many_spheres.rs` measures the hierarchy beside other libraries.)
//!
//! ```text
//! cargo bench --bench spheres                  # tables of medians and ratios, then criterion's estimates
//! cargo bench --bench spheres -- 1024          # only the estimates of what matches, after the tables
//! cargo bench --bench spheres -- --test        # each once
//! ```
//!
//! With `RUSTFLAGS='--cfg eyeray_lanes="avx2"'`, eyeray does without AVX-512, and with `"compiled"` without AVX2 too.
//!
//! Half of the rays are eye rays, half are bounce rays from their hits. The loops are those that path tracers have: a formula
//! for each sphere in turn, the nearest so far as the range's end, and the point and the normal of the nearest at last.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, Throughput, criterion_group};
use eyeray::{Hit, Hittable, Ray, Scalar, Sphere, SphereBvh, Spheres, nearest};
use glam::{Vec3, dvec3, vec2};

#[path = "../examples/render/material.rs"]
#[allow(dead_code, reason = "the spheres' looks make no difference")]
mod material;
mod measure;
mod methods;
#[path = "../examples/render/scene.rs"]
#[allow(dead_code, reason = "only the spheres and the camera are needed")]
mod scene;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::Effort;
use measure::page;
use measure::timing::{self, PassOver, Regime};
use methods::single::{ahead, parry_nearest, textbook};
use scene::View;
use support::families::Rng;

const ALL: std::ops::Range<f32> = 0.0..f32::INFINITY;

/// What a loop finds: index, t, point and normal.
type Found = Option<(usize, f32, Vec3, Vec3)>;

/// The nearest by a formula for t.
#[inline(always)]
fn by_formula(spheres: &[Sphere], ray: &Ray, t: impl Fn(&Ray, &Sphere) -> Option<f32>) -> Found {
    let mut end = f32::INFINITY;
    let mut found = None;
    for (index, sphere) in spheres.iter().enumerate() {
        if let Some(t) = t(ray, sphere).filter(|&t| t < end) {
            end = t;
            found = Some(index);
        }
    }
    let sphere = spheres.get(found?)?;
    let point = ray.at(end);
    Some((found?, end, point, (point - sphere.center) / sphere.radius))
}

fn of_hit((index, hit): (usize, Hit)) -> (usize, f32, Vec3, Vec3) {
    (index, hit.t, hit.point, hit.normal)
}

/// Spheres, and the rays to ask for.
struct Scene {
    slice: Vec<Sphere>,
    spheres: Spheres,
    bvh: SphereBvh,
    rays: Vec<Ray>,
}

impl Scene {
    fn new(count: usize) -> Self {
        let mut rng = Rng::new(count as u64);
        // The same density for every number; 46 are those of the example, seen by its camera.
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let extent = 2.0 * (count as f64).cbrt();
        let slice: Vec<Sphere> = if count == 46 {
            scene::Scene::new().spheres.iter().collect()
        } else {
            (0..count)
                .map(|_| Sphere::new(within(&mut rng, extent), number(&mut rng, 0.2, 0.8)))
                .collect()
        };
        let camera = View::Perspective.camera(720, 480).expect("its arguments are in order");
        let mut eye_ray = || {
            if count == 46 {
                let pixel = vec2(number(&mut rng, 0.0, 720.0), number(&mut rng, 0.0, 480.0));
                (camera.pixel_ray(pixel, 720, 480), rng.unit_vector().as_vec3())
            } else {
                let eye = within(&mut rng, extent * 2.5);
                let target = within(&mut rng, extent * 0.7);
                (Ray::new(eye, target - eye), rng.unit_vector().as_vec3())
            }
        };
        // More than a branch predictor learns by heart, as long as a round stays short.
        let rays = if count > 10_000 { 64 } else { 4096 };
        let mut eye = Vec::new();
        let mut bounced = Vec::new();
        while bounced.len() < rays / 2 {
            let (ray, sideways) = eye_ray();
            if let Some((_, hit)) = nearest(&slice, &ray, ALL) {
                bounced.push(hit.spawn(hit.normal + sideways));
            }
            if eye.len() < rays / 2 {
                eye.push(ray);
            }
        }
        let rays = eye.into_iter().zip(bounced).flat_map(|(eye, bounced)| [eye, bounced]).collect();
        Self {
            spheres: slice.iter().copied().collect(),
            bvh: slice.iter().copied().collect(),
            slice,
            rays,
        }
    }
}

fn number(rng: &mut Rng, low: f64, high: f64) -> f32 {
    f32::from_f64(rng.uniform(low, high))
}

fn within(rng: &mut Rng, extent: f64) -> Vec3 {
    dvec3(rng.uniform(-extent, extent), rng.uniform(-extent, extent), rng.uniform(-extent, extent))
        .as_vec3()
}

/// Goes through the rays of a scene.
type Pass = PassOver<Scene>;

/// A pass that stores the result of each ray.
fn pass<T>(find: impl Fn(&Scene, &Ray) -> T + Sync + 'static) -> Pass {
    Box::new(move |scene| {
        for ray in &scene.rays {
            black_box(find(scene, black_box(ray)));
        }
    })
}

fn passes() -> Vec<(&'static str, Pass)> {
    vec![
        (
            "textbook",
            pass(|scene, ray| {
                by_formula(&scene.slice, ray, |ray, sphere| ahead(textbook(ray, sphere)))
            }),
        ),
        ("parry3d's formula", pass(|scene, ray| by_formula(&scene.slice, ray, parry_nearest))),
        ("nearest", pass(|scene, ray| nearest(&scene.slice, ray, ALL).map(of_hit))),
        ("Spheres", pass(|scene, ray| scene.spheres.nearest(ray, ALL).map(of_hit))),
        ("SphereBvh", pass(|scene, ray| scene.bvh.nearest(ray, ALL).map(of_hit))),
        ("occludes", pass(|scene, ray| scene.spheres.occludes(ray, ALL))),
    ]
}

/// The place of `Spheres` among them.
const SCAN: usize = 3;

const COUNTS: [usize; 7] = [1, 2, 4, 8, 46, 1024, 65_536];

/// How the passes compare with the formulas, and with what the machine could do at best.
fn ratios(rounds: usize) -> String {
    let mut text = String::new();
    let passes = passes();
    let (lanes, least) = lanes();
    let _ = writeln!(
        text,
        "Nearest hit of one f32 ray among spheres, `Spheres` by {lanes}: nanoseconds a ray, and how many times as fast as the \
faster formula.\n"
    );
    let _ = write!(text, "{:>8}", "spheres");
    for (name, _) in &passes {
        let _ = write!(text, "{name:>19}");
    }
    let _ = writeln!(text);
    let turns: Vec<_> = passes.iter().map(|(_, pass)| pass).collect();
    let mut scanned = Vec::new();
    for count in COUNTS {
        let scene = Scene::new(count);
        let rays = scene.rays.len();
        let regime = Regime { cases: rays, warm_up: 0, timed: 1, rounds };
        let medians = timing::medians(&turns, &scene, rays, regime);
        let formula = medians[0].min(medians[1]);
        let _ = write!(text, "{count:>8}");
        for time in &medians {
            let _ = write!(text, "{time:>11.1} ({:>4.1}x)", formula / time);
        }
        let _ = writeln!(text);
        scanned.push((count, medians[SCAN]));
    }

    let gigahertz = cycles_a_nanosecond();
    let _ = writeln!(
        text,
        "\n`Spheres`: nanoseconds a sphere, and how many times the least, at {gigahertz:.2} GHz\n"
    );
    let least = least / gigahertz;
    let _ = writeln!(text, "{:>8}{:>19}", "spheres", format!("{lanes}, {least:.3}"));
    for (count, time) in scanned {
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let a_sphere = time / count as f64;
        let _ = writeln!(text, "{count:>8}{a_sphere:>11.3} ({:>4.1}x)", a_sphere / least);
    }
    text
}

/// The instructions that `Spheres` uses, and the least time that they could take for a sphere, in cycles, if a core starts two
/// vectors of products and two of sums in each: the filter computes 3 sums and 8 products, each but two of them with a sum,
/// fused where that can be.
fn lanes() -> (&'static str, f64) {
    let fused = |lanes: f64| 8.0 / (2.0 * lanes);
    #[cfg(target_arch = "x86_64")]
    {
        let all = !cfg!(any(eyeray_lanes = "avx2", eyeray_lanes = "compiled"));
        if is_x86_feature_detected!("avx512f") && (all || cfg!(target_feature = "avx512f")) {
            return ("AVX-512", fused(16.0));
        }
        let detected = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        let compiled = cfg!(all(target_feature = "avx2", target_feature = "fma"));
        if detected && (!cfg!(eyeray_lanes = "compiled") || compiled) {
            return ("AVX2", fused(8.0));
        }
        // Not fused, the products' sums are 6 more.
        ("SSE2", (3.0 + 6.0) / (2.0 * 4.0))
    }
    #[cfg(not(target_arch = "x86_64"))]
    ("four lanes", fused(4.0))
}

/// The processor's cycles a nanosecond: those of a chain of products of integers, each of which takes three on every
/// processor of the last ten years.
fn cycles_a_nanosecond() -> f64 {
    const PRODUCTS: u32 = 1_000_000;
    let nanoseconds = (0..11).map(|_| {
        let start = Instant::now();
        let mut product = black_box(3_u64);
        for _ in 0..PRODUCTS {
            product = black_box(5_u64).wrapping_mul(product);
        }
        black_box(product);
        start.elapsed().as_secs_f64() * 1e9
    });
    3.0 * f64::from(PRODUCTS) / nanoseconds.fold(f64::INFINITY, f64::min)
}

fn estimates(criterion: &mut Criterion) {
    for count in COUNTS {
        let scene = Scene::new(count);
        let mut group = criterion.benchmark_group(count.to_string());
        group.throughput(Throughput::Elements((count * scene.rays.len()) as u64));
        for (name, pass) in passes() {
            group.bench_function(name, |bencher| bencher.iter(|| pass(black_box(&scene))));
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(400))
        .without_plots();
    targets = estimates
}

fn main() -> std::io::Result<()> {
    let once = std::env::args().any(|argument| argument == "--test");
    let ratios = ratios(if once { 1 } else { 101 });
    benches();
    Criterion::default().configure_from_args().final_summary();
    page::finish("spheres", if once { Effort::Test } else { Effort::Usual }, &ratios)
}
