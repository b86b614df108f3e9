//! Times of functions that take turns.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Passes once over its input, with the function that is timed inlined into the loop.
pub type PassOver<T> = Box<dyn Fn(&T) + Sync>;

/// Passes once over its own input, with the function that is timed inlined into the loop.
pub type Turn<'a> = Box<dyn FnMut() + 'a>;

/// How many cases, passes and rounds.
#[derive(Clone, Copy, Debug)]
pub struct Regime {
    pub cases: usize,
    /// Passes of a turn before those that are timed.
    pub warm_up: u32,
    /// Passes of a turn that are timed.
    pub timed: u32,
    /// Turns of each.
    pub rounds: usize,
}

impl Regime {
    /// Few cases over and over. Branch predictors learn 1,024 cases within some ten passes, and 4,096 some of them
    /// never: then the time depends on how many others take turns.
    pub const PREDICTED: Self = Self { cases: 1024, warm_up: 30, timed: 8, rounds: 11 };
    /// More cases than a branch predictor can learn, each of them once in a turn.
    pub const UNPREDICTED: Self = Self { cases: 32_768, warm_up: 0, timed: 1, rounds: 11 };
    /// Only to see that it runs.
    pub const SMALLEST: Self = Self { cases: 16, warm_up: 0, timed: 1, rounds: 1 };

    /// The same, for a first impression.
    #[must_use]
    pub fn quick(self) -> Self {
        Self { cases: self.cases.min(8192), rounds: 5, ..self }
    }
}

/// Warming up and timing each end after this time: for a function that takes so long, the prediction of branches matters little.
const LONG: Duration = Duration::from_millis(3);

/// The nanoseconds that each pass takes for one of `count` inputs: the median of rounds in which the passes take turns.
pub fn medians<T: ?Sized>(
    passes: &[&PassOver<T>],
    input: &T,
    count: usize,
    regime: Regime,
) -> Vec<f64> {
    let turns = passes.iter().map(|pass| -> Turn<'_> { Box::new(|| pass(black_box(input))) });
    medians_of_turns(turns.collect(), count, regime)
}

/// The nanoseconds that each takes for one of `count` inputs: the median of rounds in which they take turns.
pub fn medians_of_turns(mut turns: Vec<Turn<'_>>, count: usize, regime: Regime) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(regime.rounds); turns.len()];
    for _ in 0..regime.rounds {
        for (turn, times) in turns.iter_mut().zip(&mut times) {
            repeat(turn, regime.warm_up);
            let (passes, time) = repeat(turn, regime.timed);
            times.push(time.as_secs_f64() * 1e9 / f64::from(passes));
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    times.into_iter().map(|times| median(times) / count as f64).collect()
}

/// Repeats a turn so many times, or fewer if that takes long. Returns the number of times and the time.
fn repeat(turn: &mut Turn<'_>, times: u32) -> (u32, Duration) {
    let start = Instant::now();
    for done in 0..times {
        let elapsed = start.elapsed();
        if done > 0 && elapsed > LONG {
            return (done, elapsed);
        }
        turn();
    }
    (times, start.elapsed())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
