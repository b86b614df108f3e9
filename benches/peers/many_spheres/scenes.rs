//! The scenes.

use std::f32::consts::TAU;

use eyeray::{Hit, Ray, Sphere, SphereBvh};
use glam::{Vec3, vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng as _, SeedableRng};

/// Spheres of which every seed gives others.
pub struct Scene {
    pub name: &'static str,
    pub spheres: fn(u64) -> Vec<Sphere>,
}

macro_rules! scenes {
    ($($name:literal: $spheres:expr),+ $(,)?) => {
        /// All of them.
        pub const SCENES: &[Scene] = &[$(Scene { name: $name, spheres: $spheres }),+];
    };
}

scenes! {
    "cloud of 100": |seed| cloud(seed, 100),
    "cloud of 1,000": |seed| cloud(seed, 1_000),
    "cloud of 10,000": |seed| cloud(seed, 10_000),
    "cloud of 100,000": |seed| cloud(seed, 100_000),
    "cloud of 1,000,000": |seed| cloud(seed, 1_000_000),
    "ground and 10,000": ground,
    "100 clusters of 100": clusters,
    "three decades of radii": decades,
    "chain of 50,000 atoms": chain,
    "galaxy of 200,000": galaxy,
    "shell of 30,000": shell,
    "cloud of 20": |seed| cloud(seed, 20),
    "cloud of 64": |seed| cloud(seed, 64),
    "cloud of 65": |seed| cloud(seed, 65),
    "cloud of 128": |seed| cloud(seed, 128),
    "cloud of 300": |seed| cloud(seed, 300),
    "cloud of 5,000": |seed| cloud(seed, 5_000),
    "cloud of 70,000": |seed| cloud(seed, 70_000),
}

struct Random(Pcg32);

impl Random {
    fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    #[expect(clippy::cast_precision_loss, reason = "24 bits are what an f32 can hold")]
    fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.0.next_u32() >> 8) as f32 / (1 << 24) as f32;
        low + (high - low) * unit
    }

    /// Anywhere in the cube that reaches from `-reach` to `reach`.
    fn in_cube(&mut self, reach: f32) -> Vec3 {
        Vec3::from([(); 3].map(|()| self.between(-reach, reach)))
    }

    fn unit_vector(&mut self) -> Vec3 {
        let (z, angle) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let around = (1.0 - z * z).sqrt();
        vec3(around * angle.cos(), around * angle.sin(), z)
    }

    /// The sum of a dozen evenly distributed numbers: nearly normally distributed, with a deviation of 1.
    fn normal(&mut self) -> Vec3 {
        (0..12).map(|_| self.in_cube(0.5)).sum()
    }
}

/// Spheres anywhere in a cube, of which about 2 are in the way of a ray straight through it, however many there are.
#[expect(clippy::cast_precision_loss, reason = "a radius need not be exact")]
fn cloud(seed: u64, count: usize) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let radius = 1000.0 * (1.6 / (count as f32 * std::f32::consts::PI * 1.12)).sqrt() * 1.6;
    (0..count)
        .map(|_| Sphere::new(random.in_cube(1000.0), radius * random.between(0.4, 1.6)))
        .collect()
}

/// Small spheres on a ground of radius 10,000.
fn ground(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let ground = Sphere::new(vec3(0.0, -1e4, 0.0), 1e4);
    let small = (0..10_000).map(|_| {
        let radius = random.between(0.1, 0.4);
        let around = vec3(random.between(-60.0, 60.0), 0.0, random.between(-60.0, 60.0));
        let up = (around - ground.center).normalize();
        Sphere::new(ground.center + up * (ground.radius + radius), radius)
    });
    std::iter::once(ground).chain(small).collect()
}

