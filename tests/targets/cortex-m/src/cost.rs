//! Counts the instructions of a miss, of an easy hit and of one from afar on a Cortex-M4F, and compares them with the formula's.
//!
//! QEMU advances its clock by a nanosecond an instruction (`-icount shift=0`), and the board's `SysTick` counts at 25 MHz.
#![no_std]
#![no_main]

#[path = "../../../support/families.rs"]
mod families;

use core::fmt::Write;
use core::hint::black_box;
use core::ops::Range;
use core::panic::PanicInfo;
use core::slice;

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};
use eyeray::{Hittable, Ray, Sphere, nearest};
use families::{Case, FAMILIES, Rng};
use glam::Vec3;

const INSTRUCTIONS_A_TICK: u32 = 1_000_000_000 / 25_000_000;
const CASES: usize = 256;
const ALL: Range<f32> = 0.0..f32::INFINITY;

#[entry]
fn main() -> ! {
    let mut out = hio::hstdout().expect("semihosting is on");
    let mut timer = Peripherals::take().expect("nobody has taken them").SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(0xff_ffff);
    timer.clear_current();
    timer.enable_counter();

    let [misses, easy, far] = cases();
    let mut count = |what: &str, cases: &[Case<Vec3>], [formula, ours]: [fn(&Case<Vec3>); 2]| {
        let nothing = instructions(&mut timer, cases, |_| {});
        let formula = instructions(&mut timer, cases, formula) - nothing;
        let ours = instructions(&mut timer, cases, ours) - nothing;
        let tenths = ours * 10 / formula;
        let (whole, tenth) = (tenths / 10, tenths % 10);
        writeln!(
            out,
            "  {what}: {ours} instructions, {whole}.{tenth} times the formula's {formula}"
        )
        .expect("semihosting takes all");
    };
    count("a miss of a slice", &misses, [by_formula, by_nearest]);
    count("an easy hit", &easy, [by_formula, by_intersect]);
    count("a hit from 1,000 radii", &far, [by_formula, by_intersect]);
    debug::exit(debug::EXIT_SUCCESS);
    unreachable!("the emulator has stopped")
}

/// Misses and hits of the easy family, and the same hits from 1,000 radii away.
fn cases() -> [[Case<Vec3>; CASES]; 3] {
    let easy = FAMILIES.iter().find(|family| family.name == "easy").expect("there is one");
    let mut rng = Rng::new(1);
    let mut next = |is_hit| loop {
        let (ray, sphere) = (easy.f32)(&mut rng);
        if sphere.occludes(&ray, ALL) == is_hit {
            return (ray, sphere);
        }
    };
    let misses = [(); CASES].map(|()| next(false));
    let hits = [(); CASES].map(|()| next(true));
    let far = hits.map(|(ray, sphere)| {
        let away = ray.direction.normalize() * (1000.0 * sphere.radius);
        let point = sphere.intersect(&ray, ALL).expect("it is one of the hits").point;
        (Ray::new(point - away, ray.direction), sphere)
    });
    [misses, hits, far]
}

/// The lecture's formula, S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*: the first root ahead.
#[inline(never)]
fn by_formula((ray, sphere): &Case<Vec3>) {
    let first_ahead = || {
        let o = sphere.center - ray.origin;
        let a = ray.direction.dot(ray.direction);
        let h = ray.direction.dot(o);
        let c = o.dot(o) - sphere.radius * sphere.radius;
        let discriminant = h * h - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let root = libm::sqrtf(discriminant);
        [(h - root) / a, (h + root) / a].into_iter().find(|&t| t > 0.0)
    };
    black_box(first_ahead());
}

#[inline(never)]
fn by_nearest((ray, sphere): &Case<Vec3>) {
    // Of an unknown length, as slices are.
    let slice: &[Sphere] = black_box(slice::from_ref(sphere));
    black_box(nearest(slice, ray, ALL));
}

#[inline(never)]
fn by_intersect((ray, sphere): &Case<Vec3>) {
    black_box(sphere.intersect(ray, ALL));
}

/// How many instructions it takes for a case.
fn instructions(timer: &mut SYST, cases: &[Case<Vec3>], run: impl Fn(&Case<Vec3>)) -> u32 {
    timer.clear_current();
    let before = SYST::get_current();
    for case in cases {
        run(black_box(case));
    }
    // It counts down.
    let ticks = before.wrapping_sub(SYST::get_current()) & 0xff_ffff;
    ticks * INSTRUCTIONS_A_TICK / u32::try_from(cases.len()).expect("they are few")
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
