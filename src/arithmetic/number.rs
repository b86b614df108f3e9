//! What a derivation may do with a number, so that it is written once and carried out in `f64` or in pairs.

use core::ops::{Add, Div, Mul, Sub};

use glam::DVec3;

/// A number that a derivation can be carried out in.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// 1.
    const ONE: Self;

    /// Rounded to an `f64`.
    fn to_f64(self) -> f64;
}

impl Number for f64 {
    const ONE: Self = 1.0;

    fn to_f64(self) -> f64 {
        self
    }
}

/// A vector of such numbers.
#[derive(Clone, Copy, Debug)]
pub struct Triple<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl<N: Number> Triple<N> {
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub fn map<M>(self, f: impl Fn(N) -> M) -> Triple<M> {
        Triple { x: f(self.x), y: f(self.y), z: f(self.z) }
    }

    #[inline(always)]
    pub fn zip<M, O: Copy>(self, other: Triple<O>, f: impl Fn(N, O) -> M) -> Triple<M> {
        Triple { x: f(self.x, other.x), y: f(self.y, other.y), z: f(self.z, other.z) }
    }
}

impl From<DVec3> for Triple<f64> {
    #[inline(always)]
    fn from(vector: DVec3) -> Self {
        Self { x: vector.x, y: vector.y, z: vector.z }
    }
}

impl From<Triple<f64>> for DVec3 {
    #[inline(always)]
    fn from(triple: Triple<f64>) -> Self {
        Self::new(triple.x, triple.y, triple.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::pair::Pair;

    /// That the operations are those of vectors, and that `one` is 1.
    fn check<N: Number>(number: impl Fn(f64) -> N) {
        let triple = |x, y, z| Triple { x, y, z }.map(&number);
        let (a, b) = (triple(2.0, -3.0, 5.0), triple(7.0, 11.0, -13.0));
        assert_eq!(a.dot(b).to_f64(), -84.0);
        assert_eq!(DVec3::from(a.cross(b).map(N::to_f64)), DVec3::new(-16.0, 61.0, 43.0));
        let difference = a.zip(b, |a, b| a - b * N::ONE / N::ONE);
        assert_eq!(DVec3::from(difference.map(N::to_f64)), DVec3::new(-5.0, -14.0, 18.0));
    }

    #[test]
    fn triples_are_vectors_of_any_number() {
        check(|x| x);
        check(Pair::from);
        let vector = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(DVec3::from(Triple::from(vector)), vector);
    }

    #[test]
    fn a_pair_rounds_to_its_high_part() {
        assert_eq!(Pair { hi: 1.0, lo: f64::EPSILON / 2.0 }.to_f64(), 1.0);
    }
}
