//! A line and a sphere: as the caller gave them, and as the plain steps see them.

use glam::DVec3;

use super::chord::{Chord, Derivation};
use crate::arithmetic::number::Triple;
use crate::arithmetic::pair::{Pair, two_difference};
use crate::{Ray, Sphere, Vector};

/// A line and a sphere as the caller gave them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
}

impl Line {
    #[inline(always)]
    pub(crate) fn new<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>) -> Self {
        Self {
            origin: ray.origin.to_f64(),
            direction: ray.direction.to_f64(),
            center: sphere.center.to_f64(),
            radius: sphere.radius.into(),
        }
    }

    /// c - p, exactly, unless it overflows on the way.
    #[inline(always)]
    pub(crate) fn o(&self) -> Triple<Pair> {
        Triple::from(self.center).zip(Triple::from(self.origin), two_difference)
    }

    /// Whether a ray can meet the sphere at all: no NaN, no infinity, no zero direction, no negative radius.
    pub(crate) fn is_valid(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.center.is_finite()
            && self.radius.is_finite()
            && self.direction != DVec3::ZERO
            && self.radius >= 0.0
    }
}

/// Whether a square, a or the larger of o·o and r², is between 2⁻⁴⁸⁰ and 2⁴⁸⁰: then no product of two of them overflows, and
/// what underflows on the way is far below the error bounds.
#[inline(always)]
pub(crate) fn is_safe(square: f64) -> bool {
    const LEAST: u64 = (1023 - 480) << 52;
    const SPAN: u64 = 960 << 52;
    // Above the span are all negative numbers, infinities and NaN.
    square.to_bits().wrapping_sub(LEAST) < SPAN
}

/// A line and a sphere as the plain steps see them.
pub(crate) struct Setting {
    pub(crate) line: Line,
    /// From the ray's origin to the center, rounded.
    pub(crate) o: DVec3,
    /// Negative where the radius is.
    pub(crate) radius_squared: f64,
}

impl Setting {
    #[inline(always)]
    pub(crate) fn new<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>) -> Self {
        Self::of(Line::new(sphere, ray))
    }

    #[inline(always)]
    pub(crate) fn of(line: Line) -> Self {
        let o = line.center - line.origin;
        Self { line, o, radius_squared: line.radius * line.radius.abs() }
    }

    /// The chord in plain `f64`.
    #[inline(always)]
    pub(crate) fn chord<D: Derivation>(&self) -> Chord<f64> {
        D::chord(Triple::from(self.o), Triple::from(self.line.direction), self.radius_squared)
    }

    /// The chord, unless its terms might overflow or underflow.
    #[inline(always)]
    pub(crate) fn safe_chord<D: Derivation>(&self) -> Option<Chord<f64>> {
        let chord = self.chord::<D>();
        (is_safe(chord.a) && is_safe(self.larger(&chord))).then_some(chord)
    }

    /// m.
    #[inline(always)]
    pub(crate) fn larger(&self, chord: &Chord<f64>) -> f64 {
        if chord.power > 0.0 { chord.distance_squared } else { self.radius_squared }
    }
}
