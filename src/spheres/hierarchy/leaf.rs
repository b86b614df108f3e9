//! Which of 16 spheres a ray may meet, in f32 and many lanes at a time. A sphere may pass though the ray misses it; none is
//! dropped that is hit.
//!
//! A hit with t from `start` to `end` is a point of that segment of the ray; [`local`](crate::spheres::local) rounds the two
//! outwards. So a sphere is dropped where its center is farther from the segment than the radius: with o = c - p, a = d·d and
//! e = d / a,
//!
//! ```text
//! m = o·e, but at least start and at most end
//! w = o - m d
//! |w|² > R²,   R = r, made larger
//! ```
//!
//! Unlike o·o - h² / a, this does not cancel from afar: of what passes, nearly all is hit.
//!
//! **The error.** With u = 2⁻²⁴ and every operation rounded (a fused multiply-add rounds less),
//!
//! ```text
//! o             a difference each                  is off by at most  u |o|
//! e             a 3, the quotient 1, a product 1                      5 u |e|
//! o·e           o 1, e 5, a product 1, 2 sums                         9 u |o| |e|, and the same m, for a limit moves no
//!                                                                     two numbers farther apart: so m d by 9 u |o|
//! w             o 1, a product, a difference                          u |o| + u m |d| + u |w|
//! ```
//!
//! If the ray hits, the exact w is at most r long, and so |o| ≤ r + m |d|. As it is computed, |w| is therefore at most
//!
//! ```text
//! r + 9 u |o| + u |o| + u m |d| + u r = r (1 + 11 u) + 11 u m |d|
//! ```
//!
//! **Rounded numbers.** Spheres are in the coordinates of the world and in the scene's own precision, and so is p. Only o is
//! `f32`. The direction may be rounded to `f32`, which moves the point at t by u t |d| ≤ u (r + m |d|), for the hit is at most
//! half a chord beyond m; r too, by u r; and where p has been moved along the ray, it is off by what [`Tube::moved`] adds to
//! every radius. That makes r (1 + 13 u) + 12 u m |d|.
//!
//! |w|² - R² is the sum of x² + y², off by 2 u (x² + y²), and of z² - R², off by u z², u R² and the rounding of the difference,
//! u R²; to round the sum of the two changes no sign. That is at most 4 u R², or 2 u of R. R takes two more roundings: 4 u in
//! all. So r is made larger by [`RADIUS_MARGIN`], 20 u, and then by [`DISTANCE_MARGIN`] m |d|, 14 u. What is left of either, more
//! than u r and u m |d|, is far more than all terms of the second order. The length |d| is taken for |x| + |y| + |z|, which is no
//! smaller.
//!
//! **Overflow and underflow.** Lengths up to 2⁶⁰ and directions of 2⁻³⁰ to 2⁶⁰ keep every intermediate result finite: |o| < 2⁶²,
//! and m < 2⁹² for a sphere that is hit, wherever the range starts. A product that underflows is off by 2⁻¹⁵⁰: in m d that makes
//! 2⁻⁸⁸, and [`LEAST`], 2⁻⁶⁰, which each R has added to it, is more; R² is then at least 2⁻¹²⁰ above r², and |w|² off by 2⁻¹⁴⁸ at
//! most.

use core::mem::size_of;

use glam::{DVec3, Vec4};

use crate::spheres::lanes::{Instructions, LANES};
use crate::spheres::local::{narrow, to_f32};
use crate::{Ray, Scalar, Sphere, Vector};

/// By which part of itself a radius is made larger: 20 u. See the derivation above.
const RADIUS_MARGIN: f32 = 10.0 * f32::EPSILON;

/// By which part of the way to the closest approach it is made larger besides: 14 u.
const DISTANCE_MARGIN: f32 = 7.0 * f32::EPSILON;

/// What is added to every radius: more than underflow can take from it.
const LEAST: f32 = f32::from_bits((127 - 60) << 23); // 2^-60

