use super::*;
use crate::root::tests::{assert_exact, line, lines_of_every_kind};
use crate::testing::{Dyadic, ExactChord, Float, Random, exactly, part_of_bound};

#[test]
fn chords_in_integers_are_exact_to_96_bits() {
    let mut random = Random::new(1);
    let (mut narrow, count) = (0, 4000);
    for _ in 0..count {
        let numbers = lines_of_every_kind(&mut random);
        let exact = ExactChord::new(numbers);
        let Some(found) = Narrow::new(&line(numbers)) else { continue };
        narrow += 1;
        for (found, expected) in [
            (found.a(), &exact.a),
            (found.h(), &exact.h),
            (found.power(), &exact.power),
            (found.discriminant(), &exact.discriminant),
        ] {
            assert_eq!((found.hi == 0.0), expected.is_zero(), "{numbers:?}");
            assert_eq!((found.hi < 0.0), expected.is_negative(), "{numbers:?}");
            let bound = expected.clone().abs().scaled(-96);
            assert!(part_of_bound(&exactly(found), expected, &bound) <= 1.0, "{numbers:?}");
        }
    }
    assert!((count / 4..count).contains(&narrow), "{narrow} of {count} are narrow");
}

#[test]
fn what_spans_61_places_is_narrow() {
    let numbers = |center: f64, origin: f64, radius: f64, x: f64, y: f64| {
        [center, 0.0, 0.0, origin, 0.0, 0.0, x, y, 0.0, radius]
    };
    let is_narrow = |numbers| Narrow::new(&line(numbers)).is_some();
    let two = |places: i32| 2_f64.powi(places);
    // 2^60 has 61 places, of which 2^0 is the last.
    assert!(is_narrow(numbers(two(60), 1.0, 1.0, 1.0, 0.0)));
    assert!(!is_narrow(numbers(two(61), 1.0, 1.0, 1.0, 0.0)));
    assert!(is_narrow(numbers(1.0, 1.0, 1.0, two(60), 1.0)));
    assert!(!is_narrow(numbers(1.0, 1.0, 1.0, two(61), 1.0)));
    assert!(is_narrow(numbers(0.0, two(0), two(60), two(-500), two(-440))));
    assert!(!is_narrow(numbers(0.0, two(-1), two(60), 1.0, 0.0)));
    assert!(is_narrow(numbers(0.0, 0.0, 0.0, f64::from_bits(1), 0.0)));
    // Zeros have no place.
    let all_zero = Narrow::new(&line([0.0; 10])).expect("zeros are narrow");
    assert!(all_zero.a().hi == 0.0 && all_zero.power().hi == 0.0);
    // The largest of 61 bits keep their values, and the widest differences.
    let most = two(60) * (2.0 - 2.0 * f64::EPSILON);
    let numbers = [most, -most, most, -most, most, -most, most, -most, 256.0, most];
    let exact = ExactChord::new(numbers);
    let narrow = Narrow::new(&line(numbers)).expect("61 places");
    for (found, expected) in [
        (narrow.a(), &exact.a),
        (narrow.h(), &exact.h),
        (narrow.power(), &exact.power),
        (narrow.discriminant(), &exact.discriminant),
    ] {
        let bound = expected.clone().abs().scaled(-96);
        assert!(part_of_bound(&exactly(found), expected, &bound) <= 1.0);
    }
}

#[test]
fn roots_in_integers_are_the_nearest() {
    let mut random = Random::new(4);
    let (mut roots, mut hits) = (0, 0);
    for _ in 0..1600 {
        let numbers = lines_of_every_kind(&mut random);
        let exact = ExactChord::new(numbers);
        let line = line(numbers);
        let mut found = match chord(&line, Format::F64) {
            Verdict::Hit(found) => found,
            Verdict::Miss => {
                assert!(exact.discriminant.is_negative(), "{numbers:?}");
                continue;
            }
            Verdict::Doubt => continue,
        };
        let exact_roots = exact.roots().expect("this hits");
        for (side, expected) in [Side::Near, Side::Far].into_iter().zip(&exact_roots) {
            let estimate = exactly(found.estimate(side));
            if exact.discriminant.is_zero() || !expected.is_zero() {
                let bound = &Dyadic::exactly(ROOT_ERROR) * &expected.clone().abs();
                let part = part_of_bound(&estimate, expected, &bound);
                assert!(part <= 1.0, "{part} {numbers:?}");
            }
            let Some((t, root)) = found.root(side) else { continue };
            roots += 1;
            assert_eq!(t, f64::nearest(expected), "{side:?} {numbers:?}");
            if numbers[9] == 0.0 {
                continue;
            }
            if let Some(hit) = found.hit(side, t, root) {
                assert_exact(Format::F64, numbers, side, &hit);
                hits += 1;
            }
        }
    }
    assert!(roots > 1000 && hits > 800, "{roots} roots, {hits} hits");
}

#[test]
fn roots_in_integers_are_the_nearest_f32_too() {
    let mut count = 0;
    let mut check = |numbers: [f64; 10]| {
        let Some(roots) = ExactChord::new(numbers).roots() else { return };
        let line = line(numbers);
        let mut found = match chord(&line, Format::F32) {
            Verdict::Hit(found) => found,
            Verdict::Miss => panic!("this hits: {numbers:?}"),
            Verdict::Doubt => return,
        };
        for (side, expected) in [Side::Near, Side::Far].into_iter().zip(&roots) {
            let Some((root, _)) = found.root(side) else { continue };
            let nearest = f32::nearest(expected);
            assert_eq!(root, f64::from(nearest), "{side:?} {numbers:?}");
            count += 1;
        }
    };
    // Midpoints of two f32, and what no f64 tells from them.
    for beside in [0.0, 1e-10, 1e-30] {
        for radius in [0.5, 1.5, 2.5] {
            for center in [16_777_215.0, 16_777_218.0, 33_554_431.0] {
                check([beside, 0.0, center, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, radius]);
            }
        }
    }
    let mut random = Random::new(5);
    for _ in 0..1000 {
        check(lines_of_every_kind(&mut random));
    }
    assert!(count > 500, "{count} roots");
}
