//! The page that every run of the benches ends with: what was measured, and where the reports lie.
//!
//! `cargo bench` runs one program after the other. Each leaves its part of the page beside its report, and prints the whole.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::arguments::Effort;
use super::conditions;

/// The programs in the order of interest.
const PROGRAMS: [&str; 5] = ["speed_vs_error", "speed", "spheres", "peers", "intersect"];

/// Parts older than this are of another run.
const ONE_RUN: Duration = Duration::from_secs(15 * 60);

/// Where a program leaves its reports.
pub fn directory(program: &str) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"));
    target.parent().unwrap_or(target).join(program)
}

/// Leaves a program's part of the page, and prints the page.
pub fn finish(program: &str, effort: Effort, part: &str) -> std::io::Result<()> {
    if effort == Effort::Test {
        println!("{program}: each once, untimed");
        return Ok(());
    }
    fs::create_dir_all(directory(program))?;
    fs::write(directory(program).join("page.md"), part)?;
    print();
    Ok(())
}

/// Prints the parts of all programs that ran lately.
pub fn print() {
    let rule = "=".repeat(100);
    println!("\n{rule}\nMeasured on {}", conditions::line());
    for program in PROGRAMS {
        let file = directory(program).join("page.md");
        let age = fs::metadata(&file).and_then(|file| file.modified()).ok();
        let age = age.and_then(|written| written.elapsed().ok());
        if let Some(age) = age.filter(|&age| age < ONE_RUN) {
            let before = match age.as_secs() / 60 {
                0 => String::new(),
                minutes => format!(", {minutes} min ago"),
            };
            println!("\n--- {program}{before}\n");
            print!("{}", fs::read_to_string(&file).unwrap_or_default());
        }
    }
    println!("{rule}");
}
