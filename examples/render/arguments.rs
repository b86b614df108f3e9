//! The command line.

use std::path::PathBuf;

use lexopt::Parser;
use lexopt::ValueExt;
use lexopt::prelude::{Long, Short};

use crate::command_line::whole_number;
use crate::scene::View;

pub(crate) const USAGE: &str = "usage: render [--camera perspective|orthographic] \
[--width 1..16384] [--height 1..16384] [--samples 1..65535] [--output FILE.png]";

/// A parsed command line.
pub(crate) struct Arguments {
    pub(crate) view: View,
    pub(crate) width: u16,
    pub(crate) height: u16,
    /// Eye rays a pixel.
    pub(crate) samples: u16,
    pub(crate) output: PathBuf,
}

/// Parses the command line. Returns `None` for `--help`.
pub(crate) fn parse(mut parser: Parser) -> Result<Option<Arguments>, lexopt::Error> {
    let mut arguments = Arguments {
        view: View::Perspective,
        width: 960,
        height: 540,
        samples: 48,
        output: PathBuf::from("render.png"),
    };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("camera") => {
                arguments.view = parser.value()?.parse_with(|name| match name {
                    "perspective" => Ok(View::Perspective),
                    "orthographic" => Ok(View::Orthographic),
                    _ => Err("there is no such camera"),
                })?;
            }
            Long("width") => arguments.width = whole_number(&mut parser, 1..=16_384)?,
            Long("height") => arguments.height = whole_number(&mut parser, 1..=16_384)?,
            // As many as the low-discrepancy sequence has.
            Long("samples") => arguments.samples = whole_number(&mut parser, 1..=65_535)?,
            Long("output") => arguments.output = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(arguments))
}
