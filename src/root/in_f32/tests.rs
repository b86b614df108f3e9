use super::*;
use crate::algebraic::Quadratic;
use crate::refine::needs_integers;

#[path = "../../tests/support/families.rs"]
mod families;

use families::{FAMILIES, Rng};

/// How far a case has to go for its nearest root.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Effort {
    FirstTry,
    SecondTry,
    Pairs,
    Integers,
}

fn effort(sphere: &Sphere, ray: &Ray) -> Effort {
    let setting = Setting::new(sphere, ray);
    match nearest_ahead(&setting.chord::<Quadratic>(), setting.radius_squared) {
        FirstTry::Miss => return Effort::FirstTry,
        FirstTry::Root { numerator, denominator, .. } => {
            let t = numerator / denominator;
            let normal = t >= f64::from(f32::MIN_POSITIVE) && rounds_safely::<MARGIN>(t);
            if normal || t < 0.0 {
                return Effort::FirstTry;
            }
        }
        FirstTry::Doubt => {}
    }
    let line = Line::new(sphere, ray);
    match second_try(line.o(), line.direction.into(), line.radius) {
        SecondTry::Miss => return Effort::SecondTry,
        SecondTry::Hit(estimate) if settle(&estimate, &line).is_some() => return Effort::SecondTry,
        _ => {}
    }
    if needs_integers::<f32>(&line) { Effort::Integers } else { Effort::Pairs }
}

/// `cargo test --lib how_often -- --nocapture` prints, of every family, how many in a hundred get no further than each try.
/// What that costs, `cargo bench --bench speed_vs_error` measures.
#[test]
fn how_often_the_careful_paths_run() {
    const CASES: u32 = 4000;
    println!("{:<28} {:>9} {:>9} {:>9} {:>9}", "%", "first", "second", "pairs", "integers");
    for family in FAMILIES {
        let mut rng = Rng::new(1);
        let mut counts = [0; 4];
        for _ in 0..CASES {
            let (ray, sphere) = (family.f32)(&mut rng);
            counts[effort(&sphere, &ray) as usize] += 1;
        }
        let [first, second, pairs, integers] =
            counts.map(|count| 100.0 * f64::from(count) / f64::from(CASES));
        println!("{:<28} {first:>9.2} {second:>9.2} {pairs:>9.2} {integers:>9.2}", family.name);
        if family.name == "easy" {
            assert!(first > 99.5, "the hot path is the rule");
        }
    }
}
