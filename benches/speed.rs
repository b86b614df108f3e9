//! How many times the textbook's time the hot path takes where branches are predicted: 4,096 cases of the easy family over
//! and over, medians of rounds in which all take their turn.
//!
//! ```text
//! cargo bench --bench speed
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo bench --bench speed     # with FMA
//! ```
//!
//! What is compared with a crate rather than a formula is timed by `cargo bench --manifest-path benches/peers/Cargo.toml`.

use eyeray::{Algebraic, Geometric, Hittable};

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::comparison::Comparisons;
use measure::{conditions, stored_of, sum_of};

/// The rows of a precision, and how many times the time of the formula each may take.
macro_rules! rows {
    ($function:ident, $module:ident, $float:ident, $at_most:expr) => {
        fn $function(comparisons: &mut Comparisons) {
            use methods::$module::{ahead, parry_nearest, textbook, textbook_shading};

            const ALL: std::ops::Range<$float> = 0.0..$float::INFINITY;
            let [nearest, both] = $at_most;
            let name = |what: &str| format!("{}: {what}", stringify!($float));

            let formulas = [
                (
                    "textbook",
                    sum_of(move |ray, sphere| ahead(textbook(ray, sphere)).unwrap_or_default()),
                ),
                (
                    "parry3d's formula",
                    sum_of(move |ray, sphere| parry_nearest(ray, sphere).unwrap_or_default()),
                ),
            ];
            let t_of = |hit: Option<eyeray::Hit<_>>| hit.map_or(0.0, |hit| hit.t);
            let intersect = sum_of(move |ray, sphere| t_of(sphere.intersect(ray, ALL)));
            let algebraic = sum_of(move |ray, sphere| t_of(Algebraic(*sphere).intersect(ray, ALL)));
            let geometric = sum_of(move |ray, sphere| t_of(Geometric(*sphere).intersect(ray, ALL)));
            comparisons.compare(&name("nearest t, intersect"), nearest, &intersect, &formulas);
            comparisons.compare(&name("nearest t, Algebraic"), "", &algebraic, &formulas);
            comparisons.compare(&name("nearest t, Geometric"), "", &geometric, &formulas);

            let sum = |roots: Option<[$float; 2]>| roots.map_or(0.0, |[near, far]| near + far);
            let formula = sum_of(move |ray, sphere| sum(textbook(ray, sphere)));
            let formula = [("textbook", formula)];
            let algebraic = sum_of(move |ray, sphere| sum(sphere.roots_algebraic(ray)));
            let geometric = sum_of(move |ray, sphere| sum(sphere.roots_geometric(ray)));
            comparisons.compare(&name("both roots, roots_algebraic"), both, &algebraic, &formula);
            comparisons.compare(&name("both roots, roots_geometric"), both, &geometric, &formula);

            let formula = stored_of(textbook_shading);
            let hit = stored_of(|ray, sphere| sphere.intersect(ray, ALL));
            comparisons.compare(&name("whole hit, intersect"), "", &hit, &[("textbook", formula)]);
        }
    };
}

rows!(rows_f32, single, f32, ["1.5", "2"]);
rows!(rows_f64, double, f64, [if cfg!(target_feature = "fma") { "3" } else { "6" }, ""]);

fn main() {
    let arguments = Arguments::read("cargo bench --bench speed", false);
    let mut comparisons = Comparisons::new(arguments.effort);
    rows_f32(&mut comparisons);
    rows_f64(&mut comparisons);
    if arguments.effort != Effort::Test {
        println!("{}\n\n{comparisons}", conditions::line());
    }
}
