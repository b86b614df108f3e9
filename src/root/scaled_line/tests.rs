use super::*;
use crate::root::tests::line;
use crate::testing::{Lie, Random, setting};

/// The line with lengths times 2^`length` and the direction times 2^`direction`.
fn times(line: &Line, length: i32, direction: i32) -> Line {
    let lengths = |vector: DVec3| vector.map(|x| scale(x, length));
    Line {
        origin: lengths(line.origin),
        direction: line.direction.map(|x| scale(x, direction)),
        center: lengths(line.center),
        radius: scale(line.radius, length),
    }
}

/// A step that knows these crossings.
struct Known([f64; 2], Found);

impl Crossings for Known {
    type Root = ();

    fn root(&mut self, side: Side) -> Option<(f64, ())> {
        Some((self.0[usize::from(side == Side::Far)], ()))
    }

    fn hit(&mut self, _: Side, t: f64, (): ()) -> Option<Found> {
        Some(Found { t, ..self.1 })
    }
}

#[test]
fn lines_of_any_size_are_brought_near_1_and_back() {
    let mut random = Random::new(2);
    for _ in 0..2000 {
        let here = line(setting(&mut random, Lie { power: 0.1, discriminant: 1e-3 }));
        let (lengths, directions) = (random.integer(-900..=900), random.integer(-900..=900));
        let there = times(&here, lengths, directions);
        let scaled = Scaled::new(&there).expect("no digit is lost");
        let is_scaled = (scaled.length_exponent, scaled.direction_exponent) != (0, 0);
        assert_eq!((scaled.line == there, scaled.is_exact), (!is_scaled, true));
        assert_eq!(times(&scaled.line, scaled.length_exponent, scaled.direction_exponent), there);
        let longest = (scaled.line.center - scaled.line.origin).abs().max_element();
        let sizes = [longest.max(scaled.line.radius), scaled.line.direction.abs().max_element()];
        let [length, direction] = sizes.map(exponent);
        if is_scaled {
            assert_eq!((length, direction), (0, 0), "{there:?}");
        } else {
            assert!(length.abs() < 150 && direction.abs() < 150, "{there:?}");
        }

        // Roots and points of this size, in its units and in the caller's.
        let point = DVec3::new(1.5, -0.75, 0.0);
        let found = Found { t: 0.0, point, normal: DVec3::X };
        let mut crossings = scaled.unscaled(Known([-1.25, 1.75], found));
        let e = scaled.length_exponent - scaled.direction_exponent;
        for (side, t) in [(Side::Near, -1.25), (Side::Far, 1.75)] {
            let expected = (e == 0 || scale(t, e).abs() > f64::MIN_POSITIVE).then(|| scale(t, e));
            assert_eq!(crossings.root(side).map(|(t, ())| t), expected, "{t} 2^{e}");
        }
        let hit = crossings.hit(Side::Near, 7.0, ()).expect("all coordinates are normal");
        let expected = point.map(|x| scale(x, scaled.length_exponent));
        assert_eq!((hit.t, hit.point, hit.normal), (7.0, expected, DVec3::X));
    }
}

#[test]
fn what_loses_digits_is_left_to_the_last_step() {
    let scaled = |numbers| Scaled::new(&line(numbers));
    let line = |size: f64| [5.0 * size, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, size];
    assert!(scaled(line(1.0)).is_some() && scaled(line(1e-300)).is_some());
    // Coordinates that are replaced, with a difference that is not zero, and one that overflows.
    let tiny = 1e-316;
    let replaced =
        scaled([1e131, 0.0, tiny, 0.0, 0.0, tiny, 1.0, 0.0, 0.0, 1e115]).expect("finite");
    assert!(!replaced.is_exact && replaced.line.o().z.hi > 0.0);
    let rounded = scaled([1e300, -1e-200, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]).expect("finite");
    assert!(!rounded.is_exact && rounded.line.center.y < 0.0);
    let found = Found { t: 1.0, point: DVec3::ONE, normal: DVec3::X };
    let mut crossings = rounded.unscaled(Known([1.0, 2.0], found));
    assert!(crossings.root(Side::Near).is_some());
    assert!(crossings.hit(Side::Near, 1.0, ()).is_none());
    assert!(scaled([1e-300, 1e300, 0.0, 0.0, 1e300, 0.0, 1.0, 0.0, 0.0, 1e-300]).is_none());
    // A difference that overflows, all lengths zero, and what no ray can meet.
    assert!(scaled([1e308, 0.0, 0.0, -1e308, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]).is_none());
    assert!(scaled([1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).is_none());
    for (index, number) in [(0, f64::NAN), (6, 0.0), (7, f64::INFINITY), (9, -1.0)] {
        let mut numbers = line(1.0);
        numbers[index] = number;
        assert!(scaled(numbers).is_none(), "{numbers:?}");
    }
    // Below the normal numbers, and of the least of them, a number may have been rounded twice.
    assert_eq!(unscaled(1.5, -1022), Some(1.5 * f64::MIN_POSITIVE));
    assert_eq!(unscaled(-1.0, -1022), None);
    assert_eq!(unscaled(1.5, -1023), None);
    assert_eq!(unscaled(-1.0, 1024), Some(f64::NEG_INFINITY));
    assert_eq!(unscaled(0.0, -1074), Some(0.0));
    assert_eq!(unscaled(f64::from_bits(1), 0), Some(f64::from_bits(1)));
}
