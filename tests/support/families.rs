//! Families of rays and spheres: one for each way in which an intersection routine can go wrong.
//!
//! The same seed gives the same bits on every machine: the generators add, subtract, multiply, divide and take square
//! roots in IEEE arithmetic, and move bits. They need neither `std` nor `alloc`, only glam, `libm::sqrt` and `rand_pcg`,
//! so that benchmarks and programs for bare metal can include this file by its path.
//!
//! ```ignore
//! for family in FAMILIES {
//!     let mut rng = Rng::new(1);
//!     let (ray, sphere) = (family.f32)(&mut rng);
//! }
//! ```
#![allow(
    dead_code,
    unreachable_pub,
    reason = "shared by several programs, each of which takes what it needs"
)]

use eyeray::{Ray, Scalar, Sphere, Vector};
use glam::{DVec3, Vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng as _, SeedableRng};

/// A generator of cases of one kind, in both precisions.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// A short name, for the row of a table.
    pub name: &'static str,
    /// What the cases are.
    pub description: &'static str,
    /// The next case in single precision.
    pub f32: fn(&mut Rng) -> Case<Vec3>,
    /// The next case in double precision.
    pub f64: fn(&mut Rng) -> Case<DVec3>,
}

/// A ray and the sphere it may meet.
pub type Case<V> = (Ray<V>, Sphere<V>);

/// The family of that generator, for both precisions.
macro_rules! family {
    ($name:literal, $generator:ident, $description:literal) => {
        Family {
            name: $name,
            description: $description,
            f32: $generator::<Vec3>,
            f64: $generator::<DVec3>,
        }
    };
}

/// Every family. Where a description names two ranges, the second is that of double precision.
pub const FAMILIES: &[Family] = &[
    family!("easy", easy, "unit sphere at 2 to 10"),
    family!("far", far, "distance/radius 1e2 to 1e4"),
    family!("very far", very_far, "distance/radius 1e4 to 1e7"),
    family!("farthest", farthest, "distance/radius 1e7 to 1e8; to 1e15"),
    family!("huge", huge, "radius 1e3 to 1e6; origin 0.1 to 10 above the surface"),
    family!("hugest", hugest, "the same with a radius of 1e6 to 1e7; to 1e12"),
    family!("grazing", grazing, "within 1e-8 to 1e-3 of the limb"),
    family!("at the limb", at_the_limb, "within 1e-10 to 1e-8 of the limb; from 1e-17"),
    family!(
        "grazing from afar",
        grazing_from_afar,
        "within 1e-8 to 1e-3 of the limb, 1e2 to 1e5 away"
    ),
    family!(
        "at the limb from afar",
        at_the_limb_from_afar,
        "within 1e-10 to 1e-8 of the limb, 1e2 to 1e6 away; from 1e-17, to 1e9"
    ),
    family!(
        "planet's limb",
        planets_limb,
        "within 100 km of the limb of a planet, in meters, seen from an orbit at 200 to 2,000 km"
    ),
    family!("on the surface", on_the_surface, "origin on the surface, as near as floats get"),
    family!(
        "on the surface, exactly",
        exactly_on_the_surface,
        "origin an exact point of the surface: c = 0"
    ),
    family!("inside", inside, "origin inside the sphere"),
    family!("behind", behind, "the line meets the sphere behind the origin"),
    family!("axis-parallel", axis_parallel, "direction along an axis, coordinates with few digits"),
    family!("direction length", direction_length, "direction length 1e-8 to 1e8"),
    family!(
        "extreme direction length",
        extreme_direction_length,
        "direction length 1e-30 to 1e30; 1e-300 to 1e300"
    ),
    family!("scene scale", scene_scale, "scenes scaled by 1e-18 to 1e18; 1e-300 to 1e300"),
    family!(
        "far from the world's origin",
        far_from_world_origin,
        "center at 1e3 to 1e6 from zero; to 1e12"
    ),
    family!("tiny", tiny, "radius 1e-6 to 1e-3 at distance 1"),
    family!("tiniest", tiniest, "radius 1e-8 to 1e-6 at distance 1; from 1e-12"),
    family!("exact tangent", exact_tangent, "integer frames whose discriminant is exactly 0"),
    family!(
        "tangent's neighbor",
        tangent_neighbor,
        "an exact tangent with one coordinate an ulp off"
    ),
    family!(
        "near tangent",
        near_tangent,
        "an exact tangent moved by 1e-30 to 1e-6 of the radius; from 1e-290"
    ),
    family!("exact tie", exact_tie, "a root exactly midway between two floats"),
    family!("near tie", near_tie, "a root closer to midway than any fixed precision tells"),
    family!(
        "near tie beside the axis",
        near_tie_beside_the_axis,
        "the center moved from an exact tie by 1e-12 to 1e-1 of the radius"
    ),
    family!(
        "tie of a tiny sphere",
        tie_of_a_tiny_sphere,
        "radius of half an ulp of the distance, or beside that tie"
    ),
    family!(
        "hard to round",
        hard_to_round,
        "a root near midway between two f32, of random coordinates"
    ),
    family!(
        "point sphere",
        point_sphere,
        "radius 0, the line exactly through the center or an ulp off"
    ),
    family!("subnormal", subnormal, "coordinates of a few bits above the smallest subnormal"),
    family!("near overflow", near_overflow, "coordinates up to the largest float"),
    family!("coefficients, narrow", coefficients_narrow, "quadratics over 2^±32; 2^±256"),
    family!("coefficients, wide", coefficients_wide, "quadratics over 2^±70; 2^±560"),
    family!("coefficients, widest", coefficients_widest, "quadratics over 2^±126; 2^±1022"),
    family!("random bits", random_bits, "any bit patterns, NaN and infinities too"),
    family!("random finite bits", random_finite_bits, "any finite bit patterns"),
];

