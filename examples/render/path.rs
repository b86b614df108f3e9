//! The path tracer: the light that arrives along a ray.

use std::f32::consts::{PI, TAU};

use eyeray::{Hit, Hittable, Ray, Sphere};
use glam::Vec3;

use crate::material::Material;
use crate::sampler::Sampler;
use crate::scene::{Scene, sky};

/// An unbiased estimate of the radiance that arrives along `ray`, from its nearest hit and the index of that sphere.
pub(crate) fn radiance(
    scene: &Scene,
    mut ray: Ray,
    mut found: Option<(usize, Hit)>,
    sampler: &mut Sampler,
) -> Vec3 {
    let mut radiance = Vec3::ZERO;
    let mut throughput = Vec3::ONE;
    // A diffuse surface asks every lamp for its light: met by chance as well, that light would count twice.
    let mut lamps_counted = false;
    for bounce in 0.. {
        let Some((index, hit)) = found else {
            radiance += throughput * sky(ray.direction);
            break;
        };
        let material = scene.materials[index];
        if let Material::Lamp(emitted) = material {
            if !lamps_counted {
                radiance += throughput * emitted;
            }
            break;
        }
        let [a, b, choice, roulette] = sampler.draw();
        let Some(scatter) = material.scatter(&ray, &hit, [a, b, choice]) else { break };
        throughput *= scatter.weight;
        if scatter.diffuse {
            radiance += throughput / PI * lamplight(scene, &hit, sampler);
        }
        lamps_counted = scatter.diffuse;

        // Russian roulette: faint paths end early, and those that go on make up for them.
        if bounce >= 3 {
            let survival = throughput.max_element().min(0.95);
            if roulette >= survival {
                break;
            }
            throughput /= survival;
        }
        ray = hit.spawn(scatter.direction);
        found = scene.spheres.nearest(&ray, 0.0..f32::INFINITY);
    }
    radiance
}

/// An estimate of the irradiance at `hit` from the lamps in sight, by a shadow ray to each.
fn lamplight(scene: &Scene, hit: &Hit, sampler: &mut Sampler) -> Vec3 {
    let mut irradiance = Vec3::ZERO;
    for (lamp, emitted) in scene.lamps() {
        let [a, b, ..] = sampler.draw();
        let (direction, solid_angle) = toward(&lamp, hit.point, a, b);
        let cosine = direction.dot(hit.normal);
        if cosine <= 0.0 {
            continue;
        }
        let shadow_ray = hit.spawn(direction);
        // The range excludes its end, the very distance at which the scene finds the lamp: no lamp is in its own way.
        let in_sight = lamp
            .intersect(&shadow_ray, 0.0..f32::INFINITY)
            .is_some_and(|at_lamp| !scene.spheres.occludes(&shadow_ray, 0.0..at_lamp.t));
        if in_sight {
            irradiance += emitted * (cosine * solid_angle);
        }
    }
    irradiance
}

/// A direction drawn evenly from the cone in which `point` sees `sphere` from outside, and the cone's solid angle.
fn toward(sphere: &Sphere, point: Vec3, a: f32, b: f32) -> (Vec3, f32) {
    let to_center = sphere.center - point;
    let sine_squared = sphere.radius * sphere.radius / to_center.length_squared();
    // 1 - cosine of the half-angle, without the cancellation.
    let cap = sine_squared / (1.0 + (1.0 - sine_squared).sqrt());
    let height = a * cap;
    let radius = (height * (2.0 - height)).sqrt();
    let (sine, cosine) = (TAU * b).sin_cos();
    let w = to_center.normalize();
    let (u, v) = w.any_orthonormal_pair();
    ((1.0 - height) * w + radius * (cosine * u + sine * v), TAU * cap)
}
