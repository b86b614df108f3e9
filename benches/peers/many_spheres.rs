//! One ray against many spheres: `SphereBvh` beside a scan, obvhs and Embree, in turns, one thread.
//!
//! ```text
//! cargo bench --manifest-path benches/peers/Cargo.toml --bench many_spheres
//! cargo bench --manifest-path benches/peers/Cargo.toml --bench many_spheres -- --seed 7 chain   # other numbers, one scene
//! cargo bench --manifest-path benches/peers/Cargo.toml --bench many_spheres -- --pictures       # only the second table
//! ```
//!
//! Half of the rays are eye rays, half bounce off what those meet. A second table has the rays of a picture, and takes many at a
//! time. Without Debian's libembree-dev, Embree is skipped. With `RUSTFLAGS='--cfg eyeray_lanes="avx2"'` eyeray does without
//! AVX-512, and with `"compiled"` without AVX2 too. Embree chooses for itself: in Debian's build, up to AVX2.
#![allow(missing_docs, reason = "a benchmark")]

#[allow(dead_code, reason = "the example's")]
#[path = "../../examples/many_spheres/src/obvhs.rs"]
mod by_obvhs;
#[path = "many_spheres/pictures.rs"]
mod pictures;
#[path = "many_spheres/scenes.rs"]
mod scenes;

use std::hint::black_box;
use std::time::Instant;

use by_obvhs::Hierarchy;
use eyeray::{Hittable, Ray, Sphere, SphereBvh, Spheres};
use scenes::{SCENES, Scene};

const ALL: std::ops::Range<f32> = 0.0..f32::INFINITY;

/// Rays that are timed together.
const BATCH: usize = 500;

/// What the command line asks for.
struct Arguments {
    seed: u64,
    rounds: usize,
    rays: usize,
    /// Only the rays of pictures.
    pictures: bool,
    /// Only scenes whose name has this in it.
    only: String,
}

fn arguments() -> Result<Arguments, lexopt::Error> {
    use lexopt::prelude::*;
    let mut arguments =
        Arguments { seed: 1, rounds: 9, rays: 40_000, pictures: false, only: String::new() };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("seed") => arguments.seed = parser.value()?.parse()?,
            Long("rounds") => arguments.rounds = parser.value()?.parse()?,
            Long("rays") => arguments.rays = parser.value()?.parse()?,
            Long("pictures") => arguments.pictures = true,
            Long("test") => (arguments.rounds, arguments.rays) = (1, 200),
            Long("bench") => {}
            Value(name) => arguments.only = name.string()?,
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(arguments)
}

/// Takes all rays once.
type Pass<'a> = Box<dyn Fn(&[Ray]) + 'a>;

fn pass<'a, T>(find: impl Fn(&Ray) -> T + 'a) -> Pass<'a> {
    Box::new(move |rays| {
        for ray in rays {
            black_box(find(black_box(ray)));
        }
    })
}

fn milliseconds<T>(make: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let made = make();
    (made, start.elapsed().as_secs_f64() * 1e3)
}

fn main() {
    let arguments = match arguments() {
        Ok(arguments) => arguments,
        Err(error) => {
            eprintln!("many_spheres: {error}");
            std::process::exit(2);
        }
    };
    if embree::Device::new().is_none() {
        println!("Embree is skipped: Debian's libembree-dev is not installed");
    }
    if !arguments.pictures {
        one_at_a_time(&arguments);
    }
    pictures::print_head();
    for scene in SCENES.iter().filter(|scene| scene.name.contains(&arguments.only)) {
        let spheres = (scene.spheres)(arguments.seed);
        let hierarchy = spheres.iter().collect();
        let embree = embree::Device::new().and_then(|device| device.build(&numbers(&spheres)));
        pictures::print_row(scene.name, &spheres, &hierarchy, embree.as_ref(), arguments.rounds);
    }
}

/// The first table.
fn one_at_a_time(arguments: &Arguments) {
    println!(
        "nearest and occluded: ns a ray, and SphereBvh's time as a part of the other's; build: ms"
    );
    println!("{:<24}{:>52} |{:>24} |{:>24}", "", "nearest", "occluded", "build");
    println!(
        "{:<24}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8} |{:>9}{:>9}{:>6} |{:>9}{:>9}{:>6}",
        "scene",
        "scan",
        "obvhs",
        "Embree",
        "eyeray",
        "/Embree",
        "/scan",
        "Embree",
        "eyeray",
        "",
        "Embree",
        "eyeray",
        "",
    );
    for scene in SCENES.iter().filter(|scene| scene.name.contains(&arguments.only)) {
        row(scene, arguments);
    }
}

/// x, y, z and radius of each.
fn numbers(spheres: &[Sphere]) -> Vec<[f32; 4]> {
    let numbers = |&Sphere { center, radius }: &Sphere| [center.x, center.y, center.z, radius];
    spheres.iter().map(numbers).collect()
}

