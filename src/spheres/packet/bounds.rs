//! Bounds of t where 16 rays meet a sphere, in f32.
//!
//! With o = c - p, a = d·d, and any m next to the closest approach, the exact t of the roots are
//!
//! ```text
//! m = o·d / a,   w = o - m d
//! t = m + e ∓ √((r² - |w|²) / a + e²),   e = w·d / a
//! ```
//!
//! where e is 0 but for the rounding of m. So t is bounded by two spheres around the same center, one larger and one smaller:
//!
//! ```text
//! m - √((R² - |w|²) / a)  ≤  t  ≤  m - √((S² - |w|²) / a)
//! R = r + reach,   S = r - reach
//! ```
//!
//! for the near root, and likewise for the far one. Where R² < |w|², the line misses; where S² > |w|², it certainly hits.
//!
//! **The errors.** With u = 2⁻²⁴ and every operation rounded (a fused multiply-add rounds less),
//!
//! ```text
//! o         a difference each                              is off by at most  u |o|
//! m         o 1, o·d a product and 2 sums, a 3,
//!           its reciprocal 1, a product 1                                     9 u |o| / |d|: so |e| is no more
//! w         o, a product, a difference                                        u |o| + u |m| |d| + u |w|
//! ```
//!
//! Where the line hits, |w| is at most about r, and |o| ≤ r + |m| |d|: w is off by at most 2 u (r + |m| |d|), and |w|² by 2 r
//! times that. |w|² - R² is a sum of x² + y², off by 2 u (x² + y²), and of z² - R², off by u z² + 2 u R²: together by 4 u R². So
//! R² has to be larger than r² by
//!
//! ```text
//! 2 r 2 u (r + |m| |d|) + 4 u r² = 2 r (4 u r + 2 u |m| |d|)   of the first order, and
//! (2² + 9²) u² (r + |m| |d|)²                                  of the second: of w, and e² a
//! ```
//!
//! and S² smaller than r² by what is of the first order, where the second order makes t no later: for that, a reach of
//! 4 u r + 2 u |m| |d| is enough, with its own square for the second order.
//!
//! **The bounds of t.** Half the chord, the root times 1 / |d|, is off by 14 u r / |d|: u for the root, u for the product, and 1
//! / |d| is too large by 12 u at most. m is off by 9 u |o| / |d|; the sum of both is off by u |t|, and t is rounded, u |t|. With
//! |o| / |d| ≤ |m| + r / |d| and |t| no more, together that is at most 11 u |m| + 25 u r / |d|, and an ulp of t, so that the
//! upper bound is also above the float above t, makes 13 u |m| + 27 u r / |d|. What is added to R is added to half the chord,
//! too, or more: the slope of √(R² - |w|²) in R is R / √(R² - |w|²), no less than 1.
//!
//! So the reach is [`RADIUS_MARGIN`] r + [`DISTANCE_MARGIN`] |m| |d|, 32 u r + 16 u |m| |d|. (S² is smaller by 2 r reach -
//! reach², no less than r times it, where S is not negative.)
//!
//! **Overflow and underflow.** As for leaves, of which [`LEAST`] is added to the reach: a radius below that is never certain to
//! be hit.

use super::{Mask, Packet, Sixteen};
use crate::Sphere;
use crate::float::sqrt_f32;
use crate::spheres::lanes::{Instructions, LANES, Vectorized};

/// By which part of itself a radius is made larger, and smaller: 32 u. See the derivation above.
const RADIUS_MARGIN: f32 = 16.0 * f32::EPSILON;

/// By which part of the way to the closest approach besides: 16 u.
const DISTANCE_MARGIN: f32 = 8.0 * f32::EPSILON;

/// By how much a radius is made larger, and smaller, at least: more than underflow can take from it.
const LEAST: f32 = f32::from_bits((127 - 60) << 23); // 2^-60

/// All of these.
#[derive(Clone, Copy, Debug)]
pub(super) struct Margins {
    pub(super) radius: f32,
    pub(super) distance: f32,
}

impl Margins {
    pub(super) const PROVEN: Self = Self { radius: RADIUS_MARGIN, distance: DISTANCE_MARGIN };
}

/// Asks which rays meet a sphere before the nearest so far.
pub(in crate::spheres) struct Meet<'a> {
    pub(in crate::spheres) packet: &'a mut Packet,
    pub(in crate::spheres) sphere: &'a Sphere,
    pub(in crate::spheres) place: u32,
    /// The rays that are asked.
    pub(in crate::spheres) rays: Mask,
}

