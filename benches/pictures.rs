//! The rays of a picture: `nearest_each` and `occludes_each` beside one ray at a time, in turns.
//!
//! ```text
//! cargo bench --bench pictures              # a table: ns a ray, and the median of the ratios
//! cargo bench --bench pictures -- --test    # each once
//! ```
//!
//! With `RUSTFLAGS='--cfg eyeray_lanes="avx2"'`, eyeray does without AVX-512, and with `"compiled"` without AVX2 too.
//!
//! The eye rays are those of a picture of 256 by 256 pixels in tiles of 64, the shadow rays go from their hits to one lamp, and
//! bounces from there in any direction. "Shuffled" are the eye rays and the shadow rays of the picture in any order: they have
//! nothing in common.

use std::hint::black_box;
use std::ops::Range;
use std::time::Instant;

use eyeray::{Camera, CameraError, Hit, Hittable, Ray, Sphere, SphereBvh, Spheres};
use glam::{DVec3, Vec3, vec2, vec3};

#[path = "../tests/support/families.rs"]
mod families;

use families::Rng;

const ALL: Range<f32> = 0.0..f32::INFINITY;
const SIZE: u16 = 256;
/// How many rays are asked together.
const TOGETHER: usize = 64;

type Found = Option<(usize, Hit)>;

/// What both collections have.
trait Collection {
    fn nearest(&self, ray: &Ray) -> Found;
    fn nearest_each(&self, rays: &[Ray], found: &mut [Found]);
    fn occludes(&self, ray: &Ray) -> bool;
    fn occludes_each(&self, rays: &[Ray], occluded: &mut [bool]);
}

macro_rules! collections {
    ($($name:ident)+) => {$(
        impl Collection for $name {
            fn nearest(&self, ray: &Ray) -> Found {
                $name::nearest(self, ray, ALL)
            }

            fn nearest_each(&self, rays: &[Ray], found: &mut [Found]) {
                $name::nearest_each(self, rays, ALL, found);
            }

            fn occludes(&self, ray: &Ray) -> bool {
                Hittable::occludes(self, ray, 0.0..1.0)
            }

            fn occludes_each(&self, rays: &[Ray], occluded: &mut [bool]) {
                $name::occludes_each(self, rays, 0.0..1.0, occluded);
            }
        }
    )+};
}

collections!(Spheres SphereBvh);

/// A ball full of spheres.
fn cloud(count: usize) -> Vec<Sphere> {
    let mut rng = Rng::new(count as u64);
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let radius = 0.4 / (count as f64).cbrt();
    let mut in_ball = || rng.unit_vector() * rng.uniform(0.0, 1.0).cbrt();
    (0..count).map(|_| sphere(in_ball(), radius)).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "any radius will do")]
fn sphere(center: DVec3, radius: f64) -> Sphere {
    Sphere::new(center.as_vec3(), radius as f32)
}

/// The rays of a picture in tiles, whose 16s and 64s lie together.
fn eye_rays() -> Result<Vec<Ray>, CameraError> {
    let camera = Camera::perspective_fov(vec3(1.0, 1.2, 2.0), Vec3::ZERO, Vec3::Y, 0.7, 1.0)?;
    let corners = |size: u16, step: u16| {
        let along = move || (0..size).step_by(step.into());
        along().flat_map(move |y| along().map(move |x| [x, y]))
    };
    let pixels = corners(SIZE, 8).flat_map(|tile| {
        corners(8, 4).flat_map(move |square| {
            corners(4, 1).map(move |pixel| [0, 1].map(|k| tile[k] + square[k] + pixel[k]))
        })
    });
    let ray = |[x, y]: [u16; 2]| {
        camera.pixel_ray(vec2(f32::from(x) + 0.5, f32::from(y) + 0.5), SIZE.into(), SIZE.into())
    };
    Ok(pixels.map(ray).collect())
}

/// The same in any order.
fn shuffled(rays: &[Ray]) -> Vec<Ray> {
    let mut rng = Rng::new(9);
    let mut rays = rays.to_vec();
    for last in (1..rays.len()).rev() {
        let other = usize::try_from(rng.below(last as u64 + 1)).unwrap_or(0);
        rays.swap(last, other);
    }
    rays
}

