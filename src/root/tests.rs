use core::ops::Range;

use glam::{DVec3, Vec3};

use super::answer::{Found, Side};
use super::*;
use crate::arithmetic::pair::U;
use crate::arithmetic::scaling::scale;
use crate::testing::support::oracle::BITS;
use crate::testing::{Dyadic, ExactChord, Float, Lie, Random, Root, part_of_bound, setting, total};
use crate::{Hittable, Ray, Sphere};

/// How far off a point may be besides the rounding of its coordinates: by the smaller of two lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointTolerance {
    /// A part of the distance travelled, t times the direction's length.
    pub(super) of_distance: f64,
    /// A part of the radius.
    pub(super) of_radius: f64,
}

impl Format {
    /// What the first steps keep to.
    pub(super) const fn point_tolerance(self) -> PointTolerance {
        match self {
            // 2^-30 and 2^-24.
            Self::F32 => PointTolerance {
                of_distance: f32::EPSILON as f64 / 128.0,
                of_radius: f32::EPSILON as f64 / 2.0,
            },
            // 2^-60 and 2^-53.
            Self::F64 => PointTolerance { of_distance: U / 128.0, of_radius: U },
        }
    }
}

/// The line and the sphere of the coordinates of center, origin and direction, and the radius.
pub(super) fn line(numbers: [f64; 10]) -> Line {
    let [cx, cy, cz, px, py, pz, dx, dy, dz, radius] = numbers;
    Line {
        center: DVec3::new(cx, cy, cz),
        origin: DVec3::new(px, py, pz),
        direction: DVec3::new(dx, dy, dz),
        radius,
    }
}

/// What the moved origin says, and what integers say.
pub(super) fn careful_steps(
    line: &Line,
    format: Format,
    question: &Question,
) -> [Verdict<Answer>; 2] {
    let Some(scaled) = Scaled::new(line) else { return [Verdict::Doubt, Verdict::Doubt] };
    [
        moved_origin::chord(&scaled.line, format)
            .and_then(|chord| question.ask(&mut scaled.unscaled(chord))),
        integers::chord(&scaled.line, format)
            .and_then(|chord| question.ask(&mut scaled.unscaled(chord))),
    ]
}

/// Its coordinates rounded to `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
pub(super) fn single(numbers: [f64; 10]) -> [f64; 10] {
    numbers.map(|number| (number as f32).into())
}

fn numbers_of(Line { origin, direction, center, radius }: &Line) -> [f64; 10] {
    let [[cx, cy, cz], [px, py, pz], [dx, dy, dz]] =
        [center, origin, direction].map(DVec3::to_array);
    [cx, cy, cz, px, py, pz, dx, dy, dz, *radius]
}

/// Lines of every kind: integers, floats of a few exponents, of many, and exact tangents.
pub(super) fn lines_of_every_kind(random: &mut Random) -> [f64; 10] {
    let mut numbers = match random.below(8) {
        0 => [0.0; 10].map(|_: f64| f64::from(random.integer(-20..=20))),
        1 => {
            let lie = Lie { power: 2_f64.powi(-random.integer(1..=50)), discriminant: 0.25 };
            single(setting(random, lie))
        }
        2 => {
            let lie = Lie { power: 2_f64.powi(-random.integer(1..=50)), discriminant: 0.25 };
            setting(random, lie)
        }
        3 => [0.0; 10].map(|_: f64| random.float(-300..=300)),
        // All of 53 bits at both ends of 61 places.
        4 => [0.0; 10].map(|_: f64| random.float(-8..=0)),
        // Half the chord is 4 where the line is 3 off a center of radius 5, or 0: roots of a few bits, and of 54.
        5 | 6 => {
            let size = f64::from(random.integer(1..=1000));
            let aside = [3.0, 5.0][random.below(2)] * size;
            let shift = 2_f64.powi(random.integer(0..=49));
            [shift, aside, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 5.0 * size]
        }
        _ => {
            // A tangent with the direction (3, 4, 0) and the normal (-4, 3, 0).
            let long = f64::from(random.integer(1..=1000));
            let radius = f64::from(random.integer(1..=1000));
            let along = f64::from(random.integer(-1000..=1000));
            let center = [3.0 * along - 4.0 * radius, 4.0 * along + 3.0 * radius];
            [center[0], center[1], 7.0, 0.0, 0.0, 7.0, 3.0 * long, 4.0 * long, 0.0, 5.0 * radius]
        }
    };
    numbers[9] = numbers[9].abs();
    if numbers[6..9].iter().all(|d| *d == 0.0) {
        numbers[7] = 1.0;
    }
    // In any units, brought near 1.
    let (lengths, directions) = (random.integer(-300..=300), random.integer(-300..=300));
    for (index, number) in numbers.iter_mut().enumerate() {
        *number = scale(*number, if (6..9).contains(&index) { directions } else { lengths });
    }
    Scaled::new(&line(numbers)).map_or(numbers, |scaled| numbers_of(&scaled.line))
}

