//! The nearest hit among 100 to 1,000,000 spheres by [`eyeray::SphereBvh`], and the time that it takes, beside a scan
//! ([`eyeray::Spheres`]), a hierarchy of the crate obvhs, and Embree.
//!
//! ```text
//! cargo run --release --manifest-path examples/many_spheres/Cargo.toml
//! cargo run --release --manifest-path examples/many_spheres/Cargo.toml -- --largest 10000 --rays 1000000
//! ```
//!
//! Half of the rays are eye rays, the other half leave the surfaces that those have met. The scan, `SphereBvh` and the exact
//! routine in obvhs's hierarchy must give the same hits, bit for bit, or the example fails. Embree, which computes in single
//! precision, is there if Debian's libembree-dev is installed.
//!
//! Two more columns are of the eye rays only, by `SphereBvh`: one at a time ([`eyeray::SphereBvh::nearest`]), and 64 at a time,
//! those of a tile of the picture ([`eyeray::SphereBvh::nearest_each`]). These must give the same hits, too.

mod arguments;
mod cloud;
#[path = "../../shared/command_line.rs"]
mod command_line;
mod obvhs;

use std::error::Error;
use std::hint::black_box;
use std::io::{Write, stdout};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use arguments::{Arguments, USAGE};
use eyeray::{Hit, Ray, Sphere, SphereBvh, Spheres};
use obvhs::Hierarchy;

/// How many spheres there are in the clouds.
const SIZES: [u32; 13] = [
    100, 200, 500, 1_000, 2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000, 500_000,
    1_000_000,
];

fn main() -> ExitCode {
    command_line::run("many_spheres", USAGE, arguments::parse, run)
}

/// Measures all sizes, prints each when it is done, and then from which size on `SphereBvh` is faster than the scan.
fn run(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let eye_rays =
        cloud::eye_rays(arguments.rays / 2).map_err(|error| format!("no such camera: {error}"))?;
    let titles =
        ["scan", "SphereBvh", "obvhs", "Embree", "eye rays", "in tiles", "built in", "same hits"];
    print_row("spheres", titles.map(String::from));

    let mut overtakes = None;
    for count in SIZES.into_iter().filter(|&count| count <= arguments.largest) {
        let row = measure(count, &eye_rays, arguments.rays)?;
        if row.bvh >= row.scan {
            overtakes = None;
        } else if overtakes.is_none() {
            overtakes = Some(count);
        }
        let nanoseconds = |time: f64| format!("{time:.0} ns");
        let cells = [
            nanoseconds(row.scan),
            nanoseconds(row.bvh),
            nanoseconds(row.obvhs),
            row.embree.map_or("skipped".into(), nanoseconds),
            nanoseconds(row.eye_rays),
            nanoseconds(row.in_tiles),
            format!("{:.2} ms", row.build.as_secs_f64() * 1e3),
            format!("of {}", row.compared),
        ];
        print_row(&count.to_string(), cells);
    }
    Ok(match overtakes {
        Some(count) => format!("SphereBvh is faster than the scan from {count} spheres on."),
        None => "The scan is as fast to the end.".to_owned(),
    })
}

fn print_row(count: &str, cells: [String; 8]) {
    let cells = cells.map(|cell| format!("{cell:>12}"));
    // A closed pipe is no error.
    let _ = writeln!(stdout(), "{count:>9}{}", cells.concat());
}

/// The measurements of one cloud: nanoseconds a ray.
struct Row {
    scan: f64,
    bvh: f64,
    obvhs: f64,
    /// If it is there.
    embree: Option<f64>,
    /// The eye rays only, by `SphereBvh`, one at a time.
    eye_rays: f64,
    /// The same, 64 at a time.
    in_tiles: f64,
    /// How long `SphereBvh` took to sort the spheres.
    build: Duration,
    /// How many rays were asked of all.
    compared: usize,
}

