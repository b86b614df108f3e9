//! A cone around the rays of a packet, and which of 16 spheres are in it, in f32 and many lanes at a time. A sphere may pass
//! though no ray meets it; none is dropped that one of them hits.
//!
//! All rays start within ρ of an axis' origin P, and their directions are within σ of its direction D. So at t > 0, each is
//! within ρ + σ t of P + t D, and a sphere that it hits there has its center within r + ρ + σ t. With o = c - P, for t between a
//! first number and an end,
//!
//! ```text
//! m = o·D / D·D, but at least the first t and at most the end
//! w = o - m D,   k = σ / |D|
//! ```
//!
//! and a center that far from P + t D for any such t is at most this far from P + m D:
//!
//! ```text
//! |w| ≤ (r + ρ + σ m) / √(1 - k²)
//! ```
//!
//! For with v = (t - m) |D|, the square of its distance from P + t D is at least |w|² + v², as v and w·D have no signs that would
//! make it less, and √(|w|² + v²) - k v is least where v = k |w| / √(1 - k²): there it is √(1 - k²) |w|.
//!
//! **The error.** With u = 2⁻²⁴, as in leaves: for R the right side, m is off by 9 u |o| / |D|, and so σ m / √(1 - k²) by 6 u
//! |o|, for |k| ≤ ½; |w| is off by 11 u (R + m |D|) for what hits, its square by 4 u R², 2 u of R; R has 3 roundings. Together 22
//! u R and 17 u m |D|: the margins are [`MARGIN`], 32 u of each. ρ and σ are made larger for the rounding of their own: see
//! [`Cone::around`].

use glam::{DVec3, Vec3};

use super::{Extent, Sixteen, square};
use crate::Scalar;
use crate::float::sqrt;
use crate::spheres::filter::Block;
use crate::spheres::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::spheres::local::to_f32;

/// By which part of itself R is made larger, and by which part of m |D| besides: 32 u. See the derivation above.
const MARGIN: f64 = 16.0 * f32::EPSILON as f64;

/// These two.
pub(super) const MARGINS: [f64; 2] = [MARGIN; 2];

/// What is added to every radius: more than underflow can take from it.
const LEAST: f64 = f64::from_bits((1023 - 60) << 52); // 2^-60

/// k at most: wider cones have too much in them.
const WIDEST: f64 = 0.5;

/// A cone around rays.
#[derive(Clone, Copy, Debug)]
pub(in crate::spheres) struct Cone {
    origin: Vec3,
    direction: Vec3,
    /// D / D·D.
    over_a: Vec3,
    /// 1 / √(1 - k²), ρ times that, and σ times that, each made larger.
    factor: f32,
    base: f32,
    widening: f32,
    /// The first t, or less.
    pub(super) first: f32,
}

impl Cone {
    pub(super) const EMPTY: Self = Self {
        origin: Vec3::ZERO,
        direction: Vec3::ZERO,
        over_a: Vec3::ZERO,
        factor: 0.0,
        base: 0.0,
        widening: 0.0,
        first: 0.0,
    };

    /// The cone around rays, if it is not too wide. A distance from the axis is off by 5 u of itself: with the margin, that is
    /// more than allowed for.
    #[expect(clippy::cast_possible_truncation, reason = "the margin has room for rounding")]
    pub(super) fn around(
        lanes: Lanes,
        sixteens: &[Sixteen],
        extent: &Extent,
        first: f32,
        margins: [f64; 2],
    ) -> Option<Self> {
        let middle = |[low, high]: [Vec3; 2]| low * 0.5 + high * 0.5;
        let axis = [middle(extent.origins), middle(extent.directions)];
        let [base, spread] = lanes
            .run(Distances { sixteens, axis })
            .map(|square| sqrt(f64::from(square)) * (1.0 + MARGIN));
        let length = axis[1].as_dvec3().length();
        let k = spread / length;
        if k.is_nan() || k > WIDEST {
            return None;
        }
        let factor = sqrt(1.0 - k * k).recip();
        let (widening, [of_radius, of_distance]) = (spread * factor, margins);
        let over_a = DVec3::from(axis[1]) / (length * length);
        Some(Self {
            origin: axis[0],
            direction: axis[1],
            over_a: over_a.as_vec3(),
            factor: (factor * (1.0 + of_radius)) as f32,
            base: (base * factor * (1.0 + of_radius) + LEAST) as f32,
            widening: (widening * (1.0 + of_radius) + length * of_distance) as f32,
            first,
        })
    }

