use glam::DVec3;

use super::format::PointTolerance;
use super::*;
use crate::arithmetic::pair::U;
use crate::arithmetic::scaling::scale;
use crate::testing::{
    Dyadic, ExactChord, Lie, Neighbors, Random, nearest, part_of_bound, setting, total,
};

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

/// Its coordinates rounded to `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what this does")]
pub(super) fn single(numbers: [f64; 10]) -> [f64; 10] {
    numbers.map(|number| (number as f32).into())
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

/// Both roots by the careful steps, `None` for a miss.
fn both(numbers: [f64; 10], format: Format) -> Option<[f64; 2]> {
    carefully(&line(numbers), format, &Question::Both)?.both()
}

fn nearest_ahead(numbers: [f64; 10], format: Format) -> Option<Found> {
    carefully(&line(numbers), format, &Question::Nearest(0.0..f64::INFINITY))?.nearest()
}

fn rounded(format: Format, exact: &Dyadic) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "a guess")]
    match format {
        Format::F32 => nearest(exact, exact.approximately() as f32).into(),
        Format::F64 => nearest(exact, exact.approximately()),
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
        if let (Some(found), Some(roots), Some(side)) = (found, expected, ahead) {
            let tolerance = format.point_tolerance();
            let parts = parts_of_tolerance(numbers, &roots[side], &found, tolerance);
            assert!(parts.iter().all(|part| *part <= 1.0), "{parts:?} {format:?} {numbers:?}");
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
        assert!(carefully(&line, format, &question).unwrap().both().is_none());
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
            assert!(beside == 0.0 || expected.is_even() || center > 1.6 || expected == center);
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
        let back = -DVec3::new(1.0, 2.0, -3.0).normalize();
        assert!((found.normal - back).length() < 1e-15, "back along the ray");
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
