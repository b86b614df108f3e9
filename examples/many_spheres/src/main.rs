//! What a ray costs in a cloud of 100 to 1,000,000 spheres: asked of all of them by [`eyeray::Spheres`], and through a
//! hierarchy of boxes around them, by the crate obvhs.
//!
//! ```text
//! cargo run --release --manifest-path examples/many_spheres/Cargo.toml
//! cargo run --release --manifest-path examples/many_spheres/Cargo.toml -- --largest 10000 --rays 1000000
//! ```
//!
//! The hierarchy takes longer to build, and is worth it for more than a few thousand spheres. Half of the rays are eye rays,
//! the other half leave the surfaces that those have met. Both ways must give the same hits, bit for bit, or the example fails.

mod arguments;
mod cloud;
mod hierarchy;

use std::hint::black_box;
use std::io::{Write, stderr, stdout};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use arguments::{Arguments, Request, USAGE};
use eyeray::{Hit, Ray, Spheres};
use hierarchy::Hierarchy;

/// How many spheres there are in the clouds.
const SIZES: [u32; 13] = [
    100, 200, 500, 1_000, 2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000, 500_000,
    1_000_000,
];

fn main() -> ExitCode {
    match arguments::parse(lexopt::Parser::from_env()) {
        Ok(Request::Help) => tell(stdout(), USAGE, ExitCode::SUCCESS),
        Ok(Request::Measure(arguments)) => match run(&arguments) {
            Ok(summary) => tell(stdout(), &summary, ExitCode::SUCCESS),
            Err(message) => tell(stderr(), &format!("many_spheres: {message}"), ExitCode::FAILURE),
        },
        Err(error) => tell(stderr(), &format!("many_spheres: {error}\n{USAGE}"), ExitCode::from(2)),
    }
}

/// Prints the message. That nobody listens, as at the end of a closed pipe, is no error.
fn tell(mut to: impl Write, message: &str, code: ExitCode) -> ExitCode {
    let _ = writeln!(to, "{message}");
    code
}

/// Measures all sizes, printing each as it is done, and says where the hierarchy overtakes the scan.
fn run(arguments: &Arguments) -> Result<String, String> {
    let eye_rays =
        cloud::eye_rays(arguments.rays / 2).map_err(|error| format!("no such camera: {error}"))?;
    print_row("", "scan", "scan", "hierarchy", "hierarchy", "same hits");
    print_row("spheres", "build", "a ray", "build", "a ray", "of so many rays");

    let mut overtakes = None;
    for count in SIZES.into_iter().filter(|&count| count <= arguments.largest) {
        let row = measure(count, &eye_rays, arguments.rays)?;
        if row.hierarchy.a_ray >= row.scan.a_ray {
            overtakes = None;
        } else if overtakes.is_none() {
            overtakes = Some(count);
        }
        print_row(
            &count.to_string(),
            &format!("{:.2} ms", row.scan.build.as_secs_f64() * 1e3),
            &format!("{:.0} ns", row.scan.a_ray),
            &format!("{:.2} ms", row.hierarchy.build.as_secs_f64() * 1e3),
            &format!("{:.0} ns", row.hierarchy.a_ray),
            &row.compared.to_string(),
        );
    }
    Ok(match overtakes {
        Some(count) => format!("The hierarchy is faster from {count} spheres on."),
        None => "The scan is as fast to the end.".to_owned(),
    })
}

fn print_row(count: &str, scan: &str, a_scan: &str, build: &str, a_query: &str, same: &str) {
    let row = format!("{count:>9}{scan:>11}{a_scan:>12}{build:>12}{a_query:>11}  {same}");
    tell(stdout(), &row, ExitCode::SUCCESS);
}

/// What was measured of one cloud.
struct Row {
    scan: Cost,
    hierarchy: Cost,
    /// How many rays were asked of both.
    compared: usize,
}

struct Cost {
    build: Duration,
    /// In nanoseconds.
    a_ray: f64,
}

fn measure(count: u32, eye_rays: &[Ray], ray_count: u32) -> Result<Row, String> {
    let spheres = cloud::spheres(count as usize);
    let (scan, scan_build) = timed(|| spheres.iter().copied().collect::<Spheres>());
    let (hierarchy, hierarchy_build) = timed(|| Hierarchy::new(&spheres));

    let hits: Vec<Hit> =
        eye_rays.iter().filter_map(|ray| hierarchy.nearest(ray)).map(|(_, hit)| hit).collect();
    let mut rays = eye_rays.to_vec();
    rays.extend(cloud::bounce_rays(&hits, ray_count - ray_count / 2));
    // A scan takes as much longer as there are more spheres: of a large cloud, some of the rays have to do.
    let every = 1 + count as usize / 2_000;
    let sample: Vec<Ray> = rays.iter().copied().step_by(every).collect();

    let scanned = |ray: &Ray| scan.nearest(ray, 0.0..f32::INFINITY);
    for ray in &sample {
        let (expected, found) = (scanned(ray), hierarchy.nearest(ray));
        if found != expected {
            return Err(format!(
                "of {count} spheres, {ray:?} meets {expected:?}, but in the hierarchy {found:?}"
            ));
        }
    }
    Ok(Row {
        scan: Cost { build: scan_build, a_ray: nanoseconds(&sample, scanned) },
        hierarchy: Cost {
            build: hierarchy_build,
            a_ray: nanoseconds(&rays, |ray| hierarchy.nearest(ray)),
        },
        compared: sample.len(),
    })
}

fn timed<T>(make: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = make();
    (result, start.elapsed())
}

/// How long a query takes.
///
/// All rays are traced several times, in batches, and of each batch the shortest time counts: what else the machine does
/// in between makes some batches longer, and none shorter. Between two times, all other rays have passed.
fn nanoseconds(rays: &[Ray], nearest: impl Fn(&Ray) -> Option<(usize, Hit)>) -> f64 {
    const BATCH: usize = 500;
    const TIMES: usize = 4;
    let mut shortest = vec![Duration::MAX; rays.len().div_ceil(BATCH)];
    for _ in 0..TIMES {
        for (batch, shortest) in rays.chunks(BATCH).zip(&mut shortest) {
            let ((), time) = timed(|| {
                for ray in batch {
                    black_box(nearest(ray));
                }
            });
            *shortest = time.min(*shortest);
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "there are fewer rays than 2⁵²")]
    let rays = rays.len() as f64;
    shortest.into_iter().sum::<Duration>().as_secs_f64() * 1e9 / rays
}
