//! The contract of accuracy, on every family of cases, against exact arithmetic.
//!
//! In both precisions: no wrong decision, every root correctly rounded, and the same bits from both derivations; points, normals,
//! cut ranges, and directions scaled by powers of two.
//!
//! The long run, of more than ten million cases in each precision:
//!
//! ```text
//! EYERAY_CASES=400000 cargo test --release --test accuracy -- --nocapture --test-threads=1
//! ```

mod support;

use std::fmt::{self, Display};
use std::ops::Range;

use eyeray::{Algebraic, Geometric, Hit, Hittable, Ray, Scalar, Sphere};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use support::families::{Case, FAMILIES, Family, Rng};
use support::float::Float;
use support::oracle::{Coordinates, Root, Truth};
use support::reproduce::source;

/// Cases of a family that share a seed: the seeds are 0, 1, 2 and so on.
const CASES_PER_SEED: u64 = 1000;

/// How many ulps of 1 a coordinate of a normal may be off.
const NORMAL: f64 = 2.0;

/// A precision that cases can be made for.
trait Contract: Coordinates {
    fn generate(family: &Family, rng: &mut Rng) -> Case<Self>;
}

impl Contract for Vec3 {
    fn generate(family: &Family, rng: &mut Rng) -> Case<Self> {
        (family.f32)(rng)
    }
}

impl Contract for DVec3 {
    fn generate(family: &Family, rng: &mut Rng) -> Case<Self> {
        (family.f64)(rng)
    }
}

#[test]
fn single_precision() {
    check::<Vec3>();
}

#[test]
fn double_precision() {
    check::<DVec3>();
}

/// Cases that long runs have found, each with what had gone wrong.
#[test]
fn found_by_long_runs() {
    let bits = |bits: [u32; 3]| Vec3::from_array(bits.map(f32::from_bits));
    let cases = [
        (
            "a root beyond a tie by 1e-31 of itself, taken for the tie",
            Ray::new(
                bits([0x54b4_71e3, 0xcd8d_4000, 0x8000_0000]),
                bits([0xbc00_0000, 0x8000_0000, 0x8000_0000]),
            ),
            Sphere::new(bits([0xd4b4_71dd, 0xcde8_4000, 0xb1ca_7759]), f32::from_bits(0x4d36_8000)),
        ),
        (
            "a positive root that underflows, returned as a negative zero",
            Ray::new(bits([0x8000_0000, 0x9f14_8359, 0xb857_2ebd]), bits([0, 0, 0x52fa_a2de])),
            Sphere::new(Vec3::ZERO, f32::from_bits(0x3857_2ebd)),
        ),
    ];
    for (what, ray, sphere) in cases {
        let mut case = Examination::new(ray, sphere);
        case.roots();
        case.ranges();
        assert!(
            case.failure.is_none(),
            "{what}: {}\n{}",
            case.failure.unwrap_or_default(),
            source(&ray, &sphere)
        );
    }
}

/// Tries every family, prints a row for each, and fails with the first case of each that broke the contract.
fn check<V: Contract>() {
    let cases = match std::env::var("EYERAY_CASES") {
        Ok(cases) => cases.parse().expect("EYERAY_CASES is the number of cases of each family"),
        Err(_) => CASES_PER_SEED,
    };
    let seeds = u64::div_ceil(cases, CASES_PER_SEED);
    println!("{}", Tally::HEADER);
    let mut total = Tally::default();
    for family in FAMILIES {
        let tally = (0..seeds)
            .into_par_iter()
            .map(|seed| tally::<V>(family, seed))
            .reduce(Tally::default, Tally::and);
        println!("{:<28}{tally}", family.name);
        total = total.and(tally);
    }
    println!("{:<28}{total}", "all");
    assert!(total.failures.is_empty(), "\n{}", total.failures.join("\n\n"));
}

