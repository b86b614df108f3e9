//! The path tracer, and the picture file.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use eyeray::Ray;
use glam::{Vec3, vec2, vec3};
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::lens::Lens;
use crate::material::Material;
use crate::objects::Objects;
use crate::random::Random;

/// The largest number of bounces of a path.
const DEEPEST: u32 = 50;

/// Renders the picture on every core, as bytes of red, green and blue, row by row from the top.
pub(crate) fn render(
    objects: &Objects,
    materials: &[Material],
    lens: &Lens,
    samples: u16,
) -> Vec<u8> {
    let Lens { width, height, .. } = *lens;
    let mut pixels = vec![[0; 3]; usize::from(width) * usize::from(height)];
    let rows = pixels.par_chunks_mut(width.into()).zip(0..height);
    rows.progress_with(progress_bar(height)).for_each(|(row, y)| {
        // A seed for each row: the picture does not depend on which thread renders it.
        let mut random = Random::new(y.into());
        for (pixel, x) in row.iter_mut().zip(0..width) {
            let mut sum = Vec3::ZERO;
            for _ in 0..samples {
                let place = vec2(f32::from(x) + random.unit(), f32::from(y) + random.unit());
                let ray = lens.ray(place, &mut random);
                sum += color(objects, materials, ray, &mut random);
            }
            *pixel = to_bytes(sum / f32::from(samples));
        }
    });
    pixels.into_flattened()
}

/// Returns the color of the light that comes along the ray, reflected and refracted on its way from the sky.
fn color(objects: &Objects, materials: &[Material], mut ray: Ray, random: &mut Random) -> Vec3 {
    let mut color = Vec3::ONE;
    for _ in 0..DEEPEST {
        let Some((index, hit)) = objects.nearest(&ray) else {
            return color * sky(ray.direction);
        };
        let Some((attenuation, scattered)) = materials[index].scatter(&ray, &hit, random) else {
            return Vec3::ZERO;
        };
        color *= attenuation;
        ray = scattered;
    }
    Vec3::ZERO
}

/// White at the horizon, blue above.
fn sky(direction: Vec3) -> Vec3 {
    let upwards = 0.5 * (direction.normalize().y + 1.0);
    Vec3::ONE.lerp(vec3(0.5, 0.7, 1.0), upwards)
}

/// The book's gamma of 2.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is from 0 to 255"
)]
fn to_bytes(color: Vec3) -> [u8; 3] {
    color.to_array().map(|linear| (256.0 * linear.sqrt().clamp(0.0, 0.999)) as u8)
}

fn progress_bar(rows: u16) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} rows, {eta} left");
    ProgressBar::new(rows.into()).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Writes the bytes as a PNG.
pub(crate) fn write_png(
    output: &Path,
    width: u16,
    height: u16,
    pixels: &[u8],
) -> Result<(), png::EncodingError> {
    let file = BufWriter::new(File::create(output)?);
    let mut encoder = png::Encoder::new(file, width.into(), height.into());
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()
}
