//! Spheres wherever they are, in both precisions, and spheres that move: what that costs `Spheres` and `SphereBvh`.
//!
//! ```text
//! cargo bench --bench sphere_scenes                   # tables of medians and ratios
//! cargo bench --bench sphere_scenes -- --test         # each once, untimed
//! ```
//!
//! Half of the rays are eye rays, half are bounce rays from their hits.

use std::fmt::Write as _;
use std::hint::black_box;
use std::io;
use std::ops::Range;

use eyeray::{Ray, Scalar, Sphere, SphereBvh, Spheres, Vector};
use glam::{DVec3, Vec3, dvec3};

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::page;
use measure::timing::{self, Regime, Turn};
use support::families::Rng;

/// How many spheres are in the scenes that are not for a number.
const MANY: usize = 20_000;

/// How many rays are asked of a hierarchy and of a scan.
const RAYS: [usize; 2] = [4096, 256];

fn all<S: Scalar>() -> Range<S> {
    S::ZERO..S::INFINITY
}

fn within(rng: &mut Rng, extent: f64) -> DVec3 {
    [(); 3].map(|()| rng.uniform(-extent, extent)).into()
}

/// How far the spheres of a cloud are from its middle, on each axis.
fn extent(count: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let count = count as f64;
    2.0 * count.cbrt()
}

/// Centers and radii, relative to where the scene is.
fn cloud(rng: &mut Rng, count: usize) -> Vec<(DVec3, f64)> {
    let extent = extent(count);
    (0..count).map(|_| (within(rng, extent), rng.uniform(0.2, 0.8))).collect()
}

/// Spheres far from a cloud of [`MANY`], in all directions.
fn strays(rng: &mut Rng, count: usize, extents: f64) -> Vec<(DVec3, f64)> {
    (0..count).map(|_| (rng.unit_vector() * extents * extent(MANY), 0.5)).collect()
}

/// A scene, and where and from where it is seen.
struct Scene {
    name: String,
    spheres: Vec<(DVec3, f64)>,
    world: DVec3,
    /// How many extents the eyes are away from the middle.
    from: f64,
}

impl Scene {
    fn placed<V: Vector>(&self) -> Vec<Sphere<V>> {
        let place = |&(center, radius): &(DVec3, f64)| {
            Sphere::new(V::from_f64(self.world + center), V::Scalar::from_f64(radius))
        };
        self.spheres.iter().map(place).collect()
    }

    fn rays<V: Vector>(&self, spheres: &SphereBvh<V>, extent: f64, count: usize) -> Vec<Ray<V>> {
        let mut rng = Rng::new(3);
        let mut rays = Vec::new();
        while rays.len() < count {
            let eye = self.world + rng.unit_vector() * self.from * extent;
            let target = self.world + within(&mut rng, extent * 0.7);
            let ray = Ray::new(V::from_f64(eye), V::from_f64(target - eye));
            rays.push(ray);
            if let Some((_, hit)) = spheres.nearest(&ray, all()) {
                rays.push(hit.spawn(hit.normal + V::from_f64(rng.unit_vector())));
            }
        }
        rays
    }
}

/// Asks with each of the rays.
fn ask<V: Vector, T>(rays: &[Ray<V>], find: impl Fn(&Ray<V>) -> T) {
    for ray in rays {
        black_box(find(black_box(ray)));
    }
}

/// The nanoseconds that a ray takes, of a hierarchy and of a scan, and the milliseconds that building them takes.
fn times<V: Vector>(scene: &Scene, extent: f64, rounds: usize) -> [f64; 4] {
    let placed = scene.placed::<V>();
    let (bvh, scan) = (SphereBvh::new(&placed), Spheres::from(placed.as_slice()));
    let [of_bvh, of_scan] = RAYS.map(|count| scene.rays(&bvh, extent, count));
    let regime = Regime { cases: 1, warm_up: 0, timed: 1, rounds };
    let turns: Vec<Turn<'_>> = vec![
        Box::new(|| ask(&of_bvh, |ray| bvh.nearest(ray, all()))),
        Box::new(|| ask(&of_scan, |ray| scan.nearest(ray, all()))),
        Box::new(|| drop(black_box(SphereBvh::new(black_box(&placed))))),
        Box::new(|| drop(black_box(Spheres::from(black_box(placed.as_slice()))))),
    ];
    let medians = timing::medians_of_turns(turns, 1, regime);
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let counts = [of_bvh.len() as f64, of_scan.len() as f64, 1e6, 1e6];
    [0, 1, 2, 3].map(|place| medians[place] / counts[place])
}

fn scenes() -> Vec<(Scene, f64)> {
    let mut rng = Rng::new(2);
    let mut scenes = Vec::new();
    for count in [100, 485, 10_000, 200_000] {
        let spheres = cloud(&mut rng, count);
        let name = format!("{count} spheres");
        scenes.push((Scene { name, spheres, world: DVec3::ZERO, from: 2.0 }, extent(count)));
    }
    let many = cloud(&mut rng, MANY);
    let mut add = |name: &str, more: Vec<(DVec3, f64)>, world: DVec3, from: f64| {
        let spheres = [many.clone(), more].concat();
        let name = name.to_owned();
        scenes.push((Scene { name, spheres, world, from }, extent(MANY)));
    };
    add("20,000 spheres", Vec::new(), DVec3::ZERO, 2.0);
    for extents in [1e4, 1e5, 1e6] {
        for count in [1, 100] {
            let name = format!("{count} more, {extents:e} extents off");
            add(&name, strays(&mut rng, count, extents), DVec3::ZERO, 2.0);
        }
    }
    for extents in [5.0, 250.0, 2500.0, 1e6] {
        add(&format!("from {extents} extents"), Vec::new(), DVec3::ZERO, extents);
    }
    let place = dvec3(0.6, -0.48, 0.64);
    add("on a planet, 6.4e6", Vec::new(), place * 6.4e6, 2.0);
    add("around a star, 1.5e11", Vec::new(), place * 1.5e11, 2.0);
    let hostile = (0..1000).map(|i| (DVec3::splat([f64::NAN, f64::INFINITY][i % 2]), 1.0));
    add("and 1,000 of NaN or infinity", hostile.collect(), DVec3::ZERO, 2.0);
    scenes
}