/// 100 clusters of 100 spheres.
fn clusters(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let mut spheres = Vec::new();
    for _ in 0..100 {
        let (center, size) = (random.in_cube(1000.0), random.between(20.0, 60.0));
        for _ in 0..100 {
            let radius = size * random.between(0.08, 0.25);
            spheres.push(Sphere::new(center + random.normal() * size, radius));
        }
    }
    spheres
}

/// 20,000 spheres in a cube, their radii over three decades, the logarithm evenly distributed.
fn decades(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    (0..20_000)
        .map(|_| Sphere::new(random.in_cube(1000.0), 0.15 * 10_f32.powf(random.between(0.0, 3.0))))
        .collect()
}

/// A folded chain of overlapping atoms, as a protein has: a random walk that turns back into a ball.
fn chain(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let mut place = Vec3::ZERO;
    let mut direction = Vec3::X;
    let mut spheres = Vec::new();
    for _ in 0..50_000 {
        let home = -place / 60.0;
        direction =
            (direction + random.unit_vector() * 0.9 + home * home.length() * 0.5).normalize();
        place += direction * 1.4;
        spheres.push(Sphere::new(place, random.between(1.2, 1.9)));
    }
    spheres
}

/// A flat disc, dense in its middle.
fn galaxy(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    (0..200_000)
        .map(|_| {
            let (angle, distance) =
                (random.between(0.0, TAU), random.between(0.0, 1.0).powi(2) * 1000.0);
            let height = random.normal().x * (4.0 + 40.0 * (-distance / 150.0).exp());
            let center = vec3(distance * angle.cos(), height, distance * angle.sin());
            Sphere::new(center, random.between(0.2, 2.0))
        })
        .collect()
}

/// Spheres on a sphere, as a sculpture is scanned.
fn shell(seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    (0..30_000)
        .map(|_| {
            Sphere::new(
                random.unit_vector() * random.between(99.0, 101.0),
                random.between(0.5, 1.5),
            )
        })
        .collect()
}

/// The least and the largest coordinates of nine in ten of the centers, so that a ground does not count.
pub fn extent(spheres: &[Sphere]) -> [Vec3; 2] {
    let mut low = [0.0; 3];
    let mut high = [0.0; 3];
    for axis in 0..3 {
        let mut coordinates: Vec<f32> = spheres.iter().map(|sphere| sphere.center[axis]).collect();
        coordinates.sort_by(f32::total_cmp);
        let outside = coordinates.len() / 20;
        (low[axis], high[axis]) =
            (coordinates[outside], coordinates[coordinates.len() - 1 - outside]);
    }
    [low.into(), high.into()]
}

/// Eye rays and bounce rays, in turns.
pub fn rays(spheres: &[Sphere], hierarchy: &SphereBvh, count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random::new(seed + 1000);
    let [low, high] = extent(spheres);
    let (middle, extent) = (low.midpoint(high), high - low);
    let mut bounced = Vec::new();
    let mut eye = Vec::new();
    let mut tries = 0;
    let eyes: Vec<Vec3> = (0..8)
        .map(|_| {
            let mut toward = random.unit_vector();
            toward.y = toward.y.abs() + 0.1;
            middle + toward.normalize() * extent.max_element() * 1.5
        })
        .collect();
    let mut hits: Vec<Hit> = Vec::new();
    while eye.len() < count.div_ceil(2) {
        let from = eyes[eye.len() * 8 / count.div_ceil(2)];
        let to = middle + random.in_cube(0.5) * extent;
        let ray = Ray::new(from, to - from);
        if let Some((_, hit)) = hierarchy.nearest(&ray, 0.0..f32::INFINITY) {
            hits.push(hit);
        }
        eye.push(ray);
        tries += 1;
        if tries > 100 * count {
            break;
        }
    }
    for hit in hits.iter().cycle().take(eye.len()) {
        bounced.push(hit.spawn((hit.normal + random.unit_vector()).normalize_or(hit.normal)));
    }
    eye.into_iter().zip(bounced).flat_map(|(eye, bounced)| [eye, bounced]).collect()
}