/// The index in a lane without a sphere.
pub(super) const NONE: u32 = u32::MAX;

/// Up to 16 spheres.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Leaf<S> {
    /// Of the centers, by axis.
    center: [[S; LANES]; 3],
    radius: [S; LANES],
    /// Of each, its place in the order in which the spheres were given, or [`NONE`].
    index: [u32; LANES],
}

impl<S: Scalar> Leaf<S> {
    pub(super) const LANES: usize = LANES;

    /// One sphere, over and over.
    pub(super) fn filled<V: Vector<Scalar = S>>(index: u32, sphere: &Sphere<V>) -> Self {
        let center = sphere.center.to_f64().to_array().map(S::from_f64);
        Self {
            center: center.map(|coordinate| [coordinate; LANES]),
            radius: [sphere.radius; LANES],
            index: [index; LANES],
        }
    }

    /// Puts a sphere into a lane.
    pub(super) fn set<V: Vector<Scalar = S>>(
        &mut self,
        lane: usize,
        index: u32,
        sphere: &Sphere<V>,
    ) {
        let center = sphere.center.to_f64().to_array().map(S::from_f64);
        for (all, coordinate) in self.center.iter_mut().zip(center) {
            all[lane] = coordinate;
        }
        self.radius[lane] = sphere.radius;
        self.index[lane] = index;
    }

    /// The sphere of a lane.
    #[inline(always)]
    pub(super) fn sphere<V: Vector<Scalar = S>>(&self, lane: usize) -> Sphere<V> {
        let [x, y, z] = [0, 1, 2].map(|axis: usize| self.center[axis][lane].into());
        Sphere::new(V::from_f64(DVec3::new(x, y, z)), self.radius[lane])
    }