/// How long an update takes at least and the queries after it, beside a hierarchy that is built anew.
fn moving<V: Vector>(text: &mut String, rounds: usize) {
    let mut rng = Rng::new(6);
    let scene = Scene {
        name: String::new(),
        spheres: cloud(&mut rng, MANY),
        world: DVec3::ZERO,
        from: 2.0,
    };
    let before = scene.placed::<V>();
    for radii in [0.1, 0.3, 1.0, 3.0, 10.0] {
        let moved: Vec<Sphere<V>> = before
            .iter()
            .map(|sphere| {
                let shift = rng.unit_vector() * radii * sphere.radius.into();
                Sphere::new(V::from_f64(sphere.center.to_f64() + shift), sphere.radius)
            })
            .collect();
        let fresh = SphereBvh::new(&moved);
        let rays = scene.rays(&fresh, extent(MANY), RAYS[0]);
        let median = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        let least = |times: Vec<f64>| times.into_iter().fold(f64::INFINITY, f64::min);
        let milliseconds = |run: &mut dyn FnMut()| {
            let start = std::time::Instant::now();
            run();
            start.elapsed().as_secs_f64() * 1e3
        };
        let (mut updates, mut builds, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..rounds {
            let mut updated = SphereBvh::new(&before);
            // What the first update of a tree sets up is part of it.
            updates.push(milliseconds(&mut || updated.update(black_box(&moved))));
            builds.push(milliseconds(&mut || drop(black_box(SphereBvh::new(black_box(&moved))))));
            let ask = |bvh: &SphereBvh<V>| {
                milliseconds(&mut || ask(&rays, |ray| bvh.nearest(ray, all())))
            };
            ratios.push(ask(&updated) / ask(&fresh));
        }
        let (update, build) = (least(updates), least(builds));
        let _ = writeln!(
            text,
            "{:>10} radii{update:>12.2}{build:>12.2}{:>12.2}{:>16.2}",
            radii,
            update / build,
            median(ratios)
        );
    }

    // Little by little, until the hierarchy is built anew, and on.
    let mut spheres = before;
    let mut updated = SphereBvh::new(&spheres);
    let _ = writeln!(
        text,
        "\nStep by step, a tenth of a radius each: time of queries, as a multiple of a hierarchy built anew\n"
    );
    for turn in 1..=rounds.min(24) {
        for sphere in &mut spheres {
            let shift = rng.unit_vector() * 0.1 * sphere.radius.into();
            sphere.center = V::from_f64(sphere.center.to_f64() + shift);
        }
        updated.update(&spheres);
        let fresh = SphereBvh::new(&spheres);
        let rays = scene.rays(&fresh, extent(MANY), RAYS[0]);
        let turns: Vec<Turn<'_>> = vec![
            Box::new(|| ask(&rays, |ray| updated.nearest(ray, all()))),
            Box::new(|| ask(&rays, |ray| fresh.nearest(ray, all()))),
        ];
        let regime = Regime { cases: 1, warm_up: 1, timed: 1, rounds: rounds.min(11) };
        let medians = timing::medians_of_turns(turns, 1, regime);
        let _ = write!(text, "{:>6.2}", medians[0] / medians[1]);
        if turn % 12 == 0 {
            let _ = writeln!(text);
        }
    }
    let _ = writeln!(text);
}

fn main() -> io::Result<()> {
    let arguments = Arguments::read("sphere_scenes");
    let rounds = match arguments.effort {
        Effort::Test => 1,
        Effort::Quick => 5,
        Effort::Usual | Effort::Full => 31,
    };
    let mut text = String::from(
        "Nearest hit, nanoseconds a ray, and building, milliseconds; of f64, in parentheses, as a multiple of f32\n\n",
    );
    let _ = writeln!(
        text,
        "{:>34}{:>10}{:>17}{:>12}{:>19}{:>10}{:>17}",
        "scene", "SphereBvh", "f64", "Spheres", "f64", "build", "f64"
    );
    for (scene, extent) in scenes() {
        let single = times::<Vec3>(&scene, extent, rounds);
        let double = times::<DVec3>(&scene, extent, rounds);
        let pair =
            |place: usize| format!("{:.1} ({:.2})", double[place], double[place] / single[place]);
        let _ = writeln!(
            text,
            "{:>34}{:>10.1}{:>17}{:>12.1}{:>19}{:>10.2}{:>17}",
            scene.name,
            single[0],
            pair(0),
            single[1],
            pair(1),
            single[2],
            pair(2)
        );
    }
    let _ = writeln!(
        text,
        "\n20,000 spheres that move\n\n{:>16}{:>12}{:>12}{:>12}{:>16}",
        "by", "update, ms", "build, ms", "ratio", "queries, ratio"
    );
    let _ = writeln!(text, "f32");
    moving::<Vec3>(&mut text, rounds);
    let _ = writeln!(text, "f64");
    moving::<DVec3>(&mut text, rounds);
    page::finish("sphere_scenes", arguments.effort, &text)
}
