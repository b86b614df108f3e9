//! What one thing costs beside another that does the same.

use super::arguments::Effort;
use super::report::Table;
use super::timing::{self, Pass, Regime};
use super::{Measured, SEED, cases};
use crate::support::families::FAMILIES;

/// The easy family's cases over and over, until their branches are predicted.
const REGIME: Regime = Regime { rounds: 31, ..Regime::PREDICTED };

/// A table of comparisons, each of which was timed in rounds.
pub struct Comparisons {
    table: Table,
    effort: Effort,
}

impl Comparisons {
    pub fn new(effort: Effort) -> Self {
        let heads = ["what", "eyeray, ns", "compared with", "ns", "ratio", "at most"];
        Self { table: Table::new(&heads), effort }
    }

    /// Times ours and the others in turns, and adds a row that compares it with the fastest of them.
    pub fn compare<V: Measured>(
        &mut self,
        what: &str,
        at_most: &str,
        ours: &Pass<V>,
        others: &[(&str, Pass<V>)],
    ) {
        let regime = self.effort.regime(REGIME);
        let easy = FAMILIES.iter().find(|family| family.name == "easy").expect("it is a family");
        let passes: Vec<_> =
            std::iter::once(ours).chain(others.iter().map(|(_, pass)| pass)).collect();
        let cases = cases::<V>(easy, SEED, regime.cases);
        let times = timing::medians(&passes, cases.as_slice(), cases.len(), regime);
        let fastest =
            others.iter().zip(&times[1..]).min_by(|(_, one), (_, other)| one.total_cmp(other));
        if let Some(((name, _), time)) = fastest {
            self.table.row([
                what.into(),
                format!("{:.2}", times[0]),
                (*name).into(),
                format!("{time:.2}"),
                format!("{:.2}", times[0] / time),
                at_most.into(),
            ]);
        }
    }
}

impl std::fmt::Display for Comparisons {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.table.fmt(formatter)
    }
}
