//! Builds `spheres.c` where Embree is installed.

fn main() {
    println!("cargo:rerun-if-changed=spheres.c");
    let built = cc::Build::new()
        .file("spheres.c")
        .opt_level(3)
        .cargo_warnings(false)
        .try_compile("embree_spheres");
    if built.is_ok() {
        println!("cargo:rustc-cfg=embree");
        println!("cargo:rustc-link-lib=embree3");
    }
}