/// Deterministic random numbers.
#[derive(Clone, Debug)]
pub struct Rng(Pcg32);

impl Rng {
    /// The sequence of that seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg32::seed_from_u64(seed))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Heads or tails.
    pub fn coin(&mut self) -> bool {
        self.bits() >> 63 == 1
    }

    /// 1 or -1.
    pub fn sign(&mut self) -> f64 {
        if self.coin() { 1.0 } else { -1.0 }
    }

    /// An integer below `end`, uniformly but for a bias of `end` / 2^64.
    pub fn below(&mut self, end: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(end)) >> 64) as u64
    }

    /// An integer of `low..=high`, uniformly.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        low.wrapping_add_unsigned(self.below(low.abs_diff(high) + 1))
    }

    /// A number of `low..high`, uniformly.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 * f64::EPSILON * 0.5;
        low + (high - low) * unit
    }

    /// A positive number of `low..high`, log-uniformly but for a uniform mantissa: every float between is as likely.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        f64::from_bits(low.to_bits() + self.below(high.to_bits() - low.to_bits()))
    }

    /// A power of two with its exponent in `low..=high`.
    pub fn power_of_two(&mut self, low: i32, high: i32) -> f64 {
        two_to(self.integer(low.into(), high.into()))
    }

    /// A unit vector, uniformly over the sphere.
    pub fn unit_vector(&mut self) -> DVec3 {
        loop {
            let v = DVec3::new(
                self.uniform(-1.0, 1.0),
                self.uniform(-1.0, 1.0),
                self.uniform(-1.0, 1.0),
            );
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// A unit vector perpendicular to a given one, uniformly.
    pub fn perpendicular(&mut self, unit: DVec3) -> DVec3 {
        loop {
            let v = unit.cross(self.unit_vector());
            if v.length_squared() > 0.01 {
                return v.normalize();
            }
        }
    }

    /// How far from the center, in radii, a line through a random point of a disk around the sphere passes. The disk has
    /// twice the area of the sphere's, so that half of the lines hit.
    pub fn limb_fraction(&mut self) -> f64 {
        let (x, y) = (self.uniform(0.0, 1.0), self.uniform(0.0, 1.0));
        core::f64::consts::SQRT_2 * x.max(y)
    }

    /// 0, 1 or 2.
    fn index(&mut self) -> usize {
        match self.below(3) {
            0 => 0,
            1 => 1,
            _ => 2,
        }
    }

    /// A vector of integers of `low..=high`.
    fn integers(&mut self, low: i64, high: i64) -> DVec3 {
        let [x, y, z] = [(); 3].map(|()| integral(self.integer(low, high)));
        DVec3::new(x, y, z)
    }
}

/// What the generators need of a precision.
pub trait Precision: Vector {
    /// The largest finite value.
    const MAX: f64;
    /// The smallest positive value.
    const SMALLEST: f64;
    /// The bits of a mantissa.
    const DIGITS: u32;
    /// The exponents between which a coefficient family places its lengths.
    const EXPONENTS: (i32, i32);

    /// Returns the value that is for this precision.
    fn either<T>(single: T, double: T) -> T;
    /// The vector with one coordinate moved to the float above or below.
    fn nudged(self, coordinate: usize, up: bool) -> Self;
    /// The scalar with the leading ones of those bits.
    fn scalar(bits: u64) -> Self::Scalar;
    /// The vector of these coordinates.
    fn vector(coordinates: [Self::Scalar; 3]) -> Self;
}

macro_rules! precision {
    ($vector:ty, $float:ty, $bits:ty, $exponents:expr, $either:expr) => {
        impl Precision for $vector {
            #[allow(clippy::cast_lossless, reason = "not all of them are")]
            const MAX: f64 = <$float>::MAX as f64;
            #[allow(clippy::cast_lossless, reason = "not all of them are")]
            const SMALLEST: f64 = <$float>::from_bits(1) as f64;
            const DIGITS: u32 = <$float>::MANTISSA_DIGITS;
            const EXPONENTS: (i32, i32) = $exponents;

            fn either<T>(single: T, double: T) -> T {
                $either(single, double)
            }

            fn nudged(mut self, coordinate: usize, up: bool) -> Self {
                let value = self[coordinate];
                let away_from_zero = up == (value >= 0.0);
                self[coordinate] = if value == 0.0 {
                    if up { <$float>::from_bits(1) } else { -<$float>::from_bits(1) }
                } else {
                    <$float>::from_bits(value.to_bits().wrapping_add_signed(if away_from_zero {
                        1
                    } else {
                        -1
                    }))
                };
                self
            }

            #[allow(
                clippy::cast_possible_truncation,
                reason = "the first bits are the ones wanted"
            )]
            fn scalar(bits: u64) -> $float {
                <$float>::from_bits((bits >> (64 - <$bits>::BITS)) as $bits)
            }

            fn vector(coordinates: [$float; 3]) -> Self {
                Self::from_array(coordinates)
            }
        }
    };
}