/// The exact length of a vector, to 80 bits.
pub(super) fn length(vector: &[Dyadic; 3]) -> Dyadic {
    total([0, 1, 2].map(|axis| &vector[axis] * &vector[axis])).square_root(80)
}

pub(super) fn difference(a: &[Dyadic; 3], b: &[Dyadic; 3]) -> [Dyadic; 3] {
    [0, 1, 2].map(|axis| &a[axis] - &b[axis])
}

/// Direction d, origin p and o = c - p.
pub(super) struct ExactLine {
    pub(super) d: [Dyadic; 3],
    pub(super) p: [Dyadic; 3],
    pub(super) o: [Dyadic; 3],
}

impl ExactLine {
    pub(super) fn new(numbers: [f64; 10]) -> Self {
        let [cx, cy, cz, px, py, pz, dx, dy, dz, _] = numbers.map(Dyadic::exactly);
        let p = [px, py, pz];
        Self { d: [dx, dy, dz], o: difference(&[cx, cy, cz], &p), p }
    }

    /// o × d.
    pub(super) fn moment(&self) -> [Dyadic; 3] {
        let Self { o, d, .. } = self;
        [(1, 2), (2, 0), (0, 1)].map(|(j, k): (usize, usize)| &(&o[j] * &d[k]) - &(&o[k] * &d[j]))
    }

    /// P = |o| |d|.
    pub(super) fn reach(&self) -> Dyadic {
        &length(&self.o) * &length(&self.d)
    }

    /// t d - o.
    pub(super) fn offset(&self, t: &Dyadic) -> [Dyadic; 3] {
        [0, 1, 2].map(|axis| &(t * &self.d[axis]) - &self.o[axis])
    }
}

/// What part of what is allowed the error of the point takes, and of the normal, at that exact root: in each coordinate, the
/// tolerance and the rounding.
pub(super) fn parts_of_tolerance(
    numbers: [f64; 10],
    root: &Dyadic,
    found: &Found,
    tolerance: PointTolerance,
) -> [f64; 2] {
    let exact = ExactLine::new(numbers);
    let radius = Dyadic::exactly(numbers[9]);
    let offset = exact.offset(root);
    let travelled = &root.clone().abs() * &length(&exact.d);
    let of_radius = &Dyadic::exactly(tolerance.of_radius) * &radius;
    let of_distance = &Dyadic::exactly(tolerance.of_distance) * &travelled;
    let allowed = of_radius.min(of_distance);
    let part = |found: f64, exact: &Dyadic, allowed: &Dyadic, ulps: f64| {
        let half_ulp = (f64::from_bits(found.abs().to_bits() + 1) - found.abs()) / 2.0;
        let allowed = allowed + &Dyadic::exactly(half_ulp * ulps);
        part_of_bound(&Dyadic::exactly(found), exact, &allowed)
    };
    let point = [0, 1, 2].map(|axis: usize| {
        let exact = &exact.p[axis] + &(root * &exact.d[axis]);
        part(found.point[axis], &exact, &allowed, 1.0)
    });
    // Rounded themselves, and by the division by the radius.
    let normal = [0, 1, 2].map(|axis: usize| {
        let exact = offset[axis].divided_by(&radius, 200);
        part(found.normal[axis], &exact, &Dyadic::exactly(tolerance.of_radius), 2.0)
    });
    [point, normal].map(|parts| parts.into_iter().fold(0.0, f64::max))
}