fn measure(count: u32, eye_rays: &[Ray], ray_count: u32) -> Result<Row, String> {
    const ALL: std::ops::Range<f32> = 0.0..f32::INFINITY;
    let spheres = cloud::spheres(count as usize);
    let scan: Spheres = spheres.iter().copied().collect();
    let (bvh, build) = timed(|| spheres.iter().copied().collect::<SphereBvh>());
    let hierarchy = Hierarchy::new(&spheres);
    let numbers: Vec<[f32; 4]> =
        spheres.iter().map(|&Sphere { center: c, radius }| [c.x, c.y, c.z, radius]).collect();
    let embree = embree::Device::new().and_then(|device| device.build(&numbers));

    let found: Vec<_> = eye_rays.iter().map(|ray| bvh.nearest(ray, ALL)).collect();
    let mut in_tiles = vec![None; eye_rays.len()];
    bvh.nearest_each(eye_rays, ALL, &mut in_tiles);
    if in_tiles != found {
        return Err(format!(
            "of {count} spheres, the eye rays do not have the same hits in tiles as one at a time"
        ));
    }

    let hits: Vec<Hit> = found.into_iter().flatten().map(|(_, hit)| hit).collect();
    let mut rays = eye_rays.to_vec();
    rays.extend(cloud::bounce_rays(&hits, ray_count - ray_count / 2));
    // A scan takes as much longer as there are more spheres: of a large cloud, some of the rays have to do.
    let every = 1 + count as usize / 2_000;
    let sample: Vec<Ray> = rays.iter().copied().step_by(every).collect();

    for ray in &sample {
        let expected = scan.nearest(ray, ALL);
        for (name, found) in
            [("SphereBvh", bvh.nearest(ray, ALL)), ("obvhs", hierarchy.nearest(ray))]
        {
            if found != expected {
                return Err(format!(
                    "of {count} spheres, {ray:?} meets {expected:?}, but by {name} {found:?}"
                ));
            }
        }
    }
    Ok(Row {
        scan: nanoseconds(&sample, |ray| scan.nearest(ray, ALL)),
        bvh: nanoseconds(&rays, |ray| bvh.nearest(ray, ALL)),
        obvhs: nanoseconds(&rays, |ray| hierarchy.nearest(ray)),
        embree: embree.map(|embree| {
            nanoseconds(&rays, |ray| {
                embree.nearest(ray.origin.to_array(), ray.direction.to_array())
            })
        }),
        eye_rays: nanoseconds(eye_rays, |ray| bvh.nearest(ray, ALL)),
        in_tiles: nanoseconds_in_batches(eye_rays, |batch| {
            let mut found = [None; 64];
            for tile in batch.chunks(64) {
                bvh.nearest_each(tile, ALL, &mut found);
                black_box(&found);
            }
        }),
        build,
        compared: sample.len(),
    })
}

fn timed<T>(make: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = make();
    (result, start.elapsed())
}

/// How many rays are timed together: a whole number of tiles.
const BATCH: usize = 512;

/// How long a query takes, of one ray at a time.
fn nanoseconds<T>(rays: &[Ray], nearest: impl Fn(&Ray) -> T) -> f64 {
    nanoseconds_in_batches(rays, |batch| {
        for ray in batch {
            black_box(nearest(ray));
        }
    })
}

/// How long a query takes a ray.
///
/// All rays are traced several times, in batches, and of each batch the shortest time counts: what else the machine does
/// in between makes some batches longer, and none shorter. Between two times, all other rays have passed.
fn nanoseconds_in_batches(rays: &[Ray], ask: impl Fn(&[Ray])) -> f64 {
    const TIMES: usize = 4;
    let mut shortest = vec![Duration::MAX; rays.len().div_ceil(BATCH)];
    for _ in 0..TIMES {
        for (batch, shortest) in rays.chunks(BATCH).zip(&mut shortest) {
            let ((), time) = timed(|| ask(batch));
            *shortest = time.min(*shortest);
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "there are fewer rays than 2⁵²")]
    let rays = rays.len() as f64;
    shortest.into_iter().sum::<Duration>().as_secs_f64() * 1e9 / rays
}
