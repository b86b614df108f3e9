//! Times of methods that take turns.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::support::families::Case;

/// Goes through all that it is given, with what is timed inlined into its loop.
pub type PassOver<T> = Box<dyn Fn(&T) + Sync>;

/// Goes through cases.
pub type Pass<V> = PassOver<[Case<V>]>;

/// How cases are gone through.
#[derive(Clone, Copy, Debug)]
pub struct Regime {
    pub cases: usize,
    /// Passes of a method's turn before those that are timed.
    pub warm_up: u32,
    /// Passes of a method's turn that are timed.
    pub timed: u32,
    /// Turns of each method.
    pub rounds: usize,
}

impl Regime {
    /// Few cases over and over: the branch predictor has learned them after about 60 passes.
    pub const PREDICTED: Self = Self { cases: 4096, warm_up: 60, timed: 8, rounds: 15 };
    /// More cases than a branch predictor can learn, each of them once in a turn.
    pub const UNPREDICTED: Self = Self { cases: 32_768, warm_up: 0, timed: 1, rounds: 11 };
    /// Only to see that it runs.
    pub const SMALLEST: Self = Self { cases: 64, warm_up: 0, timed: 1, rounds: 1 };

    /// The same, for a first impression.
    #[must_use]
    pub fn quick(self) -> Self {
        Self { cases: self.cases.min(8192), rounds: 3, ..self }
    }
}

/// Passes end after this time, before as while they are timed: of what is so slow, branches are the least.
const LONG: Duration = Duration::from_millis(3);

/// The nanoseconds that each pass takes for one of `count`: the median of rounds in each of which every one takes its turn.
pub fn medians<T: ?Sized>(
    passes: &[&PassOver<T>],
    input: &T,
    count: usize,
    regime: Regime,
) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(regime.rounds); passes.len()];
    for _ in 0..regime.rounds {
        for (pass, times) in passes.iter().zip(&mut times) {
            repeat(pass, input, regime.warm_up);
            let (passes, time) = repeat(pass, input, regime.timed);
            times.push(time.as_secs_f64() * 1e9 / f64::from(passes));
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    times.into_iter().map(|times| median(times) / count as f64).collect()
}

/// Goes through the input so many times, or fewer if that takes long. Returns how many times, and how long it took.
fn repeat<T: ?Sized>(pass: &PassOver<T>, input: &T, times: u32) -> (u32, Duration) {
    let start = Instant::now();
    for done in 0..times {
        let elapsed = start.elapsed();
        if done > 0 && elapsed > LONG {
            return (done, elapsed);
        }
        pass(black_box(input));
    }
    (times, start.elapsed())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
