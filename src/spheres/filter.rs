//! The filter: which of 32 spheres a ray may meet, in f32 and many lanes at a time. It may let a sphere pass that the ray
//! misses; it never drops one that it hits.
//!
//! A hit with t in (0, end) is a point of the segment from the ray's origin to `end`. So a sphere is dropped where that
//! segment stays clear of its ball: where the point of the segment nearest to the center, at t = m, is farther from it than
//! the radius. With o = c - p, h = d·o and a = d·d,
//!
//! ```text
//! m = h / a, but at least 0 and at most end
//! |m d - o|² - r² = o·o - r² + m (a m - 2 h) > 0
//! ```
//!
//! That takes the spheres behind the origin and those beyond the nearest hit so far along with those beside the ray.
//!
//! **The error.** With u = 2⁻²⁴ and every operation rounded (a fused multiply-add rounds less), what is computed for
//!
//! ```text
//! o·o - r²   o twice, a product, 3 sums                   is off by at most  6 u o·o + 3 u r²
//! 2 h m      d and o, a product, 2 sums, 2 more with m    is off by at most  10 u |o| |d| m + 4 u h m
//! a m²       a product, 2 sums; 3 more with m             is off by at most  6 u a m²
//! ```
//!
//! The last sum is compared with zero, and rounding it changes no sign. That m itself is rounded matters in the second order
//! only, as it is where the distance is least. Now let the ray hit: o·o ≤ r² + 2 h m - a m². Let s = h / |d| be the distance
//! to the closest approach, l ≤ r that of the center from there, and q = m |d| ≤ s; then
//! |o| |d| m = q √(s² + l²) ≤ q s + l² / 2 ≤ h m + r² / 2. Together the errors are at most
//!
//! ```text
//! 6 u (r² + 2 h m - a m²) + 3 u r² + 10 u (h m + r² / 2) + 4 u h m + 6 u a m² = 14 u r² + 26 u h m
//! ```
//!
//! So r² and 2 h are each made larger by [`MARGIN`], 16 u, once for each sphere and once for each ray: that is 15 u after
//! rounding, and leaves room for all terms of the second order. The loop pays nothing for the bound.
//!
//! **Overflow and underflow.** Lengths up to [`LARGEST`] and directions whose square is within [`SHORTEST`] and [`LONGEST`]
//! keep every intermediate result finite: |o|² < 2¹²⁴, m < 2⁹³. A product that underflows is off by 2⁻¹⁵⁰ more, which m ≤
//! 2 |o| / |d| < 2³² |o| multiplies to 2⁻¹¹⁵ |o| in all. Either that is below [`LEAST`], which each r² has added to it, or
//! |o| > 2¹⁵ and it is far below u o·o. What is larger does not come here: such a sphere passes always, such a ray asks all.

use glam::Vec3;

use crate::{Ray, Sphere};

/// How many spheres are filtered at a time: as many as a word has bits. Eight vectors of SSE2 or NEON, four of AVX2.
pub(crate) const LANES: usize = 32;

/// By which part of themselves r² and h are made larger: 16 u. See the derivation above.
pub(crate) const MARGIN: f32 = 8.0 * f32::EPSILON;

/// What is added to every r²: more than what underflow can take from a distance squared.
const LEAST: f64 = 1.0 / (1_u128 << 99) as f64;

/// The largest coordinate or radius that the filter computes with: 2⁶⁰.
const LARGEST: f32 = (1_u64 << 60) as f32;

/// The largest square of a direction that the filter computes with.
const LONGEST: f32 = LARGEST;

/// The smallest one.
const SHORTEST: f32 = 1.0 / LARGEST;

/// 2ⁱ at i: the bit of each lane.
const BIT: [u32; LANES] = {
    let mut bits = [1; LANES];
    let mut lane = 0;
    while lane < LANES {
        bits[lane] = 1 << lane;
        lane += 1;
    }
    bits
};

/// What the filter knows of 32 spheres.
///
/// The four arrays of a block lie together, so that a scan reads one stream of memory, and the cache line of one field brings
/// the next; with four arrays as long as the scene it is four streams, and 4 pages instead of 1 at every step.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct Block {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    /// -r², made larger. Infinite for a sphere that is always dropped, negative infinite for one that passes always.
    negative_radius_squared: [f32; LANES],
}

impl Block {
    /// A block without spheres: every lane is dropped.
    pub(crate) const EMPTY: Self = Self {
        x: [0.0; LANES],
        y: [0.0; LANES],
        z: [0.0; LANES],
        negative_radius_squared: [f32::INFINITY; LANES],
    };

    /// Puts a sphere into a lane.
    pub(crate) fn set(&mut self, lane: usize, sphere: &Sphere, margin: f32) {
        let Sphere { center, radius } = *sphere;
        let (center, negative_radius_squared) =
            if !center.is_finite() || !radius.is_finite() || radius < 0.0 {
                // Nothing meets it.
                (Vec3::ZERO, f32::INFINITY)
            } else if center.abs().max_element() > LARGEST || radius > LARGEST {
                (Vec3::ZERO, f32::NEG_INFINITY)
            } else {
                (center, -enlarged_square(radius, margin))
            };
        self.x[lane] = center.x;
        self.y[lane] = center.y;
        self.z[lane] = center.z;
        self.negative_radius_squared[lane] = negative_radius_squared;
    }

