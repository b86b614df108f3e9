use super::*;
use crate::root::tests::line;
use crate::testing::{Dyadic, ExactChord, Lie, exactly, part_of_bound, search_settings};

fn part_of_power(exact: &ExactChord, numbers: [f64; 10]) -> f64 {
    let line = line(numbers);
    let (computed, error) = accurate_power(line.o(), line.radius);
    assert_eq!(computed.hi + computed.lo, computed.hi, "normalized: {numbers:?}");
    // No larger than it has to be: close to the surface, hardly more than the last place of the power.
    let larger = exact.larger().approximately();
    let is_close = computed.hi.abs() < larger / 2_f64.powi(31);
    let most = if is_close {
        1500.0 * U * V * larger + 2.1 * V * computed.hi.abs()
    } else {
        41.0 * V * larger
    };
    assert!(error <= most, "{error:e} for {:e}: {numbers:?}", computed.hi);
    if error == 0.0 {
        assert_eq!(exactly(computed), exact.power, "{numbers:?}");
        return 0.0;
    }
    // Farther away, the finer sum is not worth its time.
    let is_far = computed.hi.abs() > larger / 2_f64.powi(29);
    assert!(!is_far || error >= 39.0 * V * larger, "{error:e} for {:e}", computed.hi);
    part_of_bound(&exactly(computed), &exact.power, &Dyadic::exactly(error))
}

#[test]
fn powers_in_pairs_keep_their_bound() {
    // Where the power is more than 2^-30 of the square.
    let lies = [0.9, 0.1, 1e-6, 1e-9, -0.9, -0.1, -1e-6, -1e-9]
        .map(|power| Lie { power, discriminant: 0.05 });
    let part = |exact: &ExactChord, numbers| Some(part_of_power(exact, numbers));
    assert!(search_settings("power in pairs", 80, 250, &lies, part) > 0.1);
}

#[test]
fn powers_in_three_floats_keep_their_bound() {
    let lies = [1e-10, 1e-14, 1e-16, 0.0, -1e-10, -1e-14, -1e-16]
        .map(|power| Lie { power, discriminant: 0.5 });
    let part = |exact: &ExactChord, numbers| Some(part_of_power(exact, numbers));
    assert!(search_settings("power in three floats", 80, 250, &lies, part) > 0.1);
}

#[test]
fn powers_that_vanish_vanish() {
    for numbers in [
        [3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 5.0],
        [1.0, 2.0, 2.0, 1e-30, 0.0, 0.0, 1.0, 0.0, 0.0, 3.0],
        [1.0, 2.0, 2.0, 1e-17, -1e-18, 1e-20, 1.0, 0.0, 0.0, 3.0],
        [0.1, 0.2, 0.3, 0.1, 0.2, 0.3 - 1e-5, 1.0, 0.0, 0.0, 0.3 - (0.3 - 1e-5)],
    ] {
        let exact = ExactChord::new(numbers);
        assert!(part_of_power(&exact, numbers) <= 1.0, "{numbers:?}");
    }
    // And they are known to.
    for (x, y, radius) in [(3.0, 4.0, 5.0), (51_539_607_555.0, 68_719_476_740.0, 85_899_345_925.0)]
    {
        let exact =
            accurate_power(line([x, y, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, radius]).o(), radius);
        assert_eq!(exact, (Pair { hi: 0.0, lo: 0.0 }, 0.0));
    }
    // What underflows is not.
    for tiny in [1e-150, 1e-200] {
        let (power, error) =
            accurate_power(line([3.0, 4.0, tiny, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 5.0]).o(), 5.0);
        assert!(power.hi >= 0.0 && error > 0.0, "{tiny}");
    }
}
