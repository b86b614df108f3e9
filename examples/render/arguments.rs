//! The command line.

use std::path::PathBuf;

use lexopt::ValueExt;
use lexopt::prelude::{Long, Short};

use crate::scene::View;

pub(crate) const USAGE: &str = "usage: render [--camera perspective|orthographic] \
[--width 1..16384] [--height 1..16384] [--samples 1..65535] [--output FILE.png]";

/// A parsed command line.
pub(crate) enum Request {
    Help,
    Render(Arguments),
}

/// The picture asked for.
pub(crate) struct Arguments {
    pub(crate) view: View,
    pub(crate) width: u16,
    pub(crate) height: u16,
    /// Eye rays a pixel.
    pub(crate) samples: u16,
    pub(crate) output: PathBuf,
}

pub(crate) fn parse(mut parser: lexopt::Parser) -> Result<Request, lexopt::Error> {
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
            Long("width") => arguments.width = whole_number(&mut parser, 16_384)?,
            Long("height") => arguments.height = whole_number(&mut parser, 16_384)?,
            // As many as the low-discrepancy sequence has.
            Long("samples") => arguments.samples = whole_number(&mut parser, 65_535)?,
            Long("output") => arguments.output = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(Request::Help),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Request::Render(arguments))
}

/// The next value, a whole number from 1 to `largest`.
fn whole_number(parser: &mut lexopt::Parser, largest: u16) -> Result<u16, lexopt::Error> {
    parser.value()?.parse_with(|text| match text.parse() {
        Ok(number) if (1..=largest).contains(&number) => Ok(number),
        _ => Err(format!("not a whole number from 1 to {largest}")),
    })
}