precision!(Vec3, f32, u32, (-149, 127), |single, _| single);
precision!(DVec3, f64, u64, (-1074, 1023), |_, double| double);

/// A case in double precision, to be rounded to the one in use.
#[derive(Clone, Copy, Debug)]
struct Scene {
    origin: DVec3,
    direction: DVec3,
    center: DVec3,
    radius: f64,
}

impl Scene {
    /// A sphere, and the ray along a random unit direction whose line passes `closest` from the center and which starts
    /// `before` that closest approach.
    fn passing(rng: &mut Rng, center: DVec3, radius: f64, closest: f64, before: f64) -> Self {
        let direction = rng.unit_vector();
        let outward = rng.perpendicular(direction);
        Self { origin: center + outward * closest - direction * before, direction, center, radius }
    }

    /// A sphere near the world's origin, and a ray whose distances from the center are given in radii: of the closest
    /// approach, and from there back to the origin.
    fn at_distance(rng: &mut Rng, limb_fraction: f64, distance: f64) -> Self {
        let center = rng.unit_vector() * rng.uniform(0.0, 2.0);
        let radius = rng.uniform(0.5, 2.0);
        Self::passing(rng, center, radius, limb_fraction * radius, distance * radius)
    }

    /// A sphere, and a ray along a random unit direction from a point at `fraction` of its radius from its center.
    fn from_radial(rng: &mut Rng, fraction: f64) -> Self {
        let center = rng.unit_vector() * rng.uniform(0.0, 10.0);
        let radius = rng.magnitude(0.1, 100.0);
        let origin = center + rng.unit_vector() * (radius * fraction);
        Self { origin, direction: rng.unit_vector(), center, radius }
    }

    /// The scene `scale` times as large, and the direction as it is.
    fn scaled(self, scale: f64) -> Self {
        Self {
            origin: self.origin * scale,
            center: self.center * scale,
            radius: self.radius * scale,
            direction: self.direction,
        }
    }

    /// The same ray with a direction `scale` times as long.
    fn with_direction_scaled(self, scale: f64) -> Self {
        Self { direction: self.direction * scale, ..self }
    }

