//! Where `f32` begins: the plain step in `f64`, and one rounding.

use core::ops::Range;

use glam::Vec3;

use super::again::{both_again, nearest_again, nearest_ahead};
use super::answer::{Found, Question, Side};
use super::ask_carefully;
use super::chord::Derivation;
use super::format::Format;
use super::line::{Line, Setting};
use super::plain::{self, Both, Nearest};
use super::plain_single::{CLEAR, MARGIN, NEAR, surely_rounded};
use super::precision::Precision;
use crate::arithmetic::comparison::exceeds;
use crate::arithmetic::rounding::rounds_safely;
use crate::target::HAS_F64;
use crate::{Hit, Ray, Sphere};

/// Finds the nearest hit: the plain step, and the way to the others.
// Inlined always: so that what a caller does not use of the hit is not computed.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded once, here")]
fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
    let setting = Setting::new(sphere, ray);
    let chord = setting.chord::<D>();
    match nearest_ahead(&setting, &chord, false) {
        Nearest::Miss => return None,
        Nearest::Root { t, half_chord } => {
            let rounded = t as f32;
            // Down to the smallest normal number, rounding is another matter.
            let is_certain = rounds_safely::<MARGIN>(t) && rounded > f32::MIN_POSITIVE;
            if is_certain && rounded >= range.start {
                // Not where that is NaN.
                let is_in_range = rounded < range.end;
                if !is_in_range {
                    return None;
                }
                let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
                // From so far outside, it is the near one.
                let side = Side::Near;
                if is_far && HAS_F64 {
                    // Apart, so that the compiler need not keep what only one of the two needs.
                    return Some(hit(sphere, ray, setting.found_from_afar(&chord, side, rounded)));
                }
                let found = if is_far {
                    setting.found_from_afar(&chord, side, rounded)
                } else {
                    setting.found(t, rounded)
                };
                return Some(hit(sphere, ray, found));
            }
            // Where the near root is below the range, the far one may be in it.
            if is_certain && HAS_F64 {
                if half_chord < 0.0 {
                    return None;
                }
                let t = plain::far_root(&chord, half_chord);
                if rounds_safely::<MARGIN>(t) {
                    let rounded = t as f32;
                    if !range.contains(&rounded) {
                        return None;
                    }
                    let is_far = exceeds(chord.distance_squared, NEAR, setting.radius_squared);
                    let found = if is_far {
                        setting.found_from_afar(&chord, Side::Far, rounded)
                    } else {
                        setting.found(t, rounded)
                    };
                    return Some(hit(sphere, ray, found));
                }
            }
        }
        Nearest::Doubt => {}
    }
    let found = nearest_again(sphere, ray, &Line::new(sphere, ray), range)?;
    Some(hit(sphere, ray, found))
}

/// The same by a call: where `f64` is software, that costs next to nothing, and copies of the plain step much.
#[inline(never)]
fn intersect_by_a_call<D: Derivation>(
    sphere: &Sphere,
    ray: &Ray,
    range: Range<f32>,
) -> Option<Hit> {
    intersect::<D>(sphere, ray, range)
}

impl Precision for Vec3 {
    #[inline(always)]
    fn intersect<D: Derivation>(sphere: &Sphere, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        if HAS_F64 {
            intersect::<D>(sphere, ray, range)
        } else {
            intersect_by_a_call::<D>(sphere, ray, range)
        }
    }

    fn exit_at_same_t(sphere: &Sphere, ray: &Ray) -> Option<Hit> {
        let line = Line::new(sphere, ray);
        let found = ask_carefully(&line, Format::F32, &Question::Exit)?.nearest()?;
        Some(hit(sphere, ray, found))
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the roots are rounded once, here")]
    fn roots<D: Derivation>(sphere: &Sphere, ray: &Ray) -> Option<[f32; 2]> {
        let setting = Setting::new(sphere, ray);
        match plain::both(&setting.chord::<D>(), setting.radius_squared, CLEAR, || None) {
            Both::Miss => return None,
            Both::Roots { t, .. } => {
                if let Some(rounded) = surely_rounded(t) {
                    return Some(rounded);
                }
            }
            Both::Doubt => {}
        }
        let roots = both_again(sphere, ray, &Line::new(sphere, ray))?;
        Some(roots.map(|root| root as f32))
    }
}

/// The hit, rounded.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "t is rounded already")]
fn hit(sphere: &Sphere, ray: &Ray, found: Found) -> Hit {
    let (t, point) = (found.t as f32, found.point.as_vec3());
    let (normal, error) = (found.normal.as_vec3(), point_error(t, sphere, ray));
    Hit { t, point, normal, error }
}

/// How far off the point may be besides the rounding of its coordinates, and more: see [`Hit::clearance`].
///
/// The point is off by at most the smaller of 2⁻³¹ of the distance travelled and 2⁻²⁵ of the radius; here are 2⁻²⁹ of the largest
/// coordinate of the way travelled, which is at least 1/√3 of it, and 2⁻²⁴ of the radius. A direction that is outward by the
/// rounded normal is inward in truth by no more than that is off, e < √3 2⁻²⁵, and passes the surface from e² r / 2 above it;
/// here are 2⁻⁴⁸ r.
#[inline(always)]
fn point_error(t: f32, sphere: &Sphere, ray: &Ray) -> f32 {
    const OF_DISTANCE: f32 = f32::EPSILON / 64.0;
    const OF_RADIUS: f32 = f32::EPSILON / 2.0;
    const OF_CURVATURE: f32 = f32::EPSILON * f32::EPSILON / 4.0;
    // Not `f32::max`, which takes care of NaN: here there is none.
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let Vec3 { x, y, z } = ray.direction.abs();
    let travelled = t * larger(larger(x, y), z);
    let radius = sphere.radius;
    smaller(travelled * OF_DISTANCE, radius * OF_RADIUS) + radius * OF_CURVATURE
}
