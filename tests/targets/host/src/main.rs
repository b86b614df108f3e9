//! Prints the digests on a target with the standard library, where `Spheres` finds what the slice gives.

fn main() {
    digest::assert_spheres_find_the_same();
    let mut text = String::new();
    digest::report(&mut text).expect("a String takes all");
    print!("{text}");
}