    /// The nearest case in the precision of `V`.
    fn rounded<V: Precision>(self) -> Case<V> {
        (
            Ray::new(V::from_f64(self.origin), V::from_f64(self.direction)),
            Sphere::new(V::from_f64(self.center), V::Scalar::from_f64(self.radius)),
        )
    }
}

fn easy<V: Precision>(rng: &mut Rng) -> Case<V> {
    let center = rng.unit_vector() * rng.uniform(0.0, 2.0);
    let (closest, before) = (rng.limb_fraction(), rng.uniform(2.0, 10.0));
    Scene::passing(rng, center, 1.0, closest, before).rounded()
}

fn far<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.magnitude(1e2, 1e4));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn very_far<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.magnitude(1e4, 1e7));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn farthest<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.magnitude(1e7, V::either(1e8, 1e15)));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn huge<V: Precision>(rng: &mut Rng) -> Case<V> {
    close_to_a_large_sphere(rng, 1e3, 1e6)
}

fn hugest<V: Precision>(rng: &mut Rng) -> Case<V> {
    close_to_a_large_sphere(rng, 1e6, V::either(1e7, 1e12))
}

fn close_to_a_large_sphere<V: Precision>(rng: &mut Rng, low: f64, high: f64) -> Case<V> {
    let up = rng.unit_vector();
    let radius = rng.magnitude(low, high);
    let origin = up * rng.magnitude(0.1, 10.0);
    Scene { origin, direction: rng.unit_vector(), center: up * -radius, radius }.rounded()
}

/// A fraction of the radius just within or beyond the limb.
fn near_the_limb(rng: &mut Rng, low: f64, high: f64) -> f64 {
    1.0 + rng.sign() * rng.magnitude(low, high)
}

fn grazing<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (near_the_limb(rng, 1e-8, 1e-3), rng.uniform(2.0, 10.0));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn at_the_limb<V: Precision>(rng: &mut Rng) -> Case<V> {
    let limb_fraction = near_the_limb(rng, V::either(1e-10, 1e-17), 1e-8);
    let distance = rng.uniform(2.0, 10.0);
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn grazing_from_afar<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (near_the_limb(rng, 1e-8, 1e-3), rng.magnitude(1e2, 1e5));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn at_the_limb_from_afar<V: Precision>(rng: &mut Rng) -> Case<V> {
    let limb_fraction = near_the_limb(rng, V::either(1e-10, 1e-17), 1e-8);
    let distance = rng.magnitude(1e2, V::either(1e6, 1e9));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

/// A planet of the Earth's size, whose surface is at the world's origin.
fn planets_limb<V: Precision>(rng: &mut Rng) -> Case<V> {
    let radius = 6.371e6;
    let up = rng.unit_vector();
    let center = DVec3::NEG_Y * radius;
    let orbit = radius + rng.uniform(2e5, 2e6);
    let origin = center + up * orbit;
    // The line's closest approach, up to 100 km above or below the ground.
    let closest = radius + rng.sign() * rng.magnitude(1.0, 1e5);
    let sine = closest / orbit;
    let direction = rng.perpendicular(up) * sine - up * libm::sqrt(1.0 - sine * sine);
    Scene { origin, direction, center, radius }.rounded()
}

fn on_the_surface<V: Precision>(rng: &mut Rng) -> Case<V> {
    Scene::from_radial(rng, 1.0).rounded()
}

fn inside<V: Precision>(rng: &mut Rng) -> Case<V> {
    let fraction = rng.uniform(0.0, 1.0);
    Scene::from_radial(rng, fraction).rounded()
}

fn behind<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(-10.0, -1.5));
    Scene::at_distance(rng, limb_fraction, distance).rounded()
}

fn axis_parallel<V: Precision>(rng: &mut Rng) -> Case<V> {
    let axis = DVec3::AXES[rng.index()] * rng.sign();
    let origin = rng.integers(-64, 64) * 0.25;
    let center = rng.integers(-64, 64) * 0.25;
    let closest = (center - origin).cross(axis).length();
    let radius = if rng.coin() {
        // A radius of few digits too, so that some of the tangents are exact.
        closest + integral(rng.integer(-4, 4)) * 0.25
    } else {
        closest / rng.limb_fraction().max(0.01)
    };
    Scene { origin, direction: axis * rng.power_of_two(-4, 4), center, radius }.rounded()
}

