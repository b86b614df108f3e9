//! The final scene of *[Ray Tracing in One Weekend]* with this crate: some 485 spheres, matte, of metal and of glass, seen
//! through a thin lens.
//!
//! ```text
//! cargo run --release --example weekend
//! cargo run --release --example weekend -- --width 400 --samples 32 --objects slice
//! ```
//!
//! What replaces the types of the book:
//!
//! | the book | here |
//! |:--|:--|
//! | `ray` | [`eyeray::Ray`] |
//! | `interval` | a range: `0.0..f32::INFINITY` |
//! | `hittable` | [`eyeray::Hittable`] |
//! | `hit_record` | [`eyeray::Hit`], whose normal is the outward one on either side; the material is found by the object's index |
//! | `front_face`, `set_face_normal` | [`eyeray::Hit::front_face`] |
//! | `sphere` | [`eyeray::Sphere`] |
//! | `hittable_list` | a slice and [`eyeray::nearest`], or [`eyeray::Spheres`] |
//! | `bvh_node` of the second book | [`eyeray::SphereBvh`] |
//! | `camera::initialize` | [`eyeray::Frame`], which makes an [`eyeray::Camera`] |
//! | `camera::get_ray` | [`eyeray::Camera::pixel_ray`]; the lens is in `lens.rs` |
//! | the `t` of at least 0.001 against shadow acne | nothing: [`eyeray::Hit::spawn`] starts a ray clear of the surface |
//!
//! The materials, the colors and the numbers of the scene are the book's. `--objects` chooses the collection of the spheres. The
//! picture is the same, byte for byte, with all four of them, and with any number of threads (`RAYON_NUM_THREADS`).
//!
//! [Ray Tracing in One Weekend]: https://raytracing.github.io/books/RayTracingInOneWeekend.html

mod arguments;
#[path = "../shared/command_line.rs"]
mod command_line;
mod lens;
mod material;
mod objects;
mod picture;
mod random;
mod scene;

use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use arguments::{Arguments, USAGE};
use lens::Lens;
use objects::Objects;
use scene::Scene;

fn main() -> ExitCode {
    command_line::run("weekend", USAGE, arguments::parse, render)
}

/// Renders the scene into the file that the command line names, and returns how long it took.
fn render(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let Arguments { width, height, samples, kind, ref output } = *arguments;
    let lens = Lens::new(width, height)?;
    let Scene { spheres, materials } = Scene::new();
    let count = spheres.len();

    let start = Instant::now();
    let objects = Objects::new(kind, spheres);
    let pixels = picture::render(&objects, &materials, &lens, samples);
    let seconds = start.elapsed().as_secs_f64();

    picture::write_png(output, width, height, &pixels)?;
    Ok(format!(
        "{}: {width} x {height}, {samples} samples a pixel, {count} spheres as {kind}, {seconds:.1} s",
        output.display()
    ))
}
