//! The published methods of ray-sphere intersection, each as its source states it.
//!
//! One definition serves both precisions: `methods::single` and `methods::double`. With `o = c - p`, the roots are those of
//! `a t² - 2 h t + c = 0`, where `a = d·d`, `h = d·o` and `c = o·o - r²`; they come ascending.
#![allow(dead_code, unreachable_pub, reason = "each benchmark takes what it needs")]

use eyeray::Ray;
use glam::{Vec2, Vec3};

/// The nearest hit with what shading needs.
#[derive(Clone, Copy, Debug)]
pub struct Shading<V, S> {
    pub t: S,
    pub point: V,
    pub normal: V,
}

macro_rules! methods {
    ($module:ident, $vector:ident, $float:ident) => {
        pub mod $module {
            use eyeray::{Ray, Sphere};
            use glam::$vector;

            use super::Shading;

            type Roots = Option<[$float; 2]>;

            /// The first root ahead, of both along the line.
            #[inline(always)]
            pub fn ahead(roots: Roots) -> Option<$float> {
                let [near, far] = roots?;
                if near > 0.0 {
                    Some(near)
                } else if far > 0.0 {
                    Some(far)
                } else {
                    None
                }
            }

            /// The lecture's algebraic form, which is every textbook's: S. Marschner, CS4620 lecture 6, *Ray Tracing
            /// Basics*.
            #[inline(always)]
            pub fn textbook(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let o = sphere.center - ray.origin;
                let a = ray.direction.dot(ray.direction);
                let h = ray.direction.dot(o);
                let c = o.dot(o) - sphere.radius * sphere.radius;
                let discriminant = h * h - a * c;
                if discriminant < 0.0 {
                    return None;
                }
                let root = discriminant.sqrt();
                Some([(h - root) / a, (h + root) / a])
            }

            /// The textbook's nearest hit with what shading needs: the point on the ray, and the normal from it.
            #[inline(always)]
            pub fn textbook_shading(
                ray: &Ray<$vector>,
                sphere: &Sphere<$vector>,
            ) -> Option<Shading<$vector, $float>> {
                let t = ahead(textbook(ray, sphere))?;
                let point = ray.at(t);
                Some(Shading { t, point, normal: (point - sphere.center) / sphere.radius })
            }

            /// The lecture's geometric form: the closest approach along the direction, normalized first, and half a chord
            /// to either side. The same source.
            #[inline(always)]
            pub fn geometric(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let length = ray.direction.length();
                let unit = ray.direction / length;
                let p = ray.origin - sphere.center;
                let t_m = -p.dot(unit);
                let l_m_squared = p.dot(p) - t_m * t_m;
                let radius_squared = sphere.radius * sphere.radius;
                if l_m_squared > radius_squared {
                    return None;
                }
                let half_chord = (radius_squared - l_m_squared).sqrt();
                Some([(t_m - half_chord) / length, (t_m + half_chord) / length])
            }

            /// The quadratic without the cancellation in its roots: W. Press et al., *Numerical Recipes*, §5.6.
            #[inline(always)]
            pub fn stable(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let o = sphere.center - ray.origin;
                let a = ray.direction.dot(ray.direction);
                let h = ray.direction.dot(o);
                let c = o.dot(o) - sphere.radius * sphere.radius;
                let discriminant = h * h - a * c;
                if discriminant < 0.0 {
                    return None;
                }
                let q = h + discriminant.sqrt().copysign(h);
                Some(ascending(c / q, q / a, q))
            }

            /// The discriminant from the closest approach, and the stable quadratic: E. Haines, J. Günther, T.
            /// Akenine-Möller, *Precision Improvements for Ray/Sphere Intersection*, Ray Tracing Gems, chapter 7.
            #[inline(always)]
            pub fn haines(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let f = ray.origin - sphere.center;
                let a = ray.direction.dot(ray.direction);
                let b = -f.dot(ray.direction);
                let radius_squared = sphere.radius * sphere.radius;
                let closest = f + ray.direction * (b / a);
                let discriminant = radius_squared - closest.dot(closest);
                if discriminant < 0.0 {
                    return None;
                }
                let c = f.dot(f) - radius_squared;
                let q = b + (a * discriminant).sqrt().copysign(b);
                Some(ascending(c / q, q / a, q))
            }

            /// The same with the discriminant as a product, (r + l)(r - l): M. Pharr, W. Jakob, G. Humphreys, *Physically
            /// Based Rendering*, 4th edition, §6.8.3. Theirs has intervals for its coefficients; these are plain numbers.
            #[inline(always)]
            pub fn pbrt(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let o = ray.origin - sphere.center;
                let a = ray.direction.dot(ray.direction);
                let b = 2.0 * ray.direction.dot(o);
                let c = o.dot(o) - sphere.radius * sphere.radius;
                let length = (o - ray.direction * (b / (2.0 * a))).length();
                let discriminant = 4.0 * a * (sphere.radius + length) * (sphere.radius - length);
                if discriminant < 0.0 {
                    return None;
                }
                let q = -0.5 * (b + discriminant.sqrt().copysign(b));
                Some(ascending(c / q, q / a, q))
            }

            /// The closest approach with a reciprocal: Embree 4, `kernels/geometry/sphere_intersector.h`.
            #[inline(always)]
            pub fn embree(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Roots {
                let inverse = 1.0 / ray.direction.dot(ray.direction);
                let o = sphere.center - ray.origin;
                let t_m = o.dot(ray.direction) * inverse;
                let perpendicular = o - ray.direction * t_m;
                let l_squared = perpendicular.dot(perpendicular);
                let radius_squared = sphere.radius * sphere.radius;
                if l_squared > radius_squared {
                    return None;
                }
                let half_chord = ((radius_squared - l_squared) * inverse).sqrt();
                Some([t_m - half_chord, t_m + half_chord])
            }

            /// The nearest hit by the textbook's formula with an early way out behind: parry3d 0.31,
            /// `query/ray/ray_ball.rs`, for a hollow ball.
            #[inline(always)]
            pub fn parry_nearest(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Option<$float> {
                let p = ray.origin - sphere.center;
                let a = ray.direction.dot(ray.direction);
                let b = p.dot(ray.direction);
                let c = p.dot(p) - sphere.radius * sphere.radius;
                if c > 0.0 && b > 0.0 {
                    return None;
                }
                let discriminant = b * b - a * c;
                if discriminant < 0.0 {
                    return None;
                }
                let root = discriminant.sqrt();
                let near = (-b - root) / a;
                Some(if near > 0.0 { near } else { (-b + root) / a })
            }

            /// The roots c/q, the nearer to zero, and q/a, in order along the ray.
            #[inline(always)]
            fn ascending(smaller: $float, larger: $float, q: $float) -> [$float; 2] {
                if q > 0.0 { [smaller, larger] } else { [larger, smaller] }
            }
        }
    };
}

methods!(single, Vec3, f32);
methods!(double, DVec3, f64);

/// The textbook's orthographic eye ray through (u, v): p = e + u U + v V, d = -W. S. Marschner, CS4620 lecture 6.
#[inline(always)]
pub fn orthographic_ray(eye: Vec3, [u, v, w]: [Vec3; 3], uv: Vec2) -> Ray {
    Ray::new(eye + uv.x * u + uv.y * v, -w)
}

/// The textbook's perspective eye ray through (u, v): p = e, d = u U + v V - s W. The same source.
#[inline(always)]
pub fn perspective_ray(eye: Vec3, [u, v, w]: [Vec3; 3], distance: f32, uv: Vec2) -> Ray {
    Ray::new(eye, uv.x * u + uv.y * v - distance * w)
}
