//! AVX-512: 16 lanes. Rust has it since 1.89; before, no machine is said to have it.

pub(super) use implementation::Avx512;

#[rustversion::since(1.89)]
mod implementation {
    use core::arch::x86_64::{_mm512_cmplt_epi32_mask, _mm512_loadu_si512, _mm512_setzero_si512};
    use std::arch::is_x86_feature_detected;

    use crate::spheres::lanes::instructions::{Instructions, LANES, Vectorized};

    /// The machine has the foundation of AVX-512, which is enough.
    #[derive(Clone, Copy)]
    pub(in crate::spheres) struct Avx512(());

    impl Avx512 {
        #[inline(always)]
        pub(in crate::spheres) fn detect() -> Option<Self> {
            is_x86_feature_detected!("avx512f").then_some(Self(()))
        }

        #[inline(always)]
        pub(in crate::spheres) fn run<F: Vectorized>(self, f: F) -> F::Output {
            #[expect(unsafe_code, reason = "the machine has what the function is compiled for")]
            // SAFETY: `detect`, which alone makes a `Self`, has seen AVX-512.
            unsafe {
                run(self, f)
            }
        }
    }

    #[target_feature(enable = "avx512f")]
    #[inline(never)]
    #[expect(unsafe_code, reason = "before Rust 1.86, no function of other instructions is safe")]
    unsafe fn run<F: Vectorized>(avx512: Avx512, f: F) -> F::Output {
        f.run(avx512)
    }

    impl Instructions for Avx512 {
        #[inline(always)]
        fn multiply_add(self, a: f32, b: f32, c: f32) -> f32 {
            a.mul_add(b, c)
        }

        #[inline(always)]
        fn signs(self, numbers: &[f32; LANES]) -> u32 {
            #[expect(unsafe_code, reason = "the machine has these instructions")]
            // SAFETY: `detect`, which alone makes a `Self`, has seen AVX-512, and there are the 16 numbers that are loaded.
            let signs = unsafe {
                let numbers = _mm512_loadu_si512(numbers.as_ptr().cast());
                _mm512_cmplt_epi32_mask(numbers, _mm512_setzero_si512())
            };
            signs.into()
        }
    }
}

#[rustversion::before(1.89)]
mod implementation {
    use crate::spheres::lanes::instructions::Vectorized;

    /// There is none.
    #[derive(Clone, Copy)]
    pub(in crate::spheres) enum Avx512 {}

    impl Avx512 {
        #[inline(always)]
        pub(in crate::spheres) fn detect() -> Option<Self> {
            None
        }

        #[inline(always)]
        pub(in crate::spheres) fn run<F: Vectorized>(self, _: F) -> F::Output {
            match self {}
        }
    }
}
