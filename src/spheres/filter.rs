//! The filter: which of 16 spheres a ray may meet, in f32 and many lanes at a time. It may let a sphere pass that the ray
//! misses; it never drops one that it hits.
//!
//! A hit with t in (0, end) is a point of the segment from the ray's origin to `end`. So a sphere is dropped where that
//! segment stays clear of its ball: where the point of the segment nearest to the center, at t = m, is farther from it than
//! the radius. With o = c - p, h = d·o, a = d·d, and s = a m,
//!
//! ```text
//! s = h, but at least 0 and at most a end
//! |m d - o|² - r² = (o·o - r²) - T > 0,   T = 2 h m - a m² = s (2 h - s) / a
//! ```
//!
//! That drops the spheres behind the origin and those beyond the nearest hit so far along with those beside the ray. For the
//! whole line s = h and T = h² / a, which is quicker: it goes first where there are many spheres.
//!
//! **The error.** With u = 2⁻²⁴ and every operation rounded (a fused multiply-add rounds less),
//!
//! ```text
//! o·o - r²   o twice, a product, 3 sums                 is off by at most  6 u o·o + 3 u r²
//! h          o, a product, 2 sums                       is off by at most  4 u |o| |d|, and so T by 8 u |o| |d| m
//! T          a 3, the quotient 1, 2 products, 2 sums    is off by at most  8 u T besides
//! ```
//!
//! The last subtraction is compared with zero, and rounding it changes no sign. That m itself is rounded matters in the second
//! order only, as it is where the distance is least; `a end` is rounded up. Now let the ray hit: o·o ≤ r² + T. With the
//! distance q = m |d| to the point at m, that to the closest approach, h / |d| ≥ q, and that of the center from the line, at
//! most r: |o| |d| m = q √((h / |d|)² + r²) ≤ h m + r² / 2 ≤ T + r² / 2. Together the errors are at most
//!
//! ```text
//! 6 u (r² + T) + 3 u r² + 8 u (T + r² / 2) + 8 u T = 13 u r² + 22 u T
//! ```
//!
//! So r² is made larger by [`MARGIN`], 16 u, of which its rounding leaves 15 u, and T by twice that. The rest is far more than
//! all terms of the second order. One factor is in what is kept of each sphere and the other in what is kept of the ray: the
//! loop pays nothing for the bound.
//!
//! **Overflow and underflow.** Lengths up to [`LARGEST`] and directions whose square is between its inverse and itself keep
//! every intermediate result finite: |o|² < 2¹²⁴, m < 2⁹³. A product that underflows is off by 2⁻¹⁵⁰ more, which factors of
//! at most m, 2 |o| |d| or |o| / |d|, all below 2³² |o|, bring to 2⁻¹¹⁵ |o| in all. Either that is below [`LEAST`], which
//! each r² has added to it, or |o| > 2¹⁵ and it is far below u o·o. Larger spheres pass always, and other rays ask all.

use glam::Vec3;

use crate::{Ray, Sphere};

/// How many spheres are filtered at a time: four vectors of SSE2 or NEON, two of AVX2, one of AVX-512.
pub(crate) const LANES: usize = 16;

/// By which part of themselves r², and by twice of which T, is made larger: 16 u. See the derivation above.
pub(crate) const MARGIN: f32 = 8.0 * f32::EPSILON;

/// What is added to every r²: more than underflow can take from it.
const LEAST: f64 = f64::from_bits((1023 - 99) << 52); // 2^-99

/// The largest coordinate, radius and square of a direction that the filter computes with: 2⁶⁰.
const LARGEST: f32 = f32::from_bits((127 + 60) << 23); // 2^60

