//! The price of exactness: eyeray's times in multiples of the textbook's on the easy family.

use std::hint::black_box;

use eyeray::{Algebraic, Geometric, Hit, Hittable, Scalar, Vector};
use glam::{DVec3, Vec3};

use super::arguments::Effort;
use super::report::Table;
use super::timing::{self, Regime, Turn};
use super::{Measured, SEED, Test, Timed, cases};
use crate::methods::Shading;
use crate::support::families::{Case, FAMILIES, Family};

/// Blocks of cases that are learned and timed one after the other, so that rare cases are among them.
const BLOCKS: usize = 4;

/// The time of a test where branches are predicted.
#[derive(Clone, Copy, Debug)]
pub struct Predicted {
    pub nanoseconds: f64,
    /// How many times the reference's time on the easy family, which takes its turn in the same rounds.
    pub price: f64,
}

/// The number of cases that [`predicted`] takes of a family.
pub fn predicted_cases() -> usize {
    BLOCKS * Regime::PREDICTED.cases
}

/// Times tests on a family, and a reference on the easy one, all in turns.
pub fn predicted<V: Measured>(
    tests: &[&dyn Timed<V>],
    reference: &dyn Timed<V>,
    family: &Family,
    effort: Effort,
) -> Vec<Predicted> {
    let regime = effort.regime(Regime::PREDICTED);
    let easy = cases::<V>(family_named("easy"), SEED, BLOCKS * regime.cases);
    let cases = cases::<V>(family, SEED, BLOCKS * regime.cases);
    let mut sums = vec![0.0; 1 + tests.len()];
    for (easy, cases) in easy.chunks(regime.cases).zip(cases.chunks(regime.cases)) {
        let tests = tests.iter().map(|test| test.turn(cases));
        let turns = std::iter::once(reference.turn(easy)).chain(tests).collect();
        let times = timing::medians_of_turns(turns, regime.cases, regime);
        for (sum, time) in sums.iter_mut().zip(times) {
            *sum += time;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "blocks are few")]
    let blocks = BLOCKS as f64;
    let of_sum = |sum: &f64| Predicted { nanoseconds: sum / blocks, price: sum / sums[0] };
    sums[1..].iter().map(of_sum).collect()
}

/// The family of that name.
fn family_named(name: &str) -> &'static Family {
    FAMILIES.iter().find(|family| family.name == name).expect("it is a family")
}

/// Families with the same goal: at most so many times the textbook's time on the easy family, in f32 and in f64.
struct Goal {
    what: &'static str,
    families: &'static [&'static str],
    at_most: [f64; 2],
}

const EASY_F64: f64 = if cfg!(target_feature = "fma") { 3.3 } else { 4.0 };

const GOALS: [Goal; 11] = [
    Goal {
        what: "unit sphere at 2 to 10; far from the world's origin; direction of any length",
        families: &["easy", "far from the world's origin", "direction length"],
        at_most: [1.5, EASY_F64],
    },
    Goal { what: "from inside", families: &["inside"], at_most: [1.7, 5.0] },
    Goal { what: "huge spheres", families: &["huge"], at_most: [2.0, 7.0] },
    Goal { what: "distance/radius 1e2 to 1e4", families: &["far"], at_most: [2.0, 6.0] },
    Goal { what: "distance/radius 1e4 to 1e7", families: &["very far"], at_most: [3.5, 10.0] },
    Goal { what: "tiny radii", families: &["tiny"], at_most: [2.5, 8.0] },
    Goal { what: "a planet's limb from orbit", families: &["planet's limb"], at_most: [3.5, 12.0] },
    Goal { what: "grazing the limb", families: &["grazing"], at_most: [2.5, 8.0] },
    Goal { what: "grazing from afar", families: &["grazing from afar"], at_most: [4.0, 12.0] },
    Goal { what: "from the surface, rounded", families: &["on the surface"], at_most: [3.0, 20.0] },
    Goal {
        what: "exact tangent; exactly from the surface; exact tie",
        families: &["exact tangent", "on the surface, exactly", "exact tie"],
        at_most: [30.0, 50.0],
    },
];

/// The most for all other families.
const ANY: f64 = 100.0;

fn goal<V: Measured>(family: &str) -> f64 {
    let goal = GOALS.iter().find(|goal| goal.families.contains(&family));
    goal.map_or(ANY, |goal| V::either(goal.at_most[0], goal.at_most[1]))
}

/// A row of the table.
#[derive(Clone, Debug)]
struct Price {
    what: String,
    family: &'static str,
    time: Predicted,
    at_most: String,
}

/// The prices of a precision.
pub struct Prices {
    precision: &'static str,
    /// Of the nearest root by `Sphere::intersect`, family by family.
    nearest: Vec<Price>,
    /// Of what else a sphere is asked for.
    other: Vec<Price>,
}