/// The cases of one seed.
fn tally<V: Contract>(family: &Family, seed: u64) -> Tally {
    let mut rng = Rng::new(seed);
    let mut tally = Tally::default();
    for _ in 0..CASES_PER_SEED {
        let (ray, sphere) = V::generate(family, &mut rng);
        let mut case = Examination::new(ray, sphere);
        case.roots();
        case.ranges();
        case.scaled_direction(&mut rng);
        tally = tally.and(case.tally(family, seed));
    }
    tally
}

/// What was found in some cases.
#[derive(Debug, Default)]
struct Tally {
    cases: u64,
    /// Lines that meet the sphere.
    hits: u64,
    /// Cases where a decision was wrong: hit or miss, which root, or occluded or not.
    wrong: u64,
    /// Roots that are not correctly rounded.
    misrounded: u64,
    /// Cases where the two derivations, or `Sphere`, returned different bits of a root.
    different: u64,
    /// Cases where the two derivations returned different bits of a point or a normal.
    other_points: u64,
    /// The worst errors: of a root in ulps, of a point as a part of what is promised, of a normal in ulps of 1.
    worst: Errors,
    /// The first case of each family that broke the contract.
    failures: Vec<String>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    root: f64,
    point: f64,
    normal: f64,
}

impl Errors {
    fn and(self, other: Self) -> Self {
        Self {
            root: self.root.max(other.root),
            point: self.point.max(other.point),
            normal: self.normal.max(other.normal),
        }
    }
}

impl Tally {
    const HEADER: &str = "\nfamily                         cases      hits  wrong  misrounded  different  other points  \
                          worst root in ulps, point as a part of what is promised, normal in ulps of 1";

    fn and(mut self, other: Self) -> Self {
        self.cases += other.cases;
        self.hits += other.hits;
        self.wrong += other.wrong;
        self.misrounded += other.misrounded;
        self.different += other.different;
        self.other_points += other.other_points;
        self.worst = self.worst.and(other.worst);
        for failure in other.failures {
            // Failures begin with the name of their family.
            let family = failure.lines().next().map(str::to_owned);
            if !self.failures.iter().any(|known| known.lines().next().map(str::to_owned) == family)
            {
                self.failures.push(failure);
            }
        }
        self
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            cases,
            hits,
            wrong,
            misrounded,
            different,
            other_points,
            worst: Errors { root, point, normal },
            ..
        } = self;
        write!(
            f,
            "{cases:>8}  {hits:>8}  {wrong:>5}  {misrounded:>10}  {different:>9}  {other_points:>12}  {root:.6}  {point:.4}  {normal:.4}"
        )
    }
}

/// One case, and what is found in it.
struct Examination<V: Contract> {
    ray: Ray<V>,
    sphere: Sphere<V>,
    truth: Option<Truth<V>>,
    /// The roots as a correct routine returns them.
    expected: Option<[V::Scalar; 2]>,
    /// Hits whose points and normals have been compared, with the root that they are at.
    examined: Vec<(Hit<V>, usize)>,
    worst: Errors,
    misrounded: u64,
    different: bool,
    other_points: bool,
    wrong: bool,
    failure: Option<String>,
}

impl<V: Contract> Examination<V> {
    fn new(ray: Ray<V>, sphere: Sphere<V>) -> Self {
        let truth = Truth::new(&ray, &sphere);
        let expected = truth.as_ref().map(|truth| truth.roots.each_ref().map(Root::nearest));
        Self {
            ray,
            sphere,
            truth,
            expected,
            examined: Vec::new(),
            worst: Errors::default(),
            misrounded: 0,
            different: false,
            other_points: false,
            wrong: false,
            failure: None,
        }
    }

    fn tally(self, family: &Family, seed: u64) -> Tally {
        let failure = self.failure.map(|what| {
            format!("{}\nseed {seed}: {what}\n{}", family.name, source(&self.ray, &self.sphere))
        });
        Tally {
            cases: 1,
            hits: self.truth.is_some().into(),
            wrong: self.wrong.into(),
            misrounded: self.misrounded,
            different: self.different.into(),
            other_points: self.other_points.into(),
            worst: self.worst,
            failures: failure.into_iter().collect(),
        }
    }

