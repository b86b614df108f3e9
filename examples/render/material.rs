//! Materials: how surfaces reflect and refract light.

use std::f32::consts::TAU;

use eyeray::{Hit, Ray};
use glam::{Vec3, vec3};

/// The material of a sphere.
#[derive(Clone, Copy)]
pub(crate) enum Material {
    /// A lamp: emits that radiance in every direction, and reflects nothing.
    Lamp(Vec3),
    /// A matte (Lambertian) surface with that albedo.
    Matte(Vec3),
    /// A matte surface with that albedo under a clear coat.
    Glossy(Vec3),
    /// A metal, with its reflectance at normal incidence; `fuzz`, from 0 to 1, blurs the reflection.
    Metal { reflectance: Vec3, fuzz: f32 },
    /// A clear material with that index of refraction.
    Glass(f32),
}

/// The continuation of a path.
pub(crate) struct Scatter {
    pub(crate) direction: Vec3,
    /// The part of the light from there that is scattered along the path.
    pub(crate) weight: Vec3,
    /// Whether `direction` was drawn from Lambert's cosine law.
    pub(crate) diffuse: bool,
}

impl Material {
    /// Returns the continuation from `hit` of the path that came along `ray`, by three random numbers in 0..1; `None` where it
    /// ends.
    pub(crate) fn scatter(
        &self,
        ray: &Ray,
        hit: &Hit,
        [a, b, choice]: [f32; 3],
    ) -> Option<Scatter> {
        let incoming = ray.direction.normalize();
        let mirrored = incoming.reflect(hit.normal);
        let cosine = -incoming.dot(hit.normal);
        let (direction, weight, diffuse) = match *self {
            Self::Lamp(_) => return None,
            Self::Glossy(_) if choice < schlick(COAT, cosine) => (mirrored, Vec3::ONE, false),
            Self::Matte(albedo) | Self::Glossy(albedo) => {
                (hit.normal + on_unit_sphere(a, b), albedo, true)
            }
            Self::Metal { reflectance, fuzz } => {
                let weight = reflectance + (1.0 - reflectance) * schlick(0.0, cosine);
                (mirrored + fuzz * on_unit_sphere(a, b), weight, false)
            }
            Self::Glass(index) => {
                let direction = through_glass(incoming, hit, hit.front_face(ray), index, choice);
                return Some(Scatter { direction, weight: Vec3::ONE, diffuse: false });
            }
        };
        // A direction into the opaque surface, by fuzz or by rounding, is absorbed.
        hit.is_outward(direction).then_some(Scatter { direction, weight, diffuse })
    }
}

/// The reflectance of a clear coat of index 1.5 at normal incidence.
const COAT: f32 = 0.04;

/// Returns the reflected or the refracted direction, as the random number `choice` decides.
fn through_glass(incoming: Vec3, hit: &Hit, entering: bool, index: f32, choice: f32) -> Vec3 {
    let (normal, ratio) = if entering { (hit.normal, 1.0 / index) } else { (-hit.normal, index) };
    // Zero where the reflection is total.
    let refracted = incoming.refract(normal, ratio);
    // Schlick's angle is the one in the air.
    let cosine = -normal.dot(if entering { incoming } else { refracted });
    let at_normal = ((1.0 - index) / (1.0 + index)).powi(2);
    if choice < schlick(at_normal, cosine) { incoming.reflect(normal) } else { refracted }
}

/// Schlick's approximation to Fresnel's reflectance, from that at normal incidence.
fn schlick(at_normal: f32, cosine: f32) -> f32 {
    at_normal + (1.0 - at_normal) * (1.0 - cosine.clamp(0.0, 1.0)).powi(5)
}

/// Maps the unit square to the unit sphere, preserving areas.
fn on_unit_sphere(a: f32, b: f32) -> Vec3 {
    let z = 1.0 - 2.0 * a;
    let radius = (1.0 - z * z).sqrt();
    let (sine, cosine) = (TAU * b).sin_cos();
    vec3(radius * cosine, radius * sine, z)
}
