//! The cloud, and the rays through it: random, and the same in every run.

use std::f32::consts::{PI, TAU};

use eyeray::{Camera, CameraError, Hit, Ray, Sphere};
use glam::{Vec3, vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng as _, SeedableRng};

/// The cloud fills a cube around the world's origin, so far in each direction.
const REACH: f32 = 1000.0;

/// `count` spheres anywhere in the cube, and so overlapping now and then, the largest 4 times as large as the smallest.
///
/// On average, 2 of them are in the way of a ray straight through the cube, however many there are, so that all clouds are
/// equally opaque: of n spheres a volume, with a mean cross section of π r², a ray meets n π r² a length.
#[expect(clippy::cast_precision_loss, reason = "a radius need not be exact")]
pub(crate) fn spheres(count: usize) -> Vec<Sphere> {
    const EDGE: f32 = 2.0 * REACH;
    const IN_THE_WAY: f32 = 2.0;
    /// Of a factor evenly distributed from 0.4 to 1.6.
    const MEAN_SQUARE: f32 = 1.12;

    let a_volume = count as f32 / EDGE.powi(3);
    let radius = (IN_THE_WAY / EDGE / (a_volume * PI * MEAN_SQUARE)).sqrt();
    let mut random = Random::new(1);
    (0..count)
        .map(|_| {
            let center = [(); 3].map(|()| random.between(-REACH, REACH));
            Sphere::new(center.into(), radius * random.between(0.4, 1.6))
        })
        .collect()
}

/// `count` eye rays, in tiles of 64, through a square image that the cloud about fills.
pub(crate) fn eye_rays(count: u32) -> Result<Vec<Ray>, CameraError> {
    let eye = vec3(1500.0, 1000.0, 3500.0);
    let camera = Camera::perspective_fov(eye, Vec3::ZERO, Vec3::Y, 0.75, 1.0)?;
    // Rounded up, so that there are enough pixels, in tiles that are all whole.
    let side = (count.isqrt() + 1).next_multiple_of(8);
    let rays = camera.tiles(side, side, 8).flat_map(|tile| tile.rays());
    Ok(rays.take(count as usize).collect())
}

/// `count` rays, of unit direction, that leave the matte surfaces where the eye rays met them.
pub(crate) fn bounce_rays(hits: &[Hit], count: u32) -> Vec<Ray> {
    let mut random = Random::new(2);
    hits.iter()
        .cycle()
        .take(count as usize)
        .map(|hit| {
            // Lambert's law: towards any point of a unit sphere that rests on the surface.
            let (z, angle) = (random.between(-1.0, 1.0), random.between(0.0, TAU));
            let around = (1.0 - z * z).sqrt();
            let direction = hit.normal + vec3(around * angle.cos(), around * angle.sin(), z);
            hit.spawn(direction.normalize_or(hit.normal))
        })
        .collect()
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
}
