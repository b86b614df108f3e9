//! Exact numbers: an integer of any size times a power of two. Every float is one, and so is every sum, difference and
//! product of floats.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::{BigInt, Sign};

/// `integer` times 2^`exponent`.
#[derive(Clone, Debug)]
pub struct Dyadic {
    integer: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// 0.
    pub const ZERO: Self = Self { integer: BigInt::ZERO, exponent: 0 };

    /// `integer` times 2^`exponent`.
    pub fn new(integer: impl Into<BigInt>, exponent: i64) -> Self {
        Self { integer: integer.into(), exponent }
    }

    /// The value of a finite float.
    pub fn exactly(float: f64) -> Self {
        assert!(float.is_finite(), "{float} is no number");
        let biased = float.to_bits() >> 52 & 0x7ff;
        let fraction = float.to_bits() & ((1 << 52) - 1);
        let (magnitude, exponent) =
            if biased == 0 { (fraction, 1) } else { (fraction | 1 << 52, biased) };
        // A short integer keeps what is computed from it short.
        let zeros = if magnitude == 0 { 0 } else { magnitude.trailing_zeros() };
        let integer = BigInt::from(magnitude >> zeros);
        let exponent = signed(exponent) - 1075 + i64::from(zeros);
        Self { integer: if float < 0.0 { -integer } else { integer }, exponent }
    }

    /// The nearest f64 but for an error of two ulps.
    pub fn approximately(&self) -> f64 {
        if self.is_zero() {
            return 0.0;
        }
        let (integer, exponent) = self.leading(53);
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
        let mut value = integer as f64;
        let mut exponent = exponent.clamp(-3000, 3000);
        while exponent != 0 {
            let step = exponent.clamp(-1000, 1000);
            value *= f64::from_bits(1023_u64.wrapping_add_signed(step) << 52);
            exponent -= step;
        }
        if self.is_negative() { -value } else { value }
    }

    /// The first `digits` bits of the magnitude, at most 64, as an integer and the exponent of its power of two.
    pub fn leading(&self, digits: u32) -> (u64, i64) {
        let shift = signed(self.integer.bits()) - i64::from(digits);
        let magnitude = self.integer.magnitude();
        let integer = if shift > 0 { magnitude >> shift } else { magnitude << -shift };
        (integer.try_into().expect("at most 64 bits were kept"), self.exponent + shift)
    }

    /// The exponent of the largest power of two that is no larger in magnitude. Not for 0.
    pub fn magnitude(&self) -> i64 {
        assert!(!self.is_zero(), "0 has no magnitude");
        signed(self.integer.bits()) - 1 + self.exponent
    }

    pub fn is_zero(&self) -> bool {
        self.integer.sign() == Sign::NoSign
    }

    pub fn is_negative(&self) -> bool {
        self.integer.sign() == Sign::Minus
    }

    /// How it compares with 0.
    pub fn sign(&self) -> Ordering {
        match self.integer.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    pub fn abs(self) -> Self {
        if self.is_negative() { -&self } else { self }
    }

    /// 2^`exponent` times the number.
    pub fn scaled(mut self, exponent: i64) -> Self {
        self.exponent += exponent;
        self
    }

    /// The square root cut off after at least `bits` bits, of a number that is not negative.
    pub fn square_root(&self, bits: i64) -> Self {
        let missing = 2 * bits - signed(self.integer.bits());
        let mut shift = missing.max(0);
        shift += (self.exponent - shift) & 1;
        Self { integer: (&self.integer << shift).sqrt(), exponent: (self.exponent - shift) / 2 }
    }

    /// The quotient cut off after at least `bits` bits. `divisor` is not 0.
    pub fn divided_by(&self, divisor: &Self, bits: i64) -> Self {
        let missing = bits + 1 + signed(divisor.integer.bits()) - signed(self.integer.bits());
        let shift = missing.max(0);
        Self {
            integer: (&self.integer << shift) / &divisor.integer,
            exponent: self.exponent - shift - divisor.exponent,
        }
    }

    /// The integers of two numbers in the unit of the finer one, and its exponent.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        (
            &self.integer << (self.exponent - exponent),
            &other.integer << (other.exponent - exponent),
            exponent,
        )
    }
}

/// A count of bits or an exponent, as a number that can be subtracted from.
fn signed(count: u64) -> i64 {
    count.try_into().expect("no integer here is that long")
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic { integer: -&self.integer, exponent: self.exponent }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        // A zero of a small exponent must not make its neighbor's integer long.
        if self.is_zero() {
            other.clone()
        } else if other.is_zero() {
            self.clone()
        } else {
            let (a, b, exponent) = self.aligned(other);
            Dyadic { integer: a + b, exponent }
        }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        self + &-other
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        Dyadic { integer: &self.integer * &other.integer, exponent: self.exponent + other.exponent }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b, _) = self.aligned(other);
        a.cmp(&b)
    }
}
