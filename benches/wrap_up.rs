//! The page that a whole `cargo bench` ends with.
//!
//! Cargo runs the benches in the order of their names. This is the last, and prints the summaries that the others have left.

mod measure;
mod methods;
#[path = "../tests/support/mod.rs"]
mod support;

use measure::arguments::{Arguments, Effort};
use measure::page;

fn main() {
    if Arguments::read("wrap_up").effort != Effort::Test {
        page::print_all();
    }
}