    fn fail(&mut self, what: impl FnOnce() -> String) {
        self.failure.get_or_insert_with(what);
    }

    fn fail_decision(&mut self, what: impl FnOnce() -> String) {
        self.wrong = true;
        self.fail(what);
    }

    /// Both derivations' roots along the whole line.
    fn roots(&mut self) {
        let algebraic = self.sphere.roots_algebraic(&self.ray);
        let geometric = self.sphere.roots_geometric(&self.ray);
        let same = match (algebraic, geometric) {
            (Some(a), Some(g)) => a[0].identical(g[0]) && a[1].identical(g[1]),
            (a, g) => a.is_none() && g.is_none(),
        };
        if !same {
            self.different = true;
            self.fail(|| format!("algebraic roots {algebraic:?}, geometric roots {geometric:?}"));
        }
        for (name, roots) in [("algebraic", algebraic), ("geometric", geometric)] {
            let Some(roots) = roots else {
                if self.truth.is_some() {
                    self.fail_decision(|| format!("{name}: no roots, but there are"));
                }
                continue;
            };
            let Some(truth) = self.truth.take() else {
                self.fail_decision(|| format!("{name}: roots {roots:?}, but there are none"));
                continue;
            };
            for (root, computed) in truth.roots.iter().zip(roots) {
                self.root(name, root, computed);
            }
            if roots[0] > roots[1] {
                self.fail_decision(|| format!("{name}: roots {roots:?} out of order"));
            }
            self.truth = Some(truth);
        }
    }

    fn root(&mut self, name: &str, root: &Root, computed: V::Scalar) {
        let nearest: V::Scalar = root.nearest();
        let correctly_rounded =
            computed.identical(nearest) || (root.is_zero() && computed == V::Scalar::ZERO);
        let error = root.error(computed);
        self.worst.root = self.worst.root.max(error);
        self.misrounded += u64::from(!correctly_rounded);
        if !correctly_rounded {
            self.fail(|| format!("{name}: root {computed:?}, {error} ulps from the exact one, nearest is {nearest:?}"));
        }
    }

    /// `intersect` and `occludes` of all three, over the whole half-line and ranges that begin or end at a root.
    fn ranges(&mut self) {
        let (zero, infinity) = (V::Scalar::ZERO, V::Scalar::INFINITY);
        let nan = V::Scalar::from_f64(f64::NAN);
        let mut ranges = vec![zero..infinity, -infinity..infinity, infinity..zero, nan..infinity];
        if let Some([near, far]) = self.expected {
            let after =
                |t: V::Scalar| V::Scalar::from_ordinal((t.ordinal() + 1).min(V::Scalar::INFINITE));
            ranges.extend([
                near..infinity,
                after(near)..infinity,
                far..infinity,
                after(far)..infinity,
            ]);
            ranges.extend([
                zero..near,
                zero..after(near),
                zero..far,
                near..far,
                after(near)..after(far),
            ]);
        }
        for range in ranges {
            let objects: [(&str, &dyn Hittable<V>); 3] = [
                ("Sphere", &self.sphere.clone()),
                ("Algebraic", &Algebraic(self.sphere)),
                ("Geometric", &Geometric(self.sphere)),
            ];
            let hits = objects.map(|(_, object)| object.intersect(&self.ray, range.clone()));
            let same = |t: Option<V::Scalar>, u: Option<V::Scalar>| match (t, u) {
                (Some(t), Some(u)) => t.identical(u),
                (t, u) => t.is_none() && u.is_none(),
            };
            let t = hits.map(|hit| hit.map(|hit| hit.t));
            if !(same(t[0], t[1]) && same(t[0], t[2])) {
                self.different = true;
                self.fail(|| {
                    format!("{range:?}: Sphere, Algebraic and Geometric differ: {hits:?}")
                });
            }
            // Nothing is promised of these: a point is computed from a root that is not rounded yet.
            self.other_points |= hits[1] != hits[2];
            for ((name, object), hit) in objects.into_iter().zip(hits) {
                self.hit(name, &range, hit);
                let occludes = object.occludes(&self.ray, range.clone());
                if occludes != hit.is_some() {
                    self.fail_decision(|| {
                        format!("{name}, {range:?}: occludes is {occludes}, intersect is {hit:?}")
                    });
                }
            }
        }
    }