    /// That of one ray: ρ, σ and k are 0, and the margins are those of all.
    #[inline(always)]
    pub(super) fn of_one(
        origin: Vec3,
        direction: Vec3,
        one_over_a: f32,
        length: f32,
        first: f32,
        margins: [f64; 2],
    ) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "they are powers of two")]
        let ([of_radius, of_distance], least) = (margins.map(|margin| margin as f32), LEAST as f32);
        Self {
            origin,
            direction,
            over_a: direction * one_over_a,
            factor: 1.0 + of_radius,
            base: least,
            widening: length * of_distance,
            first,
        }
    }

    /// The same with coordinates relative to a center. The rounding of a difference is less than what it adds.
    pub(super) fn relative_to(&self, center: Vec3) -> Self {
        let origin = self.origin - center;
        let base = self.base + origin.abs().element_sum() * f32::EPSILON;
        Self { origin, base, ..*self }
    }

    /// Which of 16 spheres may be hit before `end`, a bit for each: of the centers' coordinates and the radii.
    #[inline(always)]
    pub(in crate::spheres) fn near<S: Scalar, I: Instructions>(
        &self,
        instructions: I,
        [centers_x, centers_y, centers_z, radii]: [&[S; LANES]; 4],
        end: f32,
    ) -> u32 {
        let Self { origin, direction, over_a, factor, base, widening, first } = *self;
        let mut clearances = [0.0; LANES];
        for lane in 0..LANES {
            let x = to_f32(centers_x[lane]) - origin.x;
            let y = to_f32(centers_y[lane]) - origin.y;
            let z = to_f32(centers_z[lane]) - origin.z;
            let m = instructions.multiply_add(over_a.y, y, over_a.x * x);
            let m = instructions.multiply_add(over_a.z, z, m);
            let m = if m > first { m } else { first };
            let m = if m < end { m } else { end };
            let x = instructions.multiply_add(-m, direction.x, x);
            let y = instructions.multiply_add(-m, direction.y, y);
            let z = instructions.multiply_add(-m, direction.z, z);
            let radius = instructions.multiply_add(to_f32(radii[lane]), factor, base);
            let radius = instructions.multiply_add(widening, m, radius);
            let one = instructions.multiply_add(y, y, x * x);
            clearances[lane] = one + instructions.multiply_add(-radius, radius, z * z);
        }
        instructions.signs(&clearances)
    }
}

/// Computes the squares of the largest distances from an axis, of origins and of directions.
struct Distances<'a> {
    sixteens: &'a [Sixteen],
    axis: [Vec3; 2],
}

impl Vectorized for Distances<'_> {
    type Output = [f32; 2];

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> [f32; 2] {
        let Self { sixteens, axis: [origin, direction] } = self;
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let [mut of_origin, mut of_direction] = [[0.0; LANES]; 2];
        for sixteen in sixteens {
            let ([p, q, r], [x, y, z]) = (&sixteen.origin, &sixteen.direction);
            for lane in 0..LANES {
                let [p, q, r] = [p[lane] - origin.x, q[lane] - origin.y, r[lane] - origin.z];
                let [x, y, z] =
                    [x[lane] - direction.x, y[lane] - direction.y, z[lane] - direction.z];
                of_origin[lane] = larger(of_origin[lane], square(instructions, p, q, r));
                of_direction[lane] = larger(of_direction[lane], square(instructions, x, y, z));
            }
        }
        [of_origin, of_direction].map(|numbers| super::reduce(numbers, larger))
    }
}

/// Finds the next block with spheres in the cone.
pub(in crate::spheres) struct InBlocks<'a> {
    pub(in crate::spheres) blocks: &'a [Block],
    pub(in crate::spheres) cone: &'a Cone,
    pub(in crate::spheres) end: f32,
}

impl Vectorized for InBlocks<'_> {
    /// How many blocks are skipped, and a bit for each sphere of the next.
    type Output = (usize, u32);

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> (usize, u32) {
        let Self { blocks, cone, end } = self;
        for (skipped, block) in blocks.iter().enumerate() {
            let [x, y, z, negative_radius_squared] = block.numbers();
            let mut radii = [0.0; LANES];
            let mut dropped = [0.0; LANES];
            for lane in 0..LANES {
                let square = -negative_radius_squared[lane];
                dropped[lane] = square;
                radii[lane] = crate::float::sqrt_f32(square.abs());
            }
            let near =
                cone.near(instructions, [x, y, z, &radii], end) & !instructions.signs(&dropped);
            if near != 0 {
                return (skipped, near);
            }
        }
        (blocks.len(), 0)
    }
}