fn direction_length<V: Precision>(rng: &mut Rng) -> Case<V> {
    let length = rng.magnitude(1e-8, 1e8);
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(2.0, 10.0));
    Scene::at_distance(rng, limb_fraction, distance).with_direction_scaled(length).rounded()
}

fn extreme_direction_length<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (low, high) = V::either((1e-30, 1e30), (1e-300, 1e300));
    let length = rng.magnitude(low, high);
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(2.0, 10.0));
    Scene::at_distance(rng, limb_fraction, distance).with_direction_scaled(length).rounded()
}

fn scene_scale<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (low, high) = V::either((1e-18, 1e18), (1e-300, 1e300));
    let scale = rng.magnitude(low, high);
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(2.0, 10.0));
    let scene = Scene::at_distance(rng, limb_fraction, distance).scaled(scale);
    if rng.coin() { scene.with_direction_scaled(scale).rounded() } else { scene.rounded() }
}

fn far_from_world_origin<V: Precision>(rng: &mut Rng) -> Case<V> {
    let center = rng.unit_vector() * rng.magnitude(1e3, V::either(1e6, 1e12));
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(2.0, 10.0));
    let radius = rng.uniform(0.5, 2.0);
    Scene::passing(rng, center, radius, limb_fraction * radius, distance * radius).rounded()
}

fn tiny<V: Precision>(rng: &mut Rng) -> Case<V> {
    small_at_distance_1(rng, 1e-6, 1e-3)
}

fn tiniest<V: Precision>(rng: &mut Rng) -> Case<V> {
    small_at_distance_1(rng, V::either(1e-8, 1e-12), 1e-6)
}

fn small_at_distance_1<V: Precision>(rng: &mut Rng, low: f64, high: f64) -> Case<V> {
    let radius = rng.magnitude(low, high);
    let limb_fraction = rng.limb_fraction();
    Scene::passing(rng, DVec3::ZERO, radius, limb_fraction * radius, 1.0).rounded()
}

/// Three perpendicular integer vectors of the same integer length, from a quaternion of integers up to `largest`.
fn integer_frame(rng: &mut Rng, largest: i64) -> ([DVec3; 3], f64) {
    loop {
        let [w, x, y, z] = [(); 4].map(|()| integral(rng.integer(-largest, largest)));
        let length = w * w + x * x + y * y + z * z;
        if length > 0.0 {
            let frame = [
                DVec3::new(
                    w * w + x * x - y * y - z * z,
                    2.0 * (x * y + w * z),
                    2.0 * (x * z - w * y),
                ),
                DVec3::new(
                    2.0 * (x * y - w * z),
                    w * w - x * x + y * y - z * z,
                    2.0 * (y * z + w * x),
                ),
                DVec3::new(
                    2.0 * (x * z + w * y),
                    2.0 * (y * z - w * x),
                    w * w - x * x - y * y + z * z,
                ),
            ];
            return (frame, length);
        }
    }
}

/// A sphere with integers for its coordinates and its radius, a line that touches it in a point with integer
/// coordinates, and a ray on that line: the discriminant is exactly 0, and the two roots are one fraction of integers.
fn integer_tangent<V: Precision>(rng: &mut Rng) -> Scene {
    let (largest, multiple, extent) = V::either((10, 40, 1 << 22), (1 << 9, 1 << 20, 1 << 50));
    let ([along, outward, _], length) = integer_frame(rng, largest);
    let center = rng.integers(-extent, extent);
    let times = integral(rng.integer(1, multiple));
    let before = integral(rng.integer(-multiple / 4, multiple));
    Scene {
        origin: center + outward * times - along * before,
        direction: along * integral(rng.integer(1, 8)),
        center,
        radius: length * times,
    }
    .scaled(rng.power_of_two(-20, 20))
}

fn exact_tangent<V: Precision>(rng: &mut Rng) -> Case<V> {
    integer_tangent::<V>(rng).rounded()
}

/// The case with one coordinate, of its origin, direction or center, moved by an ulp.
fn nudged<V: Precision>(rng: &mut Rng, (mut ray, mut sphere): Case<V>) -> Case<V> {
    let vector =
        [&mut ray.origin, &mut ray.direction, &mut sphere.center].into_iter().nth(rng.index());
    if let Some(vector) = vector {
        *vector = vector.nudged(rng.index(), rng.coin());
    }
    (ray, sphere)
}