/// The number (A + B √D) / C of these, correctly rounded.
pub(super) fn exact_surd(format: Format, numbers: [&Dyadic; 4]) -> f64 {
    let surd = Root::new(numbers.map(Dyadic::clone), BITS);
    match format {
        Format::F32 => surd.nearest::<f32>().into(),
        Format::F64 => surd.nearest(),
    }
}

/// One of the roots, rounded.
pub(super) fn exact_root(format: Format, numbers: [f64; 10], side: Side) -> f64 {
    let ExactChord { a, h, discriminant, .. } = ExactChord::new(numbers);
    let along = Dyadic::new(if side == Side::Near { -1 } else { 1 }, 0);
    exact_surd(format, [&h, &along, &discriminant, &a])
}

/// The hit at one of the roots, as the careful steps are to give it.
fn exact_hit(format: Format, numbers: [f64; 10], side: Side) -> Found {
    let chord = ExactChord::new(numbers);
    let ExactLine { d, p, o } = ExactLine::new(numbers);
    let [a, h, discriminant] = [&chord.a, &chord.h, &chord.discriminant];
    let surd = |rational: &Dyadic, along: &Dyadic, denominator: &Dyadic| {
        let along = if side == Side::Near { -along } else { along.clone() };
        exact_surd(format, [rational, &along, discriminant, denominator])
    };
    let t = exact_root(format, numbers, side);
    let radius = Dyadic::exactly(numbers[9]);
    let [mut point, mut normal] = [[0.0; 3]; 2];
    for axis in 0..3 {
        let along = h * &d[axis];
        // A zero has no sign.
        point[axis] = surd(&(&along + &(a * &p[axis])), &d[axis], a) + 0.0;
        normal[axis] = if radius.is_zero() {
            exact_surd(format, [&Dyadic::ZERO, &-&d[axis], a, a]) + 0.0
        } else {
            let exponent = radius.magnitude();
            let rational = &along - &(a * &o[axis]);
            let offset = surd(&rational, &d[axis], &a.clone().scaled(exponent));
            let normal = format.nearest(offset / radius.clone().scaled(-exponent).approximately());
            let least = if format == Format::F32 { -24 } else { -53 };
            if normal.abs() < 2_f64.powi(least) { 0.0 } else { normal }
        };
    }
    Found { t, point: point.into(), normal: normal.into() }
}

/// Asserts that a hit is that of one of the roots.
pub(super) fn assert_exact(format: Format, numbers: [f64; 10], side: Side, found: &Found) {
    let bits = |found: &Found| {
        [found.point, found.normal].map(|vector| vector.to_array().map(f64::to_bits))
    };
    let expected = exact_hit(format, numbers, side);
    assert_eq!(found.t, expected.t, "{format:?} {side:?} {numbers:?}");
    let (found_bits, expected_bits) = (bits(found), bits(&expected));
    assert_eq!(found_bits, expected_bits, "{found:?} {expected:?} {format:?} {numbers:?}");
}

/// Both roots by the careful steps, `None` for a miss.
fn both(numbers: [f64; 10], format: Format) -> Option<[f64; 2]> {
    carefully(&line(numbers), format, &Question::Both)?.roots()
}

fn nearest_ahead(numbers: [f64; 10], format: Format) -> Option<Found> {
    carefully(&line(numbers), format, &Question::Nearest(0.0..f64::INFINITY))?.nearest()
}

