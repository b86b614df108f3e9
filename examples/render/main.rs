//! A small path tracer over eyeray: 46 spheres under an evening sky, with two lamps among them.
//!
//! ```text
//! cargo run --release --example render
//! cargo run --release --example render -- --camera orthographic --output orthographic.png
//! ```
//!
//! `examples/render.png` was made by
//!
//! ```text
//! cargo run --release --example render -- --width 800 --height 450 --samples 1024 --output examples/render.png
//! ```
//!
//! The crate creates the eye rays ([`eyeray::Camera`]), finds the nearest hits of all those of a pixel at once
//! ([`eyeray::Spheres::nearest_each`]), creates the rays that leave a surface ([`eyeray::Hit::spawn`]), finds the nearest hit of
//! each ([`eyeray::Spheres::nearest`]) and tests whether a lamp is in sight ([`eyeray::Hittable::occludes`]). There is no epsilon
//! to tune: each range begins at 0, and no surface shadows itself.

mod arguments;
#[path = "../shared/command_line.rs"]
mod command_line;
mod material;
mod path;
mod picture;
mod sampler;
mod scene;

use std::error::Error;
use std::fs::File;
use std::process::ExitCode;
use std::time::Instant;

use arguments::{Arguments, USAGE};
use scene::Scene;

fn main() -> ExitCode {
    command_line::run("render", USAGE, arguments::parse, run)
}

/// Renders the picture into its file, and prints what was done.
fn run(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let Arguments { view, width, height, samples, output } = arguments;
    let cannot_write =
        |error: &dyn Error| format!("cannot write \"{}\": {error}", output.display());
    let camera =
        view.camera(*width, *height).map_err(|error| format!("no such camera: {error}"))?;
    // Opened first, so that a path that cannot be written is reported before the work.
    let file = File::create(output).map_err(|error| cannot_write(&error))?;

    let start = Instant::now();
    let pixels = picture::render(&Scene::new(), &camera, *width, *height, *samples);
    let seconds = start.elapsed().as_secs_f64();
    picture::write_png(file, *width, *height, &pixels).map_err(|error| cannot_write(&error))?;

    let output = output.display();
    Ok(format!("{output}: {width} x {height}, {samples} samples a pixel, {seconds:.1} s"))
}
