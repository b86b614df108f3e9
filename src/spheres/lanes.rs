//! The machine's lanes: runs a loop that the compiler vectorizes with the widest instructions that are there.
//!
//! The call of a function compiled for more instructions is `unsafe`: it takes the promise that the machine has them. Until
//! Rust 1.86, so is even to declare such a function. The feature `bytemuck` aside, nothing else in the crate is.

/// A loop for the compiler to vectorize. `run` must be inlined always, to be compiled anew for each set of instructions.
pub(crate) trait Vectorized {
    /// What it computes: the same for each set of instructions.
    type Output;

    /// Runs it; `FUSED` where the machine has a fused multiply-add.
    fn run<const FUSED: bool>(&self) -> Self::Output;
}

/// A set of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lanes {
    /// What the crate is compiled for: at least SSE2 on x86-64, NEON on aarch64.
    Compiled,
    /// AVX2 with FMA.
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx2,
}

impl Lanes {
    /// All that this machine has, the best last.
    pub fn available() -> impl Iterator<Item = Self> {
        [
            Some(Self::Compiled),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            has_avx2().then_some(Self::Avx2),
        ]
        .into_iter()
        .flatten()
    }

    /// The best that this machine has.
    #[inline(always)]
    pub(crate) fn best() -> Self {
        #[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx512f")))]
        if has_avx2() {
            return Self::Avx2;
        }
        Self::Compiled
    }

    /// Runs the loop with this set of instructions, or with what the crate is compiled for if the machine lacks it.
    #[cfg_attr(
        not(all(feature = "std", target_arch = "x86_64")),
        expect(clippy::unused_self, reason = "there is one set of instructions only")
    )]
    #[inline(always)]
    pub(crate) fn run<F: Vectorized>(self, f: &F) -> F::Output {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if self == Self::Avx2 && has_avx2() {
            #[expect(unsafe_code, reason = "the machine has what the function is compiled for")]
            // SAFETY: has_avx2() says that both AVX2 and FMA are there.
            return unsafe { run_avx2(f) };
        }
        run_compiled(f)
    }
}

// Neither is inlined: a loop that shares its function with other code may get the vectors that it keeps saved and restored.
#[inline(never)]
fn run_compiled<F: Vectorized>(f: &F) -> F::Output {
    f.run::<{ cfg!(any(target_arch = "aarch64", target_feature = "fma")) }>()
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
fn has_avx2() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
#[inline(never)]
#[expect(unsafe_code, reason = "Rust 1.85 has no safe functions of other instructions")]
unsafe fn run_avx2<F: Vectorized>(f: &F) -> F::Output {
    f.run::<true>()
}