/// The least times of both in ns a ray, and the median of their ratios.
fn compare(rounds: usize, rays: usize, mut one: impl FnMut(), mut each: impl FnMut()) -> [f64; 3] {
    let time = |pass: &mut dyn FnMut()| {
        let start = Instant::now();
        pass();
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let rays = rays as f64;
        start.elapsed().as_secs_f64() * 1e9 / rays
    };
    let times: Vec<_> = (0..rounds).map(|_| [time(&mut one), time(&mut each)]).collect();
    let least = |k: usize| times.iter().map(|times| times[k]).fold(f64::INFINITY, f64::min);
    let mut ratios: Vec<_> = times.iter().map(|[one, each]| each / one).collect();
    ratios.sort_by(f64::total_cmp);
    [least(0), least(1), ratios[ratios.len() / 2]]
}

fn nearest(rounds: usize, collection: &dyn Collection, rays: &[Ray]) -> [f64; 3] {
    let mut by_one = vec![None; rays.len()];
    let mut by_each = vec![None; rays.len()];
    let one = || {
        for (ray, found) in rays.iter().zip(&mut by_one) {
            *found = collection.nearest(black_box(ray));
        }
    };
    let each = || {
        for (rays, found) in rays.chunks(TOGETHER).zip(by_each.chunks_mut(TOGETHER)) {
            collection.nearest_each(black_box(rays), found);
        }
    };
    let times = compare(rounds, rays.len(), one, each);
    assert!(by_one == by_each, "the answers are the same");
    times
}

fn occluded(rounds: usize, collection: &dyn Collection, rays: &[Ray]) -> [f64; 3] {
    let mut by_one = vec![false; rays.len()];
    let mut by_each = vec![false; rays.len()];
    let one = || {
        for (ray, occluded) in rays.iter().zip(&mut by_one) {
            *occluded = collection.occludes(black_box(ray));
        }
    };
    let each = || {
        for (rays, occluded) in rays.chunks(TOGETHER).zip(by_each.chunks_mut(TOGETHER)) {
            collection.occludes_each(black_box(rays), occluded);
        }
    };
    let times = compare(rounds, rays.len(), one, each);
    assert!(by_one == by_each, "the answers are the same");
    times
}

fn main() -> Result<(), CameraError> {
    let rounds = if std::env::args().any(|argument| argument == "--test") { 1 } else { 15 };
    let eye_rays = eye_rays()?;
    let lamp = vec3(2.0, 3.0, 1.0);
    println!("ns a ray, one at a time and {TOGETHER} together, and the ratio");
    print!("{:<20}", "spheres");
    for kind in ["eye rays", "shadows", "bounces", "eye, shuffled", "shadows, shuffled"] {
        print!("{kind:>23}");
    }
    println!();
    for count in [46, 1_024, 100, 10_000, 100_000] {
        let spheres = cloud(count);
        let (name, collection): (_, Box<dyn Collection>) = match count {
            46 | 1_024 => ("Spheres", Box::new(Spheres::from(spheres))),
            _ => ("SphereBvh", Box::new(SphereBvh::from(spheres))),
        };
        let collection = &*collection;
        let mut rng = Rng::new(1);
        let hits: Vec<Hit> =
            eye_rays.iter().filter_map(|ray| Some(collection.nearest(ray)?.1)).collect();
        let shadows: Vec<Ray> = hits.iter().map(|hit| hit.spawn(lamp - hit.point)).collect();
        let mut bounce = |hit: &Hit| hit.spawn(hit.normal + rng.unit_vector().as_vec3() * 0.99);
        let bounces: Vec<Ray> = hits.iter().map(&mut bounce).collect();
        print!("{:<20}", format!("{name}, {count}"));
        for [one, each, ratio] in [
            nearest(rounds, collection, &eye_rays),
            occluded(rounds, collection, &shadows),
            nearest(rounds, collection, &bounces),
            nearest(rounds, collection, &shuffled(&eye_rays)),
            occluded(rounds, collection, &shuffled(&shadows)),
        ] {
            print!("{one:>9.1}{each:>8.1}{ratio:>6.2}");
        }
        println!();
    }
    Ok(())
}
