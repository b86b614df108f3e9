//! The two floating-point formats: which numbers they have, and how far apart these are.

use std::cmp::Ordering;

use eyeray::Scalar;

use super::dyadic::Dyadic;

/// A floating-point format.
///
/// Its values are numbered in order: the `ordinal` of zero is 0, that of the smallest positive value 1, and so on up to
/// infinity, which stands for the power of two after the largest finite value. Negative values have negative ordinals.
pub trait Float: Scalar {
    /// The bits of a mantissa.
    const DIGITS: u32;
    /// The exponent of the smallest positive value.
    const LEAST_EXPONENT: i64;
    /// The ordinal of infinity.
    const INFINITE: i64;

    /// The position of the value in this order. Not for NaN.
    fn ordinal(self) -> i64;
    /// The value of that ordinal.
    fn from_ordinal(ordinal: i64) -> Self;
    /// The text of an expression with exactly this value.
    fn source(self) -> String;
    /// Whether the bits are the same, or both are zeros.
    fn identical(self, other: Self) -> bool;
    /// Whether it is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// 2^`exponent`, for exponents of normal values.
    fn power_of_two(exponent: i64) -> Self;

    /// The exponent of the last bit of the largest finite value.
    const GREATEST_EXPONENT: i64 =
        (Self::INFINITE >> (Self::DIGITS - 1)) - 2 + Self::LEAST_EXPONENT;

    /// The number that an ordinal stands for.
    fn number(ordinal: i64) -> Dyadic {
        let leading = 1 << (Self::DIGITS - 1);
        let (biased, fraction) = (ordinal.abs() / leading, ordinal.abs() % leading);
        let (integer, exponent) =
            if biased == 0 { (fraction, 0) } else { (fraction + leading, biased - 1) };
        Dyadic::new(integer * ordinal.signum(), exponent + Self::LEAST_EXPONENT)
    }

    /// The ordinal of a number cut off after the format's last bit, at most that of infinity.
    fn ordinal_towards_zero(number: &Dyadic) -> i64 {
        if number.is_zero() || number.magnitude() < Self::LEAST_EXPONENT {
            return 0;
        }
        let (integer, exponent) = number.leading(Self::DIGITS);
        let integer = i64::try_from(integer).expect("a mantissa has at most 53 bits");
        let above_least = exponent - Self::LEAST_EXPONENT;
        let magnitude = if above_least > Self::GREATEST_EXPONENT - Self::LEAST_EXPONENT {
            Self::INFINITE
        } else if above_least < 0 {
            integer >> -above_least
        } else {
            (above_least << (Self::DIGITS - 1)) + integer
        };
        if number.is_negative() { -magnitude } else { magnitude }
    }

    /// The value nearest to a number, of two equally near ones the even one. From the largest finite value and half an ulp on it
    /// is infinite; a zero has the sign of the number.
    fn nearest(number: &Dyadic) -> Self {
        Self::nearest_by(number, |other| number.cmp(other))
    }

    /// The same of a number that is known by how it compares with others, and `near` is close to it.
    fn nearest_by(near: &Dyadic, compare: impl Fn(&Dyadic) -> Ordering) -> Self {
        // What is near says where to look. Comparisons with the numbers midway to the neighbors decide; a number midway belongs
        // to the even one.
        let mut ordinal = Self::ordinal_towards_zero(near);
        let belongs_above = |ordinal: i64| {
            let twice_midway = &Self::number(ordinal) + &Self::number(ordinal + 1);
            match compare(&twice_midway.scaled(-1)) {
                Ordering::Less => false,
                Ordering::Equal => ordinal % 2 != 0,
                Ordering::Greater => true,
            }
        };
        while ordinal < Self::INFINITE && belongs_above(ordinal) {
            ordinal += 1;
        }
        while ordinal > -Self::INFINITE && !belongs_above(ordinal - 1) {
            ordinal -= 1;
        }
        let value = Self::from_ordinal(ordinal);
        let is_negative_zero = ordinal == 0 && compare(&Dyadic::ZERO).is_lt();
        if is_negative_zero { Self::from_f64(-0.0) } else { value }
    }

    /// The exponent of an ulp of a number: of the last bit that the format keeps of it.
    fn ulp(number: &Dyadic) -> i64 {
        if number.is_zero() {
            return Self::LEAST_EXPONENT;
        }
        (number.magnitude() + 1 - i64::from(Self::DIGITS))
            .clamp(Self::LEAST_EXPONENT, Self::GREATEST_EXPONENT)
    }

    /// How far a computed value is from the exact one, in units of 2^`ulp`. An infinity stands for every number that is
    /// too large for the format; NaN is infinitely far from all.
    fn error(self, exact: &Dyadic, ulp: i64) -> f64 {
        if self.partial_cmp(&self).is_none() {
            return f64::INFINITY;
        }
        let number = Self::number(self.ordinal());
        let beyond = !self.is_finite()
            && exact.sign() == number.sign()
            && exact.clone().abs() >= number.clone().abs();
        if beyond { 0.0 } else { (&number - exact).abs().scaled(-ulp).approximately() }
    }
}

macro_rules! float {
    ($float:ident) => {
        impl Float for $float {
            const DIGITS: u32 = $float::MANTISSA_DIGITS;
            const LEAST_EXPONENT: i64 = $float::MIN_EXP as i64 - $float::MANTISSA_DIGITS as i64;
            #[allow(
                clippy::cast_possible_wrap,
                clippy::cast_lossless,
                reason = "the sign bit is 0"
            )]
            const INFINITE: i64 = $float::INFINITY.to_bits() as i64;

            #[allow(
                clippy::cast_possible_wrap,
                clippy::cast_lossless,
                reason = "the sign bit is 0"
            )]
            fn ordinal(self) -> i64 {
                let magnitude = self.abs().to_bits() as i64;
                if self < 0.0 { -magnitude } else { magnitude }
            }

            #[allow(
                clippy::cast_possible_truncation,
                reason = "ordinals are no larger than the one of infinity"
            )]
            fn from_ordinal(ordinal: i64) -> Self {
                let magnitude = $float::from_bits(ordinal.unsigned_abs() as _);
                if ordinal < 0 { -magnitude } else { magnitude }
            }

            fn source(self) -> String {
                format!(concat!(stringify!($float), "::from_bits({:#x})"), self.to_bits())
            }

            fn identical(self, other: Self) -> bool {
                self.to_bits() == other.to_bits()
            }

            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }

            fn power_of_two(exponent: i64) -> Self {
                let biased = i64::from($float::MAX_EXP) - 1 + exponent;
                Self::from_ordinal(biased << ($float::MANTISSA_DIGITS - 1))
            }
        }
    };
}

float!(f32);
float!(f64);
