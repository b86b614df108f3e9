//! What surfaces do with the light that meets them.

use std::f32::consts::TAU;

use eyeray::{Hit, Ray};
use glam::{Vec3, vec3};

/// What a sphere is made of.
#[derive(Clone, Copy)]
pub(crate) enum Material {
    /// Shines with that radiance in every direction, and reflects nothing.
    Lamp(Vec3),
    /// Lambert's surface of that albedo.
    Matte(Vec3),
    /// Lambert's surface of that albedo under a clear coat.
    Glossy(Vec3),
    /// `reflectance` is what comes back at normal incidence; `fuzz`, from 0 to 1, blurs the mirror.
    Metal { reflectance: Vec3, fuzz: f32 },
    /// Clear, of that index of refraction.
    Glass(f32),
}

/// Where a path goes on.
pub(crate) struct Scatter {
    pub(crate) direction: Vec3,
    /// What part of the light from there goes on along the path.
    pub(crate) weight: Vec3,
    /// Whether `direction` was drawn from Lambert's cosine law.
    pub(crate) diffuse: bool,
}

impl Material {
    /// Where the path that came along `ray` goes on from `hit`, by three random numbers in 0..1; `None` where it ends.
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
        // What the fuzz, or a rounding, sends into an opaque surface is lost there.
        hit.is_outward(direction).then_some(Scatter { direction, weight, diffuse })
    }
}

/// How much a clear coat of index 1.5 reflects at normal incidence.
const COAT: f32 = 0.04;

/// Reflected or refracted, as `choice` has it.
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

/// The unit square onto the unit sphere, areas kept.
fn on_unit_sphere(a: f32, b: f32) -> Vec3 {
    let z = 1.0 - 2.0 * a;
    let radius = (1.0 - z * z).sqrt();
    let (sine, cosine) = (TAU * b).sin_cos();
    vec3(radius * cosine, radius * sine, z)
}
