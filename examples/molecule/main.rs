//! A molecule viewer: some thousand atoms of potassium fulleride in orthographic view, labels, and picking by a pixel.
//!
//! ```text
//! cargo run --release --example molecule
//! cargo run --release --example molecule -- --pick 423,171
//! ```
//!
//! `examples/molecule.png` was made by
//!
//! ```text
//! cargo run --release --example molecule -- --beside-textbook --zoom 5 --width 720 --height 270 --output examples/molecule.png
//! ```
//!
//! From far away, the distances of atoms one behind the other round to the same `f32`, and the one in front is still the one that
//! is seen. `--from-afar` asks the rays of the picture with the eye 1e6 and 1e7 radii away, and counts the answers that are not
//! the atom in front: with this crate none. By the least correctly rounded distance, it is none from 1e6 radii, because atoms of
//! this crystal only just touch, and 16 of 6,075 from 1e7.
//!
//! ```text
//! cargo run --release --example molecule -- --from-afar --width 100 --height 100
//! ```
//!
//! An orthographic camera sees only what is ahead of its eye, so a viewer places the eye well back: by default 3,000 radii of a
//! carbon atom. With this crate the distance changes nothing in the picture. With the textbook's formula in `f32`, which
//! `--beside-textbook` draws in the right half, it does: the discriminant is the difference of two large numbers, and the
//! farther the eye, the fewer correct digits are left in it.
//!
//! The crate creates the eye rays ([`eyeray::Camera::rays`]), finds the atoms that they hit ([`eyeray::SphereBvh`]), creates the
//! ray of the mouse's pixel for picking ([`eyeray::Camera::pixel_ray`]), and projects an atom to the pixel of its label
//! ([`eyeray::Camera::project_to_pixel`]).

mod arguments;
#[path = "../shared/command_line.rs"]
mod command_line;
mod crystal;
mod from_afar;
mod picture;
mod textbook;
mod viewer;

use std::error::Error;
use std::process::ExitCode;

use arguments::{Arguments, USAGE};
use glam::Vec2;
use viewer::Viewer;

fn main() -> ExitCode {
    command_line::run("molecule", USAGE, arguments::parse, run)
}

/// Draws the picture, or picks an atom.
fn run(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    if arguments.from_afar {
        return from_afar::report(arguments);
    }
    let viewer = Viewer::new(crystal::atoms(), arguments)?;
    if let Some([x, y]) = arguments.pick {
        return Ok(describe(&viewer, Vec2::new(x, y)));
    }
    let picture = if arguments.beside_textbook {
        let ours = viewer.picture(|ray| viewer.nearest(ray));
        let textbook = viewer.picture(|ray| textbook::nearest(viewer.atoms(), ray));
        ours.beside(&textbook)
    } else {
        let mut picture = viewer.picture(|ray| viewer.nearest(ray));
        for (pixel, label) in viewer.labels() {
            picture.write(pixel, &label);
        }
        picture
    };
    picture.save(&arguments.output)?;
    Ok(format!("{}: {} atoms", arguments.output.display(), viewer.atoms().len()))
}

/// Describes the atom that is seen at a pixel.
fn describe(viewer: &Viewer, pixel: Vec2) -> String {
    match viewer.pick(pixel) {
        Some((index, hit)) => {
            let atom = &viewer.atoms()[index];
            let center = atom.sphere.center;
            format!(
                "atom {index}, {}, at {center:.2}, seen at {:.3}",
                atom.element.name(),
                hit.point
            )
        }
        None => "no atom".to_owned(),
    }
}
