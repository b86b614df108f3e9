//! Prints the digests in a WebAssembly engine, byte by byte through the one function that it imports.
#![no_std]

use core::fmt;
use core::panic::PanicInfo;

mod host {
    #[link(wasm_import_module = "host")]
    unsafe extern "C" {
        pub(crate) safe fn print(byte: u8);
    }
}

struct Host;

impl fmt::Write for Host {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            host::print(byte);
        }
        Ok(())
    }
}

// SAFETY: no other symbol of this module has the name.
#[unsafe(no_mangle)]
extern "C" fn run() {
    digest::report(&mut Host).expect("the host takes all");
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}
