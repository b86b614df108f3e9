//! One ray against a slice of spheres, in both precisions: `nearest` and `occludes` beside loops over published formulas.
//!
//! ```text
//! cargo bench --bench sphere_slices                   # a table of medians and ratios, in some seconds
//! cargo bench --bench sphere_slices -- --test         # each once, untimed
//! ```
//!
//! The spheres are random, with the same density for every number. Half of the rays are eye rays, half are bounce rays from their
//! hits.
//! The loops are those that path tracers have: a formula for each sphere in turn, the nearest so far as the range's end, and the
//! point and the normal of the nearest at last.

use std::fmt::Write as _;
use std::hint::black_box;
use std::io;
use std::ops::Range;

use eyeray::{Hit, Hittable, Ray, Scalar, Sphere, Vector, nearest};
use glam::{DVec3, Vec3};

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::page;
use measure::report::Table;
use measure::timing::{self, PassOver, Regime};
use methods::{double, single};
use support::families::Rng;

const COUNTS: [usize; 5] = [1, 8, 46, 1024, 16_384];

fn all<S: Scalar>() -> Range<S> {
    S::ZERO..S::INFINITY
}

/// The result of a loop: index, t, point and normal.
type Found<V> = (usize, <V as Vector>::Scalar, V, V);

/// The nearest by a formula for t.
#[inline(always)]
fn by_formula<V: Vector>(
    Scene { spheres, .. }: &Scene<V>,
    ray: &Ray<V>,
    t: impl Fn(&Ray<V>, &Sphere<V>) -> Option<V::Scalar>,
) -> Option<Found<V>> {
    let mut end = V::Scalar::INFINITY;
    let mut found = None;
    for (index, sphere) in spheres.iter().enumerate() {
        if let Some(t) = t(ray, sphere).filter(|&t| t < end) {
            end = t;
            found = Some(index);
        }
    }
    let sphere = spheres.get(found?)?;
    let point = ray.at(end);
    Some((found?, end, point, (point - sphere.center) * (V::Scalar::ONE / sphere.radius)))
}

fn of_hit<V: Vector>((index, hit): (usize, Hit<V>)) -> Found<V> {
    (index, hit.t, hit.point, hit.normal)
}

/// Spheres, and the rays to ask for.
struct Scene<V: Vector> {
    spheres: Vec<Sphere<V>>,
    rays: Vec<Ray<V>>,
}

impl<V: Vector> Scene<V> {
    fn new(count: usize) -> Self {
        let mut rng = Rng::new(count as u64);
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let extent = 2.0 * (count as f64).cbrt();
        let within = |rng: &mut Rng, extent: f64| -> V {
            let coordinates = [(); 3].map(|()| rng.uniform(-extent, extent));
            V::from_f64(DVec3::from(coordinates))
        };
        let spheres: Vec<Sphere<V>> = (0..count)
            .map(|_| {
                let radius = V::Scalar::from_f64(rng.uniform(0.2, 0.8));
                Sphere::new(within(&mut rng, extent), radius)
            })
            .collect();
        // More than a branch predictor learns by heart, as long as a round stays short.
        let half = if count > 10_000 { 32 } else { 2048 };
        let (mut eye, mut bounced) = (Vec::new(), Vec::new());
        while bounced.len() < half {
            let from = within(&mut rng, extent * 2.5);
            let ray = Ray::new(from, within(&mut rng, extent * 0.7) - from);
            let sideways = V::from_f64(rng.unit_vector());
            if let Some((_, hit)) = nearest(&spheres, &ray, all()) {
                bounced.push(hit.spawn(hit.normal + sideways));
            }
            if eye.len() < half {
                eye.push(ray);
            }
        }
        let rays = eye.into_iter().zip(bounced).flat_map(|(eye, bounced)| [eye, bounced]).collect();
        Self { spheres, rays }
    }
}

/// A pass over the rays of a scene that stores the result of each.
fn pass<V: Vector, T>(
    find: impl Fn(&Scene<V>, &Ray<V>) -> T + Sync + 'static,
) -> PassOver<Scene<V>> {
    Box::new(move |scene| {
        for ray in &scene.rays {
            black_box(find(scene, black_box(ray)));
        }
    })
}

/// The table of one precision.
fn table<V: Vector>(formulas: [PassOver<Scene<V>>; 2], rounds: usize) -> Table {
    let [textbook, parry] = formulas;
    let passes = [
        ("textbook", textbook),
        ("parry3d's formula", parry),
        ("`nearest`", pass(|scene, ray| nearest(&scene.spheres, ray, all()).map(of_hit))),
        ("`occludes`", pass(|scene, ray| scene.spheres.occludes(ray, all()))),
    ];
    let heads: Vec<_> =
        std::iter::once("spheres").chain(passes.iter().map(|&(name, _)| name)).collect();
    let mut table = Table::new(&heads);
    let turns: Vec<_> = passes.iter().map(|(_, pass)| pass).collect();
    for count in COUNTS {
        let scene = Scene::new(count);
        let rays = scene.rays.len();
        let regime = Regime { cases: rays, warm_up: 0, timed: 1, rounds };
        let medians = timing::medians(&turns, &scene, rays, regime);
        let formula = medians[0].min(medians[1]);
        let cells = medians.iter().map(|time| format!("{time:.1} ({:.2})", time / formula));
        table.row(std::iter::once(count.to_string()).chain(cells).collect::<Vec<_>>());
    }
    table
}

fn main() -> io::Result<()> {
    let effort = Arguments::read("sphere_slices").effort;
    let rounds = match effort {
        Effort::Full | Effort::Usual => 101,
        Effort::Quick => 11,
        Effort::Test => 1,
    };
    let single = table::<Vec3>(
        [
            pass(|scene, ray| by_formula(scene, ray, |r, s| single::ahead(single::textbook(r, s)))),
            pass(|scene, ray| by_formula(scene, ray, single::parry_nearest)),
        ],
        rounds,
    );
    let double = table::<DVec3>(
        [
            pass(|scene, ray| by_formula(scene, ray, |r, s| double::ahead(double::textbook(r, s)))),
            pass(|scene, ray| by_formula(scene, ray, double::parry_nearest)),
        ],
        rounds,
    );
    let mut text = String::new();
    for (precision, table) in [("f32", single), ("f64", double)] {
        let _ = writeln!(
            text,
            "First hit of one {precision} ray on a slice of spheres: nanoseconds a ray, and in parentheses in multiples of the \
faster formula's time.\n\n{table}"
        );
    }
    page::finish("sphere_slices", effort, &text)
}