fn rounded(format: Format, exact: &Dyadic) -> f64 {
    match format {
        Format::F32 => f32::nearest(exact).into(),
        Format::F64 => f64::nearest(exact),
    }
}

const ANYWHERE: [Lie; 8] = [
    Lie { power: 0.999, discriminant: -0.01 },
    Lie { power: 0.99, discriminant: 1e-6 },
    Lie { power: 0.1, discriminant: 1e-3 },
    Lie { power: 1e-14, discriminant: 1e-14 },
    Lie { power: -1e-20, discriminant: 0.5 },
    Lie { power: 1e-16, discriminant: 0.5 },
    Lie { power: 0.5, discriminant: 1e-31 },
    Lie { power: -0.9, discriminant: 0.95 },
];

#[test]
fn careful_answers_are_the_exact_ones_rounded() {
    let mut random = Random::new(6);
    for round in 0..2000 {
        let lie = ANYWHERE[random.below(ANYWHERE.len())];
        let numbers = setting(&mut random, lie);
        let (format, numbers) =
            if round % 2 == 0 { (Format::F64, numbers) } else { (Format::F32, single(numbers)) };
        let expected = ExactChord::new(numbers).roots();
        let rounded =
            expected.as_ref().map(|roots| [0, 1].map(|i: usize| rounded(format, &roots[i])));
        assert_eq!(both(numbers, format), rounded, "{format:?} {numbers:?}");
        let ahead = rounded.and_then(|roots| roots.iter().position(|t| *t > 0.0));
        let found = nearest_ahead(numbers, format);
        assert_eq!(found.map(|found| found.t), ahead.map(|side| rounded.unwrap()[side]));
        if let (Some(found), Some(side)) = (found, ahead) {
            assert_exact(format, numbers, [Side::Near, Side::Far][side], &found);
        }
    }
}

#[test]
fn lines_of_any_size_have_the_same_roots() {
    let mut random = Random::new(2);
    for _ in 0..500 {
        let lie = ANYWHERE[1 + random.below(ANYWHERE.len() - 1)];
        let numbers = setting(&mut random, lie);
        let (lengths, directions) = (random.integer(-900..=900), random.integer(-900..=900));
        let mut scaled = numbers;
        for (index, number) in scaled.iter_mut().enumerate() {
            *number = scale(*number, if (6..9).contains(&index) { directions } else { lengths });
        }
        let expected = both(numbers, Format::F64)
            .map(|roots| roots.map(|root| scale(root, lengths - directions)));
        let Some(expected) = expected else { continue };
        if expected.iter().any(|root| !root.is_normal()) {
            continue;
        }
        assert_eq!(
            both(scaled, Format::F64),
            Some(expected),
            "2^{lengths} 2^{directions} {numbers:?}"
        );
    }
}

#[test]
fn roots_at_the_ends_of_the_range_are_the_nearest() {
    let mut random = Random::new(4);
    for _ in 0..300 {
        let lie = ANYWHERE[1 + random.below(ANYWHERE.len() - 1)];
        let mut numbers = setting(&mut random, lie);
        // Subnormal roots, and roots next to infinity.
        let e = if random.below(2) == 0 {
            -1022 - random.integer(0..=52)
        } else {
            1023 + random.integer(-2..=1)
        };
        for (index, number) in numbers.iter_mut().enumerate() {
            *number = scale(*number, if (6..9).contains(&index) { -e / 2 } else { e - e / 2 });
        }
        let exact = ExactChord::new(numbers).roots();
        let expected = exact.map(|roots| [0, 1].map(|i: usize| rounded(Format::F64, &roots[i])));
        assert_eq!(both(numbers, Format::F64), expected, "{numbers:?}");
        let ahead =
            expected.and_then(|roots| roots.into_iter().find(|t| *t > 0.0 && t.is_finite()));
        assert_eq!(nearest_ahead(numbers, Format::F64).map(|found| found.t), ahead, "{numbers:?}");
    }
}

