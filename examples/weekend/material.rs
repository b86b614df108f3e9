//! Materials: how surfaces reflect and refract light.

use eyeray::{Hit, Ray};
use glam::Vec3;

use crate::random::Random;

/// The material of a sphere.
#[derive(Clone, Copy)]
pub(crate) enum Material {
    /// The book's `lambertian`.
    Matte(Vec3),
    /// The book's `metal`: `fuzz`, from 0 to 1, blurs the mirror.
    Metal { albedo: Vec3, fuzz: f32 },
    /// The book's `dielectric`, of that index of refraction.
    Glass(f32),
}

impl Material {
    /// Returns the color by which the light is multiplied and the ray on which it came; `None` where it is absorbed.
    pub(crate) fn scatter(self, ray: &Ray, hit: &Hit, random: &mut Random) -> Option<(Vec3, Ray)> {
        let incoming = ray.direction.normalize();
        let from_outside = hit.front_face(ray);
        // The normal on the side that the ray comes from.
        let normal = if from_outside { hit.normal } else { -hit.normal };
        let (color, direction) = match self {
            Self::Matte(albedo) => (albedo, normal + random.on_unit_sphere()),
            Self::Metal { albedo, fuzz } => {
                (albedo, incoming.reflect(normal) + fuzz * random.on_unit_sphere())
            }
            Self::Glass(index) => {
                let ratio = if from_outside { 1.0 / index } else { index };
                let cosine = (-incoming.dot(normal)).min(1.0);
                // The zero vector where the reflection is total.
                let refracted = incoming.refract(normal, ratio);
                let reflects =
                    refracted == Vec3::ZERO || random.unit() < reflectance(cosine, ratio);
                // A refracted ray is spawned like any other: its direction says on which side of the surface it goes on.
                let direction = if reflects { incoming.reflect(normal) } else { refracted };
                return Some((Vec3::ONE, hit.spawn(direction)));
            }
        };
        // A direction below the surface, by fuzz, is absorbed.
        (direction.dot(normal) > 0.0).then(|| (color, hit.spawn(direction)))
    }
}

/// Schlick's approximation to the reflectance of glass.
fn reflectance(cosine: f32, ratio: f32) -> f32 {
    let at_normal = ((1.0 - ratio) / (1.0 + ratio)).powi(2);
    at_normal + (1.0 - at_normal) * (1.0 - cosine).powi(5)
}