/// A tangent to a sphere at the world's origin, moved by far less than an ulp of its radius.
fn near_tangent<V: Precision>(rng: &mut Rng) -> Case<V> {
    let tangent = integer_tangent::<V>(rng);
    let mut center = DVec3::ZERO;
    center[rng.index()] =
        rng.sign() * tangent.radius * rng.magnitude(V::either(1e-30, 1e-290), 1e-6);
    Scene { origin: tangent.origin - tangent.center, center, ..tangent }.rounded()
}

fn tangent_neighbor<V: Precision>(rng: &mut Rng) -> Case<V> {
    let case = exact_tangent(rng);
    nudged(rng, case)
}

fn exactly_on_the_surface<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (largest, multiple, extent) = V::either((10, 40, 1 << 22), (1 << 9, 1 << 20, 1 << 50));
    let ([_, outward, _], length) = integer_frame(rng, largest);
    let times = integral(rng.integer(1, multiple));
    let center = rng.integers(-extent, extent);
    let direction = rng.unit_vector();
    Scene { origin: center + outward * times, direction, center, radius: length * times }
        .scaled(rng.power_of_two(-20, 20))
        .rounded()
}

/// The half-chord and the closest approach are the legs of a Pythagorean triangle whose hypotenuse is the radius, so
/// the roots are integers, and of one bit more than a mantissa has. Off the plane of that triangle, by `off_plane`, the
/// center moves the roots from there by about half the square of that.
fn tie<V: Precision>(rng: &mut Rng, off_plane: impl Fn(f64) -> f64) -> Case<V> {
    let n = rng.integer(1, 19);
    let m = rng.integer(n + 1, 20);
    let (half_chord, closest, radius) = (m * m - n * n, 2 * m * n, m * m + n * n);
    let (half_chord, closest) =
        if rng.coin() { (half_chord, closest) } else { (closest, half_chord) };

    let limit = 1_i64 << V::DIGITS;
    let root = (limit + rng.integer(1, limit - limit / 16)) | 1;
    let to_center = if rng.coin() { root + half_chord } else { root - half_chord };
    let center = to_center / 2 - rng.integer(0, 1000);
    let origin = to_center - center;

    let sideways = rng.integer(-1000, 1000);
    let vector = |x, y, z| DVec3::new(integral(x), integral(y), z);
    let rotation = rng.index();
    let rotated = |v: DVec3| [v, DVec3::new(v.z, v.x, v.y), DVec3::new(v.y, v.z, v.x)][rotation];
    let sign = rng.sign();
    Scene {
        origin: rotated(vector(-origin, sideways - closest, 0.0)) * sign,
        direction: rotated(DVec3::X) * sign * rng.power_of_two(-10, 10),
        center: rotated(vector(center, sideways, off_plane(integral(radius)))) * sign,
        radius: integral(radius),
    }
    .scaled(rng.power_of_two(-20, 20))
    .rounded()
}

fn exact_tie<V: Precision>(rng: &mut Rng) -> Case<V> {
    tie(rng, |_| 0.0)
}

fn near_tie<V: Precision>(rng: &mut Rng) -> Case<V> {
    let off_plane = rng.magnitude(V::either(1e-18, 1e-150), 1e-2);
    tie(rng, |_| off_plane)
}

fn near_tie_beside_the_axis<V: Precision>(rng: &mut Rng) -> Case<V> {
    let part = rng.magnitude(1e-12, 1e-1);
    tie(rng, |radius| radius * part)
}

/// On an axis, a center at a float and a radius of an odd number of half its ulps; in one of two cases, the center is moved
/// beside the axis by 1e-12 to 1e-1 of the radius.
fn tie_of_a_tiny_sphere<V: Precision>(rng: &mut Rng) -> Case<V> {
    let distance = V::Scalar::from_f64(rng.uniform(1.0, 2.0)).into();
    let half_ulp = two_to(-i64::from(V::DIGITS));
    let radius = half_ulp * integral(2 * rng.integer(0, 20) + 1);
    let beside = if rng.coin() { 0.0 } else { rng.magnitude(1e-12, 1e-1) * radius };
    let axis = rng.index();
    let along = DVec3::AXES[axis] * rng.sign();
    let across = DVec3::AXES[(axis + 1) % 3];
    let scale = rng.power_of_two(-20, 20);
    Scene {
        origin: DVec3::ZERO,
        direction: along * rng.power_of_two(-10, 10),
        center: along * distance + across * beside,
        radius,
    }
    .scaled(scale)
    .rounded()
}

