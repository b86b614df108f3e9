//! The command line.

use lexopt::ValueExt;
use lexopt::prelude::{Long, Short};

pub(crate) const USAGE: &str = "usage: many_spheres [--largest 100..1000000] [--rays 2..10000000]";

/// A parsed command line.
pub(crate) enum Request {
    Help,
    Measure(Arguments),
}

pub(crate) struct Arguments {
    /// The number of spheres at which to stop.
    pub(crate) largest: u32,
    /// Rays through each cloud.
    pub(crate) rays: u32,
}

pub(crate) fn parse(mut parser: lexopt::Parser) -> Result<Request, lexopt::Error> {
    let mut arguments = Arguments { largest: 1_000_000, rays: 200_000 };
    while let Some(argument) = parser.next()? {
        match argument {
            Long("largest") => {
                arguments.largest = whole_number(&mut parser, 100, 1_000_000)?;
            }
            Long("rays") => arguments.rays = whole_number(&mut parser, 2, 10_000_000)?,
            Long("help") | Short('h') => return Ok(Request::Help),
            _ => return Err(argument.unexpected()),
        }
    }
    Ok(Request::Measure(arguments))
}

/// The next value, a whole number from `least` to `largest`.
fn whole_number(
    parser: &mut lexopt::Parser,
    least: u32,
    largest: u32,
) -> Result<u32, lexopt::Error> {
    parser.value()?.parse_with(|text| match text.parse() {
        Ok(number) if (least..=largest).contains(&number) => Ok(number),
        _ => Err(format!("not a whole number from {least} to {largest}")),
    })
}
