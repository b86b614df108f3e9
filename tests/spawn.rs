//! Rays spawned at a hit never meet the surface they leave: outwards they start strictly outside the sphere, inwards
//! strictly inside, judged by exact arithmetic; and no farther from the surface than promised.
//!
//! The long run, of one and a half million spawned rays or more in each precision:
//!
//! ```text
//! EYERAY_CASES=1000000 cargo test --release --test spawn -- --nocapture
//! ```

mod support;

use std::cmp::Ordering;

use eyeray::{Algebraic, Geometric, Hittable, Ray, Scalar, Sphere};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use support::dyadic::Dyadic;
use support::families::{Precision, Rng};
use support::float::Float;
use support::oracle::{Coordinates, Truth, side};
use support::reproduce::source;

/// Cases that share a seed: the seeds are 0, 1, 2 and so on.
const CASES_PER_SEED: u64 = 1000;

#[test]
fn single_precision() {
    check::<Vec3>();
}

#[test]
fn double_precision() {
    check::<DVec3>();
}

/// The results of spawned rays.
#[derive(Debug, Default)]
struct Tally {
    outwards: u64,
    inwards: u64,
    /// Of both, those within a thousandth of the tangent plane.
    grazing: u64,
    failed: u64,
    first_failure: Option<String>,
}

impl Tally {
    fn and(self, other: Self) -> Self {
        Self {
            outwards: self.outwards + other.outwards,
            inwards: self.inwards + other.inwards,
            grazing: self.grazing + other.grazing,
            failed: self.failed + other.failed,
            first_failure: self.first_failure.or(other.first_failure),
        }
    }
}

fn check<V: Precision + Coordinates>() {
    let cases = match std::env::var("EYERAY_CASES") {
        Ok(cases) => cases.parse().expect("EYERAY_CASES is the number of hits"),
        Err(_) => 10 * CASES_PER_SEED,
    };
    let seeds = u64::div_ceil(cases, CASES_PER_SEED);
    let total = (0..seeds).into_par_iter().map(tally::<V>).reduce(Tally::default, Tally::and);
    let Tally { outwards, inwards, grazing, failed, first_failure } = total;
    println!(
        "{} digits: {outwards} rays outwards, {inwards} inwards, {grazing} of them grazing, {failed} failed",
        V::DIGITS
    );
    assert!(
        first_failure.is_none(),
        "{failed} failed, first\n{}",
        first_failure.unwrap_or_default()
    );
    let rays = outwards + inwards;
    let quarter = rays / 4;
    assert!(
        rays > cases && outwards > quarter && inwards > quarter && grazing > quarter,
        "a poor choice of cases"
    );
}

/// The cases of one seed: of each hit, one ray outwards and one inwards.
fn tally<V: Precision + Coordinates>(seed: u64) -> Tally {
    let mut rng = Rng::new(seed);
    let mut tally = Tally::default();
    for _ in 0..CASES_PER_SEED {
        let on_ground = !rng.coin();
        let (sphere, ray) = scene::<V>(&mut rng, on_ground);
        let Some(hit) = sphere.intersect(&ray, V::Scalar::ZERO..V::Scalar::INFINITY) else {
            continue;
        };
        if !is_large(&sphere, hit.point) {
            continue;
        }
        for outwards in [true, false] {
            let (direction, grazing) = leaving(&mut rng, hit.normal.to_f64(), outwards);
            let direction = V::from_f64(direction);
            let spawned = hit.spawn(direction);
            let (count, wanted) = if outwards {
                (&mut tally.outwards, Ordering::Greater)
            } else {
                (&mut tally.inwards, Ordering::Less)
            };
            *count += 1;
            tally.grazing += u64::from(grazing);
            let result = examine(&sphere, &spawned, wanted)
                .and_then(|()| stays_close(&sphere, &ray, hit.point, spawned.origin))
                .and_then(|()| {
                    let agrees = hit.is_outward(direction) == outwards;
                    agrees.then_some(()).ok_or_else(|| "is_outward contradicts".to_owned())
                });
            if let Err(what) = result {
                tally.failed += 1;
                tally.first_failure.get_or_insert_with(|| {
                    format!(
                        "seed {seed}: {what}\n{hit:?}\nthe ray that hit: {}\nspawned: {}",
                        source(&ray, &sphere),
                        source(&spawned, &sphere)
                    )
                });
            }
        }
    }
    tally
}

