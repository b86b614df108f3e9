//! The rays of a picture: eyeray and Embree one ray at a time, eyeray 64 at a time, Embree 16 coherent ones at a time.

use std::hint::black_box;
use std::ops::Range;
use std::time::Instant;

use eyeray::{Camera, Hit, Hittable, Ray, Sphere, SphereBvh};
use glam::{Vec3, vec2, vec3};

use crate::scenes;

/// The picture's width and height in pixels.
const SIZE: u16 = 256;

/// Shadow rays end at the lamp.
const TO_THE_LAMP: Range<f32> = 0.0..1.0;

/// Times each method by itself: in turns on one batch, the later would find the caches warm. ns a ray, the least of all rounds.
#[expect(clippy::cast_precision_loss, reason = "counts are small")]
fn times<const N: usize>(rounds: usize, rays: usize, passes: [&mut dyn FnMut(); N]) -> [f64; N] {
    passes.map(|pass| {
        let round = |_| {
            let start = Instant::now();
            pass();
            start.elapsed().as_secs_f64()
        };
        (0..rounds).map(round).fold(f64::INFINITY, f64::min) * 1e9 / rays as f64
    })
}

/// The numbers of 16 rays, as Embree takes them. Of fewer, the first is there again: Embree's assertions refuse a NaN.
fn sixteens(rays: &[Ray]) -> Vec<[[f32; 16]; 6]> {
    let sixteen = |rays: &[Ray]| {
        let number = |ray: &Ray, k: usize| [ray.origin, ray.direction][k / 3][k % 3];
        let of_all =
            |k| std::array::from_fn(|place| number(rays.get(place).unwrap_or(&rays[0]), k));
        std::array::from_fn(of_all)
    };
    rays.chunks(16).map(sixteen).collect()
}

/// The rays of a picture of a scene from outside, in tiles of 8 by 8 whose 16s lie together.
fn eye_rays(spheres: &[Sphere]) -> Vec<Ray> {
    let [low, high] = scenes::extent(spheres);
    let (middle, extent) = (low.midpoint(high), (high - low).max_element());
    let eye = middle + vec3(0.5, 0.6, 1.0).normalize() * extent * 1.3;
    let Ok(camera) = Camera::perspective_fov(eye, middle, Vec3::Y, 0.7, 1.0) else {
        return Vec::new();
    };
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
    pixels.map(ray).collect()
}

pub fn print_head() {
    println!("A picture, ns a ray, and the time of 64 at a time as a part of Embree's 16");
    println!("{:<24}{:>42} |{:>42}", "", "eye rays", "shadow rays to one lamp");
    print!("{:<24}", "scene");
    for end in [" |", "\n"] {
        print!("{:>9}{:>10}{:>8}{:>8}{:>7}{end}", "Embree 1", "Embree 16", "one", "each", "/16");
    }
}

pub fn print_row(
    name: &str,
    spheres: &[Sphere],
    hierarchy: &SphereBvh,
    embree: Option<&embree::Scene>,
    rounds: usize,
) {
    let rays = eye_rays(spheres);
    let all = 0.0..f32::INFINITY;
    let mut found: Vec<Option<(usize, Hit)>> = vec![None; rays.len()];
    let mut found_each = found.clone();
    let packed = sixteens(&rays);
    let nearest = times(
        rounds,
        rays.len(),
        [
            &mut || {
                for ray in &rays {
                    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
                    black_box(embree.and_then(|embree| embree.nearest(origin, direction)));
                }
            },
            &mut || {
                for rays in &packed {
                    black_box(embree.map(|embree| embree.nearest_16(rays)));
                }
            },
            &mut || {
                for (ray, found) in rays.iter().zip(&mut found) {
                    *found = hierarchy.nearest(ray, all.clone());
                }
            },
            &mut || {
                for (rays, found) in rays.chunks(64).zip(found_each.chunks_mut(64)) {
                    hierarchy.nearest_each(rays, all.clone(), found);
                }
            },
        ],
    );
    assert!(found == found_each, "the answers are the same");

    let eye = rays.first().map_or(Vec3::ZERO, |ray| ray.origin);
    let lamp = eye + vec3(0.3, 0.5, 0.1) * eye.length();
    let hits = found.iter().flatten();
    let rays: Vec<Ray> = hits.map(|(_, hit)| hit.spawn(lamp - hit.point)).collect();
    let mut occluded = vec![false; rays.len()];
    let mut occluded_each = occluded.clone();
    let packed = sixteens(&rays);
    let shadows = times(
        rounds,
        rays.len(),
        [
            &mut || {
                for ray in &rays {
                    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
                    black_box(embree.map(|embree| embree.occludes(origin, direction, 1.0)));
                }
            },
            &mut || {
                for rays in &packed {
                    black_box(embree.map(|embree| embree.occludes_16(rays, 1.0)));
                }
            },
            &mut || {
                for (ray, occluded) in rays.iter().zip(&mut occluded) {
                    *occluded = hierarchy.occludes(ray, TO_THE_LAMP);
                }
            },
            &mut || {
                for (rays, occluded) in rays.chunks(64).zip(occluded_each.chunks_mut(64)) {
                    hierarchy.occludes_each(rays, TO_THE_LAMP, occluded);
                }
            },
        ],
    );
    assert!(occluded == occluded_each, "the answers are the same");

    print!("{name:<24}");
    for ([one, sixteen, alone, each], end) in [(nearest, " |"), (shadows, "\n")] {
        print!("{one:>9.1}{sixteen:>10.1}{alone:>8.1}{each:>8.1}{:>7.2}{end}", each / sixteen);
    }
}