    /// The spheres that a ray may meet before `end`, a bit for each lane.
    #[inline(always)]
    pub(crate) fn touched<const FUSED: bool>(&self, segment: &Segment, end: f32) -> u32 {
        let Segment { origin, twice_direction, a, half_over_a } = *segment;
        let mut touched = 0;
        for lane in 0..LANES {
            let x = self.x[lane] - origin.x;
            let y = self.y[lane] - origin.y;
            let z = self.z[lane] - origin.z;
            let twice_h = multiply_add::<FUSED>(
                twice_direction.z,
                z,
                multiply_add::<FUSED>(twice_direction.y, y, twice_direction.x * x),
            );
            let power = multiply_add::<FUSED>(x, x, self.negative_radius_squared[lane]);
            let power = multiply_add::<FUSED>(z, z, multiply_add::<FUSED>(y, y, power));

            // Comparisons in the form that is one instruction: `f32::max` has to look for NaN, and there is none here.
            let m = twice_h * half_over_a;
            let m = if m > 0.0 { m } else { 0.0 };
            let m = if m < end { m } else { end };
            let clearance = multiply_add::<FUSED>(m, multiply_add::<FUSED>(a, m, -twice_h), power);
            touched |= if clearance > 0.0 { 0 } else { BIT[lane] };
        }
        touched
    }
}

/// r², made larger by `margin` of itself and by [`LEAST`].
#[expect(clippy::cast_possible_truncation, reason = "rounding is within the margin")]
fn enlarged_square(radius: f32, margin: f32) -> f32 {
    let radius = f64::from(radius);
    (radius * radius * (1.0 + f64::from(margin)) + LEAST) as f32
}

/// `a b + c`, rounded once where the machine has an instruction for it.
#[inline(always)]
fn multiply_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(feature = "std")]
    if FUSED {
        return a.mul_add(b, c);
    }
    a * b + c
}

/// What the filter knows of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    origin: Vec3,
    /// 2 d, made larger.
    twice_direction: Vec3,
    /// d·d.
    a: f32,
    /// 1 / 2a.
    half_over_a: f32,
}

impl Segment {
    /// `None` for a ray that is beyond what the filter can compute with.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray, margin: f32) -> Option<Self> {
        let Ray { origin, direction } = *ray;
        let a = direction.length_squared();
        let ordinary =
            origin.abs().cmple(Vec3::splat(LARGEST)).all() && a >= SHORTEST && a <= LONGEST;
        ordinary.then(|| Self {
            origin,
            twice_direction: direction * (2.0 * (1.0 + margin)),
            a,
            half_over_a: 0.5 / a,
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use sobol_burley::sample;

    use super::*;
    use crate::Hittable;

    /// How many of the hits of random rays that graze a sphere, or end where they meet it, a filter of that margin drops.
    fn dropped(margin: f32, fused: bool, cases: u32) -> u32 {
        let mut hits = 0;
        let mut dropped = 0;
        for case in 0..cases {
            let random = |dimension| f64::from(sample(case, dimension, 1));
            let vector = |dimension| {
                DVec3::new(random(dimension), random(dimension + 1), random(dimension + 2))
                    - DVec3::splat(0.5)
            };
            let direction = vector(0);
            let outward = direction.cross(vector(3)).normalize_or(DVec3::X);
            let center = vector(6) * 10.0;
            let radius = 0.01 + random(9) * random(9);
            let at_the_limb = 1.0 - 1e-6 * random(10);
            let closest =
                if case % 2 == 0 { at_the_limb } else { random(10) * at_the_limb } * radius;
            let origin = center + outward * closest - direction * (20.0 * random(11));

            let sphere = Sphere::new(center.as_vec3(), radius as f32);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
            let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };
            let mut block = Block::EMPTY;
            block.set(5, &sphere, margin);
            let Some(segment) = Segment::new(&ray, margin) else { continue };
            for end in [f32::INFINITY, hit.t.next_up()] {
                hits += 1;
                let touched = if fused {
                    block.touched::<true>(&segment, end)
                } else {
                    block.touched::<false>(&segment, end)
                };
                assert_eq!(touched & !(1 << 5), 0, "an empty lane passed");
                dropped += u32::from(touched == 0);
            }
        }
        assert!(hits > cases / 2);
        dropped
    }

    #[test]
    fn drops_no_sphere_that_is_hit() {
        assert_eq!(dropped(MARGIN, false, 60_000), 0);
        assert_eq!(dropped(MARGIN, true, 10_000), 0);
    }

    #[test]
    fn needs_its_margin() {
        assert!(dropped(0.0, false, 60_000) > 0);
        assert!(dropped(0.0, true, 10_000) > 0);
    }
}
