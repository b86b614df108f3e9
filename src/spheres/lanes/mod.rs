//! The machine's lanes: runs a loop that the compiler vectorizes with the widest instructions that are there.
//!
//! Each set of instructions is a type. A value of it is the proof that the machine has them: where that must be found out, only
//! finding out makes one. So the `unsafe` that remains is in [`avx2`] and [`avx512`], each of which keeps that promise to
//! itself: to call a function compiled for these instructions, and to collect signs with one of them, which no loop compiles
//! to. The feature `bytemuck` aside, nothing else in the crate is `unsafe`.

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx2;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx512;
mod instructions;

#[cfg(test)]
use core::fmt;

use glam::Vec4;

pub(crate) use instructions::{Instructions, LANES, Vectorized};
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use {avx2::Avx2, avx512::Avx512};

/// A set of instructions that this machine has.
#[derive(Clone, Copy)]
pub(crate) struct Lanes(Set);

#[derive(Clone, Copy)]
enum Set {
    Compiled(Compiled),
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx2(Avx2),
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx512(Avx512),
}

impl Lanes {
    /// All that this machine has, the best last.
    #[cfg(test)]
    pub(crate) fn available() -> impl Iterator<Item = Self> {
        [
            Some(Self(Set::Compiled(Compiled))),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Avx2::detect().map(|avx2| Self(Set::Avx2(avx2))),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Avx512::detect().map(|avx512| Self(Set::Avx512(avx512))),
        ]
        .into_iter()
        .flatten()
    }

    /// The best that this machine has. To measure the others, `--cfg eyeray_lanes="avx2"` in RUSTFLAGS leaves out what is better
    /// than AVX2, and `--cfg eyeray_lanes="compiled"` all that the crate is not compiled for.
    #[inline(always)]
    pub(crate) fn best() -> Self {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if !cfg!(eyeray_lanes = "compiled") {
            if !cfg!(eyeray_lanes = "avx2") {
                if let Some(avx512) = Avx512::detect() {
                    return Self(Set::Avx512(avx512));
                }
            }
            if let Some(avx2) = Avx2::detect() {
                return Self(Set::Avx2(avx2));
            }
        }
        Self(Set::Compiled(Compiled))
    }

    /// How many numbers one of its vectors holds.
    pub(crate) fn at_a_time(self) -> usize {
        match self.0 {
            Set::Compiled(_) => 4,
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx2(_) => 8,
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx512(_) => 16,
        }
    }

    /// Runs the loop with this set of instructions.
    #[inline(always)]
    pub(crate) fn run<F: Vectorized>(self, f: F) -> F::Output {
        match self.0 {
            Set::Compiled(compiled) => compiled.run(f),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx2(avx2) => avx2.run(f),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx512(avx512) => avx512.run(f),
        }
    }
}

#[cfg(test)]
impl fmt::Debug for Lanes {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self.0 {
            Set::Compiled(_) => "Compiled",
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx2(_) => "AVX2",
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Set::Avx512(_) => "AVX-512",
        })
    }
}

/// What the crate is compiled for: at least SSE2 on x86-64, NEON on aarch64.
#[derive(Clone, Copy)]
pub(crate) struct Compiled;

impl Compiled {
    // Like those of the others, not inlined: a loop that shares its function with other code may get the vectors that it keeps
    // saved and restored.
    #[inline(never)]
    fn run<F: Vectorized>(self, f: F) -> F::Output {
        f.run(self)
    }
}

impl Instructions for Compiled {
    #[inline(always)]
    fn multiply_add(self, a: f32, b: f32, c: f32) -> f32 {
        #[cfg(all(feature = "std", any(target_arch = "aarch64", target_feature = "fma")))]
        let sum = a.mul_add(b, c);
        #[cfg(not(all(feature = "std", any(target_arch = "aarch64", target_feature = "fma"))))]
        let sum = a * b + c;
        sum
    }

    #[inline(always)]
    fn signs(self, numbers: &[f32; LANES]) -> u32 {
        let four = |first: usize| Vec4::from_slice(&numbers[first..]).is_negative_bitmask();
        four(0) | four(4) << 4 | four(8) << 8 | four(12) << 12
    }
}
