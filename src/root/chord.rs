//! The chord that a sphere cuts from a line: what both derivations find.

use crate::arithmetic::number::{Number, Triple};

/// The chord, in the terms of the lecture, with o = c - p from the ray's origin to the center and d the direction.
///
/// The line's distances `t` to the sphere are the roots of `a t² - 2 h t + power`, halfway between them is the closest
/// approach, `t_m = h / a`, and they lie `Δt = √discriminant / a` to either side of it.
#[derive(Clone, Copy, Debug)]
pub struct Chord<N> {
    /// d·d, the square of the direction's length.
    pub a: N,
    /// d·o, and so `a t_m`: how far along the line the closest approach to the center is.
    pub h: N,
    /// o·o, the square of the distance to the center.
    pub distance_squared: N,
    /// o·o - r², the power of the origin: positive outside, zero on the surface, negative inside. The product of the roots
    /// is `power / a`.
    pub power: N,
    /// (a Δt)²: negative where the line misses, zero where it touches.
    pub discriminant: N,
}

/// A way to the chord.
pub trait Derivation {
    /// The chord of the line along `d` in the sphere whose center is `o` from the ray's origin.
    fn chord<N: Number>(o: Triple<N>, d: Triple<N>, radius_squared: N) -> Chord<N>;
}
