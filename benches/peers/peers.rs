//! Speed against error of the crates that a Rust user would take instead, through their public functions: the families, the
//! oracle and the measures of `speed_vs_error`.
//!
//! ```text
//! cargo bench --manifest-path benches/peers/Cargo.toml                  # in about a minute
//! cargo bench --manifest-path benches/peers/Cargo.toml -- --quick       # for a first impression, in some seconds
//! ```
//!
//! What a crate does not promise is counted apart, neither right nor wrong: a root ahead for a ray that starts inside, or
//! a direction that it would have as a unit vector and that cannot be normalized. Making a crate's own types from a ray and
//! a sphere is part of its time. The report goes to `benches/peers/target/peers/`.

use std::io;

use bevy_math::{Dir3A, Vec3A};
use bevy_shape::{BoundingSphere, RayCast3d};
use cgmath::{BaseFloat, Point3};
use collision::{Continuous, Ray3};
use eyeray::{Hittable, Ray, Sphere};
use glam::{DVec3, Vec3};
use simple_vectors::Vector;

mod decisions;
#[path = "../measure/mod.rs"]
mod measure;
#[path = "../methods/mod.rs"]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::comparison::Comparisons;
use measure::{Kind, Method, Start, Test, Timed, report};

/// Cases of a family in f32 and in f64.
const ACCURACY_CASES: [usize; 2] = [200_000, 100_000];

/// Cases of a family on which decisions are compared.
const DECIDED_CASES: usize = 100_000;