    /// The coordinates of the centers, and the radii.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [&[S; LANES]; 4] {
        let [x, y, z] = &self.center;
        [x, y, z, &self.radius]
    }

    /// Its place in the order in which the spheres were given.
    #[inline(always)]
    pub(super) fn index(&self, lane: usize) -> u32 {
        self.index[lane]
    }

    /// The spheres that the ray may meet from a start to an end, a bit for each.
    ///
    /// Of those, m goes to `closest` and |w|² - R² to `clearances`.
    #[inline(always)]
    pub(super) fn near<I: Instructions>(
        &self,
        instructions: I,
        tube: &Tube<S>,
        limits: [f32; 2],
        closest: &mut [f32; LANES],
        clearances: &mut [f32; LANES],
    ) -> u32 {
        let origin = tube.origin;
        let offset = |lane: usize, axis: usize| to_f32(self.center[axis][lane] - origin[axis]);
        if size_of::<S>() == size_of::<f32>() {
            let sphere = |lane| {
                (offset(lane, 0), offset(lane, 1), offset(lane, 2), to_f32(self.radius[lane]))
            };
            Self::near_origin(instructions, tube, sphere, limits, closest, clearances)
        } else {
            self.near_narrowed(instructions, tube, offset, limits, closest, clearances)
        }
    }

    /// [`near`](Self::near) of a ray that begins anew.
    #[inline(always)]
    pub(super) fn near_moved<I: Instructions>(
        &self,
        instructions: I,
        tube: &Tube<S>,
        limits: [f32; 2],
        closest: &mut [f32; LANES],
        clearances: &mut [f32; LANES],
    ) -> u32 {
        let origin = tube.moved_origin;
        let offset =
            |lane: usize, axis: usize| to_f32(self.center[axis][lane].into() - origin[axis]);
        self.near_narrowed(instructions, tube, offset, limits, closest, clearances)
    }

    /// The same with the coordinates of a lane relative to the ray's origin. All are rounded to `f32` before anything else is
    /// done with them: in one loop with `f64`, a vector would hold no more of what is `f32`.
    #[inline(always)]
    fn near_narrowed<I: Instructions>(
        &self,
        instructions: I,
        tube: &Tube<S>,
        offset: impl Fn(usize, usize) -> f32,
        limits: [f32; 2],
        closest: &mut [f32; LANES],
        clearances: &mut [f32; LANES],
    ) -> u32 {
        let [mut x, mut y, mut z, mut radius] = [[0.0; LANES]; 4];
        for lane in 0..LANES {
            x[lane] = offset(lane, 0);
            y[lane] = offset(lane, 1);
            z[lane] = offset(lane, 2);
            radius[lane] = to_f32(self.radius[lane]);
        }
        let sphere = |lane: usize| (x[lane], y[lane], z[lane], radius[lane]);
        Self::near_origin(instructions, tube, sphere, limits, closest, clearances)
    }

    /// The same with what the coordinates of a lane are, relative to the ray's origin, and the radius.
    #[inline(always)]
    fn near_origin<I: Instructions>(
        instructions: I,
        tube: &Tube<S>,
        sphere: impl Fn(usize) -> (f32, f32, f32, f32),
        [start, end]: [f32; 2],
        closest: &mut [f32; LANES],
        clearances: &mut [f32; LANES],
    ) -> u32 {
        let Tube { direction, over_a, radius_factor, widening, least, .. } = *tube;
        // Arrays of its own, or the compiler would have to store each number before it loads the next.
        let (mut all_closest, mut all_clearances) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let (x, y, z, radius) = sphere(lane);
            let m = instructions.multiply_add(over_a.y, y, over_a.x * x);
            let m = instructions.multiply_add(over_a.z, z, m);
            // Comparisons that are one instruction each: `f32::clamp` looks for NaN.
            let m = if m > start { m } else { start };
            let m = if m < end { m } else { end };
            let x = instructions.multiply_add(-m, direction.x, x);
            let y = instructions.multiply_add(-m, direction.y, y);
            let z = instructions.multiply_add(-m, direction.z, z);
            let radius = instructions.multiply_add(radius, radius_factor, least);
            let radius = instructions.multiply_add(widening, m, radius);
            // Two halves, neither of which waits for the other.
            let one = instructions.multiply_add(y, y, x * x);
            let other = instructions.multiply_add(-radius, radius, z * z);
            all_closest[lane] = m;
            all_clearances[lane] = one + other;
        }
        *closest = all_closest;
        *clearances = all_clearances;
        instructions.signs(&all_clearances)
    }
}

/// What the leaves are tested with: a ray, and how far around it a sphere may be.
///
/// In vectors of four, for the reason that `Slabs` has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tube<S> {
    origin: [S; 4],
    /// Where the ray begins anew, if it does.
    moved_origin: [f64; 4],
    direction: Vec4,
    /// e = d / d·d.
    over_a: Vec4,
    /// By which radii are multiplied.
    radius_factor: f32,
    /// What is added to them, in m.
    widening: f32,
    /// What is added to them besides.
    least: f32,
}

impl<S: Scalar> Tube<S> {
    #[inline(always)]
    pub(super) fn new<V: Vector<Scalar = S>>(ray: &Ray<V>) -> Self {
        Self::with_margins(ray, RADIUS_MARGIN, DISTANCE_MARGIN)
    }

    /// Of a ray that begins anew at `t`.
    ///
    /// With v = 2⁻⁵³, the product is off by v t |d|, and the sum by v of itself. Twice that is added to every radius, with the
    /// sums of the coordinates for the lengths.
    pub(super) fn moved<V: Vector<Scalar = S>>(ray: &Ray<V>, t: f64) -> Self {
        let way = ray.direction.to_f64() * t;
        let origin = ray.origin.to_f64() + way;
        let sizes = way.abs().element_sum() + origin.abs().element_sum();
        let mut tube = Self::new(ray);
        tube.moved_origin = origin.extend(0.0).to_array();
        tube.least += to_f32(f64::EPSILON * sizes);
        tube
    }