/// In a plane, a line and a circle with the coordinates that chance gives; then the center is moved off that plane so far
/// that a root, as near as the digits of this way allow, is midway between two single-precision floats.
fn hard_to_round<V: Precision>(rng: &mut Rng) -> Case<V> {
    /// Of a single-precision float, in the bits of a double-precision one.
    const HALF_ULP: u64 = 1 << 28;

    loop {
        let mut vector =
            |low, high| DVec3::new(rng.uniform(low, high), rng.uniform(low, high), 0.0);
        let (origin, direction, center) = (vector(-4.0, 4.0), vector(-1.0, 1.0), vector(-4.0, 4.0));
        let radius = rng.magnitude(0.1, 4.0);
        let (mut ray, mut sphere) = Scene { origin, direction, center, radius }.rounded::<V>();

        let radius: f64 = sphere.radius.into();
        let d = ray.direction.to_f64();
        let to_center = sphere.center.to_f64() - ray.origin.to_f64();
        let length = d.length();
        let closest = to_center.cross(d).length() / length;
        let half_chord = libm::sqrt((radius - closest) * (radius + closest));
        let near = to_center.dot(d) / length - half_chord;
        if !(half_chord > 0.1 && near > 0.1) {
            continue;
        }
        let near = near / length;
        // The number midway between the two floats around the near root, or the next one: the root grows as the center
        // leaves the plane.
        let halves = near.to_bits() / HALF_ULP;
        let midway = f64::from_bits(((halves + 1) | 1) * HALF_ULP);
        let shorter = (midway - near) * length;
        let off_plane = libm::sqrt(shorter * (2.0 * half_chord - shorter));
        let mut off = sphere.center.to_f64();
        off.z = off_plane * rng.sign();
        sphere.center = V::from_f64(off);

        let rotation = rng.index();
        let rotated = |v: V| {
            let v = v.to_f64();
            V::from_f64([v, DVec3::new(v.z, v.x, v.y), DVec3::new(v.y, v.z, v.x)][rotation])
        };
        ray = Ray::new(rotated(ray.origin), rotated(ray.direction));
        sphere.center = rotated(sphere.center);
        return (ray, sphere);
    }
}

fn point_sphere<V: Precision>(rng: &mut Rng) -> Case<V> {
    let (extent, step, multiple) =
        V::either((1 << 22, 1 << 10, 1 << 12), (1 << 50, 1 << 25, 1 << 25));
    let origin = rng.integers(-extent, extent);
    let direction = rng.integers(-step, step);
    let center = origin + direction * integral(rng.integer(-multiple / 4, multiple));
    let scale = rng.power_of_two(-20, 20);
    let case = Scene { origin, direction, center, radius: 0.0 }.scaled(scale).rounded();
    if rng.coin() { case } else { nudged(rng, case) }
}

fn subnormal<V: Precision>(rng: &mut Rng) -> Case<V> {
    let scale = V::SMALLEST * rng.power_of_two(0, 20);
    let (limb_fraction, distance) = (rng.limb_fraction(), rng.uniform(1.0, 10.0));
    let scene = Scene::at_distance(rng, limb_fraction, distance);
    match rng.index() {
        0 => scene.scaled(scale),
        1 => scene.with_direction_scaled(scale),
        _ => scene.scaled(scale).with_direction_scaled(scale),
    }
    .rounded()
}

fn near_overflow<V: Precision>(rng: &mut Rng) -> Case<V> {
    let center = rng.unit_vector() * rng.uniform(0.0, 1.0);
    let origin = rng.unit_vector() * rng.uniform(0.0, 1.0);
    let radius = rng.uniform(0.0, 1.0);
    let before = center - origin;
    let outward = rng.perpendicular(before.normalize_or(DVec3::X));
    let through = before + outward * (radius * rng.limb_fraction());
    let direction = through.normalize_or(DVec3::X);
    let length = [1.0, V::MAX, V::SMALLEST * rng.power_of_two(0, 60)][rng.index()];
    Scene { origin, direction, center, radius }
        .scaled(V::MAX)
        .with_direction_scaled(length)
        .rounded()
}