    /// Compares a hit with the root that it should be: the nearest that is acceptable as it is returned.
    fn hit(&mut self, name: &str, range: &Range<V::Scalar>, hit: Option<Hit<V>>) {
        let Some((truth, expected)) = self.truth.as_ref().zip(self.expected) else {
            if hit.is_some() {
                self.fail_decision(|| format!("{name}, {range:?}: {hit:?}, but the line misses"));
            }
            return;
        };
        let acceptable = |t: &V::Scalar| *t > V::Scalar::ZERO && t.is_finite() && range.contains(t);
        let (hit, root) = match (hit, expected.iter().position(acceptable)) {
            (None, None) => return,
            (Some(hit), Some(root)) if hit.t.identical(expected[root]) => (hit, root),
            (hit, root) => {
                self.fail_decision(|| {
                    format!(
                        "{name}, {range:?}: {hit:?}, but it should be root {root:?} of {expected:?}"
                    )
                });
                return;
            }
        };
        if self.examined.contains(&(hit, root)) {
            return;
        }
        let errors = Errors {
            root: 0.0,
            point: truth.point_error(root, hit.point),
            normal: truth.normal_error(root, hit.normal),
        };
        self.examined.push((hit, root));
        self.worst = self.worst.and(errors);
        let Errors { point, normal, .. } = errors;
        if point > 1.0 || normal > NORMAL {
            self.fail(|| {
                format!(
                    "{name}, {range:?}: {hit:?}: point {point} of what is promised, normal {normal} ulps off"
                )
            });
        }
    }

    /// A direction 2^k times as long makes every t that stays a normal number 2^k times as small, exactly.
    fn scaled_direction(&mut self, rng: &mut Rng) {
        let range = i64::from(V::Scalar::DIGITS) * if rng.coin() { 1 } else { 4 };
        let exponent = rng.integer(-range, range);
        let (scale, inverse) =
            (V::Scalar::power_of_two(exponent), V::Scalar::power_of_two(-exponent));
        let direction = self.ray.direction * scale;
        if direction * inverse != self.ray.direction {
            return;
        }
        let scaled = Ray::new(self.ray.origin, direction);
        let leading = 1 << (V::Scalar::DIGITS - 1);
        let is_normal = |t: V::Scalar| t.is_finite() && t.ordinal().abs() >= leading;
        for (name, roots, scaled_roots) in [
            (
                "algebraic",
                self.sphere.roots_algebraic(&self.ray),
                self.sphere.roots_algebraic(&scaled),
            ),
            (
                "geometric",
                self.sphere.roots_geometric(&self.ray),
                self.sphere.roots_geometric(&scaled),
            ),
        ] {
            let same = match (roots, scaled_roots) {
                (Some(roots), Some(scaled_roots)) => {
                    roots.iter().zip(scaled_roots).all(|(&t, scaled_t)| {
                        !is_normal(t) || !is_normal(t * inverse) || scaled_t.identical(t * inverse)
                    })
                }
                (roots, scaled_roots) => roots.is_none() && scaled_roots.is_none(),
            };
            if !same {
                self.fail_decision(|| {
                    format!("{name}: roots {roots:?}, but {scaled_roots:?} where the direction is 2^{exponent} as long")
                });
            }
        }
    }
}