/// The other functions of a sphere, besides the nearest root.
pub struct Questions<V: Measured> {
    textbook: Test<V, V::Scalar>,
    algebraic: Test<V, V::Scalar>,
    geometric: Test<V, V::Scalar>,
    textbook_roots: Test<V, [V::Scalar; 2]>,
    roots_algebraic: Test<V, [V::Scalar; 2]>,
    roots_geometric: Test<V, [V::Scalar; 2]>,
    textbook_hit: Test<V, Shading<V, V::Scalar>>,
    hit: Test<V, Hit<V>>,
    /// The crossing after the nearest: the range begins at the next float.
    exit: InRange<V>,
    /// Nothing: the range begins behind both roots.
    behind: InRange<V>,
}

/// The nearest root in a range that begins at a place of its own for each case.
struct InRange<V: Measured> {
    /// That place, between or behind the roots.
    start: fn([V::Scalar; 2]) -> V::Scalar,
    answer: Box<InRanges<V>>,
}

type InRanges<V> =
    dyn Fn(&[Case<V>], &[<V as Vector>::Scalar], &mut [Option<<V as Vector>::Scalar>]) + Sync;

impl<V: Measured> Timed<V> for InRange<V> {
    /// Where a ray misses, its range is the whole half-line.
    fn turn<'a>(&'a self, cases: &'a [Case<V>]) -> Turn<'a> {
        let start = |(ray, sphere): &Case<V>| {
            let of_hit = |[near, far]: [V::Scalar; 2]| {
                if near > V::Scalar::ZERO { (self.start)([near, far]) } else { V::Scalar::ZERO }
            };
            sphere.roots(ray).map_or(V::Scalar::ZERO, of_hit)
        };
        let starts: Vec<_> = cases.iter().map(start).collect();
        let mut answers = vec![None; cases.len()];
        Box::new(move || (self.answer)(black_box(cases), black_box(&starts), &mut answers))
    }
}