macro_rules! shared_peers {
    ($module:ident, $methods:ident, $parry:ident, $vector:ident, $float:ident) => {
        mod $module {
            use super::*;

            const ALL: std::ops::Range<$float> = 0.0..$float::INFINITY;

            /// The ray that a parry3d shape in its own frame asks for.
            #[inline(always)]
            pub fn local_ray(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> $parry::query::Ray {
                let origin = ray.origin - sphere.center;
                $parry::query::Ray::new(origin.to_array().into(), ray.direction.to_array().into())
            }

            #[inline(always)]
            fn parry(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Option<$float> {
                use $parry::query::RayCast;
                let ball = $parry::shape::Ball::new(sphere.radius);
                ball.cast_local_ray(&local_ray(ray, sphere), $float::MAX, false)
            }

            #[inline(always)]
            fn collide_ray(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Option<$float> {
                let vector = |v: $vector| Vector::<$float, 3>::from(v.to_array());
                collide_ray::Ray::new(vector(ray.origin), vector(ray.direction))
                    .intersect_sphere(vector(sphere.center), sphere.radius)
                    .map(|(t, _)| t)
            }

            #[inline(always)]
            fn collision_point(
                ray: &Ray<$vector>,
                sphere: &Sphere<$vector>,
            ) -> Option<($vector, $float)> {
                let length = ray.direction.length();
                let unit = ray.direction / length;
                let point = collision_point_of(
                    ray.origin.to_array(),
                    unit.to_array(),
                    sphere.center.to_array(),
                    sphere.radius,
                )?;
                Some(($vector::from_array(point), length))
            }

            /// The distance along the ray to the point that collision gives.
            fn collision(ray: &Ray<$vector>, sphere: &Sphere<$vector>) -> Option<$float> {
                let (point, _) = collision_point(ray, sphere)?;
                let [from, along] = [point - ray.origin, ray.direction];
                Some(from.dot(along) / along.dot(along))
            }

            pub fn ours_and_shared() -> Vec<Method<$vector>> {
                use methods::$methods::{ahead, textbook};

                vec![
                    Method::new(
                        "textbook",
                        "the lecture's algebraic form, to compare with",
                        Kind::Plain,
                        |ray, sphere| ahead(textbook(ray, sphere)),
                    ),
                    Method::new("eyeray", "`Sphere::intersect`", Kind::Eyeray, |ray, sphere| {
                        sphere.intersect(ray, ALL).map(|hit| hit.t)
                    }),
                    Method::new(
                        "parry3d",
                        "0.31 (for f64: parry3d-f64), `Ball::cast_local_ray`, hollow",
                        Kind::Plain,
                        parry,
                    ),
                    Method::new(
                        "collision",
                        "0.20, `Continuous` of its `Sphere` and `Ray3`. Wants a unit direction, which is made as part of the \
                         time, and an origin outside. It gives a point: t is taken from that by projection, untimed",
                        Kind::Plain,
                        collision,
                    )
                    .promising(|(ray, _), start| {
                        start == Start::Outside && ray.direction.try_normalize().is_some()
                    })
                    .timed_by(Test::new(collision_point)),
                    Method::new(
                        "collide-ray",
                        "0.3, `Ray::intersect_sphere`. It takes t = 0 for a hit: an origin on the surface is counted apart",
                        Kind::Plain,
                        collide_ray,
                    )
                    .promising(|_, start| start != Start::OnTheSurface),
                ]
            }

            pub fn compare(comparisons: &mut Comparisons) {
                use $parry::query::RayCast;
                use $parry::shape::Ball;

                let name = |what: &str| format!("{}: {what}", stringify!($float));
                let ours = Test::new(|ray: &Ray<$vector>, sphere: &Sphere<$vector>| {
                    sphere.intersect(ray, ALL).map(|hit| hit.t)
                });
                let theirs = ("parry3d, cast_local_ray", &Test::new(parry) as &dyn Timed<_>);
                comparisons.compare(&name("nearest root"), "", &ours, theirs);

                let ours = Test::new(|ray: &Ray<$vector>, sphere: &Sphere<$vector>| {
                    sphere.intersect(ray, ALL)
                });
                let theirs = Test::new(|ray, sphere: &Sphere<$vector>| {
                    let ball = Ball::new(sphere.radius);
                    ball.cast_local_ray_and_get_normal(&local_ray(ray, sphere), $float::MAX, false)
                });
                let theirs =
                    ("parry3d, cast_local_ray_and_get_normal", &theirs as &dyn Timed<_>);
                let at_most = if stringify!($float) == "f32" { "1" } else { "" };
                comparisons.compare(&name("point and normal"), at_most, &ours, theirs);
            }

            pub fn compare_decisions(effort: Effort) -> String {
                let line = Test::new(|ray: &Ray<$vector>, sphere: &Sphere<$vector>| {
                    sphere.roots_algebraic(ray).is_some().then_some(())
                });
                let ray = Test::new(|ray: &Ray<$vector>, sphere: &Sphere<$vector>| {
                    sphere.occludes(ray, ALL).then_some(())
                });
                decisions::compare(&line, &ray, DECIDED_CASES, effort)
            }
        }
    };
}

shared_peers!(single, single, parry3d, Vec3, f32);
shared_peers!(double, double, parry3d_f64, DVec3, f64);

/// The point where collision has the ray meet the sphere.
#[inline(always)]
fn collision_point_of<S: BaseFloat>(
    origin: [S; 3],
    unit: [S; 3],
    center: [S; 3],
    radius: S,
) -> Option<[S; 3]> {
    let sphere = collision::Sphere { center: Point3::from(center), radius };
    sphere.intersection(&Ray3::new(Point3::from(origin), unit.into())).map(Into::into)
}

#[inline(always)]
fn bevy(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let vector = |v: Vec3| Vec3A::from_array(v.to_array());
    let (direction, length) = Dir3A::new_and_length(vector(ray.direction)).ok()?;
    RayCast3d::new(vector(ray.origin), direction, f32::MAX)
        .sphere_intersection_at(&BoundingSphere::new(vector(sphere.center), sphere.radius))
        .map(|distance| distance / length)
}

#[inline(always)]
fn fyrox(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let vector = |v: Vec3| nalgebra::Vector3::from(v.to_array());
    fyrox_math::ray::Ray::new(vector(ray.origin), vector(ray.direction))
        .sphere_intersection(&vector(sphere.center), sphere.radius)
        .and_then(|roots| methods::single::ahead(Some([roots.min, roots.max])))
}

fn peers_f32() -> Vec<Method<Vec3>> {
    let mut methods = single::ours_and_shared();
    methods.extend([
        Method::new(
            "bevy_math",
            "0.20, `RayCast3d` against `BoundingSphere`. Wants a unit direction, which is made as part of the time, and \
             answers 0 for an origin inside or on the surface",
            Kind::Plain,
            bevy,
        )
        .promising(|(ray, _), start| {
            let direction = Vec3A::from_array(ray.direction.to_array());
            start == Start::Outside && Dir3A::new(direction).is_ok()
        }),
        Method::new(
            "fyrox-math",
            "1.0, `Ray::sphere_intersection`. It gives both roots along the line: the first above 0 is taken",
            Kind::Plain,
            fyrox,
        ),
    ]);
    methods
}

fn main() -> io::Result<()> {
    let arguments = Arguments::read("peers");
    let effort = arguments.effort;
    let mut comparisons = Comparisons::new(effort);
    single::compare(&mut comparisons);
    double::compare(&mut comparisons);
    let decisions = [single::compare_decisions(effort), double::compare_decisions(effort)];

    let progress = report::progress(2);
    let [cases_f32, cases_f64] = ACCURACY_CASES;
    let parts = [
        report::measure(&peers_f32(), None, cases_f32, effort, &progress),
        report::measure(&double::ours_and_shared(), None, cases_f64, effort, &progress),
    ];
    progress.finish_and_clear();
    let introduction = format!(
        "By `cargo bench --manifest-path benches/peers/Cargo.toml`.\n\nOn easy cases, branches predicted:\n\n{comparisons}\n\
CGAL's `do_intersect` of a sphere and a line or a ray, by its kernels of exact predicates, with inexact constructions and \
with exact ones: it decides only, and gives no root. Wrong decisions in a million, where there are any, and nanoseconds with \
branches predicted; beside `roots_algebraic` and `occludes`. Both kernels decide about a line in f32 exactly; the inexact \
one rounds the square of an f64 radius and the point that it makes of a ray's direction.\n\n{}",
        decisions.join("\n")
    );
    report::publish("peers", &introduction, &parts, arguments, None)
}
