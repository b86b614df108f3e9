use glam::{DVec3, Vec3};

use super::*;
use crate::geometric::ClosestApproach;
use crate::root::double;
use crate::root::format::Format;
use crate::root::precision::Precision;
use crate::root::tests::{careful_steps, line, parts_of_tolerance, single};
use crate::testing::{Dyadic, ExactChord, Float, Lie, Random, part_of_bound, search, setting};

use crate::testing::families::{FAMILIES, Rng};

/// How far a case has to go for its nearest root.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(in crate::root) enum Effort {
    /// The plain step; in `f64`, with the correction by halves.
    Hot,
    /// A finer power or a rough root.
    Again,
    Pairs,
    Integers,
}

/// Which of the steps that are the same for both precisions decides.
pub(in crate::root) fn careful_effort(line: &Line, format: Format, range: Range<f64>) -> Effort {
    let question = Question::Nearest(range);
    let [in_pairs, _] = careful_steps(line, format, &question);
    if matches!(in_pairs, Verdict::Doubt) { Effort::Integers } else { Effort::Pairs }
}

#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn effort(sphere: &Sphere, ray: &Ray) -> Effort {
    let setting = Setting::new(sphere, ray);
    let chord = setting.chord::<Quadratic>();
    let is_certain = |t: f64| t as f32 >= f32::MIN_POSITIVE;
    match nearest_ahead(&setting, &chord, false) {
        Nearest::Miss => return Effort::Hot,
        Nearest::Root { t, .. } if rounds_safely::<MARGIN>(t) && is_certain(t) => {
            return Effort::Hot;
        }
        _ => {}
    }
    let is_far = chord.distance_squared > NEAR * setting.radius_squared;
    let nearest =
        if is_far { from_afar(&setting, &chord) } else { nearest_ahead(&setting, &chord, true) };
    match nearest {
        Nearest::Miss => return Effort::Again,
        Nearest::Root { t, .. } if is_certain(t) => {
            return if rounds_safely::<MARGIN>(t) { Effort::Again } else { Effort::Integers };
        }
        _ => {}
    }
    careful_effort(&setting.line, Format::F32, 0.0..f64::INFINITY)
}

/// `cargo test --lib how_often -- --nocapture` prints, of every family, how many in a hundred get no further than each step.
/// What that costs, `cargo bench --bench speed_vs_error` measures.
#[test]
fn how_often_the_careful_paths_run() {
    const CASES: u32 = 2000;
    let print = |name: &str, precision: &str, efforts: &mut dyn FnMut() -> Effort| {
        let mut counts = [0; 4];
        for _ in 0..CASES {
            counts[efforts() as usize] += 1;
        }
        let parts = counts.map(|count| 100.0 * f64::from(count) / f64::from(CASES));
        let [hot, again, pairs, integers] = parts;
        println!("{name:<28} {precision} {hot:>8.2} {again:>8.2} {pairs:>8.2} {integers:>8.2}");
        if name == "easy" {
            assert!(hot > 99.0, "the hot path is the rule");
        }
    };
    println!("{:<32} {:>8} {:>8} {:>8} {:>8}", "%", "hot", "again", "pairs", "integers");
    for family in FAMILIES {
        let mut rng = Rng::new(1);
        print(family.name, "f32", &mut || {
            let (ray, sphere) = (family.f32)(&mut rng);
            effort(&sphere, &ray)
        });
        let mut rng = Rng::new(1);
        print(family.name, "f64", &mut || {
            let (ray, sphere) = (family.f64)(&mut rng);
            double::tests::effort(&sphere, &ray)
        });
    }
}

#[expect(clippy::cast_possible_truncation, reason = "they are f32")]
fn ray_and_sphere(numbers: [f64; 10]) -> (Ray, Sphere) {
    let line = line(numbers);
    let ray = Ray::new(line.origin.as_vec3(), line.direction.as_vec3());
    (ray, Sphere::new(line.center.as_vec3(), line.radius as f32))
}

fn rounded(exact: &Dyadic) -> f32 {
    f32::nearest(exact)
}

const LIES: [Lie; 14] = [
    Lie { power: 0.99, discriminant: 1e-4 },
    Lie { power: 0.5, discriminant: 0.3 },
    Lie { power: 0.5, discriminant: 1e-8 },
    Lie { power: 0.5, discriminant: 1e-13 },
    Lie { power: 0.5, discriminant: -1e-13 },
    Lie { power: -0.5, discriminant: 0.7 },
    Lie { power: 1e-9, discriminant: 0.5 },
    Lie { power: -1e-9, discriminant: 0.5 },
    Lie { power: 1e-12, discriminant: 0.3 },
    // From afar, through the middle and close to the limb.
    Lie { power: 1.0 - 1.1 / NEAR, discriminant: 0.5 / NEAR },
    Lie { power: 1.0 - 0.9 / NEAR, discriminant: 0.5 / NEAR },
    Lie { power: 1.0 - 1e-8, discriminant: 1e-9 },
    Lie { power: 1.0 - 1e-8, discriminant: 3e-10 },
    Lie { power: 1.0 - 1e-13, discriminant: 3e-14 },
];