macro_rules! questions {
    ($function:ident, $module:ident, $vector:ident, $float:ident) => {
        pub fn $function() -> Questions<$vector> {
            use crate::methods::$module::{ahead, textbook, textbook_shading};

            const ALL: std::ops::Range<$float> = 0.0..$float::INFINITY;
            let in_range = |start| InRange::<$vector> {
                start,
                answer: Box::new(|cases, starts, answers| {
                    for (((ray, sphere), &start), answer) in cases.iter().zip(starts).zip(answers) {
                        *answer = sphere.intersect(ray, start..$float::INFINITY).map(|hit| hit.t);
                        // As for the others.
                        black_box(answer);
                    }
                }),
            };
            Questions {
                textbook: Test::new(|ray, sphere| ahead(textbook(ray, sphere))),
                algebraic: Test::new(|ray, sphere| {
                    Algebraic(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                }),
                geometric: Test::new(|ray, sphere| {
                    Geometric(*sphere).intersect(ray, ALL).map(|hit| hit.t)
                }),
                textbook_roots: Test::new(textbook),
                roots_algebraic: Test::new(|ray, sphere| sphere.roots_algebraic(ray)),
                roots_geometric: Test::new(|ray, sphere| sphere.roots_geometric(ray)),
                textbook_hit: Test::new(textbook_shading),
                hit: Test::new(|ray, sphere| sphere.intersect(ray, ALL)),
                exit: in_range(|[near, _]| $float::from_bits(near.to_bits() + 1)),
                behind: in_range(|[near, far]| far + (far - near)),
            }
        }
    };
}

questions!(questions_f32, single, Vec3, f32);
questions!(questions_f64, double, DVec3, f64);

impl<V: Measured> Questions<V> {
    pub fn textbook(&self) -> &dyn Timed<V> {
        &self.textbook
    }
}

impl Prices {
    /// Puts together the times of the nearest root, family by family, and those of the other questions, which are measured.
    pub fn new<V: Measured>(
        nearest: impl IntoIterator<Item = (&'static Family, Predicted)>,
        questions: &Questions<V>,
        effort: Effort,
    ) -> Self {
        let of_goal = |family: &str| GOALS.iter().position(|goal| goal.families.contains(&family));
        let mut nearest: Vec<Price> = nearest
            .into_iter()
            .map(|(family, time)| Price {
                what: named(family),
                family: family.name,
                time,
                at_most: multiple(goal::<V>(family.name)),
            })
            .collect();
        nearest.sort_by_key(|price| of_goal(price.family).unwrap_or(GOALS.len()));

        let mut prices = Self { precision: V::NAME, nearest, other: Vec::new() };
        for (family, roots_f32) in [("easy", 2.0), ("far", 3.0)] {
            let at_most = V::either(roots_f32, 1.3 * prices.of(family));
            prices.ask(family, questions, at_most, effort);
        }
        prices
    }

    /// The price of the nearest root on a family.
    fn of(&self, family: &str) -> f64 {
        let price = self.nearest.iter().find(|price| price.family == family);
        price.map_or(f64::NAN, |price| price.time.price)
    }

    /// Adds the prices of the other questions on a family.
    fn ask<V: Measured>(
        &mut self,
        family: &'static str,
        questions: &Questions<V>,
        roots_at_most: f64,
        effort: Effort,
    ) {
        /// An exit is to take at most 1.5 times the entry.
        const EXIT: f64 = 1.5;
        let exit_at_most = multiple(EXIT * self.of(family));
        let asked: [(&str, &dyn Timed<V>, String); 9] = [
            ("nearest root, `Algebraic`", &questions.algebraic, String::new()),
            ("nearest root, `Geometric`", &questions.geometric, String::new()),
            ("both roots, textbook", &questions.textbook_roots, String::new()),
            ("both roots, `roots_algebraic`", &questions.roots_algebraic, multiple(roots_at_most)),
            ("both roots, `roots_geometric`", &questions.roots_geometric, multiple(roots_at_most)),
            ("whole hit, textbook", &questions.textbook_hit, String::new()),
            ("whole hit, `intersect`", &questions.hit, String::new()),
            ("exit, range from the next float on", &questions.exit, exit_at_most.clone()),
            ("nothing, range behind", &questions.behind, exit_at_most),
        ];
        let tests: Vec<_> = asked.iter().map(|(_, test, _)| *test).collect();
        let times = predicted(&tests, &questions.textbook, family_named(family), effort);
        for ((what, _, at_most), time) in asked.into_iter().zip(times) {
            self.other.push(Price { what: format!("{family}: {what}"), family, time, at_most });
        }
    }

    /// The table of this precision.
    pub fn table(&self) -> Table {
        let mut table = Table::new(&["what", "ns", "× textbook's on easy", "goal"]);
        for price in self.nearest.iter().chain(&self.other) {
            table.row([
                price.what.clone(),
                format!("{:.1}", price.time.nanoseconds),
                multiple(price.time.price),
                price.at_most.clone(),
            ]);
        }
        table
    }

    /// The prices of the families of a goal, from the least to the largest.
    fn of_families(&self, families: &[&str]) -> String {
        range(self.nearest.iter().filter(|price| families.contains(&price.family)))
    }

    /// The prices of what else is asked on a family.
    fn of_question(&self, family: &str, question: &str) -> String {
        let is_it = |price: &&Price| {
            price.family == family
                && price.what.contains(question)
                && !price.what.contains("textbook")
        };
        range(self.other.iter().filter(is_it))
    }
}

/// Prices from the least to the largest.
fn range<'a>(prices: impl Iterator<Item = &'a Price> + Clone) -> String {
    let prices = prices.map(|price| price.time.price);
    if prices.clone().next().is_none() {
        return "–".into();
    }
    let least = multiple(prices.clone().fold(f64::INFINITY, f64::min));
    let largest = multiple(prices.fold(f64::NEG_INFINITY, f64::max));
    if least == largest { least } else { format!("{least}–{largest}") }
}

/// The table of all precisions in short, which the README shows.
pub fn in_short(of_precisions: &[&Prices]) -> Table {
    let mut heads = vec!["rays and spheres"];
    heads.extend(of_precisions.iter().map(|prices| prices.precision));
    let mut table = Table::new(&heads);
    let mut row = |what: &str, ranges: &mut dyn Iterator<Item = String>| {
        table.row(std::iter::once(what.to_owned()).chain(ranges).collect::<Vec<_>>());
    };
    for goal in &GOALS {
        row(goal.what, &mut of_precisions.iter().map(|prices| prices.of_families(goal.families)));
    }
    for (what, family, question) in [
        ("both roots, unit sphere at 2 to 10", "easy", "both roots"),
        ("both roots, distance/radius 1e2 to 1e4", "far", "both roots"),
        ("point and normal too, unit sphere at 2 to 10", "easy", "whole hit"),
        ("exit, unit sphere at 2 to 10", "easy", "exit"),
        ("range behind, unit sphere at 2 to 10", "easy", "range behind"),
    ] {
        row(what, &mut of_precisions.iter().map(|prices| prices.of_question(family, question)));
    }
    table
}

/// The name of a family, and what its cases are.
fn named(family: &Family) -> String {
    let Family { name, description, .. } = family;
    if description.starts_with(name) {
        (*description).into()
    } else {
        format!("{name}: {description}")
    }
}

/// A multiple with two digits that count.
fn multiple(value: f64) -> String {
    if value.is_nan() {
        "–".into()
    } else if value < 9.95 {
        format!("{value:.1}")
    } else {
        format!("{value:.0}")
    }
}
