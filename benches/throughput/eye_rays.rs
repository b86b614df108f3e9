//! Eye rays, each beside the textbook's lines.
//!
//! What is timed creates every ray of an image of 160 by 90 pixels. `ray` and the textbook are given (u, v) from an array;
//! `pixel_ray` is given the center of the pixel. "ray, (u, v) of the pixel" computes (u, v) from the same center first.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use eyeray::{Camera, Frame, Ray, Vector, ViewRect};
use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::methods;

const EYE: Vec3 = Vec3::new(3.0, 2.0, 5.0);
const VIEW: ViewRect = ViewRect { left: -1.6, right: 1.6, bottom: -0.9, top: 0.9 };
const DISTANCE: f32 = 2.0;
const WIDTH: u16 = 160;
const HEIGHT: u16 = 90;

/// The centers of the pixels, row by row.
fn pixel_centers() -> Vec<Vec2> {
    let row = |y| (0..WIDTH).map(move |x| Vec2::new(f32::from(x), f32::from(y)) + 0.5);
    (0..HEIGHT).flat_map(row).collect()
}

/// The point of the view plane that a pixel shows, by the lecture's formula.
macro_rules! in_view_plane {
    ($pixel:expr, $vec2:ident, $float:ident) => {{
        let [left, right, bottom, top] =
            [VIEW.left, VIEW.right, VIEW.bottom, VIEW.top].map($float::from);
        let (width, height) = ($float::from(WIDTH), $float::from(HEIGHT));
        $vec2::new(
            left + (right - left) * ($pixel.x / width),
            top - (top - bottom) * ($pixel.y / height),
        )
    }};
}

/// Times creating all the rays of an image.
fn image<V: Vector, I: Iterator<Item = Ray<V>>>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    rays: impl Fn() -> I,
) {
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for ray in rays() {
                black_box(ray);
            }
        });
    });
}

/// The textbook's lines.
fn textbook(group: &mut BenchmarkGroup<'_, WallTime>, camera: &Camera, uvs: &[Vec2]) {
    let basis = camera.basis();
    if camera.distance().is_some() {
        image(group, "ray, textbook", || {
            let (eye, basis, distance) = black_box((EYE, basis, DISTANCE));
            let ray = move |uv: &Vec2| methods::perspective_ray(eye, basis, distance, *uv);
            black_box(uvs).iter().map(ray)
        });
    } else {
        image(group, "ray, textbook", || {
            let (eye, basis) = black_box((EYE, basis));
            black_box(uvs).iter().map(move |uv| methods::orthographic_ray(eye, basis, *uv))
        });
    }
}

macro_rules! rows {
    ($group:ident, $camera:ident, $pixels:expr, $vec2:ident, $float:ident) => {
        let (pixels, camera): (Vec<$vec2>, _) = ($pixels, $camera);
        let uvs: Vec<$vec2> =
            pixels.iter().map(|pixel| in_view_plane!(pixel, $vec2, $float)).collect();
        image(&mut $group, "ray", || {
            let camera = black_box(camera);
            black_box(&uvs).iter().map(move |uv| camera.ray(*uv))
        });
        image(&mut $group, "ray, (u, v) of the pixel", || {
            let camera = black_box(camera);
            let uv = |pixel: &$vec2| in_view_plane!(pixel, $vec2, $float);
            black_box(&pixels).iter().map(move |pixel| camera.ray(uv(pixel)))
        });
        image(&mut $group, "pixel_ray", || {
            let camera = black_box(camera);
            let (width, height) = black_box((WIDTH.into(), HEIGHT.into()));
            black_box(&pixels).iter().map(move |pixel| camera.pixel_ray(*pixel, width, height))
        });
        image(&mut $group, "rays", || black_box(camera).rays(WIDTH.into(), HEIGHT.into()));
        $group.finish();
    };
}

pub(crate) fn eye_rays(criterion: &mut Criterion) {
    let pixels = pixel_centers();
    let uvs: Vec<Vec2> = pixels.iter().map(|pixel| in_view_plane!(pixel, Vec2, f32)).collect();
    let frame = Frame::look_at(EYE, Vec3::ZERO, Vec3::Y).expect("a frame");
    let cameras = [
        ("perspective", frame.perspective(VIEW, DISTANCE)),
        ("orthographic", frame.orthographic(VIEW)),
    ];
    for (projection, camera) in cameras {
        let camera = camera.expect("a camera");
        let throughput = Throughput::Elements(u64::from(WIDTH) * u64::from(HEIGHT));

        let mut group = criterion.benchmark_group(format!("f32, eye rays, {projection}"));
        group.throughput(throughput.clone());
        textbook(&mut group, &camera, &uvs);
        rows!(group, camera, pixels.clone(), Vec2, f32);

        let camera = Camera::<DVec3>::from(camera);
        let mut group = criterion.benchmark_group(format!("f64, eye rays, {projection}"));
        group.throughput(throughput);
        rows!(group, camera, pixels.iter().map(|pixel| pixel.as_dvec2()).collect(), DVec2, f64);
    }
}
