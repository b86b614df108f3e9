//! The command line of a report.

use std::process;

use lexopt::{Arg, Parser};

use super::timing::Regime;

/// How much is measured, and where it goes.
#[derive(Clone, Copy, Debug)]
pub struct Arguments {
    pub effort: Effort,
    /// Only the prices, without the other methods and without errors.
    pub prices: bool,
    /// Whether the copies beside the benches are written too.
    pub refresh: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// For the copies beside the benches.
    Full,
    Usual,
    /// For a first impression.
    Quick,
    /// Only to see that it runs.
    Test,
}

impl Effort {
    /// The number of cases at this effort.
    pub fn cases(self, full: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Usual => full / 5,
            Self::Quick => full / 50,
            Self::Test => 20,
        }
    }

    pub fn regime(self, full: Regime) -> Regime {
        match self {
            Self::Full | Self::Usual => full,
            Self::Quick => full.quick(),
            Self::Test => Regime::SMALLEST,
        }
    }
}

impl Arguments {
    /// Reads the arguments of a program, and ends it where they ask for other benchmarks.
    pub fn read(program: &str) -> Self {
        Self::parse(program).unwrap_or_else(|error| {
            eprintln!("error: {error}");
            process::exit(2)
        })
    }

    /// `cargo bench` passes the same arguments to every program, also those that are only for criterion.
    fn parse(program: &str) -> Result<Self, lexopt::Error> {
        let mut arguments = Self { effort: Effort::Usual, prices: false, refresh: false };
        let mut parser = Parser::from_env();
        while let Some(argument) = parser.next()? {
            match argument {
                Arg::Long("quick") => arguments.effort = Effort::Quick,
                Arg::Long("test") => arguments.effort = Effort::Test,
                Arg::Long("prices") => arguments.prices = true,
                Arg::Long("refresh") => arguments.refresh = true,
                // What cargo adds by itself.
                Arg::Long("bench") => {}
                Arg::Value(name) if program.contains(&*name.to_string_lossy()) => {}
                Arg::Value(_) => process::exit(0),
                other => eprintln!("not for this report: {}", other.unexpected()),
            }
        }
        if arguments.refresh {
            if arguments.effort != Effort::Usual || arguments.prices {
                return Err("--refresh is for a full run".into());
            }
            arguments.effort = Effort::Full;
        }
        Ok(arguments)
    }
}
