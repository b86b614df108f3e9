//! Compiles `cgal.cpp` where CGAL is installed: on Debian, `apt-get install libcgal-dev`.

use std::path::Path;
use std::{env, fs};

fn build() -> cc::Build {
    let mut build = cc::Build::new();
    // CGAL's intervals are computed with the processor's rounding upwards.
    build.cpp(true).std("c++17").flag_if_supported("-frounding-math").define("NDEBUG", None);
    build
}

fn main() -> std::io::Result<()> {
    println!("cargo::rustc-check-cfg=cfg(cgal)");
    println!("cargo::rerun-if-changed=cgal.cpp");
    println!("cargo::rerun-if-changed=/usr/include/CGAL/version.h");

    let directory = env::var_os("OUT_DIR").unwrap_or_default();
    let probe = Path::new(&directory).join("probe.cpp");
    fs::write(&probe, "#include <CGAL/version.h>\n#include <mpfr.h>\n")?;
    if build().file(&probe).cargo_output(false).try_compile("probe").is_ok() {
        build().file("cgal.cpp").warnings(false).compile("eyeray_cgal");
        println!("cargo::rustc-link-lib=mpfr");
        println!("cargo::rustc-link-lib=gmp");
        println!("cargo::rustc-cfg=cgal");
    }
    Ok(())
}