/// A ground, or any sphere, and a ray towards it.
fn scene<V: Precision + Coordinates>(rng: &mut Rng, on_ground: bool) -> (Sphere<V>, Ray<V>) {
    if on_ground {
        return ground(rng);
    }
    let sphere = sphere(rng);
    (sphere, towards(rng, &sphere))
}

/// A ground of radius 1e2 to 1e7 with its top near the world's origin, and a ray at it from 0.01 to 1,000 above, or from inside.
fn ground<V: Precision>(rng: &mut Rng) -> (Sphere<V>, Ray<V>) {
    let radius = rng.magnitude(1e2, 1e7);
    let up = if rng.coin() { DVec3::Y } else { rng.unit_vector() };
    let sphere = Sphere::new(V::from_f64(up * -radius), V::Scalar::from_f64(radius));
    let height = rng.magnitude(0.01, 1000.0);
    let aside = rng.perpendicular(up) * (height * rng.magnitude(1e-3, 30.0));
    let from_below = rng.below(4) == 0;
    let origin = up * if from_below { -height } else { height };
    let ray = Ray::new(V::from_f64(origin), V::from_f64(aside - origin));
    (sphere, ray)
}

/// An ulp of the largest coordinate of a point.
fn ulp_of<V: Coordinates>(point: V) -> Dyadic {
    let ulps = point.coordinates().map(|x| V::Scalar::ulp(&Dyadic::exactly(x.into())));
    Dyadic::new(1, ulps.into_iter().max().expect("there are three"))
}

/// Whether the promise holds for a sphere at that point.
fn is_large<V: Coordinates>(sphere: &Sphere<V>, point: V) -> bool {
    Dyadic::exactly(sphere.radius.into()) >= &ulp_of(point) * &Dyadic::new(1000, 0)
}

/// Whether a spawned ray starts no farther from the surface than promised: 32 times the sum of an ulp of the point's largest
/// coordinate and the smaller of a part of the distance travelled and a part of the radius, and a smaller part of the radius
/// more.
fn stays_close<V: Coordinates>(
    sphere: &Sphere<V>,
    ray: &Ray<V>,
    point: V,
    spawned: V,
) -> Result<(), String> {
    let [of_distance, of_radius, more_of_radius] =
        if V::Scalar::DIGITS == 24 { [32, 24, 47] } else { [62, 53, 102] };
    let exactly = |v: V| v.coordinates().map(|x| Dyadic::exactly(x.into()));
    let distance_squared = |v: V, w: V| {
        let (v, w) = (exactly(v), exactly(w));
        let squares = [0, 1, 2].map(|i| {
            let difference = &v[i] - &w[i];
            &difference * &difference
        });
        squares.iter().fold(Dyadic::ZERO, |sum, square| &sum + square)
    };
    let radius = Dyadic::exactly(sphere.radius.into());
    let travelled = distance_squared(point, ray.origin).square_root(100);
    let off = travelled.scaled(-of_distance).min(radius.clone().scaled(-of_radius));
    let promised = &(&ulp_of(point) + &off).scaled(5) + &radius.clone().scaled(-more_of_radius);
    let distance = distance_squared(spawned, sphere.center);
    let square = |x: &Dyadic| x * x;
    let is_close = distance <= square(&(&radius + &promised))
        && distance >= square(&(&radius - &promised).max(Dyadic::ZERO));
    is_close.then_some(()).ok_or_else(|| {
        let from_surface = (&distance.square_root(200) - &radius).abs();
        format!(
            "{:e} from the surface, and {:e} are promised",
            from_surface.approximately(),
            promised.approximately()
        )
    })
}

/// A sphere of a radius from 1e-3 to 1e6, at up to 1e6 from the world's origin: at least 1,000 ulp of its largest
/// coordinate, and one in two of them close to that.
fn sphere<V: Precision + Coordinates>(rng: &mut Rng) -> Sphere<V> {
    let center = V::from_f64(rng.unit_vector() * rng.magnitude(1e-3, 1e6));
    let ulp = center
        .coordinates()
        .map(|coordinate| V::Scalar::ulp(&Dyadic::exactly(coordinate.into())))
        .into_iter()
        .max()
        .map_or(0.0, |exponent| Dyadic::new(1, exponent).approximately());
    let least = (1000.0 * ulp).max(1e-3);
    let radius =
        if rng.coin() { rng.magnitude(least, 2.0 * least) } else { rng.magnitude(least, 1e6) };
    let radius = V::Scalar::from_f64(radius);
    let rounded_down = radius.into() < least;
    Sphere::new(
        center,
        if rounded_down { V::Scalar::from_ordinal(radius.ordinal() + 1) } else { radius },
    )
}

