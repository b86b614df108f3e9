//! `f64`: the plain step, a correction of its root, and one rounding.

use core::ops::Range;

use glam::DVec3;

use super::answer::{Found, Question};
use super::ask_carefully;
use super::chord::Derivation;
use super::format::Format;
use super::halves;
use super::line::{Line, Setting};
use super::near_surface::from_the_surface;
use super::plain::{self, Both, Nearest};
use super::precision::Precision;
use crate::{Hit, Ray, Sphere};

#[cfg(test)]
pub(super) mod tests;

/// The nearest hit where the plain step is in doubt: from close to the surface by a finer power.
#[cold]
#[inline(never)]
fn nearest_again(line: &Line, range: Range<f64>) -> Option<Found> {
    if !Format::F64.has_few_steps() {
        if let Some(nearest) = from_the_surface(*line, Format::F64, &range) {
            return nearest;
        }
    }
    ask_carefully(line, Format::F64, &Question::Nearest(range))?.nearest()
}

impl Precision for DVec3 {
    #[inline(always)]
    fn intersect<D: Derivation>(
        sphere: &Sphere<Self>,
        ray: &Ray<Self>,
        range: Range<f64>,
    ) -> Option<Hit<Self>> {
        let setting = Setting::new(sphere, ray);
        let line = setting.line;
        if let Some(chord) = setting.safe_chord::<D>() {
            match plain::nearest_ahead(&chord, setting.radius_squared, halves::CLEAR, || None) {
                Nearest::Miss => return None,
                Nearest::Root { t, half_chord } => {
                    let size = setting.radius_squared * setting.larger(&chord);
                    let correction = setting.correction(&chord);
                    let (mut t, mut is_far) = (t, half_chord < 0.0);
                    let half_chord = half_chord.abs();
                    // One copy of the code for both roots.
                    while let Some(root) = correction.correct_surely(t, half_chord, size) {
                        let t_rounded = root.t.hi;
                        if t_rounded >= range.start {
                            return (t_rounded < range.end).then(|| {
                                let normal = root.offset() / line.radius;
                                hit(line, t_rounded, root.point(), normal)
                            });
                        }
                        if is_far {
                            return None;
                        }
                        // Where the near root is below the range, the far one may be in it.
                        (t, is_far) = (plain::far_root(&chord, half_chord), true);
                    }
                }
                Nearest::Doubt => {}
            }
        }
        let found = nearest_again(&Line::new(sphere, ray), range)?;
        Some(hit(line, found.t, found.point, found.normal))
    }

    fn exit_at_same_t(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<Hit<Self>> {
        let line = Line::new(sphere, ray);
        let found = ask_carefully(&line, Format::F64, &Question::Exit)?.nearest()?;
        Some(hit(line, found.t, found.point, found.normal))
    }

    #[inline(always)]
    fn roots<D: Derivation>(sphere: &Sphere<Self>, ray: &Ray<Self>) -> Option<[f64; 2]> {
        let setting = Setting::new(sphere, ray);
        if let Some(chord) = setting.safe_chord::<D>() {
            match plain::both(&chord, setting.radius_squared, halves::CLEAR, || None) {
                Both::Miss => return None,
                Both::Roots { t: [near, far], half_chord } => {
                    let correction = setting.correction(&chord);
                    let size = setting.radius_squared * setting.larger(&chord);
                    let near = correction.correct_surely(near, half_chord, size);
                    let far = correction.correct_surely(far, half_chord, size);
                    if let (Some(near), Some(far)) = (near, far) {
                        return Some([near.t.hi, far.t.hi]);
                    }
                }
                Both::Doubt => {}
            }
        }
        ask_carefully(&Line::new(sphere, ray), Format::F64, &Question::Both)?.roots()
    }
}

/// The hit.
#[inline(always)]
fn hit(line: Line, t: f64, point: DVec3, normal: DVec3) -> Hit<DVec3> {
    Hit { t, point, normal, error: point_error(t, line) }
}

/// How far off the point may be besides the rounding of its coordinates, and more: see [`Hit::clearance`].
///
/// As for `f32`, where the point may be off by the smaller of 2⁻⁶⁰ of the distance travelled and 2⁻⁵³ of the radius, and the
/// normal by e < √3 2⁻⁵².
#[inline(always)]
fn point_error(t: f64, line: Line) -> f64 {
    const OF_DISTANCE: f64 = f64::EPSILON / 64.0;
    const OF_RADIUS: f64 = f64::EPSILON;
    const OF_CURVATURE: f64 = 2.0 * f64::EPSILON * f64::EPSILON;
    // Not `f64::max`, which takes care of NaN: here there is none.
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    let DVec3 { x, y, z } = line.direction.abs();
    let travelled = t * larger(larger(x, y), z);
    smaller(travelled * OF_DISTANCE, line.radius * OF_RADIUS) + line.radius * OF_CURVATURE
}
