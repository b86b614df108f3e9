//! What is asked of a set of instructions, and of a loop that is compiled for it.

/// How many numbers a loop works on at a time: four vectors of SSE2 or NEON, two of AVX2, one of AVX-512.
pub(crate) const LANES: usize = 16;

/// A set of instructions, and what a loop cannot say by itself.
pub(crate) trait Instructions: Copy {
    /// `a b + c`, rounded once where the machine has an instruction for it.
    fn multiply_add(self, a: f32, b: f32, c: f32) -> f32;

    /// A bit for each number whose sign is set.
    fn signs(self, numbers: &[f32; LANES]) -> u32;
}

/// A loop for the compiler to vectorize. `run` must be inlined always, to be compiled anew for each set of instructions.
pub(crate) trait Vectorized {
    /// What it computes: the same for each set of instructions.
    type Output;

    /// Runs it.
    fn run<I: Instructions>(self, instructions: I) -> Self::Output;
}