fn coefficients_narrow<V: Precision>(rng: &mut Rng) -> Case<V> {
    coefficients(rng, V::either(32, 256))
}

fn coefficients_wide<V: Precision>(rng: &mut Rng) -> Case<V> {
    coefficients(rng, V::either(70, 560))
}

fn coefficients_widest<V: Precision>(rng: &mut Rng) -> Case<V> {
    coefficients(rng, V::either(126, 1022))
}

/// A ray and a sphere whose quadratic a t² - 2 h t + c has coefficients with exponents from `-range` to `range`, as far
/// as the lengths that this takes are in the range of the precision.
fn coefficients<V: Precision>(rng: &mut Rng, range: i64) -> Case<V> {
    let (low, high) = V::EXPONENTS;
    loop {
        let [a, h, c] = [(); 3].map(|()| rng.integer(-range, range));
        // The length of the direction, the way along it to the closest approach, the root of |c|, and one length more.
        let exponents = [a / 2, h - a / 2, c / 2, c / 2 + rng.integer(-12, 2)];
        if exponents.iter().any(|&exponent| exponent < low.into() || exponent >= high.into()) {
            continue;
        }
        let [length, along, root_of_c, free] =
            exponents.map(|exponent| rng.uniform(1.0, 2.0) * two_to(exponent));

        // Squares may overflow; those of the lengths in the unit of the largest do not.
        let unit = along.max(root_of_c).max(free);
        let square = |length: f64| (length / unit) * (length / unit);
        let (along_squared, c_squared, free_squared) =
            (square(along), square(root_of_c), square(free));
        let side = |squared: f64| libm::sqrt(squared) * unit;
        let (radius, closest) = if rng.coin() {
            // c < 0: the origin is inside.
            (side(along_squared + free_squared + c_squared), free)
        } else if along > root_of_c {
            (side(along_squared + free_squared - c_squared), free)
        } else {
            // The discriminant is negative.
            (free, side(c_squared - along_squared + free_squared))
        };
        let forward =
            if rng.coin() { rng.unit_vector() } else { DVec3::AXES[rng.index()] * rng.sign() };
        let outward =
            if rng.coin() { rng.perpendicular(forward) } else { forward.any_orthogonal_vector() };
        let to_center = forward * (along * rng.sign()) + outward * closest;
        let (origin, center) =
            if rng.coin() { (DVec3::ZERO, to_center) } else { (-to_center, DVec3::ZERO) };
        return Scene { origin, direction: forward * length, center, radius }.rounded();
    }
}

/// 2^`exponent`, from the smallest subnormal to the largest power of two.
fn two_to(exponent: i64) -> f64 {
    if exponent < -1022 {
        f64::from_bits(1 << (exponent + 1074))
    } else {
        f64::from_bits(1023_u64.wrapping_add_signed(exponent) << 52)
    }
}

fn random_bits<V: Precision>(rng: &mut Rng) -> Case<V> {
    let mut vector = || V::vector([(); 3].map(|()| V::scalar(rng.bits())));
    let (origin, direction, center) = (vector(), vector(), vector());
    (Ray::new(origin, direction), Sphere::new(center, V::scalar(rng.bits())))
}

fn random_finite_bits<V: Precision>(rng: &mut Rng) -> Case<V> {
    let mut scalar = || {
        let bits = rng.bits();
        let value: f64 = V::scalar(bits).into();
        // Without the highest bit of its exponent, a NaN or an infinity is finite.
        if value.is_finite() { V::scalar(bits) } else { V::scalar(bits & !(1 << 62)) }
    };
    let mut vector = || V::vector([(); 3].map(|()| scalar()));
    let (origin, direction, center) = (vector(), vector(), vector());
    // Of several radii the largest: a small one is never hit.
    let radius = [(); 4]
        .map(|()| scalar())
        .into_iter()
        .fold(V::Scalar::ZERO, |r, s| if s > r { s } else { r });
    (Ray::new(origin, direction), Sphere::new(center, radius))
}

/// The same integer as a float.
#[expect(clippy::cast_precision_loss, reason = "the integers here are at most 2^53")]
fn integral(value: i64) -> f64 {
    value as f64
}
