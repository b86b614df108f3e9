//! Every bit that eyeray returns for the cases of the accuracy tests, in a digest a family: on all machines the same.
#![no_std]

#[path = "../../../support/families.rs"]
mod families;
#[cfg(feature = "alloc")]
mod spheres;

use core::fmt;
use core::hash::Hasher;

use eyeray::{Algebraic, Geometric, Hit, Hittable, Scalar, Vector};
use families::{Case, FAMILIES, Rng};
use fnv::FnvHasher;
use glam::{DVec3, Vec3};

#[cfg(feature = "alloc")]
pub use spheres::assert_spheres_find_the_same;

/// The cases of each family, in each precision.
const CASES: u32 = 2_000;

/// Writes a line for every family and precision: the digest of the cases, that of the results, and how many are hits.
/// The last line is the digest of all the results.
///
/// # Errors
/// Those of `out`.
pub fn report(out: &mut impl fmt::Write) -> fmt::Result {
    let mut all = FnvHasher::default();
    for family in FAMILIES {
        let single = run(family.f32);
        let double = run(family.f64);
        for (precision, digests) in [("f32", single), ("f64", double)] {
            let Digests { cases, results, hits } = digests;
            writeln!(out, "{precision} {cases:016x} {results:016x} {hits:4} {}", family.name)?;
            all.write(&results.to_le_bytes());
        }
    }
    writeln!(out, "{:016x}", all.finish())
}

/// What became of one family in one precision.
struct Digests {
    /// The digest of the rays and spheres.
    cases: u64,
    /// The digest of what the routines returned for them.
    results: u64,
    /// How many of the rays hit.
    hits: u32,
}

fn run<V: Vector + Bits>(case: fn(&mut Rng) -> Case<V>) -> Digests
where
    V::Scalar: Bits,
{
    let mut rng = Rng::new(1);
    let mut cases = FnvHasher::default();
    let mut results = FnvHasher::default();
    let mut hits = 0;
    for _ in 0..CASES {
        let (ray, sphere) = case(&mut rng);
        [ray.origin, ray.direction, sphere.center].digest(&mut cases);
        sphere.radius.digest(&mut cases);

        sphere.roots_algebraic(&ray).digest(&mut results);
        sphere.roots_geometric(&ray).digest(&mut results);
        let range = V::Scalar::ZERO..V::Scalar::INFINITY;
        Algebraic(sphere).intersect(&ray, range.clone()).digest(&mut results);
        Geometric(sphere).intersect(&ray, range.clone()).digest(&mut results);
        let hit = sphere.intersect(&ray, range.clone());
        hit.digest(&mut results);
        hits += u32::from(hit.is_some());
        results.write_u8(sphere.occludes(&ray, range).into());
    }
    Digests { cases: cases.finish(), results: results.finish(), hits }
}

/// A value whose bits go into a digest.
trait Bits {
    fn digest(&self, digest: &mut FnvHasher);
}

macro_rules! float {
    ($float:ty) => {
        impl Bits for $float {
            fn digest(&self, digest: &mut FnvHasher) {
                // Only the cases have NaNs. Which bits a NaN has may change on its way through a register.
                let value = if self.is_nan() { <$float>::NAN } else { *self };
                digest.write(&value.to_bits().to_le_bytes());
            }
        }
    };
}

float!(f32);
float!(f64);

macro_rules! vector {
    ($vector:ty) => {
        impl Bits for $vector {
            fn digest(&self, digest: &mut FnvHasher) {
                self.to_array().digest(digest);
            }
        }
    };
}

vector!(Vec3);
vector!(DVec3);

impl<T: Bits, const N: usize> Bits for [T; N] {
    fn digest(&self, digest: &mut FnvHasher) {
        for value in self {
            value.digest(digest);
        }
    }
}

impl<T: Bits> Bits for Option<T> {
    fn digest(&self, digest: &mut FnvHasher) {
        digest.write_u8(self.is_some().into());
        if let Some(value) = self {
            value.digest(digest);
        }
    }
}

impl<V: Vector + Bits> Bits for Hit<V>
where
    V::Scalar: Bits,
{
    fn digest(&self, digest: &mut FnvHasher) {
        self.t.digest(digest);
        [self.point, self.normal].digest(digest);
        [self.spawn(self.normal).origin, self.spawn(-self.normal).origin].digest(digest);
    }
}
