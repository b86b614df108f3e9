//! Meets one sphere in each precision asked for and does nothing else, so that its size is that of the routines.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

use cortex_m_rt::entry;
use eyeray::{Hittable, Ray, Scalar, Sphere, Vector};

#[entry]
fn main() -> ! {
    if cfg!(feature = "f32") {
        meet::<glam::Vec3>();
    }
    if cfg!(feature = "f64") {
        meet::<glam::DVec3>();
    }
    loop {}
}

fn meet<V: Vector>() {
    let ray = Ray::new(V::default(), V::default());
    let sphere = Sphere::new(V::default(), V::Scalar::ONE);
    let (ray, sphere) = black_box((ray, sphere));
    black_box(sphere.intersect(&ray, V::Scalar::ZERO..V::Scalar::INFINITY));
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}
