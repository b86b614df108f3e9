//! One ray against many spheres: `Spheres` beside loops over the slice, and beside the least that the machine could take.
//!
//! ```text
//! cargo bench --bench spheres                  # tables of medians and ratios, then criterion's estimates
//! cargo bench --bench spheres -- 1024          # only the estimates of what matches, after the tables
//! cargo bench --bench spheres -- --test        # each once
//! ```
//!
//! Half of the rays come from an eye, half bounce off what those meet. The loops are those that path tracers have: a formula
//! for each sphere in turn, the nearest so far as the range's end, and the point and the normal of the nearest at last.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, Throughput, criterion_group};
use eyeray::{Camera, Hit, Hittable, Lanes, Ray, Sphere, Spheres, nearest};
use glam::{Vec3, dvec3, vec2, vec3};

#[path = "../tests/support/families.rs"]
mod families;
mod methods;

use families::Rng;
use methods::single::{ahead, parry_nearest, textbook};

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
    rays: Vec<Ray>,
}

impl Scene {
    fn new(count: usize) -> Self {
        let mut rng = Rng::new(count as u64);
        // The same density for every number; 46 are those of `examples/render/scene.rs`.
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let extent = 2.0 * (count as f64).cbrt();
        let slice: Vec<Sphere> = if count == 46 {
            path_tracer()
        } else {
            (0..count)
                .map(|_| Sphere::new(within(&mut rng, extent), number(&mut rng, 0.2, 0.8)))
                .collect()
        };
        let camera = Camera::perspective_fov(
            vec3(1.0, 2.2, 5.3),
            vec3(0.05, 0.33, -1.2),
            Vec3::Y,
            37_f32.to_radians(),
            1.5,
        );
        let camera = camera.expect("its arguments are in order");
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
        Self { spheres: slice.iter().copied().collect(), slice, rays }
    }
}

fn number(rng: &mut Rng, low: f64, high: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "any number will do")]
    let number = rng.uniform(low, high) as f32;
    number
}

fn within(rng: &mut Rng, extent: f64) -> Vec3 {
    dvec3(rng.uniform(-extent, extent), rng.uniform(-extent, extent), rng.uniform(-extent, extent))
        .as_vec3()
}

/// The spheres of Aras Pranckevičius's benchmark `ToyPathTracer`.
fn path_tracer() -> Vec<Sphere> {
    let mut spheres = vec![Sphere::new(vec3(0.0, -100.5, -1.0), 100.0)];
    let centers = [[-2, 1], [0, 1], [2, 1], [-2, -1], [0, -1], [2, -1]];
    spheres.extend(
        centers.map(|[x, z]: [i8; 2]| Sphere::new(vec3(f32::from(x), 0.0, f32::from(z)), 0.5)),
    );
    spheres.push(Sphere::new(vec3(0.5, 1.0, 0.5), 0.5));
    spheres.push(Sphere::new(vec3(-1.5, 1.5, 0.0), 0.3));
    spheres.push(Sphere::new(vec3(1.5, 1.5, -2.0), 0.3));
    for z in [-3.0, -4.0, -5.0, -6.0] {
        spheres.extend(
            (0..9_u8).map(|column| Sphere::new(vec3(4.0 - f32::from(column), 0.0, z), 0.5)),
        );
    }
    spheres
}

/// Goes through the rays of a scene.
type Pass = Box<dyn Fn(&Scene)>;

/// A pass that stores what is found of each ray.
fn pass<T>(find: impl Fn(&Scene, &Ray) -> T + 'static) -> Pass {
    Box::new(move |scene| {
        for ray in &scene.rays {
            black_box(find(scene, black_box(ray)));
        }
    })
}

