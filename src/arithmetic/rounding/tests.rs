use super::*;
use crate::testing::{Dyadic, Random};

/// Halfway between two neighboring `f32`: of any exponent of theirs, also beyond the largest and below the smallest.
fn midpoint(random: &mut Random) -> f64 {
    let mantissa = f64::from(16_777_216 + random.integer(0..=16_777_215)) + 0.5;
    random.sign()
        * match random.below(8) {
            // A tie among subnormal numbers.
            0 => (f64::from(random.integer(0..=2000)) + 0.5) * 2_f64.powi(-149),
            1 => 2_f64.powi(128) - 2_f64.powi(103),
            2 => 2_f64.powi(-150),
            3 => (16_777_216.0 + 0.5) * 2_f64.powi(random.integer(-149..=103)),
            4 => (33_554_431.0 + 0.5) * 2_f64.powi(random.integer(-149..=103)),
            _ => mantissa * 2_f64.powi(random.integer(-149..=102)),
        }
}

/// A few units in the last place, or many, to either side.
fn steps(random: &mut Random) -> i64 {
    let width = 1_i64 << random.below(22);
    i64::from(random.integer(-1..=1)) * (width + i64::from(random.integer(0..=1)) - 1)
}

/// The number so many places after `x`.
fn step(x: f64, steps: i64) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add_signed(steps))
}

#[test]
fn what_rounds_safely_is_away_from_midpoints() {
    const MARGIN: u32 = 1000;
    let mut random = Random::new(1);
    let mut safe = 0;
    for _ in 0..20_000 {
        let t = step(midpoint(&mut random), steps(&mut random));
        if t.abs() < f64::from(f32::MIN_POSITIVE) {
            continue;
        }
        #[expect(clippy::cast_possible_truncation, reason = "rounding is what is tested")]
        let [low, high] = [-1, 1].map(|side| step(t, side * i64::from(MARGIN)) as f32);
        // Where an end is the midpoint itself, it may fall to either side.
        #[expect(clippy::cast_possible_truncation, reason = "rounding is what is tested")]
        let [lower, higher] = [-1, 1].map(|side| step(t, side * i64::from(MARGIN + 1)) as f32);
        if rounds_safely::<MARGIN>(t) {
            assert_eq!(low, high, "{t:e}");
            safe += 1;
        } else {
            assert_ne!(lower, higher, "{t:e}");
        }
    }
    assert!((5_000..15_000).contains(&safe), "{safe}");
}

#[test]
fn rounding_down_gives_the_largest_number_below() {
    let mut random = Random::new(4);
    for _ in 0..20_000 {
        let hi = match random.below(3) {
            0 => step(midpoint(&mut random), steps(&mut random)),
            1 => {
                f64::from(f32::from_bits(u32::try_from(random.bits() >> 33).unwrap()))
                    .min(f64::from(f32::MAX))
                    * random.sign()
            }
            _ => random.float(-300..=300),
        };
        let unit = (step(hi.abs(), 1) - hi.abs()).max(f64::from_bits(1));
        let lo = unit * 2_f64.powi(-random.integer(1..=60)) * f64::from(random.integer(-1..=1));
        if hi + lo != hi || hi.is_nan() {
            continue;
        }
        let exact = &Dyadic::exactly(hi) + &Dyadic::exactly(lo);

        let down = f64::round_down(hi, lo);
        assert!(Dyadic::exactly(down) <= exact, "{hi:e} + {lo:e}");
        let next = if lo < 0.0 { hi } else { step(hi, if hi < 0.0 { -1 } else { 1 }) };
        assert!(hi == 0.0 || Dyadic::exactly(next) > exact, "{hi:e} + {lo:e}");
        assert!(down == hi || lo < 0.0, "{hi:e} + {lo:e}");

        let down = f32::round_down(hi, lo);
        if down == f32::NEG_INFINITY {
            assert!(exact < Dyadic::exactly(f64::from(f32::MIN)), "{hi:e} + {lo:e}");
        } else {
            assert!(Dyadic::exactly(down.into()) <= exact, "{hi:e} + {lo:e}");
            let next: f32 = if down == 0.0 {
                f32::from_bits(1)
            } else if down > 0.0 {
                f32::from_bits(down.to_bits() + 1)
            } else {
                f32::from_bits(down.to_bits() - 1)
            };
            assert!(
                next.is_infinite() || Dyadic::exactly(next.into()) > exact,
                "{hi:e} + {lo:e} gives {down:e}"
            );
        }
    }
    assert_eq!(f64::round_down(0.0, 0.0), 0.0);
    assert_eq!(f64::round_down(1.0, -1e-300), 1.0 - f64::EPSILON / 2.0);
    assert_eq!(f64::round_down(-1.0, -1e-300), -1.0 - f64::EPSILON);
    assert_eq!(f32::round_down(-1e-300, 0.0), -f32::from_bits(1));
    assert_eq!(f32::round_down(1e300, 0.0), f32::MAX);
    assert_eq!(f32::round_down(-1e300, 0.0), f32::NEG_INFINITY);
    assert_eq!(f32::round_down(f64::INFINITY, f64::NAN), f32::INFINITY);
    assert_eq!(f64::round_down(f64::INFINITY, f64::NAN), f64::INFINITY);
}
