//! From radiance to a picture file.

use std::fs::File;
use std::io::BufWriter;

use eyeray::{Camera, Ray};
use glam::{Vec3, vec2, vec3};
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::path::radiance;
use crate::sampler::Sampler;
use crate::scene::Scene;

/// The picture as sRGB bytes, row by row from the top, computed on every core.
pub(crate) fn render(
    scene: &Scene,
    camera: &Camera,
    width: u16,
    height: u16,
    samples: u16,
) -> Vec<u8> {
    let mut pixels = vec![[0; 3]; usize::from(width) * usize::from(height)];
    let rows = pixels.par_chunks_mut(width.into()).zip(0..height);
    rows.progress_with(progress_bar(height)).for_each(|(row, y)| {
        for (pixel, x) in row.iter_mut().zip(0..width) {
            let (mut samplers, eye_rays): (Vec<Sampler>, Vec<Ray>) = (0..samples)
                .map(|sample| {
                    let mut sampler = Sampler::new([x, y], sample);
                    let [right, down, ..] = sampler.draw();
                    let place = vec2(f32::from(x) + right, f32::from(y) + down);
                    (sampler, camera.pixel_ray(place, width.into(), height.into()))
                })
                .unzip();
            // The eye rays of a pixel lie together, and are asked together. Later, each path goes its own way.
            let mut found = vec![None; eye_rays.len()];
            scene.spheres.nearest_each(&eye_rays, 0.0..f32::INFINITY, &mut found);
            let paths = samplers.iter_mut().zip(eye_rays).zip(found);
            let sum: Vec3 =
                paths.map(|((sampler, ray), found)| radiance(scene, ray, found, sampler)).sum();
            *pixel = develop(sum / f32::from(samples));
        }
    });
    pixels.into_flattened()
}

fn progress_bar(rows: u16) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} rows, {eta} left");
    ProgressBar::new(rows.into()).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Linear radiance as sRGB bytes, through an exposure curve that rolls off as film does.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is rounded and in 0..=255"
)]
fn develop(radiance: Vec3) -> [u8; 3] {
    const EXPOSURE: f32 = 2.1;
    // The curve is of the luminance, so that lamps keep their color.
    let luminance = radiance.dot(vec3(0.2126, 0.7152, 0.0722)).max(f32::MIN_POSITIVE);
    let exposed = radiance * ((1.0 - (-EXPOSURE * luminance).exp()) / luminance);
    exposed.min(Vec3::ONE).to_array().map(|linear| {
        let encoded = if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * encoded).round() as u8
    })
}

/// Writes those bytes as a PNG.
pub(crate) fn write_png(
    file: File,
    width: u16,
    height: u16,
    pixels: &[u8],
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(BufWriter::new(file), width.into(), height.into());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()
}
