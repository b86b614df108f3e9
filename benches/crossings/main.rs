//! All crossings of a ray with many spheres, beside a tree that a user would write, and ranges that do not start at 0.
//!
//! ```text
//! cargo bench --bench crossings                # tables of medians and ratios, then criterion's estimates
//! cargo bench --bench crossings -- 1000        # only the estimates of what matches, after the tables
//! cargo bench --bench crossings -- --test      # each once
//! ```
//!
//! Spheres that overlap, so that a ray crosses many of them. Half of the rays start outside of the scene and half inside.
#![allow(missing_docs, reason = "criterion's macros make public functions")]

use std::fmt::Write as _;
use std::hint::black_box;
use std::ops::Range;
use std::time::Duration;

use criterion::{Criterion, criterion_group};
use eyeray::{Ray, Scalar, Sphere, SphereBvh, Spheres};
use glam::{Vec3, dvec3};

#[path = "../measure/mod.rs"]
mod measure;
#[path = "../methods/mod.rs"]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;
mod tree;

use measure::arguments::Effort;
use measure::page;
use measure::timing::{self, PassOver, Regime};
use support::families::Rng;
use tree::Tree;

const ALL: Range<f32> = 0.0..f32::INFINITY;

const COUNTS: [usize; 4] = [46, 1_000, 10_000, 100_000];

/// A ray, where a clipping plane cuts it, and the ray that starts there.
struct Question {
    ray: Ray,
    plane: f32,
    from_plane: Ray,
}

/// Spheres, of which every third is visible, and the rays to ask for.
struct Scene {
    spheres: Spheres,
    bvh: SphereBvh,
    tree: Tree,
    visible: Vec<bool>,
    questions: Vec<Question>,
}

impl Scene {
    fn new(count: usize) -> Self {
        let mut rng = Rng::new(count as u64);
        // The same density for every number.
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let extent = 2.0 * (count as f64).cbrt();
        let slice: Vec<Sphere> = (0..count)
            .map(|_| {
                let center = within(&mut rng, extent);
                Sphere::new(center, f32::from_f64(rng.uniform(1.0, 2.0)))
            })
            .collect();
        let questions = (0..1024)
            .map(|place| {
                let eye = within(&mut rng, if place % 2 == 0 { extent * 2.5 } else { extent });
                let direction = within(&mut rng, extent * 0.7) - eye;
                // The plane through the middle of the scene, across the ray.
                let plane = -eye.dot(direction) / direction.length_squared();
                let plane = if plane > 0.0 { plane } else { 0.1 };
                let ray = Ray::new(eye, direction);
                Question { ray, plane, from_plane: Ray::new(ray.at(plane), direction) }
            })
            .collect();
        Self {
            spheres: slice.iter().copied().collect(),
            bvh: slice.iter().copied().collect(),
            tree: Tree::new(&slice),
            visible: (0..count).map(|_| rng.below(3) == 0).collect(),
            questions,
        }
    }
}

fn within(rng: &mut Rng, extent: f64) -> Vec3 {
    let mut number = || rng.uniform(-extent, extent);
    dvec3(number(), number(), number()).as_vec3()
}

/// Goes through the rays of a scene.
type Pass = PassOver<Scene>;

/// A pass that stores the result of each ray.
fn pass<T>(find: impl Fn(&Scene, &Question) -> T + Sync + 'static) -> Pass {
    Box::new(move |scene| {
        for question in &scene.questions {
            black_box(find(scene, black_box(question)));
        }
    })
}

/// Every crossing, for all that they are good for.
fn each<T>(crossings: impl Iterator<Item = T>) {
    for crossing in crossings {
        black_box(crossing);
    }
}

/// The first of each is what the others of its group are compared with.
type Group = (&'static str, Vec<(&'static str, Pass)>);

fn groups() -> [Group; 3] {
    [
        (
            "hits",
            vec![
                ("nearest", pass(|scene, it| scene.bvh.nearest(&it.ray, ALL))),
                ("the first", pass(|scene, it| scene.bvh.hits(&it.ray, ALL).next())),
                (
                    "the first visible",
                    pass(|scene, it| {
                        scene.bvh.hits(&it.ray, ALL).find(|(index, _)| scene.visible[*index])
                    }),
                ),
                ("all", pass(|scene, it| each(scene.bvh.hits(&it.ray, ALL)))),
                ("all by a binary tree", pass(|scene, it| scene.tree.crossings(&it.ray))),
            ],
        ),
        (
            "hits of Spheres",
            vec![
                ("nearest", pass(|scene, it| scene.spheres.nearest(&it.ray, ALL))),
                ("the first", pass(|scene, it| scene.spheres.hits(&it.ray, ALL).next())),
                ("all", pass(|scene, it| each(scene.spheres.hits(&it.ray, ALL)))),
            ],
        ),
        (
            "ranges",
            vec![
                ("rays from a plane", pass(|scene, it| scene.bvh.nearest(&it.from_plane, ALL))),
                (
                    "range from the plane",
                    pass(|scene, it| scene.bvh.nearest(&it.ray, it.plane..f32::INFINITY)),
                ),
                ("range behind all", pass(|scene, it| scene.bvh.nearest(&it.ray, BEHIND))),
                ("Spheres", pass(|scene, it| scene.spheres.nearest(&it.ray, ALL))),
                (
                    "from the plane",
                    pass(|scene, it| scene.spheres.nearest(&it.ray, it.plane..f32::INFINITY)),
                ),
                ("behind all", pass(|scene, it| scene.spheres.nearest(&it.ray, BEHIND))),
            ],
        ),
    ]
}

/// Beyond ten times the way from the eye to its target.
const BEHIND: Range<f32> = 10.0..f32::INFINITY;

/// How the passes compare with the first of each group.
fn ratios(rounds: usize) -> String {
    let mut text = String::from(
        "Crossings of one f32 ray with many spheres that overlap, in nanoseconds a ray.\n",
    );
    let groups = groups();
    let scenes = COUNTS.map(|count| (count, Scene::new(count)));
    for (name, passes) in &groups {
        let _ = write!(text, "\n{name:>16}");
        for (name, _) in passes {
            let _ = write!(text, "{name:>24}");
        }
        let _ = writeln!(text);
        let turns: Vec<_> = passes.iter().map(|(_, pass)| pass).collect();
        for (count, scene) in &scenes {
            let rays = scene.questions.len();
            let regime = Regime { cases: rays, warm_up: 0, timed: 1, rounds };
            let medians = timing::medians(&turns, scene, rays, regime);
            let _ = write!(text, "{count:>16}");
            for time in &medians {
                let _ = write!(text, "{time:>15.1} ({:>5.2}x)", time / medians[0]);
            }
            let _ = writeln!(text);
        }
    }
    text
}

fn estimates(criterion: &mut Criterion) {
    for count in COUNTS {
        let scene = Scene::new(count);
        for (name, passes) in groups() {
            let mut group = criterion.benchmark_group(format!("{name}, {count}"));
            for (name, pass) in passes {
                group.bench_function(name, |bencher| bencher.iter(|| pass(black_box(&scene))));
            }
            group.finish();
        }
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
    let ratios = ratios(if once { 1 } else { 41 });
    benches();
    Criterion::default().configure_from_args().final_summary();
    page::finish("crossings", if once { Effort::Test } else { Effort::Usual }, &ratios)
}
