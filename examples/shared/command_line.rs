//! The part of the command line that the examples share.

use std::error::Error;
use std::fmt::Display;
use std::io::{Write, stderr, stdout};
use std::ops::RangeInclusive;
use std::process::ExitCode;
use std::str::FromStr;

use lexopt::{Parser, ValueExt};

/// Parses the command line, runs the example, and prints its result, or the error. Where `parse` returns `None`, prints the
/// usage.
pub(crate) fn run<Arguments>(
    name: &str,
    usage: &str,
    parse: impl FnOnce(Parser) -> Result<Option<Arguments>, lexopt::Error>,
    example: impl FnOnce(&Arguments) -> Result<String, Box<dyn Error>>,
) -> ExitCode {
    match parse(Parser::from_env()) {
        Ok(None) => print(stdout(), usage, ExitCode::SUCCESS),
        Ok(Some(arguments)) => match example(&arguments) {
            Ok(result) => print(stdout(), &result, ExitCode::SUCCESS),
            Err(error) => print(stderr(), &format!("{name}: {error}"), ExitCode::FAILURE),
        },
        Err(error) => print(stderr(), &format!("{name}: {error}\n{usage}"), ExitCode::from(2)),
    }
}

/// Prints the message. A closed pipe is no error.
fn print(mut to: impl Write, message: &str, code: ExitCode) -> ExitCode {
    let _ = writeln!(to, "{message}");
    code
}

/// Parses the next value, a whole number in the range.
pub(crate) fn whole_number<N: FromStr + PartialOrd + Display>(
    parser: &mut Parser,
    range: RangeInclusive<N>,
) -> Result<N, lexopt::Error> {
    parser.value()?.parse_with(|text| match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        _ => Err(format!("not a whole number from {} to {}", range.start(), range.end())),
    })
}
