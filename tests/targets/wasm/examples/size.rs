//! Meets one sphere in each precision asked for and does nothing else, in a WebAssembly engine.
#![no_std]

#[path = "../../cortex-m/src/meet.rs"]
mod meet;

use core::panic::PanicInfo;

// SAFETY: no other symbol of this module has the name.
#[unsafe(no_mangle)]
extern "C" fn run() {
    meet::meet_a_sphere();
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}
