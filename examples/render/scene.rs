//! The scene and its cameras: the spheres of Aras Pranckevičius's benchmark `ToyPathTracer`, at dusk.

use std::f32::consts::TAU;

use eyeray::{Camera, CameraError, Sphere, Spheres, ViewRect};
use glam::{Vec3, vec3};

use crate::material::Material::{self, Glass, Glossy, Lamp, Matte, Metal};

/// The spheres and their materials, in the same order.
pub(crate) struct Scene {
    pub(crate) spheres: Spheres,
    pub(crate) materials: Vec<Material>,
}

impl Scene {
    pub(crate) fn new() -> Self {
        let mut scene = Self { spheres: Spheres::new(), materials: Vec::new() };
        scene.add(vec3(0.0, -100.5, -1.0), 100.0, Matte(vec3(0.55, 0.5, 0.45)));

        let (red, amber, teal) =
            (vec3(0.75, 0.12, 0.1), vec3(0.8, 0.45, 0.1), vec3(0.05, 0.4, 0.35));
        let silver = Metal { reflectance: vec3(0.9, 0.9, 0.92), fuzz: 0.0 };
        let gold = Metal { reflectance: vec3(0.98, 0.72, 0.32), fuzz: 0.0 };
        scene.add(vec3(-2.0, 0.0, 1.0), 0.5, Glossy(red));
        scene.add(vec3(0.0, 0.0, 1.0), 0.5, Glass(1.5));
        scene.add(vec3(2.0, 0.0, 1.0), 0.5, gold);
        scene.add(vec3(-2.0, 0.0, -1.0), 0.5, silver);
        scene.add(vec3(0.0, 0.0, -1.0), 0.5, Glossy(amber));
        scene.add(vec3(2.0, 0.0, -1.0), 0.5, Glossy(teal));
        scene.add(vec3(0.5, 1.0, 0.5), 0.5, Glass(1.5));

        scene.add(vec3(-1.5, 1.5, 0.0), 0.3, Lamp(vec3(9.5, 5.5, 2.4)));
        scene.add(vec3(1.5, 1.5, -2.0), 0.3, Lamp(vec3(1.6, 4.0, 10.0)));

        for (row, z) in [-3.0, -4.0, -5.0, -6.0].into_iter().enumerate() {
            for column in 0..9_u8 {
                let x = 4.0 - f32::from(column);
                let color = hue(0.5 - x / 8.0);
                // The farther the row, the duller its metal.
                let material = match (row + usize::from(column)) % 3 {
                    0 => Glossy(color),
                    1 => Metal { reflectance: 0.4 + 0.6 * color, fuzz: -0.1 * (z + 2.5) },
                    _ => Matte(color),
                };
                scene.add(vec3(x, 0.0, z), 0.5, material);
            }
        }
        scene
    }

    fn add(&mut self, center: Vec3, radius: f32, material: Material) {
        self.spheres.push(Sphere::new(center, radius));
        self.materials.push(material);
    }

    /// The lamps, each with its radiance.
    pub(crate) fn lamps(&self) -> impl Iterator<Item = (Sphere, Vec3)> {
        self.spheres.iter().zip(&self.materials).filter_map(|(sphere, material)| match material {
            Lamp(radiance) => Some((sphere, *radiance)),
            _ => None,
        })
    }
}

/// The radiance of the sky: the glow of dusk over the horizon, blue overhead.
pub(crate) fn sky(direction: Vec3) -> Vec3 {
    // The ground is a sphere, and its horizon lies below the level of the eye.
    let height = (0.25 + direction.normalize().y).clamp(0.0, 1.0);
    vec3(0.06, 0.09, 0.19) + vec3(0.9, 0.4, 0.1) * (1.0 - height).powi(7)
}

/// A color from violet at 0, over green, to red at 1.
fn hue(across: f32) -> Vec3 {
    let wave =
        |phase: f32| 0.04 + 0.8 * (0.5 + 0.5 * (TAU * (0.75 * across + phase)).cos()).powf(1.5);
    vec3(wave(0.25), wave(0.6), wave(0.95))
}

/// Which camera looks at the scene.
#[derive(Clone, Copy)]
pub(crate) enum View {
    Perspective,
    Orthographic,
}

impl View {
    pub(crate) fn camera(self, width: u16, height: u16) -> Result<Camera, CameraError> {
        let aspect = f32::from(width) / f32::from(height);
        match self {
            Self::Perspective => {
                let (eye, target) = (vec3(1.0, 2.2, 5.3), vec3(0.05, 0.33, -1.2));
                Camera::perspective_fov(eye, target, Vec3::Y, 37_f32.to_radians(), aspect)
            }
            Self::Orthographic => {
                let (eye, target) = (vec3(2.0, 5.0, 6.5), vec3(0.0, 0.0, -2.3));
                let (right, top) = (2.9 * aspect, 2.9);
                let view = ViewRect { left: -right, right, bottom: -top, top };
                Camera::orthographic(eye, target, Vec3::Y, view)
            }
        }
    }
}
