//! The page that every run of the benches ends with: what was measured, and where the reports are.
//!
//! `cargo bench` runs one program after the other. Each prints its part of the page at its end; the last, `wrap_up`, prints them
//! all.

use std::fs;
use std::path::{Path, PathBuf};

use super::arguments::Effort;
use super::conditions;

/// The programs in the order of interest.
const PROGRAMS: [&str; 6] =
    ["speed_vs_error", "sphere_slices", "spheres", "sphere_scenes", "crossings", "throughput"];

/// The file of a program's part.
const PART: &str = "page.md";

/// Older parts belong to another run.
const ONE_RUN_SECONDS: u64 = 15 * 60;

/// The directory of a program's reports.
pub fn directory(program: &str) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"));
    target.parent().unwrap_or(target).join(program)
}

/// Writes a program's part of the page beside its reports, and prints it.
pub fn finish(program: &str, effort: Effort, part: &str) -> std::io::Result<()> {
    if effort == Effort::Test {
        println!("{program}: each once, untimed");
        return Ok(());
    }
    fs::create_dir_all(directory(program))?;
    fs::write(directory(program).join(PART), part)?;
    print(&[program]);
    Ok(())
}

/// Prints the parts of all programs that ran lately.
pub fn print_all() {
    print(&PROGRAMS);
}

fn print(programs: &[&str]) {
    let rule = "=".repeat(100);
    println!("\n{rule}\nMeasured on {}", conditions::line());
    for program in programs {
        let file = directory(program).join(PART);
        let age = fs::metadata(&file).and_then(|file| file.modified()).ok();
        let age = age.and_then(|written| written.elapsed().ok());
        if age.is_some_and(|age| age.as_secs() < ONE_RUN_SECONDS) {
            println!("\n{}", fs::read_to_string(&file).unwrap_or_default().trim_end());
        }
    }
    println!("{rule}");
}
