//! Prints the digests on a Cortex-M4F without an operating system, through semihosting.
#![no_std]
#![no_main]

use core::fmt::Write;
use core::panic::PanicInfo;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};

#[entry]
fn main() -> ! {
    let mut out = hio::hstdout().expect("semihosting is on");
    digest::report(&mut out).expect("semihosting takes all");
    debug::exit(debug::EXIT_SUCCESS);
    unreachable!("the emulator has stopped")
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    if let Ok(mut out) = hio::hstderr() {
        let _ = writeln!(out, "{info}");
    }
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}
