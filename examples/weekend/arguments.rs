//! The command line.

use std::path::PathBuf;

use lexopt::Parser;
use lexopt::ValueExt;
use lexopt::prelude::{Long, Short};

use crate::command_line::whole_number;
use crate::objects::Kind;

pub(crate) const USAGE: &str = "usage: weekend [--width 1..16384] [--height 1..16384] [--samples 1..65535] \
[--objects slice|boxes|spheres|bvh] [--output FILE.png]";

/// A parsed command line.
pub(crate) struct Arguments {
    pub(crate) width: u16,
    pub(crate) height: u16,
    /// Eye rays a pixel.
    pub(crate) samples: u16,
    /// What the spheres are kept in.
    pub(crate) kind: Kind,
    pub(crate) output: PathBuf,
}

/// Parses the command line. Returns `None` for `--help`.
pub(crate) fn parse(mut parser: Parser) -> Result<Option<Arguments>, lexopt::Error> {
    let mut arguments = Arguments {
        width: 800,
        height: 450,
        samples: 64,
        kind: Kind::Bvh,
        output: PathBuf::from("weekend.png"),
    };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("width") => arguments.width = whole_number(&mut parser, 1..=16_384)?,
            Long("height") => arguments.height = whole_number(&mut parser, 1..=16_384)?,
            Long("samples") => arguments.samples = whole_number(&mut parser, 1..=65_535)?,
            Long("objects") => arguments.kind = parser.value()?.parse()?,
            Long("output") => arguments.output = parser.value()?.into(),
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(arguments))
}