/// A ray from inside or outside, of which one in two passes close to the limb, and which may yet miss.
fn towards<V: Precision>(rng: &mut Rng, sphere: &Sphere<V>) -> Ray<V> {
    let (center, radius) = (sphere.center.to_f64(), sphere.radius.into());
    let direction = rng.unit_vector();
    let closest = rng.perpendicular(direction) * radius;
    let fraction = if rng.coin() { 1.0 - rng.magnitude(1e-9, 1e-2) } else { rng.uniform(0.0, 1.0) };
    let before = if rng.coin() { rng.uniform(-1.0, 1.0) } else { rng.magnitude(1.0, 1e4) };
    let origin = center + closest * fraction - direction * (before * radius);
    Ray::new(V::from_f64(origin), V::from_f64(direction * rng.power_of_two(-8, 8)))
}

/// A direction to one side of the tangent plane, in one of two cases within a thousandth of it, and whether it is.
fn leaving(rng: &mut Rng, normal: DVec3, outwards: bool) -> (DVec3, bool) {
    let normal = normal.normalize();
    let away = if outwards { normal } else { -normal };
    let grazing = rng.coin();
    // The least sine keeps to its side of the plane when the direction is rounded to single precision.
    let sine = if grazing { rng.magnitude(1e-6, 1e-3) } else { rng.uniform(1e-3, 1.0) };
    let direction = rng.perpendicular(normal) + away * sine;
    let length =
        if rng.below(4) == 0 { rng.magnitude(1e-30, 1e30) } else { rng.uniform(0.1, 10.0) };
    (direction * length, grazing)
}

/// Whether the ray starts strictly on the wanted side and meets what it should ahead: nothing from outside, and from
/// inside the far wall.
fn examine<V: Coordinates>(
    sphere: &Sphere<V>,
    spawned: &Ray<V>,
    wanted: Ordering,
) -> Result<(), String> {
    let side = side(sphere, spawned.origin);
    if side != Some(wanted) {
        return Err(format!("the origin compares as {side:?} with the surface, not as {wanted:?}"));
    }
    let ahead = Truth::new(spawned, sphere)
        .and_then(|truth| truth.roots.into_iter().find(|root| root.compare(&Dyadic::ZERO).is_gt()));
    if wanted.is_gt() && ahead.is_some() {
        return Err(format!("the exact ray meets the surface it leaves: {ahead:?}"));
    }
    let range = V::Scalar::ZERO..V::Scalar::INFINITY;
    let objects: [&dyn Hittable<V>; 3] = [sphere, &Algebraic(*sphere), &Geometric(*sphere)];
    for object in objects {
        let hit = object.intersect(spawned, range.clone());
        if object.occludes(spawned, range.clone()) != hit.is_some() {
            return Err(format!("occludes contradicts {hit:?}"));
        }
        match (&ahead, hit) {
            (None, None) => {}
            (Some(root), Some(hit)) if root.error(hit.t) <= 0.5 => {}
            (ahead, hit) => return Err(format!("{hit:?}, but the exact root ahead is {ahead:?}")),
        }
    }
    Ok(())
}

#[test]
fn directions_in_the_tangent_plane_leave_too() {
    // Rounding decides to which side such a direction points. On either the ray must not be caught by the surface:
    // from outside it meets nothing, from inside the far wall.
    fn check<V: Precision + Coordinates>() {
        let mut rng = Rng::new(0);
        for case in 0..4000 {
            let (sphere, ray) = scene::<V>(&mut rng, case % 2 == 1);
            let Some(hit) = sphere.intersect(&ray, V::Scalar::ZERO..V::Scalar::INFINITY) else {
                continue;
            };
            let normal = hit.normal.to_f64();
            let lean = normal * (rng.sign() * rng.magnitude(1e-18, 1e-6));
            let spawned = hit.spawn(V::from_f64(rng.perpendicular(normal.normalize()) + lean));
            let side = side(&sphere, spawned.origin).expect("all is finite");
            assert!(side.is_ne(), "on the surface: {}", source(&spawned, &sphere));
            assert_eq!(hit.is_outward(spawned.direction), side.is_gt(), "another side");
            examine(&sphere, &spawned, side)
                .unwrap_or_else(|what| panic!("{what}\n{}", source(&spawned, &sphere)));
        }
    }
    check::<Vec3>();
    check::<DVec3>();
}
