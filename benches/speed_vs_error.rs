//! Speed against error: every published method and eyeray's, on every family of cases.
//!
//! ```text
//! cargo bench --bench speed_vs_error                  # in about a minute
//! cargo bench --bench speed_vs_error -- --quick       # for a first impression, in some seconds
//! cargo bench --bench speed_vs_error -- --prices      # only eyeray's times, in multiples of the textbook's
//! cargo bench --bench speed_vs_error -- --refresh     # five times the cases, and the copies in benches/report/
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo bench --bench speed_vs_error -- --prices     # with FMA
//! ```
//!
//! The report is written to `target/speed_vs_error/`: Markdown, CSV, and a plot for each precision. Its first page, which has
//! the figures that the README states, is printed.

use std::io;
use std::path::Path;

use eyeray::{Algebraic, Geometric, Hittable, Ray, Scalar, Sphere};
use glam::{DVec3, Vec3};

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::price::{self, questions_f32, questions_f64};
use measure::{Kind, Measured, Method, page, report};

/// Cases of a family in f32 and in f64, whose exact answers take longer, where the copies are refreshed.
const ACCURACY_CASES: [usize; 2] = [200_000, 50_000];

macro_rules! methods_of {
    ($function:ident, $module:ident, $vector:ident, $float:ident) => {
        fn $function() -> Vec<Method<$vector>> {
            use methods::$module::{ahead, embree, geometric, haines, pbrt, stable, textbook};

            const ALL: std::ops::Range<$float> = 0.0..$float::INFINITY;
            let plain = Kind::Plain;
            vec![
                Method::new(
                    "textbook",
                    "the lecture's algebraic form; S. Marschner, CS4620 lecture 6",
                    plain,
                    |ray, sphere| ahead(textbook(ray, sphere)),
                ),
                Method::new(
                    "geometric",
                    "the lecture's geometric form, the direction normalized first; the same",
                    plain,
                    |ray, sphere| ahead(geometric(ray, sphere)),
                ),
                Method::new(
                    "stable",
                    "the stable quadratic; W. Press et al., *Numerical Recipes*, §5.6",
                    plain,
                    |ray, sphere| ahead(stable(ray, sphere)),
                ),
                Method::new(
                    "Haines",
                    "E. Haines, J. Günther, T. Akenine-Möller, Ray Tracing Gems, chapter 7",
                    plain,
                    |ray, sphere| ahead(haines(ray, sphere)),
                ),
                Method::new(
                    "pbrt-v4",
                    "(r + l)(r - l) for the discriminant; M. Pharr, W. Jakob, G. Humphreys, *PBRT* 4e, §6.8.3, without \
                     its intervals",
                    plain,
                    |ray, sphere| ahead(pbrt(ray, sphere)),
                ),
                Method::new(
                    "Embree",
                    "the closest approach; Embree 4, `sphere_intersector.h`",
                    plain,
                    |ray, sphere| ahead(embree(ray, sphere)),
                ),
                Method::new("eyeray algebraic", "`Algebraic`", Kind::Eyeray, |ray, sphere| {
                    Algebraic(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                }),
                Method::new("eyeray geometric", "`Geometric`", Kind::Eyeray, |ray, sphere| {
                    Geometric(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                }),
                Method::new("eyeray", "`Sphere::intersect`", Kind::Eyeray, |ray, sphere| {
                    sphere.intersect(ray, ALL).map(|hit| hit.t)
                }),
            ]
        }
    };
}

methods_of!(plain_f32, single, Vec3, f32);
methods_of!(plain_f64, double, DVec3, f64);

fn methods_f32() -> Vec<Method<Vec3>> {
    use methods::double::{ahead, stable, textbook};

    let mut methods = plain_f32();
    let widened_ones = [
        Method::new(
            "textbook f64",
            "the textbook in f64 on f32 inputs, rounded once",
            Kind::Widened,
            |ray, sphere| {
                ahead(textbook(&Ray::from(*ray), &Sphere::from(*sphere))).map(f32::from_f64)
            },
        ),
        Method::new(
            "stable f64",
            "the stable quadratic in f64 on f32 inputs, rounded once",
            Kind::Widened,
            |ray, sphere| {
                ahead(stable(&Ray::from(*ray), &Sphere::from(*sphere))).map(f32::from_f64)
            },
        ),
    ];
    let ours = methods.iter().position(|method| method.kind == Kind::Eyeray);
    let at = ours.unwrap_or(methods.len());
    methods.splice(at..at, widened_ones);
    methods
}

fn main() -> io::Result<()> {
    let arguments = Arguments::read("speed_vs_error");
    if arguments.prices { prices(arguments.effort) } else { speed_vs_error(arguments) }
}

fn prices(effort: Effort) -> io::Result<()> {
    fn ours<V: Measured>(methods: Vec<Method<V>>) -> Option<Method<V>> {
        methods.into_iter().find(|method| method.name == report::OURS)
    }

    let progress = report::progress(2);
    let mut parts = Vec::new();
    if let (Some(single), Some(double)) = (ours(plain_f32()), ours(plain_f64())) {
        parts = vec![
            report::prices(&single, &questions_f32(), effort, &progress),
            report::prices(&double, &questions_f64(), effort, &progress),
        ];
    }
    progress.finish_and_clear();
    let tables: Vec<_> = parts.iter().map(|prices| prices.table().to_string()).collect();
    let in_short = price::in_short(&parts.iter().collect::<Vec<_>>());
    let text = format!("{}\n\n{}\n{in_short}", report::PRICES, tables.join("\n"));
    page::finish("speed_vs_error", effort, &text)
}

fn speed_vs_error(arguments: Arguments) -> io::Result<()> {
    let effort = arguments.effort;
    let progress = report::progress(2);
    let [cases_f32, cases_f64] = ACCURACY_CASES;
    let parts = [
        report::measure(&methods_f32(), Some(&questions_f32()), cases_f32, effort, &progress),
        report::measure(&plain_f64(), Some(&questions_f64()), cases_f64, effort, &progress),
    ];
    progress.finish_and_clear();
    let copies = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/report");
    report::publish(
        "speed_vs_error",
        "By `cargo bench --bench speed_vs_error`.",
        &parts,
        arguments,
        Some(&copies),
    )
}
