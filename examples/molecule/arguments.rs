//! The command line.

use std::path::PathBuf;

use lexopt::Parser;
use lexopt::ValueExt;
use lexopt::prelude::{Long, Short};

use crate::command_line::whole_number;

pub(crate) const USAGE: &str = "usage: molecule [--pick X,Y] [--beside-textbook] [--from-afar] [--distance RADII] \
[--zoom FACTOR] [--width 1..16384] [--height 1..16384] [--output FILE.png]";

/// A parsed command line.
#[derive(Clone)]
pub(crate) struct Arguments {
    /// The pixel below which an atom is to be named, instead of a picture.
    pub(crate) pick: Option<[f32; 2]>,
    /// Whether to draw the same picture by the textbook's formula beside the other.
    pub(crate) beside_textbook: bool,
    /// Whether to count hidden atoms from far away, instead of a picture.
    pub(crate) from_afar: bool,
    /// How far the eye is from the middle of the molecule, in radii of a carbon atom.
    pub(crate) distance: f32,
    /// How many times the picture is enlarged.
    pub(crate) zoom: f32,
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) output: PathBuf,
}

/// Parses the command line. Returns `None` for `--help`.
pub(crate) fn parse(mut parser: Parser) -> Result<Option<Arguments>, lexopt::Error> {
    let mut arguments = Arguments {
        pick: None,
        beside_textbook: false,
        from_afar: false,
        distance: 3_000.0,
        zoom: 1.0,
        width: 800,
        height: 800,
        output: PathBuf::from("molecule.png"),
    };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("pick") => arguments.pick = Some(parser.value()?.parse_with(pixel)?),
            Long("beside-textbook") => arguments.beside_textbook = true,
            Long("from-afar") => arguments.from_afar = true,
            Long("distance") => arguments.distance = parser.value()?.parse()?,
            Long("zoom") => arguments.zoom = parser.value()?.parse()?,
            Long("width") => arguments.width = whole_number(&mut parser, 1..=16_384)?,
            Long("height") => arguments.height = whole_number(&mut parser, 1..=16_384)?,
            Long("output") => arguments.output = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(arguments))
}

/// Parses a pixel, "X,Y".
fn pixel(text: &str) -> Result<[f32; 2], &'static str> {
    let coordinates =
        text.split_once(',').and_then(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?]));
    coordinates.ok_or("not two numbers with a comma between them")
}
