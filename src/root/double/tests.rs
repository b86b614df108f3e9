use super::*;
use crate::algebraic::Quadratic;
use crate::geometric::ClosestApproach;
use crate::root::again::tests::{Effort, careful_effort};
use crate::root::answer::Side;
use crate::root::line::is_safe;
use crate::root::tests::{assert_exact, line};
use crate::testing::{ExactChord, Float, Lie, Random, setting};

/// How far a case has to go for its nearest root.
pub(in crate::root) fn effort(sphere: &Sphere<DVec3>, ray: &Ray<DVec3>) -> Effort {
    let range = 0.0..f64::INFINITY;
    let setting = Setting::new(sphere, ray);
    if let Some(chord) = setting.safe_chord::<Quadratic>() {
        match plain::nearest_ahead(&chord, setting.radius_squared, halves::CLEAR, || None) {
            Nearest::Miss => return Effort::Hot,
            Nearest::Root { t, half_chord } => {
                let size = setting.radius_squared * setting.larger(&chord);
                let corrected = setting.correction(&chord).correct_surely(t, half_chord, size);
                if corrected.is_some_and(|corrected| corrected.t.hi >= range.start) {
                    return Effort::Hot;
                }
            }
            Nearest::Doubt => {}
        }
    }
    if from_the_surface(setting.line, Format::F64, &range).is_some() {
        return Effort::Again;
    }
    careful_effort(&setting.line, Format::F64, range)
}

fn ray_and_sphere(numbers: [f64; 10]) -> (Ray<DVec3>, Sphere<DVec3>) {
    let line = line(numbers);
    (Ray::new(line.origin, line.direction), Sphere::new(line.center, line.radius))
}

const LIES: [Lie; 14] = [
    Lie { power: 0.99, discriminant: 1e-4 },
    Lie { power: 0.5, discriminant: 0.3 },
    Lie { power: 0.5, discriminant: 1e-8 },
    Lie { power: 0.5, discriminant: 1e-13 },
    Lie { power: 0.5, discriminant: -1e-13 },
    Lie { power: -0.5, discriminant: 0.7 },
    Lie { power: 1e-3, discriminant: 0.5 },
    Lie { power: -1e-3, discriminant: 0.5 },
    Lie { power: 1e-9, discriminant: 0.5 },
    Lie { power: -1e-9, discriminant: 0.5 },
    Lie { power: 1e-15, discriminant: 0.3 },
    Lie { power: -1e-16, discriminant: 0.5 },
    Lie { power: 1.0 - 1e-8, discriminant: 1e-9 },
    Lie { power: 1.0 - 1e-13, discriminant: 3e-14 },
];

#[test]
fn squares_are_safe_from_2_to_the_minus_480_up_to_2_to_the_480() {
    let (least, most) = (2_f64.powi(-480), 2_f64.powi(480));
    for square in [least, 1.0, most * (1.0 - f64::EPSILON)] {
        assert!(is_safe(square), "{square:e}");
    }
    let below = least * (1.0 - f64::EPSILON / 2.0);
    for square in [below, most, 0.0, -0.0, -1.0, f64::INFINITY, -f64::INFINITY, f64::NAN] {
        assert!(!is_safe(square), "{square:e}");
    }
}

#[test]
fn answers_are_the_exact_ones_rounded() {
    let mut random = Random::new(1);
    let mut close = 0;
    for _ in 0..3000 {
        let lie = LIES[random.below(LIES.len())];
        let numbers = setting(&mut random, lie);
        let (ray, sphere) = ray_and_sphere(numbers);
        let exact = ExactChord::new(numbers).roots();
        let roots = exact.map(|roots| [0, 1].map(|side: usize| f64::nearest(&roots[side])));
        assert_eq!(DVec3::roots::<Quadratic>(&sphere, &ray), roots, "{numbers:?}");
        assert_eq!(DVec3::roots::<ClosestApproach>(&sphere, &ray), roots, "{numbers:?}");
        let ahead = roots.into_iter().flatten().filter(|t| *t > 0.0).collect::<Vec<_>>();
        // From the first root on, from just behind it, and only up to it.
        let mut ranges = vec![0.0..f64::INFINITY];
        for t in &ahead {
            let next = f64::from_bits(t.to_bits() + 1);
            ranges.extend([*t..f64::INFINITY, next..f64::INFINITY, 0.0..*t, 0.0..next]);
        }
        // Nothing behind the origin is ahead, and there is no number in a range from or to NaN.
        ranges.extend([-1e9..f64::INFINITY, 0.0..f64::NAN, f64::NAN..f64::INFINITY, 1.0..0.0]);
        for range in ranges {
            let expected = ahead.iter().copied().find(|t| range.contains(t));
            let found = [
                DVec3::intersect::<Quadratic>(&sphere, &ray, range.clone()).map(|hit| hit.t),
                DVec3::intersect::<ClosestApproach>(&sphere, &ray, range.clone()).map(|hit| hit.t),
                nearest_again(&line(numbers), range.clone()).map(|found| found.t),
            ];
            assert_eq!(found, [expected; 3], "{range:?} {numbers:?}");
            if let Some(found) = from_the_surface(line(numbers), Format::F64, &range) {
                assert_eq!(found.map(|found| found.t), expected, "{range:?} {numbers:?}");
                close += 1;
            }
        }
    }
    assert!(close > 2000, "{close} from close to the surface");
}

#[test]
fn careful_hits_are_rounded_correctly() {
    let mut random = Random::new(2);
    let mut hits = 0;
    for _ in 0..3000 {
        let lie = LIES[random.below(LIES.len())];
        let numbers = setting(&mut random, lie);
        let Some(found) = nearest_again(&line(numbers), 0.0..f64::INFINITY) else { continue };
        // Outside, the near root is ahead; inside, the far one.
        let is_inside = ExactChord::new(numbers).power.is_negative();
        let side = if is_inside { Side::Far } else { Side::Near };
        assert_exact(Format::F64, numbers, side, &found);
        hits += 1;
    }
    assert!(hits > 1000, "{hits} hits");
}