#[test]
fn a_range_is_half_open_and_may_begin_behind_the_first_root() {
    // Roots 3 and 7.
    let numbers = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    let line = line(numbers);
    for format in [Format::F32, Format::F64] {
        let nearest = |range: Range<f64>| {
            carefully(&line, format, &Question::Nearest(range))?.nearest().map(|found| found.t)
        };
        assert_eq!(nearest(0.0..f64::INFINITY), Some(3.0));
        assert_eq!(nearest(3.0..4.0), Some(3.0));
        assert_eq!(nearest(0.0..3.0), None);
        assert_eq!(nearest(3.5..f64::INFINITY), Some(7.0));
        assert_eq!(nearest(7.0..f64::INFINITY), Some(7.0));
        assert_eq!(nearest(3.5..7.0), None);
        assert_eq!(nearest(f64::NAN..f64::INFINITY), None);
        let question = Question::Nearest(0.0..9.0);
        assert!(carefully(&line, format, &question).unwrap().roots().is_none());
        assert!(carefully(&line, format, &Question::Both).unwrap().nearest().is_none());
    }
}

#[test]
fn roots_that_only_exact_numbers_tell_apart_ascend() {
    // The closest approach is at the midpoint of two f64, and the radius next to nothing.
    for (x, y, z, approach, radius) in [
        (870_401.0, 53_969.0, 223_028.0, 1.964_105_606_079_101_6, 1e-28),
        (816_139.0, 85_539.0, 459_903.0, 1.934_988_975_524_902_3, 1e-30),
        (816_139.0, 85_539.0, 459_903.0, 1.934_988_975_524_902_3, 1e-100),
    ] {
        let direction = DVec3::new(x, y, z);
        let origin = direction * (-f64::EPSILON / 2.0);
        let [center, origin, direction] =
            [direction * approach, origin, direction].map(|v| v.to_array());
        let mut numbers = [radius; 10];
        for (number, coordinate) in
            numbers.iter_mut().zip([center, origin, direction].into_iter().flatten())
        {
            *number = coordinate;
        }
        let exact = ExactChord::new(numbers).roots().expect("this goes through the center");
        let expected = [0, 1].map(|i: usize| rounded(Format::F64, &exact[i]));
        assert!(expected[0] <= expected[1]);
        assert_eq!(both(numbers, Format::F64), Some(expected), "{numbers:?}");
    }
}

#[test]
fn a_root_next_to_the_midpoint_of_two_f32_is_no_tie() {
    for (beside, near, far) in [
        (0.0, 16_777_214.0, 16_777_216.0),
        (1e-30, 16_777_215.0, 16_777_215.0),
        (1e-9, 16_777_215.0, 16_777_215.0),
    ] {
        let numbers = [beside, 0.0, 16_777_215.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5];
        assert_eq!(both(numbers, Format::F32), Some([near, far]));
    }
}

#[test]
fn ties_of_f64_go_to_even() {
    // A sphere of radius 2^-53 whose center is 1.5 along an axis, and the same a little beside the axis.
    let radius = U;
    for beside in [0.0, 1e-1, 1e-5, 1e-12].map(|part: f64| part * radius) {
        for center in [1.5, 1.5 + f64::EPSILON, 1.75] {
            let numbers = [center, beside, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius];
            let exact = ExactChord::new(numbers).roots().expect("this hits");
            let expected = [0, 1].map(|i: usize| rounded(Format::F64, &exact[i]));
            assert_eq!(both(numbers, Format::F64), Some(expected), "{numbers:?}");
            let expected = expected[0];
            assert!(
                beside == 0.0 || expected.to_bits() % 2 == 0 || center > 1.6 || expected == center
            );
            assert_eq!(nearest_ahead(numbers, Format::F64).map(|found| found.t), Some(expected));
        }
    }
}

