//! The random numbers of the path tracer.

/// The random numbers of one path: an Owen-scrambled Sobol sequence, which spreads the paths of a pixel evenly.
///
/// They depend on the pixel and the sample alone, so the picture is the same on any number of cores.
pub(crate) struct Sampler {
    sample: u32,
    seed: u32,
}

impl Sampler {
    pub(crate) fn new([x, y]: [u16; 2], sample: u16) -> Self {
        let pixel = u32::from(y) << 16 | u32::from(x);
        // An odd multiplier gives every pixel a seed of its own, far from its neighbors'.
        Self { sample: sample.into(), seed: pixel.wrapping_mul(0x9e37_79b1) }
    }

    /// Four more numbers in 0..1, independent of those before.
    pub(crate) fn draw(&mut self) -> [f32; 4] {
        self.seed = self.seed.wrapping_add(1);
        sobol_burley::sample_4d(self.sample, 0, self.seed)
    }
}