/// What is known of the rays that meet a sphere, or may do so.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::spheres) struct Met {
    /// Those for which it is certainly the nearest so far.
    pub(in crate::spheres) surely: Mask,
    /// Those that have to be asked exactly.
    pub(in crate::spheres) doubtfully: Mask,
}

impl Vectorized for Meet<'_> {
    type Output = Met;

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> Met {
        self.run_with(instructions, Margins::PROVEN)
    }
}

impl Meet<'_> {
    #[inline(always)]
    pub(super) fn run_with<I: Instructions>(self, instructions: I, margins: Margins) -> Met {
        let Self { packet, sphere, place, rays } = self;
        let first = packet.first;
        let mut met = Met::default();
        for (sixteen, number) in packet.sixteens[..packet.count].iter_mut().zip(0..) {
            let shift = number * LANES;
            if rays >> shift & 0xFFFF != 0 {
                let (surely, doubtfully) =
                    sixteen.meet(instructions, sphere, place, first, margins);
                met.surely |= Mask::from(surely) << shift;
                met.doubtfully |= Mask::from(doubtfully) << shift;
            }
        }
        Met { surely: met.surely & rays, doubtfully: met.doubtfully & rays }
    }
}

impl Sixteen {
    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "so that the loop has no branches")]
    fn meet<I: Instructions>(
        &mut self,
        instructions: I,
        sphere: &Sphere,
        place: u32,
        first: f32,
        margins: Margins,
    ) -> (u32, u32) {
        let Sphere { center, radius } = *sphere;
        let Self { origin: [origin_x, origin_y, origin_z], .. } = self;
        let Self { direction: [direction_x, direction_y, direction_z], .. } = self;
        let Self { one_over_a, length, .. } = self;
        let least_reach = radius * margins.radius + LEAST;
        let (mut closest, mut reaches) = ([0.0; LANES], [0.0; LANES]);
        let (mut squares, mut clearances) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let x = center.x - origin_x[lane];
            let y = center.y - origin_y[lane];
            let z = center.z - origin_z[lane];
            let h = instructions.multiply_add(direction_y[lane], y, direction_x[lane] * x);
            let h = instructions.multiply_add(direction_z[lane], z, h);
            let m = h * one_over_a[lane];
            let x = instructions.multiply_add(-m, direction_x[lane], x);
            let y = instructions.multiply_add(-m, direction_y[lane], y);
            let z = instructions.multiply_add(-m, direction_z[lane], z);
            let reach =
                instructions.multiply_add(m.abs() * margins.distance, length[lane], least_reach);
            let outer = radius + reach;
            closest[lane] = m;
            reaches[lane] = reach;
            let one = instructions.multiply_add(y, y, x * x);
            squares[lane] = instructions.multiply_add(z, z, one);
            clearances[lane] = one + instructions.multiply_add(-outer, outer, z * z);
        }
        let near = instructions.signs(&clearances);
        if near == 0 {
            return (0, 0);
        }
        let (mut surely, mut doubtfully) = ([0.0; LANES], [0.0; LANES]);
        // Copies, or the compiler would have to write number by number.
        let (mut lowers, mut ends, mut places) = (self.lower, self.end, self.place);
        let one_over_length = &self.one_over_length;
        for lane in 0..LANES {
            let (m, reach) = (closest[lane], reaches[lane]);
            let inner = radius - reach;
            let inner = if inner > 0.0 { inner } else { 0.0 };
            // NaN where the line may miss, and so no comparison holds.
            let most = sqrt_f32(-clearances[lane]) * one_over_length[lane];
            let inside = instructions.multiply_add(inner, inner, -squares[lane]);
            let inside = if inside > 0.0 { inside } else { f32::NAN };
            let least = sqrt_f32(inside) * one_over_length[lane];
            // The far root, where the near one is certainly before the range.
            let is_far = m - least < first;
            let lower = if is_far { m + least } else { m - most };
            let upper = if is_far { m + most } else { m - least };
            let is_ahead = (m + most >= first) & (lower <= ends[lane]);
            let is_sure = (lower >= first) & (upper < lowers[lane]) & (clearances[lane] < 0.0);
            surely[lane] = if is_sure { -1.0 } else { 1.0 };
            doubtfully[lane] = if is_ahead & !is_sure { -1.0 } else { 1.0 };
            lowers[lane] = if is_sure { lower } else { lowers[lane] };
            ends[lane] = if is_sure { upper } else { ends[lane] };
            places[lane] = if is_sure { place } else { places[lane] };
        }
        (self.lower, self.end, self.place) = (lowers, ends, places);
        (instructions.signs(&surely), instructions.signs(&doubtfully) & near)
    }
}
