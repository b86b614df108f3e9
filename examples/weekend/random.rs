//! Random numbers.

use std::f32::consts::TAU;

use glam::{Vec3, vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng as _, SeedableRng};

/// A generator of random numbers, the same from the same seed.
pub(crate) struct Random(Pcg32);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    /// Returns a number from 0 to 1, 1 excluded.
    #[expect(clippy::cast_precision_loss, reason = "24 bits are what an f32 can hold")]
    pub(crate) fn unit(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 / (1 << 24) as f32
    }

    /// Returns a number from `low` to `high`.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Returns a color whose three components are from `low` to `high`.
    pub(crate) fn color(&mut self, low: f32, high: f32) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.between(low, high)))
    }

    /// Returns a point of the unit sphere.
    pub(crate) fn on_unit_sphere(&mut self) -> Vec3 {
        let z = self.between(-1.0, 1.0);
        let (sine, cosine) = (TAU * self.unit()).sin_cos();
        let around = (1.0 - z * z).sqrt();
        vec3(around * cosine, around * sine, z)
    }

    /// Returns a point of the unit disk.
    pub(crate) fn in_unit_disk(&mut self) -> [f32; 2] {
        let radius = self.unit().sqrt();
        let (sine, cosine) = (TAU * self.unit()).sin_cos();
        [radius * cosine, radius * sine]
    }
}
