//! The machine, the compiler and the flags that a table was measured with.

use std::process::Command;
use std::{env, fs};

/// The machine, the compiler and the flags, in a line.
pub fn line() -> String {
    let (os, architecture) = (env::consts::OS, env::consts::ARCH);
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let compiler = command("rustc", &["--version"]).unwrap_or_else(|| "an unknown rustc".into());
    // Those that this was compiled with.
    let flags = option_env!("RUSTFLAGS").unwrap_or_default();
    let flags =
        if flags.is_empty() { "no RUSTFLAGS".into() } else { format!("RUSTFLAGS=\"{flags}\"") };
    let fused = if cfg!(target_feature = "fma") { "FMA" } else { "no FMA" };
    format!(
        "{}, {processors} processors, {architecture} {os}; {compiler}; `cargo bench` with its profile, {flags}, {fused}.",
        processor().unwrap_or_else(|| "an unknown processor".into()),
    )
}

/// The name of the processor, where Linux tells it.
fn processor() -> Option<String> {
    let information = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = information.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn command(name: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(name).args(arguments).output().ok()?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