fn passes() -> Vec<(String, Pass)> {
    let mut passes = vec![
        (
            "textbook".into(),
            pass(|scene, ray| {
                by_formula(&scene.slice, ray, |ray, sphere| ahead(textbook(ray, sphere)))
            }),
        ),
        (
            "parry3d's formula".into(),
            pass(|scene, ray| by_formula(&scene.slice, ray, parry_nearest)),
        ),
        ("nearest".into(), pass(|scene, ray| nearest(&scene.slice, ray, ALL).map(of_hit))),
        ("Spheres".into(), pass(|scene, ray| scene.spheres.nearest(ray, ALL).map(of_hit))),
        ("occludes".into(), pass(|scene, ray| scene.spheres.occludes(ray, ALL))),
    ];
    for lanes in Lanes::available() {
        let find = move |scene: &Scene, ray: &Ray| {
            scene.spheres.nearest_in_lanes(lanes, ray, ALL).map(of_hit)
        };
        passes.push((format!("{lanes:?}"), pass(find)));
    }
    passes
}

const COUNTS: [usize; 7] = [1, 2, 4, 8, 46, 1024, 65_536];

/// How long each pass takes for a ray of a scene, in nanoseconds: medians of rounds in which all take their turn.
fn medians(passes: &[(String, Pass)], scene: &Scene, rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::new(); passes.len()];
    for _ in 0..rounds {
        for ((_, pass), times) in passes.iter().zip(&mut times) {
            let start = Instant::now();
            pass(black_box(scene));
            times.push(start.elapsed().as_secs_f64());
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let rays = scene.rays.len() as f64;
    times
        .into_iter()
        .map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2] * 1e9 / rays
        })
        .collect()
}

/// Prints how the passes compare with the formulas, and with what the machine could do at best.
fn print_ratios(rounds: usize) {
    let passes = passes();
    println!("nanoseconds a ray, and how many times as fast as the faster formula\n");
    print!("{:>8}", "spheres");
    for (name, _) in &passes {
        print!("{name:>19}");
    }
    println!();
    let lanes = passes.len() - Lanes::available().count();
    let mut of_lanes = Vec::new();
    for count in COUNTS {
        let mut medians = medians(&passes, &Scene::new(count), rounds);
        let formula = medians[0].min(medians[1]);
        print!("{count:>8}");
        for time in &medians {
            print!("{time:>11.1} ({:>4.1}x)", formula / time);
        }
        println!();
        of_lanes.push((count, medians.split_off(lanes)));
    }

    let gigahertz = cycles_a_nanosecond();
    println!("\nnanoseconds a sphere, and how many times the least, at {gigahertz:.2} GHz\n");
    print!("{:>8}", "spheres");
    let least: Vec<f64> =
        passes[lanes..].iter().map(|(name, _)| least_cycles(name) / gigahertz).collect();
    for ((name, _), least) in passes[lanes..].iter().zip(&least) {
        print!("{:>19}", format!("{name}, {least:.3}"));
    }
    println!();
    for (count, times) in of_lanes {
        print!("{count:>8}");
        for (time, least) in times.iter().zip(&least) {
            #[expect(clippy::cast_precision_loss, reason = "counts are small")]
            let a_sphere = time / count as f64;
            print!("{a_sphere:>11.3} ({:>4.1}x)", a_sphere / least);
        }
        println!();
    }
    println!();
}

/// The least time that a set of instructions could take for a sphere, in cycles, if a core starts two vectors of products and
/// two of sums in each: the filter computes 3 sums and 8 products, each but two of them with a sum, fused where that can be.
fn least_cycles(lanes: &str) -> f64 {
    let fused = |lanes: f64| 8.0 / (2.0 * lanes);
    match lanes {
        "AVX-512" => fused(16.0),
        "AVX2" => fused(8.0),
        _ if cfg!(target_feature = "avx512f") => fused(16.0),
        _ if cfg!(all(target_feature = "avx2", target_feature = "fma")) => fused(8.0),
        _ if cfg!(target_arch = "aarch64") => fused(4.0),
        // Not fused, the products' sums are 6 more.
        _ => (3.0 + 6.0) / (2.0 * 4.0),
    }
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

fn main() {
    let once = std::env::args().any(|argument| argument == "--test");
    print_ratios(if once { 1 } else { 101 });
    benches();
    Criterion::default().configure_from_args().final_summary();
}
