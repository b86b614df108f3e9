use super::*;
use crate::arithmetic::pair::U;
use crate::testing::{Dyadic, Random};

#[test]
fn splitters_are_above_the_root_of_the_square() {
    let mut random = Random::new(1);
    for _ in 0..5000 {
        let square = random.float(-480..=480).abs();
        let power = splitter(square) / (1.5 * 2_f64.powi(26));
        assert_eq!(power.to_bits() & ((1 << 52) - 1), 0, "no power of two: {square:e}");
        let [least, exact] = [Dyadic::exactly(power), Dyadic::exactly(square)];
        assert!(&least * &least >= exact, "{square:e}");
        assert!((&least * &least).scaled(-4) < exact, "{square:e}");
    }
}

#[test]
fn dot_products_of_high_parts_are_exact() {
    let mut random = Random::new(2);
    for round in 0..5000 {
        let vector = match round % 4 {
            // The longest of 26 bits, in any direction or along an axis.
            0 => DVec3::splat((1.0 - U) / 3_f64.sqrt()) * random.mantissa(),
            1 => DVec3::X * (2.0 - 2.0 * U),
            _ => DVec3::from([0; 3].map(|_| random.float(-30..=0))),
        };
        let splitter = splitter(vector.length_squared());
        let Halves { high, low } = Halves::new(vector, splitter);
        let unit = splitter / 1.5 / 2_f64.powi(52);
        for axis in 0..3 {
            assert_eq!(
                &Dyadic::exactly(high[axis]) + &Dyadic::exactly(low[axis]),
                Dyadic::exactly(vector[axis])
            );
            assert!(low[axis].abs() <= unit / 2.0 * (1.0 + U), "{vector}");
            let places = high[axis] / unit;
            assert_eq!(places, places.round(), "a multiple of the unit");
            assert!(places.abs() <= 2_f64.powi(26), "26 bits");
        }
        let [x, y, z] = high.to_array().map(|x| x * x);
        let exact = length_squared(high);
        for sum in [(x + y) + z, (x + z) + y, (y + z) + x] {
            assert_eq!(Dyadic::exactly(sum), exact, "{vector}");
        }
        assert_eq!(Dyadic::exactly(high.dot(high)), exact, "{vector}");
    }
}

fn length_squared(vector: DVec3) -> Dyadic {
    let square = |x: f64| &Dyadic::exactly(x) * &Dyadic::exactly(x);
    &(&square(vector.x) + &square(vector.y)) + &square(vector.z)
}
