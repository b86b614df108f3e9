use super::*;
use crate::algebraic::Quadratic;
use crate::testing::{Dyadic, ExactChord, Lie, Random, part_of_bound, search, setting};

fn line(numbers: [f64; 10]) -> Setting {
    let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = numbers;
    Setting::new(
        &Sphere::new(DVec3::new(cx, cy, cz), radius),
        &Ray::new(DVec3::new(px, py, pz), DVec3::new(dx, dy, dz)),
    )
}

const LIES: [Lie; 6] = [
    Lie { power: 0.99, discriminant: 1e-4 },
    Lie { power: 0.5, discriminant: 0.5 },
    Lie { power: 1e-4, discriminant: 1e-4 },
    Lie { power: -0.9, discriminant: 0.95 },
    // From the surface through the center, where the bound is what it is for.
    Lie { power: 1e-4, discriminant: 0.9998 },
    Lie { power: -1e-4, discriminant: 0.9999 },
];

fn search_settings(what: &str, part: impl Fn(&ExactChord, &Setting) -> Option<f64>) -> f64 {
    let start = |random: &mut Random| {
        let lie = LIES[random.below(LIES.len())];
        setting(random, lie)
    };
    search(what, 60, 200, start, |numbers| part(&ExactChord::new(numbers), &line(numbers)))
}

/// The roots of the first try, before they are polished.
fn first_roots(setting: &Setting) -> Option<([f64; 2], f64)> {
    match both_roots(&setting.chord::<Quadratic>()?, setting.radius_squared) {
        BothRoots::Roots { t, half_chord } => Some((t, half_chord)),
        _ => None,
    }
}

/// The larger part that the residuals at two numbers take of their bound.
fn residuals(exact: &ExactChord, setting: &Setting, numbers: [f64; 2]) -> f64 {
    let parts = numbers.map(|t| {
        let number = Dyadic::exactly(t);
        let slope = &(&exact.a * &number) - &(&exact.h + &exact.h);
        let residual = &(&slope * &number) + &exact.power;
        let unit = &Dyadic::exactly(f64::EPSILON) * &residual.clone().abs();
        let bound = &unit + &(&Dyadic::exactly(RESIDUAL_ERROR) * &exact.larger());
        part_of_bound(&Dyadic::exactly(setting.residual(t)), &residual, &bound)
    });
    parts[0].max(parts[1])
}

#[test]
fn residuals_keep_their_bound() {
    let first_try = |exact: &ExactChord, setting: &Setting| {
        Some(residuals(exact, setting, first_roots(setting)?.0))
    };
    assert!(search_settings("residual at the first try", first_try) > 0.07);

    // At a root, its own last place is nothing, and the bound is that of what is rounded on the way.
    let nearest = |exact: &ExactChord, setting: &Setting| {
        let roots = exact.roots()?.map(|root| root.approximately());
        Some(residuals(exact, setting, roots))
    };
    assert!(search_settings("residual at a root", nearest) > 0.1);
}

#[test]
fn polished_roots_are_the_nearest_or_next_to_it() {
    // Half a unit in the last place for the rounding of the sum, and 2⁻⁹ of one for all else, twice the square of the first
    // try's error over √CLEAR: 2⁻⁶² of the root.
    let part = |exact: &ExactChord, setting: &Setting| {
        let (roots, half_chord) = first_roots(setting)?;
        let expected = exact.roots().expect("this hits");
        let parts = [(0, half_chord), (1, -half_chord)].map(|(side, half_chord): (usize, f64)| {
            let (t, _) = setting.polish(roots[side], half_chord);
            let unit = f64::from_bits(t.abs().to_bits() + 1) - t.abs();
            let rest = &Dyadic::exactly(2_f64.powi(-62)) * &expected[side].clone().abs();
            let bound = &Dyadic::exactly(unit / 2.0) + &rest;
            part_of_bound(&Dyadic::exactly(t), &expected[side], &bound)
        });
        Some(parts[0].max(parts[1]))
    };
    assert!(search_settings("polished root", part) > 0.99);
}