#[test]
fn the_margin_is_that_of_the_plain_step() {
    assert_eq!(MARGIN, 18 << 16);
    assert_eq!(CLEAR, 2_f64.powi(-16));
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded already")]
fn answers_are_the_exact_ones_rounded() {
    let mut random = Random::new(1);
    for _ in 0..3000 {
        let lie = LIES[random.below(LIES.len())];
        let numbers = single(setting(&mut random, lie));
        let (ray, sphere) = ray_and_sphere(numbers);
        let exact = ExactChord::new(numbers).roots();
        let roots = exact.map(|roots| [0, 1].map(|side: usize| rounded(&roots[side])));
        assert_eq!(Vec3::roots::<Quadratic>(&sphere, &ray), roots, "{numbers:?}");
        assert_eq!(Vec3::roots::<ClosestApproach>(&sphere, &ray), roots, "{numbers:?}");
        let ahead = roots.into_iter().flatten().filter(|t| *t > 0.0).collect::<Vec<_>>();
        // From the first root on, from just behind it, and only up to it.
        let mut ranges = vec![0.0..f32::INFINITY];
        for t in &ahead {
            let next = f32::from_bits(t.to_bits() + 1);
            ranges.extend([*t..f32::INFINITY, next..f32::INFINITY, 0.0..*t, 0.0..next]);
        }
        // There is no number in a range from or to NaN.
        ranges.extend([0.0..f32::NAN, f32::NAN..f32::INFINITY, 1.0..0.0]);
        for range in ranges {
            let expected = ahead.iter().copied().find(|t| range.contains(t));
            let found = [
                Vec3::intersect::<Quadratic>(&sphere, &ray, range.clone()).map(|hit| hit.t),
                Vec3::intersect::<ClosestApproach>(&sphere, &ray, range.clone()).map(|hit| hit.t),
                nearest_again(&sphere, &ray, &Line::new(&sphere, &ray), range.clone())
                    .map(|found| found.t as f32),
            ];
            assert_eq!(found, [expected; 3], "{range:?} {numbers:?}");
        }
    }
}

#[test]
fn points_keep_their_tolerance() {
    let start = |random: &mut Random| {
        let lie = LIES[random.below(LIES.len())];
        setting(random, lie)
    };
    let part = |numbers| {
        let numbers = single(numbers);
        let (ray, sphere) = ray_and_sphere(numbers);
        let roots = ExactChord::new(numbers).roots()?;
        let tolerance = Format::F32.point_tolerance();
        let part = |found: Found| {
            let near = Dyadic::exactly(found.t);
            let closer = |a: &&Dyadic, b: &&Dyadic| (*a - &near).abs().cmp(&(*b - &near).abs());
            let root = roots.iter().min_by(closer).expect("two roots");
            let [point, normal] = parts_of_tolerance(numbers, root, &found, tolerance);
            point.max(normal)
        };
        let line = Line::new(&sphere, &ray);
        nearest_again(&sphere, &ray, &line, 0.0..f32::INFINITY).map(part)
    };
    assert!(search("point of the plain step in f32", 80, 150, start, part) > 0.03);
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded already")]
fn roots_and_points_from_afar_keep_their_bounds() {
    let mut random = Random::new(4);
    let (mut certain, mut worst) = (0, [0.0_f64; 2]);
    for _ in 0..8000 {
        // Of all distances, and from the middle to the limb.
        let radius_squared = 2_f64.powi(-random.integer(15..=66));
        let chord_squared = radius_squared * 2_f64.powi(-random.integer(1..=40));
        let lie = Lie { power: 1.0 - radius_squared, discriminant: chord_squared };
        let mut numbers = setting(&mut random, lie);
        let [cx, cy, cz, px, py, pz, ..] = numbers;
        numbers[9] = radius_squared.sqrt() * DVec3::new(cx - px, cy - py, cz - pz).length();
        let setting = Setting::of(line(numbers));
        let chord = setting.chord::<Quadratic>();
        let exact = ExactChord::new(numbers);
        match half_chord_from_afar(&setting) {
            Verdict::Miss => assert!(exact.discriminant.is_negative(), "{numbers:?}"),
            Verdict::Hit(half_chord) => {
                let roots = exact.roots().expect("this hits");
                let Both::Roots { t, .. } = Both::from_half_chord(&chord, half_chord) else {
                    panic!("there are roots");
                };
                for (t, exact) in t.into_iter().zip(&roots) {
                    let bound = &Dyadic::exactly(plain::ROOT_ERROR / CLEAR) * &exact.clone().abs();
                    worst[0] = worst[0].max(part_of_bound(&Dyadic::exactly(t), exact, &bound));
                }
                let Nearest::Root { t, .. } = from_afar(&setting, &chord) else { continue };
                let far = plain::far_root(&chord, half_chord);
                for ((side, t), root) in [(Side::Near, t), (Side::Far, far)].into_iter().zip(&roots)
                {
                    let found = setting.found_from_afar(&chord, side, t as f32);
                    let tolerance = Format::F32.point_tolerance();
                    let parts = parts_of_tolerance(numbers, root, &found, tolerance);
                    worst[1] = worst[1].max(parts[0]).max(parts[1]);
                }
                certain += 1;
            }
            Verdict::Doubt => {}
        }
    }
    println!("from afar: {} of the bound of roots, {} of points", worst[0], worst[1]);
    assert!(worst.iter().all(|part| *part <= 1.0) && worst[1] > 0.03, "{worst:?}");
    assert!(certain > 500, "{certain}");
}
