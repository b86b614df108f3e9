//! AVX2 with FMA: 8 lanes.

use core::arch::x86_64::{
    _mm_movemask_epi8, _mm_packs_epi16, _mm_shuffle_epi32, _mm256_castsi256_si128,
    _mm256_extracti128_si256, _mm256_loadu_si256, _mm256_packs_epi32,
};
use std::arch::is_x86_feature_detected;

use super::instructions::{Instructions, LANES, Vectorized};

/// The machine has AVX2 and FMA.
#[derive(Clone, Copy)]
pub(super) struct Avx2(());

impl Avx2 {
    #[inline(always)]
    pub(super) fn detect() -> Option<Self> {
        (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")).then_some(Self(()))
    }

    #[inline(always)]
    pub(super) fn run<F: Vectorized>(self, f: F) -> F::Output {
        #[expect(unsafe_code, reason = "the machine has what the function is compiled for")]
        // SAFETY: `detect`, which alone makes a `Self`, has seen both AVX2 and FMA.
        unsafe {
            run(self, f)
        }
    }
}

#[target_feature(enable = "avx2,fma")]
#[inline(never)]
#[expect(unsafe_code, reason = "before Rust 1.86, no function of other instructions is safe")]
unsafe fn run<F: Vectorized>(avx2: Avx2, f: F) -> F::Output {
    f.run(avx2)
}

impl Instructions for Avx2 {
    #[inline(always)]
    fn multiply_add(self, a: f32, b: f32, c: f32) -> f32 {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn signs(self, numbers: &[f32; LANES]) -> u32 {
        // The two vectors are packed to bytes, which keeps signs, but takes the halves of each in turns.
        const IN_ORDER: i32 = 0b11_01_10_00;
        let (low, high) = numbers.split_at(LANES / 2);
        #[expect(unsafe_code, reason = "the machine has these instructions")]
        // SAFETY: `detect`, which alone makes a `Self`, has seen AVX2, and each half holds the 8 numbers that are loaded.
        let signs = unsafe {
            let packed = _mm256_packs_epi32(
                _mm256_loadu_si256(low.as_ptr().cast()),
                _mm256_loadu_si256(high.as_ptr().cast()),
            );
            let packed = _mm_packs_epi16(
                _mm256_castsi256_si128(packed),
                _mm256_extracti128_si256::<1>(packed),
            );
            _mm_movemask_epi8(_mm_shuffle_epi32::<IN_ORDER>(packed))
        };
        #[expect(clippy::cast_sign_loss, reason = "they are 16 bits")]
        let signs = signs as u32;
        signs
    }
}