    #[inline(always)]
    fn with_margins<V: Vector<Scalar = S>>(
        ray: &Ray<V>,
        radius_margin: f32,
        distance_margin: f32,
    ) -> Self {
        let direction = narrow(ray.direction);
        let over_a = direction.length_squared().recip();
        let direction = direction.extend(0.0);
        Self {
            origin: ray.origin.to_f64().extend(0.0).to_array().map(S::from_f64),
            moved_origin: [0.0; 4],
            direction,
            over_a: direction * over_a,
            radius_factor: 1.0 + radius_margin,
            widening: distance_margin * direction.abs().element_sum(),
            least: LEAST,
        }
    }

    /// |d|.
    pub(super) fn length(&self) -> f32 {
        self.direction.length()
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use sobol_burley::sample;

    use super::*;
    use crate::Hittable;
    use crate::spheres::lanes::{Lanes, Vectorized};

    struct Near<'a> {
        leaf: &'a Leaf<f32>,
        tube: Tube<f32>,
        limits: [f32; 2],
    }

    impl Vectorized for Near<'_> {
        type Output = u32;

        #[inline(always)]
        fn run<I: Instructions>(self, instructions: I) -> u32 {
            let (mut closest, mut clearances) = ([0.0; LANES], [0.0; LANES]);
            self.leaf.near(instructions, &self.tube, self.limits, &mut closest, &mut clearances)
        }
    }

    /// How many of the hits of random rays that graze a sphere, near or far, or that end where they meet it, are dropped.
    fn dropped(margins: [f32; 2], far: f64, lanes: Lanes, cases: u32) -> u32 {
        const LANE: usize = 3;
        let mut hits = 0;
        let mut dropped = 0;
        for case in 0..cases {
            let random = |dimension| f64::from(sample(case, dimension, 3));
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
            let origin = center + outward * closest - direction * (far * random(11));

            #[expect(clippy::cast_possible_truncation, reason = "any radius will do")]
            let sphere = Sphere::new(center.as_vec3(), radius as f32);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
            let Some(hit) = sphere.intersect(&ray, 0.0..f32::INFINITY) else { continue };
            let elsewhere = Sphere::new((center + outward * (3.0 * radius + far)).as_vec3(), 0.0);
            let mut leaf = Leaf::filled(0, &elsewhere);
            leaf.set(LANE, 1, &sphere);
            let just_after = f32::from_bits(hit.t.to_bits() + 1);
            let Some([_, exit]) = sphere.roots(&ray) else { continue };
            // The exact t may be less than the one returned.
            let before = |t: f32| f32::from_bits(t.to_bits() - 1);
            for limits in [
                [0.0, f32::INFINITY],
                [0.0, just_after],
                [before(hit.t), f32::INFINITY],
                [before(exit), f32::INFINITY],
            ] {
                hits += 1;
                let tube = Tube::with_margins(&ray, margins[0], margins[1]);
                let near = lanes.run(Near { leaf: &leaf, tube, limits });
                assert_eq!(near & !(1 << LANE), 0, "a point elsewhere passed");
                dropped += u32::from(near == 0);
            }
        }
        assert!(hits > cases / 2, "{hits}");
        dropped
    }

    /// Far away, where the distance makes the error.
    const FAR: f64 = 1e4;

    #[test]
    fn drops_no_sphere_that_is_hit() {
        for lanes in Lanes::available() {
            for far in [2.0, 20.0, FAR] {
                assert_eq!(dropped([RADIUS_MARGIN, DISTANCE_MARGIN], far, lanes, 40_000), 0);
            }
        }
    }

    #[test]
    fn needs_both_margins() {
        for lanes in Lanes::available() {
            assert!(dropped([0.0, DISTANCE_MARGIN], 0.001, lanes, 40_000) > 0, "{lanes:?}");
            assert!(dropped([RADIUS_MARGIN, 0.0], FAR, lanes, 40_000) > 0, "{lanes:?}");
        }
    }
}
