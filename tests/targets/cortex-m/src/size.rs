//! Meets one sphere in each precision asked for and does nothing else, on a Cortex-M4F without an operating system.
#![no_std]
#![no_main]

mod meet;

use core::panic::PanicInfo;

use cortex_m_rt::entry;

#[entry]
fn main() -> ! {
    meet::meet_a_sphere();
    loop {}
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}