#[expect(clippy::cast_precision_loss, reason = "counts are small")]
fn row(scene: &Scene, arguments: &Arguments) {
    let spheres = (scene.spheres)(arguments.seed);
    let collected: Spheres = spheres.iter().copied().collect();
    let (hierarchy, mut build) = milliseconds(|| spheres.iter().copied().collect::<SphereBvh>());
    let (obvhs, _) = milliseconds(|| Hierarchy::new(&spheres));
    let numbers = numbers(&spheres);
    let by_embree = || embree::Device::new().map(|device| milliseconds(|| device.build(&numbers)));
    let (embree, mut embree_build) = match by_embree() {
        Some((Some(scene), time)) => (Some(scene), time),
        _ => (None, f64::NAN),
    };
    // Of short times, the least of several.
    for _ in 0..if spheres.len() > 200_000 { 1 } else { 5 } {
        build = build.min(milliseconds(|| spheres.iter().copied().collect::<SphereBvh>()).1);
        if let Some((_, time)) = by_embree() {
            embree_build = embree_build.min(time);
        }
    }

    let rays = scenes::rays(&spheres, &hierarchy, arguments.rays, arguments.seed);
    check(&spheres, &hierarchy, embree.as_ref(), &rays);

    let scanned = &rays[..(200_000_000 / spheres.len() / 16).clamp(20, rays.len())];
    let passes: [(Pass, &[Ray]); 6] = [
        (pass(|ray| collected.nearest(ray, ALL)), scanned),
        (pass(|ray| obvhs.nearest(ray)), &rays),
        (
            pass(|ray| {
                let embree = embree.as_ref()?;
                embree.nearest(ray.origin.to_array(), ray.direction.to_array())
            }),
            &rays,
        ),
        (pass(|ray| hierarchy.nearest(ray, ALL)), &rays),
        (
            pass(|ray| {
                embree.as_ref().is_some_and(|embree| {
                    embree.occludes(ray.origin.to_array(), ray.direction.to_array(), f32::INFINITY)
                })
            }),
            &rays,
        ),
        (pass(|ray| hierarchy.occludes(ray, ALL)), &rays),
    ];
    // Of each batch, the shortest of its turns counts: what else the machine does makes some longer, and none shorter.
    let batches = |rays: &[Ray]| vec![f64::INFINITY; rays.len().div_ceil(BATCH)];
    let mut times: Vec<Vec<f64>> = passes.iter().map(|(_, rays)| batches(rays)).collect();
    for _ in 0..arguments.rounds {
        for ((pass, rays), times) in passes.iter().zip(&mut times) {
            for (batch, time) in rays.chunks(BATCH).zip(times) {
                let start = Instant::now();
                pass(batch);
                *time = time.min(start.elapsed().as_secs_f64() * 1e9);
            }
        }
    }
    let a_ray: Vec<f64> = passes
        .iter()
        .zip(&times)
        .map(|((_, rays), times)| times.iter().sum::<f64>() / rays.len() as f64)
        .collect();
    let (of_scan, of_embree, occluded) =
        (a_ray[3] / a_ray[0], a_ray[3] / a_ray[2], a_ray[5] / a_ray[4]);
    println!(
        "{:<24}{:>9.1}{:>9.1}{:>9.1}{:>9.1}{of_embree:>8.2}{of_scan:>8.2} |{:>9.1}{:>9.1}{occluded:>6.2} |{embree_build:>9.2}{build:>9.2}{:>6.2}",
        scene.name,
        a_ray[0],
        a_ray[1],
        a_ray[2],
        a_ray[3],
        a_ray[4],
        a_ray[5],
        build / embree_build,
    );
}

/// The hierarchy must find what the slice has, bit for bit. Embree, in single precision, finds another sphere now and then.
fn check(spheres: &[Sphere], hierarchy: &SphereBvh, embree: Option<&embree::Scene>, rays: &[Ray]) {
    for ray in rays.iter().step_by(1 + spheres.len() / 500) {
        let expected = eyeray::nearest(spheres, ray, ALL);
        assert_eq!(hierarchy.nearest(ray, ALL), expected, "{ray:?}");
        assert_eq!(hierarchy.occludes(ray, ALL), expected.is_some(), "{ray:?}");
    }
    let Some(embree) = embree else { return };
    let others = rays.iter().filter(|ray| {
        let found = embree.nearest(ray.origin.to_array(), ray.direction.to_array());
        let expected = hierarchy.nearest(ray, ALL);
        found.map(|(index, _)| index as usize) != expected.map(|(index, _)| index)
    });
    let others = others.count();
    if others * 50 > rays.len() {
        println!("Embree finds another sphere for {others} of {} rays:", rays.len());
    }
}
