//! The command line.

use lexopt::Parser;
use lexopt::prelude::{Long, Short};

use crate::command_line::whole_number;

pub(crate) const USAGE: &str = "usage: many_spheres [--largest 100..1000000] [--rays 2..10000000]";

/// A parsed command line.
pub(crate) struct Arguments {
    /// The number of spheres at which to stop.
    pub(crate) largest: u32,
    /// Rays through each cloud.
    pub(crate) rays: u32,
}

/// Parses the command line. Returns `None` for `--help`.
pub(crate) fn parse(mut parser: Parser) -> Result<Option<Arguments>, lexopt::Error> {
    let mut arguments = Arguments { largest: 1_000_000, rays: 200_000 };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("largest") => {
                arguments.largest = whole_number(&mut parser, 100..=1_000_000)?;
            }
            Long("rays") => arguments.rays = whole_number(&mut parser, 2..=10_000_000)?,
            Long("help") | Short('h') => return Ok(None),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Some(arguments))
}