/// What the filter knows of 16 spheres.
///
/// The four arrays of a block lie together: a scan reads one stream of memory in whole cache lines. That measured as the best
/// layout, and it has no rest of the last block to be treated apart, because lanes without a sphere are dropped like others.
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

    /// The spheres that the ray may meet before the segment's end, a bit for each.
    #[inline(always)]
    pub(crate) fn near_segment<const FUSED: bool>(&self, segment: &Segment, end: f32) -> u32 {
        let longest = segment.a * end;
        let mut near = 0;
        for lane in 0..LANES {
            let (power, h) = self.power_and_h::<FUSED>(lane, segment);
            // Comparisons that are one instruction each: `f32::clamp` looks for NaN, and there is none here.
            let s = if h > 0.0 { h } else { 0.0 };
            let s = if s < longest { s } else { longest };
            let clearance = multiply_add::<FUSED>(s * segment.one_over_a, (s - h) - h, power);
            near |= if clearance > 0.0 { 0 } else { 1 << lane };
        }
        near
    }

    /// Whether there is a sphere that the whole line may meet, ahead or behind.
    #[inline(always)]
    pub(crate) fn is_near_line<const FUSED: bool>(&self, segment: &Segment) -> bool {
        // Signs are quicker to collect than comparisons.
        let mut signs = 0;
        for lane in 0..LANES {
            let (power, h) = self.power_and_h::<FUSED>(lane, segment);
            let clearance = multiply_add::<FUSED>(-(h * segment.one_over_a), h, power);
            signs |= clearance.to_bits();
        }
        signs >> 31 == 1
    }

    /// o·o - r² and d·o.
    #[inline(always)]
    fn power_and_h<const FUSED: bool>(&self, lane: usize, segment: &Segment) -> (f32, f32) {
        let Segment { origin, direction, .. } = *segment;
        let x = self.x[lane] - origin.x;
        let y = self.y[lane] - origin.y;
        let z = self.z[lane] - origin.z;
        let power = multiply_add::<FUSED>(x, x, self.negative_radius_squared[lane]);
        let power = multiply_add::<FUSED>(y, y, power);
        let power = multiply_add::<FUSED>(z, z, power);
        let h = multiply_add::<FUSED>(direction.y, y, direction.x * x);
        (power, multiply_add::<FUSED>(direction.z, z, h))
    }
}

/// r², made larger by `margin` of itself and by [`LEAST`].
#[expect(clippy::cast_possible_truncation, reason = "the margin has room for rounding")]
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
    direction: Vec3,
    /// d·d, made larger so that with it the segment does not become shorter.
    a: f32,
    /// 1 / d·d, made larger.
    one_over_a: f32,
}

impl Segment {
    /// Whether the filter can compute with that ray.
    #[inline(always)]
    pub(crate) fn allows(ray: &Ray) -> bool {
        let a = ray.direction.length_squared();
        ray.origin.abs().cmple(Vec3::splat(LARGEST)).all() && (1.0 / LARGEST..=LARGEST).contains(&a)
    }

    #[inline(always)]
    pub(crate) fn new(ray: &Ray, margin: f32) -> Self {
        let Ray { origin, direction } = *ray;
        let a = direction.length_squared();
        Self { origin, direction, a: a * (1.0 + margin), one_over_a: (1.0 + 2.0 * margin) / a }
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

            #[expect(clippy::cast_possible_truncation, reason = "any radius will do")]
            let sphere = Sphere::new(center.as_vec3(), radius as f32);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
            let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };
            let mut block = Block::EMPTY;
            block.set(5, &sphere, margin);
            let segment = Segment::new(&ray, margin);
            for end in [f32::INFINITY, f32::from_bits(hit.t.to_bits() + 1)] {
                hits += 1;
                let (near_line, near) = if fused {
                    (
                        block.is_near_line::<true>(&segment),
                        block.near_segment::<true>(&segment, end),
                    )
                } else {
                    (
                        block.is_near_line::<false>(&segment),
                        block.near_segment::<false>(&segment, end),
                    )
                };
                assert_eq!(near & !(1 << 5), 0, "an empty lane passed");
                dropped += u32::from(near == 0 || !near_line);
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
