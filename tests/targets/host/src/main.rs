//! Prints the digests on a target with the standard library.

fn main() {
    let mut text = String::new();
    digest::report(&mut text).expect("a String takes all");
    print!("{text}");
}
