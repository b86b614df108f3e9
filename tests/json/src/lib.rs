//! Data read back from JSON with serde_json's default features, whose parser of decimal numbers may be off by an ulp.
//!
//! ```text
//! cargo test --manifest-path tests/json/Cargo.toml
//! ```
#![cfg(test)]

use eyeray::{Camera, Ray, Sphere, Vector};
use glam::{DVec3, Vec3, dvec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde_json::{from_str, to_string};

const CASES: usize = 20_000;

/// Numbers between -1 and 1.
struct Numbers(Pcg32);

impl Numbers {
    fn new() -> Self {
        Self(Pcg32::seed_from_u64(1))
    }

    fn next(&mut self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let bits = (self.0.next_u64() >> 11) as f64;
        bits * f64::EPSILON - 1.0
    }

    fn vector<V: Vector>(&mut self) -> V {
        V::from_f64(dvec3(self.next(), self.next(), self.next()))
    }

    /// The camera that needs all its digits.
    fn camera(&mut self) -> Camera<DVec3> {
        let (eye, target, up) = (self.vector::<DVec3>() * 10.0, self.vector(), self.vector());
        let (fov_y, aspect) = (1.5 + self.next(), 1.5 + self.next());
        Camera::perspective_fov(eye, target, up, fov_y, aspect).expect("a camera")
    }

    fn camera_f32(&mut self) -> Camera {
        let (eye, target, up) = (self.vector::<Vec3>() * 10.0, self.vector(), self.vector());
        Camera::perspective_fov(eye, target, up, 0.9, 1.6).expect("a camera")
    }
}

/// The largest difference between coordinates of two directions, in lengths of the first.
fn difference(a: DVec3, b: DVec3) -> f64 {
    (a - b).abs().max_element() / a.length()
}

#[test]
fn single_precision_is_read_as_it_was_written() {
    let mut numbers = Numbers::new();
    for _ in 0..CASES {
        let ray: Ray = Ray::new(numbers.vector(), numbers.vector());
        let read: Ray = from_str(&to_string(&ray).expect("finite")).expect("a ray");
        assert_eq!(read, ray);
    }
}

/// If this fails, serde_json now reads exactly without its feature, and the documentation need not ask for it.
#[test]
fn double_precision_needs_float_roundtrip() {
    let mut numbers = Numbers::new();
    let mut changed = 0;
    for _ in 0..CASES {
        let sphere: Sphere<DVec3> = Sphere::new(numbers.vector(), numbers.next());
        let read: Sphere<DVec3> = from_str(&to_string(&sphere).expect("finite")).expect("a sphere");
        assert!((read.center - sphere.center).abs().max_element() <= f64::EPSILON);
        changed += usize::from(read != sphere);
    }
    assert!(changed > 0);
    println!("{changed} of {CASES} spheres in f64 have changed");
}

/// A camera keeps its basis in f64. It is read all the same, and is as good as before in f32.
#[test]
fn every_camera_is_read() {
    let mut numbers = Numbers::new();
    let mut changed = [0; 2];
    for _ in 0..CASES {
        let camera = numbers.camera();
        let read: Camera<DVec3> = from_str(&to_string(&camera).expect("finite")).expect("a camera");
        changed[1] += usize::from(read != camera);
        for (read, ray) in read.rays(3, 2).zip(camera.rays(3, 2)) {
            assert!(difference(read.direction, ray.direction) <= 4.0 * f64::EPSILON);
        }

        let camera = numbers.camera_f32();
        let read: Camera = from_str(&to_string(&camera).expect("finite")).expect("a camera");
        changed[0] += usize::from(read != camera);
        for (read, ray) in read.rays(3, 2).zip(camera.rays(3, 2)) {
            let [read, ray] = [read, ray].map(|ray| ray.direction.as_dvec3());
            assert!(difference(read, ray) <= f64::from(f32::EPSILON));
        }
    }
    assert!(changed.iter().all(|changed| *changed > 0));
    println!("{changed:?} of {CASES} cameras in f32 and f64 have changed");
}
