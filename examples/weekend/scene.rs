//! The spheres of the final scene, and their materials.

use eyeray::Sphere;
use glam::{Vec3, vec3};

use crate::material::Material;
use crate::random::Random;

/// The scene: sphere i has material i.
pub(crate) struct Scene {
    pub(crate) spheres: Vec<Sphere>,
    pub(crate) materials: Vec<Material>,
}

impl Scene {
    pub(crate) fn new() -> Self {
        let mut scene = Self { spheres: Vec::new(), materials: Vec::new() };
        let mut random = Random::new(1);

        scene.add(vec3(0.0, -1000.0, 0.0), 1000.0, Material::Matte(Vec3::splat(0.5)));
        for a in -11..11_i16 {
            for b in -11..11_i16 {
                let [x, z] = [a, b].map(|cell| f32::from(cell) + 0.9 * random.unit());
                let center = vec3(x, 0.2, z);
                let material = small_material(&mut random);
                if center.distance(vec3(4.0, 0.2, 0.0)) > 0.9 {
                    scene.add(center, 0.2, material);
                }
            }
        }
        scene.add(vec3(0.0, 1.0, 0.0), 1.0, Material::Glass(1.5));
        scene.add(vec3(-4.0, 1.0, 0.0), 1.0, Material::Matte(vec3(0.4, 0.2, 0.1)));
        let metal = Material::Metal { albedo: vec3(0.7, 0.6, 0.5), fuzz: 0.0 };
        scene.add(vec3(4.0, 1.0, 0.0), 1.0, metal);
        scene
    }

    fn add(&mut self, center: Vec3, radius: f32, material: Material) {
        self.spheres.push(Sphere::new(center, radius));
        self.materials.push(material);
    }
}

/// A random material of a small sphere: four in five are matte, and one in twenty is glass.
fn small_material(random: &mut Random) -> Material {
    match random.unit() {
        ..0.8 => Material::Matte(random.color(0.0, 1.0) * random.color(0.0, 1.0)),
        ..0.95 => {
            Material::Metal { albedo: random.color(0.5, 1.0), fuzz: random.between(0.0, 0.5) }
        }
        _ => Material::Glass(1.5),
    }
}
