//! A first picture, with nothing left out: a camera, three spheres, shading by the normal, a PNG.
//!
//! ```text
//! cargo run --release --example first_picture [FILE.png]
//! ```
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "colors become bytes")]

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;

use eyeray::{Camera, Ray, Sphere, nearest};
use glam::{Vec3, vec3};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;

fn main() -> Result<(), Box<dyn Error>> {
    let (eye, target) = (vec3(0.0, 0.8, 5.0), vec3(0.0, 0.1, 0.0));
    let fov_y = 40_f32.to_radians();
    let camera = Camera::perspective_fov(eye, target, Vec3::Y, fov_y, 16.0 / 9.0)?;
    let scene = [
        Sphere::new(vec3(0.0, -1000.5, 0.0), 1000.0), // the ground
        Sphere::new(vec3(-0.8, 0.5, 0.0), 1.0),
        Sphere::new(vec3(1.0, 0.0, 0.6), 0.5),
    ];

    // One eye ray a pixel, row by row from the top.
    let pixels: Vec<u8> = camera.rays(WIDTH, HEIGHT).flat_map(|ray| color(&scene, &ray)).collect();

    let path = std::env::args_os().nth(1).unwrap_or_else(|| "first_picture.png".into());
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), WIDTH, HEIGHT);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}

/// Returns the color that is seen along the ray: the components of the normal as red, green and blue, darker in shadow; or the
/// sky.
fn color(scene: &[Sphere], ray: &Ray) -> [u8; 3] {
    let lamp = vec3(6.0, 8.0, 4.0);
    let color = match nearest(scene, ray, 0.0..f32::INFINITY) {
        Some((_, hit)) => {
            // From the surface to the lamp: t = 1 is the lamp. No smallest t is needed.
            let shadow_ray = hit.spawn(lamp - hit.point);
            let in_shadow = nearest(scene, &shadow_ray, 0.0..1.0).is_some();
            (0.5 * hit.normal + 0.5) * if in_shadow { 0.4 } else { 1.0 }
        }
        None => vec3(0.8, 0.9, 1.0),
    };
    (255.0 * color).to_array().map(|channel| channel as u8)
}