#[test]
fn a_sphere_of_no_radius_is_hit_exactly_at_its_center() {
    for format in [Format::F32, Format::F64] {
        let numbers = [3.0, 6.0, -9.0, 0.0, 0.0, 0.0, 1.0, 2.0, -3.0, 0.0];
        assert_eq!(both(numbers, format), Some([3.0; 2]));
        let found = nearest_ahead(numbers, format).expect("through the center");
        assert_eq!((found.t, found.point), (3.0, DVec3::new(3.0, 6.0, -9.0)));
        assert_exact(format, numbers, Side::Near, &found);
        let back = -DVec3::new(1.0, 2.0, -3.0).normalize();
        assert!((found.normal - back).length() < 1e-7, "back along the ray");
        let mut beside = numbers;
        beside[0] += 1e-6;
        assert_eq!(both(single(beside), format), None);
    }
}

#[test]
fn what_is_no_ray_or_no_sphere_is_not_hit() {
    let good = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0];
    for format in [Format::F32, Format::F64] {
        let check = |numbers: [f64; 10]| {
            assert!(both(numbers, format).is_none(), "{numbers:?}");
            assert!(nearest_ahead(numbers, format).is_none(), "{numbers:?}");
        };
        assert!(both(good, format).is_some() && nearest_ahead(good, format).is_some());
        for index in 0..10 {
            for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut numbers = good;
                numbers[index] = odd;
                check(numbers);
            }
        }
        for (index, number) in [(9, -2.0), (6, 0.0)] {
            let mut numbers = good;
            numbers[index] = number;
            check(numbers);
            // The same from inside.
            numbers[0] = 0.5;
            check(numbers);
        }
    }
}

#[test]
fn what_is_rounded_up_to_the_smallest_normal_number_is_no_double_rounding() {
    // Midway between the largest subnormal number and the smallest normal one is 1 - 2^-24 of that, a number of a normal's
    // digits: here it is c - r, in units of the direction, and the origin is ahead by what `f64` does not see.
    let ulp = f32::EPSILON;
    let sphere = Sphere::new(Vec3::X * (2.0 - ulp), 1.0 - ulp / 2.0);
    let (largest_subnormal, smallest_normal) =
        (f32::from_bits(f32::MIN_POSITIVE.to_bits() - 1), f32::MIN_POSITIVE);
    let direction = Vec3::X * 2_f32.powi(126);
    for (ahead, near) in
        [(0.0, smallest_normal), (1e-20, largest_subnormal), (-1e-20, smallest_normal)]
    {
        let ray = Ray::new(Vec3::X * ahead, direction);
        let back = Ray::new(Vec3::X * ahead, -direction);
        assert_eq!(sphere.roots_algebraic(&ray).map(|[near, _]| near), Some(near));
        assert_eq!(sphere.roots_geometric(&ray).map(|[near, _]| near), Some(near));
        assert_eq!(sphere.roots_algebraic(&back).map(|[_, far]| far), Some(-near));
        let hit = sphere.intersect(&ray, 0.0..f32::INFINITY);
        assert_eq!(hit.map(|hit| hit.t), Some(near), "{ahead}");
    }
    // The same of `f64`, where pairs are scaled.
    let ulp = f64::EPSILON;
    let numbers = |ahead: f64| {
        let direction = 2_f64.powi(1022);
        [2.0 - ulp, 0.0, 0.0, ahead, 0.0, 0.0, direction, 0.0, 0.0, 1.0 - ulp / 2.0]
    };
    for ahead in [0.0, 1e-40, -1e-40] {
        for (side, index) in [(Side::Near, 0), (Side::Far, 1)] {
            let expected = exact_root(Format::F64, numbers(ahead), side);
            let found = both(numbers(ahead), Format::F64).expect("this hits")[index];
            assert_eq!(found, expected, "{ahead} {side:?}");
        }
    }
}
