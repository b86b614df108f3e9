//! Comparisons of two functions that do the same.

use super::arguments::Effort;
use super::price::{self, Predicted};
use super::report::Table;
use super::{Measured, Timed};
use crate::support::families::FAMILIES;

/// A table of comparisons on the easy family, each timed in turns.
pub struct Comparisons {
    table: Table,
    effort: Effort,
}

impl Comparisons {
    pub fn new(effort: Effort) -> Self {
        let heads = ["what", "eyeray, ns", "compared with", "ns", "ratio", "at most"];
        Self { table: Table::new(&heads), effort }
    }

    /// Times ours and another in turns, and adds a row that compares them.
    pub fn compare<V: Measured>(
        &mut self,
        what: &str,
        at_most: &str,
        ours: &dyn Timed<V>,
        (name, theirs): (&str, &dyn Timed<V>),
    ) {
        let easy = FAMILIES.iter().find(|family| family.name == "easy").expect("it is a family");
        let times = price::predicted(&[ours], theirs, easy, self.effort);
        let [Predicted { nanoseconds, price: ratio }] = times[..] else { return };
        self.table.row([
            what.into(),
            format!("{nanoseconds:.2}"),
            name.into(),
            format!("{:.2}", nanoseconds / ratio),
            format!("{ratio:.2}"),
            at_most.into(),
        ]);
    }
}

impl std::fmt::Display for Comparisons {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.table.fmt(formatter)
    }
}
