//! What a report is asked on the command line.

use std::process;

use lexopt::{Arg, Parser};

use super::timing::Regime;

/// How much is measured, and where it goes.
#[derive(Clone, Copy, Debug)]
pub struct Arguments {
    pub effort: Effort,
    /// Whether the copies beside the benches are written too.
    pub refresh: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    Full,
    /// For a first impression.
    Quick,
    /// Only to see that it runs.
    Test,
}

impl Effort {
    /// So much of a number of cases.
    pub fn cases(self, full: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Quick => full / 50,
            Self::Test => 20,
        }
    }

    pub fn regime(self, full: Regime) -> Regime {
        match self {
            Self::Full => full,
            Self::Quick => full.quick(),
            Self::Test => Regime::SMALLEST,
        }
    }
}

impl Arguments {
    /// Reads the arguments; where they are wrong, says how they go and ends the program.
    pub fn read(bench: &str, can_refresh: bool) -> Self {
        match Self::parse(can_refresh) {
            Ok(arguments) => arguments,
            Err(error) => {
                let refresh = if can_refresh { " [--refresh]" } else { "" };
                eprintln!("error: {error}");
                eprintln!("usage: {bench} -- [--quick | --test]{refresh}");
                process::exit(2)
            }
        }
    }

    fn parse(can_refresh: bool) -> Result<Self, lexopt::Error> {
        let mut arguments = Self { effort: Effort::Full, refresh: false };
        let mut parser = Parser::from_env();
        while let Some(argument) = parser.next()? {
            match argument {
                Arg::Long("quick") => arguments.effort = Effort::Quick,
                Arg::Long("test") => arguments.effort = Effort::Test,
                Arg::Long("refresh") if can_refresh => arguments.refresh = true,
                // What cargo adds by itself.
                Arg::Long("bench") => {}
                other => return Err(other.unexpected()),
            }
        }
        if arguments.refresh && arguments.effort != Effort::Full {
            return Err("--refresh is for a full run".into());
        }
        Ok(arguments)
    }
}
